"""Styles of clones: those of their originals, as a map takes them along."""

from __future__ import annotations

import math

from msgspec.structs import astuple, replace

from .style import Style
from .transforms import Affine
from .value import Value

_ROUNDING = 1e-6


def style_followed(own: Style, before: Style, after: Style, by: Affine) -> Style:
    """Return the style of a clone whose original looks otherwise now.

    One that looks as its original did goes on to; be it as wide as that, or enlarged with all of it.
    """
    if own == before and not (before.is_placed or after.is_placed):
        return after
    return style_by(after, by) if looks_same(own, style_by(before, by)) else own


def style_by(style: Style, by: Affine) -> Style:
    """Return a style mapped with all that it paints; its line as if the map had scaled evenly."""
    scale = math.sqrt(abs((1.0 + by.xx) * (1.0 + by.yy) - by.xy * by.yx))
    if style.width is not None:
        style = replace(style, width=style.width * scale)
    return style.mapped(by.point)


def looks_same(one: object, other: object) -> bool:
    """Whether two styles, or values of such, are the same but for roundings."""
    if isinstance(one, Value) and isinstance(other, Value):
        one, other = astuple(one), astuple(other)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(looks_same, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
    return one == other
