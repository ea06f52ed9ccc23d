"""Documents on disk: a saved file is complete, and a save that fails leaves the old file unchanged.

A save writes a temporary file in the same folder, flushes it to the disk, and renames it to the file in one
step. Qt's QSaveFile is not used: on a full disk it replaced a good file by a truncated one (measured with Qt
6.12).

In reading order: `load` and `save`; `read` and `write` for any bytes; access rights; names of temporary
files; the path of a reference image; messages about files that cannot be read or written.
"""

from __future__ import annotations

import errno
import logging
import os
import os.path
import re
import stat
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import perf_counter

import msgspec
from msgspec.structs import replace

from .. import storage
from ..document.model import Document
from .format import VERSION, Decoded, decode_counting, encode, version_of
from .system import folder_lock, is_number_alive, machine

_log = logging.getLogger("curvebench.storage")

MAX_BYTES = 256 * 2**20
"""Largest file that is read: about four million points."""

_FOLDER_SYNC_UNSUPPORTED = frozenset({errno.EINVAL, errno.ENOTSUP, errno.EACCES})


class Stamp(msgspec.Struct, frozen=True):
    """Fingerprint of a file when it was read or written, to detect that it has changed since."""

    size: int
    modified: int
    inode: int
    device: int
    digest: bytes

    def is_of(self, status: os.stat_result) -> bool:
        """Return whether a file with this status is most likely the same, without reading it."""
        known = (self.size, self.modified, self.inode, self.device)
        return known == (status.st_size, status.st_mtime_ns, status.st_ino, status.st_dev)


class Content(msgspec.Struct, frozen=True):
    """Content of a file, and its stamp at that moment."""

    data: bytes
    stamp: Stamp


class StorageError(OSError):
    """A file cannot be read or written; the message gives the reason and a remedy."""


class MissingError(StorageError):
    """The file does not exist."""


class ChangedOnDiskError(StorageError):
    """The file has changed since it was last read; nothing was written."""


class NewerVersionError(StorageError):
    """The file was written by a newer version of the program; it was not replaced."""


class UnconfirmedError(StorageError):
    """The file was written, but the disk did not confirm it; `stamp` is that of the new content."""

    def __init__(self, message: str, stamp: Stamp) -> None:
        super().__init__(message)
        self.stamp = stamp


def load(path: str | os.PathLike[str]) -> Document:
    """Return the document in the file at `path`, with the absolute path of its reference image.

    Raises
    ------
    StorageError
        If the file cannot be read.
    FormatError
        If its content is not a valid document.
    """
    return load_counting(path).document


def load_counting(path: str | os.PathLike[str]) -> Decoded:
    """Return the document in the file at `path`, and the features of an older version that were left out."""
    return document_in(read(path), path)


def document_in(data: bytes, path: str | os.PathLike[str]) -> Decoded:
    """Return the document in `data`, the content of the file at `path`; see `load_counting`."""
    decoded = decode_counting(data)
    return Decoded(with_absolute_image_path(decoded.document, folder_of(path)), decoded.left_out)


def save(path: str | os.PathLike[str], document: Document, *, expected: Stamp | None = None) -> Stamp:
    """Write a document to `path`, completely or not at all, with the path of its image relative to `path`.

    A file of an older version of the format is first copied to a backup (``name.v0.bak``); a file of a newer
    version is not replaced.

    Parameters
    ----------
    expected
        Stamp of the file when it was last read: a file that has changed since is not replaced. By default any
        file is replaced.

    Raises
    ------
    FormatError
        If the document is not valid; nothing is written.
    StorageError
        If the file cannot be written; the old file is unchanged.
    """
    data = encode(with_relative_image_path(document, folder_of(path)))
    return write(path, data, before_replacing=lambda target: _check_replaceable(path, target, expected))


def _check_replaceable(path: str | os.PathLike[str], target: Path, expected: Stamp | None) -> None:
    """Raise StorageError if the file must not be replaced; back up a file of an older version."""
    try:
        present = read_content(target)
    except MissingError:
        return
    except StorageError:
        # The file may be written but not read: compare its status in the folder instead.
        if expected is not None and not expected.is_of(target.stat()):
            raise _changed(path) from None
        return
    if expected is not None and present.stamp.digest != expected.digest:
        raise _changed(path)
    version = version_of(present.data)
    if version is not None and version > VERSION:
        raise NewerVersionError(
            f"{quoted_path(path)} was written by a newer version of Curvebench and was not replaced. "
            "Save under another name."
        )
    if version is not None and version < VERSION:
        keep_backup(target, present.data, f"v{version}")


