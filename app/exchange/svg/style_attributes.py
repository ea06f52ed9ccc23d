"""Styles as attributes of SVG."""

from __future__ import annotations

from ...document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from ..drawing.styles import PictureStyle
from .numbers import number


def style_attributes(style: Style, picture: PictureStyle, usual_width: float) -> str:
    """Return a style as attributes, each after a blank; what SVG takes for granted is left out."""
    pairs = [("fill", picture.fill_of(style) if style.has_fill else NO_PAINT), *_of_fill(style)]
    pairs += _of_stroke(style, picture, usual_width)
    if style.opacity < 1:
        pairs.append(("opacity", number(style.opacity)))
    return "".join(f' {name}="{value}"' for name, value in pairs)


def _of_fill(style: Style) -> list[tuple[str, str]]:
    pairs = []
    if style.has_fill and style.fill_rule is not FillRule.NONZERO:
        pairs.append(("fill-rule", str(style.fill_rule.value)))
    if style.has_fill and style.fill_opacity < 1:
        pairs.append(("fill-opacity", number(style.fill_opacity)))
    return pairs


def _of_stroke(style: Style, picture: PictureStyle, usual_width: float) -> list[tuple[str, str]]:
    if not style.has_stroke:
        return []
    width = usual_width if style.width is None else style.width
    pairs = [("stroke", picture.stroke_of(style)), ("stroke-width", number(width))]
    if style.cap is not LineCap.BUTT:
        pairs.append(("stroke-linecap", str(style.cap.value)))
    if style.join is not LineJoin.MITER:
        pairs.append(("stroke-linejoin", str(style.join.value)))
    elif style.miter_limit != 4:
        pairs.append(("stroke-miterlimit", number(style.miter_limit)))
    if style.dash:
        pairs.append(("stroke-dasharray", " ".join(number(each * width) for each in style.dash)))
    if style.dash and style.dash_offset:
        pairs.append(("stroke-dashoffset", number(style.dash_offset * width)))
    if style.stroke_opacity < 1:
        pairs.append(("stroke-opacity", number(style.stroke_opacity)))
    return pairs
