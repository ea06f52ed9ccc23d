"""Bernstein form: control points, exact conversions, Bezier pieces and polylines of any curve.

- ``bernstein``: fast evaluation from control points.  ``bernstein_algebra``: products, derivatives, roots.
- ``hermite_roots``: where derivatives of the cardinal Hermite polynomials vanish; imported late, for its
  fractions.
- ``chebyshev``: Chebyshev coefficients, and from them those of Bernstein.
- ``control_points``: exact and approximate ones.
- ``conversion``: exact ones of any stretch, degree elevation.
- ``pieces``: any curve as Bezier pieces of low degree.  ``arcs``: Bezier arcs that searches halve.
- ``flatten``: polylines within a tolerance.  ``flatten_samples``: those of curves without Bezier pieces.
  ``polylines``: geometry of polylines, and how far they may leave the curve.
"""
