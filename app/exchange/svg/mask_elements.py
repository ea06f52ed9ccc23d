"""Masks as elements of SVG, in the units of the drawing: what two shapes share is there once."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...document.mask import Mask
from ..naming import Names
from .defined_elements import DefinedElements
from .gradient_elements import own_names
from .numbers import number

_BLACK = "#000000"
_ROUNDING = 1e-9


class MaskElements(DefinedElements):
    """The masks of one file."""

    def __init__(self, ids: Names) -> None:
        super().__init__(ids)
        self._known: dict[tuple[Mask, ...], str] = {}

    def reference(self, masks: tuple[Mask, ...]) -> str:
        """Return what refers to what all of some masks let be seen; "none" of none."""
        if not masks:
            return "none"
        if masks not in self._known:
            rest = self.reference(masks[1:])
            self._known[masks] = name = self._ids.different("mask")
            self.lines += _lines(masks[0], name, rest)
        return f"url(#{self._known[masks]})"

    def around(self, element: str, masks: tuple[Mask, ...]) -> str:
        """Return an element within groups that are masked: one without a name is none of the drawing."""
        for each in masks:
            element = f'<g mask="{self.reference((each,))}">{element}</g>'
        return element


def _lines(mask: Mask, name: str, rest: str) -> Iterator[str]:
    seen = mask.mapped(lambda place: (place[0], -place[1]))
    left, top, width, height = seen.tile.view
    corners = np.array([(left, top, 1), (left + width, top, 1), (left, top + height, 1)])
    corners = np.vstack([corners, corners[1] + corners[2] - corners[0]]) @ np.array(seen.matrix).reshape(3, 2)
    (x, y), (right, bottom) = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    place = zip(("x", "y", "width", "height"), (x, y, right - x, bottom - y), strict=True)
    attributes = "".join(f' {key}="{number(value)}"' for key, value in place)
    body = own_names(mask.tile.body, name).replace("currentColor", _BLACK)
    a, b, c, d, *_ = seen.matrix
    if max(abs(b), abs(c)) > _ROUNDING * max(abs(a), abs(d)):
        # What is turned is no region of its own.
        box = zip(("x", "y", "width", "height"), map(number, seen.tile.view), strict=True)
        rectangle = "".join(f' {key}="{value}"' for key, value in box)
        yield f'    <clipPath id="{name}-region"><rect{rectangle}/></clipPath>'
        body = f'<g clip-path="url(#{name}-region)">{body}</g>'
    if not np.allclose(seen.matrix, (1, 0, 0, 1, 0, 0), rtol=0, atol=_ROUNDING):
        body = f'<g transform="matrix({" ".join(map(number, seen.matrix))})">{body}</g>'
    body = body if rest == "none" else f'<g mask="{rest}">{body}</g>'
    kind = ' style="mask-type:alpha"' if mask.is_alpha else ""
    yield f'    <mask id="{name}" maskUnits="userSpaceOnUse"{attributes}{kind}>{body}</mask>'
