"""Parts of a window, driven by real events."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtTest import QTest

from ..features.basis.panel import BasisPanel
from ..workbench.notice_bar import NoticeBar
from .input_driver import InputDriver, type_keys
from .reach import require_reachable

_NO_KEYS = Qt.KeyboardModifier.NoModifier


class Rail:
    """The t-rail of the basis panel, with a tick for each point."""

    def __init__(self, driver: InputDriver) -> None:
        self._driver = driver

    @property
    def _panel(self) -> BasisPanel:
        panel = self._driver.window.basis_panel
        assert isinstance(panel, BasisPanel)
        return panel

    def _tick(self, index: int) -> QPointF:
        return self._panel.rail_pixel(float(self._driver.window.session.active_view.parameters[index]))

    def drag(self, index: int, to: float, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Drag the tick of point `index`."""
        self._driver.drag_pixels(self._panel, self._tick(index), self._panel.rail_pixel(to), keys=keys)

    def click(self, index: int, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Click on the tick of point `index`."""
        place = self._tick(index)
        self._driver.drag_pixels(self._panel, place, place, keys=keys)

    def type(self, index: int, text: str) -> None:
        """Double-click on the tick of point `index`, type, and press Enter."""
        panel, place = self._panel, self._tick(index)
        self.click(index)
        self._driver.send(panel, QEvent.Type.MouseButtonDblClick, place)
        self._driver.send(panel, QEvent.Type.MouseButtonRelease, place, held=False)
        line = panel.tick_edit.line
        line.selectAll()
        type_keys(line, text)
        QTest.keyClick(line, Qt.Key.Key_Return)
        self._driver.settle()

    def scrub(self, t: float) -> None:
        """Drag the scrub line from the start of the curve to t."""
        panel = self._panel
        start, _ = self._driver.window.session.active_view.parameters[[0, -1]]
        height = 0.5
        self._driver.drag_pixels(panel, panel.to_pixel(start, height), panel.to_pixel(t, height))


class FileBar:
    """The line about the document's file, with what it offers."""

    def __init__(self, driver: InputDriver) -> None:
        self._driver = driver

    @property
    def text(self) -> str:
        """The sentence; empty where there is none."""
        bar = self._driver.window.findChild(NoticeBar, "fileBar")
        return bar.text if bar is not None else ""

    def answer(self, action: str) -> None:
        """Click the button that the sentence offers for the action of this name."""
        bar = self._driver.window.findChild(NoticeBar, "fileBar")
        if bar is None or action not in bar.offered:
            raise LookupError(f"{action!r} is not offered; {bar.offered if bar else 'there is no line'}.")
        require_reachable(bar.button(action))
        QTest.mouseClick(bar.button(action), Qt.MouseButton.LeftButton)
        self._driver.settle()
