"""Arrow keys pressed one after the other are one step of the history."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document.transforms import round_step_above
from app.features.history.commands import HistoryCommands

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
def nudged(arch):
    """The arch, at a time that stands still."""
    arch.session.history.clock = Clock()
    return arch


def history(editor):
    """The rows of the history panel."""
    editor.window.context.docks["historyDock"].fill()
    model = editor.window.commands[HistoryCommands].panel.view.model()
    return [model.data(model.index(row, 0)) for row in range(1, model.rowCount())]


def wait(editor, seconds):
    editor.session.history.clock.now += seconds


def test_quick_nudges_are_one_step_and_one_row(nudged):
    document, step = nudged.session.document, round_step_above(2 * nudged.pixel)
    nudged.select([0, 1, 2])
    for key in (RIGHT, RIGHT, UP):
        nudged.key(key)
        wait(nudged, 0.9)
    assert history(nudged) == ["Begin", "Nudge 3 points"]
    assert nudged.point(2) == pytest.approx((3 + 2 * step, 2 + step))
    moved = nudged.session.document
    nudged.trigger("undo")
    assert nudged.session.document is document
    nudged.trigger("redo")
    assert nudged.session.document is moved


def test_a_pause_begins_a_new_step(nudged):
    nudged.select([1])
    nudged.key(RIGHT)
    wait(nudged, 1.1)
    nudged.key(RIGHT)
    assert history(nudged) == ["Begin", "Nudge point 1", "Nudge point 1"]


def test_an_action_in_between_begins_a_new_step(nudged):
    nudged.select([1])
    nudged.key(RIGHT)
    nudged.drag_point(2, to=(3, 3))
    nudged.select([1])
    nudged.key(RIGHT)
    assert history(nudged) == ["Begin", "Nudge point 1", "Move point 2", "Nudge point 1"]
    nudged.trigger("undo")
    nudged.trigger("undo")
    nudged.key(UP)
    assert history(nudged) == ["Begin", "Nudge point 1", "Nudge point 1"]
    nudged.key(UP)
    assert history(nudged) == ["Begin", "Nudge point 1", "Nudge point 1"]


def test_another_selection_and_its_return_begin_new_steps(nudged):
    for index in (1, 2, 2):
        nudged.select([])
        nudged.select([index])
        nudged.key(RIGHT)
    assert history(nudged) == ["Begin", "Nudge point 1", "Nudge point 2", "Nudge point 2"]


def test_a_saved_state_stays_a_step(nudged, tmp_path):
    nudged.select([1])
    nudged.key(RIGHT)
    nudged.session.save(tmp_path / "nudged.curve.json")
    nudged.key(RIGHT)
    assert history(nudged) == ["Begin", "Nudge point 1", "Nudge point 1"]
    nudged.trigger("undo")
    assert not nudged.session.files.is_modified


def test_nudges_there_and_back_leave_no_step(nudged):
    # With steps of the grid, so that it is the same place to the last bit.
    nudged.set_grid(0.5)
    begun = history(nudged)
    nudged.trigger("toggleSnap")
    document = nudged.session.document
    nudged.select([1])
    nudged.key(RIGHT)
    assert nudged.session.document != document
    nudged.key(LEFT)
    assert nudged.session.document == document
    assert history(nudged) == begun
    nudged.key(UP)
    assert history(nudged) == [*begun, "Nudge point 1"]


def test_quick_nudges_of_ticks_and_of_the_image_are_one_step(nudged):
    panel = nudged.window.basis_panel
    nudged.select([1])
    panel.setFocus()
    for _ in range(3):
        QTest.keyClick(panel, RIGHT)
    assert history(nudged) == ["Begin", "Change t of point 1"]
    nudged.key(RIGHT)
    assert history(nudged) == ["Begin", "Change t of point 1", "Nudge point 1"]