def _changed(path: str | os.PathLike[str]) -> ChangedOnDiskError:
    return ChangedOnDiskError(
        f"{quoted_path(path)} was changed by another program since it was opened. "
        "Save under another name, or compare with the file first."
    )


def keep_backup(target: Path, data: bytes, mark: str) -> Path:
    """Write the old content to a backup beside the file, under an unused name, and return its path.

    Raises
    ------
    OSError
        If the backup cannot be written.
    """
    temporary, _ = _write_temporary(target.parent, data, target)
    try:
        for number in range(1, 1000):
            backup = target.with_name(f"{target.name}.{mark}{f'.{number}' if number > 1 else ''}.bak")
            if backup.exists() and backup.read_bytes() == data:
                return backup
            if _placed(temporary, backup):
                return backup
        raise StorageError(f"There are already {number} backups of {quoted_path(target)}. Remove some.")
    finally:
        temporary.unlink(missing_ok=True)


def _placed(temporary: Path, name: Path) -> bool:
    """Rename a temporary file to `name` unless that exists; return whether it was renamed."""
    try:
        os.link(temporary, name)
    except FileExistsError:
        return False
    except OSError:
        # The file system has no hard links, as on a memory stick.
        if name.exists():
            return False
        temporary.rename(name)
    return True


def folder_of(path: str | os.PathLike[str]) -> str:
    """Return the absolute folder of a path, links not resolved."""
    return os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links are not resolved


def read(path: str | os.PathLike[str]) -> bytes:
    """Return the content of the regular file at `path`, at most `MAX_BYTES` long.

    Raises
    ------
    StorageError
        For folders, pipes, devices and files that are too large, missing or not permitted.
    """
    return read_content(path).data


def read_content(path: str | os.PathLike[str]) -> Content:
    """Return the content of the file at `path` with its stamp; see `read`."""
    with _logged("read") as size:
        content = _content(path)
        size.append(len(content.data))
    return content


def _content(path: str | os.PathLike[str]) -> Content:
    # Without O_NONBLOCK, opening a pipe would wait for a writer.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags)
        try:
            status = os.fstat(descriptor)
            _refuse_irregular(path, status)
            with os.fdopen(descriptor, "rb", closefd=False) as file:
                data = file.read(MAX_BYTES + 1)
        finally:
            os.close(descriptor)
    except StorageError:
        raise
    except FileNotFoundError as problem:
        raise MissingError(unreadable_message(path, problem)) from problem
    except (OSError, ValueError) as problem:
        raise StorageError(unreadable_message(path, problem)) from problem
    if len(data) > MAX_BYTES:
        raise _too_large(path)
    return Content(data, _stamp(status, data))


@contextmanager
def _logged(verb: str) -> Iterator[list[int]]:
    """Log the number of bytes that were read or written and the time, or the code of the error."""
    began, size = perf_counter(), list[int]()
    try:
        yield size
    except StorageError as problem:
        code = getattr(problem.__cause__, "errno", None)
        _log.info("not %s: %s", verb, errno.errorcode.get(code or 0, type(problem).__name__))
        raise
    _log.debug("%s %d bytes in %.0f ms", verb, *size, 1e3 * (perf_counter() - began))


def _stamp(status: os.stat_result, data: bytes) -> Stamp:
    digest = storage.digests.sha256(data)
    return Stamp(status.st_size, status.st_mtime_ns, status.st_ino, status.st_dev, digest)


def write(
    path: str | os.PathLike[str], data: bytes, *, before_replacing: Callable[[Path], None] | None = None
) -> Stamp:
    """Write `data` to the file at `path`, completely or not at all, and return the stamp of the file.

    The permissions of an existing file are kept, symbolic links are followed, and no temporary file is
    left behind. When this returns, the data is on the disk.

    Parameters
    ----------
    before_replacing
        Called with the file that is about to be replaced, while no other Curvebench works in its folder; an
        exception leaves the old file unchanged.

    Raises
    ------
    StorageError
        If any step fails; the old file is then unchanged, except for `UnconfirmedError`.
    """
    with _logged("written") as size:
        stamp = _write(path, data, before_replacing)
        size.append(len(data))
    return stamp


