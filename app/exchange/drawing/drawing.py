"""Drawings: the visible curves of a document as outlines in a frame, the source of every picture."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import NamedTuple

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore import CurveError
from curvecore.arrays import FloatArray
from curvecore.bezier.control_points import cubic_shape

from ...document.model import Curve, Document
from ...document.style import USUAL_WIDTH, Style
from ...tasks.progress import Report, part, silent, with_progress
from ...view_model.curve.core_curve import in_words
from ...view_model.curve.curve_view import ParametricCurve, view_of
from ...view_model.extents import around_dot
from ..cubics_in import PIECES_OF_A_TURN, arc, letters_of
from ..errors import ExchangeError
from ..options import automatic_tolerance
from .outlines import (
    LARGEST,
    Frame,
    Outline,
    are_lines,
    by_shape,
    frame_around,
    frame_with,
    painted_extent,
    straight_pieces,
)

POINT_RADIUS = 0.006
"""Radius of the discs at the points, against the larger side of the drawing."""

MOST_POINTS = 10_000
"""Points of the largest Lagrange curve that is computed; the work grows with the square."""

_SAMPLES = 513

_ROUND = 1e-9
"""Share of the radius by which control points of a circle may be off."""

_SLIMMEST_TRIMMED = 0.02
"""Least ratio of the sides: a slimmer drawing, such as a horizontal line, has a margin."""


class Annotation(msgspec.Struct, frozen=True):
    """Lines that go with the curves.

    Attributes
    ----------
    name
        Name of their group: "grid", "handles" or "basis".
    lines
        Polylines, each (k, 2).
    width
        Width of their strokes, in the document's unit.
    opacity
        From 0 to 1.
    colour
        "#rrggbb", or empty for the ink of the picture.
    filled
        Whether they are outlines of areas, without a stroke.
    dash
        Lengths of dashes and gaps; empty for none.
    """

    name: str
    lines: tuple[FloatArray, ...]
    width: float
    opacity: float = 1.0
    colour: str = ""
    filled: bool = False
    dash: tuple[float, ...] = ()


class Drawing(msgspec.Struct, frozen=True):
    """All visible curves of a document that can be drawn.

    Attributes
    ----------
    outlines
        At least one.
    frame
        The visible rectangle: the curves and their points with a margin.
    tolerance
        The deviation that was allowed, in the document's unit.
    left_out
        One sentence for every curve that could not be drawn.
    annotations
        Lines beside the curves.
    hidden
        Outlines of hidden curves for files that keep them, each with the number of outlines behind it.
    """

    outlines: tuple[Outline, ...]
    frame: Frame
    tolerance: float
    left_out: tuple[str, ...] = ()
    annotations: tuple[Annotation, ...] = ()
    hidden: tuple[tuple[int, Outline], ...] = ()

    @property
    def shapes(self) -> list[tuple[Outline, ...]]:
        """The outlines, those of a shape together."""
        return by_shape(self.outlines)

    @property
    def all_shapes(self) -> list[tuple[Outline, ...]]:
        """The outlines and the hidden ones, those of a shape together."""
        outlines = list(self.outlines)
        for behind, outline in reversed(self.hidden):
            outlines.insert(behind, outline)
        return by_shape(outlines)

    @property
    def usual_width(self) -> float:
        """Width of a line whose style does not say it."""
        return USUAL_WIDTH * self.frame.side

    @property
    def deviation(self) -> float:
        """Largest distance of any outline from its true curve."""
        return max(outline.deviation for outline in (*self.outlines, *(hidden for _, hidden in self.hidden)))

    @property
    def is_bound(self) -> bool:
        """Whether no outline is anywhere farther away."""
        return all(outline.is_bound for outline in (*self.outlines, *(hidden for _, hidden in self.hidden)))

    def fitted(self, width: float, height: float) -> Drawing:
        """Return the drawing moved and scaled to the frame (0, 0, width, height), centred in it.

        The deviations stay those of the original, in the document's unit.
        """
        scale = min(width / self.frame.width, height / self.frame.height)
        corner = np.array([self.frame.left, self.frame.bottom])
        room = np.array([width - scale * self.frame.width, height - scale * self.frame.height])

        def moved(points: FloatArray) -> FloatArray:
            return np.asarray((points - corner) * scale + room / 2)

        outlines = tuple(
            replace(
                outline,
                control_points=moved(outline.control_points),
                points=moved(outline.points),
                style=_scaled(outline.style, scale),
            )
            for outline in self.outlines
        )
        annotations = tuple(
            replace(
                annotation,
                lines=tuple(map(moved, annotation.lines)),
                width=annotation.width * scale,
                dash=tuple(length * scale for length in annotation.dash),
            )
            for annotation in self.annotations
        )
        frame = Frame(0.0, 0.0, width, height)
        return replace(self, outlines=outlines, frame=frame, annotations=annotations)


def drawing_of(
    document: Document,
    tolerance: float | None = None,
    report: Report = silent,
    *,
    with_hidden: bool = False,
) -> Drawing:
    """Return the drawing of a document.

    Parameters
    ----------
    document
        A document with at least one curve that can be drawn.
    tolerance
        Largest deviation allowed, positive, in the document's unit; by default
        `automatic_tolerance`.
    report
        Called with the progress.
    with_hidden
        Whether to have the outlines of hidden curves, too.

    Raises
    ------
    ExchangeError
        If no curve can be drawn, or if the coordinates are so large, so small or so far from the origin
        that no picture can hold them.
    """
    if tolerance is not None and not 0 < tolerance < np.inf:
        raise ExchangeError("The tolerance must be a positive number.")
    curves, remarks = _some_drawable(document, part(report, 0.0, 0.3))
    samples = [_samples(*pair) for pair in with_progress(curves, part(report, 0.3, 0.5), "Computing curves")]
    frame_around(samples)  # refuses what no picture can hold, before the work
    allowed = automatic_tolerance(document) if tolerance is None else tolerance
    drawn = with_progress(curves, part(report, 0.5, 1.0), "Drawing curves")
    outlines = tuple(_outline(curve, core, allowed) for curve, core in drawn)
    hidden = tuple(_hidden(document, [curve for curve, _ in curves], allowed)) if with_hidden else ()
    return Drawing(
        outlines,
        frame_with(outlines),
        allowed,
        tuple(remarks),
        hidden=hidden,
    )


def _some_drawable(
    document: Document, report: Report
) -> tuple[list[tuple[Curve, ParametricCurve]], list[str]]:
    """Return the same as `drawable_curves`; raise `ExchangeError` where no curve is there to be drawn."""
    curves, remarks = drawable_curves(document, report)
    if not curves:
        why = f". {' '.join(remarks)}" if remarks else ": all curves are hidden."
        raise ExchangeError(f"There is nothing to draw{why}")
    return curves, remarks


def _hidden(document: Document, drawn: Iterable[Curve], tolerance: float) -> Iterator[tuple[int, Outline]]:
    """Yield the hidden curves that can be drawn, each with the number of drawn ones behind it."""
    behind, left = 0, list(drawn)
    for curve in document.curves:
        behind += behind < len(left) and left[behind] is curve
        if not curve.visible and not complexity_problem(curve) and (core := view_of(curve).curve) is not None:
            with suppress(ExchangeError):
                yield behind, _outline(curve, core, tolerance)


def _scaled(style: Style, scale: float) -> Style:
    return style if style.width is None else replace(style, width=style.width * scale)


def complexity_problem(curve: Curve) -> str:
    """Return why a curve cannot be computed in any sensible time, as a sentence; empty if it can."""
    if curve.family.curve_class.is_one_polynomial and len(curve.points) > MOST_POINTS:
        return f"{curve.family.subject} can have {MOST_POINTS} points, not {len(curve.points)}."
    return ""


def drawable_curves(
    document: Document, report: Report
) -> tuple[list[tuple[Curve, ParametricCurve]], list[str]]:
    """Return the visible curves that can be computed, as they are, and a sentence for each of the others."""
    curves, remarks = [], []
    visible = [curve for curve in document.curves if curve.visible]
    for curve in with_progress(visible, report, "Computing curves"):
        reason = complexity_problem(curve)
        view = view_of(curve) if not reason else None
        if view is not None and view.curve is not None:
            curves.append((curve, view.curve))
        else:
            remarks.append(f"“{curve.display_name}”: {reason if view is None else view.problem}")
    return curves, remarks


def _samples(curve: Curve, core: ParametricCurve) -> FloatArray:
    """Return points all along the curve, enough to know its size."""
    parameters = np.union1d(np.linspace(*core.domain, _SAMPLES), core.parameters)
    samples = core.evaluate(parameters)
    refuse_out_of_range(curve, samples)
    # A line without length is as large as the dot of its caps.
    return samples if (samples != samples[0]).any() else around_dot(samples[0], curve.style)


def refuse_out_of_range(curve: Curve, samples: FloatArray) -> None:
    """Raise ExchangeError for samples of a curve, (m, 2), that no picture can hold."""
    if not np.isfinite(samples).all() or np.abs(samples).max() > LARGEST:
        raise ExchangeError(
            f"“{curve.display_name}” oscillates beyond {LARGEST:g} between points, too far for a picture. "
            "Try Chebyshev parameters or a Hermite curve."
        )


def _outline(curve: Curve, core: ParametricCurve, tolerance: float) -> Outline:
    try:
        path = cubic_shape(core, tolerance)
    except CurveError as problem:
        raise ExchangeError(f"“{curve.display_name}” cannot be drawn: {in_words(str(problem))}.") from problem
    points = core.points[: len(curve.points)]
    return Outline(
        curve.name,
        path.control_points,
        points,
        float(path.deviation),
        curve.is_closed,
        curve.style,
        curve.shape,
        curve.groups,
        curve.visible,
        curve.locked,
        letters_of(curve, path.control_points),
        path.is_bound,
    )


class Circle(NamedTuple):
    """Circle: its first point at an angle in radians, its deviation from the outline that is taken for it."""

    centre: FloatArray
    radius: float
    start: float
    deviation: float


def circle_of(outline: Outline) -> Circle | None:
    """Return the circle that an outline is but for rounding: closed, of four quarters as `arc` makes them."""
    controls = outline.control_points
    if not outline.closed or len(controls) != PIECES_OF_A_TURN:
        return None
    centre = controls[:, 0].mean(axis=0)
    (x, y), (after_x, after_y) = (controls[:2, 0] - centre).tolist()
    radius, start = math.hypot(x, y), math.atan2(y, x)
    ideal = arc(centre, radius * np.eye(2), start, math.copysign(math.tau, x * after_y - y * after_x))
    is_round = radius > 0 and np.abs(ideal.pieces - controls).max() <= _ROUND * radius
    return Circle(centre, radius, start, ideal.deviation) if is_round else None


def rounded(drawing: Drawing, decimals: int) -> Drawing:
    """Return a drawing with coordinates of so many decimals, lines straight; its deviations hold for them."""

    def with_decimals(outline: Outline) -> Outline:
        controls, lines = outline.control_points.round(decimals), are_lines(outline.control_points)
        controls[lines] = straight_pieces(controls[lines])
        if circle := circle_of(outline):
            size = round(circle.radius, decimals) / circle.radius
            controls = (outline.control_points - circle.centre) * size + circle.centre.round(decimals)
        # A curve is nowhere farther from another than their control points are from each other.
        moved = float(np.hypot(*(controls - outline.control_points).reshape(-1, 2).T).max())
        return replace(outline, control_points=controls, deviation=outline.deviation + moved)

    return replace(
        drawing,
        outlines=tuple(map(with_decimals, drawing.outlines)),
        hidden=tuple((behind, with_decimals(outline)) for behind, outline in drawing.hidden),
    )


def trimmed_to_curves(drawing: Drawing) -> Drawing:
    """Return a drawing whose frame is the box around its curves with their strokes."""
    low, high = _painted(drawing)
    middle, size = low + (high - low) / 2, high - low
    width, height = np.maximum(size, _SLIMMEST_TRIMMED * size.max()).tolist()
    x, y = middle.tolist()
    return replace(drawing, frame=Frame(x - width / 2, y - height / 2, width, height))


def _painted(drawing: Drawing) -> tuple[FloatArray, FloatArray]:
    """Return the corners of the box around the curves of a drawing with their strokes."""
    boxes = np.array([painted_extent(outline) for outline in drawing.outlines])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    if any(outline.style.has_stroke and outline.style.width is None for outline in drawing.outlines):
        # The usual width is a share of the longer side with these lines.
        reach = float((high - low).max()) * USUAL_WIDTH / (1 - USUAL_WIDTH) / 2
        low, high = low - reach, high + reach
    return low, high
