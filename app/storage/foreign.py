"""Files of other formats that documents were opened from."""

from __future__ import annotations

from pathlib import Path

import msgspec

from .files import MissingError, StorageError, keep_backup, read_content
from .reasons import why_unwritable


class Foreign(msgspec.Struct, frozen=True):
    """File of another format that a document was opened from, and may be written back to.

    Attributes
    ----------
    path
        Where it is.
    written
        The digest of what was written back last; empty before that.
    missed
        What in it did not come in as it stands there, in words; writing back loses it.
    """

    path: Path
    written: bytes = b""
    missed: tuple[str, ...] = ()

    def keep_what_would_be_lost(self) -> Path | None:
        """Copy the file beside itself, unless it is as it was written back last; return the copy.

        What another program wrote may hold more than a document does: texts, pictures, other elements.

        Raises
        ------
        StorageError
            If it cannot be read, or the copy not be written.
        """
        try:
            found = read_content(self.path)
        except MissingError:
            return None
        if found.stamp.digest == self.written:
            return None
        try:
            return keep_backup(self.path, found.data, "before")
        except StorageError:
            raise
        except OSError as problem:
            raise StorageError(why_unwritable(self.path, problem)) from problem

    def as_it_is(self) -> Foreign:
        """Return the file that the document was just written to."""
        return Foreign(self.path, read_content(self.path).stamp.digest)
