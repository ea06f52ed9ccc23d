"""Markers: what stands where lines begin and end, chosen by its picture."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QSize, Signal
from PySide6.QtGui import QIcon, QPainter, QPen
from PySide6.QtWidgets import QComboBox, QWidget

from ...appearance.theme import Theme
from ...appearance.themed import FollowsTheme
from ...document.marker import MarkerKind
from ...document.style import PLAIN_STYLE
from ...plotting.pictures import transparent
from ...qt.markers import path_of
from ...view_model.geometry.markers import Ends, markers_of
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box

_PICTURE = QSize(30, 14)
_WIDTH, _INSIDE = 2.0, 8.0
_LEAST = 48

FIELDS = {"start_marker": ("startMarker", "Start marker"), "end_marker": ("endMarker", "End marker")}
"""Name and label of the boxes, by the field of a style."""


class MarkerField(FollowsTheme, QWidget):
    """Shows the markers at start and end, and asks for others.

    Signals
    -------
    chosen
        Another one was chosen: the field of the style, and the kind.
    """

    chosen = Signal(str, object)

    def __init__(self) -> None:
        super().__init__()
        self._boxes = {field: self._box(field, *words) for field, words in FIELDS.items()}
        self._shown: dict[str, object] = {}
        row_of(*((box, 1) for box in self._boxes.values()), margins=0, spacing=6, parent=self)
        self.setFocusProxy(self._boxes["end_marker"])
        self.follow_theme()

    def _box(self, field: str, name: str, label: str) -> QComboBox:
        where = "begin" if field == "start_marker" else "end"
        box = choice_box(name, label, f"What stands where open lines {where}", (k.label for k in MarkerKind))
        box.setIconSize(_PICTURE)
        box.setMinimumWidth(_LEAST)
        box.setMinimumContentsLength(3)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        kinds = list(MarkerKind)
        box.activated.connect(lambda row: self._choose(field, kinds[row]))
        return box

    def render_value(self, field: str, value: object) -> None:
        """Show the marker of a field of styles; none of those that there are for several."""
        self._shown[field] = value
        kinds: list[object] = list(MarkerKind)
        self._boxes[field].setCurrentIndex(kinds.index(value) if value in kinds else -1)

    def _choose(self, field: str, kind: MarkerKind) -> None:
        # What is on is what the owner shows.
        self.render_value(field, self._shown.get(field))
        self.chosen.emit(field, kind)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        for field, box in self._boxes.items():
            for row, kind in enumerate(MarkerKind):
                box.setItemIcon(row, self._icon(field, kind, theme))

    def _icon(self, field: str, kind: MarkerKind, theme: Theme) -> QIcon:
        """Return a picture of one end of a line."""
        wide, middle = float(_PICTURE.width()), _PICTURE.height() / 2
        is_start = field == "start_marker"
        start, end = (_INSIDE, wide) if is_start else (0.0, wide - _INSIDE)
        ends = Ends(
            np.array([start, middle]), np.array([-1.0, 0.0]), np.array([end, middle]), np.array([1.0, 0])
        )
        picture = transparent(wide, _PICTURE.height(), self.devicePixelRatioF())
        with QPainter(picture) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(QPen(theme.ink, _WIDTH))
            painter.drawLine(QPointF(start, middle), QPointF(end, middle))
            painter.fillPath(
                path_of(markers_of(PLAIN_STYLE.with_fields({field: kind}), ends, ends, _WIDTH)), theme.ink
            )
        return QIcon(picture)
