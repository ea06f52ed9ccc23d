"""Styles as options of a path in TikZ."""

from __future__ import annotations

from ..document.style import FillRule, LineCap, LineJoin, Style

_CAPS = {LineCap.BUTT: "butt", LineCap.ROUND: "round", LineCap.SQUARE: "rect"}


def tikz_command(style: Style, *, has_lengths: bool = True) -> str:
    r"""Return ``\draw`` or ``\fill`` with its options; without lengths where no centimetre is one of them.

    A line of the usual width has that of TikZ.
    """
    pairs = [f"line join={style.join.value}"] if style.has_stroke else []
    if style.has_stroke and style.stroke:
        pairs.append(f"{'draw' if style.has_fill else 'color'}={_colour(style.stroke)}")
    if style.has_fill:
        pairs.append(f"fill={_colour(style.fill) if style.fill else 'black'}")
        pairs += ["even odd rule"] if style.fill_rule is FillRule.EVENODD else []
    if style.has_stroke and has_lengths and style.width is not None:
        pairs += _of_line(style, style.width)
    pairs += _opacities(style)
    return rf"\{'draw' if style.has_stroke else 'fill'}[{', '.join(pairs)}]"


def _of_line(style: Style, width: float) -> list[str]:
    pairs = [f"line width={_length(width)}", f"line cap={_CAPS[style.cap]}"]
    if style.join is LineJoin.MITER:
        pairs.append(f"miter limit={style.miter_limit:g}")
    if style.dash:
        lengths = enumerate(style.dashes_and_gaps)
        words = (f"{'off' if i % 2 else 'on'} {_length(each * width)}" for i, each in lengths)
        pairs.append(f"dash pattern={' '.join(words)}")
        pairs += [f"dash phase={_length(style.dash_offset * width)}"] if style.dash_offset else []
    return pairs


def _opacities(style: Style) -> list[str]:
    shares = {"draw": style.stroke_opacity, "fill": style.fill_opacity}
    shown = {"draw": style.has_stroke, "fill": style.has_fill}
    return [f"{name} opacity={share:.4g}" for name, share in shares.items() if shown[name] and share < 1]


def _colour(code: str) -> str:
    red, green, blue = bytes.fromhex(code[1:])
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"


def _length(centimetres: float) -> str:
    return f"{centimetres:.5g}cm" if abs(centimetres) >= 1e-4 or centimetres == 0 else "0.0001cm"
