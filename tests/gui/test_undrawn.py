"""Export says before it draws what an opened SVG has that it does not draw."""

from __future__ import annotations

import re

import pytest
from msgspec.structs import replace

from app.cli import main
from app.document.curve_edits import remove_curve
from app.features.import_export.export_dialog import ExportDialog

pytestmark = pytest.mark.usefixtures("drawings_read_here")

SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<defs><filter id="m"><feTurbulence baseFrequency="0.1"/></filter></defs>
<rect id="shade" x="10" y="10" width="50" height="50" filter="url(#m)"/>
<path d="M1 1L50 9L9 40z" style="mix-blend-mode:multiply"/>
<foreignObject width="3" height="3"/><path id="whole" d="M60 60h9v9z"/></svg>"""
FILTER = "<rect> “shade” (a filter changes it)"
BLEND = "<path> (element 6) (it is blended with what lies below)"
OTHER = "<foreignObject> (element 7) (it is of another kind than SVG)"


@pytest.fixture
def opened(editor, tmp_path):
    """An editor that has opened the file, which it knew before: nobody is asked."""
    path = tmp_path / "icon.svg"
    path.write_text(SVG, encoding="utf-8")
    editor.window.context.preferences.add_recent_file(path)
    editor.window.open_file(path)
    editor.wait_for_work()
    assert editor.session.files.foreign is not None
    return editor


def said_by_dialog(editor, qtbot):
    editor.trigger("exportPicture")
    dialog = editor.window.findChild(ExportDialog, "exportDialog")
    # It is drawn soon after it is shown, with what is said.
    qtbot.waitUntil(lambda: not dialog.picture.pixmap().isNull() and not dialog.jobs.is_busy)
    text = dialog.undrawn.text()
    assert dialog.undrawn.isVisible()
    dialog.reject()
    return text


def remove(editor, name):
    (place,) = [at for at, curve in enumerate(editor.session.document.curves) if curve.name == name]
    editor.session.change("Delete", lambda document: remove_curve(document, place))


def test_export_says_how_many_things_are_not_drawn_and_which(opened, qtbot):
    """Nothing was said of the filter after the file was open: the picture was whole, and nobody knew."""
    assert said_by_dialog(opened, qtbot) == (
        f"3 things in icon.svg are drawn otherwise here, or not at all: {FILTER}, {BLEND} and {OTHER}."
    )


def test_what_was_deleted_is_not_told(opened, qtbot):
    remove(opened, "shade")
    remove(opened, "Path 6")
    assert said_by_dialog(opened, qtbot) == (
        f"1 thing in icon.svg is drawn otherwise here, or not at all: {OTHER}."
    )


def test_what_was_renamed_is_told_all_the_same(opened, qtbot):
    session = opened.session
    (place,) = [at for at, curve in enumerate(session.document.curves) if curve.name == "shade"]
    session.change(
        "Rename",
        lambda document: document.with_curve(place, replace(document.curves[place], name="Shadow")),
    )
    assert FILTER in said_by_dialog(opened, qtbot)


def test_a_chosen_object_is_exported_without_a_word_about_others(opened, qtbot):
    session = opened.session
    (place,) = [at for at, curve in enumerate(session.document.curves) if curve.name == "whole"]
    session.selected.choose({place})
    text = said_by_dialog(opened, qtbot)
    assert FILTER not in text
    assert BLEND not in text


def test_a_file_that_is_drawn_as_it_is_is_told_nothing_of(editor, qtbot, tmp_path):
    path = tmp_path / "plain.svg"
    path.write_text(re.sub("<rect id.*?/>|<path d.*?/>|<foreign.*?/>", "", SVG), encoding="utf-8")
    editor.window.open_file(path)
    editor.wait_for_work()
    assert editor.session.files.foreign is not None
    editor.trigger("exportPicture")
    dialog = editor.window.findChild(ExportDialog, "exportDialog")
    qtbot.waitUntil(lambda: not dialog.picture.pixmap().isNull() and not dialog.jobs.is_busy)
    assert dialog.undrawn.text() == ""
    dialog.reject()


@pytest.mark.parametrize("verb", ["render", "convert"])
def test_the_command_line_says_it_of_each(verb, tmp_path, capsys):
    path = tmp_path / "icon.svg"
    path.write_text(SVG, encoding="utf-8")
    target = str(tmp_path / "a.png")
    assert main([verb, str(path), *(["-o"] if verb == "render" else []), target]) == 0
    said = capsys.readouterr().err
    assert said.startswith("curvebench: 3 elements of icon.svg come in otherwise than they are drawn:\n")
    assert "<rect> “shade”: a filter changes it; it comes in without." in said
    assert "<path> (element 6): it is blended with what lies below; it covers that." in said
    assert "<foreignObject> (element 7): it is of another kind than SVG; left out." in said
