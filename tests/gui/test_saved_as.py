"""Save As under the names of other formats: the file is what its name says, or there is none."""

from __future__ import annotations

import gzip

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog

from app.document.model import make_curve
from app.document.several_curves import mapped, whole_curves
from app.document.transforms import skewing
from app.exchange.svg.reader import read_svg
from app.families import HERMITE, LAGRANGE
from app.storage.files import load
from app.workbench.file_names import SAVED_KINDS, title_of

pytestmark = pytest.mark.usefixtures("drawings_read_here")

ANY, (OWN, SVG, PACKED, _) = "", SAVED_KINDS.split(";;")
A4 = 297.0


@pytest.fixture
def save_as(editor, tmp_path, monkeypatch):
    """Save a drawing of one rectangle under a typed name with a kind of the list chosen."""
    editor.trigger("newDrawing")
    editor.trigger("rectangleTool")
    editor.drag((20, 20), (90, 90))

    def save(name, kind=ANY):
        answer = str(tmp_path / name), kind
        monkeypatch.setattr(
            QFileDialog,
            "getSaveFileName",
            lambda *words: proposed.append(words[2]) or kinds.append(words[4]) or answer,
        )
        editor.trigger("saveDocumentAs")
        editor.wait_for_work()

    proposed, kinds = [], []
    save.proposed, save.kinds = proposed, kinds
    return save


def places(curve, rise=0.0):
    return sorted((round(x, 6), round(y + rise, 6)) for x, y in (point.position for point in curve.points))


def holds(path, editor):
    """Whether an SVG holds the rectangle of the document; there y goes down from the top of the page."""
    (found,) = read_svg(path.read_bytes()).document.curves
    return places(found, A4) == places(editor.session.document.curves[0])


def test_a_document_saved_as_svg_is_one_and_stands_for_it_from_then_on(editor, save_as, tmp_path):
    """It wrote the document's JSON under that name, which no program opens, this one among them."""
    session, files = editor.session, editor.session.files
    # Typed, and by the list with the proposed name left as it is; also where it had a file of ours.
    for typed, kind, name in (("a.svg", ANY, "a.svg"), ("b.curve.json", SVG, "b.svg")):
        save_as(typed, kind)
        assert (editor.status, editor.message) == (f"Saved {name}, exact.", "")
        assert (title_of(session), files.path, files.is_modified) == (name, None, False)
        assert editor.window.windowTitle() == f"{name}[*] – Curvebench"
        assert holds(tmp_path / name, editor)
        assert editor.window.preferences.recent_files[0] == tmp_path / name
        # What is saved from now on goes there.
        editor.session.selected.choose({0})
        editor.key(Qt.Key.Key_Right)
        assert files.is_modified
        assert not holds(tmp_path / name, editor)
        editor.trigger("saveDocument")
        editor.wait_for_work()
        assert holds(tmp_path / name, editor)
        assert not files.is_modified
        editor.trigger("undo")
        save_as(f"own {name[0]}")
        own = tmp_path / f"own {name[0]}.curve.json"
        assert (files.path, load(own)) == (own, session.document)
    assert sorted(each.name for each in tmp_path.glob("[!.]*")) == [
        "a.svg",
        "b.svg",
        "own a.curve.json",
        "own b.curve.json",
    ]


def test_a_drawing_that_an_svg_keeps_is_proposed_as_one(editor, save_as, tmp_path):
    """It was a file that no other program opens, unless somebody found the list of kinds."""
    session = editor.session
    for typed, kind, name in (
        ("left.svg", OWN, "left.curve.json"),
        ("bare", SVG, "bare.svg"),
        ("own.curve.json", SVG, "own.curve.json"),
    ):
        session.files.begin(session.document)
        save_as(typed, kind)
        assert (save_as.proposed[-1].rsplit("/")[-1], save_as.kinds[-1]) == ("Drawing.svg", SVG)
        assert editor.status.startswith(f"Saved {name}")
        assert (tmp_path / name).exists()
    assert holds(tmp_path / "bare.svg", editor)
    # One with a file of ours stays that.
    save_as("again.curve.json", OWN)
    assert (save_as.proposed[-1], save_as.kinds[-1]) == (str(tmp_path / "own.curve.json"), OWN)
    drawn, places = session.document, [(10.0, 10.0), (20.0, 40.0), (60.0, 20.0)]
    for family, page, count, kind in (
        (LAGRANGE, drawn.page, 3, OWN),
        (HERMITE, None, 3, OWN),
        (HERMITE, drawn.page, 3, SVG),
        (HERMITE, drawn.page, 1, OWN),
        (HERMITE, drawn.page, 0, OWN),
    ):
        curve = make_curve(places[:count], family=family)
        session.files.begin(replace(drawn, curves=(curve,), page=page))
        save_as(f"{count} {family.name}.json", OWN)
        assert save_as.kinds[-1] == kind
        assert save_as.proposed[-1].endswith(".svg" if kind == SVG else ".curve.json")
    session.files.begin(drawn)


