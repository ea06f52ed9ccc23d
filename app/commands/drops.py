"""Files that are dragged over the window: what a drop would do with them, and that it only reads them."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QDropEvent

from app.commands.exchange_commands import can_import
from app.commands.image_commands import PICTURE_SUFFIXES


def dropped_file(event: QDropEvent) -> Path | None:
    """Return the first local file that is dragged, None without one."""
    for url in event.mimeData().urls():
        if url.isLocalFile():
            return Path(url.toLocalFile())
    return None


def accepted_file(event: QDropEvent) -> Path | None:
    """Accept a drag of a file as a copy and return the file; None where there is none or it must be moved.

    Whoever answers "move" makes the file manager delete what was dragged.
    """
    path = dropped_file(event)
    if path is None or not event.possibleActions() & Qt.DropAction.CopyAction:
        event.ignore()
        return None
    event.setDropAction(Qt.DropAction.CopyAction)
    event.accept()
    return path


def is_picture(path: Path) -> bool:
    """Whether a file is a picture to trace."""
    return path.suffix.lower() in PICTURE_SUFFIXES


def invitation(path: Path) -> str:
    """Return what a drop would do with a file."""
    verb = "trace" if is_picture(path) else "import" if can_import(path) else "open"
    return f"Drop to {verb} {path.name}"
