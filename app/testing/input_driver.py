"""Mouse, wheel and keys on the canvas of a window, as real events."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QContextMenuEvent, QGuiApplication, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QWidget

from ..document.model import Vector
from ..plotting.plot_widget import PlotWidget
from ..window.main_window import MainWindow
from .reach import require_enabled, require_reachable, require_under_mouse, require_within_drag
from .waiting import SHORT_MS, deliver_events, wait_for_rest, wait_until_visible

_STEPS = 6
_NO_KEYS = Qt.KeyboardModifier.NoModifier
_LEFT = Qt.MouseButton.LeftButton


def type_keys(widget: QWidget, text: str) -> None:
    """Press and release a key for each letter; QTest's own function ends the process at an é."""
    for letter in text:
        if letter.isascii():
            QTest.keyClicks(widget, letter)
        else:
            for kind in (QEvent.Type.KeyPress, QEvent.Type.KeyRelease):
                event = QKeyEvent(kind, 0, Qt.KeyboardModifier.NoModifier, letter)
                QApplication.sendEvent(widget, event)


class InputDriver:
    """Driver of the mouse over a window, and of its keys."""

    window: MainWindow

    def click(self, at: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Click on the canvas, before it is painted with the button down."""
        canvas = self.window.canvas
        pixel = canvas.to_pixel(*at)
        self.send(canvas, QEvent.Type.MouseMove, pixel, held=False, keys=keys)
        self.send(canvas, QEvent.Type.MouseButtonPress, canvas.to_pixel(*at), keys=keys)
        self.release(at, keys=keys)

    def double_click(self, at: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Click twice on the canvas, as quickly as it takes to be one double click."""
        canvas = self.window.canvas
        pixel = canvas.to_pixel(*at)
        self.click(at, keys=keys)
        # The same pixel, even if the first click has moved the view.
        self.send(canvas, QEvent.Type.MouseButtonDblClick, pixel, keys=keys)
        self.send(canvas, QEvent.Type.MouseButtonRelease, pixel, held=False, keys=keys)
        self.settle()

    def drag(self, start: Vector, to: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Press at `start`, move and release at `to`, on the canvas."""
        canvas = self.window.canvas
        self.drag_pixels(canvas, canvas.to_pixel(*start), canvas.to_pixel(*to), keys=keys)

    def press(self, at: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Move to a place on the canvas and press the left button."""
        canvas = self.window.canvas
        self.send(canvas, QEvent.Type.MouseMove, canvas.to_pixel(*at), held=False, keys=keys)
        self.send(canvas, QEvent.Type.MouseButtonPress, canvas.to_pixel(*at), keys=keys)
        self.settle()

    def move(self, to: Vector, *, held: bool = True, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Move to a place on the canvas."""
        canvas = self.window.canvas
        self.send(canvas, QEvent.Type.MouseMove, canvas.to_pixel(*to), held=held, keys=keys)
        self.settle()

    def release(self, at: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Release the left button on the canvas."""
        canvas = self.window.canvas
        self.send(canvas, QEvent.Type.MouseButtonRelease, canvas.to_pixel(*at), held=False, keys=keys)
        self.settle()

    def hover(self, at: Vector) -> None:
        """Move over the canvas with no button down."""
        self.move(at, held=False)

    def leave(self) -> None:
        """Take the mouse away from the canvas."""
        QApplication.sendEvent(self.window.canvas.viewport(), QEvent(QEvent.Type.Leave))
        self.settle()

    def key(self, key: Qt.Key, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Press a key with the canvas in focus."""
        require_reachable(self.window.canvas)
        self.window.canvas.setFocus()
        QTest.keyClick(self.window.canvas, key, keys)
        self.settle()

    def hold_space(self) -> None:
        """Press Space over the canvas: a drag pans."""
        require_reachable(self.window.canvas)
        self.window.canvas.setFocus()
        QTest.keyPress(self.window.canvas, Qt.Key.Key_Space)

    def release_space(self) -> None:
        """Release Space."""
        QTest.keyRelease(self.window.canvas, Qt.Key.Key_Space)

    def escape(self) -> None:
        """Press Escape."""
        self.key(Qt.Key.Key_Escape)

    def wheel(self, at: Vector, notches: int) -> None:
        """Turn the wheel on the canvas."""
        canvas = self.window.canvas
        position = QPointF(canvas.to_pixel(*at))
        require_under_mouse(canvas.viewport(), position)
        event = QWheelEvent(
            position,
            canvas.viewport().mapToGlobal(position),
            QPoint(),
            QPoint(0, 120 * notches),
            Qt.MouseButton.NoButton,
            _NO_KEYS,
            Qt.ScrollPhase.NoScrollPhase,
            False,
        )
        QApplication.sendEvent(canvas.viewport(), event)
        self.settle()

    def drag_pixels(
        self,
        plot: PlotWidget,
        start: QPoint | QPointF,
        to: QPoint | QPointF,
        *,
        keys: Qt.KeyboardModifier = _NO_KEYS,
        button: Qt.MouseButton = _LEFT,
    ) -> None:
        """Drag between two pixels of a plot's viewport; the second may lie outside it, within a screen."""
        start, to = QPointF(start), QPointF(to)
        require_within_drag(plot.viewport(), to)  # before the press, which would stay
        self.send(plot, QEvent.Type.MouseMove, start, held=False, keys=keys)
        self.send(plot, QEvent.Type.MouseButtonPress, start, keys=keys, button=button)
        for step in range(1, _STEPS + 1):
            between = start + (to - start) * (step / _STEPS)
            self.send(plot, QEvent.Type.MouseMove, between, keys=keys, button=button)
        self.send(plot, QEvent.Type.MouseButtonRelease, to, held=False, keys=keys, button=button)
        self.settle()

    def send(
        self,
        plot: PlotWidget,
        kind: QEvent.Type,
        pixel: QPoint | QPointF,
        *,
        held: bool = True,
        keys: Qt.KeyboardModifier = _NO_KEYS,
        button: Qt.MouseButton = _LEFT,
    ) -> None:
        """Send one mouse event to a plot's viewport.

        With a button held the mouse may leave the plot, but not farther than a screen, as it may before the
        release.
        """
        position = QPointF(pixel)
        if kind == QEvent.Type.MouseButtonRelease or (kind == QEvent.Type.MouseMove and held):
            require_within_drag(plot.viewport(), position)
        else:
            require_under_mouse(plot.viewport(), position)
        nothing = Qt.MouseButton.NoButton
        event = QMouseEvent(
            kind,
            position,
            plot.viewport().mapToGlobal(position),
            nothing if kind == QEvent.Type.MouseMove else button,
            button if held else nothing,
            keys,
        )
        QApplication.sendEvent(plot.viewport(), event)

    def open_menu(self, at: Vector) -> QMenu:
        """Press the right button on the canvas and return the menu that opens."""
        canvas = self.window.canvas
        pixel = canvas.to_pixel(*at)
        self.send(canvas, QEvent.Type.MouseButtonPress, pixel, button=Qt.MouseButton.RightButton)
        return self._menu_from(canvas.viewport(), QContextMenuEvent.Reason.Mouse, pixel)

    def press_menu_key(self) -> QMenu:
        """Press the Menu key with the canvas in focus and return the menu that opens."""
        return self._menu_from(self.window.canvas, QContextMenuEvent.Reason.Keyboard, QPoint())

    def _menu_from(self, widget: QWidget, reason: QContextMenuEvent.Reason, pixel: QPoint) -> QMenu:
        require_reachable(widget)
        QApplication.sendEvent(widget, QContextMenuEvent(reason, pixel, widget.mapToGlobal(pixel)))
        self.settle()
        return self.menu()

    def menu(self) -> QMenu:
        """Return the menu that is open."""
        menu = QApplication.activePopupWidget()
        if not isinstance(menu, QMenu):
            raise LookupError("There is no menu open.")
        return menu

    def choose(self, name: str) -> None:
        """Click the entry of the open menu, or of a submenu of it, that has this objectName."""
        if not (path := _path_to(name, self.menu())):
            raise LookupError(f"There is no entry called {name!r} in the menu.")
        require_enabled(path[-1])
        for entry in path:
            menu = self.menu()
            QTest.mouseClick(menu, _LEFT, pos=menu.actionGeometry(entry).center())
            if isinstance(within := entry.menu(), QMenu):
                wait_until_visible(within)
            self.settle()

    def settle(self) -> None:
        """Deliver pending events, paint, and update the progress of a gesture in the status line."""
        QGuiApplication.processEvents()
        deliver_events()
        for plot in filter(None, (self.window.canvas, self.window.basis_panel)):
            plot.show_status()

    def wait_for_rest(self, *, up_to_ms: int = SHORT_MS) -> None:
        """Wait until numbers, panels and the table have followed the hand: those of this pace or quicker."""
        wait_for_rest(self.window, up_to_ms=up_to_ms)
        self.settle()


def _path_to(name: str, menu: QMenu) -> list[QAction]:
    """Return the entries to click, each in the menu of the one before, for that of this objectName."""
    for entry in menu.actions():
        if entry.objectName() == name:
            return [entry]
        within = entry.menu()
        if isinstance(within, QMenu) and (path := _path_to(name, within)):
            return [entry, *path]
    return []
