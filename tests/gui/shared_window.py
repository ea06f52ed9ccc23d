"""A window that is used again as long as nothing about it differs from a new one.

Building a window takes longer than most of the questions put to it. So the one that a test leaves is
reset, and the next test gets it if all that can be told of it is what was told of it when it was new;
otherwise it is thrown away. A test that makes windows of its own begins without it.

Some parts of a window are made when they are first asked for: docks, bars, the stage of a motion. Such a part
may be there already, put away, as it is in a window in which a person has opened and closed everything.

It is painted from the call of a test on, not while it is reset and fixtures prepare it: a test that asks what
was drawn settles first.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import msgspec
import pytest
from fingerprint import Fingerprint, differences, forget, named_actions
from PySide6.QtCore import QCoreApplication, QEvent, QObject, QSettings
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QDockWidget, QMenu, QToolButton, QWidget
from shiboken6 import isValid

from app.features.help.commands import HelpCommands
from app.features.hodograph.commands import HodographCommands
from app.features.import_export.commands import ImportCommands
from app.features.laboratory.commands import LaboratoryCommands
from app.features.motion.commands import MotionCommands
from app.features.plots.commands import USUAL_HEIGHT
from app.features.recovery.commands import RecoveryCommands
from app.features.style.commands import StyleCommands
from app.features.view.zoom import ZoomCommands
from app.features.wiggle.commands import WiggleCommands
from app.testing import Editor
from app.view_model.motion_settings import MotionSettings
from app.window.window_commands import ProgramCommands
from app.workbench.docks import LateDock

_A_PLOT = "plotCurvature"


class SharedEditor:
    """The editor whose window is used again."""

    def __init__(self) -> None:
        self._editor: Editor | None = None
        # What is told of a window in which everything was opened and closed; found out once for each kind.
        self._opened: dict[str, Mapping[str, object]] = {}
        self._kind = "usual"
        self._goes_on = False

    def get(self, qtbot) -> Editor:
        if self._kind not in self._opened:
            self._build(qtbot)
            open_everything(self._editor)
            self._reset()
            self._opened[self._kind] = self._painted()
            self.drop()
        if self._editor is None:
            self._build(qtbot)
            self._reset()
            self._new = self._last = self._painted()
        if QApplication.activeWindow() is not self._editor.window:
            # Tests in between had windows of their own.
            self._editor.window.activateWindow()
            self._editor.window.canvas.setFocus()
            self._editor.settle()
        return self._editor

    def _build(self, qtbot) -> None:
        self._editor = Editor(_Keeper(qtbot))
        window = self._editor.window
        # tests/leak_check.py looks for windows that are left over.
        window.setProperty("isKept", True)
        self._curtain = Curtain(window)
        window.preferences.file._settings.installEventFilter(Unwritten(window))
        self._snapping = window.canvas.tools.snapping.settings
        self._sketch, self._views = self._editor.session.document, tuple(self._editor.session.views)
        self._docks = window.findChildren(QDockWidget)
        self._in_front = [dock for dock in self._docks if is_in_front(dock)]
        files = window.context.files
        self._elsewhere = window.commands.drops.open_window, files.open_window, files.show_elsewhere
        self._size = window.size()
        # As it is when it is new, and as it is when that was restored.
        self._states, self._splitter = [window.saveState()], window.splitter.saveState()
        self._checkable = [action for action in named_actions(window) if action.isCheckable()]
        self._checked = {action for action in self._checkable if action.isChecked()}

    def take_back(self) -> list[str]:
        """Reset the window; throw it away where that fails or leaves it different, and return where it is.

        Where worker processes run the tests, it is looked at behind the last test of a file, for all of them,
        and behind one that fails. A run of one process, as of one file, looks behind each and names the test.
        """
        window = self._editor.window
        places: list[str] = []
        try:
            self._reset()
            different = {} if self._goes_on else self.differences()
            if any(".panes." in place for place in different):
                # What a pane has is told it when it is shown.
                self._curtain.open()
                self._editor.trigger(_A_PLOT)
                self._reset()
                different = self.differences()
            places += different
            if QApplication.activeWindow() is not window:
                places.append("active window")
        except Exception as caught:
            # Whatever a test has done to it.
            places.append(repr(caught))
        if places:
            self.drop()
        return places

    def differences(self) -> dict[str, object]:
        """Return what is told of the window, and neither of a new one nor of one that was used and reset."""
        # Most of the time nothing has been opened since the last test.
        told, known = Fingerprint(self._editor.window).told, (self._last, self._new, self._opened[self._kind])
        found = differences(told, *known)
        if found:
            # Some of it may be what was drawn last.
            told = self._painted()
            found = differences(told, *known)
        if not found:
            self._last = told
        return found

    def _painted(self) -> Mapping[str, object]:
        """Paint the window as it is, and return what is told of it then."""
        self._curtain.open()
        self._editor.settle()
        self._curtain.close()
        return Fingerprint(self._editor.window).told

    def _reset(self) -> None:
        editor, window, session = self._editor, self._editor.window, self._editor.session
        zoom = window.commands[ZoomCommands]
        # Nobody looks at it before the next test begins.
        self._curtain.close()
        self._put_away()
        # Before the actions: what they do to some other document may take long.
        session.history.clock = time.monotonic
        # With what was computed for it before.
        session.files.replace(self._sketch, None, views=self._views)
        fading = window.canvas.drawing.curve._fade
        fading.setCurrentTime(fading.duration())
        self._reset_actions()
        self._reset_settings()
        self._reset_drawing()
        self._reset_layout()
        session.selected.is_implicit, session.selected.next_style = False, None
        window.commands.messages.greet()
        # Again, below the message that has come by now.
        window.canvas.framing.fit()
        window.commands.wake()
        window.activateWindow()
        # Not as one who came by the keyboard.
        window.canvas.clearFocus()
        window.canvas.setFocus()
        editor.settle()
        window.status_line.reset()
        if zoom.field._soon.isActive():
            zoom.field._write()
        zoom._past.forget()
        for plot in window.central.plots:
            # Found out when it is first asked for.
            _ = plot.pixel_map

    def _put_away(self) -> None:
        """End what is going on, and close what lies over the window."""
        window = self._editor.window
        for widget in filter(QWidget.isVisible, QApplication.topLevelWidgets()):
            if widget is not window:
                widget.close()
        program, laboratory = window.commands[ProgramCommands], window.commands[LaboratoryCommands]
        for sheet in (program._palette, window.commands[HelpCommands]._sheet):
            if sheet is not None:
                sheet.hide()
        for pages in (laboratory._panel, program._dialog and program._dialog.tabs):
            if pages is not None:
                # Whoever shows it again would see the page that was seen last.
                pages.setCurrentIndex(0)
        window.context.work.jobs.give_up()
        window.commands[ImportCommands]._opened = None
        wiggle = window.commands[WiggleCommands]
        wiggle._task.give_up()
        wiggle._has_scrub = False
        # The program that a test has made, and that has ended, knew of other windows.
        files = window.context.files
        window.commands.drops.open_window, files.open_window, files.show_elsewhere = self._elsewhere
        # What a menu or the palette has found out of the curve of the sketch, which comes again.
        window.actions_by_name._opened_of = None
        # Where a menu was opened; it goes with the next movement over the canvas.
        window.canvas._menu_pointer = None
        for plot in window.central.plots:
            # Of a press of the right button that took a gesture back, in a test that opens no menu.
            plot._menu_refused = False
            # As a dialog that takes the mouse away, then as a hand that leaves.
            for event in (QEvent.Type.WindowBlocked, QEvent.Type.Leave):
                QApplication.sendEvent(plot, QEvent(event))
            QApplication.sendEvent(plot.viewport(), QEvent(QEvent.Type.Leave))
        self._editor.session.interrupt()
        if window.actions_by_name["stopMotion"].isEnabled():
            window.actions_by_name["stopMotion"].trigger()
        stage = window.commands[MotionCommands]._stage
        if stage is not None and stage.export._dialog is not None:
            # It goes on offering the numbers of the last film otherwise.
            stage.export._dialog.deleteLater()
            stage.export._dialog = None
        window.analysis.reset()
        self._keep_without_autosave()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def _keep_without_autosave(self) -> None:
        """Let a new window's work be kept by nobody, where a test has had it kept and has ended that."""
        recovery = self._editor.window.commands[RecoveryCommands]
        recovery.leave()
        if recovery._autosave is not None and recovery._autosave._is_closed:
            recovery._set_aside.leave()
            recovery._set_aside.deleteLater()
            recovery._autosave = recovery._open_beside = recovery._set_aside = None

    def _reset_actions(self) -> None:
        # Those to check before those to uncheck: of exclusive ones the first unchecks the others.
        for action in sorted(self._checkable, key=QAction.isChecked):
            if QAction.isChecked(action) != (action in self._checked):
                action.trigger()

    def _reset_settings(self) -> None:
        settings: QSettings = self._editor.window.preferences.file._settings
        if settings.allKeys():
            # Before the rest: they are remembered at once.
            keymap = self._editor.window.context.actions.keymap
            if keymap.overrides:
                keymap.reset_all()
            settings.clear()
            self._editor.window.store.read_preferences()
            # It goes on offering the colours that were used last otherwise.
            self._editor.window.commands[StyleCommands]._render()
            # It goes on naming the files of its last opening otherwise.
            self._editor.window.menus.recent.aboutToShow.emit()

    def _reset_drawing(self) -> None:
        """Take back what is neither a setting nor shown by an action that is checked."""
        window = self._editor.window
        if window.store.state.scale != 1.0:
            window.actions_by_name["usualSize"].trigger()
        # As they follow from settings and document, where a test has changed them itself.
        window.canvas.tools.snapping.settings = self._snapping
        if window.canvas.drawing.grid._fixed != self._sketch.grid_spacing:
            window.canvas.drawing.grid.set_spacing(self._sketch.grid_spacing)
        window.central["plotPanel"].last_height = USUAL_HEIGHT
        if (hodograph := window.commands[HodographCommands]._panel) is not None:
            # Fitted to whatever comes, too.
            hodograph.findChild(QToolButton, "hodographVelocity").click()
        if (stage := window.commands[MotionCommands]._stage) is not None:
            stage.player.change(**msgspec.structs.asdict(MotionSettings()))
            stage.player.clock = time.perf_counter

    def _reset_layout(self) -> None:
        window = self._editor.window
        for dock in self._docks:
            # Once opened it has had the room that it asks for.
            if dock.property("hasRoom"):
                dock.setProperty("hasRoom", None)
        if window.size() != self._size:
            window.resize(self._size)
        for dock in self._in_front:
            if not is_in_front(dock):
                # To restore the state takes ten times as long, and often nothing else differs.
                dock.raise_()
        # The state has the least heights of docks, and what is in them has just been taken back.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)
        if window.saveState() not in self._states:
            window.restoreState(self._states[0])
            self._states.append(window.saveState())
        if window.splitter.saveState() != self._splitter:
            window.splitter.restoreState(self._splitter)
        # The view is fitted to the place that is there.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item, nextitem):
        """Note whether another test of the same file comes next, in a worker process."""
        self._goes_on = (
            hasattr(item.config, "workerinput")
            and nextitem is not None
            and nextitem.path == item.path
            and "editor" in nextitem.fixturenames
        )
        return (yield)

    def pytest_runtest_makereport(self, call) -> None:
        """Have the window looked at behind a test that fails."""
        if call.excinfo is not None:
            self._goes_on = False

    def pytest_runtest_setup(self, item) -> None:
        """Begin a test that makes windows of its own without the one that is kept."""
        if "editor" not in item.fixturenames and "qapp" in item.fixturenames:
            self.drop()

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_call(self, item) -> None:
        """Have the window painted from now on: what fixtures prepared is not painted step by step."""
        if self._editor is not None and "editor" in item.fixturenames:
            self._curtain.open()

    @contextmanager
    def another(self, kind: str) -> Iterator[None]:
        """Keep another window for a while: one of a kind that is made with other records."""
        before, self._kind = self._kind, kind
        self.drop()
        yield
        self.drop()
        self._kind = before

    def drop(self) -> None:
        if self._editor is not None:
            window, self._editor = self._editor.window, None
            # One that a test has closed may be gone.
            if isValid(window):
                window.asks_before_closing = False
                window.close()
                window.deleteLater()
            forget()


