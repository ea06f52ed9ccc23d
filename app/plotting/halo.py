"""Words with paper only around their letters: what lies below stays seen."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPainterPath, QPen, QPixmap

from .pictures import transparent


class Halo:
    """Words with a halo; the last ones are kept as a picture.

    Stroking the outlines of a few letters takes a millisecond, and words stay the same for many frames.
    """

    def __init__(self) -> None:
        self._made_for: tuple[object, ...] = ()
        self._picture = QPixmap()

    def write(
        self, painter: QPainter, box: QRectF, text: str, paper: QColor, ink: QColor, width: float
    ) -> None:
        """Write text in the middle of a box, with `width` pixels of paper on either side of each line."""
        ratio = painter.device().devicePixelRatioF()
        wanted = (text, painter.font().key(), paper.rgba(), ink.rgba(), width, ratio, box.size())
        if wanted != self._made_for:
            self._made_for = wanted
            size = box.adjusted(-width, -width, width, width).size()
            self._picture = with_halo(painter, size, text, paper, ink, width)
        # On whole pixels, where letters are sharp.
        painter.drawPixmap(QPointF(round(box.left() - width), round(box.top() - width)), self._picture)


def with_halo(
    painter: QPainter, size: QSizeF, text: str, paper: QColor, ink: QColor, width: float
) -> QPixmap:
    """Return a picture, as the painter would draw it, of text with a halo in the middle of a size."""
    across, down = size.width(), size.height()
    picture = transparent(across, down, painter.device().devicePixelRatioF())
    metrics = QFontMetricsF(painter.font())
    start = QPointF(
        round((across - metrics.horizontalAdvance(text)) / 2),
        round((down + metrics.ascent() - metrics.descent()) / 2),
    )
    letters = QPainterPath()
    letters.addText(start, painter.font(), text)
    halo = QPen(paper, 2 * width)
    halo.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    drawing = QPainter(picture)
    drawing.setRenderHint(QPainter.RenderHint.Antialiasing, True)
    drawing.strokePath(letters, halo)
    drawing.setFont(painter.font())
    drawing.setPen(ink)
    drawing.drawText(start, text)
    drawing.end()
    return picture
