"""Context of command sets: the parts of a window, the hooks by which sets take part in it, context menus."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMainWindow, QMenu, QToolBar

from ..actions.menus import ActionBar
from ..actions.qactions import Actions
from ..plotting.tool_plot import ToolPlot
from ..session import Session
from ..settings.preferences import Preferences
from ..state.window_state import Analysis, WindowStore
from ..widgets.controls import menu_with_tips
from .central_area import CentralArea
from .docks import Docks
from .document_files import DocumentFiles
from .file_work import FileWork
from .status_line import StatusLine


class WindowContext(msgspec.Struct, frozen=True):
    """Parts of a window that its commands act on; each command set gets one.

    A command set is a class with decorated methods, ``def __init__(self, context: WindowContext)``; it keeps
    the parts that it uses. `CommandSet` is one that keeps the context and the session.

    Attributes
    ----------
    session, store, preferences
        The document; the state of the window; the settings saved between starts.
    analysis
        Overlays, plots and laboratory, which are a part of the window's state.
    actions
        All actions of the window.
    files, work
        Opening and saving; background work.
    window, central, docks, toolbar, status_line
        The window and its parts.
    """

    session: Session
    store: WindowStore
    preferences: Preferences
    analysis: Analysis
    actions: Actions
    files: DocumentFiles
    work: FileWork
    window: QMainWindow
    central: CentralArea
    docks: Docks
    toolbar: QToolBar
    status_line: StatusLine

    def cancel_gesture(self) -> bool:
        """Cancel the gesture in flight; return whether there was one."""
        return self.central.cancel_gesture() or (self.session.is_previewing and self.session.interrupt())

    def connect_plot(self, plot: ToolPlot) -> None:
        """Show the hints and progress of a plot in the status line, and keep the hint up to date.

        What a press would do changes with every step, also under a pointer that rests.
        """
        session, line = self.session, self.status_line
        plot.hint_changed.connect(line.show_hint)
        plot.progress_changed.connect(line.show_progress)
        plot.gesture_began.connect(line.clear_earlier)
        session.gesture_ended.connect(plot.abandon_gesture)
        for changed in (session.history_changed, session.active_changed):
            changed.connect(plot.hover_soon)


class CommandSet:
    """Base of command sets that act on the session and need nothing set up."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session


def hooks(command_sets: Iterable[object], name: str) -> list[Callable[..., object]]:
    """Return the methods called `name` of the command sets that have one.

    A command set takes part in its window by these methods:

    ``follow_drag(view)``
        Show what belongs to the curve, in every frame of a drag. Returns whether there is anything to show:
        where there is nothing, the method is not called again during the drag, until a switch, a panel, the
        scrub line or more than points has changed.
    ``render_panel(view)``
        Show the curve in a panel, after each step, and at most every 100 ms during a drag.
    ``show_document()``
        Show what a document has besides its curves, after changes of more than points of the active curve.
    ``set_theme(theme)``
        Use the colours of the theme.
    ``close()``
        End what has to end before the window is destroyed.
    ``escape()``
        Step back, where nothing else has used Escape. Returns whether it has used the key.
    ``import_files(paths)``
        Import the files of a drop.
    ``holds_drawing(data)``, ``paste_dropped(data, position)``
        Whether dropped data without a file contain a drawing; add it to the document.
    """
    return [getattr(commands, name) for commands in command_sets if hasattr(commands, name)]


def bar_menu(
    context: WindowContext, bar: ActionBar, name: str = "contextMenu", *, is_short: bool = False
) -> QMenu:
    """Return a context menu with the actions of `bar`; it is deleted when it is closed.

    With `is_short`, the menu and its submenus have only enabled actions.
    """
    menu = menu_with_tips(name, context.window)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    submenus: dict[str, QMenu] = {}
    for group in context.actions.with_sections(bar).values():
        menu.addSeparator()
        for entry in group:
            if isinstance(entry, QAction):
                menu.addActions(_offered([entry], is_short=is_short))
            elif actions := _offered(context.actions.in_section(entry), is_short=is_short):
                if entry.called not in submenus:
                    submenus[entry.called] = menu.addMenu(entry.called)
                    submenus[entry.called].setToolTipsVisible(True)
                submenus[entry.called].addSeparator()
                submenus[entry.called].addActions(actions)
    return menu


def _offered(actions: Sequence[QAction], *, is_short: bool) -> list[QAction]:
    return [action for action in actions if action.isEnabled() or not is_short]
