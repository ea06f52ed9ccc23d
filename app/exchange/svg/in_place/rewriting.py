"""An SVG file with the changes of a document in it, and everything else as it was.

The file is read as at its import, so that it is known which element each curve came from. What runs and looks
as the document has it stays as it is written; all else is changed as little as it takes: moved, then drawn
anew in its element, then as another one. The result is read once more, and counts only if it is the document.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace as replaced
from enum import IntEnum

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ....document.model import Curve, Document, Vector
from ....document.shapes import shapes
from ....tasks.progress import Report, part, silent
from ...corner import shifted
from ...drawing.cloned import clones_among
from ...drawing.drawing import Drawing, drawing_of
from ...drawing.styles import INK
from ...errors import ExchangeError
from ...formats import Written
from ...naming import Names
from ...rescaled import in_unit
from ..matrices import combined, is_uneven, mean_scale, moved
from ..our_own import OurOwn
from ..sheet import Sheet
from .courses import (
    can_be_redrawn,
    inverse_of,
    is_plain_path,
    motion_of,
    move,
    move_whole,
    note_kinds,
    note_own_data,
    redraw,
)
from .empty_layers import arrange_empty_layers, has_empty_layers, set_empty_layers
from .found import Found, Reading, Wanted, by_node, runs_as, same_content
from .frames import is_unwritten, write_content
from .letters import reword_texts
from .looks import Definitions, Looks, declare_style
from .lost_clones import lost_clones
from .matching import origins
from .on_paths import carriers
from .placing import Placing, definitions, lock, show
from .plan import Plan, Planner
from .sheets import set_guides, set_page
from .source import Node, Source, SourceError

_ROUNDS = 5
_ROUNDING = 1e-9
_log = logging.getLogger("curvebench.exchange")


class Way(IntEnum):
    """How an element is made to be as the document has it."""

    IN_ITS_PLACE = 0
    REDRAWN = 1
    ANEW = 2


def rewritten(
    data: bytes, document: Document, begun: Document | None = None, report: Report = silent
) -> Written | None:
    """Return a file with the changes of a document; None where it cannot be kept.

    Parameters
    ----------
    data
        The file, which was read before.
    document
        What it shall show.
    begun
        What of it came in; without it, all. The rest is left alone.
    report
        Hears how far it has come.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    try:
        base = Reading(Source(data))
    except (SourceError, ExchangeError):
        return None
    own = OurOwn(base.root)
    if own.is_annotated or (own.is_so and base.sheet.page is None):
        # What is beside its curves, or how large it is, hangs on them; and all of it is ours.
        return None
    placed = _in_file(document, base.sheet)
    drawing = drawing_of(placed, None, part(report, 0.0, 0.3), with_hidden=True)
    try:
        result = _Rewriting(data, base, placed, drawing, begun).result(part(report, 0.3, 1.0))
    except (SourceError, ExchangeError, np.linalg.LinAlgError) as problem:
        _log.info("a file is not kept: %s", type(problem).__name__)
        return None
    return None if result is None else replaced(result, deviation=drawing.deviation, remarks=drawing.left_out)


def _in_file(document: Document, sheet: Sheet) -> Document:
    """Return a document in the unit and the plane of a file."""
    own, page = in_unit(document, sheet.unit), sheet.page
    is_usual = page is not None and page.x == 0.0 and page.y == -page.height
    by: Vector = (0.0, -page.height) if page is not None and is_usual else (0.0, 0.0)
    return shifted(own, by) if any(by) else own


