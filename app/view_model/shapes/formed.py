"""What curves are still of the forms that they were drawn as; moved and turned ones are recognised."""

from __future__ import annotations

import math
from functools import lru_cache

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.curve_edits import replace_curve
from ...document.form import FormHandle
from ...document.form_edits import formed_anew
from ...document.forms import AnyForm
from ...document.model import Curve, Document, Vector
from ...document.transforms import IDENTITY, Affine, least_turn
from ...families import HERMITE
from ..curve.curve_view import view_of

_NEAR = 1e-7
"""Of the extent of a form: as far may roundings take its control points."""
_SAME = 1e-9
_CERTAIN = 12
_NOISE = 1e-13
"""Digits of the largest number that are no rounding, and how much of it rounding may be."""


class Formed(msgspec.Struct, frozen=True):
    """A form where it is now.

    Attributes
    ----------
    form
        What the curve is, as large as it is now.
    by
        What else became of it: a turn, a mirror image, a skew.
    """

    form: AnyForm
    by: Affine

    @property
    def handles(self) -> list[tuple[FormHandle, Vector]]:
        """The handles of the form, and where they are."""
        return [(handle, self.by.point(handle.place)) for handle in self.form.handles]

    @property
    def angle(self) -> float:
        """Degrees by which it is turned; a mirror image, sideways or upside down, is no rotation."""
        return least_turn(self.by)

    def as_drawn(self, place: Vector) -> Vector:
        """Return where a place was before the form was turned."""
        if self.by is IDENTITY:
            return place
        by = self.by
        linear = np.array([[1 + by.xx, by.xy], [by.yx, 1 + by.yy]])
        way = np.array(place) - by.centre - by.shift
        x, y = np.linalg.solve(linear, way)
        return (float(x) + by.centre[0], float(y) + by.centre[1])


@lru_cache(maxsize=4096)
def _found(curve: Curve) -> Formed | None:
    form, pieces = curve.form, pieces_of(curve)
    if form is None or pieces is None:
        return None
    made = np.array(form.pieces)
    if made.shape != pieces.shape:
        return None
    here, there = made.reshape(-1, 2), pieces.reshape(-1, 2)
    extent = float(np.ptp(there, axis=0).max())
    if np.abs(here - there).max() <= 1e-12 * extent:
        return Formed(form, IDENTITY)
    middle = here.mean(axis=0)
    linear = np.linalg.lstsq(here - middle, there - there.mean(axis=0), rcond=None)[0].T
    shift = there.mean(axis=0) - linear @ middle
    if np.abs(here @ linear.T + shift - there).max() > _NEAR * extent:
        return None
    return settled(form, linear, linear @ (form.x, form.y) + shift, float(np.abs(there).max()))


def settled(form: AnyForm, linear: FloatArray, place: FloatArray, largest: float) -> Formed | None:
    """Return a form that was mapped: as large and at the place that it has now, and the rest of the map."""
    area = abs(float(np.linalg.det(linear)))
    across, up = np.hypot(*linear)
    if area <= _SAME * across * up:
        return None
    if not form.stretches:
        across = up = math.sqrt(area)
    across, up = (1.0 if abs(each - 1.0) <= _SAME else float(each) for each in (across, up))
    x, y = (_clean(float(each), largest) for each in place)
    (xx, xy), (yx, yy) = (linear / (across, up) - np.eye(2)).tolist()
    now = form if across == up == 1.0 else _cleaned(form.scaled(across, up), largest)
    is_rest = max(map(abs, (xx, xy, yx, yy))) > _SAME
    return Formed(now.at((x, y)), Affine(xx, xy, yx, yy, (x, y)) if is_rest else IDENTITY)


def _cleaned(form: AnyForm, largest: float) -> AnyForm:
    """Return a form whose lengths are without the digits that are rounding."""
    names = [each.name for each in form.fields if each.is_length and each.name in form.__struct_fields__]
    lengths = {name: getattr(form, name) for name in names}
    return msgspec.structs.replace(
        form, **{name: _clean(length, largest) or length for name, length in lengths.items()}
    )


def _clean(value: float, largest: float) -> float:
    """Return a number as the decimal of few digits that it is but for rounding; as it is where it is none."""
    decimals = _CERTAIN - 1 - math.floor(math.log10(max(largest, 1e-300)))
    plain = round(value, decimals) + 0.0
    return plain if abs(plain - value) <= _NOISE * largest else value


def pieces_of(curve: Curve) -> FloatArray | None:
    """Return the control points of a closed cubic curve, (k, 4, 2); None of any other."""
    if curve.family is not HERMITE or not curve.is_closed:
        return None
    view = view_of(curve)
    if not view.is_current:
        return None
    pieces = [each.bezier_pieces() for each in view.pieces]
    found = [each for each in pieces if each is not None]
    return np.concatenate(found) if len(found) == len(pieces) else None


def formed(curve: Curve) -> Formed | None:
    """Return what a curve is of the form that it was drawn as; None where it is no such form any more."""
    return None if curve.form is None else _found(curve)


def with_form(document: Document, place: int, form: AnyForm, by: Affine) -> Document:
    """Return the document with a curve that is another form, mapped as the one before was."""
    return replace_curve(document, place, formed_anew(document.curves[place], form, by))
