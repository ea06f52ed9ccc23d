"""Pictures beside the screen, which layers keep while what they show stays as it is."""

from __future__ import annotations

import math

import msgspec
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPixmap

from .pixel_map import PixelMap


def transparent(width: float, height: float, ratio: float) -> QPixmap:
    """Return an empty picture of a size in pixels of a plot, for a screen with `ratio` of its own to each."""
    picture = QPixmap(math.ceil(width * ratio), math.ceil(height * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture


class Sheets(msgspec.Struct, frozen=True, eq=False):
    """What was painted for one part of the plane.

    Attributes
    ----------
    sheets
        One over the other; there are several where something else is painted between them.
    shown
        The part of the plane.
    key
        What else it was made for: the theme, the size of lines.
    """

    sheets: tuple[QPixmap, ...]
    shown: PixelMap
    key: tuple[object, ...]

    def draw(self, painter: QPainter, shown: PixelMap, sheet: QPixmap) -> None:
        """Draw a sheet, where it lies when this part of the plane is visible."""
        if shown is self.shown or shown == self.shown:
            painter.drawPixmap(0, 0, sheet)
            return
        place = self.place_in(shown)
        if (shown.sx, shown.sy) == (self.shown.sx, self.shown.sy):
            # On whole pixels of the screen, where it is as sharp as it was, and quickly copied.
            ratio = sheet.devicePixelRatio()
            corner = QPointF(round(place.x() * ratio) / ratio, round(place.y() * ratio) / ratio)
            painter.drawPixmap(corner, sheet)
        else:
            painter.drawPixmap(place, sheet, QRectF(sheet.rect()))

    def place_in(self, shown: PixelMap) -> QRectF:
        """Return where the sheets lie when another part of the plane is visible."""
        old = self.shown
        x, y = shown.point(old.x0, old.y0)
        return QRectF(x, y, old.width * shown.sx / old.sx, old.height * shown.sy / old.sy)
