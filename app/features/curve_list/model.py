"""The curves of the document as a Qt list model: one row for each, the one in front at the top.

A document has its curves in the order in which they are drawn, hence from the back to the front; rows are
counted the other way round. Everything outside Qt's indices names a curve by its place in the document.
"""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QPersistentModelIndex, Qt, Signal

from ...document.model import Curve, Document
from ...document.words import count_of
from ...qt.overrides import Guarded

Index = QModelIndex | QPersistentModelIndex
_NO_INDEX = QModelIndex()


class Row(NamedTuple):
    """Values of a curve that the list shows."""

    name: str
    colour: str
    visible: bool
    locked: bool
    facts: str


class CurveListModel(Guarded, QAbstractListModel):
    """Rows are curves; the text is the name, and setting it asks for another one.

    Signals
    -------
    name_edited
        Another name was typed for the curve at a place of the document.
    """

    name_edited = Signal(int, str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("curveListModel")
        self._curves: tuple[Curve, ...] = ()
        self._rows: list[Row] = []
        self._active = 0
        self._chosen: frozenset[int] = frozenset()

    def show_document(self, document: Document, active: int, selected: frozenset[int]) -> None:
        """Show the curves of `document`; only what changed is announced."""
        self._active, self._chosen = active, selected
        known = {id(curve): row for curve, row in zip(self._curves, self._rows, strict=True)}
        new = [known.get(id(curve)) or _row(curve) for curve in document.curves]
        old, self._curves = self._rows, document.curves
        if len(new) != len(old):
            self.beginResetModel()
            self._rows = new
            self.endResetModel()
            return
        self._rows = new
        changed = [place for place, row in enumerate(new) if row != old[place]]
        if changed:
            self.dataChanged.emit(self.index_of(changed[-1]), self.index_of(changed[0]))

    def row(self, place: int) -> Row:
        """Return what is shown of the curve at `place`."""
        return self._rows[place]

    def place_of(self, index: Index) -> int:
        """Return which curve of the document an index is about; -1 for none."""
        return len(self._rows) - 1 - index.row() if index.isValid() else -1

    def index_of(self, place: int) -> QModelIndex:
        """Return the index of the curve at `place` of the document."""
        return self.index(len(self._rows) - 1 - place)

    def rowCount(self, parent: Index = _NO_INDEX) -> int:
        return 0 if parent.isValid() else len(self._rows)

    def flags(self, index: Index) -> Qt.ItemFlag:
        return super().flags(index) | Qt.ItemFlag.ItemIsEditable

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        if not index.isValid() or index.row() >= len(self._rows):
            return None
        place = self.place_of(index)
        row = self._rows[place]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.EditRole):
            return row.name
        if role == Qt.ItemDataRole.AccessibleTextRole:
            return f"{row.name}, {row.facts}{_state(row)}{self._role_of(place)}"
        return None

    def _role_of(self, place: int) -> str:
        if len(self._chosen) < 2 or place not in self._chosen:
            return ""
        return ", chosen, edited" if place == self._active else ", chosen"

    def setData(self, index: Index, value: object, role: int = Qt.ItemDataRole.EditRole) -> bool:
        if role != Qt.ItemDataRole.EditRole or not index.isValid():
            return False
        self.name_edited.emit(self.place_of(index), str(value))
        return bool(str(value).strip())


def _row(curve: Curve) -> Row:
    family = f"{curve.family.title} (not installed)" if curve.family.is_missing else curve.family.title
    facts = f"{family}, {count_of(len(curve.points), 'point')}"
    if curve.is_closed:
        facts += ", closed"
    return Row(curve.name, curve.style.colour, curve.visible, curve.locked, facts)


def _state(row: Row) -> str:
    return ("" if row.visible else ", hidden") + (", locked" if row.locked else "")
