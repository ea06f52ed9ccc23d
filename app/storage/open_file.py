"""The file of an open document: its lock, what was seen of it last, and what has become of it since."""

from __future__ import annotations

import logging
import os
from contextlib import suppress
from enum import Enum
from pathlib import Path

import msgspec

from ..document.model import Document
from ..document.plain_numbers import with_plain_numbers
from . import files
from .files import MissingError, Stamp, StorageError, UnconfirmedError, remove_stale_files
from .format import VERSION, version_of
from .format_error import FormatError
from .lock import LockResult, Owner, ProcessLock, acquire, lock_path, owner_of, take_over
from .migration import NOTHING, LeftOut

_log = logging.getLogger("curvebench.storage")

_LARGE = 50_000
"""Bytes from which a document is opened beside the window: about a hundred curves, a tenth of a second."""


def is_large(path: Path) -> bool:
    """Whether reading a document may take a while."""
    try:
        return path.stat().st_size >= _LARGE
    except OSError:
        return False  # whoever opens it says what is wrong with it


class LockedError(StorageError):
    """Somebody else has the file open; `owner` is who."""

    def __init__(self, path: Path, owner: Owner) -> None:
        super().__init__(f"“{path.name}” is open elsewhere. Save under another name.")
        self.owner = owner


class FileChange(Enum):
    """Change of a file since it was seen last; the value says it in words."""

    SAME = ""
    CHANGED = "Another program has changed the file."
    """It holds another document than was seen last."""
    UNREADABLE = "Another program has emptied or damaged the file."
    """It holds no document, perhaps because another program is just writing it."""
    GONE = "The file is gone from its folder."


class OpenedDocument(msgspec.Struct, frozen=True):
    """A document and the file it came from."""

    document: Document
    file: OpenFile


class LoadedDocument(msgspec.Struct, frozen=True):
    """Document read from a file, with plain values alone, and the stamp of the file then.

    Attributes
    ----------
    version
        The version of the format that the file is in.
    left_out
        What it holds besides where that is an older one.
    """

    document: Document
    stamp: Stamp
    version: int
    left_out: LeftOut

    @classmethod
    def of(cls, path: Path) -> LoadedDocument:
        """Read the file at `path`; see `files.load` for what may be wrong."""
        content = files.read_content(path)
        found = files.document_in(content.data, path)
        return cls(with_plain_numbers(found.document), content.stamp, _version(content.data), found.left_out)


