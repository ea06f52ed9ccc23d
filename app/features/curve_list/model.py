"""Curves of the document as a Qt list model: the front curve at the top, groups above their curves.

A document has its curves in the order in which they are drawn, hence from the back to the front; rows are
counted the other way round. A shape or a group is an entry of its own, and its curves have rows while it is
open. Everything outside Qt's indices names a curve by its index in the document.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import compress
from operator import is_not
from typing import NamedTuple

from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal

from ...document.differences import curves_changed_besides_points
from ...document.groups import Container, Node, NodeKind, curve_tree, node_count_label
from ...document.model import Curve, Document
from ...document.style import Style
from ...document.words import count_of
from ...qt.overrides import SafeOverrides

Key = tuple[NodeKind, Container, str]


class Row(NamedTuple):
    """Displayed values of an entry."""

    name: str
    style: Style
    visible: bool
    locked: bool
    facts: str


class Entry(NamedTuple):
    """Entry of the list: a curve, a shape or a group, open or folded."""

    node: Node
    is_open: bool = False

    @property
    def indices(self) -> frozenset[int]:
        """Indices of the curves of the entry."""
        return frozenset(self.node.indices)

    @property
    def holds(self) -> bool:
        """Whether the entry can contain curves."""
        return self.node.kind is not NodeKind.CURVE

    @property
    def opens(self) -> bool:
        """Whether the entry has rows below it when it is open."""
        return bool(self.node.children)

    @property
    def key(self) -> Key:
        """Key of the entry across documents."""
        return self.node.kind, self.node.container, self.node.name


class RowMarks(NamedTuple):
    """Selected curves, as the rows show them.

    Attributes
    ----------
    active, is_editing
        The active curve, and whether it is edited.
    curves
        The curves that are selected or edited.
    """

    active: int = 0
    is_editing: bool = True
    curves: frozenset[int] = frozenset()

    def is_active(self, entry: Entry) -> bool:
        """Return whether an entry is the edited curve, or a folded shape that contains it."""
        is_one = entry.node.kind in (NodeKind.CURVE, NodeKind.SHAPE) and not entry.is_open
        return self.is_editing and is_one and self.active in entry.node.indices

    def is_selected(self, entry: Entry) -> bool:
        """Return whether all curves of an entry are selected."""
        return entry.indices <= self.curves

    def is_selected_whole(self, entry: Entry) -> bool:
        """Return whether an entry is selected as a whole: not where it alone is edited."""
        is_whole = not self.is_editing or len(self.curves) > 1
        return is_whole and self.is_selected(entry)

    def contains_selected(self, entry: Entry) -> bool:
        """Return whether a folded entry hides some, but not only, selected or edited curves."""
        is_folded = entry.opens and not entry.is_open
        is_marked = self.is_active(entry) or self.is_selected(entry)
        return is_folded and not is_marked and not self.curves.isdisjoint(entry.node.indices)

    def spoken_marks(self, entry: Entry) -> str:
        """Return the marks of an entry for screen readers."""
        has_active = self.is_editing and self.active in entry.indices
        if self.contains_selected(entry):
            return ", contains the edited curve" if has_active else ", contains selected curves"
        if not self.is_selected_whole(entry):
            return ""
        return ", selected, edited" if has_active else ", selected"


def entries_of(nodes: Sequence[Node], are_open: Collection[Key]) -> Iterator[Entry]:
    """Yield the entries with a row, from the front to the back."""
    for node in reversed(nodes):
        is_open = bool(node.children) and Entry(node).key in are_open
        yield Entry(node, is_open)
        if is_open:
            yield from entries_of(node.children, are_open)


def rows_around(entries: Sequence[Entry]) -> Iterator[int | None]:
    """Yield for each entry the row of the open entry that contains it."""
    opened: list[int] = []
    for row, entry in enumerate(entries):
        del opened[entry.node.depth :]
        yield opened[-1] if opened else None
        opened.append(row)


def row_of_curve(curve: Curve) -> Row:
    """Return the displayed values of a curve."""
    family = f"{curve.family.title} (not installed)" if curve.family.is_missing else curve.family.title
    facts = f"{family}, {count_of(len(curve.points), 'point')}"
    if curve.is_closed:
        facts += ", closed"
    return Row(curve.name, curve.style, curve.visible, curve.locked, facts)


def state_of(row: Row, entry: Entry) -> str:
    """Return the state of an entry for screen readers: open, hidden, locked."""
    folded = (", open" if entry.is_open else ", folded") if entry.opens else ""
    return folded + ("" if row.visible else ", hidden") + (", locked" if row.locked else "")


Index = QModelIndex | QPersistentModelIndex
_NO_INDEX = QModelIndex()


class CurveListModel(SafeOverrides, QAbstractListModel):
    """List model of curves, shapes and groups; setting the text of a row requests another name.

    Signals
    -------
    name_typed
        Another name was typed for the curve, shape or group of a node.

    Attributes
    ----------
    entries
        What the rows are about, from the top.
    has_folds
        Whether there are shapes or groups.
    marks
        The selected and edited curves.
    """

    name_typed = Signal(object, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("curveListModel")
        self._document: Document | None = None
        self.marks = RowMarks()
        self.entries: list[Entry] = []
        self.has_folds = False
        self._rows: list[Row] = []
        self._row_of: dict[int, int] = {}
        self._rows_around: list[int | None] = []
        self._open: set[Key] = set()

    def show_document(self, document: Document, marks: RowMarks) -> None:
        """Show the curves of `document` and the marks; only changed rows are announced."""
        self.marks = marks
        before, self._document = self._document, document
        if before is None:
            self._build(document)
        elif not _have_same_tree(before, document):
            self._follow_names(before, document)
            self._build(document)
        elif before.curves is not document.curves:
            changed = curves_changed_besides_points(before.curves, document.curves)
            self._show_rows({row for curve in changed for row in self._rows_about(curve)})

    def _follow_names(self, before: Document, document: Document) -> None:
        """Keep renamed entries open."""
        if len(before.curves) != len(document.curves):
            return
        was_open = {
            (node.kind, node.depth, node.indices) for node in _walked(before) if _key(node) in self._open
        }
        self._open |= {
            _key(node) for node in _walked(document) if (node.kind, node.depth, node.indices) in was_open
        }

    def _build(self, document: Document) -> None:
        tree = curve_tree(document.curves)
        # Keys of removed entries are forgotten: a later entry of the same name begins folded.
        self._open &= {_key(node) for top in tree for node in top.walk()}
        self._put(list(entries_of(tree, self._open)))

    def _put(self, entries: list[Entry]) -> None:
        rows = [self._row(entry.node) for entry in entries]
        if len(rows) != len(self._rows):
            self.beginResetModel()
            self._take(entries, rows)
            self.endResetModel()
            return
        old = list(zip(self.entries, self._rows, strict=True))
        self._take(entries, rows)
        now = zip(entries, rows, strict=True)
        self._announce([row for row, new in enumerate(now) if new != old[row]])

    def _take(self, entries: list[Entry], rows: list[Row]) -> None:
        self.entries, self._rows = entries, rows
        self.has_folds = any(entry.opens or entry.node.depth for entry in entries)
        self._rows_around = list(rows_around(entries))
        self._row_of = {
            curve: row
            for row, entry in enumerate(entries)
            if not entry.is_open
            for curve in entry.node.indices
        }

    def _show_rows(self, rows: Collection[int]) -> None:
        new = {row: self._row(self.entries[row].node) for row in rows}
        changed = [row for row in sorted(new) if new[row] != self._rows[row]]
        for row in changed:
            self._rows[row] = new[row]
        self._announce(changed)

    def _announce(self, changed: Sequence[int]) -> None:
        if changed:
            self.dataChanged.emit(self.index(changed[0]), self.index(changed[-1]))

    def _row(self, node: Node) -> Row:
        assert self._document is not None
        parts = self._document.curves[node.indices.start : node.indices.stop]
        if node.kind is NodeKind.CURVE:
            return row_of_curve(parts[0])
        visible, locked = any(part.visible for part in parts), all(part.locked for part in parts)
        what = f"{node.kind.name.lower()} of {node_count_label(node.children)}"
        return Row(node.name, parts[0].style, visible, locked, what)

    # Rows and indices

    def row(self, row: int) -> Row:
        """Return the displayed values of a row."""
        return self._rows[row]

    def row_of(self, curve: int) -> int:
        """Return the row of a curve, or of the folded entry that contains it."""
        return self._row_of.get(curve, -1)

    def _rows_about(self, curve: int) -> Iterator[int]:
        """Yield the row of a curve, and those of the open entries that it is in."""
        row: int | None = self.row_of(curve)
        while row is not None:
            yield row
            row = self.row_around(row)

    def row_around(self, row: int) -> int | None:
        """Return the row of the shape or group that the entry of a row is in; None for none."""
        return self._rows_around[row]

    def row_about(self, indices: frozenset[int], curve: int) -> int:
        """Return the row about these curves, one of which is at `place`; or else that of the one."""
        rows = self._rows_about(curve)
        return next((row for row in rows if self.entries[row].indices == indices), self.row_of(curve))

    def entry_of(self, index: Index) -> Entry | None:
        """Return the entry of a model index."""
        return self.entries[index.row()] if index.isValid() else None

    def open(self, row: int, is_open: bool) -> None:
        """Open or fold a shape or a group."""
        entry = self.entries[row]
        if entry.opens and entry.is_open != is_open and self._document is not None:
            self._open ^= {entry.key}
            self._build(self._document)

    # For Qt

    def rowCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self._rows)

    def flags(self, index: Index) -> Qt.ItemFlag:
        return super().flags(index) | Qt.ItemFlag.ItemIsEditable

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid() or index.row() >= len(self._rows):
            return None
        row, entry = self._rows[index.row()], self.entries[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.EditRole):
            return row.name
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return f"{row.name}, {row.facts}{state_of(row, entry)}{self.marks.spoken_marks(entry)}"
        return None

    def setData(self, index: Index, value: object, role: int = Qt.ItemDataRole.EditRole) -> bool:
        entry = self.entry_of(index)
        if role != Qt.ItemDataRole.EditRole or entry is None:
            return False
        self.name_typed.emit(entry.node, str(value))
        return bool(str(value).strip())


def _have_same_tree(before: Document, after: Document) -> bool:
    """Return whether the tree of curves, shapes and groups is unchanged."""
    old, new = before.curves, after.curves
    # Compared by identity first, in C: there may be thousands.
    others = compress(zip(old, new, strict=False), map(is_not, old, new))
    return len(old) == len(new) and all(a.shape == b.shape and a.groups == b.groups for a, b in others)


def _walked(document: Document) -> Iterator[Node]:
    return (node for top in curve_tree(document.curves) for node in top.walk())


def _key(node: Node) -> Key:
    return Entry(node).key
