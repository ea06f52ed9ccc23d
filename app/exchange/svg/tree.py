"""The curves of a drawing as elements of SVG: paths in their groups, with names, ids and styles."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ...document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from ..drawing.outlines import Outline
from ..drawing.styles import PictureStyle
from ..naming import Names
from ..node_types import guessed, joined
from .numbers import number, quoted
from .our_own import NO_CURVES

_ROUNDING = 4 * np.finfo(float).eps
_NOT_IN_ID = r"[^A-Za-z0-9_.-]+"


class Tree:
    """Lines of SVG for shapes, one after the other; each opens and closes the groups that it has to.

    Parameters
    ----------
    style
        Of the picture.
    usual_width
        Of a stroke whose style does not say it.

    Attributes
    ----------
    lines
        What was written so far.
    """

    def __init__(self, style: PictureStyle, usual_width: float) -> None:
        self._style, self._usual_width = style, usual_width
        self._open: tuple[str, ...] = ()
        self._ids = Names(NO_CURVES, between="_")
        self.lines: list[str] = []

    def add(self, shape: tuple[Outline, ...]) -> None:
        """Write the outlines of a shape as one path."""
        first = shape[0]
        self._go_into(first.groups)
        called = self._called(first.shape or first.name)
        style = _style_attributes(first.style, self._style, self._usual_width)
        unseen = "" if first.visible else ' display="none"'
        locked = ' sodipodi:insensitive="true"' if first.locked else ""
        self._write(f'<path{called} d="{path_data(shape)}"{_node_types(shape)}{style}{unseen}{locked}/>')

    def close(self) -> None:
        """Close all groups."""
        self._go_into(())

    def _go_into(self, groups: tuple[str, ...]) -> None:
        common = 0
        while groups[common : common + 1] == self._open[common : common + 1] != ():
            common += 1
        while len(self._open) > common:
            self._open = self._open[:-1]
            self._write("</g>")
        for name in groups[common:]:
            self._write(f"<g{self._called(name)}>")
            self._open = (*self._open, name)

    def _write(self, element: str) -> None:
        self.lines.append("  " * (len(self._open) + 1) + element)

    def _called(self, name: str) -> str:
        """Return an id of its own and, where the name is another word, that as Inkscape's label."""
        own = self._ids.different(_as_id(name))
        return f' id="{own}"' + (f' inkscape:label="{quoted(name)}"' if name and name != own else "")


def _as_id(name: str) -> str:
    """Return a name as an id may be."""
    word = re.sub(_NOT_IN_ID, "_", name).strip("_.-")
    return word if word[:1].isalpha() else f"curve_{word}".rstrip("_")


def _node_types(shape: tuple[Outline, ...]) -> str:
    """Return of what kinds the points are, as an attribute; nothing where one would take them for these."""
    words = joined([(each.letters, each.closed) for each in shape])
    taken = [(guessed(each.control_points, closed=each.closed), each.closed) for each in shape]
    return f' sodipodi:nodetypes="{words}"' if words and joined(taken) != words else ""


def path_data(shape: Iterable[Outline], *, has_lines: bool = True) -> str:
    """Return the pieces of outlines as path data, y negated, one piece per line; if need be all as cubics."""
    return "\n      ".join(line for outline in shape for line in _data_lines(outline, has_lines))


def _data_lines(outline: Outline, has_lines: bool) -> Iterator[str]:
    control_points = outline.control_points
    start, *_ = control_points[0].tolist()
    yield f"M {pair(start)}"
    for piece, is_line in zip(control_points.tolist(), _are_lines(control_points), strict=True):
        yield (
            f"L {pair(piece[3])}"
            if is_line and has_lines
            else f"C {' '.join(pair(point) for point in piece[1:])}"
        )
    # Closed, the stroke has a join at the seam like everywhere else.
    if outline.closed:
        yield "Z"


def _are_lines(pieces: FloatArray) -> list[bool]:
    """Whether each piece (k, 4, 2) runs straight and evenly from its start to its end, but for rounding.

    A handle is as long as velocity times parameters, and these are rounded as parts of the whole length.
    """
    start, end = pieces[:, 0], pieces[:, 3]
    third = (end - start) / 3
    off = np.abs(pieces[:, 1:3] - np.stack([start + third, end - third], axis=1)).max(axis=(1, 2))
    length = np.hypot(*(end - start).T).sum()
    return list(off <= _ROUNDING * (np.abs(pieces).max(axis=(1, 2)) + length))


def pair(point: list[float]) -> str:
    """Return a point, y negated."""
    x, y = point
    return f"{number(x)} {number(-y)}"


def _style_attributes(style: Style, picture: PictureStyle, usual_width: float) -> str:
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