class OpenFile:
    """The file of a window's document, as far as the window knows it.

    Attributes
    ----------
    path
        Its name, as the person gave it.
    stamp
        What it was when it was last read, written or accepted; None where it was not there.
    version
        The version of the format that it is in, as far as is known.
    left_out
        What it holds besides the document where that is an older one.
    owner
        Who else has it open, so that it is not saved from here; None where it is ours.
    lock_problem
        Why nobody can be told that it is open here; empty where they are.
    change
        What it holds, as far as the window has taken note of it.
    """

    def __init__(
        self,
        path: Path,
        stamp: Stamp | None,
        result: LockResult,
        version: int = VERSION,
        left_out: LeftOut = NOTHING,
    ) -> None:
        self.path, self.stamp, self.version, self.left_out = path, stamp, version, left_out
        self.change = FileChange.SAME
        self._lock: ProcessLock | None = None
        self._seen: tuple[Stamp, FileChange, Document | None] | None = None
        self._take(result)

    def _take(self, result: LockResult) -> None:
        self._lock, self.owner, self.lock_problem = result.lock, result.owner, result.problem

    # Opening and saving

    @classmethod
    def open(
        cls, path: Path, previous: OpenFile | None = None, reading: LoadedDocument | None = None
    ) -> OpenedDocument:
        """Read the document at `path` and mark it as open; see `files.load` for what may be wrong.

        `previous` is the file that was open in this window until now; its lock goes on where it is the same.
        Where the file was read before, `reading` is what it held.
        """
        found = reading or LoadedDocument.of(path)
        # What somebody writes between the reading and the lock is noticed like any later change.
        result = _lock_for(path, previous)
        remove_stale_files(_target(path).parent)
        _log.info("opened a document, version %d, %s", found.version, _counts(found.document))
        _log.info("its lock is %s", str(result))
        return OpenedDocument(found.document, cls(path, found.stamp, result, found.version, found.left_out))

    @classmethod
    def adopt(cls, path: Path, previous: OpenFile | None = None) -> OpenFile:
        """Return the file at `path` for a document that did not come from it, such as one that was recovered.

        What it holds now counts as seen. `previous` is as with `open`.
        """
        stamp, version, left_out = None, VERSION, NOTHING
        with suppress(StorageError, FormatError):
            content = files.read_content(path)
            stamp, version = content.stamp, _version(content.data)
            if version < VERSION:
                left_out = files.document_in(content.data, path).left_out
        return cls(path, stamp, _lock_for(path, previous), version, left_out)

    @classmethod
    def saved(
        cls, path: Path, document: Document, previous: OpenFile | None = None, *, overwrite: bool = False
    ) -> OpenFile:
        """Write `document` to `path` and return the file it lies in from then on.

        Parameters
        ----------
        overwrite
            Also where the file was changed since it was seen last.

        Raises
        ------
        LockedError
            If somebody else has that file open.
        StorageError, FormatError
            As `files.save`; `previous` then still is the file of the document.
        """
        if previous is not None and previous.is_at(path):
            previous._save(document, overwrite=overwrite)
            previous.path = path
            return previous
        file = cls(path, None, acquire(_lock_path(path)))
        try:
            file._save(document, overwrite=True)
        except BaseException:
            file.close()
            raise
        return file

    def _save(self, document: Document, *, overwrite: bool) -> None:
        self._refuse_if_not_ours()
        try:
            self.stamp = files.save(self.path, document, seen=None if overwrite else self.stamp)
        except UnconfirmedError as problem:
            self.stamp, self.change = problem.stamp, FileChange.SAME
            raise
        self.version, self.left_out, self.change = VERSION, NOTHING, FileChange.SAME
        _log.info("saved a document: %s", _counts(document))
        remove_stale_files(_target(self.path).parent)

    def _refuse_if_not_ours(self) -> None:
        if self.owner is None and self._lock is not None and (owner := self._lock.lost_to()) is not None:
            self.lose_to(owner)
        if self.owner is not None and not self.take_if_free():
            raise LockedError(self.path, self.owner)

    def take_if_free(self) -> bool:
        """Make the file ours if nobody else has it open by now; return whether it is ours."""
        result = acquire(_lock_path(self.path))
        if result.owner is not None:
            self.owner = result.owner
            return False
        self._take(result)
        return True

    def is_at(self, path: Path) -> bool:
        """Whether `path` leads to this file."""
        return _target(path) == _target(self.path)

    @property
    def is_older(self) -> bool:
        """Whether it is of an older version of the format; the first save then keeps a copy beside it."""
        return self.version < VERSION

    # Whose it is

    def check_lock(self) -> Owner | None:
        """Return who has the file open now; None where it is ours or free. `owner` stays as it was."""
        if self._lock is not None:
            return self._lock.lost_to()
        return owner_of(_lock_path(self.path)) if self.owner is not None else None

    def lose_to(self, owner: Owner) -> None:
        """Take note that somebody else has the file now."""
        self.owner, self._lock = owner, None
        _log.info("the lock is %s now", str(LockResult(owner=owner)))

    def take_over(self) -> None:
        """Make the file ours, whoever has it open."""
        if not self.take_if_free():
            self._take(take_over(_lock_path(self.path)))
            _log.info("the lock was taken over")

    def close(self) -> None:
        """Tell the others that the file is open here no longer."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    # What it holds

    def check(self) -> FileChange:
        """Return what has become of the file since it was seen last; quick where nothing has."""
        try:
            status = _target(self.path).stat()
        except FileNotFoundError:
            return FileChange.SAME if self.stamp is None else FileChange.GONE
        except OSError:
            return FileChange.UNREADABLE
        if self.stamp is not None and self.stamp.is_of(status):
            return FileChange.SAME
        if self._seen is not None and self._seen[0].is_of(status):
            return self._seen[1]
        return self._read_again()

    def _read_again(self) -> FileChange:
        try:
            content = files.read_content(self.path)
        except MissingError:
            return FileChange.GONE
        except StorageError:
            return FileChange.UNREADABLE
        if self.stamp is not None and content.stamp.digest == self.stamp.digest:
            # Touched, copied or checked out again, with the same content.
            self.stamp = content.stamp
            return FileChange.SAME
        document = None
        try:
            document = files.document_in(content.data, self.path).document
        except FormatError:
            change = FileChange.UNREADABLE
        else:
            change = FileChange.CHANGED
        self._seen = (content.stamp, change, document)
        return change

    @property
    def has_lost_document(self) -> bool:
        """Whether the document that came from it is in it no longer, and nobody else is to care for that."""
        is_for_owner = self.change is FileChange.CHANGED and self.owner is not None
        return self.change is not FileChange.SAME and not is_for_owner

    @property
    def other_document(self) -> Document | None:
        """The document that the last look found in the file, where it was changed."""
        return self._seen[2] if self._seen is not None else None

    def accept(self) -> None:
        """Take what the file holds now as seen: the next save replaces it."""
        change = self.check()
        if change is FileChange.GONE:
            self.stamp = None
        elif change is not FileChange.SAME and self._seen is not None:
            self.stamp = self._seen[0]
        self.change, self._seen = FileChange.SAME, None

    def read_again(self) -> Document:
        """Return the document that the file holds now, and take it as seen; see `files.load`."""
        content = files.read_content(self.path)
        found = files.document_in(content.data, self.path)
        self.stamp, self._seen, self.change = content.stamp, None, FileChange.SAME
        self.version, self.left_out = _version(content.data), found.left_out
        return found.document


def _lock_for(path: Path, previous: OpenFile | None) -> LockResult:
    """Return the lock of the file at `path`, from `previous` where that has it."""
    if previous is None or previous._lock is None or not previous.is_at(path):
        return acquire(_lock_path(path))
    owner = previous._lock.lost_to()
    if owner is not None:
        return LockResult(owner=owner)
    lock, previous._lock = previous._lock, None
    return LockResult(lock=lock)


def _lock_path(path: Path) -> Path:
    return lock_path(_target(path))


def _counts(document: Document) -> str:
    points = sum(len(curve.points) for curve in document.curves)
    return f"{len(document.curves)} curves, {points} points"


def _version(data: bytes) -> int:
    found = version_of(data)
    return VERSION if found is None else found


def _target(path: Path) -> Path:
    """Return the file itself where `path` is a link to it."""
    try:
        return Path(os.path.realpath(path))
    except (OSError, ValueError):
        return path
