"""Arrow keys pressed one after the other are one step of the history."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document.model import Document, make_curve
from app.document.transforms import clean_step
from app.features.history.commands import HistoryCommands

POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0))
NONE, SHIFT = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ShiftModifier
CTRL, ALT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.AltModifier
RIGHT, LEFT, UP = Qt.Key.Key_Right, Qt.Key.Key_Left, Qt.Key.Key_Up


class Clock:
    """Stands still until it is told."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def arch(editor):
    editor.session.history.clock = Clock()
    editor.session.commit(Document((make_curve(POINTS),)), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    return editor


def history(editor):
    """The rows of the history panel."""
    model = editor.window.commands[HistoryCommands].panel.view.model()
    return [model.data(model.index(row, 0)) for row in range(1, model.rowCount())]


def wait(editor, seconds):
    editor.session.history.clock.now += seconds


def test_quick_nudges_are_one_step_and_one_row(arch):
    document, step = arch.session.document, clean_step(2 * arch.pixel)
    arch.select([0, 1, 2])
    for key in (RIGHT, RIGHT, UP):
        arch.key(key)
        wait(arch, 0.9)
    assert history(arch) == ["Begin", "Nudge 3 points"]
    assert arch.point(2) == pytest.approx((3 + 2 * step, 2 + step))
    moved = arch.session.document
    arch.trigger("undo")
    assert arch.session.document is document
    arch.trigger("redo")
    assert arch.session.document is moved


def test_a_pause_begins_a_new_step(arch):
    arch.select([1])
    arch.key(RIGHT)
    wait(arch, 1.1)
    arch.key(RIGHT)
    assert history(arch) == ["Begin", "Nudge point 1", "Nudge point 1"]


def test_an_action_in_between_begins_a_new_step(arch):
    arch.select([1])
    arch.key(RIGHT)
    arch.drag_point(2, to=(3, 3))
    arch.select([1])
    arch.key(RIGHT)
    assert history(arch) == ["Begin", "Nudge point 1", "Move point 2", "Nudge point 1"]
    arch.trigger("undo")
    arch.trigger("undo")
    arch.key(UP)
    assert history(arch) == ["Begin", "Nudge point 1", "Nudge point 1"]
    arch.key(UP)
    assert history(arch) == ["Begin", "Nudge point 1", "Nudge point 1"]


def test_another_selection_begins_a_new_step_and_so_does_its_return(arch):
    for index in (1, 2, 2):
        arch.select([])
        arch.select([index])
        arch.key(RIGHT)
    assert history(arch) == ["Begin", "Nudge point 1", "Nudge point 2", "Nudge point 2"]


def test_a_saved_state_stays_a_step(arch, tmp_path):
    arch.select([1])
    arch.key(RIGHT)
    arch.session.save(tmp_path / "arch.curve.json")
    arch.key(RIGHT)
    assert history(arch) == ["Begin", "Nudge point 1", "Nudge point 1"]
    arch.trigger("undo")
    assert not arch.session.files.is_modified


def test_there_and_back_again_is_no_step(arch):
    # With steps of the grid, so that it is the same place to the last bit.
    arch.set_grid(0.5)
    begun = history(arch)
    arch.trigger("toggleSnap")
    document = arch.session.document
    arch.select([1])
    arch.key(RIGHT)
    assert arch.session.document != document
    arch.key(LEFT)
    assert arch.session.document == document
    assert history(arch) == begun
    arch.key(UP)
    assert history(arch) == [*begun, "Nudge point 1"]


def test_ticks_and_the_image_are_nudged_in_one_step_too(arch):
    panel = arch.window.basis_panel
    arch.select([1])
    panel.setFocus()
    for _ in range(3):
        QTest.keyClick(panel, RIGHT)
    assert history(arch) == ["Begin", "Change t of point 1"]
    arch.key(RIGHT)
    assert history(arch) == ["Begin", "Change t of point 1", "Nudge point 1"]
