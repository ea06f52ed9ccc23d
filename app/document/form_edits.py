"""Curves made of forms: a rectangle, an ellipse. No Qt, no arrays."""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec.structs import replace

from ..families import HERMITE
from .curve_edits import free_name, fresh_curve, is_numbered, replace_curve
from .forms import AnyForm
from .layers import front_of, in_front, without
from .limits import checked_vector
from .model import Curve, Document, Parametrization, ParametrizationKind, Point, Vector
from .style import Style
from .ties import holds, tied
from .transforms import IDENTITY, Affine

_SMOOTH = 1e-12
"""Share of a velocity by which the two at a point differ where roundings alone make them two."""


def drawn_place(document: Document, active: int, layer: str = "") -> int:
    """Return the place of a form that is drawn: in front in a layer, an empty active curve left out."""
    return front_of(_rest(document, active), layer).place


def with_form_drawn(
    document: Document, active: int, form: AnyForm, style: Style, layer: str = ""
) -> Document:
    """Return the document with a closed cubic curve that is a form, at its place.

    It has a style and the rules of the active curve, or is that one where it is empty.
    """
    model, rest = document.curves[active], _rest(document, active)
    if rest is not document:
        curve = replace(model, parametrization=Parametrization(), visible=True)
    else:
        curve = fresh_curve(document, replace(model, style=style), Parametrization())
    if is_numbered(curve.name):
        curve = replace(curve, name=free_name(rest, form.word.capitalize()))
    front = front_of(rest, layer)
    made = in_front(rest, front, curve)
    return replace_curve(made, front.place, formed_anew(made.curves[front.place], form))


def _rest(document: Document, active: int) -> Document:
    """Return the document without the curve that is edited where that becomes the one that is drawn."""
    return without(document, active) if _is_taken(document.curves[active]) else document


def _is_taken(active: Curve) -> bool:
    """Whether the curve that is edited becomes the one that is drawn: it is empty."""
    return not active.points and not active.locked


def formed_anew(curve: Curve, form: AnyForm, by: Affine = IDENTITY) -> Curve:
    """Return a curve that runs as a form that was mapped.

    Its parameters are spaced by its sides.
    """
    rule = curve.parametrization
    if rule.kind is not ParametrizationKind.CHORD_LENGTH:
        rule = Parametrization()
    curve = replace(curve.with_family(HERMITE), closed=True, parametrization=rule, form=form)
    return replace(curve, points=_points(form, by, rule.end - rule.start))


def _points(form: AnyForm, by: Affine, span: float) -> tuple[Point, ...]:
    """Return the points of a form whose parameters span an interval by the lengths of the chords."""
    pieces = [[by.point(each) for each in piece] for piece in form.pieces]
    chords = [math.dist(piece[0], piece[3]) for piece in pieces]
    whole = sum(chords)
    # A handle is p ± h v / 3.
    factors = [3.0 * whole / (chord * span) for chord in chords]
    return tuple(
        _point(piece[0], _way(pieces[at - 1][2:], factors[at - 1]), _way(piece, factors[at]))
        for at, piece in enumerate(pieces)
    )


def _way(ends: Sequence[Vector], factor: float) -> Vector:
    (x, y), (to_x, to_y) = ends[:2]
    return checked_vector((factor * (to_x - x), factor * (to_y - y)), "a velocity")


def _point(place: Vector, before: Vector, after: Vector) -> Point:
    x, y = checked_vector(place, "a point")
    if math.dist(before, after) <= _SMOOTH * math.hypot(*after):
        return Point(x, y, velocity=after)
    corner = Point(x, y, velocity=before, corner=True, velocity_after=after)
    return tied(corner, before, after) if holds(corner) else corner
