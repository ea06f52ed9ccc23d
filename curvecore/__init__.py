"""curvecore: parametric polynomial curves through points, with NumPy alone.

A tour of the package, one concept a file:

==================  ======================================================
errors              `CurveError`, the only exception for unusable input
arrays              validation of every argument, shared array types
parametrization     rules for the t_i: `uniform`, `chebyshev`,
                    `chord_length`, `centripetal`, `power`
families            one file each: `Curve`, the base class; `LagrangeCurve`,
                    `HermiteCurve`, `QuinticHermiteCurve`; `BasisCurve` of any
                    basis functions; `Chain`, curves end to end: corners
vectors             lengths of vectors
scaling             numbers with separate exponents
double_double       numbers of 106 bits, where plain ones would cancel
bernstein           their control points, and fast evaluation from these
tangents            velocities and accelerations estimated from points
bezier              exact and approximate Bezier control points
flatten             polylines within a tolerance
frozen              the same while points move and parameters stay
frozen_segments     the same for curves of Bezier pieces, whatever moves
moved_parameters    Lagrange functions after a few parameters moved
left_out            the curve then: some points left out and put back
bernstein_algebra   polynomials in Bernstein form: products, roots
pieces              any curve as Bezier pieces of low degree
geometry            curvature, box, inflections, extrema of curvature
lengths             lengths within a bound, and the way back
quadrature          its arithmetic, for the arcs of many curves at once
nearest_point       the nearest point of a curve, of all or within a reach
arc_pairs           arcs of a curve that may meet
intersections       where a curve crosses itself
continuity          jumps at the joints, and the class that follows
exact               polynomials through data, in integers
bezier_conversion   exact control points of any stretch, degree elevation
stability           Lebesgue function and constant
cardinal            what points do where derivatives are estimated from
                    them: `CardinalBasis`
condition           condition numbers of monomial systems
sensitivity         derivatives by the data, worst cases
ensembles           curves with random errors
rounding            curves computed with k decimal digits, and the truth
rounded_data        data rounded to so many decimals or digits
decimal_methods     its methods, operation by operation
operations          what they cost
==================  ======================================================

Every family is linear in its data: c(t) = sum over i, r of B_ir(t) d_ir, where
`jets` holds d with shape (n, R, dim) - point, velocity, acceleration, per unit
of t - and ``basis(t)`` is B with shape (m, n, R).

Arguments are copied and checked; attributes are read-only; there is no global
state. Indices count from 0.


What draws a curve is imported with the package; the analysis (lengths, geometry, continuity, stability,
rounding and the like) when one of its names is first asked for.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from curvecore.bezier import CubicPath, bezier_segments, cubic_path
from curvecore.errors import CurveError
from curvecore.families.basis_curve import BasisCurve, Scheme
from curvecore.families.chain import Chain
from curvecore.families.curve import Curve, Interpolant, LocalBasis
from curvecore.families.hermite import HermiteCurve
from curvecore.families.lagrange import LagrangeCurve
from curvecore.families.quintic_hermite import QuinticHermiteCurve
from curvecore.flatten import (
    MAX_VERTICES,
    Pieces,
    ToleranceWarning,
    flatten,
    flatten_parameters,
    flatten_pieces,
)
from curvecore.frozen import FrozenFlattening
from curvecore.frozen_segments import FrozenSegments
from curvecore.parametrization import centripetal, chebyshev, chord_length, power, uniform
from curvecore.tangents import (
    bessel_velocities,
    catmull_rom_velocities,
    finite_difference_velocities,
    natural_spline_accelerations,
    natural_spline_velocities,
    zero_accelerations,
)

if TYPE_CHECKING:
    from curvecore.bezier_conversion import LagrangeBezier, bezier_stretch, elevate_degree, lagrange_to_bezier
    from curvecore.cardinal import CardinalBasis, cardinal_basis, estimation_matrix, follow_rules
    from curvecore.condition import monomial_condition, segment_conditions, vandermonde_condition
    from curvecore.continuity import Joint, joint_report
    from curvecore.ensembles import Ensemble, ensemble
    from curvecore.geometry import (
        Box,
        CurvatureExtrema,
        bounding_box,
        curvature,
        curvature_extrema,
        curvature_of,
        inflections,
        speed,
    )
    from curvecore.intersections import SelfIntersections, self_intersections
    from curvecore.lengths import (
        ArcLength,
        Length,
        arc_length,
        equal_arc_length_parameters,
        parameter_at_length,
    )
    from curvecore.nearest_point import Nearest, NearestWithin, nearest
    from curvecore.operations import OperationCounts, operation_counts
    from curvecore.rounded_data import round_data, round_significant
    from curvecore.rounding import (
        Method,
        Rounding,
        available_methods,
        digits_lost,
        evaluate_rounded,
        exact_values,
        rounded_decimals,
    )
    from curvecore.sensitivity import (
        Band,
        acceleration_sensitivity,
        parameter_sensitivity,
        point_sensitivity,
        velocity_sensitivity,
        worst_case_band,
    )
    from curvecore.stability import derivative_sums, lebesgue_constant, lebesgue_function

_ANALYSIS = {
    "cardinal": ["CardinalBasis", "cardinal_basis", "estimation_matrix", "follow_rules"],
    "lengths": ["ArcLength", "Length", "arc_length", "equal_arc_length_parameters", "parameter_at_length"],
    "bezier_conversion": ["LagrangeBezier", "bezier_stretch", "elevate_degree", "lagrange_to_bezier"],
    "condition": ["monomial_condition", "segment_conditions", "vandermonde_condition"],
    "continuity": ["Joint", "joint_report"],
    "ensembles": ["Ensemble", "ensemble"],
    "geometry": [
        "Box",
        "CurvatureExtrema",
        "bounding_box",
        "curvature",
        "curvature_extrema",
        "curvature_of",
        "inflections",
        "speed",
    ],
    "intersections": ["SelfIntersections", "self_intersections"],
    "nearest_point": ["Nearest", "NearestWithin", "nearest"],
    "operations": ["OperationCounts", "operation_counts"],
    "rounded_data": ["round_data", "round_significant"],
    "rounding": [
        "Method",
        "Rounding",
        "available_methods",
        "digits_lost",
        "evaluate_rounded",
        "exact_values",
        "rounded_decimals",
    ],
    "sensitivity": [
        "Band",
        "acceleration_sensitivity",
        "parameter_sensitivity",
        "point_sensitivity",
        "velocity_sensitivity",
        "worst_case_band",
    ],
    "stability": ["derivative_sums", "lebesgue_constant", "lebesgue_function"],
}
_MODULE_OF = {name: module for module, names in _ANALYSIS.items() for name in names}

__all__ = [
    "MAX_VERTICES",
    "ArcLength",
    "Band",
    "BasisCurve",
    "Box",
    "CardinalBasis",
    "Chain",
    "CubicPath",
    "CurvatureExtrema",
    "Curve",
    "CurveError",
    "Ensemble",
    "FrozenFlattening",
    "FrozenSegments",
    "HermiteCurve",
    "Interpolant",
    "Joint",
    "LagrangeBezier",
    "LagrangeCurve",
    "Length",
    "LocalBasis",
    "Method",
    "Nearest",
    "NearestWithin",
    "OperationCounts",
    "Pieces",
    "QuinticHermiteCurve",
    "Rounding",
    "Scheme",
    "SelfIntersections",
    "ToleranceWarning",
    "acceleration_sensitivity",
    "arc_length",
    "available_methods",
    "bessel_velocities",
    "bezier_segments",
    "bezier_stretch",
    "bounding_box",
    "cardinal_basis",
    "catmull_rom_velocities",
    "centripetal",
    "chebyshev",
    "chord_length",
    "cubic_path",
    "curvature",
    "curvature_extrema",
    "curvature_of",
    "derivative_sums",
    "digits_lost",
    "elevate_degree",
    "ensemble",
    "equal_arc_length_parameters",
    "estimation_matrix",
    "evaluate_rounded",
    "exact_values",
    "finite_difference_velocities",
    "flatten",
    "flatten_parameters",
    "flatten_pieces",
    "follow_rules",
    "inflections",
    "joint_report",
    "lagrange_to_bezier",
    "lebesgue_constant",
    "lebesgue_function",
    "monomial_condition",
    "natural_spline_accelerations",
    "natural_spline_velocities",
    "nearest",
    "operation_counts",
    "parameter_at_length",
    "parameter_sensitivity",
    "point_sensitivity",
    "power",
    "round_data",
    "round_significant",
    "rounded_decimals",
    "segment_conditions",
    "self_intersections",
    "speed",
    "uniform",
    "vandermonde_condition",
    "velocity_sensitivity",
    "worst_case_band",
    "zero_accelerations",
]


def __getattr__(name: str) -> object:
    """Import the analysis when it is first asked for."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: object = getattr(import_module(f"{__name__}.{_MODULE_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Name what is imported later, too."""
    return sorted({*globals(), *__all__})
