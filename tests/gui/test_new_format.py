"""A format that only this test knows, one record: offered, written, read and dropped like all others."""

from __future__ import annotations

import json
import re

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QCheckBox, QComboBox, QDialog, QFileDialog, QLineEdit, QPushButton

from app.cli import main
from app.document.model import Document, make_curve
from app.exchange.cubics_in import ImportResult
from app.exchange.formats import FORMATS, ContentKind, ExportResult, Format
from app.exchange.options import TOLERANCE, Check, OneOf, Real, SomeOf, Tolerance, Whole
from app.storage.files import save

UPSIDE_DOWN = Check(
    name="upside_down",
    title="Upside down",
    tip="Write the corners with y negated",
    help="of a list of corners: y negated",
    default=False,
)
SHIFT = Real(
    name="shift", label="Shift", tip="Added to x", help="of a list of corners", default=0.0, limits=(-8, 8)
)
PEN = Whole(name="pen", label="Pen", tip="", help="of a list of corners", default=1, limits=(1, 8))
MARKS = SomeOf(
    name="marks",
    label="Marks",
    tip="Write {}",
    widget="exportMark_{}",
    help="of a list of corners",
    default=("a",),
    choices=("a", "b", "c"),
    needed="At least one.",
)
ROUGH = Tolerance(name="rough", label="Rough", tip="", help="of a list of corners", default=None)
KIND = OneOf(name="kind", label="Kind", tip="", help="of it", default=False, choices={False: "A", True: "B"})
OWN = (UPSIDE_DOWN, SHIFT, PEN, MARKS, ROUGH, KIND)
POINTS = [(0.0, 0.0), (2.0, 1.5), (4.0, -1.0)]


def write(document, options):
    """The points, with the tolerance for those who look."""
    sign = -1 if options[UPSIDE_DOWN] else 1
    shift = options[SHIFT]
    corners = [[point.x + shift, sign * point.y] for curve in document.curves for point in curve.points]
    said = {"corners": corners, "tolerance": options.tolerance}
    if options[KIND]:
        said["own"] = [options[PEN], options[MARKS], options[ROUGH]]
    return ExportResult(json.dumps(said), deviation=0.25)


def read(data, _tolerance):
    """A curve through the corners."""
    return ImportResult(Document((make_curve([tuple(pair) for pair in json.loads(data)["corners"]]),)))


@pytest.fixture
def corners():
    record = _corners()
    with FORMATS.with_record(record):
        yield record


def _corners(**fields):
    usual = {
        "endings": (".corners",),
        "title": "List of corners",
        "description": "The points, and nothing between them.",
        "options": (TOLERANCE, *OWN),
        "write": write,
        "kind": ContentKind.DRAWING,
        "plural": "Lists of corners",
        "read": read,
    }
    return Format(**(usual | fields))


