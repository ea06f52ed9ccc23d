"""A window that is used again as long as nothing about it differs from a new one.

Building a window takes longer than most of the questions put to it. So the one that a test leaves is
reset, and the next test gets it if all that can be told of it is what was told of it when it was new;
otherwise it is thrown away. A test that makes windows of its own begins without it.

Some parts of a window are made when they are first asked for: docks, bars, the stage of a motion. Such a part
may be there already, put away, as it is in a window in which a person has opened and closed everything.
"""

from __future__ import annotations

import enum
import sys
import time
from collections.abc import Mapping
from pathlib import PurePath
from types import BuiltinFunctionType, FunctionType, MethodType

import msgspec
from PySide6.QtCore import QCoreApplication, QEvent, QSettings
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QApplication, QDockWidget, QLabel, QMenu, QWidget

from app.examples import first_sketch
from app.panels.command_palette import CommandPalette
from app.panels.late_dock import LateDock
from app.panels.plot_panel import USUAL_HEIGHT
from app.panels.shortcut_sheet import ShortcutSheet
from app.testing import Editor
from app.view_model.motion import MotionSettings

_FUNCTIONS = (FunctionType, BuiltinFunctionType, MethodType)
"""What tests replace: a clock, a question to the person."""

_PLAIN = (bool, int, float, str, bytes, type(None), enum.Enum, PurePath)

_ABSENT = object()

_LIBRARIES = {*sys.stdlib_module_names, "curvecore", "numpy", "pyqtgraph", "PySide6", "shiboken6", "Shiboken"}

PASSING = {
    # What was drawn last, and what is kept so that it need not be made again.
    *(
        "_asked",
        "_costed",
        "_cost",
        "_discs_asked",
        "_dressed",
        "_drawn",
        "_extents",
        "_ghost",
        "_ghost_drawn",
    ),
    *("_frozen", "_ghost_stroke", "_is_resting", "_italic", "_known", "_made", "_made_for", "_origin"),
    *("_painted", "_pause", "_pens", "_pixels_of", "_room", "_upright"),
    *("_seconds", "_stamps", "_stroke", "_strokes", "_watcher", "__dict__", "FunctionLines._shown"),
    *("DiskCommands._shown", "MotionStage._courses", "MotionStage._rivals", "MotionStage._rivals_of"),
    *("MotionStage._scales", "PlotCommands._own", "PlotCommands._plotted", "PlotCommands._was_calm"),
    *("TickEdit._knot", "TraceLayer._lines", "WiggleCommands._cures"),
    # Where the pointer was last, before it left, and with which button.
    *("_hand", "_last", "_menu_refused", "_modal", "_place_now", "_pointer", "_button", "Scrolling._zooms"),
    *(
        "CanvasTool.grid",
        "Choosing.entered",
        "Magnets._hovered",
        "RailTool._function",
        "RailTool._scrubbing_from",
    ),
    # Where a motion was stopped, what a panel showed that is closed; both begin anew.
    *("LessonPanel._step", "Player._course", "Player._ran_on", "Player._scrub_before", "Player.seconds"),
    *("ViewCommands._before_folding", "ViewCommands._before_presentation"),
    # How often something has happened.
    *("_documents", "_meant_for"),
    # What belongs to a document that is open no more, by the place where it began.
    *("LessonCommands._visits", "LessonCommands._given"),
}
"""Names of attributes that may differ, some of one class only."""

RENDERED_ANEW = {
    *("CommandPalette", "DigitsTable", "FileBar", "JobBar", "Legend", "MotionBar", "MotionDialog"),
    *("PlotPane", "PreferencesDialog", "RecoveryBar", "ShortcutSheet", "WeightBars"),
}
"""Widgets that are made when they are first wanted, and filled whenever they are shown."""


class _Kind:
    """How objects of a type are told.

    Attributes
    ----------
    names
        The attributes that all objects of the type have; None for objects that are not ours.
    """

    def __init__(self, kind: type) -> None:
        self.is_plain = issubclass(kind, _PLAIN)
        self.is_function = issubclass(kind, _FUNCTIONS)
        self.is_set = issubclass(kind, set | frozenset)
        self.is_dict = issubclass(kind, dict)
        self.is_list = issubclass(kind, list | tuple)
        self.is_rendered_anew = kind.__name__ in RENDERED_ANEW
        package = kind.__module__.partition(".")[0]
        self.is_ours, self.is_of_tests = package == "app", package not in _LIBRARIES
        names = set(kind.__struct_fields__ if issubclass(kind, msgspec.Struct) else ())
        for base in kind.__mro__:
            slots = vars(base).get("__slots__", ())
            names.update((slots,) if isinstance(slots, str) else slots)
        self.name, self.type = kind.__name__, kind
        self.passing = {name.removeprefix(f"{kind.__name__}.") for name in PASSING}
        self.names = sorted(names - self.passing)


