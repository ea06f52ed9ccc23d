"""Styles as attributes of SVG."""

from __future__ import annotations

from collections.abc import Sequence

from ...document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from ..drawing.styles import PictureStyle
from .numbers import number


def style_attributes(
    style: Style,
    picture: PictureStyle,
    usual_width: float,
) -> str:
    """Return a style as attributes, each after a blank; what SVG takes for granted is left out."""
    pairs = [("fill", picture.fill_of(style) if style.has_fill else NO_PAINT), *_of_fill(style)]
    pairs += _of_stroke(style, picture.stroke_of(style), usual_width)
    return "".join(f' {name}="{value}"' for name, value in pairs)


def dash_style(dashes: Sequence[float], offset: float = 0.0) -> str:
    """Return lengths of dashes and gaps as CSS.

    As attributes Inkscape leaves them as they are when it enlarges a stroke, be it that a drawing in pixels
    is pasted into one in millimetres; of CSS it enlarges both.
    """
    css = f"stroke-dasharray:{','.join(map(number, dashes))}"
    return f"{css};stroke-dashoffset:{number(offset)}" if offset else css


def _of_fill(style: Style) -> list[tuple[str, str]]:
    pairs = []
    if style.has_fill and style.fill_rule is not FillRule.NONZERO:
        pairs.append(("fill-rule", str(style.fill_rule.value)))
    if style.has_fill and style.fill_opacity < 1:
        pairs.append(("fill-opacity", number(style.fill_opacity)))
    return pairs


def _of_stroke(style: Style, paint: str, usual_width: float) -> list[tuple[str, str]]:
    if not style.has_stroke:
        return []
    width = usual_width if style.width is None else style.width
    pairs = [("stroke", paint), ("stroke-width", number(width))]
    if style.cap is not LineCap.BUTT:
        pairs.append(("stroke-linecap", str(style.cap.value)))
    if style.join is not LineJoin.MITER:
        pairs.append(("stroke-linejoin", str(style.join.value)))
    elif style.miter_limit != 4:
        pairs.append(("stroke-miterlimit", number(style.miter_limit)))
    if style.stroke_opacity < 1:
        pairs.append(("stroke-opacity", number(style.stroke_opacity)))
    if style.dash:
        dashes = [each * width for each in style.dash]
        pairs.append(("style", dash_style(dashes, style.dash_offset * width)))
    return pairs
