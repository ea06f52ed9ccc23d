"""Forms as the elements that SVG has for them, rectangles, circles, ellipses, or as Inkscape notes them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from curvecore.arrays import FloatArray

from ...document.form import Form
from ...document.forms import AnyForm, Ellipse, Rectangle, Star
from ...document.model import MAX_MAGNITUDE
from ...document.transforms import Affine
from ...view_model.shapes.formed import Formed, settled
from .inkscape_forms import arc_attributes, star_attributes
from .numbers import number

Element = tuple[str, Mapping[str, float]]
"""A tag, and its attributes."""

_RIGID = 1e-9
_DIGITS, _NOISE = 15, 1e-14
_UPSIDE_DOWN = np.diag([1.0, -1.0])


def form_of_lengths(tag: str, lengths: list[float | None]) -> AnyForm | None:
    """Return what a rect, circle or ellipse that is drawn is by its lengths, y turned up; None for others."""
    values = [0.0 if value is None else value for value in lengths]
    if tag == "rect":
        x, y, width, height = values[:4]
        rx, ry = (own if own is not None else other or 0.0 for own, other in (lengths[4:], lengths[:3:-1]))
        form: Rectangle | Ellipse = Rectangle(
            x, -(y + height), width, height, min(rx, width / 2), min(ry, height / 2)
        )
    elif tag in ("circle", "ellipse"):
        first, second = lengths[2], lengths[-1]
        rx, ry = (
            own if own is not None else other or 0.0 for own, other in ((first, second), (second, first))
        )
        form = Ellipse(values[0] - rx, -(values[1] + ry), 2 * rx, 2 * ry)
    else:
        return None
    largest = max(abs(value) for value in (form.x, form.y, form.width, form.height))
    return form if largest <= MAX_MAGNITUDE and form.width > 0 < form.height else None


def _rect(form: Rectangle) -> Element:
    rx, ry = form.radii
    size = {"x": form.x, "y": -form.top, "width": form.width, "height": form.height}
    return "rect", size if not rx else {**size, "rx": rx, "ry": ry}


def _round(form: Ellipse) -> Element:
    x, y = form.middle
    if form.width == form.height:
        return "circle", {"cx": x, "cy": -y, "r": form.width / 2}
    return "ellipse", {"cx": x, "cy": -y, "rx": form.width / 2, "ry": form.height / 2}


_ELEMENTS: Mapping[type[Form], Callable[..., Element]] = {Rectangle: _rect, Ellipse: _round}
"""What each kind goes out as that SVG has an element for."""


FORMS = ("rect", "circle", "ellipse")


def mapped(now: Formed | None, matrix: FloatArray) -> Formed | None:
    """Return a form after a map of SVG, (2, 3), y down; None where it is none of its kind any more."""
    if now is None:
        return None
    linear, shift = _UPSIDE_DOWN @ matrix[:, :2], _UPSIDE_DOWN @ matrix[:, 2]
    by = now.by
    before = np.array([[1 + by.xx, by.xy], [by.yx, 1 + by.yy]])
    place = linear @ by.point((now.form.x, now.form.y)) + shift
    return settled(now.form, linear @ before, place, float(np.abs(place).max()))


def element_of(
    formed: Formed | None, *, as_path: bool = False
) -> tuple[str, dict[str, str], FloatArray | None] | None:
    """Return the tag, the attributes and the transform of a form; None where it is no more than a path.

    That is where it is skewed, since a line drawn around it would be, too. What Inkscape alone knows is a
    path to SVG, and its course is still to be said; so may all be that it knows as one.
    """
    if formed is None or (matrix := _rigid(formed.by)) is None:
        return None
    if isinstance(formed.form, Star):
        return "path", star_attributes(formed), None
    if as_path:
        # Turned, it would begin elsewhere.
        is_noted = np.array_equal(matrix, np.eye(2, 3))
        form = formed.form
        return ("path", arc_attributes(form), None) if is_noted and isinstance(form, Ellipse) else None
    tag, numbers = _ELEMENTS[type(formed.form)](formed.form)
    is_turned = not np.array_equal(matrix, np.eye(2, 3))
    return tag, {name: number(value) for name, value in numbers.items()}, matrix if is_turned else None


def _rigid(by: Affine) -> FloatArray | None:
    """Return a turn or a mirror image as a matrix of SVG, (2, 3), y down; None for another map."""
    linear = np.array([[1 + by.xx, by.xy], [by.yx, 1 + by.yy]])
    if np.abs(linear @ linear.T - np.eye(2)).max() > _RIGID:
        return None
    shift = np.array(by.point((0.0, 0.0)))
    # Without what is rounding beside the numbers that it was computed of.
    shift[np.abs(shift) <= _NOISE * np.abs(by.centre).max()] = 0.0
    return np.column_stack([_UPSIDE_DOWN @ linear.round(_DIGITS) @ _UPSIDE_DOWN, _UPSIDE_DOWN @ shift])


def matrix_text(matrix: FloatArray) -> str:
    """Return a matrix as a transform."""
    return f"matrix({' '.join(number(float(value)) for value in matrix.T.flat)})"
