"""The paper of a document: what is seen and what is exported have one paper and one ink."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from pixels import is_colour, pixels_of
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox

from app import exchange
from app.appearance.theme import DARK, LIGHT
from app.cli.command_line import main
from app.document.model import Document, Paper, make_curve
from app.document.plane_edits import set_paper
from app.document.style import Style
from app.exchange.export_choice import ExportChoice
from app.exchange.options import DARK_PAPER
from app.features.import_export.export_dialog import ExportDialog

POINTS = [(0, 0), (1, 1), (3, 1)]
THEMES = {"themeLight": LIGHT, "themeDark": DARK}
PAPERS = {Paper.LIGHT: LIGHT, Paper.DARK: DARK}


@pytest.fixture
def line(editor):
    editor.session.commit(Document((make_curve(POINTS),)), "Begin")
    editor.fit()
    editor.session.selected.select_whole([])
    return editor


def choose_paper(editor, paper):
    """Choose the paper in the panel, by keyboard."""
    editor.trigger("documentSettings")
    box = editor.window.findChild(QComboBox, "documentPaper")
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Home)
    for _ in range(list(Paper).index(paper)):
        QTest.keyClick(box, Qt.Key.Key_Down)
    editor.settle()


def colours_of_canvas(editor):
    """Return the theme in which most of the canvas, and some of it, are paper and ink."""
    image = editor.window.canvas.viewport().grab().toImage()
    found = [
        theme
        for theme in (LIGHT, DARK)
        if is_colour(image, theme.paper).mean() > 0.5 and is_colour(image, theme.curve).sum() > 50
    ]
    assert len(found) == 1
    return found[0]


def colours_of(image):
    """Return paper and ink of a picture that has no pixel without paper."""
    assert not image.isNull()
    codes = {f"#{code:06x}" for code in {*pixels_of(image)[:, 0].tolist(), *pixels_of(image)[-1].tolist()}}
    found = [theme for theme in (LIGHT, DARK) if codes == {theme.paper.name()}]
    assert len(found) == 1
    assert is_colour(image, found[0].curve).sum() > 50
    return found[0]


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("paper", PAPERS)
def test_the_paper_of_a_document_is_seen_and_exported_in_each_theme(line, theme, paper, tmp_path):
    """In the dark theme the ink is white, and every export of it was black."""
    line.trigger(theme)
    assert colours_of_canvas(line) is THEMES[theme]
    choose_paper(line, paper)
    assert line.session.document.paper is paper
    assert colours_of_canvas(line) is PAPERS[paper]
    for other in THEMES:
        line.trigger(other)
        assert colours_of_canvas(line) is PAPERS[paper]
    document = line.session.document
    for ending in (".png", ".svg", ".pdf"):
        request = ExportChoice(ending).request(document, 0)
        path = tmp_path / f"a{ending}"
        exchange.files.export(request.document, path, request.options)
        if ending == ".png":
            assert colours_of(QImage(str(path))) is PAPERS[paper]
        elif ending == ".svg":
            text = path.read_text(encoding="utf-8")
            assert 'id="paper" x=' in text
            assert PAPERS[paper].paper.name() in text
            assert PAPERS[paper].curve.name() in text
    clipboard = QGuiApplication.clipboard()
    line.window.canvas.setFocus()
    line.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    for copy in ("copyImage", "copyPoints"):
        line.trigger(copy)
        line.wait_for_work()
        assert colours_of(clipboard.image()) is PAPERS[paper]
        text = bytes(clipboard.mimeData().data("image/svg+xml").data()).decode()
        assert PAPERS[paper].paper.name() in text
        assert f'stroke="{PAPERS[paper].curve.name()}"' in text


def test_the_paper_is_saved_with_the_document_and_undone(line, tmp_path):
    line.trigger("themeLight")
    choose_paper(line, Paper.DARK)
    line.session.save(tmp_path / "a.curve.json")
    assert '"paper": "dark"' in (tmp_path / "a.curve.json").read_text(encoding="utf-8")
    assert main(["render", str(tmp_path / "a.curve.json"), "-o", str(tmp_path / "a.png")]) == 0
    assert colours_of(QImage(str(tmp_path / "a.png"))) is DARK
    line.trigger("undo")
    assert colours_of_canvas(line) is LIGHT
    line.session.files.give_up_changes()
    line.session.open(tmp_path / "a.curve.json")
    line.settle()
    line.session.selected.select_whole([])
    assert colours_of_canvas(line) is DARK
    line.session.files.give_up_changes()
    line.session.new()
    line.settle()
    assert line.window.canvas.layers.theme is LIGHT


def test_without_a_paper_pictures_have_dark_ink_as_before(line):
    """They were said to be as on the canvas, which has white ink in the dark theme."""
    assert DARK_PAPER.choices[None] == "Of the paper, or light"
    document = line.session.document
    assert ExportChoice(".svg").request(document, 0).options.style is None
    explicit = ExportChoice(".svg", {DARK_PAPER.name: False})
    assert explicit.request(set_paper(document, Paper.DARK), 0).options.style is None


def test_the_export_dialog_hides_transparent_where_the_paper_is_exported(line):
    dialog = ExportDialog(ExportChoice(".svg"), line.window)
    check = dialog.findChild(QCheckBox, "exportTransparent")
    dialog.show_document(line.session.document, 0)
    assert check.isVisibleTo(dialog)
    dialog.show_document(set_paper(line.session.document, Paper.DARK), 0)
    assert not check.isVisibleTo(dialog)
    dialog.deleteLater()


@pytest.mark.parametrize(("colour", "is_pale"), [("#ffffff", True), ("#f0f0d0", True), ("#0072b2", False)])
def test_a_white_curve_without_paper_is_not_lost_unnoticed(colour, is_pale):
    curve = replace(make_curve(POINTS, name="Wing"), style=Style(stroke=colour))
    preview = ExportChoice(".svg").format.preview
    request = ExportChoice(".svg").request(Document((curve,)), 0)
    remark = preview(*request, (300, 300)).colour_remark
    said = "“Wing” is hardly visible on white paper, and the picture has no paper of its own."
    assert remark == (said if is_pale else "")
    # With a paper it is adjusted to it instead.
    request = ExportChoice(".svg").request(Document((curve,), paper=Paper.LIGHT), 0)
    assert "no paper of its own" not in preview(*request, (300, 300)).colour_remark


def test_a_copied_image_of_a_white_curve_has_a_remark_unless_it_has_paper(line):
    white = replace(line.curve, style=Style(stroke="#ffffff"), name="Wing")
    line.session.commit(Document((white,)), "White")
    line.trigger("copyImage")
    line.wait_for_work()
    assert line.message.startswith("“Wing” is hardly visible on white paper")
    assert line.status.endswith("(PNG and SVG without a background).")
    line.session.change("Paper", lambda document: set_paper(document, Paper.DARK))
    QTest.keyClick(line.window.canvas, Qt.Key.Key_Escape)
    line.trigger("copyImage")
    line.wait_for_work()
    assert line.message == ""
    assert line.status.endswith("(PNG and SVG).")
