"""Snapshots of unsaved work: what is left when the program ends before the document is saved.

A snapshot is one file in a folder of the program's own, written as whole as a document. Beside it lies a
claim: as long as the process runs that writes the snapshot, nobody else is offered it.
"""

from __future__ import annotations

import math
import os
import time
from contextlib import suppress
from pathlib import Path
from typing import Literal

import msgspec

from app.document.model import Document
from app.storage.claim import Claim
from app.storage.files import TEMPORARY_PREFIX, Stamp, StorageError, load, read, read_content, write
from app.storage.format import FormatError, decode, encode

SUFFIX = ".snapshot.json"
DAMAGED = ".damaged"
_CLAIM = ".claim"
_OLD_TEMPORARY_S = 3600.0
"""Temporary files of this age belong to no write that is still under way."""


class _Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The content of a snapshot's file; the document is text, so that its checksum is that of its bytes."""

    format: Literal["curvebench snapshot"]
    version: Literal[1]
    written: float
    path: bytes | None
    stamp: Stamp | None
    checksum: str
    document: str


_RECORDS = msgspec.json.Decoder(_Record)


class Origin(msgspec.Struct, frozen=True):
    """The file that a document came from.

    Attributes
    ----------
    path
        Where it is; None for a document that was never saved.
    stamp
        What it was when it was last read or written; None where that is not known.
    """

    path: Path | None = None
    stamp: Stamp | None = None

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
    """

    document: Document
    origin: Origin
    written: float
    file: Path
    _claim: Claim

    def discard(self) -> None:
        """Delete it for good."""
        _remove(self.file)
        self._claim.release()

    def leave(self) -> None:
        """Keep it for the next start."""
        self._claim.release()


class Found(msgspec.Struct, frozen=True):
    """What a folder holds: snapshots of processes that have ended, latest first, and damaged ones.

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
        self._claim: Claim | None = None

    def write(self, document: Document, origin: Origin, committed: Document | None = None) -> None:
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
        write(self._claimed(), _record_of(text, origin))

    def _claimed(self) -> Path:
        if self._file is None:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            file = self._folder / (os.urandom(8).hex() + SUFFIX)
            self._claim = Claim.take(_claim_of(file))
            self._file = file
        return self._file

    def discard(self) -> None:
        """Delete the snapshot, if there is one."""
        if self._file is not None:
            _remove(self._file)
        if self._claim is not None:
            self._claim.release()
        self._file = self._claim = None

    def leave(self) -> None:
        """Keep the snapshot for the next start."""
        if self._claim is not None:
            self._claim.release()
        self._file = self._claim = None


def list_snapshots(folder: Path) -> Found:
    """Return what processes that have ended left in `folder`; never raises because of what is in it.

    The snapshots found are claimed: until they are discarded or left, no other process is offered them.
    """
    _sweep(folder)
    snapshots, damaged = [], []
    for file in _files(folder, SUFFIX):
        try:
            claim = Claim.take(_claim_of(file))
        except OSError:
            continue  # the folder is not ours to write; who may, will be offered it
        if claim is None:
            continue
        try:
            snapshot = _load(file, claim)
            if _is_saved(snapshot):
                snapshot.discard()
            else:
                snapshots.append(snapshot)
        except FileNotFoundError:
            claim.release()  # another start has just dealt with it
        except (OSError, ValueError):
            damaged.append(_set_aside(file))
            claim.release()
    snapshots.sort(key=lambda each: -each.written)
    return Found(tuple(snapshots), tuple(damaged))


def _record_of(text: bytes, origin: Origin) -> bytes:
    return msgspec.json.encode(
        _Record(
            format="curvebench snapshot",
            version=1,
            written=time.time(),
            # Bytes, because a file's name need not be text.
            path=os.fsencode(origin.path.absolute()) if origin.path is not None else None,
            stamp=origin.stamp,
            checksum=_checksum(text),
            document=text.decode(),
        )
    )


def _checksum(text: bytes) -> str:
    # Imported with the first snapshot: the start has no need of it.
    import hashlib  # noqa: PLC0415

    return hashlib.sha256(text).hexdigest()


def _load(file: Path, claim: Claim) -> Snapshot:
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
    path = Path(os.fsdecode(record.path)) if record.path is not None else None
    return Snapshot(decode(text), Origin(path, record.stamp), record.written, file, claim)


def _is_saved(snapshot: Snapshot) -> bool:
    """Whether the file holds the work after all: the process ended between saving and tidying up."""
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


def _sweep(folder: Path) -> None:
    """Remove what ended processes left beside their snapshots."""
    for path in _files(folder, _CLAIM):
        if not path.with_name(path.name.removesuffix(_CLAIM)).exists():
            with suppress(OSError):
                claim = Claim.take(path)
                if claim is not None:
                    claim.release()
    for path in _files(folder, ".tmp"):
        if path.name.startswith(TEMPORARY_PREFIX):
            with suppress(OSError):
                if time.time() - path.stat().st_mtime > _OLD_TEMPORARY_S:
                    path.unlink()


def _files(folder: Path, ending: str) -> list[Path]:
    try:
        return sorted(path for path in folder.iterdir() if path.name.endswith(ending))
    except OSError:
        return []


def _claim_of(file: Path) -> Path:
    return file.with_name(file.name + _CLAIM)


def _remove(file: Path) -> None:
    with suppress(OSError):
        file.unlink(missing_ok=True)
