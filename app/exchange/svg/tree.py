"""The curves of a drawing as elements of SVG: paths in their groups, with names and ids."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile

import numpy as np

from curvecore.arrays import FloatArray

from ..drawing.drawing import Drawing
from ..drawing.outlines import Outline
from ..drawing.styles import PictureStyle
from ..naming import Names
from ..node_types import guessed, joined
from .clip_elements import ClipElements
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
    clips
        What it is cut by.

    Of the drawing's layers it says whether all in them is hidden or locked; empty ones are written, too.
    """

    def __init__(
        self,
        style: PictureStyle,
        drawing: Drawing,
        shapes: Sequence[tuple[Outline, ...]],
    ) -> None:
        self._style, self._usual_width, self._shapes = style, drawing.usual_width, shapes
        self._layers = {name: _LayerState() for name in drawing.layers}
        self._empty = [each for each in drawing.empty_layers if each.name in self._layers]
        for each in self._empty:
            self._layers[each.name] = _LayerState(is_hidden=not each.visible, is_locked=each.locked)
        for outline in (each for shape in shapes for each in shape):
            for name in self._layers_of(outline):
                self._layers[name].add(outline)
        self._open: tuple[str, ...] = ()
        self._own_ids: dict[int, str] = {}
        self._ids = Names({*NO_CURVES, PAGE}, between="_")
        self.clips = ClipElements(self._ids)
        self.lines: list[str] = []

    @property
    def definitions(self) -> list[str]:
        """What paints what was written and cuts it, in an element of their own."""
        found = [*self.clips.lines]
        return ["  <defs>", *found, "  </defs>"] if found else []

    def add(self, place: int) -> None:
        """Write the outlines of a shape as one path, or what it is the frame of."""
        first = self._shapes[place][0]
        self._go_into(first.groups)
        # What a layer says goes for all in it.
        unseen = ' display="none"' if self._is_unseen(first) else ""
        around = [self._layers[name] for name in self._layers_of(first)]
        locked = _LOCKED if first.locked and not any(each.is_locked for each in around) else ""
        called, more = self._called(place), f"{unseen}{locked}"
        self._write(self._drawn(self._shapes[place], called, f"{more}/>"))

    def _drawn(self, shape: tuple[Outline, ...], called: str, end: str) -> str:
        """Return the element that draws a shape."""
        first = shape[0]
        style = style_attributes(first.style, self._style, self._usual_width)
        clips = first.style.clips
        cut = f' clip-path="{self.clips.reference(clips[:1])}"' if clips else ""
        runs = f' d="{path_data(shape)}"{_node_types_of(shape)}'
        return self.clips.around(f"<path{called}{runs}{style}{cut}{end}", clips[1:])

    def _is_unseen(self, outline: Outline) -> bool:
        """Whether a shape itself is hidden, and not a layer around it."""
        return not outline.visible and not any(
            self._layers[name].is_hidden for name in self._layers_of(outline)
        )

    def close(self) -> None:
        """Close all groups."""
        self._go_into(())
        self._add_empty("")

    def _go_into(self, groups: tuple[str, ...]) -> None:
        common = 0
        while groups[common : common + 1] == self._open[common : common + 1] != ():
            common += 1
        while len(self._open) > common:
            self._add_empty(self._open[-1])
            self._open = self._open[:-1]
            self._write("</g>")
        for name in groups[common:]:
            if name in self._layers:
                self._add_empty(self._open[-1] if self._open else "", before=name)
            self._write(self._layer(name) if name in self._layers else f"<g{self._group(name)}>")
            self._open = (*self._open, name)

    def _add_empty(self, outer: str, before: str = "") -> None:
        """Write the empty layers in an open one, all that are left or those before another one."""
        behind = takewhile(lambda name: name != before, self._layers)
        for each in [
            each for name in behind for each in self._empty if (each.name, each.inside) == (name, outer)
        ]:
            self._empty.remove(each)
            self._write(self._layer(each.name))
            self._open = (*self._open, each.name)
            self._add_empty(each.name)
            self._open = self._open[:-1]
            self._write("</g>")

    def _layer(self, name: str) -> str:
        """Return the tag that opens a layer; one in another says only what that does not."""
        state, around = self._layers[name], [self._layers[each] for each in self._open]
        own = self._ids.different(stem(name, "layer"))
        tag = f'<g id="{own}" inkscape:groupmode="layer" inkscape:label="{quoted(name)}"'
        if state.is_locked and not any(each.is_locked for each in around):
            tag += _LOCKED
        if state.is_hidden and not any(each.is_hidden for each in around):
            tag += ' style="display:none"'
        return f"{tag}>"

    def _layers_of(self, outline: Outline) -> Iterator[str]:
        return takewhile(self._layers.__contains__, outline.groups)

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


class _LayerState:
    """Whether all in a layer is hidden, and whether all is locked; of an empty one, what it says itself."""

    def __init__(self, *, is_hidden: bool = False, is_locked: bool = False) -> None:
        self.is_hidden, self.is_locked, self._is_empty = is_hidden, is_locked, True

    def add(self, outline: Outline) -> None:
        """Take note of something in it."""
        self.is_hidden = not outline.visible and (self._is_empty or self.is_hidden)
        self.is_locked = outline.locked and (self._is_empty or self.is_locked)
        self._is_empty = False


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
