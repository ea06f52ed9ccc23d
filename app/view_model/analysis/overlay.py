"""The record of an overlay, something that can be drawn over the curve, and all that it is made of.

`Overlay.draw` gets an `OverlayInput`, the curve with the values of the settings, and returns `Figures`: each
has a style, a shape and points of the plane; the note of the figures is for the Analysis dock. The recipe for
a new overlay stands in ``overlays``.
"""

from __future__ import annotations

import enum
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.words import with_minus
from ...tasks.progress import Report, silent
from ..geometry import Samples, one_sided, size_of
from ..line_styles import LineStyle
from ..registry import Registry
from ..settings import OwnedSetting, SettingValues, Value_co

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView

# Figures


class Shape(enum.Enum):
    """The ways in which the points of a figure belong together."""

    LINE = enum.auto()
    """A polyline; a row of NaN ends one and begins the next."""
    SEGMENTS = enum.auto()
    """Point 2k and point 2k + 1 are the ends of a segment."""
    ARROWS = enum.auto()
    """As segments, with a head at the second end."""
    TICKS = enum.auto()
    """At point 2k, a short stroke of fixed length in the direction of point 2k + 1."""
    AREA = enum.auto()
    """Polygons that turn to the left, each ended by a row of NaN; all together are one area."""
    MARKS = enum.auto()
    """Separate marks, one at each point; the style's `mark` is their shape, such as a ring."""


class Figure(msgspec.Struct, frozen=True, eq=False):
    """Points (k, 2) of the plane, how they belong together and how they look.

    Attributes
    ----------
    style
        The look of lines and marks. The legend finds the figures of an entry by it: the same object.
    label
        A word beside the last point; empty for none.
    """

    style: LineStyle
    shape: Shape
    points: FloatArray
    label: str = ""


class Figures(msgspec.Struct, frozen=True, eq=False):
    """Figures, the first one at the bottom, and a note for the Analysis dock: a result, or a reason."""

    figures: Sequence[Figure] = ()
    note: str = ""


Entry = tuple[LineStyle, str]
"""An entry of the legend: a style of figures, and its explanation."""


def number(value: float) -> str:
    """Return a number as a label has it: three digits, a real minus."""
    mantissa, _, exponent = f"{value:.3g}".partition("e")
    return with_minus(f"{mantissa}·10^{int(exponent)}" if exponent else mantissa)


# Settings


class ErrorSize(OwnedSetting[float], frozen=True, kw_only=True):
    """The largest error of something, typed.

    Attributes
    ----------
    short
        The words before the field.
    usual
        The value when it is first needed, from the curve that is then displayed; None for the default.
    """

    default: float = 0.0
    short: str
    usual: Callable[[CurveView], float] | None = None


def usual_error(view: CurveView) -> float:
    """Return a round number near one hundredth of the size of the points."""
    size = size_of(view.points) if len(view.points) else 0.0
    return float(f"{size / 100:.0e}") if size > 0 else 0.01


POINT_ERROR = ErrorSize(
    "pointError",
    "Error of the points",
    short="ε points",
    tip="Largest error of every point; velocities and accelerations are kept (a number or an expression)",
    usual=usual_error,
)
"""In the plane's unit."""

PARAMETER_ERROR = ErrorSize(
    "parameterError",
    "Error of the parameters",
    short="δ in t",
    tip="Largest error of every t; the band shows its first-order effect (a number or an expression)",
)


def errors_text(settings: SettingValues) -> str:
    """Return the sizes of the errors for the legend: ε = 0.01, δ = 0.001."""
    delta = settings.value(PARAMETER_ERROR)
    text = f"ε = {number(settings.value(POINT_ERROR))}"
    return f"{text}, δ = {number(delta)}" if delta else text


# The input

_QUICK = 64
"""Points of the longest polynomial whose derivatives are found within a frame."""

_MOST = 600
"""Samples of a whole curve; more are not told apart on a screen."""

_LEAST_A_SEGMENT = 6

_FEW, _LONG = 3, 200
"""Samples a segment of a polynomial through more than `_LONG` points, whose derivatives cost most."""


