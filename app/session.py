"""The one mutable owner: the current document, its history, the selection and the file behind it."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from app.document import storage
from app.document.edits import EditError
from app.document.model import Curve, Document, empty_document
from app.examples import first_sketch
from app.view_model.curve_view import CurveView, view_of


class _Change(QUndoCommand):
    """A step from one document to the next; the values are computed before it is made."""

    def __init__(self, session: Session, before: Document, after: Document, text: str) -> None:
        super().__init__(text)
        self._session, self._before, self._after = session, before, after

    def redo(self) -> None:
        self._session._restore(self._after)

    def undo(self) -> None:
        self._session._restore(self._before)


class Session(QObject):
    """What is open, and everything that may change it.

    Signals
    -------
    document_changed
        The document shown is another one: a preview, a commit, undo, redo, open or new.
    selection_changed
        Another set of nodes is selected.
    hovered_changed
        The pointer is over another node (its index, or -1), on the canvas or in the basis panel.
    scrub_changed
        The scrub line was moved to another t, or put away (None).
    file_changed
        The path or the modified mark is another one.
    history_changed
        There is another step to undo or redo.
    opened
        Another document was opened or begun.
    interrupted
        The document was replaced from outside a gesture (undo, open): a gesture in flight is void.
    said
        A sentence for the status line.
    """

    document_changed = Signal(object)
    selection_changed = Signal(object)
    hovered_changed = Signal(int)
    scrub_changed = Signal(object)
    file_changed = Signal()
    history_changed = Signal()
    opened = Signal()
    interrupted = Signal()
    said = Signal(str)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.undo_stack = QUndoStack(self)
        self.undo_stack.cleanChanged.connect(self._report_clean)
        self.undo_stack.indexChanged.connect(self._report_index)
        self.path: Path | None = None
        self.active_index = 0
        self.selection: frozenset[int] = frozenset()
        self.hovered = -1
        self.scrub: float | None = None
        self._committed = first_sketch()
        self._shown = self._committed
        self._view: CurveView | None = None

    def _report_clean(self, _clean: bool) -> None:
        self.file_changed.emit()

    def _report_index(self, _index: int) -> None:
        self.history_changed.emit()

    # What is shown

    @property
    def document(self) -> Document:
        """The current document; during a gesture, its preview."""
        return self._shown

    @property
    def active_curve(self) -> Curve:
        """The curve that is edited."""
        return self._shown.curves[self.active_index]

    @property
    def active_view(self) -> CurveView:
        """The view-model of the active curve, made when it is first asked for."""
        if self._view is None or self._view.source is not self.active_curve:
            self._view = view_of(self.active_curve, self._view)
        return self._view

    @property
    def selected(self) -> int | None:
        """The selected node if exactly one is selected."""
        return next(iter(self.selection)) if len(self.selection) == 1 else None

    @property
    def is_modified(self) -> bool:
        """Whether there are changes that are not in the file."""
        return not self.undo_stack.isClean()

    # Changes

    def preview(self, document: Document) -> None:
        """Show `document` during a gesture; `commit` or `cancel` ends it."""
        if document is not self._shown:
            self._show(document)

    def commit(self, document: Document, text: str) -> None:
        """Make `document` the current one, as one step of the history called `text`."""
        if document == self._committed:
            self.cancel()
        else:
            self.undo_stack.push(_Change(self, self._committed, document, text))

    def cancel(self) -> None:
        """Drop the preview; nothing is left of it."""
        if self._shown is not self._committed:
            self._show(self._committed)

    def _restore(self, document: Document) -> None:
        self.interrupted.emit()
        self._committed = document
        self._show(document)

    def _show(self, document: Document) -> None:
        self._shown = document
        self._drop_stale_indices()
        self.document_changed.emit(document)

    def _drop_stale_indices(self) -> None:
        self.active_index = min(self.active_index, len(self._shown.curves) - 1)
        count = len(self.active_curve.nodes)
        if self.hovered >= count:
            self.set_hovered(-1)
        if any(index >= count for index in self.selection):
            self.select([index for index in self.selection if index < count])

    # What is neither saved nor undone

    def select(self, indices: Collection[int]) -> None:
        """Select the nodes at `indices` of the active curve."""
        chosen = frozenset(indices)
        if chosen != self.selection:
            self.selection = chosen
            self.selection_changed.emit(chosen)

    def set_hovered(self, index: int) -> None:
        """Say which node the pointer is over; -1 for none."""
        if index != self.hovered:
            self.hovered = index
            self.hovered_changed.emit(index)

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line to `t`, or put it away (None)."""
        if t != self.scrub:
            self.scrub = t
            self.scrub_changed.emit(t)

    def say(self, text: str) -> None:
        """Show a sentence in the status line."""
        self.said.emit(text)

    # Files

    def new(self) -> None:
        """Start an empty document."""
        self._replace(empty_document(), None)

    def open(self, path: str | Path) -> None:
        """Open the document at `path`; when it cannot be read, raise and leave the open one as it was."""
        path = Path(path)
        self._replace(storage.load(path), path)

    def open_copy(self, path: str | Path) -> None:
        """Open the document at `path` as a new one without a file of its own (examples)."""
        self._replace(storage.load(Path(path)), None)

    def save(self, path: str | Path | None = None) -> None:
        """Write the document to `path`, or to the file it came from."""
        target = Path(path) if path is not None else self.path
        if target is None:
            raise EditError("The document has no file yet; choose one with Save As.")
        self.cancel()
        storage.save(target, self._committed)
        self.path = target
        self.undo_stack.setClean()
        self.file_changed.emit()

    def _replace(self, document: Document, path: Path | None) -> None:
        self.path = path
        self.active_index = 0
        self._view = None
        self.select([])
        self.set_scrub(None)
        self._restore(document)
        self.undo_stack.clear()
        self.undo_stack.setClean()
        self.file_changed.emit()
        self.opened.emit()
