"""Values of a document: points, curves, guides, reference image. Immutable, compared by value, no arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from operator import attrgetter
from typing import Annotated, Final

from msgspec.structs import replace

from ..families import LAGRANGE, NO_SETTINGS, Family, FamilySettingValues
from .derivatives import DERIVATIVES, VECTORS, AccelerationRule, EstimateRule, JerkRule, VelocityRule
from .fields import LENGTH, Requirement, Value, above, at_least, at_most_items, between, printable
from .fields import Vector as Vector  # noqa: PLC0414 - most have it from here
from .style import PLAIN_STYLE, Style
from .words import NamedEnum

Length = Annotated[float, LENGTH]
"""Number that is a length in the plane: it scales with the drawing."""

Lengths = Annotated[Vector | None, LENGTH]
"""Vector of such numbers, or None."""


# Points and curves


class ParametrizationKind(NamedEnum):
    """Rule for the parameters t_i, in the order of the window.

    Each but the manual rule has the name of the function in ``curvecore.parametrization`` that computes it.

    Attributes
    ----------
    takes
        Arguments of that function: ``count`` of the points, ``points``, ``alpha``.
    spaced
        The spacing of the parameters, within a sentence.
    alpha
        The exponent of the equivalent power rule; None for other rules.
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
    CHORD_LENGTH = "chord_length", "Chord length", ("points",), "spaced by the distances between points", 1.0
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
        """The label within a sentence: "chord length"."""
        name, dot, rest = self.label.partition(" (")
        return f"{name if rest else name.lower()}{dot}{rest}"

    @property
    def depends_on_points(self) -> bool:
        """Whether the parameters change when points move."""
        return "points" in self.takes