class _Rewriting:
    """Rewriting of one file.

    Attributes
    ----------
    base, document, wanted
        The file as it is, and the document with its shapes in the plane of the file.
    room, looks
        By how much courses may differ, and how styles are compared.
    layers
        The names of the layers that the document began with.
    has_rules
        Whether the file has rules of CSS, which outweigh attributes.
    """

    def __init__(
        self, data: bytes, base: Reading, document: Document, drawing: Drawing, begun: Document | None
    ) -> None:
        self._data, self.base, self.document = data, base, document
        shown = drawing.all_shapes
        self.wanted = [Wanted(each) for each in shown]
        self.reach = max(float(np.abs(piece).max()) for each in self.wanted for piece in each.pieces)
        if (page := base.sheet.page) is not None:
            self.reach = max(self.reach, page.width, page.height)
        self.room = _ROUNDING * self.reach
        self.looks = Looks(INK, drawing.usual_width, self.reach)
        self.layers = begun.layers if begun is not None else ()
        before = None if begun is None else self._begun(_in_file(begun, base.sheet))
        known = origins(self.wanted, before, base.seen, self.reach)
        clones = {place: each.original for place, each in clones_among(shown).items()}
        unlinked = self._unlinked(before or (), known.begun)
        self._planner = Planner(
            self.wanted, base, known.pairs, known.taken, document.layers, clones, unlinked
        )
        self.has_rules = b"<style" in data or b":style" in data

    def _begun(self, begun: Document) -> list[Wanted]:
        """Return the shapes that the document began with; those that it still has are not computed again."""
        now = {_curves(self.document, each): place for place, each in enumerate(shapes(self.document.curves))}
        before = [_curves(begun, each) for each in shapes(begun.curves)]
        gone = [each for each in before if each not in now]
        # Only where they run counts.
        curves = tuple(replace(curve, visible=True) for each in gone for curve in each)
        other = drawing_of(replace(begun, curves=curves)).all_shapes if gone else []
        if len(now) != len(self.wanted) or len(other) != len(gone):
            return [Wanted(each) for each in drawing_of(begun, with_hidden=True).all_shapes]
        rest = iter(map(Wanted, other))
        return [self.wanted[now[each]] if each in now else next(rest) for each in before]

    def _unlinked(self, begun: Sequence[Wanted], origin: Mapping[int, int]) -> set[int]:
        """Return the places of those that are clones no more, of what is there still."""
        there = {outline.identity for each in self.wanted for outline in each.outlines}
        return {
            place
            for place, before in origin.items()
            if not self.wanted[place].clone_of and begun[before].clone_of in there - {""}
        }

    def result(self, report: Report) -> Written | None:
        """Return the file; None where it cannot be kept."""
        ways: dict[int, Way] = {}  # by the keys of the entries
        for count in range(_ROUNDS):
            report(count / _ROUNDS, "Writing")
            plan = self._planner.plan({key for key, way in ways.items() if way is Way.ANEW})
            source = Source(self._data)
            wrong = _Round(self, source, plan, ways).wrong
            if not wrong:
                lost = lost_clones(plan, self._planner, self.base.seen, self.wanted, self.room, self.looks)
                return Written(source.data, changes=lost)
            for key in wrong:
                if key is None or ways.get(key) is Way.ANEW:
                    return None
                # A new clone is one, or a path.
                ways[key] = Way(ways.get(key, Way.IN_ITS_PLACE) + 1) if key >= 0 else Way.ANEW
        return None


def _curves(document: Document, places: range) -> tuple[Curve, ...]:
    """Return the curves of a shape."""
    return document.curves[places.start : places.stop]


