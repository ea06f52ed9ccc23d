"""Values of a document: points, curves, guides, reference image. Immutable, compared by value, no arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from operator import attrgetter
from typing import Annotated, Final

from msgspec.structs import replace

from ..families import LAGRANGE, NO_SETTINGS, ChosenSettings, Family
from .derivatives import DERIVATIVES, VECTORS, AccelerationRule, EstimateRule, JerkRule, VelocityRule
from .fields import LENGTH, Requirement, Value, above, at_least, at_most_items, between, printable
from .fields import Vector as Vector  # noqa: PLC0414 - most have it from here
from .style import PLAIN_STYLE, Style
from .words import NamedEnum

Length = Annotated[float, LENGTH]
"""Number that is twice as large in a drawing twice as large."""

Lengths = Annotated[Vector | None, LENGTH]
"""Vector of such numbers, or None."""


# Points and curves


class ParametrizationKind(NamedEnum):
    """The rule that gives the parameters t_i, in the order in which the window lists them.

    Each but the manual one is named as the function of ``curvecore.parametrization`` that computes it.

    Attributes
    ----------
    takes
        The arguments of that function: ``count`` of the points, ``points``, ``alpha``.
    spaced
        How the parameters lie, within a sentence.
    alpha
        The exponent of the power rule that it is; None for rules that are none.
    """

    def __init__(
        self,
        value: str,
        label: str = "",
        takes: tuple[str, ...] = (),
        spaced: str = "",
        alpha: float | None = None,
    ) -> None:
        super().__init__(value, label)
        self.takes, self.spaced, self.alpha = takes, spaced, alpha

    UNIFORM = "uniform", "Uniform", ("count",), "evenly spaced", 0.0
    CHORD_LENGTH = "chord_length", "Chord length", ("points",), "spaced as the points are", 1.0
    CENTRIPETAL = (
        "centripetal", "Centripetal", ("points",), "spaced by the square roots of the distances", 0.5
    )  # fmt: skip
    POWER = "power", "Power α", ("points", "alpha"), "spaced by the distances to the power of α"
    CHEBYSHEV = (
        "chebyshev", "Chebyshev (2nd kind)", ("count",), "at the extrema of a Chebyshev polynomial"
    )  # fmt: skip
    CHEBYSHEV_ROOTS = (
        "chebyshev_roots",
        "Chebyshev (1st kind)",
        ("count",),
        "at the roots of a Chebyshev polynomial, stretched to the ends",
    )
    MANUAL = "manual", "Manual"

    @property
    def phrase(self) -> str:
        """The label within a sentence: chord length."""
        name, dot, rest = self.label.partition(" (")
        return f"{name if rest else name.lower()}{dot}{rest}"

    @property
    def depends_on_points(self) -> bool:
        """Whether the parameters change when points move."""
        return "points" in self.takes


class Point(Value, frozen=True, gc=False):
    """A point of a curve with what the person fixed there.

    Attributes
    ----------
    x, y
        Position.
    t
        Parameter under the manual parametrization; remembered, but not used, under any other.
    velocity, acceleration, jerk
        Derivatives per unit of t that the person set; None where a rule estimates them.
    corner
        Whether the curve may have a corner here: the derivatives above are then those before the point.
    velocity_after, acceleration_after, jerk_after
        The derivatives after a corner; None where a rule estimates them.
    tied
        Whether the velocities before and after a corner, both set, go the same way and keep doing so: the
        curve is smooth there, and its handles have lengths of their own.
    even
        Whether tied velocities also keep the ratio of their speeds, which made their handles equally long.
    """

    x: Length
    y: Length
    t: float | None = None
    velocity: Lengths = None
    acceleration: Lengths = None
    corner: bool = False
    velocity_after: Lengths = None
    acceleration_after: Lengths = None
    jerk: Lengths = None
    jerk_after: Lengths = None
    tied: bool = False
    even: bool = False

    @property
    def position(self) -> Vector:
        """The point (x, y)."""
        return (self.x, self.y)

    def explicit_sides(self, order: int) -> tuple[Vector | None, Vector | None]:
        """Return the derivative of an order that the person set before and after the point."""
        each = DERIVATIVES[order - 1]
        first: Vector | None = getattr(self, each.name)
        return first, getattr(self, each.after) if self.corner else first

    def as_corner(self) -> Point:
        """Return the point as a corner with the same derivatives on both sides."""
        return replace(self, corner=True, **{each.after: getattr(self, each.name) for each in DERIVATIVES})

    def without_corner(self) -> Point:
        """Return the point with the derivatives before it on both sides."""
        return replace(
            self, corner=False, tied=False, even=False, **{each.after: None for each in DERIVATIVES}
        )

    def with_derivatives(self, before: Sequence[Vector | None], after: Sequence[Vector | None]) -> Point:
        """Return the point with derivatives before and, at a corner, after it, by their orders from 1 on."""
        changed = {each.name: vector for each, vector in zip(DERIVATIVES, before, strict=False)}
        if self.corner:
            changed |= {each.after: vector for each, vector in zip(DERIVATIVES, after, strict=False)}
        return replace(self, **changed)


class Parametrization(Value, frozen=True, omit_defaults=False):
    """The rule for the parameters and the interval they span.

    Attributes
    ----------
    kind
        The rule.
    alpha
        Exponent of the power rule, Δt = |Δp|^alpha.
    start, end
        The interval that the rule's parameters span; the manual parameters carry their own.
    """

    kind: ParametrizationKind = ParametrizationKind.CHORD_LENGTH
    alpha: Annotated[float, between(0, 1)] = 0.5
    start: float = 0.0
    end: float = 1.0

    @property
    def exponent(self) -> float | None:
        """The power of the distances that the spacings are in proportion to; None where to nothing."""
        return self.alpha if self.kind is ParametrizationKind.POWER else self.kind.alpha


derivatives_of: Callable[[Point], tuple[Vector | None, ...]] = attrgetter(*(name for _, name in VECTORS))
"""Returns the derivatives of a point in the order of `VECTORS`."""


class Curve(Value, frozen=True, dict=True):
    """Points, in order, and the rules that make a curve of them.

    Attributes
    ----------
    name
        What the person calls it.
    family, parametrization, velocity_rule, acceleration_rule, jerk_rule
        The rules.
    points
        The points, in order.
    closed
        Whether a last segment leads back to the first point; where the family cannot, it stays open.
    style
        Stroke and fill.
    shape
        Name of the shape that it is a part of, or empty: see ``shape_ranges``.
    groups
        Names of the groups that it is in, the outermost first.
    visible, locked
        Whether it is drawn, and whether it is safe from changes.
    settings
        Those of the family's settings that are not at their defaults.
    other_settings
        The same of other families, which the curve had before and may have again.
    """

    name: str
    family: Family
    parametrization: Parametrization
    points: tuple[Point, ...]
    velocity_rule: VelocityRule = VelocityRule.NATURAL_SPLINE
    acceleration_rule: AccelerationRule = AccelerationRule.NATURAL_SPLINE
    jerk_rule: JerkRule = JerkRule.NATURAL_SPLINE
    closed: bool = False
    style: Style = PLAIN_STYLE
    shape: str = ""
    groups: tuple[str, ...] = ()
    visible: bool = True
    locked: bool = False
    settings: ChosenSettings = NO_SETTINGS
    other_settings: tuple[tuple[Family, ChosenSettings], ...] = ()

    def with_family(self, family: Family) -> Curve:
        """Return this curve with another family, and the settings that it had when it was of that one."""
        if family == self.family:
            return self
        own = ((self.family, self.settings),) if self.settings else ()
        others = tuple(each for each in self.other_settings if each[0] != family)
        settings = family.settings.without_defaults(dict(self.other_settings).get(family, NO_SETTINGS))
        return replace(self, family=family, settings=settings, other_settings=(*others, *own))

    @property
    def settings_in_effect(self) -> ChosenSettings:
        """The settings, with those that closing decides."""
        return self.family.settings.in_effect(self.settings, closed=self.is_closed)

    @property
    def functions_key(self) -> tuple[Family, ChosenSettings]:
        """The family and its settings, which with the parameters determine the basis functions."""
        return self.family, self.settings_in_effect

    @property
    def is_closed(self) -> bool:
        """Whether the curve returns to its first point: closed, and of a family that can."""
        return self.closed and self.family.curve_class.can_close and len(self.points) > 1

    @cached_property
    def has_derivatives(self) -> bool:
        """Whether the person set any; asked at every move of a drag."""
        # A vector of two numbers is true, whatever they are.
        return any(map(any, map(derivatives_of, self.points)))

    @property
    def rules(self) -> tuple[EstimateRule, ...]:
        """The rules that estimate the derivatives which the family has, by their orders."""
        return tuple(getattr(self, each.rule_field) for each in DERIVATIVES[: self.family.derivatives])

    def with_rules_of(self, other: Curve) -> Curve:
        """Return this curve with the rules that estimate the derivatives of another."""
        return replace(self, **{each.rule_field: getattr(other, each.rule_field) for each in DERIVATIVES})

    @property
    def display_name(self) -> str:
        """The name that people see of it: that of its shape, or its own where it is alone."""
        return self.shape or self.name

    @property
    def is_selectable(self) -> bool:
        """Whether it is seen and not locked."""
        return self.visible and not self.locked

    @property
    def is_manual(self) -> bool:
        """Whether the person, not a rule, gives the parameters."""
        return self.parametrization.kind is ParametrizationKind.MANUAL

    @property
    def interval(self) -> tuple[float, float]:
        """The interval that the parameters span."""
        rule = self.parametrization
        if self.is_manual and len(self.points) > 1:
            first, last = self.points[0].t, self.points[-1].t
            if first is not None and last is not None:
                return (first, rule.end if self.is_closed else last)
        return (rule.start, rule.end)


# Reference image and guides

_PATH = Requirement(lambda path: bool(path.strip()) and path.isprintable(), "be the name of a file")
_OF_THIS_COMPUTER = Requirement(
    # Opening another would knock at that computer, and on some systems with the person's password.
    lambda path: not path.startswith(("//", "\\\\")),
    "lead to a file of this computer, not to one of the network",
)


class ReferenceImage(Value, frozen=True, omit_defaults=False):
    """A picture to trace, behind the curves.

    Attributes
    ----------
    path
        Its file: absolute in a document that is open, with forward slashes and relative to the document's
        own folder in a file.
    x, y
        Where its lower left corner lies.
    width, height
        Its size in the plane; what the file holds is fitted into it.
    opacity
        From 0, invisible, to 1.
    locked
        Whether it is safe from being moved.
    """

    path: Annotated[str, _PATH, _OF_THIS_COMPUTER]
    x: Length
    y: Length
    width: Annotated[Length, above(0)]
    height: Annotated[Length, above(0)]
    opacity: Annotated[float, between(0, 1)] = 0.5
    locked: bool = False


class Axis(NamedEnum):
    """A coordinate of the plane."""

    X = "x", "x"
    Y = "y", "y"

    @property
    def coordinate(self) -> int:
        """Which coordinate it is: 0 or 1."""
        return int(self is Axis.Y)


class Guide(Value, frozen=True):
    """A line to draw along, all across the plane.

    Attributes
    ----------
    axis
        The coordinate that all of its points have in common: x of an upright line, y of a level one.
    position
        That coordinate.
    """

    axis: Axis
    position: Length

    def nearest_position(self, place: Vector) -> Vector:
        """Return its point that is level with a place, or straight above or below it."""
        x, y = place
        return (self.position, y) if self.axis is Axis.X else (x, self.position)


# The document

LONGEST_UNIT = 12
"""Characters of a unit's name."""

