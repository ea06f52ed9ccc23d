"""Clips that are edited: their outlines are shapes for as long, and what they cut follows them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from msgspec.structs import replace

from ...document.clip import Clip, ring_of
from ...document.limits import EditError
from ...document.model import Curve, Document
from ...document.shapes import shape_of, tidy_shapes
from ...document.style import FillRule
from ...tasks.progress import Report, silent
from ..curve.curve_view import CurveView
from .clipping import curves_of_clip
from .courses import course_of_curve
from .regions import Combined, Names, chosen_shapes, replaced, taken_names


class ClipOutlines(Combined, frozen=True):
    """A document with the outlines of clips as shapes.

    Attributes
    ----------
    names
        Those of the shape of each clip, and of its curves.
    """

    names: frozenset[frozenset[str]]


def with_clip_outlines(
    document: Document, _views: Sequence[CurveView], curves: Collection[int], report: Report = silent
) -> ClipOutlines:
    """Return the document with what cuts some shapes as a shape each in front of them; it cuts them still.

    Raises
    ------
    EditError
        If nothing cuts them.
    """
    report(0.0, "Edit clip")
    made, outlines, taken = dict[range, list[Curve]](), dict[Clip, list[Curve]](), taken_names(document)
    names = Names("Clip", taken)
    if "Clip" in taken:
        names.next()
    for places in reversed(chosen_shapes(document, curves)):
        own = document.curves[places.start : places.stop]
        for clip in own[0].style.clips:
            if clip not in outlines and (found := curves_of_clip(clip, own[0], names.next())):
                outlines[clip] = [replace(each, visible=True) for each in found]
                made[places] = [*made.get(places, own), *outlines[clip]]
    if not made:
        raise EditError("Nothing of this is clipped.")
    after, _ = replaced(document, made)
    given = frozenset(
        frozenset({each.name for each in found} | {found[0].shape or found[0].name})
        for found in outlines.values()
    )
    # As the outlines say it, which is the same but for roundings: it is known again by being equal.
    at_first = {clip: _place(after, {found[0].name}) for clip, found in outlines.items()}
    swapped = {clip: cut for clip, place in at_first.items() if (cut := clip_at(after, place)) is not None}
    where = frozenset(at for at, each in enumerate(after.curves) if any(each.name in one for one in given))
    return ClipOutlines(_with_swapped(after, swapped), where, len(given), 0.0, given)


def followed_outlines(document: Document, before: Document, outlines: Iterable[Collection[str]]) -> Document:
    """Return the document whose clips are as their outlines run now, those that ran otherwise before."""
    swapped = dict[Clip, Clip]()
    for names in outlines:
        now, was = _place(document, names), _place(before, names)
        if now < 0 or was < 0 or _parts(document, now) == _parts(before, was):
            continue
        old, new = clip_at(before, was), clip_at(document, now)
        if old is not None and new is not None:
            swapped[old] = new
    return _with_swapped(document, swapped)


def has_shape(document: Document, names: Collection[str]) -> bool:
    """Whether a shape, or a curve, of one of these names is there."""
    return _place(document, names) >= 0


def outline_at(document: Document, names: Collection[str]) -> frozenset[int]:
    """Return the places of the outline of a clip that cuts something; none where it is none any more."""
    place = _place(document, names)
    if place < 0 or not cut_by(document, place):
        return frozenset()
    return frozenset(shape_of(document, place))


def cut_by(document: Document, place: int) -> frozenset[int]:
    """Return the places of the curves that are cut as the outline at a place says."""
    clip = clip_at(document, place)
    return frozenset(at for at, each in enumerate(document.curves) if clip in each.style.clips)


def without_outline(document: Document, outline: Collection[int]) -> Document:
    """Return the document without the outline of a clip, which goes on to cut what it cuts."""
    left = tuple(each for at, each in enumerate(document.curves) if at not in outline)
    return tidy_shapes(replace(document, curves=left))


def clip_at(document: Document, place: int) -> Clip | None:
    """Return what the shape at a place cuts others by; None where it has no outline."""
    rings = []
    for each in _parts(document, place):
        if pieces := course_of_curve(each):
            rings.append(ring_of([pieces[0][0], *(end for piece in pieces for end in piece[1:])]))
    rule = document.curves[place].style.fill_rule
    return Clip(tuple(rings), evenodd=rule is FillRule.EVENODD and len(rings) > 1) if rings else None


def _place(document: Document, names: Collection[str]) -> int:
    """Return where a shape, or one of its curves, of one of these names is first; -1 if it is nowhere."""
    found = (at for at, each in enumerate(document.curves) if each.name in names or each.shape in names)
    return next(found, -1)


def _parts(document: Document, place: int) -> Sequence[Curve]:
    places = shape_of(document, place)
    return document.curves[places.start : places.stop]


def _with_swapped(document: Document, swapped: Mapping[Clip, Clip]) -> Document:
    if not any(new != old for old, new in swapped.items()):
        return document
    return replace(document, curves=tuple(_cut_anew(each, swapped) for each in document.curves))


def _cut_anew(curve: Curve, swapped: Mapping[Clip, Clip]) -> Curve:
    clips = curve.style.clips
    if not any(clip in swapped for clip in clips):
        return curve
    new = tuple(dict.fromkeys(swapped.get(clip, clip) for clip in clips))
    return replace(curve, style=replace(curve.style, clips=new))
