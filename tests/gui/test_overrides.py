"""An exception in a method that Qt calls ends there, is told, and leaves everything else alone."""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import json
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pyqtgraph as pg
import pytest
import shiboken6
from PySide6.QtCore import QAbstractListModel, QEvent, QObject, QSize, Qt
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QLabel, QWidget

import app
from app.document.point_edits import set_position
from app.qt.overrides import SafeOverrides, empty_result, is_guarded

ROOT = Path(__file__).resolve().parents[2]
LEAST_PLACES = 30


def derived(cls):
    for each in cls.__subclasses__():
        yield each
        yield from derived(each)


def qt_classes(package):
    """Every class of a package that derives from one of Qt's."""
    for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if not found.name.endswith("__main__"):
            importlib.import_module(found.name)
    prefix = f"{package.__name__}."
    return {each for each in derived(shiboken6.Shiboken.Object) if each.__module__.startswith(prefix)}


def overrides(cls, own=None):
    """Whatever can be called in the body of a class under a name that can be called in a class of Qt's.

    `own` is the body looked at, that of a base which does not derive from Qt's.
    """
    of_qt = [base for base in cls.__mro__[1:] if base.__module__.startswith("PySide6.")]
    for name, value in vars(own or cls).items():
        is_method = callable(value) and not inspect.isclass(value)
        is_method = is_method or isinstance(value, staticmethod | classmethod | functools.partialmethod)
        if is_method and not name.startswith("__") and any(callable(vars(base).get(name)) for base in of_qt):
            yield name, value


def unguarded(classes):
    return [
        f"{cls.__module__}.{cls.__name__}.{name}"
        for cls in classes
        for own in cls.__mro__
        if own.__module__.partition(".")[0] not in ("PySide6", "pyqtgraph", "Shiboken", "builtins")
        for name, method in overrides(cls, own)
        if not is_guarded(method)
    ]


def test_every_override_of_the_program_is_guarded():
    classes = qt_classes(app)
    of_ours = {own for cls in classes for own in cls.__mro__ if own.__module__.startswith("app.")}
    assert sum(len(list(overrides(cls, own))) for cls in classes for own in of_ours & {*cls.__mro__}) > 180
    assert unguarded(classes) == [], "name `SafeOverrides` before Qt's class"


def test_an_override_without_a_guard_is_detected():
    class Bare(QWidget):
        def paintEvent(self, event):
            pass

    class Later(SafeOverrides, QWidget):
        pass

    class Sub(Later):
        def sizeHint(self) -> QSize:
            return QSize()

    class Beside:
        def moveEvent(self, event):
            pass

    class Mixed(Beside, Later):
        pass

    assert [name.rpartition(".")[2] for name in unguarded([Mixed])] == ["moveEvent"]
    assert [name.rpartition(".")[2] for name in unguarded([Bare, Later, Sub])] == ["paintEvent"]
    Later.event = lambda self, event: False
    Sub.resizeEvent = functools.partialmethod(QWidget.resizeEvent)
    found = {name.rpartition(".")[2] for name in unguarded([Bare, Later, Sub])}
    assert found == {"paintEvent", "event", "resizeEvent"}


def has_inner_class(text):
    """Whether a class of some code is no statement of its module; an example in a docstring is no class."""
    if re.search(r"^[ \t]+class\b", text, re.MULTILINE) is None:
        return False
    tree = ast.parse(text)
    return any(isinstance(node, ast.ClassDef) and node not in tree.body for node in ast.walk(tree))


def test_no_class_is_defined_inside_a_function():
    files = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "app").rglob("*.py")}
    assert [name for name, text in files.items() if has_inner_class(text)] == []
    assert has_inner_class("def make():\n    class Hidden: pass")


def test_every_override_of_pyqtgraph_is_guarded(editor):
    plots = (editor.window.canvas, editor.window.basis_panel)
    parts = {*plots, *(each for plot in plots for each in (plot.scene(), *plot.items()))}
    classes = {cls for part in parts for cls in type(part).__mro__ if cls.__module__.startswith("pyqtgraph.")}
    assert {pg.GraphicsView, pg.ViewBox, pg.GraphicsScene} <= classes
    of_library = [(cls, name, method) for cls in classes for name, method in overrides(cls)]
    assert [(cls, name) for cls, name, method in of_library if not hasattr(method, "__wrapped__")] == []


def test_a_failing_override_returns_an_empty_value_of_the_declared_type(qapp):
    for cls in qt_classes(app):
        for name, method in overrides(cls):
            declared = inspect.get_annotations(inspect.unwrap(method))["return"]
            result = empty_result(method)
            if result is None:
                assert declared in ("None", "Any", "object", "QWidget", "QIconEngine"), (cls, name)
            else:
                assert type(result).__name__ == declared.partition("[")[0].rpartition(".")[2], (cls, name)