def is_in_front(dock: QDockWidget) -> bool:
    return not dock.visibleRegion().isEmpty()


class Curtain(QObject):
    """What keeps a window from being painted while nobody looks.

    Updates are not disabled: Qt would paint all of the window twice when they are enabled again.
    """

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._window = window

    def close(self) -> None:
        self._window.installEventFilter(self)

    def open(self) -> None:
        """Let the window be painted, by whoever lets Qt deliver what is pending."""
        self._window.removeEventFilter(self)
        # Qt asks for no paint while a part is marked for one that it has asked for.
        QCoreApplication.postEvent(self._window, QEvent(QEvent.Type.UpdateRequest))

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        return event.type() == QEvent.Type.UpdateRequest


class Unwritten(QObject):
    """What keeps settings from being written to the disk at each change: that waits for the disk four times.

    Other objects of settings with the same file see the changes at once; `sync` writes as ever.
    """

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        return event.type() == QEvent.Type.UpdateRequest


class _Keeper:
    """What an Editor needs of qtbot, for a window that outlives its test."""

    def __init__(self, qtbot) -> None:
        self.waitExposed = qtbot.waitExposed

    def addWidget(self, widget, *, before_close_func=None) -> None:
        pass


def open_everything(editor: Editor) -> None:
    """Have all parts of the window made that are made when they are first wanted."""
    window = editor.window
    for dock in window.findChildren(LateDock):
        dock.show()
        dock.raise_()
        editor.settle()
        dock.close()
    for menu in window.menuBar().findChildren(QMenu):
        menu.aboutToShow.emit()
    # An overlay has a legend; whether what is computed beside the window is in time to have one is luck.
    for name in ("playMotion", _A_PLOT, "overlayVelocities"):
        editor.trigger(name)
        editor.trigger({"playMotion": "stopMotion"}.get(name, name))
