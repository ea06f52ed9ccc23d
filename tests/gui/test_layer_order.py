"""Order of layers that hold only texts, in the panel, the document and the file; real drags."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from app.exchange.svg.reader import read_svg
from tests.gui.curve_rows import rows, view_of

pytestmark = pytest.mark.usefixtures("drawings_read_here")

LEFT = Qt.MouseButton.LeftButton


def layer(name, inside):
    return f'  <g id="{name.split()[0]}" inkscape:groupmode="layer" inkscape:label="{name}">{inside}</g>\n'


SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">\n'
    + layer("Background", '<path id="ground" d="M0 0H60V40H0Z" fill="#eeeeee"/>')
    + layer("Draft notes", '<path inkscape:label="later" d="M2 38H9" stroke="#000000"/>')
    + layer(
        "Text",
        '<path inkscape:label="One" d="M2 30H9" stroke="#000000"/>'
        '<path inkscape:label="Two" d="M2 34H9" stroke="#000000"/>',
    )
    + layer("Logo", '<path id="logo" d="M5 5H20V20H5Z" fill="#00aa00"/>')
    + "</svg>\n"
)


@pytest.fixture
def drawing(editor, tmp_path):
    """The file, opened as a document."""
    path = tmp_path / "brand.svg"
    path.write_text(SVG, encoding="utf-8")
    editor.session.new()
    editor.window.context.files.open(path)
    editor.wait_for_work()
    editor.show_dock("curvesDock")
    editor.settle()
    return editor


def drag(editor, name, above):
    """Drag a row to the edge above another one, or below all."""
    view, names = view_of(editor), rows(editor)
    rects = [view.parts.entry_rect(row) for row in range(len(names))]
    start = rects[names.index(name)].center()
    y = rects[names.index(above)].top() + 1 if above else rects[-1].bottom() - 1
    QTest.mousePress(view.viewport(), LEFT, pos=start)
    QTest.mouseMove(view.viewport(), QPoint(start.x(), y + 9))
    QTest.mouseMove(view.viewport(), QPoint(start.x(), y))
    QTest.mouseRelease(view.viewport(), LEFT, pos=QPoint(start.x(), y))
    editor.settle()


def saved(editor, path):
    """Save, and return the layers of the file from the front, and of a document that it is read as."""
    editor.trigger("saveDocument")
    editor.wait_for_work()
    text = path.read_text(encoding="utf-8")
    assert [text.count(each) for each in (">One<", ">Two<", ">later<")] == [1, 1, 1]
    return re.findall('label="(.*?)"', text)[::-1], list(read_svg(text.encode()).document.layers)[::-1]


def test_a_layer_is_where_it_is_dropped_among_those_of_texts_alone(drawing, tmp_path):
    """It stayed, or others changed places, and the file had yet another order."""
    session, begun = drawing.session, ["Logo", "Text", "Draft notes", "Background"]
    assert rows(drawing) == begun
    steps = (
        ("Logo", "Draft notes", ["Text", "Logo", "Draft notes", "Background"]),
        ("Logo", "Background", ["Text", "Draft notes", "Logo", "Background"]),
        ("Logo", "", ["Text", "Draft notes", "Background", "Logo"]),
        ("Background", "Text", ["Background", "Text", "Draft notes", "Logo"]),
        ("Logo", "Text", ["Background", "Logo", "Text", "Draft notes"]),
        ("Draft notes", "Logo", ["Background", "Draft notes", "Logo", "Text"]),
        ("Text", "Background", ["Text", "Background", "Draft notes", "Logo"]),
    )
    for name, above, order in steps:
        drag(drawing, name, above)
        assert (rows(drawing), list(session.document.layers)[::-1]) == (order, order)
        assert session.undo_stack.undoText() == f"Reorder {name}"
        found, back = saved(drawing, tmp_path / "brand.svg")
        assert (found, back) == (order, order)
    # By one step, as the menu does it.
    session.selected.set_layer("Logo")
    for action, order in (
        ("raiseLayer", ["Text", "Background", "Logo", "Draft notes"]),
        ("raiseLayer", ["Text", "Logo", "Background", "Draft notes"]),
        ("raiseLayer", ["Logo", "Text", "Background", "Draft notes"]),
        ("lowerLayer", ["Text", "Logo", "Background", "Draft notes"]),
    ):
        drawing.trigger(action)
        assert rows(drawing) == order
        assert saved(drawing, tmp_path / "brand.svg") == (order, order)
    while session.undo_stack.canUndo():
        drawing.trigger("undo")
    assert rows(drawing) == begun
    assert saved(drawing, tmp_path / "brand.svg") == (begun, begun)
