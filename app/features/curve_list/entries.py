"""Entries of the list of curves: what their rows show, and what of them is chosen."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from typing import NamedTuple

from ...document.groups import Container, Node, NodeKind
from ...document.model import Curve
from ...document.style import Style
from ...document.words import count_of

Key = tuple[NodeKind, Container, str]


class Row(NamedTuple):
    """Values of an entry that the list shows."""

    name: str
    style: Style
    visible: bool
    locked: bool
    facts: str


class Entry(NamedTuple):
    """Row of the list: a curve, a shape or a group, and whether it is open."""

    node: Node
    is_open: bool = False

    @property
    def places(self) -> frozenset[int]:
        """The curves that it is about."""
        return frozenset(self.node.places)

    @property
    def holds(self) -> bool:
        """Whether curves can be in it."""
        return self.node.kind is not NodeKind.CURVE

    @property
    def opens(self) -> bool:
        """Whether it has rows of its own below it when it is open."""
        return bool(self.node.parts)

    @property
    def key(self) -> Key:
        """Key that it keeps from one document to the next."""
        return self.node.kind, self.node.around, self.node.name


class RowMarks(NamedTuple):
    """What is chosen, as the rows show it.

    Attributes
    ----------
    active, is_editing
        The active curve, and whether it is edited.
    curves
        The curves that are chosen, or edited.
    """

    active: int = 0
    is_editing: bool = True
    curves: frozenset[int] = frozenset()

    def is_edited(self, entry: Entry) -> bool:
        """Whether an entry is the curve that is edited, or a folded shape that it is in."""
        is_one = entry.node.kind in (NodeKind.CURVE, NodeKind.SHAPE) and not entry.is_open
        return self.is_editing and is_one and self.active in entry.node.places

    def is_chosen(self, entry: Entry) -> bool:
        """Whether an entry is of what is chosen."""
        return entry.places <= self.curves

    def is_chosen_whole(self, entry: Entry) -> bool:
        """Whether an entry is chosen to be acted on as a whole: not where it alone is edited."""
        is_whole = not self.is_editing or len(self.curves) > 1
        return is_whole and self.is_chosen(entry)

    def has_chosen_within(self, entry: Entry) -> bool:
        """Whether a part of what an entry hides, being folded, is chosen or edited, and not all of it."""
        is_folded = entry.opens and not entry.is_open
        is_marked = self.is_edited(entry) or self.is_chosen(entry)
        return is_folded and not is_marked and not self.curves.isdisjoint(entry.node.places)

    def words_of(self, entry: Entry) -> str:
        """Return what of this is to be said of an entry, after its name and facts."""
        is_with_edited = self.is_editing and self.active in entry.places
        if self.has_chosen_within(entry):
            return ", the edited curve is in it" if is_with_edited else ", something in it is chosen"
        if not self.is_chosen_whole(entry):
            return ""
        return ", chosen, edited" if is_with_edited else ", chosen"


def entries_of(nodes: Sequence[Node], are_open: Collection[Key]) -> Iterator[Entry]:
    """Yield what has a row, from the front to the back."""
    for node in reversed(nodes):
        is_open = bool(node.parts) and Entry(node).key in are_open
        yield Entry(node, is_open)
        if is_open:
            yield from entries_of(node.parts, are_open)


def rows_around(entries: Sequence[Entry]) -> Iterator[int | None]:
    """Yield for each entry the row of the open one that it is in."""
    opened: list[int] = []
    for row, entry in enumerate(entries):
        del opened[entry.node.depth :]
        yield opened[-1] if opened else None
        opened.append(row)


def row_of_curve(curve: Curve) -> Row:
    """Return what the row of a curve shows."""
    family = f"{curve.family.title} (not installed)" if curve.family.is_missing else curve.family.title
    facts = f"{family}, {count_of(len(curve.points), 'point')}"
    if curve.is_closed:
        facts += ", closed"
    return Row(curve.name, curve.style, curve.visible, curve.locked, facts)


def state_of(row: Row, entry: Entry) -> str:
    """Return what is said of an entry besides: open, hidden, locked."""
    folded = (", open" if entry.is_open else ", folded") if entry.opens else ""
    return folded + ("" if row.visible else ", hidden") + (", locked" if row.locked else "")
