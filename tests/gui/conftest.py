"""The editor fixture, over a window that is used again as long as nothing about it differs from a new one.

Building a window takes longer than most of the questions put to it. So the one that a test leaves is
reset, and the next test gets it if all that can be told of it is what was told of it when it was new;
otherwise it is thrown away. A test that makes windows of its own begins without it.
"""

from __future__ import annotations

import enum
import sys
from pathlib import Path, PurePath
from typing import ClassVar

import msgspec
import pytest
from PySide6.QtCore import QEvent
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QWidget

from app.examples import first_sketch
from app.testing import Editor

# What several of these tests share lies beside them.
sys.path.insert(0, str(Path(__file__).parent))

_PLAIN = (bool, int, float, str, bytes, type(None), enum.Enum, PurePath)


class Fingerprint:
    """What can be told of a window: the plain values of all objects of ours that it reaches, and its widgets.

    Attributes
    ----------
    told
        What was found, by where it was found.
    """

    passing: ClassVar = {
        # What was drawn last, and what is kept so that it need not be made again.
        *(
            "_asked",
            "_discs_asked",
            "_dressed",
            "_drawn",
            "_ghost",
            "_ghost_drawn",
            "_ghost_stroke",
            "_is_resting",
        ),
        *(
            "_known",
            "_made",
            "_painted",
            "_pens",
            "_room",
            "_seconds",
            "_stamps",
            "_stroke",
            "_strokes",
            "__dict__",
        ),
        # Where the pointer was last, before it left.
        *("_hand", "_last", "_menu_refused", "_modal", "_place_now", "_pointer"),
        # How often something has happened.
        *("_documents", "_meant_for"),
    }
    """Names of attributes that may differ."""

    def __init__(self, window: QWidget) -> None:
        self.told: dict[str, object] = {}
        # Objects, not their ids alone: an id is free for another one as soon as its owner has gone.
        self._seen: dict[int, object] = {}
        self._walk("window", window)
        for action in named_actions(window):
            self.told[f"action {action.objectName()}"] = (
                action.isChecked(),
                action.isEnabled(),
                action.isVisible(),
                action.text(),
                action.shortcut().toString(),
            )
        for widget in window.findChildren(QWidget):
            name = widget.objectName()
            if name and not name.startswith("qt_"):
                self.told[f"widget {name}"] = self._told_of(widget)

    def _walk(self, place: str, value: object) -> None:
        if isinstance(value, _PLAIN):
            self.told[place] = value
        elif isinstance(value, set | frozenset):
            self.told[place] = len(value)
        elif id(value) not in self._seen:
            self._seen[id(value)] = value
            for name, each in self._parts(value).items():
                self._walk(f"{place}.{name}", each)

    def _parts(self, value: object) -> dict[object, object]:
        if isinstance(value, dict):
            return {"count": len(value)} | {
                key: each for key, each in value.items() if isinstance(key, _PLAIN)
            }
        if isinstance(value, list | tuple):
            return {"count": len(value)} | dict(enumerate(value))
        if type(value).__module__.partition(".")[0] != "app":
            return {}
        names = set(getattr(value, "__dict__", ()))
        if isinstance(value, msgspec.Struct):
            names.update(value.__struct_fields__)
        for kind in type(value).__mro__:
            slots = vars(kind).get("__slots__", ())
            names.update((slots,) if isinstance(slots, str) else slots)
        return {"type": type(value).__name__} | {
            name: getattr(value, name, None) for name in sorted(names - self.passing)
        }

    @staticmethod
    def _told_of(widget: QWidget) -> tuple[object, ...]:
        if widget.isHidden():
            # What it says is set before it is shown.
            return (True,)
        text = widget.text() if isinstance(widget, QLabel | QAbstractButton) else ""
        return False, widget.isEnabled(), text, widget.toolTip()


def named_actions(window: QWidget) -> list[QAction]:
    return [action for action in window.findChildren(QAction) if action.objectName()]


class KeptEditor:
    """The editor whose window is used again."""

    def __init__(self) -> None:
        self._editor: Editor | None = None

    def get(self, qtbot) -> Editor:
        if self._editor is None:
            self._editor = Editor(_Keeper(qtbot))
            window = self._editor.window
            # tests/conftest.py looks for windows that are left over.
            window.setProperty("isKept", True)
            self._state, self._splitter = window.saveState(), window.splitter.saveState()
            self._checked = {action.objectName() for action in named_actions(window) if action.isChecked()}
            self._reset()
            self._new = Fingerprint(window).told
        return self._editor

    def take_back(self) -> None:
        """Reset the window; throw it away where that fails or leaves it different."""
        window = self._editor.window
        try:
            self._reset()
            is_as_new = Fingerprint(window).told == self._new and QApplication.activeWindow() is window
        except Exception:
            # Whatever a test has done to it.
            is_as_new = False
        if not is_as_new:
            self.drop()

    def _reset(self) -> None:
        editor, window, session = self._editor, self._editor.window, self._editor.session
        session.interrupt()
        session.restore(first_sketch(), None)
        session.undo_stack.setClean()
        checkable = [action for action in named_actions(window) if action.isCheckable()]
        # Those to check before those to uncheck: of exclusive ones the first unchecks the others.
        for action in sorted(checkable, key=lambda each: each.isChecked()):
            if action.isChecked() != (action.objectName() in self._checked):
                action.trigger()
        window.restoreState(self._state)
        window.splitter.restoreState(self._splitter)
        window._commands.messages.greet()
        editor.fit()
        window.canvas.setFocus()
        for plot in (window.canvas, window.basis_panel):
            QApplication.sendEvent(plot.viewport(), QEvent(QEvent.Type.Leave))
            QApplication.sendEvent(plot, QEvent(QEvent.Type.Leave))
        editor.settle()

    def pytest_runtest_setup(self, item) -> None:
        """Begin a test that makes windows of its own without the one that is kept."""
        if "editor" not in item.fixturenames:
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


_kept = KeptEditor()


def pytest_configure(config):
    """Let the kept window hear of tests in other folders, too."""
    config.pluginmanager.register(_kept)


@pytest.fixture
def editor(qtbot):
    yield _kept.get(qtbot)
    _kept.take_back()