def _write(
    path: str | os.PathLike[str], data: bytes, before_replacing: Callable[[Path], None] | None
) -> Stamp:
    try:
        target = Path(os.path.realpath(path))
        _refuse_unwritable(path, target)
        temporary, status = _write_temporary(target.parent, data, target)
        try:
            with folder_lock(target.parent):
                if before_replacing is not None:
                    before_replacing(target)
                temporary.replace(target)
        except BaseException:
            with suppress(OSError):
                temporary.unlink(missing_ok=True)
            raise
    except StorageError:
        raise
    except (OSError, ValueError) as problem:
        raise StorageError(unwritable_message(path, problem)) from problem
    stamp = _stamp(status, data)
    _confirm(path, target.parent, stamp)
    return stamp


def _refuse_unwritable(path: str | os.PathLike[str], target: Path) -> None:
    try:
        status = target.stat()
    except FileNotFoundError:
        return
    _refuse_irregular(path, status)
    # Replacing a file needs no permission for the file itself: a write-protected file would be replaced.
    if not os.access(target, os.W_OK):
        raise StorageError(f"{quoted_path(path)} is write-protected. Save under another name.")


def _write_temporary(folder: Path, data: bytes, like: Path) -> tuple[Path, os.stat_result]:
    """Write `data` to a new file in `folder`, flushed to the disk, with the access rights of `like`."""
    path = folder / temporary_name()
    # O_EXCL: an existing file or link is never followed. The umask determines the mode.
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    replaces = like.exists()
    descriptor = os.open(path, flags, 0o600 if replaces else 0o666)
    try:
        try:
            with os.fdopen(descriptor, "wb", closefd=False) as file:
                file.write(data)
            if replaces:
                keep_access(path, like)
            os.fsync(descriptor)
            status = os.fstat(descriptor)
        finally:
            os.close(descriptor)
    except BaseException:
        with suppress(OSError):
            path.unlink(missing_ok=True)
        raise
    return path, status


def _confirm(path: str | os.PathLike[str], folder: Path, stamp: Stamp) -> None:
    """Flush the new entry of the folder to the disk, where the system can."""
    if os.name == "nt":  # Windows opens no folders.
        return
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as problem:
        # Some network file systems cannot flush folders, and some folders may be written but not read.
        if problem.errno in _FOLDER_SYNC_UNSUPPORTED:
            return
        raise UnconfirmedError(
            f"{quoted_path(path)} was written, but the disk did not confirm it ({reason_of(problem)}). "
            "Save a copy on another disk.",
            stamp,
        ) from problem


def _refuse_irregular(path: str | os.PathLike[str], status: os.stat_result) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise StorageError(f"{quoted_path(path)} is a folder. Choose a file.")
    if not stat.S_ISREG(status.st_mode):
        raise StorageError(f"{quoted_path(path)} is a pipe or a device. Choose a regular file.")
    if status.st_size > MAX_BYTES:
        raise _too_large(path)


def _too_large(path: str | os.PathLike[str]) -> StorageError:
    return StorageError(f"{quoted_path(path)} is larger than {MAX_BYTES // 2**20} MB. Open a smaller file.")


# Access rights


def keep_access(path: Path, like: Path) -> None:
    """Give the file at `path` owner, group, permissions and attributes of `like`, as far as permitted."""
    wanted, present = like.stat(), path.stat()
    mode = stat.S_IMODE(wanted.st_mode)
    if hasattr(os, "chown") and (wanted.st_uid, wanted.st_gid) != (present.st_uid, present.st_gid):
        try:
            os.chown(path, wanted.st_uid, wanted.st_gid)
        except OSError:
            mode = _mode_for_other_owner(path, wanted)
    if hasattr(os, "listxattr"):
        # They include access lists; not every file system has them, and some belong to the system.
        with suppress(OSError):
            for name in os.listxattr(like):
                with suppress(OSError):
                    os.setxattr(path, name, os.getxattr(like, name))
    path.chmod(mode)


def _mode_for_other_owner(path: Path, wanted: os.stat_result) -> int:
    """Return the permissions for a file whose owner, and perhaps group, cannot be kept."""
    mode = stat.S_IMODE(wanted.st_mode) & 0o777
    try:
        os.chown(path, -1, wanted.st_gid)
    except OSError:
        # Another group than the old one gets the permissions of everybody.
        mode = mode & ~0o070 | (mode & 0o007) << 3
    return mode


# Temporary files

TEMPORARY_PREFIX = ".curvebench-"
"""Prefix of the names of temporary files, to recognise those that a power cut left behind."""

LEFT_BEHIND = 600.0
"""Seconds after which a temporary file of a process that has ended is removed."""

_NAME = re.compile(re.escape(TEMPORARY_PREFIX) + r"([0-9a-f]{8})-([1-9][0-9]{0,9})-[0-9a-f]{16}\.tmp")
_COMPUTER_DIGITS = 8


