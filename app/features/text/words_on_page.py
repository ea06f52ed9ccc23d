"""Words that are typed on the page: keys, clicks and the caret, at the letters that the canvas draws."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import Protocol

from PySide6.QtCore import QLineF, QPointF, QRect, QRectF, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QGuiApplication,
    QHideEvent,
    QInputMethodEvent,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QRegion,
    QTextCursor,
    QTransform,
    QWheelEvent,
)
from PySide6.QtWidgets import QFrame, QWidget

from ...appearance.theme import Theme
from ...appearance.themed import FollowsTheme
from ...document.value import Vector
from ...qt.caret_places import CaretPlaces
from ...qt.keys import ClaimsKeys
from .words_edit import WordsEdit

_CORE, _HALO = 1.5, 3.5
"""Pixels of the caret, and of what is light around it: one of them is seen on any ground."""

_AROUND = 6.0
"""Pixels around the letters in which a press is theirs."""

_HANDLE = 8
"""Pixels to each side of a handle of the frame in which a press is not."""

_CHOSEN = 0.35
"""Opacity of what lies over letters that are chosen."""

_SEQUENCES = QKeySequence.StandardKey
_STEPS = {
    _SEQUENCES.MoveToPreviousLine: (-1, False),
    _SEQUENCES.MoveToNextLine: (1, False),
    _SEQUENCES.SelectPreviousLine: (-1, True),
    _SEQUENCES.SelectNextLine: (1, True),
}
_ENDS = {
    _SEQUENCES.MoveToStartOfLine: (0, False),
    _SEQUENCES.MoveToEndOfLine: (1, False),
    _SEQUENCES.SelectStartOfLine: (0, True),
    _SEQUENCES.SelectEndOfLine: (1, True),
}


class KeyTaker(Protocol):
    """Has keys of its own while words are typed."""

    def claims(self, event: QKeyEvent) -> bool:
        """Whether a key is one of them."""

    def take_key(self, event: QKeyEvent) -> None:
        """Do what it is for."""


class WordsOnPage(ClaimsKeys, FollowsTheme, WordsEdit):
    """Lies over the canvas where the letters are, and has the caret between them.

    Attributes
    ----------
    places
        Where the caret can be, in pixels of the canvas.
    way
        Tells how the plane is mapped to these.

    Signals
    -------
    keyed
        The caret is where a key has led it, and wants to be in sight.
    """

    keyed = Signal()

    def __init__(self, below: QWidget, keys: KeyTaker) -> None:
        super().__init__(below)
        self._keys = keys
        self.places = self._there = CaretPlaces(())
        self._corners = self._frame = QPolygonF()
        self.way: Callable[[], QTransform] = QTransform
        self._below = below
        self._is_on = False
        # Where Up and Down lead along a line, whatever lines lie between.
        self._goal: QPointF | None = None
        self._clicks = 0
        self._again = QTimer(self, singleShot=True)
        self._blink = QTimer(self)
        self._blink.timeout.connect(self._turn)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        for each in (self, self.viewport()):
            # Letters are painted by the canvas below.
            each.setAutoFillBackground(False)
            each.setAttribute(Qt.WidgetAttribute.WA_NoSystemBackground)
        self.setToolTip("")
        self.setAcceptDrops(False)
        self.cursorPositionChanged.connect(self._follow_caret)
        self.selectionChanged.connect(self.viewport().update)
        self.hide()
        self.follow_theme()

    def set_theme(self, theme: Theme) -> None:
        self.viewport().update()

    # Where it is

    def lie_at(self, places: CaretPlaces, corners: Sequence[Vector]) -> None:
        """Lie where letters are in the plane, and in the frame with some corners that they fill, if any."""
        self._there, self._corners = places, QPolygonF([QPointF(*each) for each in corners])

    def follow_view(self) -> None:
        """Lie where these are seen now."""
        way = self.way()
        self.places = places = self._there.mapped(way)
        # PySide6 maps an empty one to one of whole numbers.
        self._frame = frame = QPolygonF() if self._corners.isEmpty() else way.map(self._corners)
        region = QRegion()
        for box in places.boxes(margin=_AROUND):
            region += QRegion(box.toPolygon())
        if not frame.isEmpty():
            region += QRegion(frame.toPolygon())
            region -= _handles_of(frame)
        area = self._below.rect()
        region &= QRegion(area)
        # Without any the whole widget would count.
        region = QRegion(-2, -2, 1, 1) if region.isEmpty() else region
        self.setGeometry(area)
        self.setMask(region)
        self._show_caret()

    @property
    def area(self) -> QRect:
        """What the letters, or their frame, take of the canvas."""
        boxes = [each.boundingRect() for each in (*self.places.boxes(), self._frame)]
        return reduce(QRectF.united, boxes).toAlignedRect()

    @property
    def caret(self) -> QLineF:
        """The caret, from its upper end down, in pixels of the canvas."""
        return self.places.line(self.caret_place)

    @property
    def is_caret_seen(self) -> bool:
        """Whether it is there now: it blinks."""
        return self._is_on and self.hasFocus() and bool(self.places.rows)

    @property
    def chosen_boxes(self) -> list[QPolygonF]:
        """What the chosen letters take, in pixels of the canvas."""
        cursor = self.textCursor()
        return self.places.boxes(cursor.selectionStart(), cursor.selectionEnd())

    def _follow_caret(self) -> None:
        self._goal = None
        self._show_caret()

    def _show_caret(self) -> None:
        """Have the caret seen from now on, and by those who help to type."""
        flash = QGuiApplication.styleHints().cursorFlashTime()
        self._is_on = True
        if self.hasFocus() and flash > 0:
            self._blink.start(flash // 2)
        else:
            self._blink.stop()
        self.viewport().update()
        if self.hasFocus():
            QGuiApplication.inputMethod().update(Qt.InputMethodQuery.ImCursorRectangle)

    def _turn(self) -> None:
        self._is_on = not self._is_on
        if self.places.rows:
            self.viewport().update(_around(self.caret))

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self._show_caret()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self._blink.stop()
        self.viewport().update()

    def hideEvent(self, event: QHideEvent) -> None:
        self._blink.stop()
        super().hideEvent(event)

    # Painted

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self.viewport())
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not self.places.rows:
            return
        accent = QColor(self.theme.accent)
        accent.setAlphaF(_CHOSEN)
        painter.setPen(QPen(self.theme.accent, 1.0))
        painter.setBrush(accent)
        for box in self.chosen_boxes:
            painter.drawPolygon(box)
        for before, typed in self._lines_under_preedit():
            _paint_line(painter, QLineF(before, typed))
        if self.is_caret_seen:
            _paint_line(painter, self.caret)

    # Letters that are not yet taken

    def inputMethodEvent(self, event: QInputMethodEvent) -> None:
        super().inputMethodEvent(event)
        self._show_caret()
        self.keyed.emit()

    def inputMethodQuery(self, query: Qt.InputMethodQuery, argument: object = None) -> object:  # noqa: N802
        if query == Qt.InputMethodQuery.ImCursorRectangle and self.places.rows:
            return _around(self.caret)
        return super().inputMethodQuery(query, argument)

    def _lines_under_preedit(self) -> list[tuple[QPointF, QPointF]]:
        start = self.textCursor().position()
        boxes = self.places.boxes(start, start + len(self.preedit))
        return [(box.at(3), box.at(2)) for box in boxes]

    # Keys

    def claims(self, event: QKeyEvent) -> bool:
        return self._keys.claims(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self._keys.claims(event):
            self._keys.take_key(event)
        elif not self._led(event):
            super().keyPressEvent(event)
        self.keyed.emit()

    def _led(self, event: QKeyEvent) -> bool:
        """Go where a key leads by the lines that are seen, or undo; return whether it does."""
        for key in (_SEQUENCES.Undo, _SEQUENCES.Redo):
            if event.matches(key):
                self.take_back(again=key == _SEQUENCES.Redo)
                return True
        for key, (step, extends) in _STEPS.items():
            if event.matches(key):
                self._step(step, extends=extends)
                return True
        for key, (end, extends) in _ENDS.items():
            if event.matches(key):
                row = self.places.row_at(self.textCursor().position())
                self.stand_at(self.places.ends_of(row)[end], extends=extends)
                return True
        return False

    def _step(self, step: int, *, extends: bool) -> None:
        """Go to the line above or below; beyond the last ones to their ends."""
        place = self.textCursor().position()
        row = self.places.row_at(place) + step
        goal = self._goal if self._goal is not None else self.places.line(place).center()
        if not 0 <= row < len(self.places.rows):
            place = (
                self.places.ends_of(0)[0] if step < 0 else self.places.ends_of(len(self.places.rows) - 1)[1]
            )
        else:
            place = self.places.place_at(goal, row)
        self.stand_at(place, extends=extends)
        self._goal = goal

    def stand_at(self, place: int, *, extends: bool = False) -> None:
        """Have the caret at a place; choose what lies between."""
        cursor, modes = self.textCursor(), QTextCursor.MoveMode
        place = min(max(place, 0), self.document().characterCount() - 1)
        cursor.setPosition(place, modes.KeepAnchor if extends else modes.MoveAnchor)
        self.setTextCursor(cursor)

    def stand_at_place(self, place: Vector) -> None:
        """Have the caret nearest to a place of the plane."""
        self.stand_at(self.places.place_at(self.way().map(QPointF(*place))))

    # The mouse

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or not self.places.rows:
            # The canvas is moved with the others.
            event.ignore()
            return
        self._clicks = self._clicks + 1 if self._again.isActive() else 1
        if self._clicks == 3:
            self._choose_line()
            return
        extends = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        self.stand_at(self.places.place_at(event.position()), extends=extends)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton or not self.places.rows:
            event.ignore()
            return
        self.stand_at(self.places.place_at(event.position()))
        cursor = self.textCursor()
        cursor.select(QTextCursor.SelectionType.WordUnderCursor)
        self.setTextCursor(cursor)
        self._clicks = 2
        self._again.start(QGuiApplication.styleHints().mouseDoubleClickInterval())

    def _choose_line(self) -> None:
        start, end = self.places.ends_of(self.places.row_at(self.textCursor().position()))
        self.stand_at(start)
        self.stand_at(end, extends=True)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if event.buttons() & Qt.MouseButton.LeftButton and self.places.rows:
            if self._clicks < 2:
                self.stand_at(self.places.place_at(event.position()), extends=True)
        else:
            event.ignore()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        if event.button() != Qt.MouseButton.LeftButton:
            event.ignore()
        elif not self._again.isActive():
            self._clicks = 0

    def wheelEvent(self, event: QWheelEvent) -> None:
        # It zooms.
        event.ignore()


def _handles_of(frame: QPolygonF) -> QRegion:
    """Return where the handles of a frame are: at its sides and a corner."""
    corners = [frame.at(index) for index in range(4)]
    middles = [(one + other) / 2 for one, other in zip(corners, corners[1:] + corners[:1], strict=True)]
    region = QRegion()
    for place in (*corners, *middles):
        x, y = round(place.x()), round(place.y())
        region += QRegion(x - _HANDLE, y - _HANDLE, 2 * _HANDLE, 2 * _HANDLE)
    return region


def _around(line: QLineF) -> QRect:
    """Return what a caret takes of the canvas, with what is light around it."""
    room = round(_HALO)
    box = QRect(line.p1().toPoint(), line.p2().toPoint()).normalized()
    return box.adjusted(-room, -room, room, room)


def _paint_line(painter: QPainter, line: QLineF) -> None:
    for colour, width in ((QColor(255, 255, 255, 230), _HALO), (QColor(0, 0, 0), _CORE)):
        painter.setPen(QPen(colour, width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap))
        painter.drawLine(line)
