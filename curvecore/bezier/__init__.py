"""Bernstein form: control points, exact conversions, Bezier pieces and polylines of any curve.

- ``bernstein``: fast evaluation from control points.  ``bernstein_algebra``: products, derivatives, roots.
- ``control_points``: exact and approximate ones.
- ``conversion``: exact ones of any stretch, degree elevation.
- ``pieces``: any curve as Bezier pieces of low degree.  ``flatten``: polylines within a tolerance.
"""
