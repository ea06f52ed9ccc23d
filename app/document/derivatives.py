"""Derivatives of points, and the rules that estimate them where they are not explicit.

A rule is given what is set beside the points: a spline as conditions, a local rule for its ends.

To add a rule: a function of ``curvecore`` that computes the estimates (its name stands in the late names of
``curvecore/__init__.pyi``), and a member of `VelocityRule`, `AccelerationRule` or `JerkRule` below; menus,
the palette, boxes, files and views read the member. A rule that is not linear in the points names with
`changes` a second function, for its Jacobian times moves of the points, and says in `linearised` which
effects of points that gives. Where the rule has kinks, or treats each coordinate by itself, that function
takes ``one_sided``, and `growth_holds` says for which points the growth of errors holds.
``curvecore/limited_tangents.py`` has two. A rule for the parameters is a member of `ParametrizationKind`
(``model``) in the same way.
"""

from __future__ import annotations

import msgspec

from .words import NamedEnum

_SMALL_MOVES, _AT_THESE_POINTS = "of small moves, averaged over x and y", "at these points"


class EstimateRule(NamedEnum):
    """Rule that estimates derivatives.

    Attributes
    ----------
    estimate
        Remark on an estimated derivative.
    function
        Name of the function in ``curvecore`` that computes the estimates.
    tip
        One-line explanation of the rule.
    takes
        Arguments of the function: ``points``, ``parameters``, ``alpha``, and by the plurals of the
        derivatives what is set: ``velocities`` is NaN in the rows that are estimated.
    changes
        Name of the function in ``curvecore`` for the change of estimates when points move, with an additional
        argument ``moves``, (n, k). Empty for a rule that is linear in the points: its estimates change as the
        points do.
    linearised
        Explanation of the effects of points, to follow "those".
    growth_holds
        Points for which the growth of errors holds, if it depends on them: the rule has kinks and treats each
        coordinate by itself, and `changes` takes ``one_sided``. Else empty.
    """

    def __init__(
        self,
        value: str,
        label: str = "",
        estimate: str = "",
        function: str = "",
        tip: str = "",
        takes: tuple[str, ...] = ("points", "parameters"),
        changes: str = "",
        linearised: str = "",
        growth_holds: str = "",
    ) -> None:
        super().__init__(value, label)
        self.estimate, self.function, self.tip, self.takes = estimate, function, tip, takes
        self.changes, self.linearised, self.growth_holds = changes, linearised, growth_holds

    @property
    def is_spline(self) -> bool:
        """Whether one spline estimates all points: corners are breaks, set derivatives are conditions."""
        return bool(self.value == "natural_spline")

    @property
    def is_linear(self) -> bool:
        """Whether estimates are linear in the points, at given parameters."""
        return not self.changes


class VelocityRule(EstimateRule):
    """Rule that estimates velocities that are not explicit."""

    NATURAL_SPLINE = (
        "natural_spline", "Natural C² spline", "estimated by the natural spline rule",
        "natural_spline_velocities",
        "Velocities with continuous acceleration wherever none is set, and zero acceleration at free ends",
        ("points", "parameters", "velocities"),
    )  # fmt: skip
    BESSEL = (
        "bessel", "Bessel (parabola)", "estimated by the Bessel (parabola) rule", "bessel_velocities",
        "The velocity of the parabola through a point and its two neighbours",
        ("points", "parameters", "velocities"),
    )  # fmt: skip
    FINITE_DIFFERENCE = (
        "finite_difference", "Finite difference", "estimated by the finite difference rule",
        "finite_difference_velocities",
        "The mean of the slopes of both chords at a point",
    )  # fmt: skip
    CATMULL_ROM = (
        "catmull_rom", "Catmull–Rom", "estimated by the Catmull–Rom rule",
        "catmull_rom_velocities",
        "The velocity of a Catmull–Rom spline with knots spaced by distances to the power of α",
        ("points", "parameters", "alpha", "velocities"), "catmull_rom_changes", "for fixed knots",
    )  # fmt: skip
    MONOTONE = (
        "monotone", "Monotone (PCHIP)", "estimated by the monotone rule of Fritsch and Carlson",
        "monotone_velocities",
        "Velocities that keep x and y monotone between monotone points, without overshoot",
        ("points", "parameters"), "monotone_changes", _SMALL_MOVES, _AT_THESE_POINTS,
    )  # fmt: skip
    AKIMA = (
        "akima", "Akima", "estimated by Akima's rule", "akima_velocities",
        "The mean of both slopes, weighted towards the straighter side: outliers have little effect",
        ("points", "parameters"), "akima_changes", _SMALL_MOVES, _AT_THESE_POINTS,
    )  # fmt: skip


class AccelerationRule(EstimateRule):
    """Rule that estimates accelerations that are not explicit."""

    NATURAL_SPLINE = (
        "natural_spline", "From the C² spline", "estimated by the natural spline rule",
        "natural_spline_accelerations",
        "The accelerations of the C² spline, where a velocity is set averaged over both sides",
        ("points", "parameters", "velocities"),
    )  # fmt: skip
    ZERO = (
        "zero", "Zero", "estimated as zero", "zero_accelerations", "Zero acceleration", ("points",)
    )  # fmt: skip


class JerkRule(EstimateRule):
    """Rule that estimates jerks that are not explicit."""

    NATURAL_SPLINE = (
        "natural_spline", "From the C² spline", "estimated by the natural spline rule",
        "natural_spline_jerks", "The jerks of the C² spline, averaged over both sides of a point",
        ("points", "parameters", "velocities", "accelerations"),
    )  # fmt: skip
    ZERO = "zero", "Zero", "estimated as zero", "zero_accelerations", "Zero jerk", ("points",)


class Derivative(msgspec.Struct, frozen=True):
    """Derivative that a point may carry; `DERIVATIVES` lists all of them.

    Attributes
    ----------
    order
        Order of the derivative, from 1.
    name
        Name of the derivative, and of the field of a point.
    plural
        Argument of the curve classes in ``curvecore``.
    letter
        Its symbol.
    unit
        Its unit, "per unit of t".
    rules
        The rules that estimate it.
    """

    order: int
    name: str
    plural: str
    letter: str
    unit: str
    rules: type[EstimateRule]

    @property
    def after(self) -> str:
        """The field of a point for the derivative after a corner."""
        return f"{self.name}_after"

    @property
    def rule_field(self) -> str:
        """The field of a curve for the rule."""
        return f"{self.name}_rule"


DERIVATIVES = (
    Derivative(1, "velocity", "velocities", "v", "per unit of t", VelocityRule),
    Derivative(2, "acceleration", "accelerations", "a", "per unit of t squared", AccelerationRule),
    Derivative(3, "jerk", "jerks", "j", "per unit of t cubed", JerkRule),
)
"""The derivatives of a point, by their orders: `Point` has their fields, `Curve` their rules."""

VECTORS = (*((row.order, row.name) for row in DERIVATIVES), *((row.order, row.after) for row in DERIVATIVES))
"""Orders and names of the fields of a point for derivatives: before a corner, then after it."""
