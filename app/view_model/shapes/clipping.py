"""Shapes cut by the outline of the one in front of them, and made whole again."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.clip import MOST_CLIPS, Clip, ClipRing, ring_of
from ...document.limits import EditError
from ...document.model import Curve, Document, Parametrization, ParametrizationKind
from ...document.style import PLAIN_STYLE, FillRule
from ...families import HERMITE
from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView
from ..fitting.cubics import points_of_cubics
from .regions import Combined, Names, chosen_shapes, outlines_of, replaced, taken_names


def with_clip_set(
    document: Document,
    views: Sequence[CurveView],
    curves: Collection[int],
    report: Report = silent,
    *,
    letters: Sequence[FloatArray] = (),
) -> Combined:
    """Return the document with the foremost of some shapes as what cuts the others; it is gone itself.

    Parameters
    ----------
    letters
        The outlines of the foremost one, cubic pieces (k, 4, 2) each, where it is a text.

    Raises
    ------
    EditError
        If there are too few shapes, or if it has no outline.
    """
    *others, front = chosen_shapes(document, curves)
    if not others:
        raise EditError("Choose two shapes or more: the one in front cuts the others.")
    report(0.0, "Set clip")
    outlines, deviation = (letters, 0.0) if letters else outlines_of([views[place] for place in front])
    style = document.curves[front.start].style
    rings = tuple(map(_ring, outlines))
    own = (Clip(rings, evenodd=style.fill_rule is FillRule.EVENODD and len(rings) > 1), *style.clips)
    made: dict[range, list[Curve]] = {front: []}
    for places in others:
        made[places] = [_cut(document.curves[place], own) for place in places]
    return Combined(*replaced(document, made), len(others), deviation)


def with_clip_released(
    document: Document, _views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> Combined:
    """Return the document with some shapes whole; what cut them is a shape each in front of them.

    Raises
    ------
    EditError
        If nothing cuts them.
    """
    report(0.0, "Release clip")
    made, given, taken = dict[range, list[Curve]](), set[Clip](), taken_names(document)
    names = Names("Clip", taken)
    if "Clip" in taken:
        names.next()
    for places in reversed(chosen_shapes(document, curves)):
        own = document.curves[places.start : places.stop]
        made[places] = [replace(each, style=replace(each.style, clips=())) for each in own]
        for clip in own[0].style.clips:
            if clip not in given:
                given.add(clip)
                made[places] += curves_of_clip(clip, own[0], names.next())
    if not any(document.curves[places.start].style.clips for places in made):
        raise EditError("Nothing of this is clipped.")
    return Combined(*replaced(document, made), len(made), 0.0)


def _cut(curve: Curve, clips: tuple[Clip, ...]) -> Curve:
    both = tuple(dict.fromkeys((*curve.style.clips, *clips)))
    if len(both) > MOST_CLIPS:
        raise EditError(f"At most {MOST_CLIPS} clips cut a shape.")
    return replace(curve, style=replace(curve.style, clips=both))


def _ring(pieces: FloatArray) -> ClipRing:
    return ring_of((x, y) for x, y in [pieces[0, 0].tolist(), *pieces[:, 1:].reshape(-1, 2).tolist()])


def curves_of_clip(clip: Clip, model: Curve, name: str) -> list[Curve]:
    """Return the rings of a clip as curves of one shape, beside another one."""
    rings = [pieces for ring in clip.rings if len(pieces := _pieces(ring))]
    several = len(rings) > 1
    rule = FillRule.EVENODD if clip.evenodd else FillRule.NONZERO
    return [
        Curve(
            f"{name} ({number})" if several else name,
            HERMITE,
            Parametrization(ParametrizationKind.MANUAL),
            points_of_cubics(pieces, closed=True).points,
            closed=True,
            style=replace(PLAIN_STYLE, fill_rule=rule) if several else PLAIN_STYLE,
            shape=name if several else "",
            groups=model.groups,
            visible=model.visible,
        )
        for number, pieces in enumerate(rings, start=1)
    ]


def _pieces(ring: ClipRing) -> FloatArray:
    """Return the pieces of a ring, (k, 4, 2), which end where they begin; those that are points left out."""
    places = np.array(ring.numbers).reshape(-1, 2)
    pieces = np.stack([places[at : len(places) - 3 + at : 3] for at in range(4)], axis=1)
    first, last = places[0], places[-1]
    if (first != last).any():
        line = np.stack([last + share * (first - last) for share in (0.0, 1 / 3, 2 / 3, 1.0)])
        line[3] = first
        pieces = np.concatenate([pieces, line[None]])
    found: FloatArray = pieces[(pieces != pieces[:, :1]).any(axis=(1, 2))]
    return found
