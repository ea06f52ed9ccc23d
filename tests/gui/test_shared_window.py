"""The window that tests share: changes of a test are reset, or detected and end the sharing."""

from __future__ import annotations

import inspect
import re
from collections import defaultdict
from pathlib import Path

import pytest
from fingerprint import DRAWN, PASSING, RENDERED_ANEW, Fingerprint, differences
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QLabel, QTabWidget

import app
from app.document.model import Axis, Document, make_curve
from app.document.point_group import points_of
from app.families import HERMITE
from app.features.lessons.commands import LessonCommands
from app.features.recovery.commands import RecoveryCommands
from app.plotting.camera import ViewBox

ARCH = make_curve([(0, 0), (1, 2), (2, 0)], name="Arch")


def attributes_in(source):
    """The attributes that the source of a class assigns to, declares or defines."""
    assigned = re.findall(r"^ +(self\.\w+[^=\n]*?) ?(?:=|: )", source, re.MULTILINE)
    declared = re.findall(r"^    (?:def )?(\w+)(?=[:(]| = )", source, re.MULTILINE)
    kept = re.findall(r'self\.__dict__\["(\w+)"\] = ', source)
    return {name for targets in assigned for name in re.findall(r"self\.(\w+)", targets)}.union(
        declared, kept
    )


def test_names_that_the_fingerprint_leaves_out_exist():
    """Names of attributes and classes were left behind when these were renamed."""
    attributes = defaultdict(set)
    for path in Path(app.__file__).parent.rglob("*.py"):
        for source in re.split(r"^(?=class )", path.read_text("utf-8"), flags=re.MULTILINE)[1:]:
            attributes[re.match(r"class (\w+)", source)[1]] |= attributes_in(source)
    bases = [base for base in ViewBox.__mro__ if base.__module__.startswith("pyqtgraph")]
    library = {"__dict__"}.union(*(attributes_in(inspect.getsource(base)) for base in bases))
    anywhere = library.union(*attributes.values())
    unknown = {
        name
        for name in PASSING
        for owner, _, attribute in [name.rpartition(".")]
        if attribute not in (attributes[owner] if owner else anywhere)
    }
    assert unknown == set()
    assert (DRAWN | RENDERED_ANEW) - attributes.keys() == set()


def test_planted_differences_of_the_window_are_detected(editor, monkeypatch):
    window, session = editor.window, editor.session
    hint, canvas = window.findChild(QLabel, "hint"), window.canvas
    action = window.actions_by_name["undo"]
    new = Fingerprint(window).told

    class Clock:
        def __call__(self):
            return 0.0

    planted = {
        "window.canvas._is_held": lambda patch: patch.setattr(canvas, "_is_held", True),
        "window.canvas.of_a_test": lambda patch: patch.setattr(canvas, "of_a_test", 1, raising=False),
        "window.canvas.layers._layers.count": lambda patch: patch.setattr(
            canvas.layers, "_layers", canvas.layers._layers[:-1]
        ),
        "window.canvas.tools.settings": lambda patch: patch.setattr(canvas.tools, "settings", None),
        "window.session.history.clock": lambda patch: patch.setattr(session.history, "clock", Clock()),
        "window.session.selected.group": lambda patch: patch.setattr(
            session.selected, "group", points_of(0, [1])
        ),
        "window.session.say": lambda patch: patch.setattr(session, "say", lambda _text: None),
        "commands RecoveryCommands._open_beside": lambda patch: patch.setattr(
            window.commands[RecoveryCommands], "_open_beside", print
        ),
        "widget hint": lambda patch: patch.setattr(hint, "is_planted", hint.setToolTip("?"), raising=False),
        "action undo": lambda patch: patch.setattr(action, "is_planted", action.setText("?"), raising=False),
    }
    assert not differences(Fingerprint(window).told, new)
    for place, plant in planted.items():
        with monkeypatch.context() as patch:
            plant(patch)
            found = differences(Fingerprint(window).told, new)
        assert any(each.startswith(place) for each in found), place
        hint.setToolTip(new["widget hint"][-1])
        action.setText("Undo")
    # What was planted is gone, and the window is as it was.
    assert not differences(Fingerprint(window).told, new)


def draw_a_guide(editor):
    canvas = editor.window.canvas
    ruler = QPoint(int(canvas.camera.origin.x()) - 10, 100)
    editor.drag_pixels(canvas, ruler, ruler + QPoint(200, 20))
    assert editor.session.document.guides


def type_a_guide(editor):
    editor.window.canvas.guide_opened.emit(Axis.X)


def choose_all_curves(editor):
    editor.session.commit(Document((*editor.session.document.curves, ARCH)), "Begin", active=1)
    editor.trigger("selectAllCurves")
    assert len(editor.session.selected.curves) == 2


def turn_a_page(editor):
    """A page that was left in front used to hide what the next lesson needs."""
    editor.trigger("toggleLaboratory")
    editor.window.findChild(QTabWidget, "laboratoryPanel").setCurrentIndex(1)


_WAYS = {
    "all curves": choose_all_curves,
    "a menu": lambda editor: editor.open_menu((1.0, 1.0)).close(),
    "another family": lambda editor: editor.choose_family(HERMITE),
    "a dark theme": lambda editor: editor.trigger("themeDark"),
    "a lesson": lambda editor: editor.window.commands[LessonCommands].open("01_basis_functions"),
    "a motion": lambda editor: editor.trigger("playMotion"),
    "a palette": lambda editor: editor.find_command("fit"),
    "a guide": draw_a_guide,
    "a style": lambda editor: editor.trigger("showStyle"),
    "a place that is typed": type_a_guide,
    "a zoom": lambda editor: editor.trigger("zoom100"),
    "no rulers": lambda editor: editor.trigger("toggleRulers"),
    "a press": lambda editor: editor.press((1.0, 1.0)),
    "a smaller window": lambda editor: editor.window.resize(900, 650),
    "another page": turn_a_page,
    "a unit": lambda editor: editor.set_unit("mm"),
    "other keys": lambda editor: editor.window.context.actions.keymap.assign("redo", []),
    "laboratory": lambda editor: editor.trigger("toggleLaboratory"),
    "a presentation": lambda editor: editor.trigger("presentation"),
    "snapping": lambda editor: editor.trigger("toggleSnap"),
    "plots": lambda editor: editor.trigger("plotSpeed"),
    "preferences": lambda editor: editor.trigger("preferences"),
    "keys": lambda editor: editor.trigger("showShortcuts"),
}


@pytest.mark.parametrize("way", list(_WAYS))
def test_changes_by_a_person_are_reset(editor, shared_editor, way):
    _WAYS[way](editor)
    editor.settle()
    shared_editor._reset()
    assert not shared_editor.differences()


def test_comparing_the_window_does_not_paint(editor, shared_editor):
    """What the drawing keeps of a frame was told of: each test had its window painted once more."""
    editor.window.canvas.camera.show_box((0, 0.1), (0, 0.08))
    editor.settle()
    editor.session.commit(Document((ARCH,)), "Begin")
    editor.select([1])
    paints = []

    def count():
        paints.append(1)

    shared_editor._reset()
    editor.window.canvas.painted.connect(count)
    assert not shared_editor.differences()
    editor.window.canvas.painted.disconnect(count)
    assert not paints