class OverlayInput(msgspec.Struct, frozen=True, eq=False, dict=True):
    """The curve that an overlay is drawn of, the values of its settings, and samples that overlays share.

    Only current views are drawn: those whose `is_current` says that the curve is the one of the points.

    Attributes
    ----------
    view
        The curve: `view.curve` evaluates it, `view.points` (n, 2) are its points. There are as many
        `view.parameters` as points; a closed curve has one more, at which it is back at the first point
        (`view.at_knots` has a position for each).
    settings
        The values of the settings of all overlays; `value` asks for one.
    scrub
        The scrub line's t; None without one.
    report
        Called now and then by long computations; raises when the result is no longer wanted.
    """

    view: CurveView
    settings: SettingValues
    scrub: float | None = None
    report: Report = silent

    def value(self, setting: OwnedSetting[Value_co]) -> Value_co:
        """Return the value of a setting."""
        return self.settings.value(setting)

    @cached_property
    def samples(self) -> list[Samples]:
        """Samples of every piece; computed once for all overlays."""
        return _samples_of(self.view)

    @cached_property
    def size(self) -> float:
        """The larger side of the box around the points."""
        return size_of(self.view.points)

    def at_scrub(self, order: int) -> FloatArray | None:
        """Return a derivative at the scrub line, None without a line or where it is not finite."""
        curve = self.view.curve
        if self.scrub is None or curve is None:
            return None
        value: FloatArray = curve.evaluate(min(max(self.scrub, curve.domain[0]), curve.domain[1]), order)
        return value if np.isfinite(value).all() else None


def is_quick(view: CurveView) -> bool:
    """Whether derivatives along the whole curve can be computed in every frame of a drag."""
    return view.curve is None or view.curve.is_local or len(view.parameters) <= _QUICK


def _samples_of(view: CurveView) -> list[Samples]:
    """Return samples of every piece, the joints among them, one-sided at both ends of each segment.

    A joint of a Hermite curve has two samples: its second derivative differs between the sides.
    """
    if view.curve is None or not view.is_current:
        return []
    segments = len(view.parameters) - 1
    least = _FEW if not view.source.family.curve_class.is_local and segments > _LONG else _LEAST_A_SEGMENT
    count = max(least, min(_MOST // segments, 60))
    samples = []
    for piece in view.pieces:
        t = one_sided(piece.parameters, np.full(len(piece.parameters) - 1, count)).t
        samples.append(Samples(t, *piece.derivatives_at(t, (0, 1, 2))))
    return samples


# The record


class Group(enum.IntEnum):
    """The subjects of overlays; overlays of a group stand together."""

    SHAPE = 0
    POLYGONS = 1
    ERRORS = 2


class Overlay(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Something that can be drawn over the curve; compares by identity.

    The record is all there is to add: menu, key, dock, legend, pictures and tests read it. The docstring of
    ``overlays`` has an example.

    Attributes
    ----------
    name
        A word in lower case, from which its object names are made.
    text, tip, key, icon, full_name
        Those of its action.
    group, rank
        Where it is sorted in the menu and the dock.
    layer
        Overlays with larger numbers are drawn over the others; None for the rank.
    draw
        Computes the figures, in every frame of a drag: in some 2 ms, or it has to settle.
    settles
        Whether it is too heavy for a frame, of some curve: drawn once nothing has changed for a moment,
        beside the window.
    settings
        Numbers and switches that it is drawn with; the dock has their sliders, fields and check boxes.
    follows_scrub
        Whether it shows the t of the scrub line.
    brings_scrub
        Whether a scrub line appears with it.
    legend
        Its entries in the legend, for a curve and the settings.
    finds
        Entries for the figures that it may find: in the legend where they are drawn.
    """

    name: str
    text: str
    tip: str
    group: Group
    rank: int
    draw: Callable[[OverlayInput], Figures]
    layer: int | None = None
    settles: Callable[[CurveView], bool] = lambda _view: False
    key: str = ""
    icon: str = ""
    full_name: str = ""
    settings: tuple[OwnedSetting[float], ...] = ()
    follows_scrub: bool = False
    brings_scrub: bool = False
    legend: Callable[[CurveView, SettingValues], Sequence[Entry]] = lambda _view, _settings: ()
    finds: Sequence[Entry] = ()

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        return self.group, self.rank

    @property
    def action_name(self) -> str:
        """The object name of its action: overlayComb."""
        return f"overlay{self.name.capitalize()}"


OVERLAYS = Registry(Overlay, f"{__package__}.overlays")
"""All overlays, in the order of the menu."""
