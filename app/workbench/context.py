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
from .central_area import CentralArea
from .docks import Docks
from .document_files import DocumentFiles
from .file_work import FileWork
from .status_line import StatusLine


class WindowContext(msgspec.Struct, frozen=True):
    """Parts of a window that its commands act on.

    Attributes
    ----------
    session, store, preferences
        The document; the window's state; what is remembered between starts.
    analysis
        Overlays, plots and laboratory, which are a part of the window's state.
    actions
        All actions of the window.
    files, work
        Opening and saving; what is read and written beside the window.
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
        """Drop the gesture in flight; return whether there was one."""
        return self.central.cancel_gesture() or (self.session.is_previewing and self.session.interrupt())

    def connect_plot(self, plot: ToolPlot) -> None:
        """Let the status line say what the mouse does on a plot, and keep that true.

        What a press would do changes with every step, also under a pointer that rests.
        """
        session, line = self.session, self.status_line
        plot.hint_changed.connect(line.show_hint)
        plot.progress_changed.connect(line.show_progress)
        plot.gesture_began.connect(line.begin_gesture)
        session.interrupted.connect(plot.abandon_gesture)
        for changed in (session.history_changed, session.active_changed):
            changed.connect(plot.hover_soon)


def hooks(command_sets: Iterable[object], name: str) -> list[Callable[..., object]]:
    """Return the methods of this name of the command sets that have one.

    ``follow(view)`` shows what belongs to a curve, for every preview, and returns whether there is anything
    to show: who has nothing is not asked again under a drag, until a switch, a panel, the scrub line or more
    than points has changed. ``render(view)`` does so at the pace of the panels. ``show_document()`` shows
    what a document has beside its curves, whenever more than points of the edited one has changed.
    ``set_theme(theme)`` takes colours, ``close()`` ends what has to end before the window goes, ``escape()``
    steps back where nothing else takes the key, and returns whether no other one shall.
    ``import_files(paths)`` takes what was dropped, ``paste_dropped(data, place)`` what is no file and of
    which ``holds_drawing(data)`` says yes.
    """
    return [getattr(each, name) for each in command_sets if hasattr(each, name)]


def bar_menu(
    context: WindowContext, bar: ActionBar, name: str = "contextMenu", *, is_short: bool = False
) -> QMenu:
    """Return a menu with the actions of `bar`, which goes when it is closed.

    One that `is_short` has those alone that can be done now; so do its submenus.
    """
    menu = QMenu(context.window)
    menu.setObjectName(name)
    menu.setToolTipsVisible(True)
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
    return [each for each in actions if each.isEnabled() or not is_short]