class _Round:
    """One way through a file.

    Attributes
    ----------
    wrong
        The keys of the entries whose elements are not as the document has them; None for what has none.
    """

    def __init__(self, job: _Rewriting, source: Source, plan: Plan, ways: dict[int, Way]) -> None:
        self._job, self._source, self._plan = job, source, plan
        self._all = list(source.root.walk())
        self._placing = Placing(source, plan.entries, plan.groups, plan.removed, plan.dissolved)
        self._entries = list(zip(plan.entries, self._placing.nodes, strict=True))
        set_page(source, job.base.sheet, job.document.page, job.document.unit)
        placed = Reading(source)
        if self._move_groups(placed):
            placed = Reading(source)
        if self._reword_texts(placed, ways):
            placed = Reading(source)
        set_guides(source, placed, job.document.guides)
        self._definitions = Definitions(Names(source.ids, between="_"))
        self.wrong: list[int | None] = []
        self._adapt_all(placed, ways)
        if not self.wrong:
            reading = Reading(source)
            if set_empty_layers(source, reading, job.document.empty_layers, job.layers):
                reading = Reading(source)
            if arrange_empty_layers(reading, job.document.layers):
                reading = Reading(source)
            self.wrong = self._check(reading)

    # Changes

    def _adapt_all(self, reading: Reading, ways: dict[int, Way]) -> None:
        """Make all elements show what they should; a clone once that which it shows does."""
        entries, shapes = self._entries, by_node(reading)
        self._carriers = carriers(entries, self._job.wanted, shapes)
        depths = {node: found[0].depth for node, found in shapes.items()}
        for depth in sorted({depths.get(node, 0) for _, node in entries}):
            if depth:
                # Where a clone is now, and how it looks, its original says.
                shapes = by_node(Reading(self._source))
            for entry, node in entries:
                if depths.get(node, 0) != depth:
                    continue
                way = ways.get(entry.key, Way.IN_ITS_PLACE) if entry.key is not None else Way.IN_ITS_PLACE
                wanted = [self._job.wanted[each] for each in entry.shapes]
                if not self._adapt(node, shapes.get(node, []), wanted, way):
                    self.wrong.append(entry.key)
            for each in self._source.adopted(self._definitions.taken()):
                each.put_last(definitions(self._source))

    def _reword_texts(self, reading: Reading, ways: dict[int, Way]) -> bool:
        """Make texts say what they should where they are; return whether some said something else."""
        known = {node: entry for entry, node in self._entries if entry.number is not None}
        wanted = {node: [self._job.wanted[each] for each in entry.shapes] for node, entry in known.items()}
        anew = {node for node, entry in known.items() if ways.get(entry.number or 0) is Way.REDRAWN}
        return reword_texts(self._source, by_node(reading), wanted, anew)

    def _move_groups(self, reading: Reading) -> bool:
        """Move groups of which everything moved alike, with what else is in them; return whether some did."""
        shapes, done = by_node(reading), set[str]()
        entries = self._entries
        for name, group in self._plan.groups.items():
            inside = [(entry, node) for entry, node in entries if name in entry.groups]
            if group.number is None or group.is_layer or done & set(inside[0][0].groups):
                continue
            found = [shape for _, node in inside for shape in shapes.get(node, [])]
            wanted = [self._job.wanted[each] for entry, _ in inside for each in entry.shapes]
            if any(runs_as(*pair, self._job.room) for pair in zip(found, wanted, strict=False)):
                continue
            by, node = motion_of(found, wanted, self._job.room), self._placing.groups[name]
            if by is not None and not is_uneven(by) and node in reading.states:
                move_whole(node, reading.states[node].matrix, by)
                done.add(name)
        return bool(done)

    def _adapt(self, node: Node, found: list[Found], wanted: list[Wanted], way: Way) -> bool:
        """Make an element show shapes of the document; return whether it can."""
        if len(found) != len(wanted):
            return False
        by, matrix = np.eye(2, 3), found[0].drawn[0].state.matrix
        is_own = len(wanted) == 1 and not found[0].is_used
        if not all(same_content(*pair) for pair in zip(found, wanted, strict=True)):
            if not is_unwritten(node):
                return False
            matrix = write_content(self._source, node, found[0], wanted[0], self._carriers)
            return self._show_as(node, found[0], wanted[0], by, way, is_alone=True, matrix=matrix)
        if all(runs_as(*pair, self._job.room) for pair in zip(found, wanted, strict=True)):
            if is_own and node.tag == "path" and found[0].letters != wanted[0].letters:
                note_kinds(self._source, node, wanted[0])
        else:
            motion = self._motion(node, found, wanted, way)
            if motion is not None:
                by = motion
                move(node, found[0], by)
            elif not is_own or not can_be_redrawn(node):
                return False
            else:
                redraw(self._source, node, wanted[0], inverse_of(matrix))
        if is_own:
            note_own_data(node, wanted[0])
        return all(
            self._show_as(node, *pair, by, way, is_alone=len(wanted) == 1)
            for pair in zip(found, wanted, strict=True)
        )

    def _motion(self, node: Node, found: list[Found], wanted: list[Wanted], way: Way) -> FloatArray | None:
        """Return how an element is to be moved as it is; None where it is to be drawn anew."""
        # A frame cannot be drawn otherwise.
        is_drawn_anew = way is not Way.IN_ITS_PLACE and found[0].content is None
        if is_drawn_anew or (len(found) == 1 and is_plain_path(node, found[0])):
            return None
        by = motion_of(found, wanted, self._job.room)
        # Where no line shows it, a clone may be stretched; what has its own frame may always.
        has_line = not found[0].is_used or any(each.style.has_stroke for each in wanted)
        stays = found[0].content is None and has_line
        return None if by is None or (stays and is_uneven(by)) else by

    def _show_as(
        self,
        node: Node,
        found: Found,
        wanted: Wanted,
        by: FloatArray,
        way: Way,
        *,
        is_alone: bool,
        matrix: FloatArray | None = None,
    ) -> bool:
        """Give an element that was moved the look of a shape of the document; return whether it can be.

        One that was written new may have another map to the plane of the file.
        """
        drawn, stretch = found.drawn[0], mean_scale(by)
        scale = drawn.scale if matrix is None else mean_scale(matrix)
        matrix = drawn.state.matrix if matrix is None else matrix
        style = (
            found.style
            if found.style.width is None
            else replace(found.style, width=found.style.width * stretch)
        )
        style = style.mapped(lambda place: _pair(moved(np.array(place), by)))
        # A gradient may hang on the box around the element, which is another one now.
        parts = self._job.looks.differing_of(node, style, wanted.style, with_gradients=way is Way.REDRAWN)
        if (parts and found.is_used) or ((parts or found.visible != wanted.visible) and not is_alone):
            return False
        if parts:
            inverse = inverse_of(combined(by, matrix))
            around = drawn.anchor.around
            values = self._job.looks.properties(
                wanted.style, parts, inverse, scale * stretch, around, self._definitions, wanted.pieces
            )
            declare_style(node, parts, values, around.properties.values, has_rules=self._job.has_rules)
        if found.visible != wanted.visible:
            show(node, wanted.visible)
        if found.locked != wanted.locked:
            lock(self._source, node, wanted.locked)
        return True

    # What came of it

    def _check(self, reading: Reading) -> list[int | None]:
        """Return what is not as the document has it; None among it where order or groups are others."""
        shapes, nodes = by_node(reading), self._placing.nodes
        wrong: list[int | None] = [
            entry.key
            for entry, node in self._entries
            if not self._is_right(
                node, shapes.get(node, []), [self._job.wanted[each] for each in entry.shapes]
            )
        ]
        if wrong:
            return wrong
        ours = set(nodes)
        order = [shape.node for shape in reading.shapes if shape.node in ours]
        if list(dict.fromkeys(order)) != nodes:
            return [None]
        groups, owners = self._placing.groups, self._placing.owners
        for entry, node in self._entries:
            around = [each for each in shapes[node][0].around if each in owners]
            if around != [groups[name] for name in entry.groups]:
                return [None]
        job = self._job
        return [] if has_empty_layers(reading, job.document.empty_layers, job.layers) else [None]

    def _is_right(self, node: Node, found: list[Found], wanted: list[Wanted]) -> bool:
        job = self._job
        return len(found) == len(wanted) and all(
            runs_as(shape, other, job.room)
            and same_content(shape, other)
            and not job.looks.differing_of(node, shape.style, other.style)
            and (shape.visible, shape.locked) == (other.visible, other.locked)
            and shape.is_clear_as(other)
            for shape, other in zip(found, wanted, strict=True)
        )


def _pair(point: FloatArray) -> Vector:
    return float(point[0]), float(point[1])
