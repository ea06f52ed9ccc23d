"""The curves of a drawing as elements of SVG: paths in their groups, with names and ids."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ..drawing.drawing import Drawing
from ..drawing.outlines import Outline
from ..drawing.styles import PictureStyle
from ..naming import Names
from ..node_types import guessed, joined
from .escapes import quoted
from .numbers import number
from .our_own import NO_CURVES, PAGE
from .style_attributes import style_attributes

_ROUNDING = 4 * np.finfo(float).eps
_NOT_IN_ID = r"[^A-Za-z0-9_.-]+"
_LOCKED = ' sodipodi:insensitive="true"'


class Tree:
    """Lines of SVG for shapes, one after the other; each opens and closes the groups that it has to.

    Attributes
    ----------
    lines
        What was written so far.
    """

    def __init__(
        self,
        style: PictureStyle,
        drawing: Drawing,
        shapes: Sequence[tuple[Outline, ...]],
    ) -> None:
        self._style, self._usual_width, self._shapes = style, drawing.usual_width, shapes
        self._open: tuple[str, ...] = ()
        self._own_ids: dict[int, str] = {}
        self._ids = Names({*NO_CURVES, PAGE}, between="_")
        self.lines: list[str] = []

    def add(self, place: int) -> None:
        """Write the outlines of a shape as one path, or what it is the frame of."""
        first = self._shapes[place][0]
        self._go_into(first.groups)
        unseen = "" if first.visible else ' display="none"'
        locked = _LOCKED if first.locked else ""
        called, more = self._called(place), f"{unseen}{locked}"
        self._write(self._drawn(self._shapes[place], called, f"{more}/>"))

    def _drawn(self, shape: tuple[Outline, ...], called: str, end: str) -> str:
        """Return the element that draws a shape."""
        first = shape[0]
        style = style_attributes(first.style, self._style, self._usual_width)
        runs = f' d="{path_data(shape)}"{_node_types_of(shape)}'
        return f"<path{called}{runs}{style}{end}"

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
            self._write(f"<g{self._group(name)}>")
            self._open = (*self._open, name)

    def _write(self, element: str) -> None:
        self.lines.append("  " * (len(self._open) + 1) + element)

    def _group(self, name: str) -> str:
        return _named(name, self._ids.different(stem(name, "curve")))

    def _called(self, place: int) -> str:
        return _named(_name_of(self._shapes[place]), self._id_of(place))

    def _id_of(self, place: int) -> str:
        """Return the id of a shape, which others that show it may ask for first."""
        if place not in self._own_ids:
            self._own_ids[place] = self._ids.different(stem(_name_of(self._shapes[place]), "curve"))
        return self._own_ids[place]


def _name_of(shape: tuple[Outline, ...]) -> str:
    return shape[0].shape or shape[0].name


def _named(name: str, own: str) -> str:
    """Return an id and, where the name is another word, that as Inkscape's label."""
    return f' id="{own}"' + (f' inkscape:label="{quoted(name)}"' if name and name != own else "")


def _node_types_of(shape: tuple[Outline, ...]) -> str:
    """Return of what kinds the points are, as an attribute; nothing where one would take them for these."""
    words = node_types(shape)
    return f' sodipodi:nodetypes="{words}"' if words else ""


def node_types(shape: Sequence[Outline], *, always: bool = False) -> str:
    """Return the letters of a path; none where one would take its points for these, unless `always`."""
    words = joined([(each.letters, each.closed) for each in shape])
    if not words or always:
        return words
    taken = [(guessed(each.control_points, closed=each.closed), each.closed) for each in shape]
    return words if joined(taken) != words else ""


def stem(name: str, kind: str) -> str:
    """Return a name as an id may be."""
    word = re.sub(_NOT_IN_ID, "_", name).strip("_.-")
    return word if word[:1].isalpha() else f"{kind}_{word}".rstrip("_")


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
