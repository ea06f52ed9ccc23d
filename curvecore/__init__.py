"""curvecore: parametric polynomial curves through points, with NumPy alone.

A tour of the package, one concept a file:

==================  ======================================================
errors              `CurveError`, the only exception for unusable input
arrays              validation of every argument, shared array types
parametrization     rules for the t_i: `uniform`, `chebyshev`,
                    `chord_length`, `centripetal`, `power`
curve               the protocol `Curve` that all families satisfy
lagrange            `LagrangeCurve`, one polynomial of degree n - 1
product_form        the Lagrange basis as products, accurate on any nodes
product_series      its derivatives, as products of power series
chain               `Chain`, curves end to end: corners
scaling             numbers with separate exponents
double_double       numbers of 106 bits, where plain ones would cancel
hermite             `HermiteCurve` and `QuinticHermiteCurve`, piecewise
hermite_basis       their cardinal polynomials, factored
bernstein           their control points, and fast evaluation from these
tangents            velocities and accelerations estimated from points
bezier              exact and approximate Bezier control points
flatten             polylines within a tolerance
frozen              the same while points move and parameters stay
==================  ======================================================

Every family is linear in its data: c(t) = sum over i, r of B_ir(t) d_ir, where
`jets` holds d with shape (n, R, dim) - point, velocity, acceleration, per unit
of t - and ``basis(t)`` is B with shape (m, n, R).

Arguments are copied and checked; attributes are read-only; there is no global
state. Indices count from 0.
"""

from curvecore.bezier import CubicPath, bezier_segments, cubic_path
from curvecore.chain import Chain
from curvecore.curve import Curve
from curvecore.errors import CurveError
from curvecore.flatten import MAX_VERTICES, flatten, flatten_parameters
from curvecore.frozen import FrozenFlattening
from curvecore.hermite import HermiteCurve, LocalBasis, QuinticHermiteCurve
from curvecore.lagrange import LagrangeCurve
from curvecore.parametrization import centripetal, chebyshev, chord_length, power, uniform
from curvecore.tangents import (
    bessel_velocities,
    catmull_rom_velocities,
    finite_difference_velocities,
    natural_spline_accelerations,
    natural_spline_velocities,
    zero_accelerations,
)

__all__ = [
    "MAX_VERTICES",
    "Chain",
    "CubicPath",
    "Curve",
    "CurveError",
    "FrozenFlattening",
    "HermiteCurve",
    "LagrangeCurve",
    "LocalBasis",
    "QuinticHermiteCurve",
    "bessel_velocities",
    "bezier_segments",
    "catmull_rom_velocities",
    "centripetal",
    "chebyshev",
    "chord_length",
    "cubic_path",
    "finite_difference_velocities",
    "flatten",
    "flatten_parameters",
    "natural_spline_accelerations",
    "natural_spline_velocities",
    "power",
    "uniform",
    "zero_accelerations",
]