class Fingerprint:
    """What can be told of a window: the plain values of all objects of ours that it reaches, and its widgets.

    Attributes
    ----------
    told
        What was found, by where it was found.
    """

    _kinds: dict[type, _Kind] = {}  # noqa: RUF012 - of all fingerprints: types do not change

    def __init__(self, window: QWidget) -> None:
        self.told: dict[str, object] = {}
        # Objects, not their ids alone: an id is free for another one as soon as its owner has gone.
        self._seen: dict[int, object] = {}
        self._window = window
        self._walk("window", window)
        for action in named_actions(window):
            self.told[f"action {action.objectName()}"] = (
                action.isChecked(),
                action.isEnabled(),
                action.isVisible(),
                # The letters that are underlined are given out when a menu opens.
                action.text().replace("&", ""),
                action.shortcut().toString(),
            )
        for dock in window.findChildren(QDockWidget):
            self.told[f"dock {dock.objectName()}"] = bool(dock.property("hadRoom"))
        for widget in window.findChildren(QWidget):
            name = widget.objectName()
            # What is out of sight is told what to say before it is shown.
            if name and not name.startswith(("qt_", "_q_")) and widget.isVisibleTo(window):
                self.told[f"widget {name}"] = self._told_of(widget)

    def _walk(self, place: str, value: object) -> None:
        kind = self._kinds.get(type(value))
        if kind is None:
            kind = self._kinds[type(value)] = _Kind(type(value))
        if kind.is_plain:
            self.told[place] = value
        elif kind.is_function:
            self.told[place] = value.__qualname__
        elif kind.is_set:
            self.told[place] = len(value)
        elif id(value) not in self._seen:
            self._seen[id(value)] = value
            if kind.is_dict:
                self.told[f"{place}.count"] = len(value)
                for key, each in value.items():
                    if isinstance(key, _PLAIN):
                        self._walk(f"{place}.{key}", each)
            elif kind.is_list:
                self.told[f"{place}.count"] = len(value)
                for index, each in enumerate(value):
                    self._walk(f"{place}.{index}", each)
            elif kind.is_ours:
                self._walk_ours(place, value, kind)
            elif kind.is_of_tests:
                # In place of something of ours, or of the library's: a clock, for one.
                self.told[place] = kind.name

    def _walk_ours(self, place: str, value: object, kind: _Kind) -> None:
        if kind.is_rendered_anew and not value.isVisibleTo(self._window):
            # As if it were not there yet.
            self.told[place] = None
            return
        self.told[f"{place}.type"] = kind.name
        passing = kind.passing
        for name in kind.names:
            self._walk(f"{place}.{name}", getattr(value, name, None))
        for name, each in getattr(value, "__dict__", {}).items():
            # What the class says of all is not told of each.
            if name not in passing and each is not getattr(kind.type, name, _ABSENT):
                self._walk(f"{place}.{name}", each)

    @staticmethod
    def _told_of(widget: QWidget) -> tuple[object, ...]:
        text = widget.text() if isinstance(widget, QLabel | QAbstractButton) else ""
        return widget.isEnabled(), text, widget.toolTip()


def named_actions(window: QWidget) -> list[QAction]:
    return [
        action
        for action in window.findChildren(QAction)
        if (name := action.objectName()) and not name.startswith("_q_")
    ]


def differences(told: Mapping[str, object], *known: Mapping[str, object]) -> dict[str, object]:
    """Return what is in none of the `known` fingerprints as it is in `told`, by its place."""
    places = set(told).union(*known)
    return {
        place: told.get(place, _ABSENT)
        for place in places
        if all(told.get(place, _ABSENT) != each.get(place, _ABSENT) for each in known)
    }


