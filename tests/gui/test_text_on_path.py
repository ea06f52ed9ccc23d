"""Texts on paths: put there, followed as the path is edited, words typed, taken off."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QToolButton

from app.document.along_edits import along_of
from app.document.contents import corners_of
from app.document.several_curves import moved, whole_curves
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.text.commands import TextCommands
from app.features.transform.panel import TransformPanel
from tests.gui.test_contents import red
from tests.gui.test_text import finish

DRAWING = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60">'
    '<path id="arc" d="M10 40C30 10 70 10 90 40" fill="none" stroke="#0000ff"/>'
    '<text id="t" x="10" y="55" font-size="10" font-weight="900" fill="#ff0000">MMM</text></svg>'
)
ARC, TEXT = range(2)
ON_LETTER = (10.3, 25.8)
"""In the first letter that lies along the curve: 5 along it, 3 above."""


@pytest.fixture
def drawing(open_drawing):
    """An SVG with a curve and a straight text."""
    return open_drawing(DRAWING)


def put(drawing):
    session = drawing.session
    session.selected.choose({ARC, TEXT})
    drawing.trigger("putOnPath")
    return session.document.curves[TEXT]


def frame(curve):
    corners = corners_of(curve)
    return np.array([*np.min(corners, axis=0), *np.max(corners, axis=0)])


def seen(drawing):
    """Whether the letters on the canvas fill the frame of the text."""
    shown = drawing.window.context.central.canvas.pixel_map
    return red(drawing) == pytest.approx(frame(drawing.session.document.curves[TEXT]), abs=0.1 + 2 / shown.sx)


def test_a_text_is_put_on_a_path_and_follows_it_and_is_taken_off(drawing):
    session = drawing.session
    begun = session.document
    curve = put(drawing)
    assert session.selected.chosen == {TEXT}
    # It begins where the path does, and goes upwards with it.
    left, low, _, high = frame(curve)
    assert (left, low) == pytest.approx((8, 20), abs=4)
    assert high - low > 18
    assert seen(drawing)
    # Live while the path is dragged by its end, and back by Escape.
    there = frame(curve)
    session.selected.choose({ARC})
    drawing.press((50, 42.5))
    drawing.move((50, 32.5))
    assert frame(session.document.curves[TEXT])[[1, 3]] == pytest.approx(there[[1, 3]] - 10, abs=0.6)
    assert seen(drawing)
    drawing.key(Qt.Key.Key_Escape)
    drawing.release((50, 32.5))
    assert frame(session.document.curves[TEXT]) == pytest.approx(there)
    drawing.drag((50, 42.5), (50, 32.5))
    assert frame(session.document.curves[TEXT])[[1, 3]] == pytest.approx(there[[1, 3]] - 10, abs=0.6)
    drawing.trigger("undo")
    assert frame(session.document.curves[TEXT]) == pytest.approx(there)
    # Both together move once.
    session.selected.choose({ARC, TEXT})
    drawing.drag((50, 42.5), (50, 47.5))
    assert frame(session.document.curves[TEXT]) == pytest.approx(np.add(there, (0, 5, 0, 5)), abs=0.3)
    drawing.trigger("undo")
    session.selected.choose({TEXT})
    drawing.trigger("flipSide")
    assert along_of(session.document.curves[TEXT]).is_flipped
    assert frame(session.document.curves[TEXT])[0] > 60
    assert seen(drawing)
    drawing.trigger("undo")
    drawing.trigger("removeFromPath")
    straight = session.document.curves[TEXT]
    assert along_of(straight) is None
    assert frame(straight)[3] - frame(straight)[1] < 9
    for _ in range(2):
        drawing.trigger("undo")
    assert session.document == begun


def test_without_its_path_a_text_is_straight_where_it_began(drawing):
    session = drawing.session
    put(drawing)
    session.selected.choose({ARC})
    drawing.trigger("deleteSelection")
    (text,) = session.document.curves
    assert along_of(text) is None
    assert frame(text)[:2] == pytest.approx((10, 20), abs=1.5)


def test_it_is_chosen_by_its_letters_and_not_by_the_frame_around_them(drawing):
    session = drawing.session
    _, low, right, _ = frame(put(drawing))
    session.selected.choose(())
    # Inside the frame, and on its side, where there is no letter.
    for place in ((right - 2, low + 2), (right, low + 3)):
        drawing.click(place)
        assert session.selected.chosen == set(), place
    drawing.click(ON_LETTER)
    assert session.selected.chosen == {TEXT}
    drawing.click((right - 2, low + 2))
    assert session.selected.chosen == set()


def test_its_words_are_typed_and_it_becomes_outlines_where_it_is(drawing):
    session = drawing.session
    there = frame(put(drawing))
    field = drawing.window.commands[TextCommands].field
    drawing.window.activateWindow()
    drawing.double_click(ON_LETTER)
    assert field.text == "MMM"
    field.words.setPlainText("MM\nMM")
    curve = session.document.curves[TEXT]
    assert [line.words for line in curve.form.lines] == ["MM MM"]
    assert frame(curve)[2] > there[2] + 5
    finish(drawing)
    assert seen(drawing)
    there = frame(session.document.curves[TEXT])
    drawing.trigger("objectToPath")
    letters = [each for each in session.document.curves if each.name.startswith("M")]
    places = np.array([point.position for each in letters for point in each.points])
    assert np.array([*places.min(axis=0), *places.max(axis=0)]) == pytest.approx(there, abs=0.2)
    assert len(letters) == 4


def test_centred_it_stands_in_the_middle_of_its_path_and_what_has_no_room_is_told(drawing):
    """Its middle was at the beginning of the path, and the first half of the words was not seen."""
    session = drawing.session
    put(drawing)
    field = drawing.window.commands[TextCommands].field
    drawing.window.activateWindow()
    drawing.double_click(ON_LETTER)
    QTest.mouseClick(field.findChild(QToolButton, "textAlign_centre"), Qt.MouseButton.LeftButton)
    remark = field.findChild(QLabel, "textRemark")
    assert not remark.isVisible()
    left, _, right, _ = frame(session.document.curves[TEXT])
    assert (left + right) / 2 == pytest.approx(50, abs=1)
    assert seen(drawing)
    QTest.mouseClick(field.findChild(QToolButton, "textAlign_left"), Qt.MouseButton.LeftButton)
    assert (along_of(session.document.curves[TEXT]).start, remark.isVisible()) == (0.0, False)
    field.words.setPlainText("M" * 40)
    assert remark.text().startswith("⚠ The path has no room for ")
    finish(drawing)


def test_where_it_starts_is_typed(drawing):
    session = drawing.session
    drawing.trigger("openTransform")
    panel = drawing.window.findChild(TransformPanel)
    edit = panel.findChild(QLineEdit, "formTextStart")
    session.selected.choose({TEXT})
    drawing.settle()
    assert panel.findChild(QLineEdit, "formTextWidth").isVisible()
    assert not edit.isVisible()
    there = frame(put(drawing))
    drawing.settle()
    assert edit.isVisible()
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "12")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    assert along_of(session.document.curves[TEXT]).start == pytest.approx(12)
    assert frame(session.document.curves[TEXT])[0] > there[0] + 5
    assert edit.text().startswith("12")


def test_it_is_saved_as_a_text_on_a_path(drawing):
    session = drawing.session
    put(drawing)
    session.change("Down", lambda now: moved(now, whole_curves(now, {ARC}), (0, -5)))
    document = session.document
    for text in (
        svg_of(document).text,
        rewritten(DRAWING.encode(), document, read_svg(DRAWING.encode()).document).data.decode(),
    ):
        assert '<textPath xlink:href="#arc">MMM' in text
        again = read_svg(text.encode()).document.curves
        here, there = along_of(again[TEXT]), along_of(document.curves[TEXT])
        assert here.of == again[ARC].identity != ""
        assert np.array(here.pieces)[0, 0] - np.array(there.pieces)[0, 0] == pytest.approx((0, 60), abs=1e-6)


def test_where_it_starts_is_typed_in_per_cent_of_its_path_and_stays_so(drawing):
    """50% was half of what there was: of nothing, nothing."""
    session = drawing.session
    drawing.trigger("openTransform")
    panel = drawing.window.findChild(TransformPanel)
    edit = panel.findChild(QLineEdit, "formTextStart")
    put(drawing)
    drawing.settle()
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, "50%")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    along = along_of(session.document.curves[TEXT])
    assert (along.start, along.is_share) == (0.5, True)
    assert session.undo_stack.undoText() == "Set where along its path it begins to 50%"
    # The curve is its own mirror image about 50.
    assert frame(session.document.curves[TEXT])[0] == pytest.approx(50, abs=1.5)
    assert edit.text() == "50%"
    assert 'startOffset="50%"' in svg_of(session.document).text
    edit.selectAll()
    QTest.keyClicks(edit, "5")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    along = along_of(session.document.curves[TEXT])
    assert (along.start, along.is_share) == (pytest.approx(5), False)
    assert edit.text() == "5"