def test_what_an_svg_has_as_plain_paths_is_told(editor, save_as):
    """A clone is one there; it once followed no more when the file was opened again, which was “exact”."""
    editor.key(Qt.Key.Key_V)
    editor.key(Qt.Key.Key_D, Qt.KeyboardModifier.AltModifier)
    save_as("a.svg")
    assert "plain" not in editor.message + editor.status
    path = editor.session.files.foreign.path
    assert [curve.clone is not None for curve in read_svg(path.read_bytes()).document.curves] == [False, True]
    editor.trigger("starTool")
    editor.drag((150, 200), (180, 200))
    editor.trigger("saveDocument")
    editor.wait_for_work()
    assert "plain" not in editor.status, "a star is one there, too"
    star = whole_curves(editor.session.document, [len(editor.session.document.curves) - 1])
    slanted = skewing(0, 20, (150, 200))
    editor.session.change("Skew", lambda document: mapped(document, star, slanted))
    editor.trigger("saveDocument")
    editor.wait_for_work()
    assert "In a.svg skewed stars are plain paths" in editor.status
    editor.trigger("undo")
    editor.trigger("undo")
    editor.trigger("saveDocument")
    editor.wait_for_work()
    assert "plain" not in editor.status


@pytest.mark.parametrize("name", ["icons.PNG", "icons.dxf", "icons.points.csv"])
def test_nothing_of_ours_has_the_name_of_another_format(editor, save_as, tmp_path, name):
    save_as(name)
    assert editor.file_bar.text.startswith(
        f"{name} was not saved. A document is saved as .curve.json or .svg. File › E"
    )
    assert (list(tmp_path.glob("[!.]*")), editor.session.files.is_modified) == ([], True)
    save_as("logo v1.2")
    assert [each.name for each in tmp_path.glob("[!.]*")] == ["logo v1.2.curve.json"]


def test_a_document_under_the_name_of_an_svg_opens_as_what_it_is_and_is_saved_elsewhere(
    editor, save_as, tmp_path
):
    path = tmp_path / "icons.svg"
    editor.session.save(path)
    held, document = path.read_bytes(), editor.session.document
    editor.session.new()
    editor.window.context.files.open(path)
    assert (editor.session.document, editor.session.files.path) == (document, path)
    save_as("icons.curve.json")
    assert save_as.proposed[-1] == str(tmp_path / "icons.curve.json")
    assert path.read_bytes() == held


def test_a_copy_is_written_elsewhere_and_the_document_stays_with_its_file(
    editor, save_as, tmp_path, monkeypatch
):
    session, files = editor.session, editor.session.files
    save_as("own.curve.json")
    own, title = tmp_path / "own.curve.json", editor.window.windowTitle()
    before = own.read_bytes()
    session.selected.choose({0})
    editor.key(Qt.Key.Key_Right)
    proposed = []
    keys = Qt.KeyboardModifier
    for answer, name in (("one", "one.curve.json"), ("two.svg", "two.svg")):
        asked = lambda *words, answer=answer: proposed.append(words[1:3]) or (str(tmp_path / answer), ANY)  # noqa: E731
        monkeypatch.setattr(QFileDialog, "getSaveFileName", asked)
        editor.key(Qt.Key.Key_S, keys.ControlModifier | keys.AltModifier | keys.ShiftModifier)
        editor.wait_for_work()
        assert editor.status == f"Saved a copy as {name}."
        # The file, what it holds, the changes and the title are as they were.
        assert (files.path, files.foreign, files.is_modified, own.read_bytes()) == (own, None, True, before)
        assert editor.window.windowTitle() == title
    assert proposed[0] == ("Save a Copy", str(tmp_path / "own copy.curve.json"))
    assert load(tmp_path / "one.curve.json").curves == session.document.curves
    assert holds(tmp_path / "two.svg", editor)
    # Nobody else finds the copy locked, and it is no recent file.
    assert not list(tmp_path.glob(".*one*"))
    assert editor.window.preferences.recent_files[0] == own


def test_a_copy_is_not_written_over_the_document_itself(editor, save_as, tmp_path, monkeypatch):
    save_as("own.curve.json")
    own = tmp_path / "own.curve.json"
    before = own.read_bytes()
    editor.session.selected.choose({0})
    editor.key(Qt.Key.Key_Right)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(own), ANY))
    editor.trigger("saveCopy")
    assert (
        editor.message
        == "own.curve.json was not saved. It is the file of this document; choose another name."
    )
    assert (own.read_bytes(), editor.session.files.is_modified) == (before, True)


def test_a_copy_of_an_opened_svg_keeps_what_else_is_in_it(editor, tmp_path, monkeypatch):
    path = tmp_path / "in.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><title>mine</title><path d="M0 0L9 9"/></svg>')
    editor.window.preferences.add_recent_file(path)
    editor.window.context.files.open(path)
    editor.wait_for_work()
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "in copy.svg"), ANY))
    editor.trigger("saveCopy")
    editor.wait_for_work()
    assert "<title>mine</title>" in (tmp_path / "in copy.svg").read_text()
    assert editor.session.files.foreign.path == path


def test_a_drawing_is_saved_packed_by_name_or_by_kind_and_opened_and_saved_again(editor, save_as, tmp_path):
    """Files ending in .svgz were refused."""
    session, files = editor.session, editor.session.files
    for typed, kind, name in (("a.svgz", ANY, "a.svgz"), ("b.svg", PACKED, "b.svgz")):
        save_as(typed, kind)
        path = tmp_path / name
        assert files.foreign.path == path
        assert title_of(session) == name
        assert not files.is_modified
        assert path.read_bytes()[:2] == b"\x1f\x8b"
        (found,) = read_svg(gzip.decompress(path.read_bytes())).document.curves
        assert places(found, A4) == places(session.document.curves[0])
    editor.window.open_file(path)
    editor.wait_for_work()
    assert files.foreign.path == path
    assert files.foreign.begun is not None
    editor.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    editor.trigger("duplicateCurve")
    editor.trigger("saveDocument")
    editor.wait_for_work()
    assert not files.is_modified
    assert len(read_svg(gzip.decompress(path.read_bytes())).document.curves) == 2
