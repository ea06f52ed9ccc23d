"""The size of what was copied, given to what is chosen; real keys and commands."""

from __future__ import annotations

import numpy as np
import pytest
from extents import CLOSE, printed_bounds, sampled_bounds
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtWidgets import QApplication

from app.document.model import Document, make_curve
from app.document.style import Style
from app.families import HERMITE

CTRL = Qt.KeyboardModifier.ControlModifier
ARCH = ((0.0, 0.0), (10.0, 20.0), (30.0, 22.0), (40.0, 5.0))
LARGE, SMALL, OTHER, LINE = range(4)


@pytest.fixture
def drawn(editor):
    """Two arches of different sizes, a third beside them, and a level line; in millimetres."""
    drawn = {
        "Large": ARCH,
        "Small": [(60 + x / 4, y / 2) for x, y in ARCH],
        "Other": [(90 + x / 2, 30 - y / 5) for x, y in ARCH],
        "Line": [(0.0, -20.0), (30.0, -20.0)],
    }
    curves = (
        replace(make_curve(points, name=name, family=HERMITE), style=Style(width=2.0))
        for name, points in drawn.items()
    )
    editor.session.commit(Document(tuple(curves), unit="mm"), "Begin")
    editor.fit()
    return editor


def size(editor, *places):
    return np.ptp(printed_bounds(editor, *places), axis=0)


def middle(editor, *places):
    return printed_bounds(editor, *places).mean(axis=0)


def copy(editor, *places):
    editor.session.selected.choose(places)
    editor.key(Qt.Key.Key_C, CTRL)


def paste(editor, command, *places):
    editor.session.selected.choose(places)
    editor.run_command(command)


@pytest.mark.parametrize(("command", "axes"), [("Size", (0, 1)), ("Width", (0,)), ("Height", (1,))])
def test_what_is_chosen_gets_the_size_that_was_copied_with_its_strokes_about_its_middle(drawn, command, axes):
    wanted, centre = size(drawn, LARGE), middle(drawn, SMALL)
    copy(drawn, LARGE)
    paste(drawn, f"Paste {command}", SMALL)
    assert size(drawn, SMALL)[list(axes)] == pytest.approx(wanted[list(axes)], abs=CLOSE)
    assert middle(drawn, SMALL)[list(axes)] == pytest.approx(centre[list(axes)], abs=CLOSE)
    assert drawn.session.undo_stack.undoText() == f"Paste {command.lower()} to Small"


def test_several_have_it_together_or_each_with_its_proportions_if_these_are_kept(drawn):
    wanted = size(drawn, LARGE)
    copy(drawn, LARGE)
    paste(drawn, "Paste Size", SMALL, OTHER)
    assert size(drawn, SMALL, OTHER) == pytest.approx(wanted, abs=CLOSE)
    drawn.key(Qt.Key.Key_Z, CTRL)
    shapes = {place: np.ptp(sampled_bounds(drawn, place), axis=0) for place in (SMALL, OTHER)}
    drawn.trigger("keepProportions")
    paste(drawn, "Paste Width Separately", SMALL, OTHER)
    for place, (width, height) in shapes.items():
        assert size(drawn, place)[0] == pytest.approx(wanted[0], abs=CLOSE)
        now = np.ptp(sampled_bounds(drawn, place), axis=0)
        assert now[1] / now[0] == pytest.approx(height / width, rel=1e-6)
    assert drawn.session.undo_stack.undoText() == "Paste width to each of 2 curves"


def test_svg_of_others_has_a_size_in_the_unit_of_the_document_and_numbers_have_none(drawn, qtbot):
    data = QMimeData()
    data.setText('<svg width="2in" height="2in" viewBox="0 0 2 2"><rect width="1" height="2"/></svg>')
    QApplication.clipboard().setMimeData(data)
    drawn.trigger("measureStrokes")
    paste(drawn, "Paste Size", SMALL)
    drawn.wait_for_work()
    assert np.ptp(sampled_bounds(drawn, SMALL), axis=0) == pytest.approx((25.4, 50.8), abs=CLOSE)
    QApplication.clipboard().setText("1 2\n3 4")
    paste(drawn, "Paste Size", OTHER)
    assert "nothing on the clipboard that has a size" in drawn.status


def test_what_has_no_height_is_given_none_and_a_copied_line_squeezes_nothing(drawn):
    before = drawn.session.document
    copy(drawn, LARGE)
    paste(drawn, "Paste Height", LINE)
    assert drawn.status.endswith("What has no height cannot be given one.")
    assert drawn.session.document is before
    drawn.trigger("measureStrokes")
    height = np.ptp(sampled_bounds(drawn, SMALL), axis=0)[1]
    copy(drawn, LINE)
    paste(drawn, "Paste Size", SMALL)
    assert np.ptp(sampled_bounds(drawn, SMALL), axis=0) == pytest.approx((30.0, height), abs=CLOSE)
