"""Snapshots of unsaved work, for recovery after the program ended before the document was saved.

A snapshot is a file in the state folder of the program, written as safely as a document. A lock file beside
it keeps other processes from offering it while its own process runs.
"""

from __future__ import annotations

import logging
import math
import os
import time
from contextlib import suppress
from pathlib import Path
from typing import Literal

import msgspec

from .. import storage
from ..document.model import Document
from .files import Stamp, StorageError, load, printable_path, read, read_content, remove_stale_files, write
from .format import decode_counting, encode
from .format_error import FormatError
from .lock import ProcessLock, acquire
from .migration import LeftOut

_log = logging.getLogger("curvebench.storage")

SUFFIX = ".snapshot.json"
DAMAGED = ".damaged"
_LOCK = ".claim"


class _Record(msgspec.Struct, frozen=True):
    """Content of a snapshot file; the document is text, so that the checksum is that of its bytes."""

    format: Literal["curvebench snapshot"]
    # Version 1 has no title and no file_stem.
    version: Literal[1, 2]
    written: float
    path: bytes | None
    stamp: Stamp | None
    checksum: str
    document: str
    title: str = ""
    file_stem: str = ""


_RECORDS = msgspec.json.Decoder(_Record)


class SnapshotOrigin(msgspec.Struct, frozen=True):
    """Origin of the document in a snapshot: its file, or its title if it was never saved.

    Attributes
    ----------
    path
        The path of the file; None for a document that was never saved.
    stamp
        The stamp of the file when it was last read or written; None if unknown.
    title, file_stem
        Title of an unsaved document, and the suggested name of its file without ending; may be empty.
    """

    path: Path | None = None
    stamp: Stamp | None = None
    title: str = ""
    file_stem: str = ""

    @property
    def is_unchanged(self) -> bool:
        """Whether the file has the same content as then."""
        if self.path is None or self.stamp is None:
            return False
        try:
            return read_content(self.path).stamp.digest == self.stamp.digest
        except StorageError:
            return False


class Snapshot(msgspec.Struct, frozen=True):
    """Snapshot of unsaved work from an earlier process.

    Attributes
    ----------
    document
        The unsaved document.
    origin
        The file that it was not saved to.
    written
        Time of the snapshot, in seconds since 1970.
    file
        The snapshot file.
    left_out
        Features of an older version that were left out.
    """

    document: Document
    origin: SnapshotOrigin
    written: float
    file: Path
    left_out: LeftOut
    _lock: ProcessLock

    def discard(self) -> None:
        """Delete the snapshot."""
        _remove(self.file)
        self._lock.release()

    def leave(self) -> None:
        """Keep the snapshot for the next start."""
        self._lock.release()


class SnapshotListing(msgspec.Struct, frozen=True):
    """Snapshots of processes that have ended, the latest first, and damaged snapshots.

    Damaged snapshots were renamed, not deleted.
    """

    snapshots: tuple[Snapshot, ...] = ()
    damaged: tuple[Path, ...] = ()