class KeptEditor:
    """The editor whose window is used again."""

    def __init__(self) -> None:
        self._editor: Editor | None = None
        # What is told of a window in which everything was opened and closed; found out once.
        self._opened: Mapping[str, object] | None = None

    def get(self, qtbot) -> Editor:
        if self._opened is None:
            self._build(qtbot)
            open_everything(self._editor)
            self._reset()
            self._opened = Fingerprint(self._editor.window).told
            self.drop()
        if self._editor is None:
            self._build(qtbot)
            self._reset()
            self._new = Fingerprint(self._editor.window).told
        return self._editor

    def _build(self, qtbot) -> None:
        self._editor = Editor(_Keeper(qtbot))
        window = self._editor.window
        # tests/conftest.py looks for windows that are left over.
        window.setProperty("isKept", True)
        self._size = window.size()
        self._state, self._splitter = window.saveState(), window.splitter.saveState()
        self._checkable = [action for action in named_actions(window) if action.isCheckable()]
        self._checked = {action for action in self._checkable if action.isChecked()}

    def take_back(self) -> None:
        """Reset the window; throw it away where that fails or leaves it different."""
        window = self._editor.window
        try:
            self._reset()
            different = self.differences()
            is_as_new = not different and QApplication.activeWindow() is window
        except Exception:
            # Whatever a test has done to it.
            is_as_new = False
        if not is_as_new:
            self.drop()

    def differences(self) -> dict[str, object]:
        """Return what is told of the window, and neither of a new one nor of one that was used and reset."""
        return differences(Fingerprint(self._editor.window).told, self._new, self._opened)

    def _reset(self) -> None:
        editor, window, session = self._editor, self._editor.window, self._editor.session
        self._put_away()
        # Before the actions: what they do to some other document may take long.
        session.clock = time.monotonic
        session.restore(first_sketch(), None)
        session.undo_stack.setClean()
        fading = window.canvas._curve_layer._fade
        fading.setCurrentTime(fading.duration())
        self._reset_actions()
        self._reset_settings()
        self._reset_drawing()
        self._reset_layout()
        window._commands.messages.greet()
        window.actions_by_name["fitView"].trigger()
        window.activateWindow()
        # Not as one who came by the keyboard.
        window.canvas.clearFocus()
        window.canvas.setFocus()
        editor.settle()
        window.status_line.forget()

    def _put_away(self) -> None:
        """End what is going on, and close what lies over the window."""
        window = self._editor.window
        for widget in QApplication.topLevelWidgets():
            if widget is not window and widget.isVisible():
                widget.close()
        for sheet in (*window.findChildren(ShortcutSheet), *window.findChildren(CommandPalette)):
            sheet.hide()
        window.jobs.give_up()
        for plot in (window.canvas, window.basis_panel):
            # As a dialog that takes the mouse away, then as a hand that leaves.
            for event in (QEvent.Type.WindowBlocked, QEvent.Type.Leave):
                QApplication.sendEvent(plot, QEvent(event))
            QApplication.sendEvent(plot.viewport(), QEvent(QEvent.Type.Leave))
        self._editor.session.interrupt()
        if window.actions_by_name["stopMotion"].isEnabled():
            window.actions_by_name["stopMotion"].trigger()
        window.analysis.reset()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def _reset_actions(self) -> None:
        # Those to check before those to uncheck: of exclusive ones the first unchecks the others.
        for action in sorted(self._checkable, key=lambda each: each.isChecked()):
            if action.isChecked() != (action in self._checked):
                action.trigger()

    def _reset_settings(self) -> None:
        settings: QSettings = self._editor.window.preferences.file._settings
        if settings.allKeys():
            settings.clear()
            self._editor.window.apply_preferences()

    def _reset_drawing(self) -> None:
        """Take back what is neither a setting nor shown by an action that is checked."""
        window = self._editor.window
        if window._commands.view._scale != 1.0:
            window.actions_by_name["usualSize"].trigger()
        window.plot_panel.kept_height = USUAL_HEIGHT
        if (stage := window._commands.motion._stage) is not None:
            stage.player.change(**msgspec.structs.asdict(MotionSettings()))
            stage.player.clock = time.perf_counter

    def _reset_layout(self) -> None:
        window = self._editor.window
        for dock in window.findChildren(QDockWidget):
            # Once opened it has had the room that it asks for.
            dock.setProperty("hadRoom", None)
        if window.size() != self._size:
            window.resize(self._size)
        if window.saveState() != self._state:
            window.restoreState(self._state)
        if window.splitter.saveState() != self._splitter:
            window.splitter.restoreState(self._splitter)
        # The view is fitted to the place that is there.
        QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)

    def pytest_runtest_setup(self, item) -> None:
        """Begin a test that makes windows of its own without the one that is kept."""
        if "editor" not in item.fixturenames and "qapp" in item.fixturenames:
            self.drop()

    def drop(self) -> None:
        if self._editor is not None:
            window, self._editor = self._editor.window, None
            window.asks_before_closing = False
            window.close()
            window.deleteLater()


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
    for name in ("playMotion", "plotCurvature"):
        editor.trigger(name)
        editor.trigger({"playMotion": "stopMotion"}.get(name, name))
