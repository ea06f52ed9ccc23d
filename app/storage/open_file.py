"""File of an open document: its lock, the version that was last read, and changes by other programs since."""

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
"""Bytes from which a document is opened in the background: about a hundred curves, a tenth of a second."""


def is_large(path: Path) -> bool:
    """Return whether reading a document may take a while."""
    try:
        return path.stat().st_size >= _LARGE
    except OSError:
        return False  # opening it reports the problem


class LockedError(StorageError):
    """The file is open elsewhere, by `owner`."""

    def __init__(self, path: Path, owner: Owner) -> None:
        super().__init__(f"“{path.name}” is open elsewhere. Save under another name.")
        self.owner = owner


class FileChange(Enum):
    """Change of a file since it was last read; the value is a sentence."""

    SAME = ""
    CHANGED = "Another program has changed the file."
    """It contains another document."""
    UNREADABLE = "Another program has emptied or damaged the file."
    """It contains no document, perhaps because another program is writing it."""
    GONE = "The file is no longer in its folder."


class OpenedDocument(msgspec.Struct, frozen=True):
    """Document and the file that it was opened from."""

    document: Document
    file: OpenFile


class LoadedDocument(msgspec.Struct, frozen=True):
    """Document that was read from a file, with the stamp of the file.

    Attributes
    ----------
    version
        Version of the file format.
    left_out
        Features of an older version that were left out.
    """

    document: Document
    stamp: Stamp
    version: int
    left_out: LeftOut

    @classmethod
    def of(cls, path: Path) -> LoadedDocument:
        """Read the file at `path`; see `files.load` for the errors."""
        content = files.read_content(path)
        decoded = files.document_in(content.data, path)
        document = with_plain_numbers(decoded.document)
        return cls(document, content.stamp, _version(content.data), decoded.left_out)


