"""Autosave: a snapshot of unsaved work, so that a crash costs a second of work and no more.

`Autosave` keeps the document of a session; `SetAside` keeps documents that were left for a lesson or an
example, as long as only the history holds them.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QStandardPaths, QTimer

from ...document.model import Document
from ...session import DocumentOrigin, Session
from ...storage.files import printable_path
from ...storage.format_error import FormatError
from ...storage.recovery import SnapshotFile, SnapshotOrigin
from ...tasks.task import Task
from ...workbench.document_files import SUFFIX

_log = logging.getLogger("curvebench.autosave")

DELAY_MS = 1000
"""A second for the timer leaves one for the disk: nobody shall lose more than two."""

_RETRY_MS = 10_000
"""Milliseconds until the next try after a disk has refused, should nothing be changed before."""

_PATIENCE_S = 10.0
"""Seconds that the end of the program waits for a disk."""


class Autosave(QObject):
    """The snapshot of one session's unsaved work.

    It follows the session: written a second after the first change that it lacks, a drag in flight included,
    and deleted when the document is saved, replaced or undone to what the file holds. Encoding and writing
    happen in a thread, for a disk may take its time; the thread sees immutable values only.

    Parameters
    ----------
    session
        What is edited.
    folder
        Where the snapshot is kept.
    delay
        How old the oldest change without a snapshot may become, in milliseconds.
    retry
        When to try again after the disk has refused, in milliseconds.
    """

    def __init__(
        self,
        session: Session,
        folder: Path,
        parent: QObject | None = None,
        *,
        delay: int = DELAY_MS,
        retry: int = _RETRY_MS,
    ) -> None:
        super().__init__(parent)
        self._session = session
        self._file = SnapshotFile(folder)
        self._kept: Document | None = None
        self._has_complained = self._has_written = False
        self._last: Task | None = None
        self._is_closed = False
        self._soon = QTimer(self, singleShot=True, interval=delay)
        self._soon.timeout.connect(self._write_soon)
        self._again = QTimer(self, singleShot=True, interval=retry)
        self._again.timeout.connect(self._note_file)
        session.document_changed.connect(self._note_change)
        session.settled.connect(self._note_change)
        session.file_changed.connect(self._note_file)
        self._note_file()

    @property
    def is_needed(self) -> bool:
        """Whether there is something that the file does not hold."""
        return self._session.files.is_modified or self._session.is_previewing

    def _note_change(self) -> None:
        # Every step of a drag comes by here.
        if not self._soon.isActive():
            self._soon.start()

    def _note_file(self) -> None:
        if self.is_needed:
            self._note_change()
        else:
            self._discard()

    def _write_soon(self) -> None:
        if not self.is_needed:
            self._discard()
        elif self._last is not None and self._last.thread.is_alive():
            self._soon.start()  # a slow disk gets one task at a time
        elif self._session.document is not self._kept:
            self._write()

    def _write(self) -> Task:
        session = self._session
        self._soon.stop()
        self._kept, self._has_written = session.document, True
        file, document, committed = self._file, session.document, session.committed
        origin = origin_of(session)
        return self._do(lambda: _written(file, document, origin, committed), self._report)

    def _do(self, work: Callable[[], object], then: Callable[[Task], object] | None = None) -> Task:
        """Do this beside the window, after all that was asked for before."""
        self._last = Task(lambda _report: work(), then, after=self._last)
        return self._last

    def _report(self, task: Task) -> None:
        """Say once that there is no snapshot; try again with the next change, or after a while."""
        if self._is_closed:
            return
        problem: str = task.result
        if problem:
            self._kept = None
            self._again.start()
        if problem and not self._has_complained:
            self._session.refuse(problem)
        self._has_complained = bool(problem)

    def _discard(self) -> None:
        self._soon.stop()
        if self._has_written:
            self._kept, self._has_written = None, False
            self._do(self._file.discard)

    def write_now(self) -> bool:
        """Write the snapshot, if one is needed, and return whether all there is to lose is on the disk."""
        if not self.is_needed:
            return True
        task = self._write()
        return task.wait(_PATIENCE_S) and task.result == ""

    def finish(self) -> None:
        """End, and delete the snapshot: the work was saved, or given up knowingly."""
        self._close()
        self._do(self._file.discard).wait(_PATIENCE_S)

    def leave(self) -> bool:
        """End, and keep what is not saved for the next start; return whether that was possible."""
        self._close()
        is_safe = self.write_now()
        self._do(self._file.leave if self.is_needed else self._file.discard).wait(_PATIENCE_S)
        return is_safe

    def _close(self) -> None:
        self._is_closed = True
        self._soon.stop()
        self._again.stop()
        session = self._session
        session.document_changed.disconnect(self._note_change)
        session.settled.disconnect(self._note_change)
        session.file_changed.disconnect(self._note_file)


def state_folder() -> Path:
    """Return where this program keeps what is neither a document nor a setting."""
    place = QStandardPaths.StandardLocation.GenericStateLocation
    return Path(QStandardPaths.writableLocation(place)) / "curvebench"


def snapshot_folder() -> Path:
    """Return where snapshots are kept."""
    return state_folder() / "unsaved"


def origin_of(session: Session) -> SnapshotOrigin:
    """Return where the document of a session came from, and what it is called."""
    files, origin = session.files, session.files.origin
    stamp = files.file.stamp if files.file is not None else None
    return SnapshotOrigin(files.path, stamp, origin.title, origin.file_stem)


def document_origin(origin: SnapshotOrigin, path: Path | None) -> DocumentOrigin:
    """Return the beginning of work that was recovered and has its file at `path`, if any.

    Where that is not to be written to any more, it keeps the name.
    """
    if path is None and origin.path is not None:
        stem = printable_path(origin.path.name).removesuffix(SUFFIX)
        return DocumentOrigin(title=stem, file_stem=stem)
    return DocumentOrigin(title=origin.title, file_stem=origin.file_stem)


def _written(file: SnapshotFile, document: Document, origin: SnapshotOrigin, committed: Document) -> str:
    """Write a snapshot and return why it could not be, empty where it could."""
    try:
        file.write(document, origin, committed)
    except Exception as problem:
        # Whatever it is, editing goes on, and the person gets to know.
        reason = problem.__cause__ if isinstance(problem.__cause__, OSError) else problem
        words = getattr(reason, "strerror", None) or str(reason)
        _log.warning("no snapshot: %s, error %s", type(reason).__name__, getattr(reason, "errno", None))
        return f"Unsaved work cannot be backed up ({words}); save often."
    return ""


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
