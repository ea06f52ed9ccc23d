"""Permissions of a file, kept where another one takes its place."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path


def keep_access(path: Path, like: Path) -> None:
    """Give the file at `path` owner, group, permissions and attributes of `like`, as far as one may."""
    wanted, own = like.stat(), path.stat()
    mode = stat.S_IMODE(wanted.st_mode)
    if hasattr(os, "chown") and (wanted.st_uid, wanted.st_gid) != (own.st_uid, own.st_gid):
        try:
            os.chown(path, wanted.st_uid, wanted.st_gid)
        except OSError:
            mode = _mode_for_other_owner(path, wanted)
    if hasattr(os, "listxattr"):
        # Access lists among them; not every file system has them, and some are the system's own.
        with suppress(OSError):
            for name in os.listxattr(like):
                with suppress(OSError):
                    os.setxattr(path, name, os.getxattr(like, name))
    path.chmod(mode)


def _mode_for_other_owner(path: Path, wanted: os.stat_result) -> int:
    """Return the permissions where only the group can be kept, or not even that."""
    mode = stat.S_IMODE(wanted.st_mode) & 0o777
    try:
        os.chown(path, -1, wanted.st_gid)
    except OSError:
        # Another group than the old one may do no more than everybody.
        mode = mode & ~0o070 | (mode & 0o007) << 3
    return mode
