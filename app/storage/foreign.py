"""Files of other formats that documents were opened from."""

from __future__ import annotations

from pathlib import Path

import msgspec

from ..document.model import Document
from .files import Content, MissingError, StorageError, keep_backup, read_content
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
        What in it did not come in as it stands there, in words; writing it anew loses it.
    opened
        The digest of what was opened; empty where nobody knows it.
    begun
        What of it came in, or was written back last; None where nobody knows it.
    """

    path: Path
    written: bytes = b""
    missed: tuple[str, ...] = ()
    opened: bytes = b""
    begun: Document | None = None

    def content(self) -> Content | None:
        """Return what the file holds now; None where it is not there any more.

        Raises
        ------
        StorageError
            If it cannot be read.
        """
        try:
            return read_content(self.path)
        except MissingError:
            return None

    def is_another(self, content: Content) -> bool:
        """Whether somebody else has written the file since it was opened, or written back."""
        known = self.written or self.opened
        return bool(known) and content.stamp.digest != known

    def keep_what_would_be_lost(self) -> Path | None:
        """Copy the file beside itself, unless it is as it was written back last; return the copy.

        What another program wrote may hold more than a document does: texts, pictures, other elements.

        Raises
        ------
        StorageError
            If it cannot be read, or the copy not be written.
        """
        found = self.content()
        if found is None or found.stamp.digest == self.written:
            return None
        try:
            return keep_backup(self.path, found.data, "before")
        except StorageError:
            raise
        except OSError as problem:
            raise StorageError(why_unwritable(self.path, problem)) from problem

    def as_it_is(self, document: Document, *, is_kept: bool) -> Foreign:
        """Return the file that a document was just written to; one that is not kept was written anew."""
        digest = read_content(self.path).stamp.digest
        return Foreign(self.path, digest, self.missed if is_kept else (), begun=document)
