"""The legend on the canvas: what the lines and marks beside the curve mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum, IntEnum
from typing import NamedTuple, Protocol

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QRect, Qt, QTimer, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QGridLayout, QToolButton, QWidget

from curvecore.arrays import FloatArray

from ..appearance.icons import icon
from ..appearance.theme import mix
from ..plotting.layers import LayerStack
from ..plotting.pens import sign_pixmap
from ..plotting.text import covered_lengths
from ..qt.labels import Label, tip_of
from ..view_model.analysis.ghost import Ghost
from ..view_model.analysis.legend import LegendRow
from ..widgets.controls import named, tool_button
from ..widgets.frames import OverlayFrame

_MARGIN = 10

FIRST = "overlays"
"""The group of the curve itself, with what is drawn over it and its ghosts."""


_SOON_MS = 120
"""Milliseconds that the drawing rests before the legend makes way for it."""

_WORTH_MOVING = 12.0
"""Pixels of curve by which another corner has to cover less than the one where the legend lies."""

_FREE = 1.0
"""Pixels of curve up to which a corner is free."""

_COVERED_FRAME = 1000.0
"""Cost of a corner where another frame lies, in pixels of curve covered."""


class Corner(Enum):
    """The corners of the drawing, the usual one first: to the right or left, below or above."""

    LOWER_RIGHT = (True, True)
    UPPER_RIGHT = (True, False)
    LOWER_LEFT = (False, True)
    UPPER_LEFT = (False, False)


class Form(IntEnum):
    """The forms of the legend: all of it, with short words, and with these alone."""

    WHOLE = 0
    BRIEF = 1
    BARE = 2


class _Shown(NamedTuple):
    """A row on screen: its words, the button behind them and the number at its end."""

    row: LegendRow
    words: Label | QToolButton
    hide: QToolButton | None
    figure: Label | None

    def say(self, form: Form) -> None:
        """Take the form of the moment."""
        self.words.setText(self.row.brief if form >= Form.BRIEF and self.row.brief else self.row.text)
        for widget in filter(None, (self.hide, self.figure)):
            widget.setVisible(form < Form.BARE)

    def with_figure_of(self, row: LegendRow) -> _Shown:
        """Show the number of a row that differs in nothing else, and return that."""
        if self.figure is not None and row.figure != self.row.figure:
            self.figure.setText(row.figure)
            if row.ghost is not None:
                _name_choosing(self.words, row)
        return self._replace(row=row)


class Room(Protocol):
    """The drawing that the legend lies on.

    Attributes
    ----------
    area
        The drawing in pixels of the viewport.
    is_busy
        Whether a gesture goes on, during which nothing else moves.
    """

    @property
    def area(self) -> QRect: ...

    @property
    def is_busy(self) -> bool: ...

    def segments(self) -> FloatArray:
        """Return what should be seen, as line segments (k, 4) in pixels of the viewport."""


class Legend(OverlayFrame):
    """Legend in the corner where it covers least; a press beside its buttons is meant for the drawing.

    Signals
    -------
    chosen
        A ghost shall become the curve.
    hidden
        A ghost shall go away.
    """

    chosen = Signal(object)
    hidden = Signal(object)

    def __init__(self, below: QWidget, style: LayerStack, room: Room) -> None:
        super().__init__("legend", below)
        self.setAccessibleName("Legend")
        self._groups: dict[str, Sequence[LegendRow]] = {}
        self._style, self._room = style, room
        self._corner, self._form = Corner.LOWER_RIGHT, Form.WHOLE
        self._shown: list[_Shown] = []
        self._soon = QTimer(self, singleShot=True, interval=_SOON_MS)
        self._soon.timeout.connect(self._make_way)
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
        before = self.rows
        if rows:
            self._groups[group] = rows
        else:
            del self._groups[group]
        if [_without_figure(row) for row in before] == [_without_figure(row) for row in self.rows]:
            self._shown = [each.with_figure_of(row) for each, row in zip(self._shown, self.rows, strict=True)]
            self._grid.activate()
            self._make_way()
        else:
            self._rebuild()

    def _rebuild(self) -> None:
        for widget in self._children():
            self._grid.removeWidget(widget)
            widget.hide()
            widget.deleteLater()
        self._shown = []
        for place, row in enumerate(self.rows):
            self._add(place, row)
        if self.isHidden():
            self._corner = Corner.LOWER_RIGHT
        self.setVisible(bool(self._groups))
        # A layout counts what is visible only.
        for widget in self._children():
            widget.show()
        for each in self._shown:
            each.say(self._form)
        self._grid.activate()
        self._make_way()

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
            self._shown.append(_Shown(row, choose, hide, self._add_figure(place, row, font)))
            return
        text = Label(row.text)
        text.setFont(font)
        text.setToolTip(tip_of(row.tip))
        text.setStyleSheet(
            f"color: {(self._style.theme.muted if row.is_muted else self._style.theme.ink).name()}"
        )
        first = 0 if row.style is None else 1
        self._grid.addWidget(text, place, first, 1, (2 if row.figure else 4) - first)
        self._shown.append(_Shown(row, text, None, self._add_figure(place, row, font)))

    def _add_figure(self, place: int, row: LegendRow, font: QFont) -> Label | None:
        if not row.figure:
            return None
        figure = Label(row.figure)
        figure.setFont(font)
        figure.setToolTip("The Lebesgue constant: how much errors in the points can grow")
        figure.setStyleSheet(f"color: {self._style.theme.muted.name()}")
        self._grid.addWidget(figure, place, 2, Qt.AlignmentFlag.AlignRight)
        return figure

    def _ghost_buttons(self, row: LegendRow, ghost: Ghost) -> tuple[QToolButton, QToolButton]:
        hiding = f"Hide the ghost: {row.text}"
        choose = tool_button(f"legendChoose_{ghost.name}", "", "", text=row.text, flat=True)
        _name_choosing(choose, row)
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
        """Lie in a corner of the drawing, as small as can be."""
        self.setGeometry(self._box_in(self._corner))

    def make_way(self) -> None:
        """Go to another corner, if that covers less, once the drawing rests."""
        if not self.isHidden():
            self._soon.start()

    def _make_way(self) -> None:
        if self._room.is_busy:
            self.place()
            self._soon.start()
            return
        segments, found = self._room.segments(), dict[tuple[Form, Corner], float]()
        for form in Form:
            self._show_form(form)
            covered = self._covered(segments)
            found |= {(form, corner): length for corner, length in covered.items()}
            best = min(covered, key=lambda corner: covered[corner])
            if covered[best] <= _FREE:
                break
        else:
            # There is no free corner: as much of the words as that costs nothing.
            form, best = min(found, key=lambda place: (found[place], place[0]))
            self._show_form(form)
        if found[form, self._corner] > found[form, best] + _WORTH_MOVING:
            self._corner = best
        self.place()

    def _covered(self, segments: FloatArray) -> dict[Corner, float]:
        """Return how much the legend covers in each corner, in pixels of curve."""
        boxes = [self._box_in(corner) for corner in Corner]
        here = Qt.FindChildOption.FindDirectChildrenOnly
        frames = [each for each in self.below.findChildren(OverlayFrame, options=here) if each is not self]
        taken = [
            any(each.isVisible() and each.geometry().intersects(box) for each in frames) for box in boxes
        ]
        lengths = covered_lengths(segments, boxes) + _COVERED_FRAME * np.array(taken)
        return dict(zip(Corner, lengths.tolist(), strict=True))

    def _show_form(self, form: Form) -> None:
        if form is self._form:
            return
        self._form = form
        for each in self._shown:
            each.say(self._form)
        self._grid.activate()

    def _box_in(self, corner: Corner) -> QRect:
        """Return where the legend lies in a corner; inside the viewport, however small that is."""
        size, area = self.sizeHint(), self._room.area
        is_right, is_below = corner.value
        x = area.right() - size.width() - _MARGIN if is_right else area.left() + _MARGIN
        y = area.bottom() - size.height() - _MARGIN if is_below else area.top() + _MARGIN
        return QRect(QPoint(max(x, 0), max(y, 0)), size)

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


def _without_figure(row: LegendRow) -> LegendRow:
    return replace(row, figure="…") if row.figure else row


def _name_choosing(button: QWidget, row: LegendRow) -> None:
    """Name the button that makes a ghost the curve, with the figure, which the narrowest form leaves out."""
    words = row.tip or f"Make this the curve: {row.text}" + (f" ({row.figure})" if row.figure else "")
    named(button, button.objectName(), words, tip_of(words))
