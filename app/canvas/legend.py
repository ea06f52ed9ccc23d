"""The legend on the canvas: what the lines and marks beside the curve mean."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QGridLayout, QToolButton, QWidget

from ..appearance.icons import icon
from ..appearance.theme import mix
from ..plotting.layers import LayerStack
from ..plotting.pens import sign_pixmap
from ..qt.labels import Label, tip_of
from ..view_model.analysis.ghost import Ghost
from ..view_model.analysis.legend import LegendRow
from ..widgets.overlay_frame import OverlayFrame
from ..widgets.tool_buttons import tool_button

_MARGIN = 10

FIRST = "overlays"
"""The group of the curve itself, with what is drawn over it and its ghosts."""


class Legend(OverlayFrame):
    """Legend in the lower right corner; what is pressed beside its buttons is meant for the drawing below.

    Signals
    -------
    chosen
        A ghost shall become the curve.
    hidden
        A ghost shall go away.
    """

    chosen = Signal(object)
    hidden = Signal(object)

    def __init__(self, below: QWidget, style: LayerStack) -> None:
        super().__init__("legend", below)
        self.setAccessibleName("Legend")
        self._groups: dict[str, Sequence[LegendRow]] = {}
        self._style = style
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(8, 5, 6, 5)
        self._grid.setHorizontalSpacing(7)
        self._grid.setVerticalSpacing(1)
        self._grid.setColumnStretch(1, 1)
        self.render_style()
        self.hide()

    @property
    def rows(self) -> Sequence[LegendRow]:
        """The lines on screen; what has no heading comes first, or it would stand under that of another."""
        names = sorted(self._groups, key=lambda name: name != FIRST)
        return [row for name in names for row in self._groups[name]]

    def render_rows(self, group: str, rows: Sequence[LegendRow]) -> None:
        """Show these lines of a group, below those of groups that were there before; hidden without any."""
        if list(rows) == list(self._groups.get(group, ())):
            return
        if rows:
            self._groups[group] = rows
        else:
            del self._groups[group]
        self._rebuild()

    def _rebuild(self) -> None:
        for widget in self._children():
            self._grid.removeWidget(widget)
            widget.hide()
            widget.deleteLater()
        for place, row in enumerate(self.rows):
            self._add(place, row)
        self.setVisible(bool(self._groups))
        # A layout counts what is visible only.
        for widget in self._children():
            widget.show()
        self._grid.activate()
        self.place()

    def _children(self) -> list[QWidget]:
        items = [self._grid.itemAt(place) for place in range(self._grid.count())]
        found = [item.widget() for item in items if item is not None]
        return [widget for widget in found if widget is not None]

    def _add(self, place: int, row: LegendRow) -> None:
        font = QFont(self.font())
        font.setPointSizeF(font.pointSizeF() * 0.92 * self._style.scale)
        if row.style is not None:
            sign = Label()
            sign.setPixmap(sign_pixmap(row.style, self._style.theme, self.devicePixelRatioF()))
            self._grid.addWidget(sign, place, 0)
        if row.ghost is not None:
            choose, hide = self._ghost_buttons(row, row.ghost)
            choose.setFont(font)
            self._grid.addWidget(choose, place, 1)
            self._grid.addWidget(hide, place, 3)
            self._add_figure(place, row, font)
            return
        text = Label(row.text)
        text.setFont(font)
        text.setToolTip(tip_of(row.tip))
        text.setStyleSheet(
            f"color: {(self._style.theme.muted if row.is_muted else self._style.theme.ink).name()}"
        )
        first = 0 if row.style is None else 1
        self._grid.addWidget(text, place, first, 1, (2 if row.figure else 4) - first)
        self._add_figure(place, row, font)

    def _add_figure(self, place: int, row: LegendRow, font: QFont) -> None:
        if row.figure:
            figure = Label(row.figure)
            figure.setFont(font)
            figure.setToolTip("The Lebesgue constant: how much errors in the points can grow")
            figure.setStyleSheet(f"color: {self._style.theme.muted.name()}")
            self._grid.addWidget(figure, place, 2, Qt.AlignmentFlag.AlignRight)

    def _ghost_buttons(self, row: LegendRow, ghost: Ghost) -> tuple[QToolButton, QToolButton]:
        choosing, hiding = row.tip or f"Make this the curve: {row.text}", f"Hide the ghost: {row.text}"
        choose = tool_button(
            f"legendChoose_{ghost.name}", choosing, tip_of(choosing), text=row.text, flat=True
        )
        hide = tool_button(f"legendHide_{ghost.name}", hiding, tip_of(hiding), icon_size=11, flat=True)
        choose.setEnabled(not row.is_muted)
        hide.setIcon(icon("close", self._style.theme))
        choose.clicked.connect(lambda: self.chosen.emit(ghost))
        hide.clicked.connect(lambda: self.hidden.emit(ghost))
        for button in (choose, hide):
            button.setCursor(Qt.CursorShape.ArrowCursor)
            # The keyboard stays with the canvas; the Analysis dock offers the same.
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        return choose, hide

    def place(self) -> None:
        """Lie in the lower right corner, as small as can be."""
        size = self.sizeHint()
        room = self.below.rect()
        self.setGeometry(
            max(room.width() - size.width() - _MARGIN, 0),
            # Above the numbers of the axis.
            max(room.height() - size.height() - _MARGIN - 22, 0),
            size.width(),
            size.height(),
        )

    def event(self, event: QEvent) -> bool:
        # The frame of a style sheet counts later than the rows.
        if event.type() == QEvent.Type.LayoutRequest:
            self.place()
        return super().event(event)

    def render_style(self) -> None:
        """Take the theme and the scale of the drawing."""
        theme = self._style.theme
        paper, line = theme.paper, theme.grid_coarse.name()
        hover = mix(theme.ink, theme.paper, 0.1).name()
        # Never opaque: Qt would cut it out of what it paints below, and drawing in a region that is no
        # rectangle takes several times as long.
        self.setStyleSheet(
            f"#legend {{ background: rgba({paper.red()}, {paper.green()}, {paper.blue()}, 215);"
            f" border: 1px solid {line}; border-radius: 6px }}"
            "QToolButton { padding: 0; border: none; border-radius: 3px; text-align: left }"
            f"QToolButton:hover {{ background: {hover} }}"
        )
        self._rebuild()
