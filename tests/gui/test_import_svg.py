"""Drawings of other programs come into the window, and go out again, with all that makes their look."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialog, QFileDialog, QMessageBox, QToolButton

from app.document.clones import original_of
from app.document.contents import is_content
from app.document.edits import move_points, set_family, set_position
from app.document.guide_edits import add_guide
from app.document.model import Axis, Document, Page, make_curve
from app.document.style import Style
from app.exchange.corner import from_lower_left
from app.exchange.options import Options
from app.exchange.reading import import_file
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.families import LAGRANGE
from app.features.import_export.commands import ImportCommands
from app.features.import_export.export_commands import ExportCommands
from app.testing import spin
from app.workbench.document_files import DocumentFiles
from app.workbench.file_names import title_of

SVG = Path(__file__).parents[1] / "data" / "svg"
CTRL = Qt.KeyboardModifier.ControlModifier
INCH = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="1in" height="1in" viewBox="0 0 4 4">'
    '<path id="a" d="M0 0L4 0L4 4Z" fill="#00ff00" stroke="#ff0000" stroke-width="1"/></svg>'
)

pytestmark = pytest.mark.usefixtures("drawings_read_here")


def opened(editor, path):
    editor.window.commands[ImportCommands].import_files([path])
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    assert dialog is not None, editor.message
    drawn(editor, dialog)
    return dialog


def drawn(editor, dialog):
    """Wait until the picture of a dialog is there."""
    while dialog.jobs.is_busy:
        spin(5)
    editor.settle()


def imported(editor, path):
    dialog = opened(editor, path)
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    return editor.session.document


def colours_in(dialog):
    image = dialog.picture.picture.pixmap().toImage()
    places = [(x, y) for x in range(0, image.width(), 2) for y in range(0, image.height(), 2)]
    return {image.pixelColor(x, y).name() for x, y in places}


def blank(editor):
    editor.session.new()
    editor.settle()


def test_the_dialog_shows_the_drawing_with_its_colours_and_its_size(editor):
    dialog = opened(editor, SVG / "inkscape_logo.svg")
    assert {"#2e7d32", "#c62828", "#0277bd"} <= colours_in(dialog)
    assert dialog.picture.size_label.text() == "70 × 50 mm"
    assert dialog.missed is None
    tree = dialog.groups
    names = [tree.topLevelItem(row).text(0) for row in range(tree.topLevelItemCount())]
    assert names == ["Leaves", "Ring", "Sketch"]
    # A group that is not taken is not shown.
    place = tree.visualItemRect(tree.topLevelItem(0))
    QTest.mouseClick(
        tree.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(place.left() + 10, place.center().y())
    )
    drawn(editor, dialog)
    assert "#2e7d32" not in colours_in(dialog)
    assert "#c62828" in colours_in(dialog)
    dialog.close()


def test_a_drawing_for_dark_paper_is_shown_on_dark_paper(editor):
    dialog = opened(editor, SVG / "material_favorite.svg")
    assert {"#15181c", "#e8eaed"} <= colours_in(dialog)
    dialog.close()


def test_what_comes_in_otherwise_is_listed_before(editor):
    dialog = opened(editor, SVG / "tabler_home.svg")
    assert dialog.missed.topLevelItemCount() == 1
    row = dialog.missed.topLevelItem(0)
    assert [row.text(column) for column in range(3)] == [
        "<path> (element 2)", "it has neither a stroke nor a fill", "left out",
    ]  # fmt: skip
    assert dialog.missed.isVisible()
    assert dialog.missed.height() >= dialog.missed.sizeHint().height()
    dialog.close()


def test_a_circle_of_four_arcs_comes_in_as_four_points(editor, tmp_path):
    """And neither as the pieces of its arcs, nor with the point where it closes twice."""
    arcs = "M80 30A15 15 0 0 1 65 45A15 15 0 0 1 50 30A15 15 0 0 1 65 15A15 15 0 0 1 80 30Z"
    (tmp_path / "ring.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80">'
        f'<path id="ring" d="{arcs}" stroke="#c62828"/>'
        '<rect width="9" height="9"/></svg>'
    )
    blank(editor)
    dialog = opened(editor, tmp_path / "ring.svg")
    row = dialog.groups.topLevelItem(0)
    assert [row.text(column) for column in range(2)] == ["ring", "4 points"]
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    ring = editor.session.document.curves[0]
    assert [point.position for point in ring.points] == [(80, 50), (65, 35), (50, 50), (65, 65)]
    assert ring.closed
    assert not any(point.corner for point in ring.points)


def test_a_new_document_takes_unit_and_page_of_the_drawing(editor):
    blank(editor)
    document = imported(editor, SVG / "inkscape_logo.svg")
    assert (document.unit, document.page) == ("mm", Page(0.0, 0.0, 70.0, 50.0))
    shown = {curve.name: curve for curve in document.curves}
    assert [curve.groups for curve in document.curves if curve.name == "Leaf"] == [
        ("Leaves", "Left pair"),
        ("Leaves", "use300"),
    ]
    assert shown["Leaf"].style.fill == "#2e7d32"
    assert {curve.shape for curve in document.curves if curve.style.fill == "#c62828"} == {"path400"}
    assert (shown["path600"].visible, shown["path600"].locked) == (False, True)
    editor.trigger("undo")
    assert (editor.session.document.unit, editor.session.document.page) == ("", None)


def test_the_first_sketch_gives_way_to_a_drawing_as_long_as_nobody_touched_it(editor):
    session, sketch = editor.session, editor.session.document
    session.files.begin(sketch)
    for _ in range(2):
        document = imported(editor, SVG / "inkscape_logo.svg")
        assert (document.unit, document.page) == ("mm", Page(0.0, 0.0, 70.0, 50.0))
        assert "Sketch" not in {curve.name for curve in document.curves}
        assert (title_of(session), session.files.is_modified) == ("inkscape_logo", True)
        # Whole, as what comes to others: ready to be moved. What nobody may move stays out.
        free = {place for place, curve in enumerate(document.curves) if curve.is_free}
        assert session.selected.chosen == free < set(range(len(document.curves)))
        before = document.curves[min(free)].points[0].x
        editor.key(Qt.Key.Key_Right)
        assert session.document.curves[min(free)].points[0].x > before
        editor.trigger("undo")
        editor.trigger("undo")
        assert (session.document, title_of(session)) == (sketch, "Untitled")
    editor.drag_point(0, to=(0.0, 0.0))
    document = imported(editor, SVG / "inkscape_logo.svg")
    assert (document.curves[0].name, document.unit, document.page) == ("Sketch", "", None)


GUIDED = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="48mm" height="48mm" viewBox="0 0 48 48" '
    'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"><sodipodi:namedview>'
    '<sodipodi:guide position="3,0" orientation="1,0"/><sodipodi:guide position="0,5" orientation="0,1"/>'
    '</sodipodi:namedview><path d="M0 0L4 0" stroke="#ff0000"/></svg>'
)


@pytest.mark.parametrize(
    ("unit", "said"),
    [
        ("", "Its page, its unit mm and 2 guides stay behind."),
        ("in", "Lengths are converted from mm to in. Its page and 2 guides stay behind."),
    ],
)
def test_what_stays_behind_of_a_drawing_beside_its_curves_is_said(editor, tmp_path, unit, said):
    """Page, unit and guides were dropped without a word."""
    blank(editor)
    path = tmp_path / "guided.svg"
    path.write_text(GUIDED, encoding="utf-8")
    dialog = opened(editor, path)
    # To a document without curves all of it comes along.
    assert dialog.rest.isHidden()
    dialog.close()
    curve = make_curve(((0, 0), (1, 1), (2, 0)))
    editor.session.commit(Document((curve,), unit=unit), "Begin")
    dialog = opened(editor, path)
    assert (dialog.rest.isVisible(), dialog.rest.text()) == (True, said)
    QTest.keyClick(dialog.into, Qt.Key.Key_Down)
    assert dialog.rest.isHidden()
    QTest.keyClick(dialog.into, Qt.Key.Key_Up)
    assert dialog.rest.isVisible()
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.status == f"Imported guided.svg: 1 curve, 2 points, exact. {said}"
    document = editor.session.document
    assert (document.unit, document.page, document.guides) == (unit, None, ())


def test_what_open_shows_is_opened_and_into_this_document_imported(editor, tmp_path, monkeypatch):
    """The dialog of Ctrl+O was titled “Import”; it comes where something is otherwise than drawn."""
    path = tmp_path / "poster.svg"
    path.write_text(INCH.replace("</svg>", "<foreignObject/></svg>"), encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    editor.key(Qt.Key.Key_O, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    drawn(editor, dialog)
    assert (dialog.windowTitle(), dialog.ok.text()) == ("Open poster.svg", "Open")
    QTest.keyClick(dialog.into, Qt.Key.Key_Up)
    assert dialog.ok.text() == "Import"
    QTest.keyClick(dialog.into, Qt.Key.Key_Down)
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.status.startswith("Opened poster.svg: 1 curve, ")


def test_a_drawing_of_which_all_comes_in_opens_without_a_question(editor, tmp_path, monkeypatch):
    """Every file of another program was asked about, also where there was nothing to say."""
    path = tmp_path / "poster.svg"
    path.write_text(INCH, encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    editor.key(Qt.Key.Key_O, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    assert editor.status == "Opened poster.svg: 1 curve, 3 points, exact."
    assert editor.session.files.foreign.path == path
    assert not editor.session.undo_stack.canUndo()
    # What is imported may be put on either document, in part: that is asked.
    dialog = opened(editor, path)
    assert dialog.windowTitle() == "Import poster.svg"


def test_open_takes_a_drawing_as_a_document_of_its_own(editor, tmp_path, monkeypatch):
    editor.session.files.begin(editor.session.document)
    editor.drag_point(0, to=(0.0, 0.0))
    path = tmp_path / "badge.svg"
    path.write_text(INCH, encoding="utf-8")
    asked, saved = [], []
    monkeypatch.setattr(
        QFileDialog, "getOpenFileName", lambda *words: (asked.append(words[3]), (str(path), ""))[1]
    )
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *words: (saved.append(words[2]), ("", ""))[1])
    monkeypatch.setattr(DocumentFiles, "_ask_about_changes", lambda _: QMessageBox.StandardButton.Discard)
    editor.trigger("openDocument")
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    session = editor.session
    assert ("*.svg" in asked[0], "*.curve.json" in asked[0]) == (True, True)
    assert ([curve.name for curve in session.document.curves], session.document.unit) == (["a"], "in")
    assert (session.files.is_modified, session.undo_stack.canUndo()) == (False, False)
    title = editor.window.windowTitle
    assert title() == "badge.svg[*] – Curvebench"
    # It is the document's file.
    move_first_point(editor, 7.0)
    assert editor.window.isWindowModified()
    save(editor)
    document = session.document
    assert (saved, title(), editor.message) == ([], "badge.svg[*] – Curvebench", "")
    assert (editor.window.isWindowModified(), session.files.is_modified) == (False, False)
    assert editor.status == "Wrote badge.svg, exact. What it was is kept as badge.svg.before.bak."
    assert (tmp_path / "badge.svg.before.bak").read_text(encoding="utf-8") == INCH
    back = import_file(path).document
    assert [each.position for each in back.curves[0].points] == [(7, 0), (1, 1), (1, 0)]
    assert (back.curves[0].style, back.unit, back.page) == (document.curves[0].style, "in", document.page)
    # Another time nothing of it is lost.
    move_first_point(editor, 8.0)
    overwrite(editor)
    assert (editor.status, session.files.is_modified) == ("Wrote badge.svg, exact.", False)
    editor.trigger("undo")
    assert session.files.is_modified
    editor.trigger("saveDocumentAs")
    assert saved == [str(path)]
    assert sorted(each.name for each in tmp_path.iterdir()) == ["badge.svg", "badge.svg.before.bak"]


def test_an_opened_drawing_is_among_the_recent_ones_and_opens_from_there(editor, tmp_path):
    path = tmp_path / "badge.svg"
    path.write_text(INCH.replace("</svg>", "<foreignObject/></svg>"), encoding="utf-8")
    open_as_document(editor, path)
    beginning, recent = editor.session.files.beginning, editor.window.menus.recent
    recent.aboutToShow.emit()
    first = recent.actions()[0]
    assert first.text().replace("&", "") == "badge.svg"
    # What was open before is shown at once; what of it is otherwise is said.
    first.trigger()
    editor.wait_for_work()
    assert editor.window.findChild(QDialog, "importDrawingDialog") is None
    assert editor.status == "Opened badge.svg: 1 curve, 3 points, exact. 1 element otherwise than drawn."
    assert editor.session.files.beginning is not beginning
    assert editor.session.files.foreign.path == path


def test_what_a_drawing_cannot_keep_is_asked_about_once(editor, tmp_path, monkeypatch):
    path = tmp_path / "badge.svg"
    path.write_text(INCH, encoding="utf-8")
    open_as_document(editor, path)
    session, asked = editor.session, []
    session.change("Family", lambda document: set_family(document, 0, LAGRANGE))
    save(editor)
    assert (editor.message, editor.status) == (
        "badge.svg cannot keep “a” as Lagrange.",
        "badge.svg is not saved yet.",
    )
    bar = editor.window.message_bar
    buttons = [bar.findChild(QToolButton, name) for name in ("offeredAction", "secondOffer")]
    assert [each.text() for each in buttons if each.isVisible()] == ["Overwrite “badge.svg”", "Save As"]
    assert path.read_text(encoding="utf-8") == INCH

    def answer(question):
        question.show()
        asked.append([question.informativeText(), *(each.text() for each in question.buttons())])
        return answers.pop()

    monkeypatch.setattr(QMessageBox, "exec", answer)
    kinds = QMessageBox.StandardButton
    answers = [kinds.Save, kinds.Cancel]
    assert not editor.window.context.files.may_discard()
    assert asked[0][0] == "badge.svg cannot keep “a” as Lagrange."
    assert {"Save in badge.svg", "Save As…"} < set(asked[0])
    # Closing waits until it is written.
    assert editor.window.context.files.may_discard()
    assert (session.files.is_modified, path.read_text(encoding="utf-8") == INCH) == (False, False)
    # From now on that is where it is saved.
    move_first_point(editor, 7.0)
    save(editor)
    assert (editor.message, session.files.is_modified) == ("", False)
    assert editor.status.startswith("Wrote badge.svg, ")


def opened_with_more(editor, tmp_path):
    """Open a file that holds more than curves; return its place and what it holds."""
    path = tmp_path / "layers.svg"
    cut = '<clipPath id="c"><text>Hi</text></clipPath><text id="Title" x="1" y="2">Hi</text>'
    whole = INCH.replace("<path ", f'{cut}<path clip-path="url(#c)" ')
    path.write_text(whole, encoding="utf-8")
    open_as_document(editor, path)
    return path, whole


def open_as_document(editor, path):
    blank(editor)
    editor.window.commands[ImportCommands].import_files([path], opened=path)
    editor.wait_for_work()
    if dialog := editor.window.findChild(QDialog, "importDrawingDialog"):
        drawn(editor, dialog)
        QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.settle()


def save(editor):
    editor.window.activateWindow()
    editor.settle()
    editor.key(Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    editor.wait_for_work()


def overwrite(editor):
    # No window manager does it where there is no screen.
    editor.window.activateWindow()
    editor.settle()
    editor.key(Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier)
    editor.wait_for_work()


def test_overwrite_keeps_what_did_not_come_in(editor, tmp_path):
    """It wrote the whole file anew, without its texts and clip paths."""
    path, whole = opened_with_more(editor, tmp_path)
    overwrite(editor)
    assert path.read_text(encoding="utf-8") == whole
    assert editor.status == "layers.svg is like this already."
    assert list(tmp_path.iterdir()) == [path]
    for x, data in ((0.25, "M 1 4 "), (0.5, "M 2 4 ")):
        move_first_point(editor, x)
        overwrite(editor)
        assert editor.status.startswith("Wrote layers.svg, exact; 1 thing that had not come in is as before.")
        assert (tmp_path / "layers.svg.before.bak").read_text(encoding="utf-8") == whole
        found = path.read_text(encoding="utf-8")
        before, after = whole.split(' d="')[0], whole.split(' d="')[1].partition('"')[2]
        assert found.startswith(f'{before} d="{data}')
        assert found.endswith(after)
    (_, back), (_, mine) = import_file(path).document.curves, editor.session.document.curves
    assert [each.position for each in back.points] == [each.position for each in mine.points]


def test_one_path_that_is_dragged_is_all_that_changes_in_a_file_of_inkscape(editor, tmp_path):
    """Layers, text, clips, filters, clones, guides and names of what was not touched stay as they were."""
    path, whole = tmp_path / "badge.svg", SVG.parent / "overwrite" / "badge.svg"
    before = whole.read_text(encoding="utf-8").splitlines()
    path.write_bytes(whole.read_bytes())
    open_as_document(editor, path)
    # The middle of the wave, from the lower left corner of the page.
    editor.escape()
    editor.drag((32, 24.5), to=(37, 27))
    assert editor.session.undo_stack.undoText() == "Move wave"
    overwrite(editor)
    after = path.read_text(encoding="utf-8").splitlines()
    changed = [line.strip() for line in before if line not in after]
    assert changed == ['d="m 20,60 c 5,-10 15,-10 20,0"']
    (course,) = [line.strip() for line in after if line not in before]
    assert [float(each) for each in course.split()[1:3]] == pytest.approx([25, 57.5], abs=0.5)
    assert "became" not in editor.status
    # A clone is one as long as it can be; else the status line tells of it.
    names = [curve.name for curve in editor.session.document.curves]
    place = names.index("use1")
    editor.session.change("Move", lambda document: move_points(document, place, [0], (1.0, 0.0)))
    overwrite(editor)
    assert "The clone “use1” became a path, because its own points were moved." in editor.status


def test_overwrite_asks_before_it_changes_what_another_program_has_written(editor, tmp_path):
    path, whole = opened_with_more(editor, tmp_path)
    theirs = whole.replace("</svg>", "<text>theirs</text></svg>\n")
    path.write_text(theirs, encoding="utf-8")
    editor.session.change("Guide", lambda document: add_guide(document, Axis.X, 1.0))
    overwrite(editor)
    assert editor.message == (
        "layers.svg was changed by another program since it was opened here. Overwrite again to put these "
        "curves into what it holds now, of which a copy is kept."
    )
    assert path.read_text(encoding="utf-8") == theirs
    overwrite(editor)
    assert import_file(path).document.guides == editor.session.document.guides
    assert "<text>theirs</text></svg>\n" in path.read_text(encoding="utf-8")
    assert editor.status.endswith("kept as layers.svg.before.bak.")
    assert (tmp_path / "layers.svg.before.bak").read_text(encoding="utf-8") == theirs


def test_overwrite_says_before_it_writes_what_would_be_lost(editor, tmp_path):
    """It wrote a file without its texts and clip paths at the first press, and called that exact."""
    path, whole = opened_with_more(editor, tmp_path)
    # What has no page is written anew, as large as its curves.
    editor.session.change("Page", lambda document: replace(document, page=None))
    told = (
        "1 thing in layers.svg did not come in as drawn and would be lost: "
        "<path> “a” (a clip path cuts some of it off). Overwrite again to write it without it."
    )
    for x in (0.25, 0.5):
        # Asked anew of another drawing.
        move_first_point(editor, x)
        overwrite(editor)
        assert editor.message == told
        assert editor.status == "layers.svg is not written yet."
        assert path.read_text(encoding="utf-8") == whole
    button = editor.window.message_bar.findChild(QToolButton, "offeredAction")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor.wait_for_work()
    assert editor.status == (
        "Wrote layers.svg without 1 thing that had not come in. What it was is kept as layers.svg.before.bak."
    )
    assert editor.message == ""
    assert "deviation" not in path.read_text(encoding="utf-8")
    (_, back), (_, mine) = import_file(path).document.curves, editor.session.document.curves
    assert [each.position for each in back.points] == [each.position for each in mine.points]
    # Now there is nothing left to lose.
    overwrite(editor)
    assert editor.status == "Wrote layers.svg, exact."


def test_what_was_not_opened_from_a_file_has_none_to_overwrite(editor, tmp_path):
    blank(editor)
    path = tmp_path / "inch.svg"
    path.write_text(INCH, encoding="utf-8")
    imported(editor, path)
    assert not editor.action("overwriteForeign").isEnabled()


def move_first_point(editor, x):
    place = next(at for at, each in enumerate(editor.session.document.curves) if not is_content(each))
    editor.session.change("Move", lambda document: set_position(document, place, 0, (x, 0.0)))


def test_very_many_shapes_without_a_group_come_together(editor, tmp_path):
    """From 501 paths on, a file without groups ended in a KeyError in place of the dialog."""
    blank(editor)
    path = tmp_path / "many.svg"
    lines = "".join(f'<path d="M{k} 0V1"/>' for k in range(501))
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{lines}</svg>', encoding="utf-8")
    dialog = opened(editor, path)
    assert dialog.groups.topLevelItemCount() == 1
    QTest.mouseClick(dialog.ok, Qt.MouseButton.LeftButton)
    editor.wait_for_work()
    assert len(editor.session.document.curves) == 501


def test_an_inch_is_an_inch_in_a_document_of_millimetres(editor, tmp_path):
    blank(editor)
    begun = Document((make_curve([(0.0, 0.0), (9.0, 9.0)]),), unit="mm")
    editor.session.change("Begin", lambda _: begun)
    path = tmp_path / "inch.svg"
    path.write_text(INCH, encoding="utf-8")
    document = imported(editor, path)
    assert (document.unit, document.page, len(document.curves)) == ("mm", None, 2)
    assert document.curves[1].points[1].x == pytest.approx(25.4)
    assert document.curves[1].style.width == pytest.approx(6.35)


def test_an_icon_goes_out_as_large_as_it_came_in(editor, tmp_path):
    """Recoloured, it is the same icon."""
    blank(editor)
    imported(editor, SVG / "lucide_leaf.svg")
    red = Style(stroke="#ff0000")
    editor.session.change(
        "Recolour",
        lambda document: replace(
            document,
            curves=tuple(
                replace(curve, style=replace(curve.style, stroke=red.stroke)) for curve in document.curves
            ),
        ),
    )
    editor.window.commands[ExportCommands].export(tmp_path / "out.svg")
    editor.wait_for_work()
    text = (tmp_path / "out.svg").read_text(encoding="utf-8")
    assert 'viewBox="0 0 24 24"' in text
    assert text.count('stroke="#ff0000" stroke-width="2" stroke-linecap="round"') == 4
    assert text.count("<rect") == text.count('width="6" height="4" rx="1"') == 1, "its own, and no paper"


def test_what_is_locked_or_hidden_is_not_chosen_when_it_comes_in(editor, tmp_path):
    """All that was opened was chosen, with a hidden ellipse in its ghost: nobody could move anything."""
    blank(editor)
    path = tmp_path / "layers.svg"
    path.write_text(LAYERS)
    document = imported(editor, path)
    selected = editor.session.selected
    assert selected.chosen == {place for place in range(5) if document.curves[place].is_free}
    assert editor.session.active_curve.is_free
    document = imported(editor, path)
    assert selected.chosen == {place for place in range(5, 10) if document.curves[place].is_free}
    assert len(selected.chosen) == 4
    # Page upon page.
    assert [curve.points for curve in document.curves[5:]] == [curve.points for curve in document.curves[:5]]


LAYERS = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40"'
    ' xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    ' xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"><sodipodi:namedview>'
    '<sodipodi:guide position="15,0" orientation="1,0"/><sodipodi:guide position="0,10" orientation="0,-1"/>'
    '</sodipodi:namedview><g inkscape:groupmode="layer" inkscape:label="Back" id="a"'
    ' sodipodi:insensitive="true" style="display:none"><path id="ground" d="M0 0H60V40H0Z" fill="#eee"/></g>'
    '<g inkscape:groupmode="layer" inkscape:label="Art work" id="b"><path id="left" d="M5 5H20V20H5Z"'
    ' fill="#00aa00"/><path id="right" d="M40 5H55V20H40Z" fill="#aa0000"/><g id="pair"><path id="one"'
    ' d="M5 30H20V35H5Z" fill="#0000aa"/><path id="two" d="M40 30H55V35H40Z" fill="#0000aa"/></g></g></svg>'
)


def test_layers_and_guides_of_inkscape_come_in_and_go_out_again(editor, tmp_path):
    """A press took a whole layer, and layers went out as groups, open and shown, without the guides."""
    blank(editor)
    path = tmp_path / "layers.svg"
    path.write_text(LAYERS)
    document, selected = imported(editor, path), editor.session.selected
    assert document.layers == ("Back", "Art work")
    # What is drawn goes to the front, but not where it may not.
    assert selected.layer == "Art work"

    def press(x, y):
        for _ in range(3):
            editor.escape()
        place = document.page.y + document.page.height - y
        editor.click((x, place))
        return {
            editor.session.document.curves[i].name for i in selected.choice.chosen or {selected.choice.active}
        }

    assert press(12, 12) == {"left"}
    assert press(47, 12) == {"right"}
    assert press(12, 32) == {"one", "two"}
    # No layer is taken apart or taken whole by what concerns groups.
    editor.trigger("ungroupCurves")
    press(12, 12)
    assert not editor.action("ungroupCurves").isEnabled()
    selected.choose((1, 3))
    editor.trigger("groupCurves")
    document = editor.session.document
    assert [curve.groups for curve in document.curves if "Group 1" in curve.groups] == [
        ("Art work", "Group 1")
    ] * 2
    text = svg_of(document, Options(unit="mm")).text
    assert (
        '<g id="Back" inkscape:groupmode="layer" inkscape:label="Back" sodipodi:insensitive="true"'
        ' style="display:none">' in text
    )
    assert '<g id="Art_work" inkscape:groupmode="layer" inkscape:label="Art work">' in text
    assert text.count("insensitive") == text.count("display") == 1
    # What stands above the origin here hangs below it there.
    assert (document.page.y, min(point.y for curve in document.curves for point in curve.points)) == (0, 0)
    assert '<path id="left" d="M 5 5' in text
    again = from_lower_left(read_svg(text.encode()).document)
    assert again.layers == document.layers
    assert len(again.guides) == 2
    assert set(again.guides) == set(document.guides)
    assert [(each.locked, each.visible) for each in again.curves] == [(True, False)] + [(False, True)] * 4


def test_closing_saves_to_the_opened_drawing_before_the_window_goes(new_editor, tmp_path, monkeypatch):
    # Its own: it is closed.
    editor = new_editor
    path, asked = tmp_path / "badge.svg", []
    path.write_text(INCH, encoding="utf-8")
    open_as_document(editor, path)
    move_first_point(editor, 7.0)
    kinds = QMessageBox.StandardButton
    answers = [kinds.Save, kinds.Cancel]
    monkeypatch.setattr(
        DocumentFiles, "_ask_about_changes", lambda _: asked.append(1) or answers[len(answers) - len(asked)]
    )
    monkeypatch.setattr(editor.window, "asks_before_closing", True)
    editor.window.activateWindow()
    editor.settle()
    editor.key(Qt.Key.Key_Q, Qt.KeyboardModifier.ControlModifier)
    assert (len(asked), editor.window.isVisible(), path.read_text(encoding="utf-8")) == (1, True, INCH)
    closed = []
    editor.window.closed.connect(lambda: closed.append(1))
    editor.window.actions_by_name["quit"].trigger()
    assert (len(asked), closed, editor.session.files.is_modified) == (2, [1], False)
    assert path.read_text(encoding="utf-8") != INCH


def test_clones_of_an_svg_are_followed_copied_and_written_as_such(editor, tmp_path):
    """Copied with its original one follows the copy; and none is lost by the name that it has of another."""
    path, session = tmp_path / "clones.svg", editor.session
    before = (SVG.parent / "overwrite" / "clones.svg").read_text(encoding="utf-8")
    path.write_text(before, encoding="utf-8")
    open_as_document(editor, path)
    editor.window.activateWindow()
    editor.settle()

    def originals():
        document = session.document
        return [original_of(document, place) for place in range(len(document.curves))]

    for copies, expected in (
        ([(Qt.Key.Key_D, CTRL)], [-1, 0, -1, 2, 0, 4, -1, -1, 6, 7, -1, -1]),
        ([(Qt.Key.Key_C, CTRL), (Qt.Key.Key_V, CTRL)], [-1, 0, 0, 2, -1, -1, 4, 5, -1, -1, -1, 10]),
    ):
        session.selected.choose([0, 1])
        editor.settle()
        for key in copies:
            editor.key(*key)
            editor.wait_for_work()
        assert originals() == expected
        assert "clone" not in editor.status
        editor.trigger("undo")
    session.selected.choose([4, 5])
    editor.settle()
    editor.key(Qt.Key.Key_D, Qt.KeyboardModifier.AltModifier)
    assert editor.status == "A clone of pair lies on it and is chosen; a drag moves it."
    session.change("Bend", lambda document: move_points(document, 0, [0], (1.0, 1.0)))
    overwrite(editor)
    assert editor.status.startswith("Wrote clones.svg, exact. ")
    text = path.read_text(encoding="utf-8")
    assert text.count("<use") == before.count("<use") + 2
    assert [line for line in before.splitlines() if "<use" in line and line not in text] == []
    overwrite(editor)
    assert editor.status == "clones.svg is like this already."
