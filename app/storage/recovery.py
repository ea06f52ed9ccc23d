"""Snapshots of unsaved work: what is left when the program ends before the document is saved.

A snapshot is one file in a folder of the program's own, written as whole as a document. Beside it lies a
lock: as long as the process runs that writes the snapshot, nobody else is offered it.
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
    """The content of a snapshot's file; the document is text, so that its checksum is that of its bytes."""

    format: Literal["curvebench snapshot"]
    # Those of version 1 have no names.
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
    """The file that a document came from, or what it is called without one.

    Attributes
    ----------
    path
        Where it is; None for a document that was never saved.
    stamp
        What it was when it was last read or written; None where that is not known.
    title, file_stem
        Its name until it is saved, and the one that its file would get; empty for none in particular.
    """

    path: Path | None = None
    stamp: Stamp | None = None
    title: str = ""
    file_stem: str = ""

    @property
    def is_unchanged(self) -> bool:
        """Whether the file still holds what it held."""
        if self.path is None or self.stamp is None:
            return False
        try:
            return read_content(self.path).stamp.digest == self.stamp.digest
        except StorageError:
            return False


class Snapshot(msgspec.Struct, frozen=True):
    """Unsaved work that was found.

    Attributes
    ----------
    document
        The work.
    origin
        The file that it is not saved to.
    written
        When, in seconds since 1970.
    file
        The file of the snapshot itself.
    left_out
        What it holds besides where an older version of the program has written it.
    """

    document: Document
    origin: SnapshotOrigin
    written: float
    file: Path
    left_out: LeftOut
    _lock: ProcessLock

    def discard(self) -> None:
        """Delete it for good."""
        _remove(self.file)
        self._lock.release()

    def leave(self) -> None:
        """Keep it for the next start."""
        self._lock.release()


class SnapshotListing(msgspec.Struct, frozen=True):
    """Snapshots in a folder: those of processes that have ended, latest first, and damaged ones.

    The damaged ones have been set aside under another name; nothing is deleted that might be of use.
    """

    snapshots: tuple[Snapshot, ...] = ()
    damaged: tuple[Path, ...] = ()


class SnapshotFile:
    """The one snapshot of one document that is being edited; made when first written.

    Parameters
    ----------
    folder
        Where snapshots are kept; created where it is missing.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._file: Path | None = None
        self._lock: ProcessLock | None = None

    def write(self, document: Document, origin: SnapshotOrigin, committed: Document | None = None) -> None:
        """Replace the snapshot by one of `document`, or of `committed` where that cannot be written.

        What a drag shows in flight may be what no file may hold.

        Raises
        ------
        FormatError
            If neither is a valid document.
        OSError
            If it cannot be written; the old snapshot is still there.
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
            # Without a lock, where none can be made, another start may offer it too.
            self._lock = acquire(_lock_of(file), is_private=True).lock
            self._file = file
        return self._file

    def discard(self) -> None:
        """Delete the snapshot, if there is one."""
        if self._file is not None:
            _remove(self._file)
        self.leave()

    def leave(self) -> None:
        """Keep the snapshot for the next start."""
        if self._lock is not None:
            self._lock.release()
        self._file = self._lock = None


def list_snapshots(folder: Path) -> SnapshotListing:
    """Return what processes that have ended left in `folder`; never raises because of what is in it.

    The snapshots found are locked: until they are discarded or left, no other process is offered them.
    """
    _remove_orphans(folder)
    snapshots, damaged = [], []
    for file in _files(folder, SUFFIX):
        lock = acquire(_lock_of(file), is_private=True).lock
        if lock is None:
            continue  # a running process has it, or the folder is not ours to write: who may, is offered it
        try:
            snapshot = _load(file, lock)
            if _is_saved(snapshot):
                snapshot.discard()
            else:
                snapshots.append(snapshot)
        except FileNotFoundError:
            lock.release()  # another start has just dealt with it
        except (OSError, ValueError):
            damaged.append(_set_aside(file))
            lock.release()
    snapshots.sort(key=lambda each: -each.written)
    _log.info("found %d snapshots, and %d damaged ones", len(snapshots), len(damaged))
    return SnapshotListing(tuple(snapshots), tuple(damaged))


def _record_of(text: bytes, origin: SnapshotOrigin) -> bytes:
    return msgspec.json.encode(
        _Record(
            format="curvebench snapshot",
            version=2,
            written=time.time(),
            path=_bytes_of(origin.path),
            stamp=origin.stamp,
            checksum=_checksum(text),
            document=text.decode(),
            title=printable_path(origin.title),
            file_stem=printable_path(origin.file_stem),
        )
    )


def _bytes_of(path: Path | None) -> bytes | None:
    """Return a path as bytes, for a file's name need not be text."""
    return os.fsencode(path.absolute()) if path is not None else None


def _path_of(name: bytes | None) -> Path | None:
    return Path(os.fsdecode(name)) if name is not None else None


def _checksum(text: bytes) -> str:
    return storage.digests.sha256(text).hex()


def _load(file: Path, lock: ProcessLock) -> Snapshot:
    """Return the snapshot in `file`; raise ValueError (FormatError among them) if it is damaged."""
    if not file.exists():
        raise FileNotFoundError(file)
    try:
        record = _RECORDS.decode(read(file))
    except (msgspec.DecodeError, RecursionError) as problem:
        raise ValueError(str(problem)) from None
    text = record.document.encode()
    if _checksum(text) != record.checksum or not math.isfinite(record.written):
        raise ValueError("the checksum is another one")
    origin = SnapshotOrigin(_path_of(record.path), record.stamp, record.title, record.file_stem)
    found = decode_counting(text)
    return Snapshot(found.document, origin, record.written, file, found.left_out, lock)


def _is_saved(snapshot: Snapshot) -> bool:
    """Whether the file holds the work after all: the process ended between saving and tidying up."""
    if snapshot.left_out:
        return False
    try:
        return snapshot.origin.path is not None and load(snapshot.origin.path) == snapshot.document
    except (FormatError, StorageError):
        return False


def _set_aside(file: Path) -> Path:
    """Give a damaged snapshot another name and return that, or the old one where it cannot be changed."""
    other = file.with_name(file.name + DAMAGED)
    try:
        return file.replace(other)
    except OSError:
        return file


def _remove_orphans(folder: Path) -> None:
    """Remove what ended processes left beside their snapshots."""
    for place in _files(folder, _LOCK):
        if not place.with_name(place.name.removesuffix(_LOCK)).exists():
            lock = acquire(place, is_private=True).lock
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
