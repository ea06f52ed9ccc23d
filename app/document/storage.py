"""Documents on disk: what was saved is whole, and a save that failed leaves the old file as it was.

Writing goes to a temporary file in the same folder, which is flushed to the disk and then put in place of
the old one in one step. Qt's QSaveFile is not used: on a full disk it replaced a good file by a truncated
one (measured with Qt 6.12).
"""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from app.document.format import decode, encode
from app.document.image_path import relative_to, resolved
from app.document.model import Document

MAX_BYTES = 256 * 2**20
"""Largest file that is read: some four million points; beyond it a file is hardly a drawing."""

TEMPORARY_PREFIX = ".curvebench-"
"""Begins the name of every temporary file, so that what a power cut left behind can be recognised."""

_FOLDER_SYNC_UNSUPPORTED = frozenset({errno.EINVAL, errno.ENOTSUP, errno.EACCES})
_DISK_FULL = frozenset({errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)})


class StorageError(OSError):
    """A file cannot be read or written; the message says which, why, and what to do."""


def load(path: str | os.PathLike[str]) -> Document:
    """Return the document in the file at `path`, with the absolute path of its image.

    Raises
    ------
    StorageError
        If the file cannot be read.
    FormatError
        If it holds no valid document.
    """
    return resolved(decode(read(path)), _folder(path))


def save(path: str | os.PathLike[str], document: Document) -> None:
    """Write `document` to `path`, whole or not at all; its image is found again relative to `path`.

    Raises
    ------
    FormatError
        If the document is not valid; nothing is written.
    StorageError
        If the file cannot be written; the old one is still there.
    """
    write(path, encode(relative_to(document, _folder(path))))


def _folder(path: str | os.PathLike[str]) -> str:
    return os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links are kept as they are


def read(path: str | os.PathLike[str]) -> bytes:
    """Return the content of the regular file at `path`, at most `MAX_BYTES` long.

    Raises
    ------
    StorageError
        For folders, pipes, devices and files that are too large, missing or not permitted.
    """
    # Without O_NONBLOCK, opening a pipe would wait for a writer.
    flags = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    try:
        descriptor = os.open(path, flags)
        try:
            _refuse_irregular(path, os.fstat(descriptor))
            with os.fdopen(descriptor, "rb", closefd=False) as file:
                data = file.read(MAX_BYTES + 1)
        finally:
            os.close(descriptor)
    except StorageError:
        raise
    except (OSError, ValueError) as problem:
        raise StorageError(_why_unreadable(path, problem)) from problem
    if len(data) > MAX_BYTES:
        raise StorageError(f"{_name(path)} is larger than {MAX_BYTES // 2**20} MB; open a smaller file.")
    return data


def write(path: str | os.PathLike[str], data: bytes) -> None:
    """Put `data` into the file at `path`, whole or not at all.

    The permissions of an existing file are kept, symbolic links are followed, and no temporary file is
    left behind. When this returns, the data is on the disk.

    Raises
    ------
    StorageError
        If any step fails; the old file is then untouched, except where the disk failed to confirm the
        very last step, which is then said.
    """
    try:
        target = Path(os.path.realpath(path))
        mode = _mode_to_keep(path, target)
        temporary = _write_temporary(target.parent, data, mode)
        try:
            temporary.replace(target)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except StorageError:
        raise
    except (OSError, ValueError) as problem:
        raise StorageError(_why_unwritable(path, problem)) from problem
    _confirm(path, target.parent)


def _mode_to_keep(path: str | os.PathLike[str], target: Path) -> int | None:
    """Return the permissions of the existing file, or None for a new one."""
    try:
        status = target.stat()
    except FileNotFoundError:
        return None
    _refuse_irregular(path, status)
    # Replacing a file needs no permission on the file itself, so that a write-protected one would go too.
    if not os.access(target, os.W_OK):
        raise StorageError(f"{_name(path)} is write-protected. Save under another name.")
    return stat.S_IMODE(status.st_mode)


def _write_temporary(folder: Path, data: bytes, mode: int | None) -> Path:
    """Write `data` to a new file in `folder`, down to the disk, and return its path."""
    path = folder / f"{TEMPORARY_PREFIX}{os.urandom(8).hex()}.tmp"
    # O_EXCL: a file or link that someone put there first is never followed. The umask gives the mode.
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0)
    descriptor = os.open(path, flags, 0o666 if mode is None else 0o600)
    try:
        try:
            with os.fdopen(descriptor, "wb", closefd=False) as file:
                file.write(data)
            if mode is not None:
                path.chmod(mode)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except BaseException:
        path.unlink(missing_ok=True)
        raise
    return path


def _confirm(path: str | os.PathLike[str], folder: Path) -> None:
    """Bring the folder's new entry to the disk, where the system can."""
    if os.name == "nt":  # Windows opens no folders.
        return
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as problem:
        # Some network file systems cannot do it, and some folders may be written but not read.
        if problem.errno in _FOLDER_SYNC_UNSUPPORTED:
            return
        raise StorageError(
            f"{_name(path)} was written, but the disk did not confirm it ({_reason(problem)}). "
            "Save a copy on another disk."
        ) from problem


def _refuse_irregular(path: str | os.PathLike[str], status: os.stat_result) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise StorageError(f"{_name(path)} is a folder. Choose a file.")
    if not stat.S_ISREG(status.st_mode):
        raise StorageError(f"{_name(path)} is a pipe or a device. Choose an ordinary file.")
    if status.st_size > MAX_BYTES:
        raise StorageError(f"{_name(path)} is larger than {MAX_BYTES // 2**20} MB. Choose a smaller file.")


def _why_unreadable(path: str | os.PathLike[str], problem: Exception) -> str:
    code = getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"There is no file {_name(path)}. Check its name and folder."
    if code in (errno.EACCES, errno.EPERM):
        return f"{_name(path)} may not be read. Ask its owner for permission, or choose another file."
    if code == errno.ELOOP:
        return f"{_name(path)} is a link that leads back to itself. Choose another file."
    return f"{_name(path)} cannot be read ({_reason(problem)}). Choose another file."


def _why_unwritable(path: str | os.PathLike[str], problem: Exception) -> str:
    code = getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"The folder of {_name(path)} does not exist. Choose another folder."
    if code in _DISK_FULL:
        return f"The disk is full; {_name(path)} was not written. Free some space or choose another disk."
    if code in (errno.EACCES, errno.EPERM, errno.EROFS):
        return f"{_name(path)} may not be written in that folder. Choose another folder."
    if code == errno.ELOOP:
        return f"{_name(path)} is a link that leads back to itself. Choose another name."
    if code == errno.ENAMETOOLONG:
        return f"The name of {_name(path)} is too long. Choose a shorter one."
    return f"{_name(path)} was not written ({_reason(problem)}). Choose another folder or disk."


def _reason(problem: Exception) -> str:
    return getattr(problem, "strerror", None) or str(problem)


def _name(path: str | os.PathLike[str]) -> str:
    """Return the path as it may stand in a sentence, whatever bytes it holds."""
    text = os.fspath(path)
    return f"“{text.encode('utf-8', 'replace').decode('utf-8')}”"
