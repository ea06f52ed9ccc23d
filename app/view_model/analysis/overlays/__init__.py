"""The overlays: one or two records a module, with all that is known of them.

- ``comb``, ``vectors``, ``circle``, ``ticks``, ``marks``: how the curve runs.
- ``bezier``, ``polygon``: control points and points.
- ``band``, ``ensemble``: what errors of the data do, at worst and at random.
"""