def temporary_name() -> str:
    """Return a new name for a temporary file, with the computer and the process that own it."""
    return f"{TEMPORARY_PREFIX}{machine()[:_COMPUTER_DIGITS]}-{os.getpid()}-{os.urandom(8).hex()}.tmp"


def remove_stale_files(folder: Path, older_than: float = LEFT_BEHIND) -> int:
    """Remove the temporary files in `folder` whose process has ended, and return their number.

    Only regular files of this program, this person and this computer are removed, if they were not touched
    for `older_than` seconds. Files that cannot be removed stay.
    """
    removed = 0
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.startswith(TEMPORARY_PREFIX) and _is_left_behind(entry, older_than):
                with suppress(OSError):
                    Path(entry.path).unlink()
                    removed += 1
    return removed


def _is_left_behind(entry: os.DirEntry[str], older_than: float) -> bool:
    match = _NAME.fullmatch(entry.name)
    if match is None or match[1] != machine()[:_COMPUTER_DIGITS]:
        return False
    try:
        status = entry.stat(follow_symlinks=False)
    except OSError:
        return False
    is_ours = not hasattr(os, "geteuid") or status.st_uid == os.geteuid()
    is_old = time.time() - status.st_mtime > older_than
    return stat.S_ISREG(status.st_mode) and is_ours and is_old and is_number_alive(int(match[2])) is False


# Path of the reference image: absolute in an open document, relative in its file

IMAGE_SUFFIXES = (".png", ".jpg", ".jpeg")
"""Endings of image files that can be a reference image."""
IMAGE_PATTERNS = " ".join(f"*{suffix}" for suffix in IMAGE_SUFFIXES)
"""The same as patterns for a file dialog."""


def with_absolute_image_path(document: Document, folder: str) -> Document:
    """Return a document that was read from a file in `folder`, with the absolute path of its image."""
    if document.image is None:
        return document
    path = os.path.normpath(Path(folder) / document.image.path)
    return replace(document, image=replace(document.image, path=path))


def with_relative_image_path(document: Document, folder: str) -> Document:
    """Return a document as it is written to a file in `folder`, with the relative path of its image."""
    if document.image is None:
        return document
    path = document.image.path
    if Path(path).is_absolute():
        with suppress(ValueError):  # another drive of Windows has no relative path
            path = os.path.relpath(path, folder)
    if os.sep != "/":
        path = path.replace(os.sep, "/")
    return replace(document, image=replace(document.image, path=path))


# Messages

_DISK_FULL = frozenset({errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)})


def unreadable_message(path: str | os.PathLike[str], problem: Exception) -> str:
    """Return the message that a file cannot be read, with the reason and a remedy."""
    name, code = quoted_path(path), getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"There is no file {name}. Check its name and folder."
    if code in (errno.EACCES, errno.EPERM):
        return f"You have no permission to read {name}. Ask its owner, or choose another file."
    if code == errno.ELOOP:
        return f"{name} is a link to itself. Choose another file."
    return f"{name} cannot be read ({reason_of(problem)}). Choose another file."


def unwritable_message(path: str | os.PathLike[str], problem: Exception) -> str:
    """Return the message that a file was not written, with the reason and a remedy."""
    name, code = quoted_path(path), getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"The folder of {name} does not exist. Choose another folder."
    if code in _DISK_FULL:
        return f"The disk is full; {name} was not written. Free some space or choose another disk."
    if code in (errno.EACCES, errno.EPERM, errno.EROFS):
        return f"{name} cannot be written in that folder. Choose another folder."
    if code == errno.ELOOP:
        return f"{name} is a link to itself. Choose another name."
    if code == errno.ENAMETOOLONG:
        return f"The name {name} is too long. Choose a shorter one."
    return f"{name} was not written ({reason_of(problem)}). Choose another folder or disk."


def reason_of(problem: Exception) -> str:
    """Return the operating system's description of an error."""
    return getattr(problem, "strerror", None) or str(problem)


def quoted_path(path: str | os.PathLike[str]) -> str:
    """Return a path in quotation marks for a sentence, whatever bytes it contains."""
    return f"“{_decodable(path)}”"


def printable_path(path: str | os.PathLike[str]) -> str:
    """Return a path as one printable line, whatever bytes it contains."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in _decodable(path))


def _decodable(path: str | os.PathLike[str]) -> str:
    return os.fspath(path).encode("utf-8", "replace").decode("utf-8")
