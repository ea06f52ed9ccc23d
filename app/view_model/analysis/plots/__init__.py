"""The plots over t: one record a module or several, with all that is known of them.

- ``lengths``: speed, acceleration and jerk.
- ``curvature``, ``lebesgue``: the bend of the curve; the growth of errors of its points.
"""
