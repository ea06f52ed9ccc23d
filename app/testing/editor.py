"""One window of the editor with its t-rail and its file bar, driven by real events."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from itertools import chain
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QAction, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QDockWidget, QWidget

from ..canvas.handle_marks import VisibleHandles
from ..cli.display import has_display
from ..document.model import Curve, ParametrizationKind, Vector
from ..document.plane_edits import set_grid_spacing, set_unit
from ..families import FAMILIES, Family
from ..features.basis.panel import BasisPanel
from ..features.curve_list.commands import CurveListCommands
from ..features.curve_list.rows import Spot, spot_rect
from ..session import Session
from ..settings.preferences import Preferences
from ..tools.box import TransformKind
from ..view_model.curve.handles import Handle
from ..window.command_palette import CommandPalette
from ..window.main_window import MainWindow
from ..workbench.message_bar import NoticeBar
from .input_driver import InputDriver, type_keys
from .reach import require_enabled, require_reachable, require_under_mouse
from .waiting import WAIT_S, spin

_NO_KEYS = Qt.KeyboardModifier.NoModifier
_LEFT = Qt.MouseButton.LeftButton


if not has_display():
    # Without a display Qt would end the test run; it reads this when the application is created.
    os.environ["QT_QPA_PLATFORM"] = "offscreen"


class QtBot(Protocol):
    """pytest-qt's ``qtbot``, as far as the driver needs it."""

    def addWidget(  # noqa: N802
        self, widget: QWidget, *, before_close_func: Callable[[QWidget], None] | None = None
    ) -> None:
        """Close `widget` after the test."""

    def waitExposed(self, widget: QWidget) -> object:  # noqa: N802
        """Wait until the window is shown."""