class SnapshotFile:
    """Snapshot file of a document that is being edited; created by the first `write`.

    Parameters
    ----------
    folder
        Folder of the snapshots; created if it is missing.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file: Path | None = None
        self._lock: ProcessLock | None = None

    def write(self, document: Document, origin: SnapshotOrigin, committed: Document | None = None) -> None:
        """Replace the snapshot by one of `document`, or of `committed` if `document` is not valid.

        A document during a drag may be invalid.

        Raises
        ------
        FormatError
            If neither is a valid document.
        OSError
            If the snapshot cannot be written; the old one is unchanged.
        """
        try:
            text = encode(document)
        except FormatError:
            if committed is None:
                raise
            text = encode(committed)
        write(self._locked(), _record_of(text, origin))

    def _locked(self) -> Path:
        if self._file is None:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            file = self._folder / (os.urandom(8).hex() + SUFFIX)
            # If no lock can be made, another start may offer the snapshot as well.
            self._lock = acquire(_lock_of(file), is_private=True).lock
            self._file = file
        return self._file

    def discard(self) -> None:
        """Delete the snapshot, if it exists."""
        if self._file is not None:
            _remove(self._file)
        self.leave()

    def leave(self) -> None:
        """Keep the snapshot for the next start."""
        if self._lock is not None:
            self._lock.release()
        self._file = self._lock = None


def list_snapshots(folder: Path) -> SnapshotListing:
    """Return the snapshots of ended processes in `folder`; never raises because of its content.

    The snapshots are locked: no other process is offered them until they are discarded or left.
    """
    _remove_orphans(folder)
    snapshots, damaged = [], []
    for file in _files(folder, SUFFIX):
        lock = acquire(_lock_of(file), is_private=True).lock
        if lock is None:
            continue  # a running process has it, or the folder is not writable for us
        try:
            snapshot = _load(file, lock)
            if _is_saved(snapshot):
                snapshot.discard()
            else:
                snapshots.append(snapshot)
        except FileNotFoundError:
            lock.release()  # another start has just handled it
        except (OSError, ValueError):
            damaged.append(_set_aside(file))
            lock.release()
    snapshots.sort(key=lambda snapshot: -snapshot.written)
    _log.info("found %d snapshots, and %d damaged ones", len(snapshots), len(damaged))
    return SnapshotListing(tuple(snapshots), tuple(damaged))


def _record_of(text: bytes, origin: SnapshotOrigin) -> bytes:
    return msgspec.json.encode(
        _Record(
            format="curvebench snapshot",
            version=2,
            written=time.time(),
            # As bytes: a file name need not be valid text.
            path=None if origin.path is None else os.fsencode(origin.path.absolute()),
            stamp=origin.stamp,
            checksum=_checksum(text),
            document=text.decode(),
            title=printable_path(origin.title),
            file_stem=printable_path(origin.file_stem),
        )
    )


def _path_of(name: bytes | None) -> Path | None:
    return Path(os.fsdecode(name)) if name is not None else None


def _checksum(text: bytes) -> str:
    return storage.digests.sha256(text).hex()


def _load(file: Path, lock: ProcessLock) -> Snapshot:
    """Return the snapshot in `file`; raise ValueError, such as FormatError, if it is damaged."""
    if not file.exists():
        raise FileNotFoundError(file)
    try:
        record = _RECORDS.decode(read(file))
    except (msgspec.DecodeError, RecursionError) as problem:
        raise ValueError(str(problem)) from None
    text = record.document.encode()
    if _checksum(text) != record.checksum or not math.isfinite(record.written):
        raise ValueError("the checksum differs")
    origin = SnapshotOrigin(_path_of(record.path), record.stamp, record.title, record.file_stem)
    decoded = decode_counting(text)
    return Snapshot(decoded.document, origin, record.written, file, decoded.left_out, lock)


def _is_saved(snapshot: Snapshot) -> bool:
    """Return whether the document is saved after all: the process ended between saving and cleaning up."""
    if snapshot.left_out:
        return False
    try:
        return snapshot.origin.path is not None and load(snapshot.origin.path) == snapshot.document
    except (FormatError, StorageError):
        return False


def _set_aside(file: Path) -> Path:
    """Rename a damaged snapshot and return its path, the old one if it cannot be renamed."""
    other = file.with_name(file.name + DAMAGED)
    try:
        return file.replace(other)
    except OSError:
        return file


def _remove_orphans(folder: Path) -> None:
    """Remove lock files and temporary files that ended processes left."""
    for path in _files(folder, _LOCK):
        if not path.with_name(path.name.removesuffix(_LOCK)).exists():
            lock = acquire(path, is_private=True).lock
            if lock is not None:
                lock.release()
    remove_stale_files(folder)


def _files(folder: Path, ending: str) -> list[Path]:
    try:
        return sorted(path for path in folder.iterdir() if path.name.endswith(ending))
    except OSError:
        return []


def _lock_of(file: Path) -> Path:
    return file.with_name(file.name + _LOCK)


def _remove(file: Path) -> None:
    with suppress(OSError):
        file.unlink(missing_ok=True)
