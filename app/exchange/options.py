"""Options of exports: records that the export form and the command line show, and their values.

An option that one format alone has is defined beside that format; here are those that several have.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

import msgspec
from msgspec.structs import replace

from ..document.lengths import MILLIMETRES, known_unit
from ..document.model import Document
from ..document.words import NamedEnum
from ..tasks.progress import Report, silent
from .drawing.styles import INK, LIGHT, PictureStyle

Value = TypeVar("Value")


@dataclass(frozen=True, kw_only=True, eq=False)
class Option(Generic[Value]):
    """An option of a format: a row of the export form, and a flag of the command line if it has a `help`.

    Attributes
    ----------
    name
        Key of the option among the stored values.
    default
        Default value.
    label
        Label of its row in the form; consecutive options with the same label share the row.
    title
        Text for screen readers and beside a check box; by default the label.
    tip
        Tooltip.
    widget
        The objectName of its widget; by default "export" and the name.
    flag
        Flag of the command line; by default two dashes and the name.
    help
        Help text of the command line; without one the command line lacks the option.
    """

    name: str
    default: Value
    label: str = ""
    title: str = ""
    tip: str = ""
    widget: str = ""
    flag: str = ""
    help: str = ""

    def __post_init__(self) -> None:
        words = self.name.split("_")
        object.__setattr__(self, "title", self.title or self.label)
        object.__setattr__(self, "widget", self.widget or "export" + "".join(map(str.capitalize, words)))
        object.__setattr__(self, "flag", self.flag or "--" + "-".join(words))

    def checked(self, value: object) -> Value:
        """Return a value that was stored or typed; the default if it is not valid."""
        return self.default


@dataclass(frozen=True, kw_only=True, eq=False)
class Check(Option[bool]):
    """An option that is on or off."""

    def checked(self, value: object) -> bool:
        """Return a truth value."""
        return value if isinstance(value, bool) else self.default


@dataclass(frozen=True, kw_only=True, eq=False)
class Whole(Option[int]):
    """A whole number between two limits.

    Attributes
    ----------
    limits
        The least and the greatest.
    suffix
        Unit in the form.
    """

    limits: tuple[int, int]
    suffix: str = ""

    def checked(self, value: object) -> int:
        """Return a number within the limits."""
        is_usable = type(value) is int and self.limits[0] <= value <= self.limits[1]
        return value if is_usable else self.default  # type: ignore[return-value]


@dataclass(frozen=True, kw_only=True, eq=False)
class Real(Option[float | None]):
    """A number between two limits.

    Attributes
    ----------
    limits
        The least and the greatest.
    """

    limits: tuple[float, float]

    def checked(self, value: object) -> float | None:
        """Return a number within the limits."""
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        is_usable = is_number and self.limits[0] <= value <= self.limits[1]  # type: ignore[operator]
        return float(value) if is_usable else self.default  # type: ignore[arg-type]


@dataclass(frozen=True, kw_only=True, eq=False)
class OneOf(Option[Value]):
    """One of several values; `choices` has the title of each."""

    choices: Mapping[Value, str] = field(default_factory=dict)

    def checked(self, value: object) -> Value:
        """Return one of the choices."""
        return next((choice for choice in self.choices if choice == value), self.default)


@dataclass(frozen=True, kw_only=True, eq=False)
class SomeOf(Option[tuple[str, ...]]):
    """Some of several words, at least one; `needed` is the message without any."""

    choices: tuple[str, ...]
    needed: str

    def checked(self, value: object) -> tuple[str, ...]:
        """Return some of the choices, at least one."""
        if not isinstance(value, list | tuple) or not value or not set(value) <= set(self.choices):
            return self.default
        return tuple(value)


@dataclass(frozen=True, kw_only=True, eq=False)
class Tolerance(Real):
    """The largest distance allowed from the true curves; None for the default."""

    limits: tuple[float, float] = (math.ulp(0.0), math.nextafter(1e12, 0.0))


class Extent(NamedEnum):
    """Part of a document that goes into a file."""

    ALL = "all", "All curves"
    SELECTED = "chosen", "Selected curves"


EXTENT = OneOf(
    name="extent",
    label="Curves",
    tip="Curves to export",
    default=Extent.ALL,
    choices={extent: extent.label for extent in Extent},
)
"""Option of all formats."""

WIDTH = Whole(
    name="width",
    label="Width",
    tip="Width in pixels, which sets the height and, with a unit of length, the resolution",
    default=1600,
    limits=(1, 16384),
    suffix=" px",
)
SCALE = OneOf(
    name="scale",
    label="Scale",
    tip="Pixels for each unit of the width",
    default=1.0,
    choices={1.0: "× 1 (96 dpi)", 2.0: "× 2 (192 dpi)", 3.0: "× 3 (288 dpi)", 4.0: "× 4 (384 dpi)"},
)
DPI = Whole(
    name="dpi",
    label="Resolution",
    tip="Pixels per inch at true size",
    default=300,
    limits=(10, 4800),
    suffix=" dpi",
)
BY_DPI = OneOf(
    name="by_dpi",
    label="Pixels",
    tip="Way of setting the number of pixels",
    widget="exportPixels",
    default=True,
    choices={True: "By resolution", False: "By width in pixels"},
)
"""Option of a PNG of a document with a unit of length: it has true size either way."""
TRUE_SIZE = Check(name="true_size", label="Size", title="True size", default=True)
DARK_PAPER: OneOf[bool | None] = OneOf(
    name="dark",
    label="Colours",
    tip="Ink and paper: those of the paper of the document, if it is set, else of light paper",
    widget="exportColours",
    default=None,
    choices={None: "Of the paper, or light", False: "Light", True: "Dark"},
)
TRANSPARENT = Check(name="transparent", title="Transparent", tip="Omit the background", default=True)


def _drawing_check(name: str, title: str, tip: str) -> Check:
    """Return the option to draw something with the curves; the check boxes share a row."""
    return Check(name=name, label="Show", title=title, tip=tip, widget=f"export_{name}", default=False)


POINTS = _drawing_check("points", "Points", "Draw the points")
HANDLES = _drawing_check("handles", "Handles", "Draw the Bézier control points beside the points")
GRID = _drawing_check("grid", "Grid", "Draw a grid behind the curves")
BASIS = _drawing_check(
    "basis", "Basis functions", "Draw the basis functions of the active curve below the picture"
)
TOLERANCE = Tolerance(
    name="tolerance",
    label="Tolerance",
    tip="Largest distance from the true curves, or “automatic”",
    default=None,
)
SVG_WIDTH = Real(
    name="svg_width",
    label="Width",
    title="Width in pixels",
    tip="Width in pixels, or “automatic”: true size, else a pixel for each unit, more if that is tiny",
    default=None,
    limits=(0.01, 1e6),
)
SVG_SCALE = Real(
    name="svg_scale",
    label="Scale",
    title="Pixels for each unit",
    tip="Pixels for each unit of the document, or “automatic”: true size, else one, more if that is tiny",
    help="pixels of an SVG for each unit of the document (default: true size, or 1, or more if tiny)",
    default=None,
    limits=(1e-6, 1e6),
)
DECIMALS = OneOf[Any](
    name="decimals",
    label="Decimals",
    tip="Decimals of coordinates in pixels, at true size in the unit; fewer make a smaller file farther away",
    help="decimals of the coordinates of an SVG in pixels, at true size in the unit (default: %(default)s)",
    default="all",
    choices={"all": "All"} | {count: str(count) for count in range(9)},
)
PICTURE = (TRUE_SIZE, DARK_PAPER, TRANSPARENT, POINTS, HANDLES, GRID, BASIS)
"""Options of all pictures."""


_OF_SIDE, _OF_CUT = 5e-5, 0.01

AUTOMATIC = f"{_OF_SIDE:g} of its size, with a unit at most {_OF_CUT:g} mm"
"""Rule of the automatic tolerance of a drawing, for help texts."""


def automatic_tolerance(document: Document) -> float:
    """Return the tolerance called “automatic”, in the document's unit, rounded down to one digit.

    It is what an eye needs, 5e-5 of the longer side of the box around the visible points: a fifth of a pixel
    where the drawing fills a screen of 3840. With a unit of length it is at most what a laser cutter needs,
    0.01 mm, a tenth of the width of its cut.
    """
    points = [point.position for curve in document.curves if curve.visible for point in curve.points]
    side = max((max(values) - min(values) for values in zip(*points, strict=True)), default=0.0)
    tolerance = _OF_SIDE * (side or 1.0)
    if unit := known_unit(document.unit):
        tolerance = min(tolerance, _OF_CUT / MILLIMETRES[unit])
    power = 10.0 ** math.floor(math.log10(tolerance))
    return float(f"{math.floor(tolerance / power * (1 + 1e-9)) * power:.0e}") or tolerance


class Options(msgspec.Struct, frozen=True, kw_only=True):
    """Options of exports; each format uses those that concern it.

    Attributes
    ----------
    width
        Pictures: width in pixels (PNG, SVG) or points of 1/72 inch (PDF); the height follows.
    tolerance
        Largest deviation allowed, in the document's unit, of formats that cannot hold the curve itself; by
        default `automatic_tolerance`.
    style
        Pictures: colours; by default dark ink, on light paper in a PNG and on none in SVG and PDF.
    points
        Pictures and DXF: whether to draw the points.
    dpi
        PNG at true size: pixels per inch; by default the width decides.
    scale
        PNG: pixels for each unit of `width`, and for 1/96 inch where there is no unit.
    transparent
        Pictures: whether to omit the paper, whatever the style.
    handles, grid
        Pictures: whether to draw the Bézier control points beside the points, and a grid.
    basis
        Pictures: index of the curve whose basis functions are drawn below; None for none.
    with_estimates
        Whether these include the estimates that follow each point, where there are any, in place of the
        functions of the family.
    unit
        Pictures, TikZ and DXF: unit of length, such as "mm". Without a `width` an SVG or PDF then
        has true size, as TikZ always has; a PNG gets its pixels per inch.
    format_options
        Values of the options of single formats, by their names.
    report
        Called with the progress; until the file is put in place it may raise `Cancelled`.
    path
        Path of the file, for formats with paths relative to it.
    from_corner
        SVG: whether its coordinates begin in its upper left corner, and not where those
        of the document do.
    """

    width: float | None = None
    tolerance: float | None = None
    style: PictureStyle | None = None
    points: bool = False
    dpi: float | None = None
    scale: float = 1.0
    transparent: bool = False
    handles: bool = False
    grid: bool = False
    basis: int | None = None
    with_estimates: bool = False
    unit: str = ""
    format_options: Mapping[str, Any] = {}
    report: Report = silent
    path: str = ""
    from_corner: bool = False

    def __getitem__(self, option: Option[Value]) -> Value:
        """Return the value of an option of a single format."""
        value: Value = self.format_options.get(option.name, option.default)
        return value

    def reporting(self, report: Report) -> Options:
        """Return the same options with a report of the progress."""
        return replace(self, report=report)

    @property
    def is_to_scale(self) -> bool:
        """Whether pictures have true size."""
        return self.width is None and bool(known_unit(self.unit))

    @property
    def paper_style(self) -> PictureStyle:
        """The colours of a PNG, which has paper unless it is to be transparent."""
        return self._on_paper(self.style or LIGHT)

    @property
    def vector_style(self) -> PictureStyle:
        """The colours of an SVG or PDF, with paper only where a style is given."""
        return self._on_paper(self.style or INK)

    def _on_paper(self, style: PictureStyle) -> PictureStyle:
        return replace(style, paper=None) if self.transparent else style


DEFAULT = Options()
"""Options with all defaults."""


def all_options(option_lists: Iterable[Iterable[Option[Any]]]) -> tuple[Option[Any], ...]:
    """Return the options of several formats, each once, in the order of their first appearance."""
    return tuple({option.name: option for options in option_lists for option in options}.values())
