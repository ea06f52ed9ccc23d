"""curvecore: parametric curves that are linear in their data, with NumPy alone.

Every family is linear in its data: c(t) = sum over i, r of B_ir(t) d_ir, where
`jets` holds d with shape (n, R, dim) - point, velocity, acceleration, jerk, per
unit of t - and ``basis(t)`` is B with shape (m, n, R).

A tour of the package, one concept a file:

===================  =======================================================
errors               `CurveError`, the only exception for unusable input
arrays               validation of every argument, shared array types
parametrization      rules for the t_i: `uniform`, `chebyshev`,
                     `chord_length`, `centripetal`, `power`
tangents             velocities and accelerations estimated from points

families             one file each: `ParametricCurve`, the base class; `LagrangeCurve`,
                     `HermiteCurve`, `QuinticHermiteCurve`, `SepticHermiteCurve`,
                     `CubicSplineCurve`, `FloaterHormannCurve`; over control points
                     `BezierCurve` and `BSplineCurve`; `BasisCurve` of any basis
                     functions; `Chain`, curves end to end: corners; `FamilySetting`

bezier.bernstein     Bernstein form: fast evaluation from control points
  bernstein_algebra  products, derivatives, roots
  chebyshev          coefficients of Chebyshev polynomials
  control_points     exact and approximate Bezier control points
  conversion         exact ones of any stretch, degree elevation
  pieces             any curve as Bezier pieces of low degree
  flatten            polylines within a tolerance, of Bezier pieces and of
                     samples (flatten_samples); polylines: their geometry
  arcs               Bezier arcs that searches halve

calculus             curves differentiated, integrated, solved, and brought to SciPy:
                     methods of every curve
  derivative         `Derivative`, a curve; `Antiderivative`, likewise
  integrals          between two parameters
  solutions          where a coordinate has a value
  scipy_objects      `BPoly` and `PPoly`

drag                 updates while points or parameters move:
  frozen_samples     polylines while points move and parameters stay
  frozen_segments    the same for curves of Bezier pieces, whatever moves
  moved_parameters   Lagrange functions after a few parameters moved
  left_out           Lagrange curves after a few points moved

analysis.geometry    curvature, box, inflections, extrema of curvature
  lengths            lengths within a bound, and the way back
  quadrature         its arithmetic, for the arcs of many curves at once
  nearest_point      the nearest point of a curve, of all or within a reach
  intersections      where a curve crosses itself; arc_pairs: where it may
  continuity         jumps at the joints, and the class that follows
  stability          Lebesgue function and constant
  cardinal           effects of points from which derivatives are estimated:
                     `CardinalBasis`
  condition          condition numbers of monomial systems
  sensitivity        derivatives by the data, worst cases
  ensembles          curves with random errors

rounding.evaluation  curves computed with k decimal digits, and the truth
  decimal_methods    its methods, operation by operation
  operations         what they cost
  rounded_data       data rounded to so many decimals or digits
  exact              polynomials through data, in integers

scaling, vectors     numbers with separate exponents; lengths, cross products
double_double        numbers of 106 bits, where plain ones would cancel
working_memory       arrays that are kept from call to call
tridiagonal          systems of splines
===================  =======================================================

Arguments are copied and checked; attributes are read-only; there is no global
state but working memory. Indices count from 0. A module is imported when one of its names is
first used (SPEC 1): the list of names is ``__init__.pyi``.
"""

from curvecore.late_names import late_names

__version__ = "0.1.0"
__getattr__, __dir__, __all__ = late_names(__name__, __file__)
