"""The file behind the document: opening, saving, and beginning another document."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from ..document.groups import tidy_shapes
from ..document.limits import EditError
from ..document.model import NEVER_EXPORTED, Document, Export, empty_document
from ..document.plain_numbers import with_plain_numbers
from ..storage.examples import template_title
from ..storage.files import load
from ..storage.open_file import FileChange, LoadedDocument, OpenFile
from ..storage.resources import is_resource
from ..view_model.curve.curve_view import CurveView
from .change import why_unsavable
from .history import DocumentOrigin, HistoryState

if TYPE_CHECKING:
    from .session import Session


_log = logging.getLogger("curvebench.session")


class Files:
    """File of the document with its lock, and the ways to another document.

    Attributes
    ----------
    path
        The path; None as long as the document has no file.
    file
        The file at `path`, open with its lock; None without one.
    origin
        Where the document began; the same for all states of it.
    blank
        Returns what a new document is.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self.path: Path | None = None
        self.file: OpenFile | None = None
        self.origin = DocumentOrigin(is_disposable=True)
        # By the beginnings of the documents that undo and redo go to.
        self._exports: dict[DocumentOrigin, Export] = {}
        self.blank: Callable[[], Document] = empty_document

    @property
    def is_read_only(self) -> bool:
        """Whether somebody else has the file open, so that only Save As keeps changes."""
        return self.file is not None and self.file.owner is not None

    @property
    def has_changes(self) -> bool:
        """Whether something was changed here since the document was opened or saved."""
        return not self._session.undo_stack.isClean()

    @property
    def is_modified(self) -> bool:
        """Whether document and file differ: changed here, or changed, damaged or deleted there."""
        return self.has_changes or (self.file is not None and self.file.has_lost_document)

    @property
    def is_untouched(self) -> bool:
        """Whether the document is the first sketch or an empty one, unchanged."""
        is_as_it_came = not self._session.undo_stack.canUndo() and not self.is_modified
        return self.origin.is_disposable and self.path is None and is_as_it_came

    @property
    def last_export(self) -> Export:
        """The last export of the document; saved with it, but no step of the history."""
        return self._exports.get(self.origin, NEVER_EXPORTED)

    def note_export(self, export: Export) -> None:
        """Take note of an export, also of one that a file tells of.

        It is saved with the next change; an export alone is no unsaved change.
        """
        self._exports[self.origin] = export

    def close(self) -> None:
        """Go on without a file."""
        self._take(None, None)

    def _take(self, path: Path | None, file: OpenFile | None) -> None:
        if self.file is not None and self.file is not file:
            self.file.close()
        self.path, self.file = path, file

    # Another document

    def new(self) -> None:
        """Start an empty document."""
        self.begin(self.blank())

    def begin(self, document: Document) -> None:
        """Begin with the first sketch, or with an empty document."""
        self.replace(with_plain_numbers(document), None, origin=DocumentOrigin(is_disposable=True))

    def begin_imported(
        self,
        document: Document,
        name: str,
        step: str = "",
        views: Sequence[CurveView] = (),
    ) -> None:
        """Begin with the content of a file of another format; saving it suggests its `name`.

        Undo goes back to the document before where it is a `step` of the history. Its views may be given.

        Raises
        ------
        EditError
            If no file of ours may hold it.
        """
        document = tidy_shapes(with_plain_numbers(document))
        if reason := why_unsavable(self.blank(), document):
            raise EditError(reason)
        session, origin = self._session, DocumentOrigin(title=name, file_stem=name)
        if not step:
            self.replace(document, None, origin=origin, views=views)
            return
        session.cancel()
        session.expect(views)
        session.history.push(session.state, HistoryState(document, 0, origin), step)
        self.note_export(document.export)

    def open(
        self, path: str | Path, reading: LoadedDocument | None = None, views: Sequence[CurveView] = ()
    ) -> None:
        """Open the document at `path`; when it cannot be read, raise and leave the open one as it was.

        Where the file was read already, `reading` is what it held, and `views` may be those of its curves.
        What ships with the program opens as a copy: it is everybody's, and a lock has no place beside it.
        """
        path = Path(path)
        if is_resource(path):
            self.open_copy(path)
            return
        opened = OpenFile.open(path, self.file, reading)
        self.replace(opened.document, path, opened.file, views=views)

    def open_copy(self, path: str | Path, text: str = "Open") -> None:
        """Open the document at `path` as a new one without a file of its own (lessons, examples).

        Work in a document without a file is not lost for it: opening is then one step of the history, called
        `text`, and undo goes back.
        """
        session, path = self._session, Path(path)
        document = with_plain_numbers(load(path))
        title = template_title(path, document)
        session.cancel()
        if self.path is not None or not (session.undo_stack.count() or self.is_modified):
            self.replace(document, None, origin=DocumentOrigin(path, title))
            return
        after = HistoryState(document, 0, DocumentOrigin(path, title, self.origin))
        session.history.push(session.state, after, text)
        self.note_export(document.export)
        # The new document is unchanged; the signal `left` reports the one before.
        session.undo_stack.setClean()
        session.file_changed.emit()
        session.opened.emit()

    def restore(self, document: Document, path: Path | None, origin: DocumentOrigin | None = None) -> None:
        """Go on with unsaved work: `document`, with changes that are not in the file at `path`."""
        self.replace(with_plain_numbers(document), path, origin=origin)
        self._session.undo_stack.resetClean()

    def replace(
        self,
        document: Document,
        path: Path | None,
        file: OpenFile | None = None,
        origin: DocumentOrigin | None = None,
        views: Sequence[CurveView] = (),
    ) -> None:
        """Begin a history with `document`; its views may be given."""
        if file is None and path is not None:
            file = OpenFile.adopt(path, self.file)
        # The path comes later: closing the document before does not touch this file.
        self._take(None, file)
        origin = origin or DocumentOrigin()
        self._exports = {origin: document.export}
        self._session.begin(HistoryState(document, 0, origin), path, views)

    # The file of this one

    def save(self, path: str | Path | None = None, *, overwrite: bool = False) -> None:
        """Write the document to `path`, or to the file it came from.

        A file that was changed since it was seen last is replaced only if `overwrite` says so; see
        `OpenFile.saved` for what is refused besides.
        """
        session, target = self._session, self.path if path is None else Path(path)
        if target is None:
            raise EditError("The document has no file yet; choose one with Save As.")
        session.cancel()
        document = replace(session.committed, export=self.last_export)
        self._take(target, OpenFile.saved(target, document, self.file, overwrite=overwrite))
        session.undo_stack.setClean()
        session.saved.emit()
        session.file_changed.emit()

    def reload(self) -> None:
        """Reload the document from its file, as a step of the history; raises as `open` does."""
        session = self._session
        if self.file is None:
            return
        document = with_plain_numbers(self.file.read_again())
        session.cancel()
        if replace(document, export=session.committed.export) != session.committed:
            active = session.active_index if session.active_index < len(document.curves) else 0
            session.history.push(session.state, HistoryState(document, active, self.origin), "Reload")
        self.note_export(document.export)
        session.undo_stack.setClean()
        session.file_changed.emit()

    def check(self) -> None:
        """Read the state of the file at this moment, for instance before the document is replaced."""
        if self.file is not None:
            self.note(self.file.check())

    def note(self, change: FileChange) -> None:
        """Note the content of the file."""
        if self.file is not None and change is not self.file.change:
            self.file.change = change
            _log.info("the file is seen as %s", change.name)
            self._session.file_changed.emit()

    def give_up_changes(self) -> None:
        """Give up unsaved changes without a question."""
        self._session.undo_stack.setClean()
        if self.file is not None:
            self.file.accept()
            self._session.file_changed.emit()
