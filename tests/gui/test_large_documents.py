"""Documents of many curves: opened beside the window, which shows how far that is."""

from __future__ import annotations

from operator import is_
from threading import current_thread, main_thread

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog

from app.cli.windows import open_windows
from app.document.model import Curve, Document, make_curve
from app.families import HERMITE
from app.features.import_export import import_drawing_dialog
from app.features.import_export.commands import ImportCommands
from app.features.import_export.import_drawing_dialog import ImportDrawingDialog
from app.storage import files, validation
from app.testing import Editor
from app.tools import box
from tests.effort import calls_of, noted_calls
from tests.waiting import until

COUNT = 450


@pytest.fixture(scope="module")
def large(tmp_path_factory):
    path = tmp_path_factory.mktemp("large") / "many.curve.json"
    curves = [
        make_curve(
            [(k % 40, k // 40), (k % 40 + 0.4, k // 40 + 0.7), (k % 40 + 0.8, k // 40)],
            name=f"Curve {k}",
            family=HERMITE,
        )
        for k in range(COUNT)
    ]
    files.save(path, Document(tuple(curves)))
    return path


def test_a_large_document_is_opened_beside_the_window(editor, large):
    """The window's thread made each view and flattened it: frozen for 3.9 s with 5,000 curves."""
    told = []
    before = editor.session.document
    editor.window.context.work.jobs.progressed.connect(lambda share, word: told.append((share, word)))
    editor.window.open_file(large)
    assert editor.window.context.work.jobs.is_busy
    assert editor.session.document is before
    assert editor.action("cancelWork").isEnabled()
    editor.trigger("cancelWork")
    assert not editor.window.context.work.jobs.is_busy
    assert editor.session.document is before
    assert "Opening many.curve.json was stopped. Nothing has changed." in editor.status

    told.clear()

    def opened() -> None:
        editor.window.open_file(large)
        editor.wait_for_work()

    # Of this thread alone; 1,450 for each curve when all was done in it, 380 now.
    calls = calls_of(opened)
    assert editor.session.files.path == large
    assert len(editor.session.document.curves) == COUNT
    assert calls < 460 * COUNT
    assert [share for share, _ in told] == sorted(share for share, _ in told)
    assert {word for _, word in told} <= {"Reading", "Computing curves"}


def test_many_curves_are_imported_beside_the_window(editor, large):
    """It stood still for 11 s, with 1,900 paths on a busy machine, from the click on Import on."""

    def asked() -> ImportDrawingDialog:
        editor.window.commands[ImportCommands].import_files([large])
        editor.wait_for_work()
        (dialog,) = filter(QDialog.isVisible, editor.window.findChildren(ImportDrawingDialog))
        return dialog

    before, jobs = editor.session.document, editor.window.context.work.jobs
    asked().ok.click()
    assert jobs.is_busy
    assert editor.action("cancelWork").isEnabled()
    editor.trigger("cancelWork")
    assert editor.session.document is before
    dialog = asked()

    def imported() -> None:
        dialog.ok.click()
        editor.wait_for_work()

    # 1,760 for each curve when their views were made in this thread, 1,060 when all were measured, 602 now.
    calls = calls_of(imported)
    assert len(editor.session.document.curves) == COUNT + 1
    assert calls < 720 * COUNT
    dialog = asked()
    dialog.ok.click()
    editor.drag_point(0, to=(1.0, 1.0))
    editor.wait_for_work()
    assert len(editor.session.document.curves) == 2 * COUNT + 1, "with what was changed meanwhile"
    assert editor.session.undo_stack.count() == 3


def test_a_window_with_an_empty_document_opens_a_large_file_without_computing_curves_again(editor, large):
    """It worked them all out a second time, frozen for 4 s with 2,000 paths."""
    editor.session.new()
    editor.window.commands[ImportCommands].import_files([large])
    editor.wait_for_work()
    (dialog,) = filter(QDialog.isVisible, editor.window.findChildren(ImportDrawingDialog))

    def imported() -> None:
        dialog.ok.click()
        editor.wait_for_work()

    calls = calls_of(imported)
    assert len(editor.session.document.curves) == COUNT
    # 1,790 for each curve before, 615 now.
    assert calls < 740 * COUNT


def test_curves_that_are_pasted_are_validated_beside_the_window(editor, large, monkeypatch):
    """Of 2,000 the window validated every one: its longest halt took 145 ms, 95 since."""
    editor.window.open_file(large)
    editor.wait_for_work()
    editor.trigger("selectAllCurves")
    editor.trigger("copyPoints")
    validate, beside = validation._validate_curve, list[bool]()

    def recording(curve: Curve, place: str, before: Curve | None) -> None:
        beside.append(current_thread() is not main_thread())
        validate(curve, place, before)

    monkeypatch.setattr(validation, "_validate_curve", recording)
    editor.trigger("pasteInPlace")
    editor.wait_for_work()
    assert len(editor.session.document.curves) == 2 * COUNT
    assert beside == [True] * COUNT


def test_a_large_document_named_at_the_start_is_read_beside_its_window(large, tmp_path, qtbot):
    """There was no window for the 17 s that 20,000 curves take."""
    table = tmp_path / "a.csv"
    table.write_text("0,0\n1,1\n", encoding="utf-8")
    cut = tmp_path / "cut.curve.json"
    cut.write_bytes(large.read_bytes()[:-9])
    windows = open_windows([str(large), str(cut), str(table)])
    for window in windows:
        qtbot.addWidget(window)
        assert window.isVisible()
        assert window.context.work.jobs.is_busy
        assert window.session.files.path is None
    first, second = map(Editor.on, windows)
    second.wait_for_work()
    assert "cut.curve.json was not opened" in second.message
    # It waits for its document, and is not lost with the sketch that is shown before.
    until(lambda: first.window.findChild(QDialog, "importTableDialog") is not None)
    assert first.session.files.path == large


def test_errors_of_a_large_file_and_of_another_are_reported_together(large, tmp_path, qtbot):
    path = tmp_path / "cut.curve.json"
    path.write_bytes(large.read_bytes()[:-9])
    (window,) = open_windows([str(path)], ["b.csv is gone."])
    qtbot.addWidget(window)
    editor = Editor.on(window)
    editor.wait_for_work()
    assert editor.message.startswith("cut.curve.json was not opened. ")
    assert editor.message.endswith(" b.csv is gone.")


def test_another_document_that_was_opened_meanwhile_stays(editor, large):
    editor.window.open_file(large)
    editor.session.new()
    editor.wait_for_work()
    assert editor.session.files.path is None
    assert (
        editor.status == "many.curve.json was not opened because another document was opened in the meantime."
    )


def test_an_error_of_a_large_file_is_reported(editor, large, tmp_path):
    path = tmp_path / "cut.curve.json"
    path.write_bytes(large.read_bytes()[:-9])
    editor.window.open_file(path)
    editor.wait_for_work()
    assert editor.session.files.path is None
    assert "cut.curve.json was not opened" in editor.message


def test_undoing_hiding_and_combining_many_curves_computes_no_curve_again(editor, large):
    """Undo made all views anew, the list asked every row for those above it, Combine each for all others."""
    editor.window.open_file(large)
    editor.wait_for_work()
    editor.show_dock("curvesDock")
    editor.session.selected.select_whole(range(COUNT))
    editor.settle()
    views = editor.session.views
    moved = calls_of(lambda: editor.key(Qt.Key.Key_Right))
    assert all(new is not old for new, old in zip(editor.session.views, views, strict=True))
    undone = calls_of(lambda: editor.trigger("undo"))
    assert all(new is old for new, old in zip(editor.session.views, views, strict=True))
    hidden = calls_of(lambda: editor.trigger("curveVisible"))
    assert not any(curve.visible for curve in editor.session.document.curves)
    assert all(new.polyline is old.polyline for new, old in zip(editor.session.views, views, strict=True))
    combined = calls_of(lambda: editor.trigger("combineCurves"))
    # 580, 360, 360 and 440 for each curve when each was compared, checked and listed for itself;
    # 2,200, 2,130, 1,760 and 9,690 at first.
    # 255, 228, 236 and 290 now.
    assert moved < 305 * COUNT
    assert undone < 275 * COUNT
    assert hidden < 285 * COUNT
    assert combined < 350 * COUNT


def test_many_curves_are_moved_and_mapped_without_computing_any_curve(editor, large, monkeypatch):
    """A step of a drag of 2,000 curves took 0.8 s, a flip 1.6 s: each was made and flattened anew."""
    editor.window.open_file(large)
    editor.wait_for_work()
    editor.session.selected.select_whole(range(COUNT))
    editor.settle()
    session = editor.session
    x, y = session.views[0].polyline[1].tolist()
    editor.press((x, y))
    editor.move((x + 1.0, y + 0.5))
    groups = noted_calls(monkeypatch, box, "whole_unlocked_curves")
    dragged = calls_of(lambda: editor.move((x + 2.0, y + 1.0)))
    released = calls_of(lambda: editor.release((x + 2.0, y + 1.0)))
    assert not groups, "the same curves are moved: they are not gathered anew at every move"
    assert session.document.curves[-1].points[0].x > COUNT % 40 + 0.9
    nudged = calls_of(lambda: editor.key(Qt.Key.Key_Right))
    flipped = calls_of(lambda: editor.trigger("flipHorizontally"))
    # The last 440 for each curve when each of its points was mapped for itself; 350, 630, 580 and 650 when
    # each was compared and checked for itself, and a release did the last step again; 800, 970, 1,110 and
    # 1,160 at first.
    # 239, 49, 258 and 275 now that whole curves are put elsewhere in one pass.
    assert dragged < 255 * COUNT
    assert released < 100 * COUNT
    assert nudged < 295 * COUNT
    assert flipped < 330 * COUNT
    # One is the active curve; the exact box of all came along with those that reach farthest.
    assert sum(not view.is_followed for view in session.views) == 1
    aligned = calls_of(lambda: editor.trigger("alignLeft"))
    # 2,030 for each curve when each was measured for itself, before and anew behind the step; 527 now.
    assert aligned < 630 * COUNT
    assert sum(not view.is_followed for view in session.views) == 1
    assert session.undo_stack.count() == 4


def test_many_curves_copied_in_this_window_are_pasted_without_computing_any_curve(editor, large):
    """They were written, read, checked and computed anew, twice where they came to the pointer: for 15 s."""
    editor.window.open_file(large)
    editor.wait_for_work()
    session = editor.session
    session.selected.select_whole(range(COUNT))
    editor.trigger("copyPoints")

    def pasted() -> None:
        editor.trigger("pastePoints")
        editor.wait_for_work()

    calls = calls_of(pasted)
    assert len(session.document.curves) == 2 * COUNT
    lines = [view.whole_line[0].parameters for view in session.views]
    assert all(map(is_, lines[COUNT:], lines[:COUNT]))
    moved = session.views[-1].points - session.views[COUNT - 1].points
    assert moved == pytest.approx(np.broadcast_to(moved[0], moved.shape))
    # 780 now.
    assert calls < 935 * COUNT


def test_many_curves_are_duplicated_and_drawn_once(editor, large, monkeypatch):
    """The step drew them, then what it chose did, and each was compared with all that were copied."""
    editor.window.open_file(large)
    editor.wait_for_work()
    session = editor.session
    session.selected.select_whole(range(COUNT))
    editor.settle()
    drawn = noted_calls(monkeypatch, type(editor.window.canvas.drawing), "render_others")
    calls = calls_of(lambda: editor.trigger("duplicateCurve"))
    assert session.selected.whole_curves == frozenset(range(COUNT, 2 * COUNT))
    assert len(drawn) == 1
    # 779 now.
    assert calls < 935 * COUNT


def test_the_groups_of_a_drawing_are_counted_once_each(qtbot, monkeypatch):
    """Each was counted anew for every path in it: 3,000 in four layers stopped the window for two seconds."""
    curves = [
        replace(
            make_curve([(0, k), (1, k)], name=f"Path {k}", family=HERMITE), groups=("Layer", f"Group {k % 3}")
        )
        for k in sorted(range(60), key=lambda k: k % 3)
    ]
    counted = noted_calls(monkeypatch, import_drawing_dialog, "shape_count_label")
    tree = import_drawing_dialog.GroupTree(Document(tuple(curves)))
    qtbot.addWidget(tree)
    assert tree.topLevelItem(0).text(1) == "60 curves"
    assert tree.topLevelItem(0).child(2).text(1) == "20 curves"
    assert len(counted) == 4
