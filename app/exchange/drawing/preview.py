"""What a picture will look like, as the dialog shows it before it is written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PySide6.QtGui import QImage


@dataclass(frozen=True)
class PicturePreview:
    """A small picture of a picture.

    Attributes
    ----------
    size
        What its file says of its size, in a line.
    moved
        What became of colours that could not be seen on the paper; empty for nothing.
    """

    image: QImage
    size: str
    moved: str = ""