class OpenFile:
    """File of a window's document.

    Attributes
    ----------
    path
        Its path, as the person entered it.
    stamp
        Its stamp when it was last read, written or accepted; None if it did not exist.
    version
        Version of its format, as far as is known.
    left_out
        Features of an older version that it has besides the document.
    owner
        The other owner of its lock, which prevents saving; None if the lock is ours.
    lock_problem
        Reason why others cannot see that it is open here; empty for none.
    change
        The last noted change by another program.
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
        self._last_check: tuple[Stamp, FileChange, Document | None] | None = None
        self._take(result)

    def _take(self, result: LockResult) -> None:
        self._lock, self.owner, self.lock_problem = result.lock, result.owner, result.problem

    # Opening and saving

    @classmethod
    def open(
        cls, path: Path, previous: OpenFile | None = None, loaded: LoadedDocument | None = None
    ) -> OpenedDocument:
        """Read the document at `path` and lock it; see `files.load` for the errors.

        `previous` is the file that was open in this window; its lock is kept if it is the same file. `loaded`
        is its content if it was read before.
        """
        loaded = loaded or LoadedDocument.of(path)
        # A change between reading and locking is noticed like any later change.
        result = _lock_for(path, previous)
        remove_stale_files(_target(path).parent)
        _log.info("opened a document, version %d, %s", loaded.version, _counts(loaded.document))
        _log.info("its lock is %s", str(result))
        file = cls(path, loaded.stamp, result, loaded.version, loaded.left_out)
        return OpenedDocument(loaded.document, file)

    @classmethod
    def adopt(cls, path: Path, previous: OpenFile | None = None) -> OpenFile:
        """Return the file at `path` for a document that was not read from it, such as a recovered one.

        Its present content counts as read. `previous` is as in `open`.
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
        """Write `document` to `path` and return its file from then on.

        Parameters
        ----------
        overwrite
            Whether to replace a file that has changed since it was last read.

        Raises
        ------
        LockedError
            If the file is open elsewhere.
        StorageError, FormatError
            As `files.save`; `previous` then stays the file of the document.
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
            self.stamp = files.save(self.path, document, expected=None if overwrite else self.stamp)
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
        """Lock the file if it has no other owner by now; return whether the lock is ours."""
        result = acquire(_lock_path(self.path))
        if result.owner is not None:
            self.owner = result.owner
            return False
        self._take(result)
        return True

    def is_at(self, path: Path) -> bool:
        """Return whether `path` leads to this file."""
        return _target(path) == _target(self.path)

    @property
    def is_older(self) -> bool:
        """Whether the format is of an older version; the first save then makes a backup beside it."""
        return self.version < VERSION

    # The lock

    def check_lock(self) -> Owner | None:
        """Return the present other owner of the lock, or None; the attribute `owner` does not change."""
        if self._lock is not None:
            return self._lock.lost_to()
        return owner_of(_lock_path(self.path)) if self.owner is not None else None

    def lose_to(self, owner: Owner) -> None:
        """Record another owner of the lock."""
        self.owner, self._lock = owner, None
        _log.info("the lock is %s now", str(LockResult(owner=owner)))

    def take_over(self) -> None:
        """Take the lock over from any owner."""
        if not self.take_if_free():
            self._take(take_over(_lock_path(self.path)))
            _log.info("the lock was taken over")

    def close(self) -> None:
        """Release the lock."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None

    # Changes by other programs

    def check(self) -> FileChange:
        """Return the change of the file since it was last read; fast if there is none."""
        try:
            status = _target(self.path).stat()
        except FileNotFoundError:
            return FileChange.SAME if self.stamp is None else FileChange.GONE
        except OSError:
            return FileChange.UNREADABLE
        if self.stamp is not None and self.stamp.is_of(status):
            return FileChange.SAME
        if self._last_check is not None and self._last_check[0].is_of(status):
            return self._last_check[1]
        return self._read_again()

    def _read_again(self) -> FileChange:
        try:
            content = files.read_content(self.path)
        except MissingError:
            return FileChange.GONE
        except StorageError:
            return FileChange.UNREADABLE
        if self.stamp is not None and content.stamp.digest == self.stamp.digest:
            # Touched, copied or checked out again: the content is the same.
            self.stamp = content.stamp
            return FileChange.SAME
        document = None
        try:
            document = files.document_in(content.data, self.path).document
        except FormatError:
            change = FileChange.UNREADABLE
        else:
            change = FileChange.CHANGED
        self._last_check = (content.stamp, change, document)
        return change

    @property
    def has_lost_document(self) -> bool:
        """Whether the file no longer contains the document, and no other owner is responsible for that."""
        is_for_owner = self.change is FileChange.CHANGED and self.owner is not None
        return self.change is not FileChange.SAME and not is_for_owner

    @property
    def other_document(self) -> Document | None:
        """The document that another program wrote to the file, as last read."""
        return self._last_check[2] if self._last_check is not None else None

    def accept(self) -> None:
        """Accept the present content of the file: the next save replaces it."""
        change = self.check()
        if change is FileChange.GONE:
            self.stamp = None
        elif change is not FileChange.SAME and self._last_check is not None:
            self.stamp = self._last_check[0]
        self.change, self._last_check = FileChange.SAME, None

    def read_again(self) -> Document:
        """Return the present document in the file, and accept it; see `files.load`."""
        content = files.read_content(self.path)
        decoded = files.document_in(content.data, self.path)
        self.stamp, self._last_check, self.change = content.stamp, None, FileChange.SAME
        self.version, self.left_out = _version(content.data), decoded.left_out
        return decoded.document


def _lock_for(path: Path, previous: OpenFile | None) -> LockResult:
    """Return the lock of the file at `path`, that of `previous` if it is the same file."""
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
    version = version_of(data)
    return VERSION if version is None else version


def _target(path: Path) -> Path:
    """Return the path with links resolved, if that is possible."""
    try:
        return Path(os.path.realpath(path))
    except (OSError, ValueError):
        return path
