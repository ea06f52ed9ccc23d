"""The one mutable owner: the document that is edited, and the file behind it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, Signal

from app.document import storage
from app.document.edits import EditError
from app.document.model import Document, empty_document
from app.document.open_file import OpenFile
from app.editing import Editing
from app.undo_step import State, UndoStep


class Session(Editing):
    """What is open, and everything that may change it.

    Signals
    -------
    file_changed
        The path or the modified mark is another one.
    opened
        Another document was opened or begun.
    saved
        The document was written to its file.
    """

    file_changed = Signal()
    opened = Signal()
    saved = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.path: Path | None = None
        self.file: OpenFile | None = None
        self.undo_stack.cleanChanged.connect(self._report_clean)

    def _report_clean(self, _clean: bool) -> None:
        self.file_changed.emit()

    def new(self) -> None:
        """Start an empty document."""
        self._replace(empty_document(), None)

    def open(self, path: str | Path) -> None:
        """Open the document at `path`; when it cannot be read, raise and leave the open one as it was."""
        path = Path(path)
        opened = OpenFile.open(path, self.file)
        self._replace(opened.document, path, opened.file)

    def open_copy(self, path: str | Path) -> None:
        """Open the document at `path` as a new one without a file of its own (examples)."""
        self._replace(storage.load(Path(path)), None)

    def reload(self) -> None:
        """Take over what the file holds now, as a step of the history; raises as `open` does."""
        if self.file is None:
            return
        document = self.file.read_again()
        self.cancel()
        if document != self._committed:
            before, after = State(self._committed, self.active_index), State(document, 0)
            if self.active_index < len(document.curves):
                after = State(document, self.active_index)
            self.undo_stack.push(UndoStep(self._restore, before, after, "Reload"))
        self.undo_stack.setClean()
        self.file_changed.emit()

    @property
    def is_read_only(self) -> bool:
        """Whether somebody else has the file open, so that only Save As keeps changes."""
        return self.file is not None and self.file.owner is not None

    def save(self, path: str | Path | None = None, *, overwrite: bool = False) -> None:
        """Write the document to `path`, or to the file it came from.

        A file that was changed since it was seen last is replaced only if `overwrite` says so; see
        `OpenFile.saved` for what is refused besides.
        """
        target = Path(path) if path is not None else self.path
        if target is None:
            raise EditError("The document has no file yet; choose one with Save As.")
        self.cancel()
        file = OpenFile.saved(target, self._committed, self.file, overwrite=overwrite)
        self._take_file(file)
        self.path = target
        self.undo_stack.setClean()
        self.saved.emit()
        self.file_changed.emit()

    def _take_file(self, file: OpenFile | None) -> None:
        if self.file is not None and self.file is not file:
            self.file.close()
        self.file = file

    def restore(self, document: Document, path: Path | None) -> None:
        """Go on with unsaved work: `document`, with changes that are not in the file at `path`."""
        self._replace(document, path)
        self.undo_stack.resetClean()

    def _replace(self, document: Document, path: Path | None, file: OpenFile | None = None) -> None:
        self._take_file(OpenFile.adopt(path) if file is None and path is not None else file)
        self.path = path
        self._begin_with(document)
        self.file_changed.emit()
        self.opened.emit()