class Editor(InputDriver):
    """One window of the editor, driven by real events.

    Positions are those of the plane; each method returns when the window has been painted::

        editor.add_point(1.0, 2.0)
        editor.drag_point(0, to=(1.5, 2.5))
        editor.trigger("undo")

    An action that is disabled raises `ImpossibleError` with the reason.

    Parameters
    ----------
    qtbot
        pytest-qt's fixture.
    session
        What to edit; by default a new session with the sketch of the first start.
    preferences
        Settings; by default those of the user (redirect them in your tests).
    size
        Size of the window in pixels.

    Attributes
    ----------
    session, window
        The objects that ``curvebench`` opens.
    rail, file_bar
        Parts of the window: the t-rail, and the line about the document's file.
    """

    def __init__(
        self,
        qtbot: QtBot,
        session: Session | None = None,
        preferences: Preferences | None = None,
        size: tuple[int, int] = (1200, 800),
    ) -> None:
        self.session = session or Session()
        self.window = MainWindow(self.session, preferences)
        self._find_parts()
        qtbot.addWidget(self.window, before_close_func=lambda _window: self._discard_changes())
        self.window.resize(*size)
        with qtbot.waitExposed(self.window):  # type: ignore[attr-defined]
            self.window.show()
        self.fit()

    @classmethod
    def on(cls, window: MainWindow) -> Editor:
        """Return a driver of a window that is open already, in a program that runs without pytest."""
        editor = cls.__new__(cls)
        editor.session, editor.window = window.session, window
        editor._find_parts()
        return editor

    def _find_parts(self) -> None:
        self.rail, self.file_bar = Rail(self), FileBar(self)

    def _discard_changes(self) -> None:
        # Else closing asks whether to save, and the test run waits for an answer.
        self.window.asks_before_closing = False
        self.session.files.give_up_changes()

    # What is there

    @property
    def curve(self) -> Curve:
        """The active curve of the document."""
        return self.session.active_curve

    def point(self, index: int) -> Vector:
        """Return the position of a point."""
        return self.curve.points[index].position

    @property
    def parameters(self) -> list[float]:
        """The parameters t_i in force."""
        return [float(t) for t in self.session.active_view.parameters]

    @property
    def pixel(self) -> float:
        """Size of a pixel of the canvas in the plane: the accuracy of the mouse."""
        return 1.0 / self.window.canvas.pixel_map.sx

    def action(self, name: str) -> QAction:
        """Return the action with this objectName."""
        action = self.window.findChild(QAction, name)
        if action is None:
            raise LookupError(f"There is no action called {name!r}.")
        return action

    @property
    def message(self) -> str:
        """The sentence above the canvas; empty when there is none."""
        return self.window.message_bar.text

    @property
    def status(self) -> str:
        """The sentence at the left of the status line."""
        return self.window.status_line.text

    # What a person does

    def new(self) -> None:
        """Start an empty sketch with the view from (−0.5, −0.5) on, adding points."""
        self.session.files.give_up_changes()
        self.trigger("newDocument")

    def trigger(self, name: str) -> None:
        """Trigger an action, as its menu or its keys would; `ImpossibleError` where it is disabled."""
        action = self.action(name)
        require_enabled(action)
        action.trigger()
        self.settle()

    def fit(self) -> None:
        """Show the whole curve."""
        self.trigger("fitView")

    def choose_family(self, family: Family | str) -> None:
        """Switch the family, given as a record or by its name."""
        self.trigger((FAMILIES.named(family) if isinstance(family, str) else family).action_name)

    def choose_parametrization(self, kind: ParametrizationKind) -> None:
        """Choose the rule for the parameters in the toolbar's box, by keyboard."""
        box = self.window.findChild(QComboBox, "parametrizationBox")
        assert box is not None
        require_reachable(box)
        box.setFocus()
        # Each key press selects the next rule.
        steps = list(ParametrizationKind).index(ParametrizationKind(kind)) - box.currentIndex()
        for _ in range(abs(steps)):
            QTest.keyClick(box, Qt.Key.Key_Down if steps > 0 else Qt.Key.Key_Up)
        self.settle()

    def add_point(self, x: float, y: float, velocity_handle: Vector | None = None) -> None:
        """Click with the Add tool at (x, y), or press there and drag to `velocity_handle`."""
        self.trigger("addTool")
        if velocity_handle is None:
            self.click((x, y))
        else:
            self.drag((x, y), velocity_handle)
        self.trigger("selectTool")

    def select_point(self, index: int) -> None:
        """Click on a point."""
        self.click(self.point(index))

    def drag_point(self, index: int, to: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Drag a point."""
        self.drag(self.point(index), to, keys=keys)

    def handle(self, kind: int = 1, *, ahead: bool = True, index: int | None = None) -> Handle:
        """Return a handle that is shown: kind 1 velocity, 2 acceleration; of a selected point, or of one."""
        canvas = self.window.canvas
        handles: VisibleHandles = canvas.drawing.points.visible_handles
        pixel_map = canvas.pixel_map
        facing = handles.facing(pixel_map) if index is not None else ()
        for handle in chain(handles.of_selected(pixel_map), facing):
            if (handle.order, handle.ahead) == (kind, ahead) and index in (None, handle.index):
                return handle
        raise LookupError("No such handle is shown.")

    def drag_handle(self, to: Vector, kind: int = 1, *, ahead: bool = True, index: int | None = None) -> None:
        """Drag a handle that is shown, as `handle` finds it."""
        self.drag(self.handle(kind, ahead=ahead, index=index).position, to)

    def bend(self, t: float, to: Vector, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Grab the curve at `t` and drag it."""
        assert self.session.active_view.curve is not None
        x, y = self.session.active_view.curve.evaluate(t)
        self.drag((float(x), float(y)), to, keys=keys)

    def grip(self, x: int = 0, y: int = 0) -> Vector:
        """Return the position of a grip of the selection box: x, y in −1, 0, 1; 0, 0 rotates."""
        canvas = self.window.canvas
        if canvas.marks.box is None:
            raise LookupError("No box is shown; select two points.")
        for grip, position in canvas.marks.box.grips(canvas.pixel_map.sx):
            is_above = not canvas.marks.box.turns and grip.does is TransformKind.ROTATE
            if is_above if (x, y) == (0, 0) else (grip.x, grip.y, is_above) == (x, y, False):
                return position
        raise LookupError("The box has no such grip.")

    def type_amount(self, text: str) -> None:
        """Type into the transform that G, S or R began."""
        require_reachable(self.window.canvas)
        QTest.keyClicks(self.window.canvas, text)
        self.settle()

    def drag_parameter(self, index: int, to: float, *, keys: Qt.KeyboardModifier = _NO_KEYS) -> None:
        """Drag the tick of point `index` along the t-rail."""
        self.rail.drag(index, to, keys=keys)

    def find_command(self, text: str) -> list[str]:
        """Open the command palette, type, and return the names it finds, best first; it stays open."""
        built = self.window.findChild(CommandPalette)
        if built is None or not built.isVisible():
            self.trigger("commandPalette")
        palette = self._palette()
        palette.search.clear()
        type_keys(palette.search, text)
        self.settle()
        return palette.matches

    def run_command(self, text: str) -> None:
        """Run the first match of the command palette."""
        self.find_command(text)
        QTest.keyClick(self._palette().search, Qt.Key.Key_Return)
        self.settle()

    def _palette(self) -> CommandPalette:
        palette = self.window.findChild(CommandPalette)
        assert palette is not None
        return palette

    def scrub(self, t: float) -> None:
        """Drag the scrub line to t."""
        self.rail.scrub(t)

    def click_in_list(self, row: int, spot: Spot = Spot.NAME) -> None:
        """Click a part of a row in the list of curves; `row` is the curve's place in the document."""
        self.show_dock("curvesDock")
        view = self.window.commands[CurveListCommands].panel.view
        position = spot_rect(view.parts.row_rect(row), spot).center()
        require_under_mouse(view.viewport(), position)
        QTest.mouseClick(view.viewport(), _LEFT, pos=position)
        self.settle()

    def show_dock(self, name: str) -> None:
        """Bring the dock with this objectName to the front."""
        dock = self.window.findChild(QDockWidget, name)
        if dock is None:
            raise LookupError(f"There is no dock called {name!r}.")
        dock.show()
        dock.raise_()
        self.settle()

    def type_text(self, widget: QWidget, text: str) -> None:
        """Type into a widget."""
        require_reachable(widget)
        type_keys(widget, text)

    def wait_for_work(self) -> None:
        """Wait until nothing is read or written beside the window; `TimeoutError` after `WAIT_S` seconds."""
        deadline = time.monotonic() + WAIT_S
        while self.window.context.work.jobs.is_busy:
            if time.monotonic() > deadline:
                raise TimeoutError(f"{self.window.context.work.jobs.title} takes longer than {WAIT_S:g} s.")
            spin(5)
        self.settle()

    def screenshot(self, path: str | Path | None = None) -> QImage:
        """Return a picture of the window, and write it to `path` if one is given."""
        self.settle()
        image = self.window.grab().toImage()
        if path is not None:
            image.save(str(path))
        return image

    def paste_text(self, text: str) -> None:
        """Put text on the clipboard."""
        QGuiApplication.clipboard().setText(text)

    def set_grid(self, spacing: float) -> None:
        """Give the document a grid of this spacing; 0 adapts it to the zoom."""
        self.session.change("Set the grid spacing", lambda document: set_grid_spacing(document, spacing))
        self.settle()

    def set_unit(self, unit: str) -> None:
        """Give the document a unit."""
        self.session.change("Set the unit", lambda document: set_unit(document, unit))
        self.settle()

    def select(self, indices: Sequence[int]) -> None:
        """Select points."""
        self.session.selected.set_points(indices)
        self.settle()


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
        position = self._tick(index)
        self._driver.drag_pixels(self._panel, position, position, keys=keys)

    def type(self, index: int, text: str) -> None:
        """Double-click on the tick of point `index`, type, and press Enter."""
        panel, position = self._panel, self._tick(index)
        self.click(index)
        self._driver.send(panel, QEvent.Type.MouseButtonDblClick, position)
        self._driver.send(panel, QEvent.Type.MouseButtonRelease, position, held=False)
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
    """The bar about the file of the document, with its actions."""

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
