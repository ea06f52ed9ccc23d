"""Lines cut apart where those in front of them cross them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import partial

import curvecore
from curvecore.arrays import FloatArray

from ...document.edits import EditError
from ...document.model import Curve, Document, Parametrization, ParametrizationKind
from ...families import HERMITE
from ...tasks.progress import Report, part, silent
from ..curve.curve_view import CurveView
from .cubics import points_of_cubics
from .regions import Combined, Names, chosen_shapes, computed, outlines_of, replaced, size_of, taken_names


def cut_apart(
    document: Document, views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> Combined:
    """Return the document with the hindmost shape of some curves in open parts, cut by those in front.

    These are taken away, and the parts look as the shape did.

    Raises
    ------
    EditError
        If there is one shape alone, or if none of the others crosses the hindmost.
    """
    back, *front = chosen_shapes(document, curves)
    if not front:
        raise EditError("Choose a path, and one in front of it that cuts it.")
    size = size_of([views[place] for places in (back, *front) for place in places])
    lines, off = outlines_of([views[place] for place in back], size)
    knives, _ = outlines_of([views[place] for places in front for place in places], size)
    names, made, count = Names(document.curves[back.start].seen_name, taken_names(document)), [], 0
    for done, (place, line) in enumerate(zip(back, lines, strict=True)):
        curve, share = document.curves[place], part(report, done / len(lines), (done + 1) / len(lines))
        parts = computed(partial(_parts, line, knives, closed=curve.is_closed, report=share))
        count += len(parts)
        made += [curve] if len(parts) == 1 else [_open_part(each, curve, names.next()) for each in parts]
    if count == len(lines):
        raise EditError("Nothing in front crosses the hindmost path.")
    gone: dict[range, Sequence[Curve]] = {places: [] for places in front}
    return Combined(*replaced(document, {back: made, **gone}), count, off)


def _parts(
    line: FloatArray, knives: Sequence[FloatArray], *, closed: bool, report: Report
) -> list[FloatArray]:
    if closed and (line[0, 0] != line[-1, 3]).any():
        line = line.copy()
        line[-1, 3] = line[0, 0]
    return curvecore.cut_line(line, knives, closed=closed, progress=lambda share: report(share, "Cut Path"))


def _open_part(pieces: FloatArray, model: Curve, name: str) -> Curve:
    """Return a part of a curve as one that looks like that."""
    return Curve(
        name,
        HERMITE,
        Parametrization(ParametrizationKind.MANUAL),
        points_of_cubics(pieces, closed=False).points,
        style=model.style,
        groups=model.groups,
        group_looks=model.group_looks,
        visible=model.visible,
    )
