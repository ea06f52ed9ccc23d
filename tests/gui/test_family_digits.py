"""Keys that reshape: at once in a course, by a second press where they mean a drawing for paper."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document import edits
from app.document.model import Document, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE

Key = Qt.Key
ARCH = ((0.0, 0.0), (10.0, 20.0), (35.0, 22.0), (40.0, 0.0))


def letter(editor, unit="mm"):
    """A curve with a handle of its own, edited, in a document of a unit."""
    document = Document((make_curve(ARCH, family=HERMITE, name="Letter"),), unit=unit)
    editor.session.commit(edits.set_velocity(document, 0, 1, (30.0, 10.0)), "Begin")
    editor.window.canvas.camera.show_box((-10, 50), (-10, 30))
    editor.settle()
    return editor


def test_a_digit_says_first_what_it_would_do_to_a_drawing_for_paper_and_the_second_press_does_it(editor):
    """3 made a letter quintic that a designer wanted to see larger."""
    before = letter(editor).session.document
    editor.key(Key.Key_3)
    assert editor.session.document is before
    said = editor.status
    assert said.startswith("Press it again to make “Letter” quintic Hermite; the shape changes by 0.77 mm. ")
    assert said.endswith("Zoom: Ctrl+3 selection, F all, Ctrl+4 page.")
    editor.key(Key.Key_3)
    assert editor.curve.family is QUINTIC_HERMITE
    editor.trigger("undo")
    assert editor.session.document == before


@pytest.mark.parametrize("between", ["another digit", "a click", "a nudge", "held down"])
def test_what_comes_between_makes_it_a_first_press_again(editor, between):
    letter(editor).key(Key.Key_3)
    if between == "another digit":
        editor.key(Key.Key_1)
    elif between == "a click":
        editor.click(editor.point(1))
    elif between == "a nudge":
        editor.select([1])
        editor.key(Key.Key_3)
        editor.key(Key.Key_Up)
    else:
        QTest.keyPress(editor.window.canvas, Key.Key_1)
        assert not editor.action("familyLagrange").autoRepeat()
        QTest.keyRelease(editor.window.canvas, Key.Key_1)
    editor.key(Key.Key_3)
    assert editor.curve.family is HERMITE
    editor.key(Key.Key_3)
    assert editor.curve.family is QUINTIC_HERMITE


def test_in_a_course_and_from_the_toolbar_nothing_is_asked(editor):
    letter(editor, unit="m").key(Key.Key_3)
    assert editor.curve.family is QUINTIC_HERMITE
    letter(editor).trigger("familyLagrange")
    assert editor.curve.family is LAGRANGE


def test_a_shape_that_stays_is_not_asked_about(editor):
    """Where no handle was set, the quintic that the rules make is the same curve."""
    letter(editor)
    editor.session.change("Estimate", lambda document: edits.set_velocity(document, 0, 1, None))
    editor.key(Key.Key_3)
    assert editor.curve.family is QUINTIC_HERMITE


def test_c_says_first_that_it_would_open_what_is_chosen_and_then_that_it_did(editor):
    """The key alone took a side from a rectangle that was chosen, and nothing was said."""
    letter(editor).trigger("closeCurve")
    before = editor.session.document
    assert editor.curve.is_closed
    assert editor.status == "Closed “Letter” · Ctrl+Z: undo"
    editor.session.selected.choose([0])
    editor.key(Key.Key_C)
    assert editor.session.document is before
    assert editor.status == "Press it again to open “Letter”. Enter edits it."
    editor.key(Key.Key_C)
    assert not editor.curve.is_closed
    assert editor.status == "Opened “Letter” · Ctrl+Z: undo"
    editor.trigger("undo")
    assert editor.session.document == before
    editor.key(Key.Key_Return)
    editor.key(Key.Key_C)
    assert not editor.curve.is_closed, "who edits a curve means it"
