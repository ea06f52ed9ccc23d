"""curvecore: parametric curves that are linear in their data, with NumPy alone.

A curve is made of points, of what its family asks for beside them, and of
parameters, and is called like a function:

>>> from curvecore import HermiteCurve, arc_length, chord_length, natural_spline_velocities
>>> points = [[0, 0], [1, 2], [4, 3], [5, 0]]
>>> t = chord_length(points)
>>> curve = HermiteCurve(points, natural_spline_velocities(points, t), t)
>>> curve
HermiteCurve(n=4, dim=2, domain=(0, 1))
>>> curve([0, 0.5]).round(3).tolist()
[[0.0, 0.0], [2.986, 3.079]]
>>> curve.derivative().roots(axis=1).round(3).tolist()
[0.55]
>>> round(arc_length(curve, 1e-9).value, 6)
8.871727

Derivatives and antiderivatives are curves too, and coordinates can be solved for:

>>> velocity = curve.derivative()
>>> velocity
Derivative(HermiteCurve(n=4, dim=2, domain=(0, 1)), order=1)
>>> curve.integrate(0, 1).round(3).tolist()
[2.757, 1.944]
>>> curve.solve(2.0, axis=0).round(3).tolist()
[0.39]
>>> curve(1.25, extrapolate=False).tolist()
[nan, nan]

Functions measure any curve of any family, within a bound that is an argument:

>>> from curvecore import flatten, nearest
>>> round(nearest(curve, [3, 1], 1e-9).distance, 6)
1.884072
>>> len(flatten(curve, 0.01)) < 50
True

A family of your own says what its functions are, and gets all of the above:

>>> import numpy as np
>>> from curvecore import ParametricCurve
>>> class Ellipse(ParametricCurve):
...     "An ellipse from the ends of its two axes."
...     name = title = "ellipse"
...     interpolates = False
...     def _basis(self, t, order):  # t (m,) -> (m, n)
...         angle = t + order * np.pi / 2
...         return np.stack([np.cos(angle), np.sin(angle)], axis=1)
>>> ellipse = Ellipse([[2, 0], [0, 1]], [0, 2 * np.pi])
>>> round(arc_length(ellipse, 1e-9).value, 6)
9.688448

Where SciPy is installed, polynomial curves go there and come back: `to_bpoly`,
`to_ppoly`, `from_bpoly`.

Its methods are those of `ParametricCurve`, whatever its family; functions of
this package take any curve. Start with ``help(curvecore.ParametricCurve)``.

Every family is linear in its data: c(t) = sum over i, r of B_ir(t) d_ir, where
`jets` holds d with shape (n, R, dim) - point, velocity, acceleration, jerk, per
unit of t - and ``basis(t)`` is B with shape (m, n, R).

A tour of the package, one subject a file:

===================  =======================================================
errors               `CurveError`, the only exception for unusable input
arrays               validation of every argument, shared array types
arithmetic           numbers with exponents of their own, lengths of vectors,
                     numbers of 106 bits
parametrization      rules for the t_i: `uniform`, `chebyshev`, `chebyshev_roots`,
                     `chord_length`, `centripetal`, `power`
tangents             velocities and accelerations estimated from points
  limited_tangents   velocities that keep to the course of the points: monotone, Akima

families             one file each: `ParametricCurve`, the base class; `LagrangeCurve`,
                     `HermiteCurve`, `QuinticHermiteCurve`, `SepticHermiteCurve`,
                     `CubicSplineCurve`, `FloaterHormannCurve`; over control points
                     `BezierCurve` and `BSplineCurve`; `BasisCurve` of any basis
                     functions; `Chain`, curves end to end: corners; `FamilySetting`

bezier.bernstein     Bernstein form: products, derivatives, roots, evaluation
  control_points     exact and approximate Bezier control points
  conversion         exact ones of any stretch, degree elevation
  pieces             any curve as Bezier pieces of low degree
  flatten            polylines within a tolerance

calculus.methods     ``derivative``, ``integrate``, ``solve`` ...: methods of every curve
  derivative         `Derivative` and `Antiderivative`, which are curves
  integrals          between two parameters
  solutions          parameters at which a coordinate has a value
  scipy_objects      SciPy's BPoly and PPoly

drag                 updates while points or parameters move:
  frozen             polylines whose vertices are kept, whatever moves
  moved_points       polylines while some points move together
  moved_parameters   Lagrange curves and functions after a few parameters moved

analysis.curvature   curvature, its inflections and extrema; extrema of coordinates
  bounding_boxes     the smallest boxes
  lengths            lengths within a bound, and the way back
  nearest_point      the nearest point of a curve, of all or within a reach
  intersections      where a curve crosses itself or another
  continuity         jumps at the joints, and the class that follows
  basis_checks       what is wrong with basis functions, measured
  stability          Lebesgue function and constant
  cardinal           effects of points from which derivatives are estimated:
                     `CardinalBasis`
  condition          condition numbers of monomial systems
  sensitivity        derivatives by the data, worst cases, random errors

fitting.fit          few points near many data: `fit`
  fitter             a curve of so many points
  least_squares      the linear problem: `least_squares_curve`
  joints             corners of data, and where joints should be

rounding.evaluation  curves computed with k decimal digits
  decimal_methods    its methods, operation by operation
  operations         what they cost
  data               data rounded to so many decimals or digits
  exact              curves without rounding, and the digits lost
===================  =======================================================

Arguments are copied and checked; attributes are read-only; there is no global
state but working memory. Indices count from 0. A module is imported when one of its
names is first used (SPEC 1): the list of names is ``__init__.pyi``.
"""

from curvecore.late_names import late_names

__version__ = "0.1.0"
__getattr__, __dir__, __all__ = late_names(__name__, __file__)