class Point(Value, frozen=True, gc=False):
    """Point of a curve, with the derivatives and the parameter that the person set.

    What a rule computes is not stored: ``Point(1.0, 2.0)`` has an estimated velocity, and
    ``Point(1.0, 2.0, velocity=(0.5, 0.0))`` an explicit one.

    Attributes
    ----------
    x, y
        Position.
    t
        Parameter under the manual rule; stored, but not used, under other rules.
    velocity, acceleration, jerk
        Explicit derivatives per unit of t; None where a rule estimates them.
    corner
        Whether the point is a corner: the derivatives above are then those before the point.
    velocity_after, acceleration_after, jerk_after
        The derivatives after a corner; None where a rule estimates them.
    tied
        Whether the explicit velocities before and after a corner stay parallel: the curve is smooth there,
        and its handles may have different lengths.
    even
        Whether tied velocities keep the ratio of their speeds, so that their handles stay equally long.
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
        """Return the explicit derivatives of an order before and after the point."""
        derivative = DERIVATIVES[order - 1]
        before: Vector | None = getattr(self, derivative.name)
        return before, getattr(self, derivative.after) if self.corner else before

    def as_corner(self) -> Point:
        """Return the point as a corner; one that was none has the same derivatives on both sides."""
        after = {row.after: self.explicit_sides(row.order)[1] for row in DERIVATIVES}
        return replace(self, corner=True, **after)

    def without_corner(self) -> Point:
        """Return the point with the derivatives before it on both sides."""
        return replace(self, corner=False, tied=False, even=False, **{row.after: None for row in DERIVATIVES})

    def with_derivatives(self, before: Sequence[Vector | None], after: Sequence[Vector | None]) -> Point:
        """Return the point with derivatives before and, at a corner, after it, in order from the first."""
        changed = {row.name: vector for row, vector in zip(DERIVATIVES, before, strict=False)}
        if self.corner:
            changed |= {row.after: vector for row, vector in zip(DERIVATIVES, after, strict=False)}
        return replace(self, **changed)


class Parametrization(Value, frozen=True, omit_defaults=False):
    """Rule for the parameters, and the interval that they span.

    Attributes
    ----------
    kind
        The rule.
    alpha
        Exponent of the power rule, Δt = |Δp|^alpha.
    start, end
        The interval that parameters of a rule span; manual parameters have their own.
    """

    kind: ParametrizationKind = ParametrizationKind.CHORD_LENGTH
    alpha: Annotated[float, between(0, 1)] = 0.5
    start: float = 0.0
    end: float = 1.0

    @property
    def exponent(self) -> float | None:
        """The power of the distances that the spacings are proportional to; None for other rules."""
        return self.alpha if self.kind is ParametrizationKind.POWER else self.kind.alpha


derivatives_of: Callable[[Point], tuple[Vector | None, ...]] = attrgetter(*(name for _, name in VECTORS))
"""Function that returns the derivatives of a point in the order of `VECTORS`."""


class Curve(Value, frozen=True, dict=True):
    """Curve of the document: points in order, and the rules that interpolate them.

    Only what the person chose is stored here; parameters and derivatives that the rules give are computed by
    the view model. For example, ``replace(curve, closed=True)`` is the closed curve.

    Attributes
    ----------
    name
        Its name in the list of curves.
    family, parametrization, velocity_rule, acceleration_rule, jerk_rule
        The rules.
    points
        The points, in order.
    closed
        Whether a last segment leads back to the first point, if the family can be closed.
    style
        Stroke and fill.
    shape
        Name of the shape that it is a part of, or empty: see ``shape_ranges``.
    groups
        Names of the groups around it, the outermost first.
    visible, locked
        Whether it is drawn, and whether it is protected from changes.
    settings
        Settings of the family that are not at their defaults.
    other_settings
        Settings of other families that the curve had before, kept for a return to them.
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
    settings: FamilySettingValues = NO_SETTINGS
    other_settings: tuple[tuple[Family, FamilySettingValues], ...] = ()

    def with_family(self, family: Family) -> Curve:
        """Return this curve with another family, and with its former settings for that family."""
        if family == self.family:
            return self
        present = ((self.family, self.settings),) if self.settings else ()
        others = tuple(entry for entry in self.other_settings if entry[0] != family)
        settings = family.settings.without_defaults(dict(self.other_settings).get(family, NO_SETTINGS))
        return replace(self, family=family, settings=settings, other_settings=(*others, *present))

    @property
    def settings_in_effect(self) -> FamilySettingValues:
        """The settings, with the values that closing the curve implies."""
        return self.family.settings.in_effect(self.settings, closed=self.is_closed)

    @property
    def functions_key(self) -> tuple[Family, FamilySettingValues]:
        """The family and its settings, which with the parameters determine the basis functions."""
        return self.family, self.settings_in_effect

    @property
    def is_closed(self) -> bool:
        """Whether the curve returns to its first point: closed, and of a family that can be closed."""
        return self.closed and self.family.curve_class.can_close and len(self.points) > 1

    @cached_property
    def has_derivatives(self) -> bool:
        """Whether any point has an explicit derivative; cached for the moves of a drag."""
        # A vector is a tuple of two numbers, and therefore true.
        return any(map(any, map(derivatives_of, self.points)))

    @property
    def rules(self) -> tuple[EstimateRule, ...]:
        """The rules for the derivatives that the family has, from the first order."""
        return tuple(getattr(self, row.rule_field) for row in DERIVATIVES[: self.family.derivatives])

    def with_rules_of(self, other: Curve) -> Curve:
        """Return this curve with the derivative rules of another."""
        return replace(self, **{row.rule_field: getattr(other, row.rule_field) for row in DERIVATIVES})

    @property
    def display_name(self) -> str:
        """The name in messages: that of its shape, or its own if it belongs to none."""
        return self.shape or self.name

    @property
    def is_selectable(self) -> bool:
        """Whether the curve is visible and unlocked."""
        return self.visible and not self.locked

    @property
    def is_manual(self) -> bool:
        """Whether the parameters are manual, not given by a rule."""
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
    # Opening a network path contacts that computer, on some systems with the password of the person.
    lambda path: not path.startswith(("//", "\\\\")),
    "be the path of a file on this computer, not on the network",
)


