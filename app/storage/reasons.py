"""Sentences about files that cannot be read or written: which, why, and what to do."""

from __future__ import annotations

import errno
import os

_DISK_FULL = frozenset({errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)})


def why_unreadable(path: str | os.PathLike[str], problem: Exception) -> str:
    """Return why a file cannot be read, and what to do."""
    code = getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"There is no file {quoted(path)}. Check its name and folder."
    if code in (errno.EACCES, errno.EPERM):
        return f"{quoted(path)} may not be read. Ask its owner for permission, or choose another file."
    if code == errno.ELOOP:
        return f"{quoted(path)} is a link that leads back to itself. Choose another file."
    return f"{quoted(path)} cannot be read ({reason_of(problem)}). Choose another file."


def why_unwritable(path: str | os.PathLike[str], problem: Exception) -> str:
    """Return why a file was not written, and what to do."""
    code = getattr(problem, "errno", None)
    if code in (errno.ENOENT, errno.ENOTDIR):
        return f"The folder of {quoted(path)} does not exist. Choose another folder."
    if code in _DISK_FULL:
        return f"The disk is full; {quoted(path)} was not written. Free some space or choose another disk."
    if code in (errno.EACCES, errno.EPERM, errno.EROFS):
        return f"{quoted(path)} may not be written in that folder. Choose another folder."
    if code == errno.ELOOP:
        return f"{quoted(path)} is a link that leads back to itself. Choose another name."
    if code == errno.ENAMETOOLONG:
        return f"The name of {quoted(path)} is too long. Choose a shorter one."
    return f"{quoted(path)} was not written ({reason_of(problem)}). Choose another folder or disk."


def reason_of(problem: Exception) -> str:
    """Return what the system says of an error."""
    return getattr(problem, "strerror", None) or str(problem)


def quoted(path: str | os.PathLike[str]) -> str:
    """Return the path in quotation marks, as it may stand in a sentence, whatever bytes it holds."""
    return f"“{_decodable(path)}”"


def shown(path: str | os.PathLike[str]) -> str:
    """Return the path as it may stand in a line, whatever bytes it holds."""
    return "".join(each if each.isprintable() else "\N{REPLACEMENT CHARACTER}" for each in _decodable(path))


def _decodable(path: str | os.PathLike[str]) -> str:
    return os.fspath(path).encode("utf-8", "replace").decode("utf-8")