@pytest.mark.usefixtures("corners")
def test_the_window_offers_a_new_format_with_its_options_and_writes_the_file(editor, tmp_path, monkeypatch):
    save(tmp_path / "a.curve.json", Document((make_curve(POINTS),)))
    editor.session.open(tmp_path / "a.curve.json")
    asked = []

    def answer(_parent, _title, start, kinds):
        asked.extend((start, kinds))
        return str(tmp_path / "mine"), ""

    monkeypatch.setattr(QFileDialog, "getSaveFileName", answer)
    editor.trigger("exportPicture")
    dialog = editor.window.findChild(QDialog, "exportDialog")
    check = dialog.findChild(QCheckBox, "exportUpsideDown")
    assert check.isHidden() or not check.isVisible()
    box = dialog.findChild(QComboBox, "exportFormat")
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_End)  # it is the last, for it has no place of its own
    assert box.currentText() == "List of corners"
    assert check.isVisible()
    QTest.mouseClick(check, Qt.MouseButton.LeftButton, pos=QPoint(8, check.height() // 2))
    field = dialog.findChild(QLineEdit, "exportShift")
    for text in ("0.5", "9"):
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
    assert field.text() == "9"  # it is beyond the limits, and stays to be mended
    QTest.mouseClick(dialog.findChild(QPushButton, "exportFile"), Qt.MouseButton.LeftButton)
    editor.wait_for_work()
    assert asked[0].endswith(".corners")
    assert asked[1] == "List of corners (*.corners)"
    written = json.loads((tmp_path / "mine.corners").read_text(encoding="utf-8"))
    assert written["corners"] == [[x + 0.5, -y] for x, y in POINTS]
    assert editor.status == "Wrote mine.corners, at most 0.25 from the true curve."
    # It is remembered with its option.
    remembered = json.loads(editor.window.preferences.export_choice)
    assert remembered == {"ending": ".corners", "upside_down": True, "shift": 0.5}


@pytest.mark.usefixtures("corners", "drawings_read_here")
def test_a_new_format_can_be_dropped_and_imported(editor, tmp_path, monkeypatch):
    path = tmp_path / "a.corners"
    path.write_text(json.dumps({"corners": POINTS}), encoding="utf-8")
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    copy, left, keys = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(editor.window, QDragEnterEvent(QPoint(300, 300), copy, data, left, keys))
    assert editor.status == "Drop to import a.corners"
    QApplication.sendEvent(editor.window, QDropEvent(QPointF(300, 300), copy, data, left, keys))
    editor.wait_for_work()
    dialog = editor.window.findChild(QDialog, "importDrawingDialog")
    QTest.mouseClick(dialog.findChild(QPushButton, "importDrawing"), Qt.MouseButton.LeftButton)
    assert [(point.x, point.y) for point in editor.session.document.curves[-1].points] == POINTS
    filters = []
    monkeypatch.setattr(
        QFileDialog, "getOpenFileNames", lambda *words: (filters.append(words[3]), ([], ""))[1]
    )
    editor.trigger("importFile")
    everything, *kinds = filters[0].split(";;")
    assert "*.corners" in everything
    assert "Lists of corners (*.corners)" in kinds


@pytest.mark.usefixtures("corners", "drawings_read_here")
def test_the_command_line_converts_a_new_format_both_ways(tmp_path, capsys):
    source, out, back = (tmp_path / name for name in ("a.curve.json", "a.corners", "b.points.csv"))
    save(source, Document((make_curve(POINTS),)))
    assert main(["convert", str(source), str(out), "--upside-down", "--tolerance", "0.5"]) == 0
    assert capsys.readouterr().out.endswith("largest deviation from the true curves 0.25\n")
    assert json.loads(out.read_text()) == {"corners": [[x, -y] for x, y in POINTS], "tolerance": 0.5}
    assert main(["convert", str(out), str(back)]) == 0
    assert "2.0,-1.5" in back.read_text()
    capsys.readouterr()
    with pytest.raises(SystemExit):
        main(["convert", "--help"])
    words = " ".join(capsys.readouterr().out.split())
    assert words.count(".corners") == 2
    assert "--upside-down of a list of corners: y negated" in words


@pytest.mark.usefixtures("corners")
def test_options_of_every_kind_are_arguments_within_their_limits(tmp_path, capsys):
    source, out = tmp_path / "a.curve.json", tmp_path / "a.corners"
    save(source, Document((make_curve(POINTS),)))
    words = ["convert", str(source), str(out)]
    own = ["--shift", "-1.5", "--pen", "8", "--marks", "a,c", "--rough", "0.25", "--kind", "True"]
    assert main([*words, *own]) == 0
    written = json.loads(out.read_text())
    assert written["corners"] == [[x - 1.5, y] for x, y in POINTS]
    assert written["own"] == [8, ["a", "c"], 0.25]
    for flag, text, reason in (
        ("--pen", "99", "“99” is not a whole number from 1 to 8"),
        ("--shift", "nan", "“nan” is not a number from -8 to 8"),
        ("--marks", "a,d", "“a,d” can only contain a, b, c"),
        ("--rough", "0", "“0” is not a number from"),
        ("--kind", "C", "invalid choice: 'C'"),
    ):
        with pytest.raises(SystemExit):
            main([*words, flag, text])
        assert reason in capsys.readouterr().err


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"endings": (".mine", ".svg")}, "“SVG drawing” and “List of corners” both write “.svg”."),
        ({"endings": (".npy",)}, "“NumPy array” and “List of corners” both read “.npy”."),
        (
            {"options": (Check(name="samples", default=False),)},
            "“Table of samples (CSV)” and “List of corners” both have an option “samples”.",
        ),
    ],
)
def test_a_conflict_of_two_formats_is_an_error_that_names_both(fields, reason):
    before = list(FORMATS)
    with (
        pytest.raises(ValueError, match=f"^{re.escape(reason)}$"),
        FORMATS.with_record(_corners(**fields)),
    ):
        pass
    assert list(FORMATS) == before


def test_a_flag_that_already_exists_is_an_error_that_names_the_flag():
    mine = _corners(options=(Check(name="output", flag="--thin", help="mine", default=False),))
    with (
        FORMATS.with_record(mine),
        pytest.raises(ValueError, match=r"“output” of a format needs another flag: .*--thin"),
    ):
        main(["convert", "a.svg", "b.svg"])


def test_a_format_is_removed_after_its_test(tmp_path, capsys):
    assert main(["convert", str(tmp_path / "a.corners"), str(tmp_path / "b.svg")]) == 1
    assert "has no known file extension" in capsys.readouterr().err
