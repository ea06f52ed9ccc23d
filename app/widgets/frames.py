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

_MOVES = (QEvent.Type.Resize, QEvent.Type.Move, QEvent.Type.Show, QEvent.Type.Hide)


class OverlayFrame(FollowsTheme, QFrame):
    """A frame on top of its parent: what lies below does not move when it appears.

    It places itself anew, by `place`, when the parent has another size, or when `beside`, which it keeps
    clear of, comes, goes or moves.
    """

    def __init__(self, name: str, below: QWidget, beside: QWidget | None = None) -> None:
        super().__init__(below)
        self.setObjectName(name)
        self._watched = [each for each in (below, beside) if each is not None]

    @property
    def below(self) -> QWidget:
        """Parent widget, asked for anew: for PySide6 a viewport that was kept was once gone."""
        below = self.parentWidget()
        assert below is not None
        return below

    def place(self) -> None:
        """Take size and place on the parent."""
        raise NotImplementedError

    def showEvent(self, event: QShowEvent) -> None:
        # Nobody listens for a frame that is hidden: every move of the mouse would come by.
        for each in self._watched:
            each.installEventFilter(self)
        self.place()
        super().showEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        for each in self._watched:
            if isValid(each):
                each.removeEventFilter(self)
        super().hideEvent(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() in _MOVES and not self.isHidden():
            self.place()
        return super().eventFilter(watched, event)

    def set_sheet(self, rules: str = "", *, line: float = 0.14) -> None:
        """Draw it as a sheet of paper with a border of this much ink; `rules` are those of what is on it."""
        theme = self.theme
        border = mix(theme.ink, theme.paper, line).name()
        sheet = (
            f"#{self.objectName()} {{ background: {theme.surface.name()}; border: 1px solid {border};"
            f" border-radius: 8px }} {rules}"
        )
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)


FRAME = QSize(16, 48)
"""Room for title bar and borders, which nobody knows before a window is shown."""

_IN_DIALOG = QSize(900, 360)
"""Largest minimum size of a dialog without its buttons: it fits 960 × 540, a usual screen at 200 %."""


Content = TypeVar("Content", bound=QWidget)


def room_on(screen: QScreen) -> QSize:
    """Return how large a window can be, so that it fits the screen with its frame."""
    return screen.availableSize() - FRAME


class _QuietBar(SafeOverrides, QScrollBar):
    """A scroll bar that is not seen where there is nothing to scroll, though it has its room."""

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.maximum() > self.minimum():
            super().paintEvent(event)


class Scrolled(SafeOverrides, QScrollArea, Generic[Content]):
    """Content that has the size it likes where there is room, and scrolls where there is not.

    Parameters
    ----------
    build
        Makes what scrolls, in the parent that it is given: made elsewhere and moved here, with all that is
        in it, everything would get its style anew.
    most
        What the content may ask for at least, whatever it needs.
    is_steady
        Whether its bar has room where nothing scrolls, too: when it comes, nothing moves under the pointer.

    Attributes
    ----------
    content
        What scrolls.
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
        # What it asked for when it last told of it.
        self._asked: tuple[QSize, QSize] | None = None
        self.setObjectName("scrolled")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        # Tab goes to what is inside, and that comes into sight by itself.
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        if is_steady:
            self.setVerticalScrollBar(_QuietBar(self))
            self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOn)
        self.setWidget(self.content)

    def sizeHint(self) -> QSize:
        return self.content.sizeHint()

    def minimumSizeHint(self) -> QSize:
        least = self.content.minimumSizeHint().expandedTo(self.content.minimumSize())
        return (least + self._beside).boundedTo(self._most)

    @property
    def _beside(self) -> QSize:
        """The room of the bar, where that is held."""
        is_steady = self.verticalScrollBarPolicy() == Qt.ScrollBarPolicy.ScrollBarAlwaysOn
        return QSize(self.verticalScrollBar().sizeHint().width() if is_steady else 0, 0)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if watched is self.content and event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.Show):
            self._ask_for_room(anew=event.type() == QEvent.Type.Show)
        return super().eventFilter(watched, event)

    def _ask_for_room(self, *, anew: bool) -> None:
        """Ask for room where another is needed than before; Qt asks once, and the content may grow later.

        To lay out the window takes as long as to paint the drawing.
        """
        asked = self.sizeHint(), self.minimumSizeHint()
        if anew or asked != self._asked:
            self._asked = asked
            self.updateGeometry()


class FittedDialog(SafeOverrides, QDialog):
    """A dialog that is never larger than the screen; its buttons stay in sight.

    Attributes
    ----------
    body
        What scrolls where there is not room for it.
    """

    def __init__(self, name: str, title: str, parent: QWidget | None = None) -> None:
        # A tool window would let the keys of the window behind it through.
        super().__init__(parent, Qt.WindowType.Dialog)
        self.setObjectName(name)
        self.setWindowTitle(title)
        self._area = Scrolled(QWidget, _IN_DIALOG, self)
        self.body = self._area.content
        self._wished = QSize()

    def hold(self, *feet: QWidget, wished: QSize | None = None) -> None:
        """Show the body and below it what always stays in sight; `wished` is the least size where it fits."""
        self._wished = wished or QSize()
        layout = column_of((self._area, 1), margins=0, spacing=0, parent=self)
        if feet:
            layout.addLayout(column_of(*feet, margins=(16, 10, 16, 14)))

    def bring_up(self) -> None:
        """Show it in front of the other windows."""
        self.show()
        self.raise_()
        self.activateWindow()

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if not event.spontaneous() and not self._wished.isNull():
            self._wished, wished = QSize(), self._wished
            # What the layouts know dates from when the parts were put together, without their style.
            for layout in self.findChildren(QLayout):
                layout.invalidate()
            self._area.updateGeometry()
            size = self.sizeHint().expandedTo(wished)
            if self.body.hasHeightForWidth():
                # The hint thinks of other lines than there will be.
                above = size.height() - self.body.sizeHint().height()
                size.setHeight(max(wished.height(), above + self.body.heightForWidth(size.width())))
            self.resize(size.boundedTo(room_on(self.screen())))
