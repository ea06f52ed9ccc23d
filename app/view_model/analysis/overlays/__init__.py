"""The overlays: one or two records a module, with all that is known of them.

- ``comb``, ``vectors``, ``circle``, ``ticks``, ``marks``: the run of the curve.
- ``bezier``, ``polygon``: control points and points.
- ``band``, ``ensemble``: errors of the data, at worst and at random.
"""