LONGEST_NAME: Final = 255
LONGEST_OPTION: Final = 1000
MOST_OPTIONS: Final = 64

_NAME = Requirement(
    lambda name: len(name) <= LONGEST_NAME and name.isprintable() and not {"/", "\\"} & {*name},
    "be the name of a file without its folder",
)
_OPTIONS = at_most_items(MOST_OPTIONS, f"be at most {MOST_OPTIONS}")
_OPTION = Requirement(
    lambda texts: all(len(text) <= LONGEST_OPTION and text.isprintable() for text in texts),
    f"be printable texts of at most {LONGEST_OPTION} characters",
)


class Export(Value, frozen=True):
    """A format, a file and the options of an export.

    Attributes
    ----------
    ending
        Of the files of the format, such as ".png"; empty where the document was never exported.
    name
        Of the file, without its folder.
    options
        Options that are not at their defaults: their names, and their values as JSON.
    """

    ending: Annotated[str, printable(LONGEST_NAME, "be the end of a name")] = ""
    name: Annotated[str, _NAME] = ""
    options: Annotated[tuple[tuple[str, str], ...], _OPTIONS, _OPTION] = ()


NEVER_EXPORTED: Final = Export()


class Document(Value, frozen=True):
    """Everything that is saved.

    Attributes
    ----------
    curves
        At least one, from the back to the front.
    image
        A picture to trace.
    unit
        Name of a length of one, such as "mm"; empty for none.
    grid_spacing
        Distance of the grid's lines; 0 where it adapts to the zoom.
    guides
        Lines to draw along.
    export
        Its last export.
    """

    curves: tuple[Curve, ...]
    image: ReferenceImage | None = None
    unit: Annotated[str, printable(LONGEST_UNIT, f"be a name of at most {LONGEST_UNIT} characters")] = ""
    grid_spacing: Annotated[Length, at_least(0)] = 0.0
    guides: tuple[Guide, ...] = ()
    export: Export = NEVER_EXPORTED

    def with_curve(self, index: int, curve: Curve) -> Document:
        """Return this document with curve `index` replaced."""
        return replace(self, curves=(*self.curves[:index], curve, *self.curves[index + 1 :]))


def empty_document() -> Document:
    """Return what File > New opens: one curve without points."""
    return Document((make_curve(()),))


def make_curve(points: Sequence[Vector], *, name: str = "Curve 1", family: Family = LAGRANGE) -> Curve:
    """Return a curve through `points` under the default rules."""
    return Curve(name, family, Parametrization(), tuple(Point(float(x), float(y)) for x, y in points))
