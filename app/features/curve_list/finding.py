"""Find: rows of the list by words of their names, of texts, and of what they are."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from ...document.curve_tree import Node, NodeKind
from ...document.model import Curve, Document
from ...qt.keys import ENTER, ClaimsKeys
from ...widgets.controls import named
from .model import CurveListModel
from .view import CurveListView


class FindField(ClaimsKeys, QLineEdit):
    """Field above the list: shows the rows that hold all words typed, with what these are in.

    Signals
    -------
    found
        Enter was pressed: these curves are found (a set of places), or none.
    left
        The keys are to go back where they came from.
    """

    found = Signal(object)
    left = Signal()

    def __init__(self, model: CurveListModel, view: CurveListView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._model, self._view = model, view
        tip = "Words of a name, of a text, or of what it is. Enter chooses what is found, Escape shows all"
        named(self, "findField", "Find", tip)
        self.setPlaceholderText("Find by name, text or kind")
        self.setClearButtonEnabled(True)
        self.textChanged.connect(self._filter)
        model.modelReset.connect(self._hide_others)
        model.dataChanged.connect(self._hide_others)
        self.hide()

    def begin(self) -> None:
        """Show the field, ready to be typed in."""
        self.show()
        self.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.selectAll()

    def show_all(self) -> None:
        """Show all rows again."""
        self.clear()
        self.hide()

    @property
    def _words(self) -> list[str]:
        return self.text().casefold().split()

    def _filter(self) -> None:
        if words := self._words:
            self._model.open_around(lambda document, node: _is_found(document, node, words))
        self._hide_others()

    def _hide_others(self) -> None:
        """Show the rows that are found and what they are in; all of them while nothing is sought."""
        words, view, model = self._words, self._view, self._model
        if not words and self.isHidden():
            return
        shown = set(range(model.rowCount())) if not words else set[int]()
        for row in model.rows_where(lambda document, node: _is_found(document, node, words)) if words else ():
            around: int | None = row
            while around is not None and around not in shown:
                shown.add(around)
                around = model.row_around(around)
        for row in range(model.rowCount()):
            if view.isRowHidden(row) is (row in shown):
                view.setRowHidden(row, row not in shown)

    def claims(self, event: QKeyEvent) -> bool:
        # Both are the window's elsewhere.
        return event.key() in (*ENTER, Qt.Key.Key_Escape)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.show_all()
            self.left.emit()
        elif event.key() in ENTER:
            words = self._words
            rows = self._model.rows_where(lambda document, node: _is_found(document, node, words))
            places = (self._model.entries[row].places for row in rows) if words else iter(())
            self.found.emit(frozenset().union(*places))
        else:
            super().keyPressEvent(event)


def _is_found(document: Document, node: Node, words: list[str]) -> bool:
    """Whether what a node is called and is holds all words; of a layer and the like its own name counts."""
    if node.kind is NodeKind.CURVE:
        told = " ".join(_told(document.curves[node.places.start])).casefold()
    else:
        told = f"{node.name} {node.kind.name}".casefold()
    return all(word in told for word in words)


def _told(curve: Curve) -> Iterator[str]:
    """Yield the words that a curve is found by."""
    yield curve.name
    yield curve.identity
    if (form := curve.form) is not None:
        yield form.noun
        yield getattr(form, "words", "")
    if curve.text is not None:
        yield curve.text.words
    if curve.clone is not None:
        yield "clone"
    yield curve.style.stroke
    yield curve.style.fill
    yield curve.family.title
