"""Revert to Saved goes back to what the file holds, an SVG as well, and Undo brings back the work."""

from __future__ import annotations

import pytest

from app.document.model import Document, make_curve
from app.document.several_curves import whole_curves
from app.document.transforms import stepping
from app.document.whole_edits import shifted
from app.families import HERMITE
from app.storage.files import save

pytestmark = pytest.mark.usefixtures("drawings_read_here")

SVG = """<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
<rect id="a" x="10" y="10" width="50" height="50"/></svg>"""


def opened(editor, path):
    editor.window.context.preferences.add_recent_file(path)
    editor.window.open_file(path)
    editor.wait_for_work()
    return editor.session


def moved(session, x, y):
    return session.change(
        "Move", lambda document: shifted(document, whole_curves(document, [0]), stepping((x, y)))
    )


@pytest.mark.parametrize("name", ["a.svg", "a.curve.json"])
def test_it_reads_the_file_again_and_undo_brings_back_the_work(editor, tmp_path, name):
    """An SVG had no way back but Undo, step by step: Reload was for documents of this program alone."""
    path = tmp_path / name
    if name.endswith(".svg"):
        path.write_text(SVG, encoding="utf-8")
    else:
        save(path, Document((make_curve([(0, 0), (5, 5)], family=HERMITE),)))
    session = opened(editor, path)
    before = session.document
    assert moved(session, 3.0, 4.0)
    assert moved(session, 3.0, 4.0)
    after = session.document
    editor.trigger("revertToSaved")
    editor.wait_for_work()
    assert session.document == before
    assert not session.files.is_modified
    assert "Undo brings back what was here." in editor.status
    editor.trigger("undo")
    assert session.document == after
    assert session.files.is_modified


def test_it_takes_what_another_program_has_written_and_saves_there_from_then_on(editor, tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(SVG, encoding="utf-8")
    session = opened(editor, path)
    path.write_text(SVG.replace('width="50"', 'width="20"'), encoding="utf-8")
    editor.trigger("revertToSaved")
    editor.wait_for_work()
    xs = [point.x for point in session.document.curves[0].points]
    assert max(xs) - min(xs) == pytest.approx(20.0)
    assert moved(session, 3.0, 0.0)
    editor.trigger("saveDocument")
    editor.wait_for_work()
    assert not session.files.is_modified
    assert 'x="13"' in path.read_text(encoding="utf-8")


def test_a_file_that_is_gone_is_said_and_the_work_stays(editor, tmp_path):
    path = tmp_path / "a.svg"
    path.write_text(SVG, encoding="utf-8")
    session = opened(editor, path)
    document = session.document
    path.unlink()
    editor.trigger("revertToSaved")
    editor.wait_for_work()
    assert "a.svg was not read again" in editor.message
    assert session.document == document


def test_without_a_file_there_is_nothing_to_revert_to(editor):
    editor.trigger("newDrawing")
    assert not editor.window.context.actions["revertToSaved"].isEnabled()
