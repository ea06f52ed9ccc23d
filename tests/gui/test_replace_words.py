"""Words of texts replaced by others: in all texts or those chosen, in their looks, in one step."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from app.document.contents import texts_at
from app.document.limits import EditError
from app.exchange.svg.reader import read_svg
from app.features.text.replace_bar import ReplaceBar
from app.features.text.replacing import Found, found_in, with_words_replaced

pytestmark = pytest.mark.usefixtures("qapp")

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="60mm" viewBox="0 0 100 60" font-size="6">'
)
DRAWING = (
    f'{HEAD}<text x="5" y="10">Ada and <tspan font-weight="700">ada</tspan>s</text>'
    '<text x="5" y="20">An<tspan font-style="italic">ada</tspan>ma</text>'
    '<text x="5" y="30">Bernoulli</text><rect x="80" y="40" width="9" height="9"/></svg>'
)


def words(document):
    return [form.words for form in texts_at(document, range(len(document.curves))).values()]


def runs(document, place=0):
    return [(run.words, run.weight, run.italic) for run in document.curves[place].form.lines[0].runs]


def test_what_replaces_looks_as_the_first_letters_of_what_it_replaces():
    document = read_svg(DRAWING.encode()).document
    assert found_in(document, range(4), "ADA") == Found(3, 2)
    done = with_words_replaced(document, range(4), "ada", "Grace")
    assert words(done) == ["Grace and Graces", "AnGracema", "Bernoulli"]
    assert runs(done) == [("Grace and ", 400.0, False), ("Grace", 700.0, False), ("s", 400.0, False)]
    # Across looks: “nada” begins before the italic letters, which go with it.
    across = with_words_replaced(document, [1], "nada", "x")
    assert runs(across, 1) == [("Ax", 400.0, False), ("ma", 400.0, False)]
    assert [curve.name for curve in done.curves[:3]] == words(done)
    assert done.curves[2:] == document.curves[2:]


@pytest.mark.parametrize("sought", ["a", "and", "ada", "s", " ", "Ada and adas", "d A", "."])
@pytest.mark.parametrize("by", ["", "aa", "longer words"])
def test_it_says_what_a_line_of_plain_words_would(sought, by):
    document = read_svg(DRAWING.encode()).document
    plain = document.curves[0].form.lines[0].words
    expected = re.sub(re.escape(sought), by, plain, flags=re.IGNORECASE)
    if not expected.strip():
        with pytest.raises(EditError, match="Nothing would be left of “Ada and adas”"):
            with_words_replaced(document, [0], sought, by)
        return
    done = with_words_replaced(document, [0], sought, by)
    assert done.curves[0].form.lines[0].words == expected


def test_words_are_typed_and_replaced_in_one_step_in_what_is_chosen_or_in_all(open_drawing):
    editor = open_drawing(DRAWING)
    editor.window.activateWindow()
    session = editor.session
    session.selected.choose(())
    editor.trigger("replaceWords")
    bar = editor.window.canvas.viewport().findChild(ReplaceBar)
    told = bar.findChild(QLabel, "replaceTold")
    assert (told.text(), bar.button.isEnabled()) == ("In all texts.", False)
    QTest.keyClicks(bar.words, "ada")
    assert (told.text(), bar.button.isEnabled()) == ("Found 3 times in 2 texts.", True)
    session.selected.choose({1})
    assert told.text() == "Found 1 time in 1 text."
    session.selected.choose({3})
    assert told.text() == "Found 3 times in 2 texts."
    bar.by.setFocus()
    QTest.keyClicks(bar.by, "Grace")
    steps = session.undo_stack.index()
    QTest.keyClick(bar.by, Qt.Key.Key_Return)
    assert words(session.document) == ["Grace and Graces", "AnGracema", "Bernoulli"]
    assert (session.undo_stack.index(), session.undo_stack.undoText()) == (
        steps + 1,
        "Replace “ada” by “Grace”",
    )
    assert editor.status == "Replaced 3 times in 2 texts."
    assert (told.text(), bar.button.isEnabled()) == ("Not found.", False)
    QTest.keyClick(bar.by, Qt.Key.Key_Return)
    assert session.undo_stack.index() == steps + 1
    session.undo_stack.undo()
    assert told.text() == "Found 3 times in 2 texts."
    QTest.keyClick(bar.by, Qt.Key.Key_Escape)
    assert not bar.isVisible()
