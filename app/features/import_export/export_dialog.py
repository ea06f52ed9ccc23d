"""Export dialog: a format, its options, and a preview of pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QImage, QPainter, QPixmap
from PySide6.QtWidgets import QWidget

from ...appearance.theme import DARK, LIGHT, mix
from ...document.expression import ExpressionError
from ...document.model import Document
from ...exchange.choice import ExportChoice
from ...exchange.errors import ExchangeError
from ...exchange.options import DARK_PAPER
from ...qt.labels import Label
from ...tasks.progress import Report
from ...widgets.boxes import column_of, row_of
from .export_form import ExportForm
from .work_dialog import WorkDialog, buttons

if TYPE_CHECKING:
    from ...exchange.drawing.image import PicturePreview

_SOON_MS = 120
_WIDTH, _HEIGHT = 300, 260
_SQUARE = 8


class ExportDialog(WorkDialog):
    """Asks for the options first; where to write is asked next.

    Signals
    -------
    chosen
        The person wants a file: the `ExportChoice`.
    """

    chosen = Signal(object)

    def __init__(self, choice: ExportChoice, parent: QWidget | None = None) -> None:
        super().__init__("exportDialog", "Export", "exportProblem", parent)
        self._document: Document | None = None
        self._active, self._chosen, self._with_estimates = 0, frozenset[int](), False
        self.form = ExportForm()
        self.picture = Label(name="exportPreview", label="Preview")
        self.picture.setToolTip("What the picture will look like; squares stand for no background")
        self.picture.setFixedSize(_WIDTH, _HEIGHT)
        self.picture.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.size_label = Label(name="exportSize", wordWrap=True)
        self.size_label.setAlignment(Qt.AlignmentFlag.AlignHCenter)
        self.told = Label(name="exportColoursTold", wordWrap=True)
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._render_preview)
        self._lay_out()
        self.form.changed.connect(self._render)
        self.form.show_choice(choice)
        self._render()

    def _lay_out(self) -> None:
        foot, self.ok = buttons("Export…", "exportFile", "Choose where to write it", "cancelExport")
        foot.accepted.connect(self._export)
        foot.rejected.connect(self.reject)
        self.preview_side = QWidget()
        column_of(self.picture, self.size_label, self.told, 1, margins=0, parent=self.preview_side)
        columns = row_of((column_of(self.form, 1, margins=0), 1), self.preview_side, spacing=18)
        column_of(columns, margins=(16, 14, 16, 0), parent=self.body)
        self.hold(self.problem, foot, wished=QSize(690, 400))

    def show_document(
        self,
        document: Document,
        active: int,
        chosen: frozenset[int] = frozenset(),
        *,
        with_estimates: bool = False,
    ) -> None:
        """Show what this document would look like; for the others see `ExportChoice.order`."""
        self._document, self._active, self._chosen = document, active, chosen
        self._with_estimates = with_estimates
        self.form.show_document(document, has_chosen=bool(chosen))
        self._soon.start()

    def _render(self) -> None:
        """Show what belongs to the format."""
        try:
            choice = self.form.choice()
        except ExpressionError as reason:
            self.complain(str(reason))
            self.ok.setEnabled(False)
            return
        self.complain("")
        self.ok.setEnabled(True)
        self.ok.setToolTip(f"Choose where to write the {choice.format.title}")
        self.preview_side.setVisible(choice.format.preview is not None)
        self._soon.start()

    def _render_preview(self) -> None:
        document, active = self._document, self._active
        self.jobs.cancel()
        if document is None or not self.preview_side.isVisible():
            return
        try:
            choice = self.form.choice()
        except ExpressionError:
            return  # that has been said
        preview = choice.format.preview
        assert preview is not None
        order = choice.order(document, active, self._chosen, with_estimates=self._with_estimates)
        room = (round(_WIDTH * self.devicePixelRatioF()), round(_HEIGHT * self.devicePixelRatioF()))

        def draw(_report: Report) -> PicturePreview:
            return preview(*order, room)

        self.jobs.start("Drawing", draw, self._show_preview, self._refuse)

    def _show_preview(self, seen: PicturePreview) -> None:
        try:
            choice = self.form.choice()
        except ExpressionError:
            return  # typed while it was drawn, and said
        # As the picture will be looked at, not as this window is.
        theme = DARK if choice[DARK_PAPER] else LIGHT
        squares = (theme.paper, mix(theme.ink, theme.paper, 0.1))
        self.picture.setPixmap(_on_squares(seen.image, self.devicePixelRatioF(), squares))
        self.size_label.setText(seen.size)
        self.told.setText(seen.moved)
        self.complain("")
        self.ok.setEnabled(True)

    def _refuse(self, problem: Exception) -> None:
        if not isinstance(problem, ExchangeError):
            raise problem
        self.picture.clear()
        self.size_label.clear()
        self.told.clear()
        self.complain(str(problem))
        self.ok.setEnabled(False)

    def _export(self) -> None:
        self.chosen.emit(self.form.choice())
        self.accept()


def _on_squares(image: QImage, ratio: float, colours: tuple[QColor, QColor]) -> QPixmap:
    """Return a picture on a chessboard that shows where it has no background."""
    image.setDevicePixelRatio(ratio)
    result = QPixmap(image.size())
    result.setDevicePixelRatio(ratio)
    result.fill(colours[0])
    painter = QPainter(result)
    side = image.deviceIndependentSize()
    for row in range(int(side.height() // _SQUARE) + 1):
        for column in range(row % 2, int(side.width() // _SQUARE) + 1, 2):
            painter.fillRect(column * _SQUARE, row * _SQUARE, _SQUARE, _SQUARE, colours[1])
    painter.drawImage(0, 0, image)
    painter.end()
    return result
