"""Clones of a drawing as `use` elements of SVG, where these look and run as they do."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.clone_styles import looks_same, style_by
from ...document.style import Style
from ...document.transforms import Affine
from ..drawing.cloned import Cloned, Shape, clones_among
from .form_elements import matrix_text
from .matrices import is_uneven
from .numbers import number

_UPSIDE_DOWN = np.diag([1.0, -1.0])


def used(shapes: Sequence[Shape], usual_width: float, unseen: Iterable[int]) -> Mapping[int, Cloned]:
    """Return the shapes that others are shown as by a `use`, by their places.

    Of its own a `use` says but what what it shows leaves open, which is nothing here: all that is painted is
    enlarged with it. What is `unseen` by itself cannot be shown by others.
    """
    hidden = frozenset(unseen)
    found = clones_among(shapes)
    return {
        place: each
        for place, each in found.items()
        if each.original not in hidden
        and len(shapes[each.original][0].style.clips) < 2
        and _looks_so(shapes[each.original][0].style, each.by, shapes[place][0].style, usual_width)
    }


def _looks_so(original: Style, by: FloatArray, clone: Style, usual_width: float) -> bool:
    if original.has_stroke and is_uneven(by):
        return False
    (xx, xy, x), (yx, yy, y) = by.tolist()
    affine = Affine(xx - 1.0, xy, yx, yy - 1.0, (0.0, 0.0), (x, y))
    wide, other = (
        each.with_usual_width(usual_width) if each.has_stroke else replace(each, width=None)
        for each in (original, clone)
    )
    return looks_same(style_by(wide, affine), other)


def use_attributes(identity: str, by: FloatArray) -> str:
    """Return what a `use` shows, as all programs read it, and where: by a matrix (2, 3), y up."""
    linear, shift = _UPSIDE_DOWN @ by[:, :2] @ _UPSIDE_DOWN, _UPSIDE_DOWN @ by[:, 2]
    if np.array_equal(linear, np.eye(2)):
        transform = f"translate({number(float(shift[0]))} {number(float(shift[1]))})"
    else:
        transform = matrix_text(np.column_stack([linear, shift]))
    return f' xlink:href="#{identity}" transform="{transform}"'
