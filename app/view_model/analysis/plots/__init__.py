"""The plots over t: one record a module or several, with all that is known of them.

- ``lengths``: speed, acceleration and jerk.
- ``curvature``, ``lebesgue``: how the curve bends; how errors of its points grow.
"""
