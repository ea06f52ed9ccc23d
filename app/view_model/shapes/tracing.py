"""Shapes of what is dark in a picture."""

from __future__ import annotations

from functools import partial

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore.arrays import FloatArray

from ...document.contents import Plane
from ...document.edits import EditError
from ...document.model import Curve, Document, make_curve
from ...document.shapes import tidy_shapes
from ...document.style import NO_PAINT, FillRule, Style
from ...tasks.progress import Report, silent
from ..fitting.outline_fit import fitted_outline
from ..fitting.picture_outlines import dark_outlines, parting_brightness
from .regions import Names, curves_of, taken_names

TOLERANCE = 0.4
"""How far an outline may be from that of the picture, in pixels of this."""

_LEAST = 4.0
"""Square pixels below which a dark or light spot is dirt."""

_MOST = 2000
"""Outlines; more of them are noise."""

_BLACK = "#000000"


class Source(msgspec.Struct, frozen=True):
    """A picture that is traced.

    Attributes
    ----------
    name
        What it is called.
    brightness
        From 0, black, to 1, (rows, columns).
    plane
        Map from it, as if it was 1 wide and high, to the plane.
    place
        Where among the curves its shape comes.
    groups
        Those that it comes into.
    """

    name: str
    brightness: FloatArray
    plane: Plane
    place: int
    groups: tuple[str, ...]

    @property
    def parting(self) -> float:
        """The brightness that parts it best in dark and light."""
        return parting_brightness(self.brightness)


class Traced(msgspec.Struct, frozen=True):
    """A document with the shape that was made of a picture.

    Attributes
    ----------
    document
        The document.
    places
        Where the shape is in it.
    points
        How many points it has.
    """

    document: Document
    places: range
    points: int


def traced(document: Document, source: Source, limit: float, report: Report = silent) -> Traced:
    """Return the document with a shape of what is darker than a limit in a picture, in front of that.

    Raises
    ------
    EditError
        If nothing is, or if there are more spots than anybody drew.
    """
    outlines = dark_outlines(source.brightness, limit, _LEAST)
    percent = f"{100.0 * limit:.0f} %"
    if not outlines:
        raise EditError(f"Nothing in “{source.name}” is darker than {percent}.")
    if len(outlines) > _MOST:
        raise EditError(
            f"“{source.name}” has {len(outlines):,} spots that are darker than {percent}; at most {_MOST:,} "
            "are traced. Choose another brightness, or a picture with fewer spots."
        )
    contours, whole, done = list[FloatArray](), sum(map(len, outlines)), 0
    for outline in outlines:
        hear = partial(report, done / whole, "Tracing")
        hear()
        contours.append(_on_plane(fitted_outline(outline, TOLERANCE, hear), source))
        done += len(outline)
    region = curvecore.Region(contours, curvecore.WindingRule.EVEN_ODD)
    name = Names(f"Trace of {source.name}", taken_names(document)).next()
    new = curves_of(region, _model(source), name, 0.0)
    curves = (*document.curves[: source.place], *new, *document.curves[source.place :])
    made = tidy_shapes(replace(document, curves=curves))
    places = range(source.place, source.place + len(new))
    return Traced(made, places, sum(len(curve.points) for curve in new))


def _on_plane(pieces: FloatArray, source: Source) -> FloatArray:
    """Return pieces in pixels of a picture where they are on the plane."""
    rows, columns = source.brightness.shape
    plane = source.plane
    ways = np.array([plane.across, plane.down]) / np.array([[columns], [rows]])
    placed: FloatArray = np.array([plane.x, plane.y]) + pieces @ ways
    # Products of matrices round the last of one piece and the first of the next as they please.
    placed[1:, 0] = placed[:-1, 3]
    placed[-1, 3] = placed[0, 0]
    return placed


def _model(source: Source) -> Curve:
    """Return a curve that looks as the shape is to."""
    style = Style(stroke=NO_PAINT, fill=_BLACK, fill_rule=FillRule.EVENODD)
    return replace(make_curve(()), style=style, groups=source.groups)
