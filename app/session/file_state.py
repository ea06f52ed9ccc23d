"""The file behind the document, and where the document began."""

from __future__ import annotations

from pathlib import Path

from app.document.model import Document
from app.session.history import Beginning
from app.storage.open_file import FileChange, OpenFile


class FileState:
    """Where the document is kept, who else has it open, and what the file holds.

    Attributes
    ----------
    path
        The path; None as long as the document has no file.
    file
        The file at `path`, open with its lock; None without one.
    beginning
        Where the document began; the same for all states of it.
    """

    def __init__(self) -> None:
        self.path: Path | None = None
        self.file: OpenFile | None = None
        self.beginning = Beginning()

    @property
    def is_read_only(self) -> bool:
        """Whether somebody else has the file open, so that only Save As keeps changes."""
        return self.file is not None and self.file.owner is not None

    @property
    def has_lost_document(self) -> bool:
        """Whether the file does not hold what it was opened or saved with: changed, damaged or deleted."""
        return self.file is not None and self.file.has_lost_document

    def take(self, path: Path | None, file: OpenFile | None) -> None:
        """Go on with another file, or none; the one before is closed."""
        if self.file is not None and self.file is not file:
            self.file.close()
        self.path, self.file = path, file

    def save(self, target: Path, document: Document, *, overwrite: bool) -> None:
        """Write `document` to `target`, which is its file from then on; raises as `OpenFile.saved` does."""
        self.take(target, OpenFile.saved(target, document, self.file, overwrite=overwrite))

    def note(self, change: FileChange) -> bool:
        """Take note of what the file holds; return whether that is news."""
        if self.file is None or change is self.file.change:
            return False
        self.file.change = change
        return True
