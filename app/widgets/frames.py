"""Frames: over another widget, scrolled where there is little room, and dialogs that fit the screen."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QHideEvent, QPaintEvent, QScreen, QShowEvent
from PySide6.QtWidgets import QDialog, QFrame, QLayout, QScrollArea, QScrollBar, QWidget
from shiboken6 import isValid

from ..appearance.theme import FollowsTheme, mix
from ..qt.overrides import SafeOverrides
from .boxes import column_of
from .controls import named

_MOVES = (QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show, QEvent.Type.Hide)


class OverlayFrame(FollowsTheme, QFrame):
    """A frame on top of its parent: the widgets below do not move when it appears.

    It calls `place` when the parent is resized, or when `beside`, a widget that it must not cover, appears,
    disappears or moves.
    """

    def __init__(self, name: str, below: QWidget, beside: QWidget | None = None) -> None:
        super().__init__(below)
        self.setObjectName(name)
        self._watched = [widget for widget in (below, beside) if widget is not None]

    @property
    def below(self) -> QWidget:
        """The parent widget, asked from Qt each time: PySide6 once lost a viewport that was stored."""
        below = self.parentWidget()
        assert below is not None
        return below

    def place(self) -> None:
        """Set size and position on the parent."""
        raise NotImplementedError

    def showEvent(self, event: QShowEvent) -> None:
        # A hidden frame filters no events: every move of the mouse would pass through it.
        for widget in self._watched:
            widget.installEventFilter(self)
        self.place()
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        for widget in self._watched:
            if isValid(widget):
                widget.removeEventFilter(self)
        super().hideEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _MOVES and not self.isHidden():
            self.place()
        return super().eventFilter(watched, event)

    def set_sheet(self, rules: str = "", *, line: float = 0.14) -> None:
        """Draw the frame as a sheet with a border of this share of ink; `rules` are for the widgets on it."""
        theme = self.theme
        border = mix(theme.ink, theme.paper, line).name()
        sheet = (
            f"#{self.objectName()} {{ background: {theme.surface.name()}; border: 1px solid {border};"
            f" border-radius: 8px }} {rules}"
        )
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)


FRAME = QSize(16, 48)
"""Room for title bar and borders, whose sizes are unknown before a window is shown."""

_IN_DIALOG = QSize(900, 360)
"""Largest minimum size of a dialog without its buttons: it fits 960 × 540, a usual screen at 200 %."""


Content = TypeVar("Content", bound=QWidget)
_Area = TypeVar("_Area", bound=QScrollArea)


def room_on(screen: QScreen) -> QSize:
    """Return the largest size of a window that fits the screen with its frame."""
    return screen.availableSize() - FRAME


class _QuietBar(SafeOverrides, QScrollBar):
    """A scroll bar that is invisible, but keeps its room, where there is nothing to scroll."""

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.maximum() > self.minimum():
            super().paintEvent(event)


def scroll_vertically(area: _Area, name: str, label: str = "") -> _Area:
    """Name an area whose content is as wide as it, and return it."""
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setWidgetResizable(True)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return named(area, name, label)


class Scrolled(SafeOverrides, QScrollArea, Generic[Content]):
    """Content that scrolls where there is too little room for it.

    Parameters
    ----------
    build
        Makes the content in the given parent: content that is made elsewhere and moved here would be styled
        twice.
    most
        Largest minimum size, whatever the content needs.
    is_steady
        Whether the bar always has room, so that nothing moves under the pointer when it appears.

    Attributes
    ----------
    content
        The widget that scrolls.
    """

    def __init__(
        self,
        build: Callable[[QWidget], Content],
        most: QSize,
        parent: QWidget | None = None,
        *,
        is_steady: bool = False,
    ) -> None:
        super().__init__(parent)
        self.content, self._most = build(self.viewport()), most
        # The size hints that Qt was told last.
        self._reported_hints: tuple[QSize, QSize] | None = None
        self.setObjectName("scrolled")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        # Tab goes to the widgets inside, which scroll into view by themselves.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        if is_steady:
            self.setVerticalScrollBar(_QuietBar(self))
            self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        self.setWidget(self.content)

    def sizeHint(self) -> QSize:
        return self.content.sizeHint()

    def minimumSizeHint(self) -> QSize:
        minimum = self.content.minimumSizeHint().expandedTo(self.content.minimumSize())
        return (minimum + self._beside).boundedTo(self._most)

    @property
    def _beside(self) -> QSize:
        """The room of the bar, if it is always reserved."""
        is_steady = self.verticalScrollBarPolicy() == Qt.ScrollBarPolicy.ScrollBarAlwaysOn
        return QSize(self.verticalScrollBar().sizeHint().width() if is_steady else 0, 0)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.content and event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.Show):
            self._update_room(anew=event.type() == QEvent.Type.Show)
        return super().eventFilter(watched, event)

    def _update_room(self, *, anew: bool) -> None:
        """Request a layout only if the size hints have changed since Qt was told.

        A layout of the window takes as long as a paint of the drawing.
        """
        hints = self.sizeHint(), self.minimumSizeHint()
        if anew or hints != self._reported_hints:
            self._reported_hints = hints
            self.updateGeometry()


class FittedDialog(SafeOverrides, QDialog):
    """A dialog that is never larger than the screen; its buttons stay visible.

    Attributes
    ----------
    body
        The part that scrolls where there is too little room.
    """

    def __init__(self, name: str, title: str, parent: QWidget | None = None) -> None:
        # A tool window would let the keys of the window behind it through.
        super().__init__(parent, Qt.WindowType.Dialog)
        self.setObjectName(name)
        self.setWindowTitle(title)
        self._area = Scrolled(QWidget, _IN_DIALOG, self)
        self.body = self._area.content
        self._preferred = QSize()

    def hold(self, *feet: QWidget, preferred: QSize | None = None) -> None:
        """Lay out the body above `feet`, which stay visible; `preferred` is the size where it fits."""
        self._preferred = preferred or QSize()
        layout = column_of((self._area, 1), margins=0, spacing=0, parent=self)
        if feet:
            layout.addLayout(column_of(*feet, margins=(16, 10, 16, 14)))

    def bring_up(self) -> None:
        """Show the dialog in front of the other windows."""
        self.show()
        self.raise_()
        self.activateWindow()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if not event.spontaneous() and not self._preferred.isNull():
            self._preferred, preferred = QSize(), self._preferred
            # The layouts were computed when the parts were put together, without their style.
            for layout in self.findChildren(QLayout):
                layout.invalidate()
            self._area.updateGeometry()
            size = self.sizeHint().expandedTo(preferred)
            if self.body.hasHeightForWidth():
                # The hint assumes other line breaks than there will be.
                above = size.height() - self.body.sizeHint().height()
                size.setHeight(max(preferred.height(), above + self.body.heightForWidth(size.width())))
            self.resize(size.boundedTo(room_on(self.screen())))
