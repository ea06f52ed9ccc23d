"""Arrow keys pressed one after the other are one step of the history."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document.model import Document, Page, make_curve
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


@pytest.fixture
def paper(arch):
    """The same on a page of millimetres, seen as a whole: there the adaptive grid has steps of 10 mm."""
    page = Page(0.0, 0.0, 210.0, 297.0)
    arch.session.change("Page", lambda document: replace(document, unit="mm", page=page))
    arch.fit()
    yield arch
    arch.new()
    arch.settle()


@pytest.mark.parametrize("snaps", [False, True])
def test_on_paper_a_key_goes_one_millimetre_at_any_zoom_whether_it_snaps_or_not(paper, snaps):
    """It went 10 mm while snapping, with Shift 100 mm."""
    if snaps:
        paper.trigger("toggleSnap")
    try:
        paper.session.selected.choose({0})
        for held, expected in ((NONE, 1.0), (SHIFT, 11.0), (CTRL, 11.1)):
            paper.key(RIGHT, held)
            assert paper.point(0)[0] == pytest.approx(expected, abs=1e-12)
        x = paper.point(0)[0]
        paper.key(RIGHT, ALT)
        assert paper.point(0)[0] - x == pytest.approx(paper.pixel, rel=0.05)
        paper.window.canvas.camera.show_box((0, 2), (0, 2))
        x = paper.point(0)[0]
        paper.key(LEFT)
        assert paper.point(0)[0] == pytest.approx(x - 1.0, abs=1e-9)
    finally:
        if snaps:
            paper.trigger("toggleSnap")


def test_the_step_is_the_grids_where_the_document_has_one_of_its_own_and_else_what_was_set(paper):
    store = paper.window.store
    paper.set_grid(2.5)
    paper.trigger("toggleSnap")
    try:
        paper.session.selected.choose({0})
        paper.key(RIGHT)
        assert paper.point(0)[0] == 2.5
        store.change(nudge=0.25)
        paper.key(RIGHT)
        assert paper.point(0)[0] == 2.75
    finally:
        paper.trigger("toggleSnap")
        store.change(nudge=0.0)
