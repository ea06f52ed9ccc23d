"""Bernstein form: control points, exact conversions, Bezier pieces and polylines of any curve.

- ``bernstein``: products, derivatives and roots; fast evaluation from control points.
- ``control_points``: exact and approximate ones of a curve.
- ``conversion``: exact ones of any stretch, degree elevation.
- ``pieces``: any curve as Bezier pieces of low degree.
- ``flatten``: polylines within a tolerance.
- ``hermite_roots``: roots of the derivatives of Hermite functions, in exact arithmetic, for
  ``families.hermite_taylor``.
"""
