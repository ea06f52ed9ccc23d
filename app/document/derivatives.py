"""Derivatives of points, and the rules that estimate them where nobody has set them.

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

_SMALL_MOVES, _AT_THESE_POINTS = "of small moves, the mean of x and y", "at these points"


class EstimateRule(NamedEnum):
    """A rule that estimates derivatives.

    Attributes
    ----------
    estimate
        What is said of an estimate.
    function
        The function of ``curvecore`` that computes the estimates.
    tip
        What it gives, in a line.
    takes
        Its arguments: ``points``, ``parameters``, ``alpha``.
    changes
        The function of ``curvecore`` for what moves of the points do to them, where these are not linear in
        the points: it takes ``moves``, (n, k), too. Empty of a linear rule, whose estimates do as the points.
    linearised
        What the effects of points are that it gives, to follow "those".
    growth_holds
        Where the growth of errors holds, if it is another one for other points: the rule has kinks, treats
        each coordinate for itself, and `changes` takes ``one_sided``. Else empty.
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
    def is_linear(self) -> bool:
        """Whether estimates are linear in the points, at given parameters."""
        return not self.changes


class VelocityRule(EstimateRule):
    """The rule that estimates the velocity of a point that has none of its own."""

    NATURAL_SPLINE = (
        "natural_spline", "Natural C² spline", "estimated by the natural spline rule",
        "natural_spline_velocities",
        "Velocities with which accelerations go on at all points and vanish at the ends",
    )  # fmt: skip
    BESSEL = (
        "bessel", "Bessel (parabola)", "estimated by the Bessel (parabola) rule", "bessel_velocities",
        "The velocity of the parabola through a point and its two neighbours",
    )  # fmt: skip
    FINITE_DIFFERENCE = (
        "finite_difference", "Finite difference", "estimated by the finite difference rule",
        "finite_difference_velocities",
        "The mean of the slopes of both chords at a point",
    )  # fmt: skip
    CATMULL_ROM = (
        "catmull_rom", "Catmull–Rom", "estimated by the Catmull–Rom rule",
        "catmull_rom_velocities",
        "The velocity of a spline over knots of its own, spaced by the distances to the power of α",
        ("points", "parameters", "alpha"), "catmull_rom_changes", "of points whose knots stay",
    )  # fmt: skip
    MONOTONE = (
        "monotone", "Monotone (PCHIP)", "estimated by the monotone rule of Fritsch and Carlson",
        "monotone_velocities",
        "Velocities with which x and y rise and fall where the points do, and never overshoot them",
        ("points", "parameters"), "monotone_changes", _SMALL_MOVES, _AT_THESE_POINTS,
    )  # fmt: skip
    AKIMA = (
        "akima", "Akima", "estimated by Akima's rule", "akima_velocities",
        "The mean of both slopes, weighted by how straight the other side is: an outlier bends little",
        ("points", "parameters"), "akima_changes", _SMALL_MOVES, _AT_THESE_POINTS,
    )  # fmt: skip


class AccelerationRule(EstimateRule):
    """The rule that estimates the acceleration of a point that has none of its own."""

    NATURAL_SPLINE = (
        "natural_spline", "From the C² spline", "estimated by the natural spline rule",
        "natural_spline_accelerations", "The accelerations of the natural C² spline through the points",
    )  # fmt: skip
    ZERO = (
        "zero", "Zero", "estimated as zero", "zero_accelerations", "No acceleration at any point", ("points",)
    )  # fmt: skip


class JerkRule(EstimateRule):
    """The rule that estimates the jerk of a point that has none of its own."""

    NATURAL_SPLINE = (
        "natural_spline", "From the C² spline", "estimated by the natural spline rule",
        "natural_spline_jerks", "The jerks of the natural C² spline through the points, a mean of both sides",
    )  # fmt: skip
    ZERO = "zero", "Zero", "estimated as zero", "zero_accelerations", "No jerk at any point", ("points",)


class Derivative(msgspec.Struct, frozen=True):
    """A derivative that a point may carry: what all that lists them reads.

    Attributes
    ----------
    order
        1 for the first by t.
    name
        The field of a point that holds it, and what people call it.
    plural
        The argument of curves of the core that holds it.
    letter
        Its symbol.
    unit
        What it is per.
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
        """The field of a point that holds the one after a corner."""
        return f"{self.name}_after"

    @property
    def rule_field(self) -> str:
        """The field of a curve that holds the rule."""
        return f"{self.name}_rule"


DERIVATIVES = (
    Derivative(1, "velocity", "velocities", "v", "per unit of t", VelocityRule),
    Derivative(2, "acceleration", "accelerations", "a", "per unit of t squared", AccelerationRule),
    Derivative(3, "jerk", "jerks", "j", "per unit of t cubed", JerkRule),
)
"""The derivatives of a point, by their orders: `Point` has their fields, `Curve` their rules."""

VECTORS = (
    *((each.order, each.name) for each in DERIVATIVES),
    *((each.order, each.after) for each in DERIVATIVES),
)
"""Orders and names of the fields of a point that hold derivatives: those before and those after a corner."""
