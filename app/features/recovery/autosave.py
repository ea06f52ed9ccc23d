"""Autosave: a snapshot of unsaved work, so that a crash costs a second of work and no more.

`Autosave` keeps the document of a session; `SetAside` keeps documents that were left for a lesson or an
example, as long as only the history holds them.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QStandardPaths

from ...document.model import Document
from ...session import DocumentOrigin, Session
from ...storage.files import printable_path
from ...storage.format_error import FormatError
from ...storage.recovery import SnapshotFile, SnapshotOrigin
from ...tasks.task import DelayedCall, Task
from ...workbench.document_files import SUFFIX

_log = logging.getLogger("curvebench.autosave")

DELAY_MS = 1000
"""Milliseconds from a change to its snapshot: with a second for the disk, at most two seconds are lost."""

_RETRY_MS = 10_000
"""Milliseconds until the next attempt after a failure, unless the document changes before."""

_PATIENCE_S = 10.0
"""Seconds that the program waits for the disk when it ends."""


class Autosave(QObject):
    """Snapshot of the unsaved work of a session.

    It is written a second after the first change that it lacks, also during a drag, and deleted when the
    document is saved, replaced, or undone to the content of its file. Encoding and writing happen in a
    background task that sees immutable values only.

    Parameters
    ----------
    session
        The session.
    folder
        Folder of the snapshot.
    delay
        Milliseconds from a change to its snapshot.
    retry
        Milliseconds until the next attempt after a failure.
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
        self._written: Document | None = None
        self._has_complained = self._has_written = False
        self._last: Task | None = None
        self._is_closed = False
        self._soon = DelayedCall(self, delay, self._write_soon)
        self._again = DelayedCall(self, retry, self._note_file)
        session.document_changed.connect(self._soon.start_if_idle)
        session.settled.connect(self._soon.start_if_idle)
        session.file_changed.connect(self._note_file)
        self._note_file()

    @property
    def is_needed(self) -> bool:
        """Whether the document differs from its file."""
        return self._session.files.is_modified or self._session.is_previewing

    def _note_file(self) -> None:
        if self.is_needed:
            self._soon.start_if_idle()
        else:
            self._discard()

    def _write_soon(self) -> None:
        if not self.is_needed:
            self._discard()
        elif self._last is not None and self._last.thread.is_alive():
            self._soon.start()  # one task at a time, also on a slow disk
        elif self._session.document is not self._written:
            self._write()

    def _write(self) -> Task:
        session = self._session
        self._soon.stop()
        self._written, self._has_written = session.document, True
        file, document, committed = self._file, session.document, session.committed
        origin = origin_of(session)
        return self._do(lambda: _written(file, document, origin, committed), self._report)

    def _do(self, work: Callable[[], object], then: Callable[[Task], object] | None = None) -> Task:
        """Run `work` in the background, after all earlier work."""
        self._last = Task(lambda _report: work(), then, after=self._last)
        return self._last

    def _report(self, task: Task) -> None:
        """Report the first failure; try again with the next change, or after a while."""
        if self._is_closed:
            return
        problem: str = task.result
        if problem:
            self._written = None
            self._again.start()
        if problem and not self._has_complained:
            self._session.refuse(problem)
        self._has_complained = bool(problem)

    def _discard(self) -> None:
        self._soon.stop()
        if self._has_written:
            self._written, self._has_written = None, False
            self._do(self._file.discard)

    def write_now(self) -> bool:
        """Write the snapshot if it is needed, and return whether all unsaved work is on the disk."""
        if not self.is_needed:
            return True
        task = self._write()
        return task.wait(_PATIENCE_S) and task.result == ""

    def finish(self) -> None:
        """End and delete the snapshot: the work was saved, or discarded by the person."""
        self._close()
        self._do(self._file.discard).wait(_PATIENCE_S)

    def leave(self) -> bool:
        """End and keep unsaved work for the next start; return whether that was possible."""
        self._close()
        is_safe = self.write_now()
        self._do(self._file.leave if self.is_needed else self._file.discard).wait(_PATIENCE_S)
        return is_safe

    def _close(self) -> None:
        self._is_closed = True
        self._soon.stop()
        self._again.stop()
        session = self._session
        session.document_changed.disconnect(self._soon.start_if_idle)
        session.settled.disconnect(self._soon.start_if_idle)
        session.file_changed.disconnect(self._note_file)


def state_folder() -> Path:
    """Return the folder for files of the program that are neither documents nor settings."""
    location = QStandardPaths.StandardLocation.GenericStateLocation
    return Path(QStandardPaths.writableLocation(location)) / "curvebench"


def snapshot_folder() -> Path:
    """Return the folder of snapshots."""
    return state_folder() / "unsaved"


def origin_of(session: Session) -> SnapshotOrigin:
    """Return the origin of the document of a session, for its snapshot."""
    files, origin = session.files, session.files.origin
    stamp = files.file.stamp if files.file is not None else None
    return SnapshotOrigin(files.path, stamp, origin.title, origin.file_stem)


def document_origin(origin: SnapshotOrigin, path: Path | None) -> DocumentOrigin:
    """Return the origin of a recovered document whose file is at `path`, if it has one.

    If its former file must not be replaced, the document keeps the name of that file as its title.
    """
    if path is None and origin.path is not None:
        stem = printable_path(origin.path.name).removesuffix(SUFFIX)
        return DocumentOrigin(title=stem, file_stem=stem)
    return DocumentOrigin(title=origin.title, file_stem=origin.file_stem)


def _written(file: SnapshotFile, document: Document, origin: SnapshotOrigin, committed: Document) -> str:
    """Write a snapshot and return the message of a failure, empty on success."""
    try:
        file.write(document, origin, committed)
    except Exception as problem:
        # Whatever the reason, editing continues, and the person is told.
        reason = problem.__cause__ if isinstance(problem.__cause__, OSError) else problem
        cause = getattr(reason, "strerror", None) or str(reason)
        _log.warning("no snapshot: %s, error %s", type(reason).__name__, getattr(reason, "errno", None))
        return f"Unsaved work cannot be backed up ({cause}). Save often."
    return ""


class SetAside(QObject):
    """Snapshots of documents that were replaced by a lesson or an example, and that only the history holds.

    The snapshot of a document that Undo restores is deleted: `Autosave` protects that document. The others
    are offered as unsaved work when the history ends, with the window or with another document.

    Parameters
    ----------
    session
        The session.
    folder
        Folder of the snapshots.
    """

    def __init__(self, session: Session, folder: Path, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._folder = session, folder
        self._snapshots: list[tuple[Document, SnapshotFile]] = []
        session.left.connect(self._add)
        session.opened.connect(self._follow)

    def _add(self, document: Document) -> None:
        file = SnapshotFile(self._folder)
        try:
            file.write(document, origin_of(self._session))
        except (OSError, FormatError) as problem:
            file.discard()
            self._session.refuse(f"Your document cannot be backed up ({problem}). Undo returns to it.")
            return
        self._snapshots.append((document, file))

    def _follow(self) -> None:
        """Delete the snapshot of a document that is open again; release all if the history has ended."""
        if not self._session.undo_stack.count():
            self.leave()
            return
        here = self._session.committed
        for document, file in self._snapshots:
            if document is here:
                file.discard()
        self._snapshots = [(document, file) for document, file in self._snapshots if document is not here]

    def leave(self) -> None:
        """Release the snapshots, so that this window or the next start offers them as unsaved work."""
        for _document, file in self._snapshots:
            file.leave()
        self._snapshots = []
