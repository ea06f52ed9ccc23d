"""What goes out: the dialog with its options, files, the clipboard; with real events."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QMessageBox, QPushButton

from app.document.group_edits import group_curves
from app.document.model import NEVER_EXPORTED, Document, Export, make_curve
from app.exchange.export_choice import ExportChoice, choice_from, choice_of, export_record, text_of
from app.exchange.files import import_file
from app.exchange.formats import FORMATS, format_of, typed_format, with_ending
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.settings.preferences import Preferences
from app.storage.files import load
from app.testing import Editor
from app.workbench.document_files import DocumentFiles
from tests.gui.editor_facts import retype
from tests.waiting import until

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(autouse=True)
def _no_pause_to_type_on(monkeypatch):
    """The preview waits until nothing is typed for a while; here nobody types on."""
    monkeypatch.setattr("app.features.import_export.export_dialog._SOON_MS", 10)


@pytest.fixture
def dialog(editor):
    editor.trigger("exportPicture")
    found = editor.window.findChild(QDialog, "exportDialog")
    yield settled(editor, found)
    if editor.window.findChild(QDialog, "exportDialog") is not None:
        found.close()


def settled(editor, dialog):
    until(lambda: not (dialog.jobs.is_busy or dialog._soon.isActive()))
    editor.settle()
    return dialog


def choose(box, text):
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Home)
    for _ in range(box.count()):
        if box.currentText() != text:
            QTest.keyClick(box, Qt.Key.Key_Down)
    assert box.currentText() == text


def choose_format(dialog, ending):
    choose(dialog.form.format_box, format_of(f"a{ending}", FORMATS.offered).title)


def click(widget):
    """Click where the sign of a check box is."""
    QTest.mouseClick(widget, Qt.MouseButton.LeftButton, pos=QPoint(8, widget.height() // 2))


def export(editor, dialog, path, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    QTest.mouseClick(dialog.findChild(QPushButton, "exportFile"), Qt.MouseButton.LeftButton)
    editor.wait_for_work()
    return path


def looks(dialog):
    return dialog.picture.pixmap().toImage()


def test_a_png_is_written_with_its_options(editor, dialog, tmp_path, monkeypatch):
    plain = looks(dialog)
    assert dialog.size_label.text().startswith("1600 × ")
    dialog.form.fields["width"].widget.setFocus()
    dialog.form.fields["width"].widget.lineEdit().selectAll()
    QTest.keyClicks(dialog.form.fields["width"].widget, "500")
    QTest.keyClick(dialog.form.fields["width"].widget, Qt.Key.Key_Tab)
    choose(dialog.form.fields["scale"].widget, "× 2 (192 dpi)")
    assert dialog.form.fields["transparent"].widget.isChecked()
    for name in ("points", "handles", "grid", "basis"):
        click(dialog.form.fields[name].widget)
    settled(editor, dialog)
    assert dialog.size_label.text().startswith("1000 × ")
    assert looks(dialog) != plain
    image = QImage(str(export(editor, dialog, tmp_path / "a.png", monkeypatch)))
    assert image.width() == 1000
    assert image.pixelColor(0, 0).alpha() == 0
    assert editor.status == f"Wrote a.png, 1000 × {image.height()} pixels."


def test_the_dialog_displays_only_the_options_of_the_format(dialog):
    form = dialog.form
    for ending, shown in ((".png", True), (".csv", False), (".py", False), (".svg", False)):
        choose_format(dialog, ending)
        assert form.fields["width"].widget.isVisible() is shown
        assert form.fields["samples"].widget.isVisible() is (ending == ".csv")
        assert form.fields["tolerance"].widget.isVisible() is (ending == ".svg")
        assert dialog.preview_side.isVisible() is (ending in (".png", ".svg"))
        assert not form.fields["cubic"].widget.isVisible()
    choose_format(dialog, ".dxf")
    assert form.fields["cubic"].widget.isVisible()
    assert form.fields["points"].widget.isVisible()
    assert not form.fields["grid"].widget.isVisible()


def test_a_dxf_for_programs_that_draw_cubics_only(editor, dialog, tmp_path, monkeypatch):
    ezdxf = pytest.importorskip("ezdxf")
    editor.choose_family(QUINTIC_HERMITE)
    choose_format(dialog, ".dxf")
    click(dialog.form.fields["cubic"].widget)
    path = export(editor, dialog, tmp_path / "a", monkeypatch)
    (spline,) = ezdxf.readfile(path.with_suffix(".dxf")).modelspace()
    assert spline.dxf.degree == 3


def test_a_table_is_written_with_its_options(editor, dialog, tmp_path, monkeypatch):
    choose_format(dialog, ".csv")
    choose(dialog.form.fields["spacing"].widget, "equal arc lengths")
    dialog.form.fields["samples"].widget.lineEdit().selectAll()
    QTest.keyClicks(dialog.form.fields["samples"].widget, "11")
    QTest.keyClick(dialog.form.fields["samples"].widget, Qt.Key.Key_Tab)
    for title, check in dialog.form.fields["columns"].checks.items():
        if check.isChecked() is not (title in ("x", "y", "length")):
            click(check)
    path = export(editor, dialog, tmp_path / "a", monkeypatch)
    with path.with_suffix(".csv").open(encoding="utf-8") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["x", "y", "length"]
    assert len(rows) == 12
    steps = np.diff([float(row[2]) for row in rows[1:]])
    assert np.ptp(steps) < 1e-4 * steps.mean()


def test_a_table_needs_a_column(dialog):
    choose_format(dialog, ".csv")
    for check in dialog.form.fields["columns"].checks.values():
        if check.isChecked():
            click(check)
    assert dialog.problem.text() == "⚠ A table needs at least one column."
    assert not dialog.ok.isEnabled()
    click(dialog.form.fields["columns"].checks["t"])
    assert dialog.ok.isEnabled()


def test_a_typed_tolerance_is_written(editor, dialog, tmp_path, monkeypatch):
    editor.choose_family(LAGRANGE)
    choose_format(dialog, ".svg")
    edit = dialog.form.fields["tolerance"].widget
    retype(edit, "wide")
    assert dialog.isVisible()
    edit.selectAll()
    QTest.keyClicks(edit, "0.5")
    QTest.keyClick(edit, Qt.Key.Key_Return)
    assert dialog.isVisible(), "Enter enters the number"
    text = export(editor, dialog, tmp_path / "a.svg", monkeypatch).read_text(encoding="utf-8")
    assert "(tolerance 0.5)" in text


def test_the_options_of_an_export_are_remembered(qtbot, tmp_path, monkeypatch):
    store = tmp_path / "preferences.ini"
    first = Editor(qtbot, preferences=Preferences(store))
    first.trigger("exportPicture")
    dialog = first.window.findChild(QDialog, "exportDialog")
    choose_format(dialog, ".pdf")
    click(dialog.form.fields["grid"].widget)
    export(first, settled(first, dialog), tmp_path / "a.pdf", monkeypatch)
    second = Editor(qtbot, preferences=Preferences(store))
    second.trigger("exportPicture")
    dialog = settled(second, second.window.findChild(QDialog, "exportDialog"))
    assert dialog.form.choice() == ExportChoice(".pdf", {"grid": True})
    dialog.close()


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '{"ending": ".exe"}', '{"width": 0}', '{"columns": []}', "\ud800"]
)
def test_invalid_stored_options_are_ignored(text):
    assert choice_from(text) == ExportChoice()
    other = ExportChoice(".csv", {"samples": 5, "columns": ("x",)})
    assert choice_from(text_of(other)) == other


@pytest.mark.parametrize(
    "export",
    [
        Export(".exe"),
        Export(".svg", "a.svg", (("grid", "["), ("dpi", '"many"'), ("nothing", "1"))),
        Export(".png", "a.png", (("width", "0"), ("scale", "17"))),
    ],
)
def test_invalid_export_options_of_a_document_are_ignored(export):
    assert choice_of(export).values == {}


def test_a_document_remembers_every_kind_of_option():
    choice = ExportChoice(".csv", {"samples": 5, "columns": ("x",), "scale": 2.0, "tolerance": 0.5})
    assert choice_of(export_record(choice, "a.csv", NEVER_EXPORTED)) == choice
    assert choice_of(NEVER_EXPORTED) is None


def test_cancelling_writes_and_remembers_nothing(editor, dialog, monkeypatch):
    choose_format(dialog, ".pdf")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: pytest.fail("asked for a file"))
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    editor.settle()
    assert editor.window.preferences.export_choice == ""


def test_no_file_is_written_without_a_name(editor, dialog, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    QTest.mouseClick(dialog.findChild(QPushButton, "exportFile"), Qt.MouseButton.LeftButton)
    assert not editor.window.context.work.jobs.is_busy


def test_the_image_panel_follows_the_document(editor, dialog):
    before = looks(dialog)
    editor.drag_point(0, to=(editor.point(0)[0] - 1, editor.point(0)[1] - 2))
    settled(editor, dialog)
    assert looks(dialog) != before


def test_the_dialog_reports_a_document_without_curves(editor):
    editor.new()
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert "nothing to draw" in dialog.problem.text()
    assert not dialog.ok.isEnabled()
    dialog.close()


def test_the_key_opens_the_export_dialog(editor):
    QTest.keyClick(editor.window, Qt.Key.Key_E, Qt.KeyboardModifier.ControlModifier)
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert dialog.isVisible()
    editor.trigger("exportPicture")
    assert len(editor.window.findChildren(QDialog, "exportDialog")) == 1
    dialog.close()


# The clipboard


def test_the_curves_are_copied_as_pictures(editor):
    editor.window.canvas.setFocus()
    keys = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_C, keys)
    editor.wait_for_work()
    data = QGuiApplication.clipboard().mimeData()
    image = QImage.fromData(data.data("image/png"))
    assert image.width() == 1600
    assert image.pixelColor(0, 0).alpha() == 0
    root = ElementTree.fromstring(bytes(data.data("image/svg+xml").data()))
    assert len(list(root.iter(f"{SVG}path"))) == 1
    assert data.hasImage()
    assert "Copied the drawing as an image" in editor.status


def test_the_drawing_is_copied_as_svg(editor):
    editor.trigger("copySvg")
    editor.wait_for_work()
    data = QGuiApplication.clipboard().mimeData()
    root = ElementTree.fromstring(bytes(data.data("image/svg+xml").data()))
    assert len(list(root.iter(f"{SVG}path"))) == 1
    as_text = ElementTree.fromstring(data.text())
    assert as_text.get("width") == root.get("width")
    assert editor.status == "Copied the drawing as SVG."


@pytest.mark.parametrize("name", ["copySvg", "copyImage", "copyPathData"])
def test_selected_curves_are_copied(waves, name):
    editor = waves("ABC")
    editor.session.selected.set_curves({0, 2})
    editor.trigger(name)
    editor.wait_for_work()
    assert editor.status.startswith("Copied 2 curves as ")
    data = QGuiApplication.clipboard().mimeData()
    svg = bytes(data.data("image/svg+xml").data()).decode() or data.text()
    assert svg.count("M ") == 2


def test_the_path_data_are_copied(editor):
    editor.choose_family(HERMITE)
    editor.trigger("copyPathData")
    editor.wait_for_work()
    text = QGuiApplication.clipboard().text()
    assert text.startswith("M ")
    assert text.count("C ") == len(editor.curve.points) - 1


def test_without_a_curve_copying_is_disabled(editor):
    editor.new()
    for name in ("copyImage", "copyPathData"):
        assert not editor.action(name).isEnabled()


def shape_of_pdf(path):
    """Width against height of the page."""
    box = re.search(rb"/MediaBox \[([^\]]+)\]", path.read_bytes())
    left, bottom, right, top = map(float, box[1].split())
    return (right - left) / (top - bottom)


def test_handles_lie_inside_the_picture_and_above_the_functions(editor, tmp_path, monkeypatch):
    curve = make_curve([(0, 0), (2, 0), (4, 0)], family=HERMITE)
    # Of which a sixth is a handle that reaches far below.
    points = tuple(replace(point, velocity=(1.2, -18.0)) for point in curve.points)
    editor.session.commit(Document((replace(curve, points=points),)), "Begin")
    editor.fit()
    shapes = []
    for ending in (".svg", ".png", ".pdf"):
        editor.trigger("exportPicture")
        dialog = editor.window.findChild(QDialog, "exportDialog")
        choose_format(dialog, ending)
        for name in ("handles", "basis"):
            if not dialog.form.fields[name].widget.isChecked():
                click(dialog.form.fields[name].widget)
        settled(editor, dialog)
        path = export(editor, dialog, tmp_path / f"a{ending}", monkeypatch)
        if ending == ".svg":
            root = ElementTree.parse(path).getroot()
            left, top, width, height = map(float, root.get("viewBox").split())
            shapes.append(width / height)
        elif ending == ".png":
            image = QImage(str(path))
            shapes.append(image.width() / image.height())
        else:
            shapes.append(shape_of_pdf(path))
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert shapes == pytest.approx([shapes[0]] * 3, rel=5e-3)

    def corners(name):
        text = " ".join(part.get("d") for part in root.find(f"{SVG}g[@id='{name}']"))
        return np.array(re.findall(r"[ML] (\S+) (\S+)", text), dtype=float)

    handles, functions = corners("handles"), corners("basis")
    assert np.ptp(handles[:, 1]) > 5
    assert left < handles[:, 0].min()
    assert handles[:, 0].max() < left + width
    assert top < handles[:, 1].min()
    assert handles[:, 1].max() < functions[:, 1].min()
    assert functions[:, 1].max() < top + height


@pytest.mark.parametrize(
    ("ending", "typed", "written", "format_ending"),
    [
        (".points.csv", "p.csv", "p.points.csv", ".points.csv"),
        (".points.csv", "p", "p.points.csv", ".points.csv"),
        (".points.csv", "P.POINTS.CSV", "P.POINTS.CSV", ".points.csv"),
        (".points.csv", "p.tsv", "p.points.tsv", ".points.csv"),
        (".points.csv", "p.points.tsv", "p.points.tsv", ".points.csv"),
        (".csv", "p.points.csv", "p.points.csv", ".points.csv"),
        (".tsv", "path.csv", "path.csv", ".csv"),
        (".tsv", "path.CSV", "path.CSV", ".csv"),
        (".scipy.py", "sp.py", "sp.scipy.py", ".scipy.py"),
        (".py", "sp.scipy.py", "sp.scipy.py", ".scipy.py"),
        (".path.txt", "path.txt", "path.path.txt", ".path.txt"),
        (".desmos.txt", "a.path.txt", "a.path.txt", ".path.txt"),
        (".coefficients.json", "a.json", "a.coefficients.json", ".coefficients.json"),
        (".svg", "a.b", "a.b.svg", ".svg"),
        (".svg", "a.csv", "a.csv", ".csv"),
        (".png", "a.curve.json", "a.curve.json", ".curve.json"),
        (".points.csv", ".csv", ".csv.points.csv", ".points.csv"),
    ],
)
def test_the_name_typed_decides_the_format(ending, typed, written, format_ending):
    form = typed_format(Path(typed), format_of(f"a{ending}", FORMATS.written))
    assert form.ending == format_ending
    assert with_ending(Path("folder", typed), form) == Path("folder", written)


def test_an_svg_has_size_scale_and_decimals_as_options(editor, tmp_path, monkeypatch):
    """Typed in the dialog, written in the file and remembered with the document."""
    points = [(0.0, 0.0), (1.0, 2 / 3), (3.0, 0.0)]
    editor.session.change("Draw", lambda _: Document((make_curve(points, family=HERMITE),), unit="mm"))
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    choose_format(dialog, ".svg")
    fields = dialog.form.fields
    width, scale, true = (fields[name].widget for name in ("svg_width", "svg_scale", "true_size"))

    def type_in(field, text):
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)
        settled(editor, dialog)

    type_in(width, "300")
    assert not scale.isVisible()
    assert not true.isVisible()
    assert dialog.size_label.text().startswith("300 × ")
    type_in(width, "automatic")
    assert scale.isVisible()
    assert true.isVisible()
    type_in(scale, "10")
    assert not true.isVisible()
    choose(fields["decimals"].widget, "2")
    path = export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    root = ElementTree.fromstring(path.read_bytes())
    box = [float(number) for number in root.get("viewBox").split()]
    assert float(root.get("width")) == pytest.approx(10 * box[2], rel=1e-5)
    data = next(root.iter(f"{SVG}path")).get("d")
    numbers = re.findall(r"-?[\d.]+", data)
    # Two decimals of a pixel, of which ten are a unit.
    assert all(len(number.partition(".")[2]) <= 3 for number in numbers)
    assert "0.667" in data
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert dialog.form.fields["svg_scale"].widget.text() == "10"
    assert dialog.form.fields["decimals"].widget.currentText() == "2"
    dialog.close()


def test_a_remark_about_a_file_goes_with_the_next_export_and_with_a_new_document(
    editor, tmp_path, monkeypatch
):
    """A remark about the curvature in a table stood through the next export and into a new document."""
    points = [(0.0, 0.0), (1.0, 1.0), (3.0, 0.0)]
    curves = (make_curve(points), replace(make_curve(points, name="Twice"), visible=False))
    editor.session.change("Draw", lambda _: Document(curves))

    def exported(ending):
        editor.trigger("exportPicture")
        dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
        choose_format(dialog, ending)
        export(editor, dialog, tmp_path / f"a{ending}", monkeypatch)
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    exported(".points.csv")
    assert "“Twice” is hidden" in editor.message
    exported(".svg")
    assert editor.message == ""
    exported(".points.csv")
    assert "“Twice” is hidden" in editor.message
    editor.session.files.give_up_changes()
    editor.trigger("newDocument")
    editor.settle()
    assert "Twice" not in editor.message


@pytest.mark.parametrize("text", ["50 mm", "0", "-5", "1e9", "3 4"])
def test_a_width_that_is_none_is_refused_and_never_ignored(editor, dialog, text, monkeypatch):
    """The text stayed without a word, and the file had the size of before."""
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    choose_format(dialog, ".svg")
    settled(editor, dialog)
    width, size = dialog.form.fields["svg_width"].widget, dialog.size_label.text()
    assert not dialog.form.fields["true_size"].widget.isVisible(), "the document has no unit"
    asked = []
    dialog.export_requested.connect(asked.append)
    retype(width, text)
    assert "Width in pixels: " in dialog.problem.text()
    assert not dialog.ok.isEnabled()
    assert width.text() == text
    QTest.keyClick(width, Qt.Key.Key_Escape)
    settled(editor, dialog)
    assert (dialog.problem.isHidden(), width.text(), dialog.size_label.text()) == (True, "automatic", size)
    # Export pressed at once, without Enter or Tab.
    width.setFocus()
    width.selectAll()
    QTest.keyClicks(width, text)
    click(dialog.ok)
    assert (asked, dialog.isVisible(), dialog.problem.isHidden()) == ([], True, False)
    retype(width, "300")
    settled(editor, dialog)
    assert (dialog.problem.isHidden(), width.text(), dialog.size_label.text()[:5]) == (True, "300", "300 ×")
    width.selectAll()
    QTest.keyClicks(width, "400")
    click(dialog.ok)
    assert [choice.values["svg_width"] for choice in asked] == [400.0]


def test_a_circle_that_was_drawn_is_exported_as_a_circle(editor, tmp_path, monkeypatch):
    editor.window.canvas.camera.show_box((-7, 7), (-5, 5))
    editor.settle()
    editor.trigger("ellipseTool")
    editor.drag((-2.0, -1.0), (1.0, 1.7), keys=Qt.KeyboardModifier.ControlModifier)
    *_, drawn = editor.session.document.curves
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    choose_format(dialog, ".svg")
    path = export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    (circle,) = ElementTree.fromstring(path.read_bytes()).iter(f"{SVG}circle")
    xs = [point.x for point in drawn.points]
    assert float(circle.get("r")) == pytest.approx((max(xs) - min(xs)) / 2, rel=1e-12)
    back = import_file(path).document.curves[-1]
    for point, other in zip(back.points, drawn.points, strict=True):
        assert point.position == pytest.approx(other.position, abs=1e-12)


def test_the_automatic_tolerance_says_its_number(editor, tmp_path, monkeypatch):
    """5e-5 of the longer side, rounded down to one digit; with a unit at most 0.01 mm."""
    points = [(0.0, 0.0), (3.0, 4.0), (9.0, 1.0)]
    editor.session.change("Draw", lambda _: Document((make_curve(points, family=QUINTIC_HERMITE),)))
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    choose_format(dialog, ".svg")
    field = dialog.form.fields["tolerance"].widget
    assert field.text() == "automatic (0.0004)"
    text = export(editor, dialog, tmp_path / "a.svg", monkeypatch).read_text(encoding="utf-8")
    assert "(tolerance 0.0004)" in text
    dialog = measured(editor, "m")
    field = dialog.form.fields["tolerance"].widget
    assert field.text() == "automatic (1e-05)"
    for typed, shown in (("0.5", "0.5"), ("Automatic", "automatic (1e-05)")):
        field.setFocus()
        field.selectAll()
        QTest.keyClicks(field, typed)
        QTest.keyClick(field, Qt.Key.Key_Return)
        assert field.text() == shown
    dialog.close()


def test_a_csv_typed_under_tsv_is_a_csv(editor, dialog, tmp_path, monkeypatch):
    choose_format(dialog, ".tsv")
    path = export(editor, dialog, tmp_path / "path.csv", monkeypatch)
    assert [each.name for each in tmp_path.glob("path*")] == ["path.csv"]
    assert path.read_text(encoding="utf-8").splitlines()[0].count(",") > 3
    assert editor.session.files.last_export.ending == ".csv"
    assert editor.status.startswith("Wrote path.csv")


def test_the_file_has_the_ending_of_its_format_once(editor, dialog, tmp_path, monkeypatch):
    choose_format(dialog, ".points.csv")
    export(editor, dialog, tmp_path / "p.csv", monkeypatch)
    assert [each.name for each in tmp_path.glob("p*")] == ["p.points.csv"]


def test_a_number_out_of_range_is_refused(editor, dialog):
    """Of a width of 99999 pixels, 9999 was left without a word."""
    choose_format(dialog, ".png")
    box = dialog.form.fields["width"].widget
    box.setFocus()
    box.selectAll()
    dialog._render_preview()  # a preview is under way
    QTest.keyClicks(box, "99999")
    QTest.keyClick(box, Qt.Key.Key_Tab)
    assert box.value() == 99999
    assert "Width: from 1 to 16384." in dialog.problem.text()
    settled(editor, dialog)
    assert not dialog.ok.isEnabled()
    choose_format(dialog, ".svg")
    assert dialog.ok.isEnabled()


def test_a_file_under_a_completed_name_is_not_replaced(editor, dialog, tmp_path, monkeypatch):
    choose_format(dialog, ".points.csv")
    (tmp_path / "p.points.csv").write_text("mine", encoding="utf-8")
    export(editor, dialog, tmp_path / "p.csv", monkeypatch)
    assert (tmp_path / "p.points.csv").read_text(encoding="utf-8") == "mine"
    assert "p.points.csv was not written. The file already exists" in editor.message


def measured(editor, unit="cm", **more):
    """Have a document with a unit."""
    editor.session.commit(replace(editor.session.document, unit=unit, **more), "Measure")
    editor.trigger("exportPicture")
    return settled(editor, editor.window.findChild(QDialog, "exportDialog"))


def test_the_unit_of_the_document_gives_true_size_and_is_displayed(editor, tmp_path, monkeypatch):
    dialog = measured(editor)
    choose_format(dialog, ".svg")
    settled(editor, dialog)
    assert dialog.size_label.text().endswith("cm, 1 : 1 (1 is 1 cm)")
    click(dialog.form.fields["true_size"].widget)
    settled(editor, dialog)
    assert dialog.size_label.text().endswith("px, not to scale")
    click(dialog.form.fields["true_size"].widget)
    path = export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    root = ElementTree.fromstring(path.read_text())
    assert root.get("width") == f"{root.get('viewBox').split()[2]}cm"


def test_a_png_at_true_size_is_by_dots_for_each_inch(editor, tmp_path, monkeypatch):
    dialog = measured(editor, "mm")
    choose_format(dialog, ".png")
    fields = dialog.form.fields
    assert [name for name in ("width", "scale", "dpi") if fields[name].widget.isVisible()] == ["dpi"]
    fields["dpi"].widget.setFocus()
    fields["dpi"].widget.lineEdit().selectAll()
    QTest.keyClicks(fields["dpi"].widget, "1200")
    QTest.keyClick(fields["dpi"].widget, Qt.Key.Key_Tab)
    settled(editor, dialog)
    found = re.fullmatch(r"(\d+) × (\d+) pixels, (\S+) × (\S+) mm at 1200 dpi", dialog.size_label.text())
    assert int(found[1]) == pytest.approx(float(found[3]) / 25.4 * 1200, rel=2e-3)
    image = QImage(str(export(editor, dialog, tmp_path / "a.png", monkeypatch)))
    assert (image.width(), image.height()) == (int(found[1]), int(found[2]))


def test_a_png_by_its_width_has_true_size_and_the_resolution_follows(editor, dialog, tmp_path, monkeypatch):
    """With “True size” on there was no width; without it the file said 96 dpi."""
    names = ("by_dpi", "true_size", "width", "scale", "dpi")

    def visible_fields(form):
        return [name for name in names if form.fields[name].widget.isVisible()]

    assert visible_fields(dialog.form) == ["width", "scale"]
    dialog.close()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    other = measured(editor, "mm")
    assert visible_fields(other.form) == ["by_dpi", "dpi"]
    box = other.form.fields["by_dpi"].widget
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Down)
    assert (box.currentText(), visible_fields(other.form)) == ("By width in pixels", ["by_dpi", "width"])
    width = other.form.fields["width"].widget
    width.setFocus()
    width.lineEdit().selectAll()
    QTest.keyClicks(width, "512")
    QTest.keyClick(width, Qt.Key.Key_Tab)
    settled(editor, other)
    found = re.fullmatch(r"512 × \d+ pixels, (\S+) × \S+ mm at (\S+) dpi", other.size_label.text())
    assert float(found[2]) == pytest.approx(512 / float(found[1]) * 25.4, rel=1e-3)
    image = QImage(str(export(editor, other, tmp_path / "a.png", monkeypatch)))
    assert image.width() == 512
    assert image.dotsPerMeterX() * 0.0254 == pytest.approx(float(found[2]), rel=1e-3)


# What goes into the file


def paths_in(path):
    return [each.get("d") for each in ElementTree.parse(path).getroot().iter(f"{SVG}path")]


@pytest.mark.parametrize("ending", [".svg", ".csv"])
def test_selected_curves_are_exported(waves, tmp_path, monkeypatch, ending):
    editor = waves("ABC")
    editor.session.selected.set_curves({0, 2})
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert dialog.form.fields["extent"].widget.currentText() == "Selected curves"
    choose_format(dialog, ending)
    path = export(editor, dialog, tmp_path / f"a{ending}", monkeypatch)
    if ending == ".svg":
        assert len(paths_in(path)) == 2
        assert float(ElementTree.parse(path).getroot().get("viewBox").split()[3]) > 7
    else:
        with path.open(encoding="utf-8") as file:
            assert {row["curve"] for row in csv.DictReader(file)} == {"A", "C"}


def test_all_curves_are_exported_without_a_selection_or_on_request(waves, tmp_path, monkeypatch):
    editor = waves("ABC")
    editor.session.selected.set_curves({0, 2})
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    choose_format(dialog, ".svg")
    choose(dialog.form.fields["extent"].widget, "All curves")
    assert len(paths_in(export(editor, dialog, tmp_path / "a.svg", monkeypatch))) == 3
    editor.session.selected.activate(1)
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert dialog.form.fields["extent"].widget.currentText() == "All curves"
    choose(dialog.form.fields["extent"].widget, "Selected curves")
    path = export(editor, dialog, tmp_path / "b.svg", monkeypatch)
    assert len(paths_in(path)) == 1, "the curve that is edited"


@pytest.mark.usefixtures("drawings_read_here")
def test_a_part_of_a_drawing_begins_in_its_own_corner(editor, tmp_path, monkeypatch):
    """The icon was seen from “79 -38”, where it lies on its page."""
    icon = make_curve([(79.1, 22), (95.1, 22), (95.1, 38), (79.1, 38)], name="icon", family=HERMITE)
    other = make_curve([(7, 22), (23, 38)], name="other", family=HERMITE)
    document = Document((icon, other), unit="mm")
    editor.session.commit(document, "Begin")
    editor.session.selected.select_whole({0})
    for what, points in (("Selected curves", icon.points),):
        editor.trigger("exportPicture")
        dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
        choose_format(dialog, ".svg")
        choose(dialog.form.fields["extent"].widget, what)
        path = export(editor, dialog, tmp_path / f"{what}.svg", monkeypatch)
        left, top, width, height = ElementTree.parse(path).getroot().get("viewBox").split()
        assert (left, top) == ("0", "0")
        back = [point.position for curve in import_file(path).document.curves for point in curve.points]
        # As far from each other as they were, to the last decimal, and all on the page.
        (x, y), (old_x, old_y) = back[0], points[0].position
        there = [(round(a - x, 9), round(b - y, 9)) for a, b in back]
        assert there == [(round(a - old_x, 9), round(b - old_y, 9)) for a, b in (p.position for p in points)]
        assert all(0 <= a <= float(width) and 0 <= -b <= float(height) for a, b in back)


def test_a_selection_is_exported_under_its_name(waves, tmp_path, monkeypatch):
    """With nothing chosen it was the curve edited last, and everything was called after the first."""
    editor, asked = waves("ABC"), []
    selected, files = editor.session.selected, editor.session.files
    editor.session.change("Group", lambda document: group_curves(document, {1, 2}).document)
    (name,) = editor.session.document.curves[1].groups
    whole = files.origin.file_stem or "Sketch"

    def proposed(dialog):
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: asked.append(given[2]) or ("", ""))
        dialog.export_requested.emit(dialog.form.choice())
        return Path(asked[-1]).name

    selected.select_whole({0})
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    choose_format(dialog, ".svg")
    what = dialog.form.fields["extent"].widget
    entry = what.model().item(what.findText("Selected curves"))
    for chosen, text, stem in (
        ({0}, "Selected curves", "A"),
        ((), "All curves", whole),
        ({1, 2}, "Selected curves", name),
        ({0, 1}, "Selected curves", whole),
    ):
        selected.select_whole(chosen)
        settled(editor, dialog)
        assert (what.currentText(), entry.isEnabled(), proposed(dialog)) == (
            text,
            bool(chosen),
            f"{stem}.svg",
        )
    # What a part was called is not what the next export of all is.
    selected.select_whole({1, 2})
    export(editor, settled(editor, dialog), tmp_path / f"{name}.svg", monkeypatch)
    selected.select_whole(())
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert dialog.form.fields["extent"].widget.currentText() == "All curves"
    assert proposed(dialog) == f"{whole}.svg"
    dialog.close()


def test_the_preview_follows_the_options(waves):
    editor = waves("ABC")
    editor.session.selected.set_curves({0, 2})
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    before = looks(dialog)
    editor.session.selected.set_curves({0, 1})
    settled(editor, dialog)
    assert looks(dialog) != before
    dialog.close()


@pytest.mark.parametrize("ending", [".png", ".svg", ".pdf"])
def test_the_background_is_transparent_by_default(editor, dialog, ending, tmp_path, monkeypatch):
    choose_format(dialog, ending)
    settled(editor, dialog)
    assert dialog.form.fields["transparent"].widget.isChecked()
    path = export(editor, dialog, tmp_path / f"a{ending}", monkeypatch)
    if ending == ".svg":
        assert not list(ElementTree.parse(path).getroot().iter(f"{SVG}rect"))
    elif ending == ".png":
        assert QImage(str(path)).pixelColor(0, 0).alpha() == 0
    editor.trigger("exportPicture")
    again = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    before = looks(again)
    click(again.form.fields["transparent"].widget)
    settled(editor, again)
    assert looks(again) != before
    again.close()


# Remembered with the document


def test_a_document_remembers_its_last_export(editor, dialog, tmp_path, monkeypatch):
    path = tmp_path / "logo.curve.json"
    editor.session.save(path)
    choose_format(dialog, ".svg")
    click(dialog.form.fields["grid"].widget)
    steps = editor.session.undo_stack.count()
    export(editor, dialog, tmp_path / "my logo.svg", monkeypatch)
    assert editor.session.undo_stack.count() == steps, "no step of the history"
    assert not editor.session.files.is_modified
    editor.session.save()
    editor.new()
    editor.window.preferences.export_choice = ""
    editor.trigger("exportPicture")
    other = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert other.form.choice() == ExportChoice()
    other.close()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    editor.session.open(path)
    editor.trigger("exportPicture")
    again = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    assert again.form.choice() == ExportChoice(".svg", {"grid": True})
    asked = []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *given: asked.append(given[2]) or ("", ""))
    QTest.mouseClick(again.findChild(QPushButton, "exportFile"), Qt.MouseButton.LeftButton)
    assert Path(asked[0]).name == "my logo.svg"


def test_undo_does_not_forget_an_export(editor, dialog, tmp_path, monkeypatch):
    editor.drag_point(0, to=(0.5, 0.5))
    choose_format(dialog, ".svg")
    export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    editor.trigger("undo")
    assert editor.session.files.last_export.name == "a.svg"
    path = tmp_path / "a.curve.json"
    editor.session.save(path)
    assert load(path).export == editor.session.files.last_export


def test_an_export_alone_does_not_modify_the_document(editor, dialog, tmp_path, monkeypatch):
    """After one somebody was asked to save a document in which nothing was changed."""
    path, asked = tmp_path / "a.curve.json", []
    editor.session.save(path)
    monkeypatch.setattr(
        DocumentFiles, "_ask_about_changes", lambda _: asked.append(1) or QMessageBox.StandardButton.Cancel
    )
    choose_format(dialog, ".svg")
    export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    assert not editor.window.isWindowModified()
    # A change that is saved takes the note along.
    editor.drag_point(0, to=(0.5, 0.5))
    editor.trigger("saveDocument")
    assert load(path).export.name == "a.svg"
    editor.trigger("exportPicture")
    again = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    export(editor, again, tmp_path / "b.svg", monkeypatch)
    editor.trigger("newDocument")
    assert (asked, editor.session.files.path) == ([], None)


def test_a_document_exported_as_a_whole_offers_that_again_despite_a_selection(waves, tmp_path, monkeypatch):
    """It fell back to what was chosen, and files held a part of the drawing."""
    editor = waves("ABC")
    editor.session.selected.select_whole({0})

    def dialog():
        editor.trigger("exportPicture")
        return settled(editor, editor.window.findChild(QDialog, "exportDialog"))

    what = dialog().form.fields["extent"].widget
    assert what.currentText() == "Selected curves"
    choose(what, "All curves")
    export(editor, dialog(), tmp_path / "a.png", monkeypatch)
    again = dialog()
    assert again.form.fields["extent"].widget.currentText() == "All curves"
    choose(again.form.fields["extent"].widget, "Selected curves")
    export(editor, again, tmp_path / "a.png", monkeypatch)
    last = dialog()
    assert last.form.fields["extent"].widget.currentText() == "Selected curves"
    last.close()


def test_an_export_of_a_part_is_remembered_without_its_name(waves, tmp_path, monkeypatch):
    editor = waves("ABC")
    editor.session.selected.set_curves({0, 2})
    editor.trigger("exportPicture")
    dialog = settled(editor, editor.window.findChild(QDialog, "exportDialog"))
    export(editor, dialog, tmp_path / "a.png", monkeypatch)
    assert editor.session.files.last_export.options == (("extent", '"chosen"'),)
    assert "chosen" not in editor.window.preferences.export_choice


def test_the_window_reports_curves_that_an_export_leaves_out(editor, dialog, tmp_path, monkeypatch):
    """The command line said so; the window said no more than "exact"."""
    broken = replace(make_curve([(0.0, 0.0), (1.0, 1.0), (1.0, 1.0), (2.0, 0.0)]), name="Twice")
    document = editor.session.document
    editor.session.commit(replace(document, curves=(*document.curves, broken)), "Add")
    choose_format(dialog, ".svg")
    export(editor, dialog, tmp_path / "a.svg", monkeypatch)
    assert editor.status.startswith("Wrote a.svg, ")
    assert "“Twice”" in editor.message
    editor.trigger("copyPathData")
    editor.wait_for_work()
    assert "“Twice”" in editor.message
