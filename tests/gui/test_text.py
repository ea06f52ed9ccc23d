"""The Text tool: a click, words typed on the canvas, and the outlines of their letters as curves."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontDatabase
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLabel, QLineEdit, QToolButton

from app.document.edits import move_points
from app.document.lines import is_line
from app.document.model import Document, make_curve
from app.document.several_curves import mapped, remove_curves, whole_curves
from app.document.style import NO_PAINT, PLAIN_STYLE, FillRule
from app.document.text import TextAlign
from app.document.transforms import Affine
from app.families import HERMITE
from app.features.import_export.export_commands import ExportCommands
from app.features.text.commands import TextCommands
from app.features.text.font_box import FontBox
from app.qt.glyphs import Face, outlines_of
from app.view_model.curve.curve_view import view_of

FONT = Path(__file__).parents[1] / "data" / "fonts" / "blocks.ttf"
FAMILY = "Curvebench Blocks"
RED = replace(PLAIN_STYLE, stroke="#aa0000", width=2.0)
AT = (1.0, 1.0)


@pytest.fixture
def drawing(editor, qapp):
    """A red line, millimetres, a font whose letters are known; the text tool is in use and nothing snaps."""
    assert QFontDatabase.applicationFontFamilies(QFontDatabase.addApplicationFont(str(FONT))) == [FAMILY]
    commands = editor.window.commands[TextCommands]
    line = replace(make_curve([(0, 3), (1, 4), (2, 3)]), style=RED)
    editor.session.commit(Document((line,), unit="mm"), "Begin")
    editor.window.canvas.camera.show_box((-1, 9), (-3, 5))
    editor.settle()
    face = commands.field.face
    editor.trigger("textTool")
    yield editor
    if commands.field.isVisible():
        press(editor, Qt.Key.Key_Escape)
    # As a new window would have them.
    choose_font(commands.field, face.family)
    for button in (commands.field.bold, commands.field.italic):
        button.setChecked(False)
    preferences = editor.window.preferences
    preferences.text_font, preferences.text_bold, preferences.text_italic = "", False, False
    # The size is that of this document.
    editor.new()


def field(editor):
    return editor.window.commands[TextCommands].field


def choose_font(shown, family):
    line = shown.font_box.lineEdit()
    line.setFocus()
    line.selectAll()
    QTest.keyClicks(line, family)
    QTest.keyClick(line, Qt.Key.Key_Return)


def type_size(editor, text):
    edit = field(editor).size_box.edit
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    press(editor, Qt.Key.Key_Return)


def begin(editor, place=AT, size="2"):
    """Click at a place, and take the font and a size; return where exactly the baseline begins."""
    editor.click(place)
    choose_font(field(editor), FAMILY)
    type_size(editor, size)
    canvas = editor.window.canvas
    return canvas.to_plane(canvas.to_pixel(*place))


def write(editor, text):
    QTest.keyClicks(QApplication.focusWidget(), text)
    editor.settle()


def press(editor, key, keys=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(QApplication.focusWidget(), key, keys)
    editor.settle()


def finish(editor):
    """Keep what is typed."""
    press(editor, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)


def letters(editor):
    return [curve for curve in editor.session.document.curves if curve.style.has_fill]


def places(curve, start, size=2.0):
    """The points of a curve in units of the font, of which the size has 1000."""
    return [((p.x - start[0]) * 1000 / size, (p.y - start[1]) * 1000 / size) for p in curve.points]


def close_to(points):
    return [pytest.approx(point, abs=1e-9) for point in points]


def test_typed_words_become_filled_shapes_of_true_size_in_one_step(drawing):
    before, steps = drawing.session.document, drawing.session.undo_stack.count()
    start = begin(drawing)
    assert drawing.session.document == before
    write(drawing, "I")
    assert [curve.name for curve in letters(drawing)] == ["I"]  # live
    write(drawing, "o I fi")
    finish(drawing)
    assert (drawing.session.undo_stack.undoText(), drawing.session.undo_stack.count()) == (
        "Add Text “Io I fi”", steps + 1
    )  # fmt: skip
    made = letters(drawing)
    assert [curve.name for curve in made] == ["I", "o (1)", "o (2)", "I", "fi (1)", "fi (2)", "fi (3)"]
    assert [curve.shape for curve in made] == ["", "o", "o", "", "fi", "fi", "fi"]
    style = replace(RED, stroke=NO_PAINT, fill="#aa0000", fill_rule=FillRule.NONZERO)
    assert all(curve.family is HERMITE and curve.is_closed for curve in made)
    assert {(curve.groups, curve.style) for curve in made} == {(("Io I fi",), style)}
    upright, ring, hole, *_, stem, _, dot = made
    assert places(upright, start) == close_to([(100, 0), (100, 700), (300, 700), (300, 0)])
    assert all(point.corner for point in upright.points)
    assert all(is_line(upright, segment) for segment in range(4))
    # Kerned: "I" takes 400 units, 100 less before an "o"; smooth wherever the font is.
    assert max(x for x, _ in places(ring, start)) == pytest.approx(300 + 550, abs=1e-9)
    assert max(x for x, _ in places(hole, start)) == pytest.approx(300 + 450, abs=1e-9)
    assert not any(point.corner for point in (*ring.points, *hole.points))
    # A ligature is one shape: the dot lies where that of the font does.
    offset = 300 + 600 + 300 + 400 + 300
    assert places(stem, start)[0] == pytest.approx((offset + 50, 0), abs=1e-9)
    assert places(dot, start)[0] == pytest.approx((offset + 350, 600), abs=1e-9)
    assert drawing.session.selected.chosen == frozenset(range(1, 8))
    assert not field(drawing).isVisible()
    drawing.trigger("undo")
    assert drawing.session.document == before


def test_a_round_letter_is_the_curve_of_the_font(drawing):
    start = begin(drawing)
    write(drawing, "o")
    finish(drawing)
    ring, _ = letters(drawing)
    assert ring.groups == ()
    view = view_of(ring)
    found = (view.curve.evaluate(np.linspace(*view.curve.domain, 801)) - start) * 500 - (300, 250)
    # The parabolas of the outline, by their control points; two of them end halfway between each two.
    corners = np.array([(250, 102), (102, 250), (-102, 250), (-250, 102)])
    corners = np.vstack([corners, -corners])
    ends, s = (corners + np.roll(corners, -1, axis=0)) / 2, np.linspace(0, 1, 400)[:, None]
    own = np.vstack([
        (1 - s) ** 2 * ends[i - 1] + 2 * s * (1 - s) * corners[i] + s**2 * ends[i] for i in range(8)
    ])  # fmt: skip
    far = np.hypot(*(found[:, None] - own[None]).transpose(2, 0, 1)).min(axis=1)
    # Between two of the 400 places of a parabola of some 200 units there lie 0.5.
    assert far.max() < 0.3


def test_escape_gives_it_up_and_a_click_elsewhere_makes_it(drawing):
    before, steps = drawing.session.document, drawing.session.undo_stack.count()
    choice = drawing.session.selected.choice
    begin(drawing)
    write(drawing, "Io")
    assert len(drawing.session.document.curves) == 4
    press(drawing, Qt.Key.Key_Escape)
    assert (drawing.session.document, drawing.session.undo_stack.count()) == (before, steps)
    assert drawing.session.selected.choice == choice
    assert drawing.window.canvas.hasFocus()
    assert drawing.action("textTool").isChecked()
    drawing.click(AT)
    assert field(drawing).text == ""
    write(drawing, "I")
    drawing.click((5.0, 3.5))
    assert drawing.session.undo_stack.undoText() == "Add Text “I”"
    assert field(drawing).isVisible()
    # Nothing typed makes nothing.
    finish(drawing)
    assert drawing.session.undo_stack.count() == steps + 1
    # The last font and size are those of the next text.
    assert field(drawing).face.family == FAMILY
    assert field(drawing).size_box.em == 2.0


def test_lines_fonts_and_sizes_are_seen_at_once(drawing):
    start = begin(drawing, size="1 in")
    write(drawing, "I")
    press(drawing, Qt.Key.Key_Return)
    write(drawing, "I")
    upper, lower = letters(drawing)
    assert upper.points[1].y - start[1] == pytest.approx(0.7 * 25.4, abs=1e-12)
    # The font is 1200 high.
    assert places(lower, start, 25.4)[0] == pytest.approx((100, -1200), abs=1e-9)
    QTest.mouseClick(field(drawing).italic, Qt.MouseButton.LeftButton)
    drawing.settle()
    slanted = letters(drawing)[0]
    assert slanted.points[1].x > upper.points[1].x + 1
    QTest.mouseClick(field(drawing).bold, Qt.MouseButton.LeftButton)
    drawing.settle()
    # A font that is pointed at in the list is seen, and forgotten with the list.
    box, shown = field(drawing).font_box, letters(drawing)
    box.setFocus()
    box.showPopup()
    QTest.keyClick(box.view(), Qt.Key.Key_Up)
    drawing.settle()
    assert field(drawing).face.family != FAMILY
    QTest.keyClick(box.view(), Qt.Key.Key_Escape)
    drawing.settle()
    assert field(drawing).face.family == FAMILY
    assert letters(drawing) == shown
    remark = field(drawing).findChild(QLabel, "textRemark")
    assert remark.text() == f"⚠ “{FAMILY}” has no bold letters."
    type_size(drawing, "0")
    assert remark.text() == "⚠ A size is greater than 0."
    assert field(drawing).size_box.em == 25.4
    # The field stays in sight, whatever the size.
    type_size(drawing, "400")
    assert drawing.window.canvas.viewport().rect().contains(field(drawing).geometry())
    finish(drawing)
    assert drawing.session.undo_stack.undoText() == "Add Text “I I”"


def test_a_family_of_several_makers_is_listed_once_by_its_plain_name(qtbot):
    data, at = FONT.read_bytes(), FONT.read_bytes().index(b"????")
    fonts = [data[:at] + maker + data[at + 4 :] for maker in (b"ABCD", b"EFGH", b"IJKL")]
    added = [QFontDatabase.addApplicationFontFromData(font) for font in fonts[:2]]
    try:
        assert f"{FAMILY} [EFGH]" in QFontDatabase.families()
        box = FontBox(f"{FAMILY} [EFGH]")
        qtbot.addWidget(box)

        def listed():
            return [box.itemText(at) for at in range(box.count()) if box.itemText(at).startswith(FAMILY)]

        assert (listed(), box.currentText(), box.family) == ([FAMILY], FAMILY, FAMILY)
        # Fonts that are installed meanwhile are listed in the same way.
        added.append(QFontDatabase.addApplicationFontFromData(fonts[2]))
        qtbot.waitUntil(lambda: f"{FAMILY} [IJKL]" in QFontDatabase.families())
        assert (listed(), box.currentText()) == ([FAMILY], FAMILY)
        box.take(box.itemText(0))
        assert (box.family, listed()) == (box.itemText(0), [FAMILY])
        box.take(FAMILY)
        assert box.family == FAMILY
    finally:
        for each in added:
            QFontDatabase.removeApplicationFont(each)


def test_words_wait_when_something_else_changes_the_document(drawing):
    begin(drawing)
    write(drawing, "Io")
    drawing.session.change("Unit", lambda document: replace(document, unit="cm"))
    drawing.settle()
    assert not letters(drawing)
    assert not field(drawing).isVisible()
    drawing.click(AT)
    assert field(drawing).text == "Io"
    assert len(letters(drawing)) == 3
    drawing.trigger("undo")
    assert not letters(drawing)
    assert drawing.session.document.unit == "cm"


def test_an_empty_curve_gives_way(editor, drawing):
    editor.new()
    editor.trigger("textTool")
    begin(editor)
    write(editor, "I I")
    finish(editor)
    assert [curve.name for curve in editor.session.document.curves] == ["I", "I"]
    editor.trigger("undo")
    assert len(editor.session.document.curves) == 1


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the fonts are those of the system")
def test_without_fonts_there_are_no_letters_and_no_crash(tmp_path):
    none = tmp_path / "fonts.conf"
    none.write_text('<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd"><fontconfig></fontconfig>')
    code = (
        "from PySide6.QtWidgets import QApplication; QApplication([]); from app.qt import glyphs; "
        "print(glyphs.has_fonts(), len(glyphs.outlines_of('Io', glyphs.Face('Sans', bold=True)).glyphs))"
    )
    environment = {**os.environ, "FONTCONFIG_FILE": str(none), "QT_QPA_PLATFORM": "offscreen"}
    run = subprocess.run(  # noqa: PLW1510 - the code is asked for below
        [sys.executable, "-c", code], env=environment, cwd=FONT.parents[3], capture_output=True, text=True
    )
    assert (run.returncode, run.stdout) == (0, "False 0\n"), run.stderr


def test_a_text_comes_into_the_present_layer_behind_those_in_front(drawing):
    session = drawing.session
    front = replace(make_curve([(0, -1), (1, -2)], name="Front"), groups=("Above",))
    layers = Document((*session.document.curves, front), layers=("Ink", "Above"), unit="mm")
    session.change("Add layers", lambda _: layers)
    session.selected.set_layer("Ink")
    begin(drawing)
    write(drawing, "AV")
    finish(drawing)
    assert [curve.groups for curve in session.document.curves][1:] == [
        *[("Ink", "AV")] * (len(session.document.curves) - 2),
        ("Above",),
    ]
    assert letters(drawing)


def shown_places(editor):
    return {curve.name: [point.position for point in curve.points] for curve in letters(editor)}


def open_again(editor, place):
    """Double-click a letter with the arrow while no curve is edited."""
    editor.trigger("selectTool")
    editor.session.selected.choose(())
    editor.double_click(place)
    assert field(editor).isVisible()


def add_line(editor, text):
    press(editor, Qt.Key.Key_End)
    press(editor, Qt.Key.Key_Return)
    write(editor, text)


def test_a_text_is_edited_again_where_its_letters_are_now(drawing):
    session, steps = drawing.session, drawing.session.undo_stack.count()
    begin(drawing)
    write(drawing, "IV")
    finish(drawing)
    # Turned, sheared and moved; blue, and behind the line.
    places = [place for place, curve in enumerate(session.document.curves) if curve.style.has_fill]
    by = Affine(-1.0, -1.5, 1.0, -1.0, AT, (2.0, -1.0))
    session.change("Turn", lambda document: mapped(document, whole_curves(document, places), by))
    blue = replace(letters(drawing)[0].style, fill="#0000aa")
    session.change("Paint", lambda document: Document(
        (*(replace(document.curves[place], style=blue) for place in places), document.curves[0]), unit="mm"
    ))  # fmt: skip
    before, upright = session.document, shown_places(drawing)["I"]
    inside, shown = tuple(np.mean(upright, axis=0)), field(drawing)
    open_again(drawing, inside)
    assert (shown.text, shown.face.family) == ("IV", FAMILY)
    assert shown.size_box.em == pytest.approx(2 * np.sqrt(1.5))
    assert not shown.findChild(QLabel, "textRemark").isVisible()
    # As it was: nothing is done.
    finish(drawing)
    assert (session.document, session.undo_stack.count()) == (before, steps + 3)
    assert session.selected.chosen == {0, 1}
    drawing.trigger("textTool")
    drawing.click(inside)
    add_line(drawing, "I")
    assert len(letters(drawing)) == 3  # live
    press(drawing, Qt.Key.Key_Escape)
    assert (session.document, session.undo_stack.count()) == (before, steps + 3)
    drawing.click(inside)
    add_line(drawing, "I")
    finish(drawing)
    assert (session.undo_stack.undoText(), session.undo_stack.count()) == ("Edit Text “IV I”", steps + 4)
    made = session.document.curves
    assert [curve.name for curve in made] == ["I", "V", "I", before.curves[2].name]
    assert {(curve.groups, curve.style) for curve in made[:3]} == {(("IV I",), blue)}
    for new, old in zip(made[0].points, upright, strict=True):
        assert new.position == pytest.approx(old, abs=1e-9)
    # The second line is 1200 units down, where that leads now.
    down = by.vector((0.0, -1.2 * 2.0))
    for new, old in zip(made[2].points, upright, strict=True):
        assert new.position == pytest.approx(np.add(old, down), abs=1e-9)
    assert session.selected.chosen == {0, 1, 2}
    drawing.trigger("undo")
    assert session.document == before


def test_letters_changed_by_hand_are_told_of_and_written_anew_where_the_others_are(drawing):
    session = drawing.session
    begin(drawing)
    write(drawing, "IVI")
    finish(drawing)
    first, _, last = letters(drawing)
    session.change("Delete", lambda document: remove_curves(document, [2]))
    session.change("Shift", lambda document: mapped(
        document, whole_curves(document, [1, 2]), Affine(0.0, 0.0, 0.0, 0.0, AT, (0.0, -2.0))
    ))  # fmt: skip
    session.change("Pull", lambda document: move_points(document, 1, [0], (-0.3, 0.1)))
    drawing.trigger("selectTool")
    session.selected.choose({1, 2})
    drawing.window.canvas.setFocus()
    press(drawing, Qt.Key.Key_Return)
    remark = field(drawing).findChild(QLabel, "textRemark")
    assert remark.text() == "⚠ The letters were changed by hand; Ctrl+Enter writes them anew at this place."
    finish(drawing)
    assert session.undo_stack.undoText() == "Edit Text “IVI”"
    made = letters(drawing)
    assert [curve.name for curve in made] == ["I", "V", "I"]
    for old, new in ((first, made[0]), (last, made[2])):
        for here, there in zip(old.points, new.points, strict=True):
            assert there.position == pytest.approx((here.x, here.y - 2.0), abs=1e-9)


def test_a_file_tells_of_a_text_and_copies_are_texts_of_their_own(drawing, tmp_path):
    session, path = drawing.session, tmp_path / "text.curve.json"
    begin(drawing)
    write(drawing, "I")
    finish(drawing)
    session.save(path)
    assert path.read_bytes().count(b'"text": {"words": "I", "font": "Curvebench Blocks"') == 1
    assert path.read_bytes().count(b'"text"') == 1
    session.new()
    session.open(path)
    session.selected.choose({1})
    drawing.trigger("duplicateCurve")
    # Also while the points of a letter are edited.
    session.selected.activate(0)
    drawing.settle()
    assert not drawing.action("editText").isEnabled()
    session.selected.activate(2)
    drawing.trigger("editText")
    write(drawing, "VV")
    finish(drawing)
    assert [curve.name for curve in letters(drawing)] == ["I", "V", "V"]
    assert [curve.groups for curve in letters(drawing)] == [(), ("VV",), ("VV",)]


def save_as(editor, monkeypatch, path):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    editor.trigger("saveDocumentAs")
    editor.wait_for_work()
    return editor.message


def open_drawing(editor, path):
    editor.session.new()
    editor.window.context.files.open(path)
    editor.wait_for_work()
    editor.settle()


def edit_text(editor):
    """Edit the text again; return what its field begins with, and what it remarks."""
    names = [curve.name for curve in editor.session.document.curves]
    editor.session.selected.choose(range(names.index("I (1)" if "I (1)" in names else "I"), len(names)))
    editor.trigger("editText")
    shown = field(editor)
    remark = shown.findChild(QLabel, "textRemark")
    return shown.text, shown.face.family, shown.setting, "" if remark.isHidden() else remark.text()


@pytest.mark.usefixtures("drawings_read_here")
def test_a_text_is_edited_again_from_an_svg_saved_as_and_in_place(drawing, tmp_path, monkeypatch):
    """Its letters came back as paths, and a typo in a logo stayed one."""
    path = tmp_path / "logo.svg"
    begin(drawing)
    write(drawing, "IV")
    press(drawing, Qt.Key.Key_Return)
    write(drawing, "I")
    type_per_cent(drawing, "textLetterSpacing", "25")
    QTest.mouseClick(field(drawing).findChild(QToolButton, "textAlign_centre"), Qt.MouseButton.LeftButton)
    field(drawing).words.setFocus()
    finish(drawing)
    assert "plain" not in save_as(drawing, monkeypatch, path)
    open_drawing(drawing, path)
    assert edit_text(drawing) == ("IV\nI", FAMILY, (0.25, 1.0, TextAlign.CENTRE), "")
    # In place: other words, and the file says so.
    field(drawing).words.selectAll()
    write(drawing, "II")
    finish(drawing)
    drawing.trigger("saveDocument")
    drawing.wait_for_work()
    assert path.read_bytes().count(b"data-curvebench=") == 2
    open_drawing(drawing, path)
    assert edit_text(drawing) == ("II", FAMILY, (0.25, 1.0, TextAlign.CENTRE), "")
    press(drawing, Qt.Key.Key_Escape)
    # A letter that another program has made another shape is none; the other one is.
    found = path.read_text(encoding="utf-8")
    place = found.index(" d=", found.index("data-curvebench=")) + 4
    end = found.index('"', place)
    path.write_text(f"{found[:place]}M 0 0 L 9 0 L 2 7 L 5 5 Z{found[end:]}", encoding="utf-8")
    open_drawing(drawing, path)
    texts = [curve.text and curve.text.words for curve in drawing.session.document.curves]
    assert texts == [None, None, "II"]


def type_per_cent(editor, name, text):
    edit = field(editor).findChild(QLineEdit, name)
    edit.setFocus()
    edit.selectAll()
    QTest.keyClicks(edit, text)
    press(editor, Qt.Key.Key_Return)


def lefts(editor, start, size=2.0):
    """Where letters begin, and their baselines, in units of the font."""
    found = [np.array(places(curve, start, size)) for curve in letters(editor)]
    return [(float(each[:, 0].min()), float(each[:, 1].min())) for each in found]


def test_letters_are_spaced_and_lines_centred_live_and_again_when_the_text_is_edited(drawing, tmp_path):
    session, path = drawing.session, tmp_path / "set.curve.json"
    start = begin(drawing)
    write(drawing, "II")
    press(drawing, Qt.Key.Key_Return)
    write(drawing, "I")
    (left, _), (second, _), (_, lower) = plain = lefts(drawing, start)
    advance = second - left
    type_per_cent(drawing, "textLetterSpacing", "25")
    type_per_cent(drawing, "textLineSpacing", "150 %")
    assert lefts(drawing, start) == close_to([plain[0], (second + 250, 0), (left, 1.5 * lower)])
    QTest.mouseClick(field(drawing).findChild(QToolButton, "textAlign_centre"), Qt.MouseButton.LeftButton)
    drawing.settle()
    # The space behind the last letter is none of the line's.
    upper, short = -(2 * advance + 250) / 2, -advance / 2
    centred = close_to([(upper + left, 0), (upper + second + 250, 0), (short + left, 1.5 * lower)])
    assert lefts(drawing, start) == centred
    assert field(drawing).isVisible()
    field(drawing).words.setFocus()
    finish(drawing)
    made = session.document
    assert lefts(drawing, start) == centred

    session.save(path)
    session.new()
    session.open(path)
    assert session.document == made
    session.selected.choose(range(1, 4))
    drawing.trigger("editText")
    assert field(drawing).setting == (0.25, 1.5, TextAlign.CENTRE)
    # As it was: nothing is done.
    finish(drawing)
    assert session.document == made
    drawing.trigger("editText")
    QTest.mouseClick(field(drawing).findChild(QToolButton, "textAlign_right"), Qt.MouseButton.LeftButton)
    type_per_cent(drawing, "textLetterSpacing", "-200")
    assert "From −100 %" in field(drawing).findChild(QLabel, "textRemark").text()
    type_per_cent(drawing, "textLetterSpacing", "0")
    field(drawing).words.setFocus()
    finish(drawing)
    right = [(left - 2 * advance, 0), (second - 2 * advance, 0), (left - advance, 1.5 * lower)]
    assert lefts(drawing, start) == close_to(right)
    assert session.undo_stack.undoText() == "Edit Text “II I”"


def test_on_a_page_a_text_stays_one_with_its_lines_and_becomes_outlines_when_asked(drawing, tmp_path):
    drawing.new()
    drawing.trigger("newDrawing")
    drawing.window.canvas.camera.show_box((-1, 9), (-3, 5))
    drawing.settle()
    drawing.trigger("textTool")
    start = begin(drawing)
    write(drawing, "AB")
    press(drawing, Qt.Key.Key_Return)
    write(drawing, "A")
    finish(drawing)
    session = drawing.session
    (text,) = (curve for curve in session.document.curves if curve.points)
    assert session.undo_stack.undoText() == "Add Text “AB A”"
    assert (text.name, [line.words for line in text.form.lines]) == ("AB A", ["AB", "A"])
    assert text.style.has_fill
    assert not text.style.has_stroke
    assert session.selected.chosen == {session.document.curves.index(text)}
    path = tmp_path / "written.svg"
    drawing.window.commands[ExportCommands].export(path)
    drawing.wait_for_work()
    written = path.read_text(encoding="utf-8")
    assert (written.count("<text"), "<path" in written) == (1, False)
    # Escape keeps what was typed, as elsewhere; undo takes it away.
    steps = session.undo_stack.count()
    drawing.click((5.0, -2.0))
    write(drawing, "B")
    press(drawing, Qt.Key.Key_Escape)
    assert session.undo_stack.undoText() == "Add Text “B”"
    drawing.trigger("undo")
    drawing.click((5.0, -2.0))
    press(drawing, Qt.Key.Key_Escape)
    assert session.undo_stack.index() == steps
    # Larger and with lines further apart it is the same object still.
    drawing.trigger("selectTool")
    drawing.double_click((start[0] + 0.5, start[1] + 0.5))
    type_size(drawing, "4")
    finish(drawing)
    (larger,) = session.document.curves
    steps = [lines[1].y - lines[0].y for lines in (text.form.lines, larger.form.lines)]
    assert steps[1] == pytest.approx(2 * steps[0])
    assert np.ptp([p.y for p in larger.points]) == pytest.approx(2 * np.ptp([p.y for p in text.points]))
    drawing.trigger("undo")
    # As large and in the same places as the letters that a text of curves would have.
    shown = field(drawing)
    letters_there = outlines_of("AB\nA", Face(FAMILY), shown.setting)
    drawing.trigger("objectToPath")
    box = np.vstack([np.concatenate([*each.contours]).reshape(-1, 2) for each in letters_there.glyphs])
    made = np.array([p.position for curve in session.document.curves for p in curve.points])
    assert len(session.document.curves) >= 3
    expected = np.add(start, box * 2.0 / letters_there.em)
    assert made.min(axis=0) == pytest.approx(expected.min(axis=0), abs=1e-3)
    assert made.max(axis=0) == pytest.approx(expected.max(axis=0), abs=1e-3)
