"""Blurs as filters of SVG, as Inkscape writes them: what two shapes share is there once."""

from __future__ import annotations

import math

from curvecore.arrays import FloatArray

from ...document.style import BLUR_REACH
from ..naming import Names
from .defined_elements import DefinedElements
from .numbers import number

_STEPS = 100
"""Parts of the size of a shape in which the room around it is told: more of it than needed does no harm."""


class FilterElements(DefinedElements):
    """The filters of one file."""

    def __init__(self, ids: Names) -> None:
        super().__init__(ids)
        self._known: dict[tuple[float, str], str] = {}

    def reference(self, deviation: float, corners: FloatArray, overhang: float) -> str:
        """Return what refers to a blur of a shape, "none" of none.

        Parameters
        ----------
        deviation
            The standard deviation.
        corners
            The least and the largest coordinates of the shape in its own units, (2, 2).
        overhang
            How far its line reaches beyond them.
        """
        if deviation <= 0:
            return "none"
        key = (deviation, _region(corners, BLUR_REACH * deviation + overhang))
        if key not in self._known:
            self._known[key] = name = self._ids.different("blur")
            self.lines += [
                f'    <filter id="{name}"{key[1]} style="color-interpolation-filters:sRGB">',
                f'      <feGaussianBlur stdDeviation="{number(deviation)}"/>',
                "    </filter>",
            ]
        return f"url(#{self._known[key]})"


def _region(corners: FloatArray, reach: float) -> str:
    """Return the attributes of a region as far around a shape: as shares of its size, if it has one."""
    (left, top), (right, bottom) = corners.tolist()
    wide, high = right - left, bottom - top
    if min(wide, high) * _STEPS < reach:
        # A filter that hangs on the box around a straight line draws nothing.
        x, y = number(left - reach), number(top - reach)
        size = f'width="{number(wide + 2 * reach)}" height="{number(high + 2 * reach)}"'
        return f' filterUnits="userSpaceOnUse" x="{x}" y="{y}" {size}'
    x, y = (math.ceil(_STEPS * reach / side) / _STEPS for side in (wide, high))
    return f' x="{-x:g}" y="{-y:g}" width="{1 + 2 * x:g}" height="{1 + 2 * y:g}"'
