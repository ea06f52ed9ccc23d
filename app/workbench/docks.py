"""Docks at the sides of the window: declared panels, their tabs and titles, and the room they get."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TypeVar

import msgspec
from PySide6.QtCore import QSize, Qt, QTimer, Signal
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QTabBar, QWidget

from ..actions.declaration import marked
from ..appearance.icons import icon
from ..appearance.theme import FollowsTheme, Theme
from ..qt.labels import Label
from ..qt.overrides import SafeOverrides
from ..widgets.boxes import row_of
from ..widgets.controls import ICON, tool_button
from ..widgets.frames import Scrolled

_LEFT, _RIGHT = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
_WIDTH = 350
"""Of the docks at the right, in a new window: no panel asks for more, so that none makes them wider."""

_SCALED = "QMainWindow > QTabBar, QDockWidget *, CentralPane QLabel, CentralPane QAbstractButton"
"""Selector of the texts that grow with the drawing."""

_DECLARED = "docked_panel"
_Builder = TypeVar("_Builder", bound=Callable[..., QWidget])


class Stack(msgspec.Struct, frozen=True):
    """Docks that are tabs of one area; the first declared one is in front.

    Attributes
    ----------
    area
        The side of the window.
    height
        Its share of the side in a new window.
    """

    area: Qt.DockWidgetArea
    height: int


UPPER, LOWER, LEFT = Stack(_RIGHT, 460), Stack(_RIGHT, 320), Stack(_LEFT, 0)
_STACKS = (UPPER, LOWER, LEFT)


class Panel(msgspec.Struct, frozen=True):
    """Declaration of a panel in a dock; the decorated method builds the panel in the parent that it gets.

    Attributes
    ----------
    name, title
        Object name of the dock, and text of its tab.
    stack
        The docks that share its tabs.
    on_demand
        Whether the dock is hidden until it is asked for: too many tabs are none.
    is_steady
        Whether the content keeps its width when the scroll bar appears, for a panel that changes with every
        click on the canvas.
    built_at_start
        Whether the panel is built with the window. Others are built when their dock is first shown, so that
        nobody waits for them at the start; the building method has to show what there is by then.
    """

    name: str
    title: str
    stack: Stack = LOWER
    on_demand: bool = False
    is_steady: bool = False
    built_at_start: bool = False

    def __call__(self, build: _Builder) -> _Builder:
        """Declare the decorated method as the one that builds the panel."""
        setattr(build, _DECLARED, self)
        return build


def declared_panels(commands: type) -> Iterator[tuple[Panel, Callable[..., QWidget]]]:
    """Yield the declarations and building methods of the panels of a command set."""
    for build, panel in marked(commands, _DECLARED):
        yield panel, build


class Docks:
    """Docks of a window, built and arranged by their declarations.

    ``docks["jointsDock"]`` is a dock by the object name that its `Panel` declares; where it stands, and
    whether it is visible, is saved between starts.

    Parameters
    ----------
    panels
        The declared panels, in the order of the tabs.
    build
        Function that builds the panel of a dock, called with its name and the parent.

    Attributes
    ----------
    all, side
        All docks in the order of their stacks; the docks at the right.
    """

    def __init__(self, window: QMainWindow, panels: Sequence[Panel], build: Callable[..., QWidget]) -> None:
        self._window, self._scale = window, 1.0
        self._usual_widths: dict[QDockWidget, int] = {}
        panels = [panel for stack in _STACKS for panel in panels if panel.stack is stack]
        self._docks = {
            panel.name: (Dock if panel.built_at_start else LateDock)(
                panel.title, partial(build, panel.name), window
            )
            for panel in panels
        }
        for panel in panels:
            self._docks[panel.name].is_steady = panel.is_steady
        fronts: dict[Stack, QDockWidget] = {}
        for panel in panels:
            self._add_dock(self[panel.name], panel, fronts)
        for front in fronts.values():
            front.raise_()
        for panel in panels:
            if panel.on_demand:
                self[panel.name].hide()
        self._fronts = [(fronts[stack], stack.height) for stack in (UPPER, LOWER)]
        self.all = tuple(self._docks.values())
        self.side = tuple(self[panel.name] for panel in panels if panel.stack is not LEFT)

    def _add_dock(self, dock: QDockWidget, panel: Panel, fronts: dict[Stack, QDockWidget]) -> None:
        """Add a dock as a tab behind the front one of its stack, or as the front one."""
        dock.setObjectName(panel.name)
        dock.setAllowedAreas(_LEFT | _RIGHT)
        front = fronts.setdefault(panel.stack, dock)
        self._window.addDockWidget(panel.stack.area, dock)
        if front is not dock:
            self._window.tabifyDockWidget(front, dock)

    def __getitem__(self, name: str) -> Dock:
        return self._docks[name]

    def fill(self) -> None:
        """Build the panels of the start, and give each stack its share of the side."""
        for dock in self.all:
            if not isinstance(dock, LateDock):
                dock.fill()
        docks, heights = zip(*self._fronts, strict=True)
        self._window.resizeDocks(docks[:1], [_WIDTH], Qt.Orientation.Horizontal)
        self._window.resizeDocks(docks, heights, Qt.Orientation.Vertical)

    def set_scale(self, scale: float) -> None:
        """Enlarge panels and the headers of panes for a projector; the drawing keeps half of the width.

        At scale 1 the panels have the widths that they had before.
        """
        docks = [dock for dock in _in_front(self._window) if isinstance(dock, Dock)]
        if self._scale == 1.0:
            self._usual_widths = {dock: dock.width() for dock in docks}
        usual = self._usual_widths
        # Docks above one another have one width.
        wanted = {dock.x(): usual.get(dock, dock.width() / self._scale) * scale for dock in docks}
        least = dict.fromkeys(wanted, 0)
        for dock in docks:
            least[dock.x()] = max(least[dock.x()], dock.minimumSizeHint().width())
        self._scale = scale
        size = QApplication.font().pointSizeF() * scale
        # With a style sheet of the application, setFont does not reach the content.
        sheet = f"{_SCALED} {{ font-size: {size}pt; }}" if scale != 1.0 else ""
        if sheet != self._window.styleSheet():
            self._window.setStyleSheet(sheet)
        # Room of the window's other half beyond the least widths, for what is wanted beyond these.
        room = self._window.width() / 2 - _BORDER * len(wanted) - sum(least.values())
        more = {x: max(width - least[x], 0.0) for x, width in wanted.items()}
        share = min(1.0, max(room / (sum(more.values()) or 1.0), 0.0)) if scale > 1.0 else 1.0
        widths = [round(least[dock.x()] + share * more[dock.x()]) for dock in docks]
        self._window.resizeDocks(docks, widths, Qt.Orientation.Horizontal)


_BORDER = 5
"""Pixels between a dock and the drawing."""

_IN_DOCK = QSize(350, 96)
"""Largest minimum size of the content of a dock: two of them, one on the other, fit a small screen."""


class Dock(SafeOverrides, QDockWidget):
    """Dock that is empty until it is filled; `build` makes its content in the parent that it gets.

    Attributes
    ----------
    is_steady
        Whether the content keeps its width when the scroll bar appears.

    Signals
    -------
    closed
        The user has closed the dock.
    """

    closed = Signal()

    def __init__(self, title: str, build: Callable[[QWidget], QWidget], window: QMainWindow) -> None:
        super().__init__(title, window)
        self._build: Callable[[QWidget], QWidget] | None = build
        self._window = window
        self.is_steady = False
        # The docks that it covers, which are raised again when it closes.
        self._covered: list[QDockWidget] = []
        self.topLevelChanged.connect(self._raise_when_docked)
        # Qt's own slot would hide a dock that is behind another tab.
        self.toggleViewAction().triggered.disconnect()
        self.toggleViewAction().triggered.connect(self._toggle)

    def fill(self) -> None:
        """Build the title and the content, if there is none."""
        # A floating dock is shown, and would be filled, again as soon as it has a title.
        build, self._build = self._build, None
        if build is not None:
            self.setTitleBarWidget(DockTitle(self))
            self.setWidget(Scrolled(build, _IN_DOCK, self, is_steady=self.is_steady))

    def bring_up(self) -> None:
        """Show the dock in front of the other tabs."""
        if self.visibleRegion().isEmpty():
            docks = self._window.findChildren(QDockWidget)
            self._covered = [dock for dock in docks if not dock.visibleRegion().isEmpty()]
        self.show()
        self.raise_()

    def _toggle(self, checked: bool) -> None:
        """Bring the dock to the front of its tabs, or hide it where it is in front already."""
        is_behind = not self.isHidden() and self._window.isVisible() and self.visibleRegion().isEmpty()
        if checked or is_behind:
            self.toggleViewAction().setChecked(True)
            self.bring_up()
        else:
            self.close()

    def _raise_when_docked(self, floats: bool) -> None:
        """Come to the front of the tabs after being docked."""
        if not floats and not self.isHidden():
            # The tab exists only after the layout.
            QTimer.singleShot(0, self, self.raise_)

    def closeEvent(self, event: QCloseEvent) -> None:
        beside = [] if self.visibleRegion().isEmpty() else self._window.tabifiedDockWidgets(self)
        super().closeEvent(event)
        for dock in beside:
            if dock in self._covered and not dock.isHidden():
                dock.raise_()
        self._covered = []
        self.closed.emit()


class LateDock(Dock):
    """Dock whose content is built when it is first visible."""

    def __init__(self, title: str, build: Callable[[QWidget], QWidget], window: QMainWindow) -> None:
        super().__init__(title, build, window)
        self.visibilityChanged.connect(self._show_content)

    def _show_content(self, visible: bool) -> None:
        # A dock behind another tab counts as not visible.
        if visible:
            self.fill()


_FLOAT_TIP, _DOCK_TIP = "Float the panel as a separate window", "Dock in the window"


class DockTitle(FollowsTheme, QWidget):
    """Title bar with the buttons Float and Close; a drag elsewhere moves the dock.

    Attributes
    ----------
    float_button, close_button
        The buttons; the first is down while the dock floats.
    """

    def __init__(self, dock: QDockWidget) -> None:
        super().__init__(dock)
        self._dock = dock
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        name, title = dock.objectName(), dock.windowTitle()
        self.float_button = tool_button(
            f"{name}Float", f"Float {title}", _FLOAT_TIP, icon_size=ICON, flat=True
        )
        self.close_button = tool_button(
            f"{name}Close", f"Close {title}", "Close; use View › Panels to reopen", icon_size=ICON, flat=True
        )
        self.float_button.setCheckable(True)
        self.float_button.clicked.connect(lambda: dock.setFloating(not dock.isFloating()))
        self.close_button.clicked.connect(dock.close)
        dock.topLevelChanged.connect(self._show_floating)
        # The text shrinks last where room is short. The layout has a minimum width of 80 then,
        # because Qt asks hundreds of times whenever docks are laid out.
        self._words = words = Label(title)
        words.setMinimumWidth(9)
        dock.windowTitleChanged.connect(self._show_title)
        buttons = self.float_button, self.close_button
        row_of((words, 1), *buttons, margins=(10, 1, 3, 1), spacing=2, parent=self)
        self.follow_theme()
        self._show_floating(dock.isFloating())

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.close_button.setIcon(icon("close", theme))
        self._show_icon()

    def _show_title(self, title: str) -> None:
        self._words.setText(title)
        for button in (self.float_button, self.close_button):
            button.setAccessibleName(f"{button.accessibleName().partition(' ')[0]} {title}")

    def _show_floating(self, floats: bool) -> None:
        button, (verb, tip) = self.float_button, ("Dock", _DOCK_TIP) if floats else ("Float", _FLOAT_TIP)
        button.setChecked(floats)
        button.setToolTip(tip)
        button.setAccessibleName(f"{verb} {button.accessibleName().partition(' ')[2]}")
        self._show_icon()

    def _show_icon(self) -> None:
        self.float_button.setIcon(icon("dock" if self._dock.isFloating() else "float", self.theme))


_HAS_ROOM = "hasRoom"
"""Property of a dock that was enlarged."""

_DIRECT = Qt.FindChildOption.FindDirectChildrenOnly

_MOVED = 2
"""Tolerance in pixels for a border that was not moved."""

_LEAST_ABOVE = 150
"""Height of the upper dock that remains, in pixels."""


def make_room(window: QMainWindow, dock: Dock, height: int) -> None:
    """Enlarge an opened dock to the height of its content, up to `height`, until it is closed.

    The room comes from the upper dock; the width stays. A border that the user has moved since stays.
    """
    if dock.property(_HAS_ROOM) or dock.isFloating():
        return
    dock.setProperty(_HAS_ROOM, True)
    # The height is known only after the layout.
    QTimer.singleShot(0, dock, lambda: _make_room(window, dock, height))


def hide_idle_docks(window: QMainWindow) -> None:
    """Hide the docks without content, which are disabled, after a layout was restored."""
    for dock in window.findChildren(QDockWidget):
        if not dock.isEnabled():
            dock.hide()


def _make_room(window: QMainWindow, dock: Dock, height: int) -> None:
    above = next((other for other in _in_front(window) if _is_above(other, dock)), None)
    missing = _needed(dock, height) - dock.height()
    given = min(missing, above.height() - _LEAST_ABOVE) if above is not None else 0
    if above is None or given <= 0:
        return
    border = above.height() - given
    _divide(window, (above, border), (dock, dock.height() + given))

    def give_back() -> None:
        dock.setProperty(_HAS_ROOM, False)
        # The covered dock is visible again and has its size.
        left = next((other for other in _in_front(window) if _is_above(above, other)), None)
        if left is not None and abs(above.height() - border) <= _MOVED:
            _divide(window, (above, above.height() + given), (left, left.height() - given))

    dock.closed.connect(lambda: QTimer.singleShot(0, dock, give_back), Qt.ConnectionType.SingleShotConnection)


def _divide(window: QMainWindow, *heights: tuple[QDockWidget, int]) -> None:
    """Give the docks of one side these heights."""
    # Qt divides the side in this proportion, including the tabs of each dock.
    tabs = max(
        (bar.height() for bar in window.findChildren(QTabBar, options=_DIRECT) if bar.isVisible()), default=0
    )
    docks = [dock for dock, _ in heights]
    with_tabs = [height + (tabs if window.tabifiedDockWidgets(dock) else 0) for dock, height in heights]
    window.resizeDocks(docks, with_tabs, Qt.Orientation.Vertical)


def _needed(dock: Dock, height: int) -> int:
    """Return the height at which a dock needs no scroll bar, at most `height`."""
    area = dock.widget()
    if not isinstance(area, Scrolled):
        return height
    content: QWidget = area.content
    return min(height, dock.height() - area.viewport().height() + content.sizeHint().height())


def _in_front(window: QMainWindow) -> list[QDockWidget]:
    """Return the visible docks at the sides."""
    docks = window.findChildren(QDockWidget)
    return [dock for dock in docks if not dock.isFloating() and not dock.visibleRegion().isEmpty()]


def _is_above(other: QDockWidget, dock: QDockWidget) -> bool:
    """Return whether `other` is above `dock` at the same side."""
    return other.x() == dock.x() and other.y() < dock.y()
