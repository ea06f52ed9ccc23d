"""Annotations of a picture beside the curves: a grid, the handles, the basis functions."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, floor, log10

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.model import Curve, Document
from ...view_model.basis import BasisView, basis_view, cardinal_view
from ...view_model.curve.curve_view import view_of
from ...view_model.curve.handles import Handle, control_polygon, handles_of
from ...view_model.palette import point_palette
from ..errors import ExchangeError
from ..options import Options
from .drawing import Annotation, Drawing
from .outlines import MARGIN, Frame, frame_with

PANEL = 0.4
"""Height of the basis functions' panel against the picture's longer side."""

MOST_HANDLES = 2_000
"""Points of a curve beyond which handles would only be a black mass."""

_CALM = (-0.5, 1.2)
_WILD = (-4.0, 4.0)
_MOST_LINES = 24
_FINE, _COARSE, _AXIS = 0.08, 0.16, 0.4
_THIN, _USUAL = 0.001, 0.002
_SQUARE = 0.004
_DASHES = ((), (0.008, 0.005), (0.002, 0.004), (0.008, 0.004, 0.002, 0.004))


def with_annotations(drawing: Drawing, document: Document, options: Options, theme: str) -> Drawing:
    """Return the drawing with the annotations of the options, on the paper of a theme, "light" or "dark".

    Raises
    ------
    ExchangeError
        If the basis functions are wanted of a curve that has none.
    """
    frame = drawing.frame
    handles = _handles(document) if options.handles else []
    if handles:
        ends = np.array([handle.position for _, arms in handles for handle in arms])
        frame = frame_with(drawing.outlines, ends)
    annotations = _grid(frame) if options.grid else []
    for colour, arms in handles:
        annotations += _handle_annotations(colour, arms, frame.side)
    if options.basis is not None:
        curve = document.curves[options.basis]
        view = _functions(curve, options.with_estimates)
        if view is None:
            raise ExchangeError(f"“{curve.name}” has no basis functions to draw.")
        height = PANEL * frame.side
        panel = Frame(frame.left, frame.bottom - height, frame.width, height)
        annotations += _basis(view, panel, frame.side, theme)
        frame = Frame(frame.left, panel.bottom, frame.width, frame.height + height)
    return replace(drawing, frame=frame, annotations=tuple(annotations))


def _functions(curve: Curve, with_estimates: bool) -> BasisView | None:
    view = view_of(curve)
    return cardinal_view(view) if with_estimates and curve.family.derivatives else basis_view(view)


def grid_step(frame: Frame) -> float:
    """Return the distance of the fine lines: 1, 2 or 5 times a power of ten."""
    least = frame.side / _MOST_LINES
    decade = 10.0 ** floor(log10(least))
    return next(step * decade for step in (1, 2, 5, 10) if step * decade >= least * (1 - 1e-9))


def _grid(frame: Frame) -> list[Annotation]:
    step, right = grid_step(frame), frame.left + frame.width
    upright = [(k, np.array([(x, frame.bottom), (x, frame.top)])) for k, x in _lines(frame.left, right, step)]
    level = [(k, np.array([(frame.left, y), (right, y)])) for k, y in _lines(frame.bottom, frame.top, step)]
    lines = [*upright, *level]
    kinds = (
        (_FINE, [line for k, line in lines if k % 5]),
        (_COARSE, [line for k, line in lines if k % 5 == 0 and k]),
        (_AXIS, [line for k, line in lines if k == 0]),
    )
    width = _THIN * frame.side
    return [Annotation("grid", tuple(group), width, opacity) for opacity, group in kinds if group]


def _lines(low: float, high: float, step: float) -> Iterator[tuple[int, float]]:
    """Yield the coordinates between two that are multiples of a step, each with which it is."""
    for k in range(ceil(low / step), floor(high / step) + 1):
        yield k, k * step


def _handles(document: Document) -> list[tuple[str, list[Handle]]]:
    """Return the handles and control polygons of the curves that have any, each with the curve's colour."""
    result = []
    for curve in document.curves:
        if curve.visible and len(curve.points) <= MOST_HANDLES and (view := view_of(curve)).is_current:
            handles = [handle for index in range(len(curve.points)) for handle in handles_of(view, index)]
            handles += control_polygon(view)
            result += [(curve.style.colour, handles)] if handles else []
    return result


def _handle_annotations(colour: str, handles: list[Handle], side: float) -> list[Annotation]:
    corner = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]) * (_SQUARE * side)
    lines = tuple(np.array([handle.anchor, handle.position]) for handle in handles)
    squares = tuple(np.array(handle.position) + corner for handle in handles)
    return [
        Annotation("handles", lines, _THIN * side, 0.6, colour=colour),
        Annotation("handles", squares, 0.0, 0.8, colour=colour, filled=True),
    ]


def _basis(view: BasisView, panel: Frame, side: float, theme: str) -> list[Annotation]:
    """Return the functions in their panel, with lines at 0 and 1 and at every parameter."""
    low, high = view.extent(range(view.kinds))
    low, high = max(min(low, _CALM[0]), _WILD[0]), min(max(high, _CALM[1]), _WILD[1])
    start, end = view.curve.domain
    room = MARGIN * panel.width

    def in_panel(t: FloatArray, values: FloatArray) -> FloatArray:
        share = (np.clip(values, low, high) - low) / (high - low)
        x = panel.left + room + (t - start) / (end - start) * (panel.width - 2 * room)
        return np.column_stack([x, panel.bottom + (0.05 + 0.9 * share) * panel.height])

    ends = np.array([start, end])
    levels = tuple(in_panel(ends, np.full(2, float(value))) for value in (0, 1))
    ticks = tuple(in_panel(np.full(2, t), np.array([low, 0.0])) for t in view.curve.parameters.tolist())
    edge = np.array([(panel.left, panel.top), (panel.left + panel.width, panel.top)])
    thin, usual = _THIN * side, _USUAL * side
    annotations = [
        Annotation("basis", (edge, levels[1]), thin, _COARSE),
        Annotation("basis", (levels[0],), thin, _AXIS),
        Annotation("basis", ticks, thin, _COARSE),
    ]
    colours = point_palette(view.point_count, theme, "")
    for kind in range(view.kinds):
        dash = tuple(length * side for length in _DASHES[kind])
        if view.is_coarse:
            t, least, greatest = view.envelope(kind)
            outline = (in_panel(t, least), in_panel(t, greatest))
            annotations.append(Annotation("basis", outline, usual, dash=dash))
            continue
        for index in view.drawn:
            line, colour = in_panel(*view.function(index, kind)), colours[view.owners[index]]
            annotations.append(Annotation("basis", (line,), usual, colour=colour, dash=dash))
    return annotations
