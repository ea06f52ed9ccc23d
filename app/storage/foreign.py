"""Files of other formats that documents were opened from."""

from __future__ import annotations

from pathlib import Path

import msgspec

from ..document.model import Curve, Document
from .files import Content, MissingError, StorageError, keep_backup, read_content
from .reasons import why_unwritable


class Lost(msgspec.Struct, frozen=True):
    """Something in a file that did not come in as it stands there.

    Attributes
    ----------
    words
        What it is and why, within a sentence.
    name
        What the document calls it, or the shapes in it; empty where nothing of it came in, or nobody knows.
    """

    words: str
    name: str = ""


class Foreign(msgspec.Struct, frozen=True):
    """File of another format that a document was opened from, and may be written back to.

    Attributes
    ----------
    path
        Where it is.
    written
        The digest of what was written back last; empty before that.
    missed
        What in it did not come in as it stands there; writing it anew loses it.
    opened
        The digest of what was opened; empty where nobody knows it.
    begun
        What of it came in, or was written back last; None where nobody knows it.
    """

    path: Path
    written: bytes = b""
    missed: tuple[Lost, ...] = ()
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
        missed = self.still_missed(document) if is_kept else ()
        return Foreign(self.path, digest, missed, begun=document)

    def still_missed(self, document: Document) -> tuple[Lost, ...]:
        """Return what of that which did not come in as it is concerns a document: not what was deleted there.

        What has another name now is known by its points.
        """
        if self.begun is None:
            return self.missed
        begun = self.begun.curves
        kept = {curve.points for curve in document.curves} if self.missed else set()
        names = {name for curve in document.curves for name in _names_of(curve)}

        def is_there(lost: Lost) -> bool:
            came = [curve for curve in begun if lost.name in _names_of(curve)]
            return not came or lost.name in names or any(curve.points in kept for curve in came)

        return tuple(each for each in self.missed if not each.name or is_there(each))


def _names_of(curve: Curve) -> tuple[str, ...]:
    """Return all names by which something of a file may be in a document with a curve."""
    return (curve.name, curve.shape, *curve.groups)
