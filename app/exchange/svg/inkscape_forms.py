"""Stars, polygons and ellipses that are paths to SVG, and more to Inkscape by what it notes beside them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace

import numpy as np

from curvecore.arrays import FloatArray

from ...document.forms import CORNERS, RATIOS, AnyForm, Ellipse, Star
from ...document.model import MAX_MAGNITUDE
from ...view_model.shapes.formed import Formed
from .names import SODIPODI
from .numbers import number
from .path_data import Subpath

_NEAR = 1e-5
"""Of its extent: as far may the digits that a program writes take a form."""
_EXACT = 1e-9
_DIGITS = 12


def star_attributes(formed: Formed) -> dict[str, str]:
    """Return what Inkscape notes of a star or polygon, y down; it is turned or mirrored at most."""
    star = formed.form
    assert isinstance(star, Star)
    (x, y), (to_x, to_y) = (formed.by.point(each) for each in ((star.x, star.y), star.handles[0].place))
    angle, half = math.atan2(y - to_y, to_x - x), math.pi / star.corners
    inner = star.radius * (math.cos(half) if star.is_polygon else star.ratio)
    places = {"cx": x, "cy": -y, "r1": star.radius, "r2": inner, "arg1": angle, "arg2": angle + half}
    return {
        "sodipodi:type": "star",
        "inkscape:flatsided": "true" if star.is_polygon else "false",
        "sodipodi:sides": number(star.corners),
        **{f"sodipodi:{name}": number(value) for name, value in places.items()},
        "inkscape:rounded": "0",
        "inkscape:randomized": "0",
    }


def arc_attributes(ellipse: Ellipse) -> dict[str, str]:
    """Return what Inkscape notes of an ellipse that is a path to SVG, y down."""
    x, y = ellipse.middle
    numbers = {"cx": x, "cy": -y, "rx": ellipse.width / 2, "ry": ellipse.height / 2}
    return {"sodipodi:type": "arc", **{f"sodipodi:{name}": number(each) for name, each in numbers.items()}}


def as_forms(element: ET.Element, subpaths: list[Subpath]) -> list[Subpath]:
    """Return the outline of a path as the form that Inkscape notes of it, where it draws just that."""
    if len(subpaths) != 1 or (read := _FORMS.get(element.get(f"{SODIPODI}type", ""))) is None:
        return subpaths
    controls = subpaths[0].controls
    extent = float(np.ptp(controls.reshape(-1, 2), axis=0).max()) if len(controls) else 0.0
    with suppress(ValueError):
        for form, is_mirrored in read(element, len(controls)):
            drawn = _drawn(form, is_mirrored=is_mirrored)
            off = np.abs(drawn - controls).max() if drawn.shape == controls.shape else np.inf
            if off <= _NEAR * extent:
                # The digits of its numbers are more than those of the path, which are steps added up.
                pieces = controls if off <= _EXACT * extent else drawn
                return [replace(subpaths[0], pieces=[pieces], closed=True, form=form)]
    return subpaths


def _drawn(form: AnyForm, *, is_mirrored: bool) -> FloatArray:
    """Return the pieces of a form, y down, or those of its mirror image about the upright through it."""
    pieces = np.array(form.pieces) * (1.0, -1.0)
    return pieces * (-1.0, 1.0) + (2 * form.x, 0.0) if is_mirrored else pieces


def _stars(element: ET.Element, count: int) -> Iterator[tuple[Star, bool]]:
    """Yield the star that is noted, run through as ours and as Inkscape's are: the other way round."""
    corners, x, y, radius, inner, angle = (
        _number_of(element, name) for name in ("sides", "cx", "cy", "r1", "r2", "arg1")
    )
    ratio = 1.0 if count == corners else _clean(inner / radius) if radius else 0.0
    if not (CORNERS[0] <= corners <= CORNERS[1] and RATIOS[0] <= ratio <= RATIOS[1]) or radius <= 0:
        return
    degrees = _clean(math.degrees(angle))
    yield Star(x, -y, radius, corners, ratio, -degrees), False
    yield Star(x, -y, radius, corners, ratio, 180.0 + degrees), True


def _ellipses(element: ET.Element, _count: int) -> Iterator[tuple[Ellipse, bool]]:
    """Yield the ellipse that is noted."""
    x, y, rx, ry = (_number_of(element, name) for name in ("cx", "cy", "rx", "ry"))
    if rx > 0 < ry:
        yield Ellipse(x - rx, -(y + ry), 2 * rx, 2 * ry), False


_FORMS: Mapping[str, Callable[[ET.Element, int], Iterator[tuple[AnyForm, bool]]]] = {
    "star": _stars,
    "arc": _ellipses,
}
"""How each type of Inkscape's is read, of a path of so many pieces."""


def _number_of(element: ET.Element, name: str) -> float:
    """Return a number that Inkscape notes.

    Raises
    ------
    ValueError
        Without one that a document may hold.
    """
    value = float(element.get(f"{SODIPODI}{name}", ""))
    # Written so that NaN fails.
    if not abs(value) <= MAX_MAGNITUDE:
        raise ValueError(name)
    return value


def _clean(value: float) -> float:
    """Return a number without the digits that its unit of angle, or a division, left."""
    return float(f"{value:.{_DIGITS}g}")
