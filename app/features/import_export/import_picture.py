"""Picture of a drawing before it comes in."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPixmap
from PySide6.QtWidgets import QWidget

from ...document.model import Document
from ...exchange.drawing.image import png_preview
from ...exchange.drawing.styles import DARK, LIGHT
from ...exchange.errors import ExchangeError
from ...exchange.options import Options
from ...qt.labels import Label
from ...tasks.progress import Report
from ...tasks.single_task import SingleTask
from ...view_model.look.palette import contrast
from ...widgets.boxes import column_of

_WIDTH, _HEIGHT = 280, 260
_TOO_PALE = 1.5
"""Contrast with light paper that somebody drew for dark."""


class ImportPicture(QWidget):
    """The curves that are taken, as they print.

    Attributes
    ----------
    picture
        What is shown.
    """

    def __init__(self, jobs: SingleTask) -> None:
        super().__init__()
        self._jobs = jobs
        self.picture = Label(name="importPicture", label="Preview")
        self.picture.setToolTip("What comes in")
        self.picture.setFixedSize(_WIDTH, _HEIGHT)
        self.picture.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.picture.setWordWrap(True)
        column_of(self.picture, 1, margins=0, parent=self)

    def show_document(self, document: Document) -> None:
        """Draw a document, beside the window's own thread."""
        ratio = self.devicePixelRatioF()
        room = (round(_WIDTH * ratio), round(_HEIGHT * ratio))

        def draw(report: Report) -> QImage:
            style = DARK if _is_for_dark_paper(document) else LIGHT
            return png_preview(document, Options(style=style, report=report), room).image

        def show(image: QImage) -> None:
            image.setDevicePixelRatio(ratio)
            self.picture.setPixmap(QPixmap.fromImage(image))

        self._jobs.cancel()
        self._jobs.start("Drawing", draw, show, self._refuse)

    def clear(self) -> None:
        """Show nothing."""
        self._jobs.cancel()
        self.picture.clear()

    def _refuse(self, problem: Exception) -> None:
        if not isinstance(problem, ExchangeError):
            raise problem
        self.picture.setText(str(problem))


def _is_for_dark_paper(document: Document) -> bool:
    """Whether nothing of a document would be seen on light paper."""
    paints = {
        paint
        for curve in document.curves
        if curve.visible
        for paint in (curve.style.stroke, curve.style.fill)
        if paint != "none"
    }
    return bool(paints) and all(
        paint.startswith("#") and contrast(paint, LIGHT.paper or "#ffffff") < _TOO_PALE for paint in paints
    )