def test_faults_in_many_overrides_are_reported_and_the_process_continues(own_home):
    here = Path(__file__).parent
    done = subprocess.run(
        [sys.executable, here / "plant_faults.py"],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    expected = {"called": True, "raised elsewhere": "", "told": 1, "kept": True, "open": True}
    wrong = [line for line in lines if line != {"place": line["place"]} | expected]
    assert wrong == []
    last = lines[-1]["place"] if lines else "the start"
    assert done.returncode == 0, f"it died after {last}: {done.stderr[-2000:]}"
    assert len(lines) >= LEAST_PLACES


# In this process


@pytest.fixture
def faults(monkeypatch):
    """What is handed to `sys.excepthook`."""
    found = []
    monkeypatch.setattr(sys, "excepthook", lambda _kind, problem, _trace: found.append(problem))
    return found


class FailsToPaint(SafeOverrides, QWidget):
    def paintEvent(self, event) -> None:
        painter = QPainter(self)
        painter.drawPoint(0, int("x"))

    def sizeHint(self) -> QSize:
        return [QSize(1, 2)][int("x")]


class FailsToClose(SafeOverrides, QWidget):
    def closeEvent(self, event) -> None:
        int("x")


class Child(SafeOverrides, QLabel):
    painted = 0

    def paintEvent(self, event) -> None:
        self.rect()
        self.painted += 1


def test_code_that_calls_a_failing_override_continues(qtbot, faults):
    window = FailsToPaint()
    qtbot.addWidget(window)
    child = Child("child", window)
    for _ in range(5):
        # Handed on, the fault would be raised by the next call of Qt's: by the child's `rect`, or here.
        window.grab()
    assert child.painted == 5
    assert {type(each) for each in faults} == {ValueError}
    assert len(faults) >= 5


def test_a_window_that_fails_to_close_stays_open(qtbot, faults):
    window = FailsToClose()
    qtbot.addWidget(window, before_close_func=QWidget.deleteLater)
    window.show()
    assert window.close() is False
    assert window.isVisible()
    assert {type(each) for each in faults} == {ValueError}
    window.hide()


def test_a_part_that_fails_to_end_keeps_neither_the_others_nor_the_window(editor, faults, monkeypatch):
    ended = []
    window = editor.window
    window.closed.connect(lambda: ended.append("last"))
    editor.session.files.give_up_changes()
    monkeypatch.setattr(window.splitter, "saveState", lambda: int("x"))
    assert window.close()
    assert ended == ["last"]
    assert [type(each) for each in faults] == [ValueError]


def test_document_and_history_agree_after_a_step_that_failed(editor, faults, monkeypatch):
    """The history went on without the document: the next undo then landed two steps further back."""
    session, stack = editor.session, editor.session.undo_stack
    states = [session.document]
    for step in range(3):
        session.commit(set_position(session.document, 0, 1, (1.0 + step, 3.0)), "Move point 1")
        states.append(session.document)
    editor.select_point(2)

    def planted(act):
        with monkeypatch.context() as patch:
            patch.setattr(session, "_restore", lambda _state: int("x"))
            act()
        assert session.document is session.committed
        assert session.document == states[stack.index()]
        assert session.active_view.source is session.document.curves[0]
        assert editor.window.canvas.drawing.view is session.active_view
        return stack.index()

    assert planted(lambda: editor.trigger("undo")) == 2
    editor.trigger("undo")
    assert session.document is states[1]
    assert planted(lambda: editor.trigger("redo")) == 2
    assert planted(lambda: stack.setIndex(0)) == 0
    assert planted(lambda: stack.setIndex(3)) == 3
    editor.trigger("undo")
    assert session.document is states[2]
    states[3:] = [set_position(states[2], 0, 1, (7.0, 7.0))]
    assert planted(lambda: session.commit(states[3], "Move")) == 3
    editor.trigger("undo")
    assert session.document is states[2]
    assert {type(each) for each in faults} == {ValueError}
    session.files.give_up_changes()


def test_a_failed_filter_passes_the_event_on(qtbot, faults):
    class Filter(SafeOverrides, QObject):
        def eventFilter(self, watched, event) -> bool:
            return bool(1 / 0)

    class Model(SafeOverrides, QAbstractListModel):
        def rowCount(self, parent=None) -> int:
            return [1][int("x")]

        def data(self, index, role=0) -> object:
            return {}["there is none"]

    watch, window = Filter(), QWidget()
    qtbot.addWidget(window)
    window.installEventFilter(watch)
    event = QEvent(QEvent.Type.WindowTitleChange)
    QWidget.event(window, event)
    window.setWindowTitle("heard")
    assert window.windowTitle() == "heard"
    assert ZeroDivisionError in map(type, faults)
    window.removeEventFilter(watch)
    model = Model()
    assert model.index(0, 0).data(Qt.ItemDataRole.DisplayRole) is None


def test_the_original_stays_within_reach():
    assert FailsToPaint.sizeHint.__wrapped__.__qualname__ == "FailsToPaint.sizeHint"
    assert FailsToPaint.sizeHint.__name__ == "sizeHint"
    with pytest.raises(ValueError, match="invalid literal"):
        FailsToPaint.sizeHint.__wrapped__(None)
