"""Backups of work that was left for a lesson or an example: undo goes back to it while the window lives."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject

from ...document.model import Document
from ...session import Session
from ...storage.format_error import FormatError
from ...storage.recovery import SnapshotFile
from .autosave import origin_of


class SetAside(QObject):
    """Snapshots of the documents that a session has left and that only its history still holds.

    One that is gone back to is not needed any more: `Autosave` keeps it. The others are offered as unsaved
    work when the history is gone, with the window or with another document.

    Parameters
    ----------
    session
        What is edited.
    folder
        Where snapshots are kept.
    """

    def __init__(self, session: Session, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._folder = session, folder
        self._kept: list[tuple[Document, SnapshotFile]] = []
        session.left.connect(self._keep)
        session.opened.connect(self._follow)

    def _keep(self, document: Document) -> None:
        file = SnapshotFile(self._folder)
        try:
            file.write(document, origin_of(self._session))
        except (OSError, FormatError) as problem:
            file.discard()
            self._session.refuse(f"What you leave cannot be backed up ({problem}); Undo goes back to it.")
            return
        self._kept.append((document, file))

    def _follow(self) -> None:
        """Drop the backup of what is open again; hand over all of them where the history is gone."""
        if not self._session.undo_stack.count():
            self.leave()
            return
        here = self._session.committed
        for document, file in self._kept:
            if document is here:
                file.discard()
        self._kept = [(document, file) for document, file in self._kept if document is not here]

    def leave(self) -> None:
        """Let what is kept be offered as unsaved work, by this window or the next start."""
        for _document, file in self._kept:
            file.leave()
        self._kept = []
