"""The shapes of a file with what shows each, as the reader finds them and as a document wants them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from operator import attrgetter

import numpy as np
from msgspec.structs import astuple, replace

from curvecore import cubic_path
from curvecore.arrays import FloatArray

from ....document.content import Content, Lettering, Picture, rough_box_of
from ....document.contents import plane_of, shortened
from ....document.empty_layer import EmptyLayer
from ....document.style import NO_PAINT, FillRule, Style
from ....document.value import Value
from ....view_model.curve.curve_view import view_of
from ...cubics_in import imported, lines
from ...drawing.outlines import Outline
from ...errors import ExchangeError
from ...node_types import guessed
from ..content_elements import uncut
from ..groups import Drawn, Settled, is_seen, settled, with_line
from ..guides import guides_of
from ..reader import SvgReader
from ..state import Group, State
from ..xml_tree import parsed
from .letter_sizes import in_one_size, same_on_path
from .source import Node, Source, SourceError

_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Wanted:
    """A shape of the document, in the coordinates and the unit of the file.

    Attributes
    ----------
    outlines
        Its outlines; the frame of a text as the reader has it, who has no fonts.
    """

    outlines: tuple[Outline, ...]

    def __post_init__(self) -> None:
        content = self.content
        if isinstance(content, Lettering):
            object.__setattr__(self, "outlines", (_roughly_framed(self.outlines[0], content),))
        elif isinstance(content, Picture) and not content.link:
            object.__setattr__(self, "outlines", (uncut(self.outlines[0]),))

    @property
    def content(self) -> Content | None:
        """The text or the picture that it is the frame of."""
        return self.outlines[0].content

    @property
    def name(self) -> str:
        """What it is called."""
        return self.outlines[0].shape or self.outlines[0].name

    @property
    def groups(self) -> tuple[str, ...]:
        """The names of the groups around it."""
        return self.outlines[0].groups

    @property
    def opacities(self) -> tuple[float, ...]:
        """Those of the groups around it that are seen through."""
        return tuple(each.opacity for each in self.outlines[0].group_looks)

    @property
    def style(self) -> Style:
        """Its style; of a text and of a picture what is drawn of it."""
        style = self.outlines[0].style
        if isinstance(self.content, Picture):
            bare = Style(stroke=NO_PAINT, opacity=style.opacity, clips=style.clips, blur=style.blur)
            return replace(bare, masks=style.masks)
        if self.content is not None:
            return replace(style, fill_rule=FillRule.NONZERO)
        return style

    @property
    def is_named_by_words(self) -> bool:
        """Whether it is called what it shows, as a text without a name is."""
        return self.content is not None and self.name == shortened(self.content.title)

    @property
    def visible(self) -> bool:
        """Whether it is shown."""
        return self.outlines[0].visible

    @property
    def locked(self) -> bool:
        """Whether it is locked."""
        return self.outlines[0].locked

    @property
    def letters(self) -> list[str]:
        """Of what kinds the points of each outline are."""
        return [each.letters for each in self.outlines]

    @property
    def clone_of(self) -> str:
        """The identity of what it is a clone of; empty for none."""
        clone = self.outlines[0].clone
        return clone.of if clone is not None else ""

    @property
    def pieces(self) -> list[FloatArray]:
        """The pieces of each outline, (k, 4, 2)."""
        return [each.control_points for each in self.outlines]

    @property
    def closed(self) -> list[bool]:
        """Of each outline whether it is closed."""
        return [each.closed for each in self.outlines]


@dataclass(frozen=True, eq=False)
class Found:
    """A shape of the file.

    Attributes
    ----------
    drawn
        Its paths.
    node
        What shows it: its element, or the outermost `use` of it.
    around
        The groups around that, the outermost first.
    name, groups
        As the document calls it, and the groups around it.
    opacities
        Those of the groups around it that are seen through.
    """

    drawn: tuple[Drawn, ...]
    node: Node
    around: tuple[Node, ...]
    name: str
    groups: tuple[str, ...]
    opacities: tuple[float, ...] = ()

    @property
    def content(self) -> Content | None:
        """The text or the picture that it is the frame of."""
        form = self.drawn[0].path.form
        return form if isinstance(form, (Lettering, Picture)) else None

    @property
    def is_named_by_words(self) -> bool:
        """Whether it is called what it shows, as a text without a name is."""
        return self.content is not None and self.name == shortened(self.content.title)

    @property
    def style(self) -> Style:
        """Its style."""
        return self.drawn[0].path.look.style

    @property
    def visible(self) -> bool:
        """Whether it is shown."""
        return self.drawn[0].path.look.visible

    @property
    def locked(self) -> bool:
        """Whether it is locked."""
        return self.drawn[0].path.look.locked

    def is_clear_as(self, other: Wanted) -> bool:
        """Whether the groups around it are seen as much as those around a shape of the document."""
        return _are_near(self.opacities, other.opacities)

    @property
    def is_used(self) -> bool:
        """Whether a `use` shows it."""
        return self.drawn[0].state.anchor is not None

    @property
    def depth(self) -> int:
        """How many others it hangs on, each by way of the next: shown by a `use`, or along a path."""
        content = self.content
        is_along = isinstance(content, Lettering) and content.along is not None
        return len(self.drawn[0].state.inside) + is_along

    @property
    def closed(self) -> list[bool]:
        """Of each path whether it is closed."""
        return [each.path.closed for each in self.drawn]

    @property
    def pieces(self) -> list[FloatArray]:
        """The pieces of each path as they stand in the file, (k, 4, 2)."""
        return [each.path.pieces for each in self.drawn]

    @property
    def letters(self) -> list[str]:
        """Of what kinds the points of each path come in."""
        return [
            guessed(each.path.pieces, closed=each.path.closed, letters=each.path.letters)
            for each in self.drawn
        ]

    @cached_property
    def smooth_pieces(self) -> list[FloatArray]:
        """The same as they come in: with smooth joints, without what is a point; none if they cannot."""
        try:
            curves = [curve for each in self.drawn for curve in imported([each.path]).document.curves]
        except ExchangeError:
            return []
        cores = [view_of(curve).curve for curve in curves]
        # They are cubics, which is what a path is at any tolerance.
        return [cubic_path(core, 1.0).control_points for core in cores if core is not None]


class Reading:
    """The shapes of a source.

    Attributes
    ----------
    shapes
        All that are drawn, in their order.
    seen
        Those of them that come in.
    groups
        The names of the groups around those, by their elements.
    states, opacities
        The states around these groups, and how much is seen of them.
    layers, empty_layers
        The elements that are layers, and those of them in which there is no shape.
    nodes, root
        All elements, in the order of the file, and the outermost one as the reader has it.
    sheet, guides
        The size of the file, and its guides.
    """

    def __init__(self, source: Source) -> None:
        root = parsed(source.data)
        self.root, self.nodes, elements = root, list(source.root.walk()), list(root.iter())
        if len(self.nodes) != len(elements):
            raise SourceError("its elements are not found")
        of_element = dict(zip(elements, self.nodes, strict=True))
        reader = SvgReader(root)
        self.sheet, drawn = reader.sheet, reader.drawn()
        self.guides = [(of_element[each], guide) for each, guide in guides_of(root, reader.sheet)]
        seen = [each for each in drawn if is_seen(each)] or [with_line(each) for each in drawn]
        told = settled(seen, reader.layers)
        around = (group for each in seen for group in each.anchor.around.groups)
        groups = dict.fromkeys([*around, *(group for each in reader.layers for group in each)])
        self._take_groups(groups, told, of_element)
        named = {each.element: path.look for each, path in zip(seen, told.paths, strict=True)}

        def found(parts: Sequence[Drawn]) -> Found:
            first, look = parts[0], named.get(parts[0].element)
            around = first.anchor.around.groups
            return Found(
                tuple(parts),
                of_element[first.anchor.element],
                tuple(of_element[each.anchor.element] for each in around if each.anchor is not None),
                (look.shape if look else "") or first.path.name,
                look.groups if look else (),
                tuple(each.opacity for each in look.group_looks) if look else (),
            )

        self.shapes = [found(list(each)) for _, each in groupby(drawn, attrgetter("element"))]
        self.seen = [each for each in self.shapes if each.drawn[0].element in named]

    def _take_groups(
        self, groups: Iterable[Group], told: Settled, of_element: Mapping[ET.Element, Node]
    ) -> None:
        """Take note of the groups that a document has of the file."""
        self.states: dict[Node, State] = {}
        self.opacities: dict[Node, float] = {}
        self.groups: dict[Node, str] = {}
        self.layers: set[Node] = set()
        self.empty_layers: dict[Node, EmptyLayer] = {}
        empty = {each.name: each for each in told.empty_layers}
        for group in groups:
            if group.anchor is not None and group in told.names:
                node = of_element[group.anchor.element]
                self.opacities[node] = group.opacity
                self.states[node], self.groups[node] = group.anchor.around, told.names[group]
                if told.names[group] in empty:
                    self.empty_layers[node] = empty[told.names[group]]
                self.layers |= {node} if group.is_layer else set()


def by_node(reading: Reading) -> dict[Node, list[Found]]:
    """Return the shapes that each element shows; where it shows some that have a paint, these."""
    found: dict[Node, list[Found]] = {}
    for shape in reading.shapes:
        found.setdefault(shape.node, []).append(shape)
    seen = set(reading.seen)
    return {node: [each for each in shapes if each in seen] or shapes for node, shapes in found.items()}


def _roughly_framed(frame: Outline, text: Lettering) -> Outline:
    """Return a text in the frame that a reader without fonts gives it; the letters stay where they are."""
    plane, box = plane_of(text, frame.corners), rough_box_of(text)
    left, top, right, bottom = box
    places = np.array([(left, top), (right, top), (right, bottom), (left, bottom), (left, top)])
    sides = lines(places @ (plane.across, plane.down) + (plane.x, plane.y))
    return replace(frame, control_points=sides, content=replace(text, box=box))


def same_content(found: Found, wanted: Wanted, *, with_course: bool = True) -> bool:
    """Whether a shape of the file is the frame of the same as one of the document, or neither is any.

    Of texts along paths these may count or not.
    """
    one, other = found.content, wanted.content
    if isinstance(one, Lettering) and isinstance(other, Lettering):
        if one.along is not None or other.along is not None:
            is_along = same_on_path(one, other, with_course=with_course)
            return is_along and _are_near(in_one_size(one), in_one_size(other))
        # Words that wrap do so in their frame.
        boxes = (one.box, other.box) if one.flow is not None else ((), ())
        return _are_near((one.lines, one.flow, boxes[0]), (other.lines, other.flow, boxes[1]))
    if isinstance(one, Picture) and isinstance(other, Picture):
        return one.link == other.link if one.link or other.link else one.data == other.data
    return one is other


def _are_near(one: object, other: object) -> bool:
    """Whether two values are the same, but for rounding."""
    if isinstance(one, Value) and isinstance(other, Value):
        return type(one) is type(other) and _are_near(astuple(one), astuple(other))
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(_are_near, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
    return one == other


def same_course(one: Sequence[FloatArray], other: Sequence[FloatArray], room: float) -> bool:
    """Whether pieces are the same, but for rounding."""
    return len(one) == len(other) and all(
        len(a) == len(b) and bool((np.abs(a - b) <= room).all()) for a, b in zip(one, other, strict=True)
    )


def runs_as(found: Found, wanted: Wanted, room: float) -> bool:
    """Whether a shape of the file runs as the document has it."""
    if found.closed != wanted.closed:
        return False
    return same_course(found.pieces, wanted.pieces, room) or same_course(
        found.smooth_pieces, wanted.pieces, room
    )
