"""The legend on the canvas: names of the lines and marks beside the curve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum, IntEnum
from typing import NamedTuple, Protocol

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QRect, Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QToolButton, QWidget

from curvecore.arrays import FloatArray

from ..appearance.icons import icon
from ..appearance.theme import mix
from ..plotting.layers import LayerStack
from ..plotting.pens import sign_pixmap
from ..plotting.text import covered_lengths
from ..qt.labels import Label, tip_of
from ..tasks.task import DelayedCall
from ..view_model.analysis.ghost import Ghost
from ..view_model.analysis.legend import LegendRow
from ..widgets.boxes import grid_of, remove_widgets
from ..widgets.controls import named, tool_button
from ..widgets.frames import OverlayFrame

_MARGIN = 10

FIRST = "overlays"
"""The group of the curve itself, its overlays and its ghosts; it has no heading."""


_MOVE_DELAY_MS = 120
"""Milliseconds of rest after which the legend moves away from the drawing."""

_WORTH_MOVING = 12.0
"""Pixels of curve by which another corner must cover less than the present one."""

_FREE_CORNER = 1.0
"""Pixels of curve up to which a corner counts as free."""

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


class _VisibleRow(NamedTuple):
    """A row on the screen: its text or button, the button that hides it, and the number at its end."""

    row: LegendRow
    words: Label | QToolButton
    hide: QToolButton | None
    figure: Label | None

    def set_form(self, form: Form) -> None:
        """Show the row in this form."""
        self.words.setText(self.row.brief if form >= Form.BRIEF and self.row.brief else self.row.text)
        for widget in filter(None, (self.hide, self.figure)):
            widget.setVisible(form < Form.BARE)

    def with_figure_of(self, row: LegendRow) -> _VisibleRow:
        """Show the number of a row that differs in nothing else, and return the row."""
        if self.figure is not None and row.figure != self.row.figure:
            self.figure.setText(row.figure)
            if row.ghost is not None:
                _name_choose_button(self.words, row)
        return self._replace(row=row)


class Room(Protocol):
    """The drawing that the legend lies on.

    Attributes
    ----------
    area
        The drawing in pixels of the viewport.
    is_busy
        Whether a gesture is in flight: the legend stays meanwhile.
    """

    @property
    def area(self) -> QRect: ...

    @property
    def is_busy(self) -> bool: ...

    def segments(self) -> FloatArray:
        """Return the lines that should stay visible, as segments (k, 4) in pixels of the viewport."""


class Legend(OverlayFrame):
    """Legend in the corner where it covers least; presses beside its buttons go to the drawing.

    Signals
    -------
    chosen
        A ghost shall replace the curve.
    hidden
        A ghost shall be hidden.
    """

    chosen = Signal(object)
    hidden = Signal(object)

    def __init__(self, below: QWidget, style: LayerStack, room: Room) -> None:
        super().__init__("legend", below)
        self.setAccessibleName("Legend")
        self._groups: dict[str, Sequence[LegendRow]] = {}
        self._style, self._room = style, room
        self._corner, self._form = Corner.LOWER_RIGHT, Form.WHOLE
        self._visible_rows: list[_VisibleRow] = []
        self._move_timer = DelayedCall(self, _MOVE_DELAY_MS, self._move_away)
        self._grid = grid_of(7, 1, stretched=[1], margins=(8, 5, 6, 5), parent=self)
        self.render_style()
        self.hide()

    @property
    def rows(self) -> Sequence[LegendRow]:
        """The rows in order; the group without a heading comes first, or it would stand below another's."""
        names = sorted(self._groups, key=lambda name: name != FIRST)
        return [row for name in names for row in self._groups[name]]

    def render_rows(self, group: str, rows: Sequence[LegendRow]) -> None:
        """Show the rows of a group, below the groups shown before it; () removes the group."""
        if list(rows) == list(self._groups.get(group, ())):
            return
        before = self.rows
        if rows:
            self._groups[group] = rows
        else:
            del self._groups[group]
        if [_without_figure(row) for row in before] == [_without_figure(row) for row in self.rows]:
            self._visible_rows = [
                visible.with_figure_of(row)
                for visible, row in zip(self._visible_rows, self.rows, strict=True)
            ]
            self._grid.activate()
            self._move_away()
        else:
            self._rebuild()

    def _rebuild(self) -> None:
        remove_widgets(self._grid, self._children())
        self._visible_rows = []
        for index, row in enumerate(self.rows):
            self._add(index, row)
        if self.isHidden():
            self._corner = Corner.LOWER_RIGHT
        self.setVisible(bool(self._groups))
        # A layout counts visible widgets only.
        for widget in self._children():
            widget.show()
        for visible in self._visible_rows:
            visible.set_form(self._form)
        self._grid.activate()
        self._move_away()

    def _children(self) -> list[QWidget]:
        items = [self._grid.itemAt(index) for index in range(self._grid.count())]
        widgets = [item.widget() for item in items if item is not None]
        return [widget for widget in widgets if widget is not None]

    def _add(self, index: int, row: LegendRow) -> None:
        font = QFont(self.font())
        font.setPointSizeF(font.pointSizeF() * 0.92 * self._style.scale)
        if row.style is not None:
            sign = Label()
            sign.setPixmap(sign_pixmap(row.style, self._style.theme, self.devicePixelRatioF()))
            self._grid.addWidget(sign, index, 0)
        if row.ghost is not None:
            choose, hide = self._ghost_buttons(row, row.ghost)
            choose.setFont(font)
            self._grid.addWidget(choose, index, 1)
            self._grid.addWidget(hide, index, 3)
            self._visible_rows.append(_VisibleRow(row, choose, hide, self._add_figure(index, row, font)))
            return
        text = Label(row.text)
        text.setFont(font)
        text.setToolTip(tip_of(row.tip))
        colour = self._style.theme.muted if row.is_muted else self._style.theme.ink
        text.setStyleSheet(f"color: {colour.name()}")
        first = 0 if row.style is None else 1
        self._grid.addWidget(text, index, first, 1, (2 if row.figure else 4) - first)
        self._visible_rows.append(_VisibleRow(row, text, None, self._add_figure(index, row, font)))

    def _add_figure(self, index: int, row: LegendRow, font: QFont) -> Label | None:
        if not row.figure:
            return None
        figure = Label(row.figure)
        figure.setFont(font)
        figure.setToolTip("Lebesgue constant: the largest factor by which errors in the points grow")
        figure.setStyleSheet(f"color: {self._style.theme.muted.name()}")
        self._grid.addWidget(figure, index, 2, Qt.AlignmentFlag.AlignRight)
        return figure

    def _ghost_buttons(self, row: LegendRow, ghost: Ghost) -> tuple[QToolButton, QToolButton]:
        hiding = f"Hide the ghost: {row.text}"
        choose = tool_button(f"legendChoose_{ghost.name}", "", "", text=row.text, flat=True)
        _name_choose_button(choose, row)
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
        """Lie in a corner of the drawing, as small as possible."""
        self.setGeometry(self._box_in(self._corner))

    def move_away(self) -> None:
        """Move to a corner that covers less, once the drawing rests."""
        if not self.isHidden():
            self._move_timer.start()

    def _move_away(self) -> None:
        if self._room.is_busy:
            self.place()
            self._move_timer.start()
            return
        segments, lengths = self._room.segments(), dict[tuple[Form, Corner], float]()
        for form in Form:
            self._show_form(form)
            covered = self._covered_lengths(segments)
            lengths |= {(form, corner): length for corner, length in covered.items()}
            best = min(covered, key=lambda corner: covered[corner])
            if covered[best] <= _FREE_CORNER:
                break
        else:
            # There is no free corner: the longest form among those that cover least.
            form, best = min(lengths, key=lambda option: (lengths[option], option[0]))
            self._show_form(form)
        if lengths[form, self._corner] > lengths[form, best] + _WORTH_MOVING:
            self._corner = best
        self.place()

    def _covered_lengths(self, segments: FloatArray) -> dict[Corner, float]:
        """Return the length of curve that the legend covers in each corner, in pixels."""
        boxes = [self._box_in(corner) for corner in Corner]
        here = Qt.FindChildOption.FindDirectChildrenOnly
        frames = [frame for frame in self.below.findChildren(OverlayFrame, options=here) if frame is not self]
        is_occupied = [
            any(frame.isVisible() and frame.geometry().intersects(box) for frame in frames) for box in boxes
        ]
        lengths = covered_lengths(segments, boxes) + _COVERED_FRAME * np.array(is_occupied)
        return dict(zip(Corner, lengths.tolist(), strict=True))

    def _show_form(self, form: Form) -> None:
        if form is self._form:
            return
        self._form = form
        for visible in self._visible_rows:
            visible.set_form(self._form)
        self._grid.activate()

    def _box_in(self, corner: Corner) -> QRect:
        """Return the rectangle of the legend in a corner, inside the viewport however small that is."""
        size, area = self.sizeHint(), self._room.area
        is_right, is_below = corner.value
        x = area.right() - size.width() - _MARGIN if is_right else area.left() + _MARGIN
        y = area.bottom() - size.height() - _MARGIN if is_below else area.top() + _MARGIN
        return QRect(QPoint(max(x, 0), max(y, 0)), size)

    def event(self, event: QEvent) -> bool:
        # The frame of a style sheet is laid out after the rows.
        if event.type() == QEvent.Type.LayoutRequest:
            self.place()
        return super().event(event)

    def render_style(self) -> None:
        """Use the theme and the scale of the drawing."""
        theme = self._style.theme
        paper, line = theme.paper, theme.grid_coarse.name()
        hover = mix(theme.ink, theme.paper, 0.1).name()
        # Never opaque: Qt would clip the painting below to a region that is no rectangle, which takes
        # several times as long.
        self.setStyleSheet(
            f"#legend {{ background: rgba({paper.red()}, {paper.green()}, {paper.blue()}, 215);"
            f" border: 1px solid {line}; border-radius: 6px }}"
            "QToolButton { padding: 0; border: none; border-radius: 3px; text-align: left }"
            f"QToolButton:hover {{ background: {hover} }}"
        )
        self._rebuild()


def _without_figure(row: LegendRow) -> LegendRow:
    return replace(row, figure="…") if row.figure else row


def _name_choose_button(button: QWidget, row: LegendRow) -> None:
    """Name the button that replaces the curve by a ghost, with the figure that the narrowest form omits."""
    text = row.tip or f"Apply to the curve: {row.text}" + (f" ({row.figure})" if row.figure else "")
    named(button, button.objectName(), text, tip_of(text))
