"""Texts follow the curves that they lie along, at the door of every change."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from ..document.along_edits import along_of, path_of, place_of, with_along
from ..document.along_path import Along, Ground, after, inverse_of, place_by
from ..document.content import Lettering
from ..document.contents import corners_of, plane_of
from ..document.form import Piece
from ..document.model import Curve, Document
from ..qt.contents import fitted
from ..qt.letters_along import course_of, start_of
from ..view_model.shapes.courses import course_at

_NEAR = 1e-7
"""Share of the size of a course by which it may be off one that it is: roundings."""


def along_paths(document: Document, before: Document) -> Document:
    """Return the document whose texts lie along their curves as these run now.

    What was moved together with its curve goes along as it is. Without its curve a text is straight again.
    """
    places = [at for at, each in enumerate(document.curves) if each.form is not None and path_of(each)]
    curves, old = list(document.curves), {each.name: each for each in before.curves} if places else {}
    for place in places:
        curve = curves[place]
        curves[place] = _following(document, before, curve, old.get(curve.name))
    is_same = all(new is was for new, was in zip(curves, document.curves, strict=True))
    return document if is_same else replace(document, curves=tuple(curves))


def _following(document: Document, before: Document, curve: Curve, was: Curve | None) -> Curve:
    along, text = along_of(curve), curve.form
    assert along is not None
    assert isinstance(text, Lettering)
    place = place_of(document, along.of)
    if place < 0:
        is_lost = place_of(before, along.of) >= 0
        return straightened(curve) if is_lost else with_along(curve, replace(along, of=""))
    course = course_at(document, place)
    if not course:
        return curve
    now = replace(along, pieces=by_ground(along.ground, course))
    if not is_near(now.pieces, along.pieces):
        ground = _taken_along(curve, along, was, course)
        along = now if ground is None else replace(along, ground=ground)
        return fitted(with_along(curve, along)) if ground is None else with_along(curve, along)
    before_form = was.form if was is not None else None
    # Words, size or start may be others, and what it takes with them.
    return curve if before_form is text else fitted(curve)


def _taken_along(curve: Curve, along: Along, was: Curve | None, course: Sequence[Piece]) -> Ground | None:
    """Return the ground of a text that was moved as its curve was; None for one that was not."""
    old = along_of(was) if was is not None else None
    if was is None or old is None or old.of != along.of:
        return None
    by = after(_ground_of(curve), inverse_of(_ground_of(was)))
    ground = after(by, old.ground)
    if is_near(by_ground(ground, course), old.pieces) and is_near(along.pieces, old.pieces):
        return ground
    return None


def _ground_of(curve: Curve) -> Ground:
    assert isinstance(curve.form, Lettering)
    plane = plane_of(curve.form, corners_of(curve))
    return (plane.x, plane.y, *plane.across, *plane.down)


def by_ground(ground: Ground, course: Sequence[Piece]) -> tuple[Piece, ...]:
    """Return a course in the units that lead to the plane so."""
    back = inverse_of(ground)
    return tuple(tuple(place_by(back, place) for place in piece) for piece in course)  # type: ignore[misc]


def is_near(one: Sequence[Piece], other: Sequence[Piece]) -> bool:
    """Whether two courses are the same, but for rounding."""
    if len(one) != len(other):
        return False
    here, there = np.array(one), np.array(other)
    size = float(np.ptp(here.reshape(-1, 2), axis=0).max())
    return bool(np.abs(here - there).max() <= _NEAR * size)


def straightened(curve: Curve) -> Curve:
    """Return a text that lies along nothing any more: straight, from where it was anchored."""
    along, text = along_of(curve), curve.form
    assert along is not None
    assert isinstance(text, Lettering)
    x, y = course_of(along.course).place(start_of(along))
    lines = tuple(replace(line, x=line.x + x, y=line.y + y) for line in text.lines)
    return fitted(replace(curve, form=replace(text, lines=lines, along=None)))