class ReferenceImage(Value, frozen=True, omit_defaults=False):
    """Reference image behind the curves, for tracing.

    Attributes
    ----------
    path
        Path of the image file: absolute in an open document; relative to the folder of the document, with
        forward slashes, in a file.
    x, y
        Position of its lower left corner.
    width, height
        Size in the plane; the image is fitted into it.
    opacity
        From 0, invisible, to 1.
    locked
        Whether it is protected from being moved.
    """

    path: Annotated[str, _PATH, _OF_THIS_COMPUTER]
    x: Length
    y: Length
    width: Annotated[Length, above(0)]
    height: Annotated[Length, above(0)]
    opacity: Annotated[float, between(0, 1)] = 0.5
    locked: bool = False


class Axis(NamedEnum):
    """Coordinate axis of the plane."""

    X = "x", "x"
    Y = "y", "y"

    @property
    def coordinate(self) -> int:
        """The index of the coordinate: 0 or 1."""
        return int(self is Axis.Y)


class Guide(Value, frozen=True):
    """Guide: a vertical or horizontal line across the plane that points snap to.

    Attributes
    ----------
    axis
        The coordinate that all of its points have in common: x of a vertical line, y of a horizontal one.
    position
        That coordinate.
    """

    axis: Axis
    position: Length

    def nearest_position(self, position: Vector) -> Vector:
        """Return the point of the guide that is nearest to a position."""
        x, y = position
        return (self.position, y) if self.axis is Axis.X else (x, self.position)


# The document

LONGEST_UNIT = 12
"""Largest number of characters of a unit."""

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
    """Last export of a document: format, file name and options.

    Attributes
    ----------
    ending
        Ending of the files of the format, such as ".png"; empty if the document was never exported.
    name
        Name of the file, without its folder.
    options
        Names, and values as JSON, of the options that are not at their defaults.
    """

    ending: Annotated[str, printable(LONGEST_NAME, "be the end of a name")] = ""
    name: Annotated[str, _NAME] = ""
    options: Annotated[tuple[tuple[str, str], ...], _OPTIONS, _OPTION] = ()


NEVER_EXPORTED: Final = Export()


class Paper(NamedEnum):
    """Paper of a document: on another one, its ink would have another colour."""

    THEME = "", "Of the theme"
    LIGHT = "light", "Light"
    DARK = "dark", "Dark"


class Document(Value, frozen=True):
    """Document: everything that is saved, as one immutable value.

    Edits return new documents, ``move_points(document, 0, [2], (0.5, 0.0))``; unchanged curves and points
    stay the same objects, so that a comparison by identity finds the differences.

    Attributes
    ----------
    curves
        The curves from the back to the front, at least one.
    image
        The reference image, or None.
    unit
        Name of the unit of length, such as "mm"; empty for none.
    grid_spacing
        Distance of the grid lines; 0 if it adapts to the zoom.
    guides
        The guides.
    export
        The last export.
    paper
        The paper of the canvas and of exported pictures.
    """

    curves: tuple[Curve, ...]
    image: ReferenceImage | None = None
    unit: Annotated[str, printable(LONGEST_UNIT, f"be a name of at most {LONGEST_UNIT} characters")] = ""
    grid_spacing: Annotated[Length, at_least(0)] = 0.0
    guides: tuple[Guide, ...] = ()
    export: Export = NEVER_EXPORTED
    paper: Paper = Paper.THEME

    def with_curve(self, index: int, curve: Curve) -> Document:
        """Return this document with curve `index` replaced."""
        return replace(self, curves=(*self.curves[:index], curve, *self.curves[index + 1 :]))


def empty_document() -> Document:
    """Return the document of File > New: one curve without points."""
    return Document((make_curve(()),))


def make_curve(points: Sequence[Vector], *, name: str = "Curve 1", family: Family = LAGRANGE) -> Curve:
    """Return a curve through `points` under the default rules."""
    return Curve(name, family, Parametrization(), tuple(Point(float(x), float(y)) for x, y in points))
