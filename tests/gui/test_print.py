"""Printing through the system's dialog, to a file: true size, the page, vectors, and what is said of it."""

from __future__ import annotations

import re
import shutil
import subprocess
import zlib

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QMarginsF, Qt
from PySide6.QtGui import QImage, QPageLayout, QPageSize
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDialogButtonBox, QLineEdit, QPushButton

from app.document.model import Document, Page, make_curve
from app.document.style import LineCap, Style
from app.exchange.drawing.printed import print_drawing, to_print
from app.exchange.errors import ExchangeError
from app.families import HERMITE
from app.tasks.progress import silent

BAR = [(20, 45), (120, 45)]
needs_ghostscript = pytest.mark.skipif(shutil.which("gs") is None, reason="Ghostscript is not installed")


def drawing(page=None, unit="mm", points=BAR, width=50.0):
    """Return a red bar, from 20 to 120 mm across and from 20 to 70 mm upwards."""
    curve = make_curve(points, name="bar", family=HERMITE)
    curve = replace(curve, style=Style(stroke="#ff0000", width=width, cap=LineCap.BUTT))
    return replace(Document((curve,)), page=page, unit=unit)


@pytest.fixture
def print_by_dialog(editor, tmp_path):
    """Press Ctrl+P, type the name of a file and press Print."""

    def press(document):
        editor.session.commit(document, "Begin")
        path = tmp_path / "out.pdf"
        editor.key(Qt.Key.Key_P, Qt.KeyboardModifier.ControlModifier)
        dialog = editor.window.findChild(QPrintDialog, "printDialog")
        assert dialog.isVisible()
        name = dialog.findChild(QLineEdit, "filename")
        name.selectAll()
        QTest.keyClicks(name, str(path))
        (button,) = [
            each
            for each in dialog.findChildren(QPushButton)
            if each.text().replace("&", "") == "Print" and isinstance(each.parent(), QDialogButtonBox)
        ]
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        editor.wait_for_work()
        return path

    return press


def media_box(data):
    return [float(each) for each in re.search(rb"/MediaBox \[([^\]]*)\]", data).group(1).split()]


def inked_box(path, tmp_path):
    """Return left, top, right, bottom of what is red on the paper, in millimetres."""
    command = ["gs", "-q", "-dNOPAUSE", "-dBATCH", "-sDEVICE=png16m", "-r127"]
    subprocess.run([*command, f"-sOutputFile={tmp_path / 'page.png'}", str(path)], check=True)
    image = QImage(str(tmp_path / "page.png")).convertToFormat(QImage.Format.Format_RGB32)
    pixels = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4)
    rows, columns = np.nonzero(pixels[:, : image.width(), 1] < 128)
    return [each / 5 for each in (columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)]


@needs_ghostscript
@pytest.mark.parametrize(
    ("page", "paper"),
    [
        (Page(0, 0, 210, 297), (595, 842)),
        (Page(0, 0, 297, 210), (842, 595)),
        (Page(0, 0, 160, 90), (454, 255)),
    ],
)
def test_a_page_is_printed_on_paper_of_its_size_at_true_size(print_by_dialog, editor, tmp_path, page, paper):
    path = print_by_dialog(drawing(page))
    assert editor.status == "Printed to out.pdf, at true size."
    _, _, width, height = media_box(path.read_bytes())
    assert (width, height) == pytest.approx(paper, abs=1)
    box = inked_box(path, tmp_path)
    assert box == pytest.approx([20, page.height - 70, 120, page.height - 20], abs=0.4)


def test_what_is_printed_are_outlines_and_no_picture(print_by_dialog):
    data = print_by_dialog(drawing(Page(0, 0, 210, 297))).read_bytes()
    assert b"/Subtype /Image" not in data
    streams = [zlib.decompress(each) for each in re.findall(rb"stream\r?\n(x.*?)endstream", data, re.DOTALL)]
    assert any(re.search(rb"\b[lc]\n\s*S\b", each) for each in streams)


@needs_ghostscript
def test_a_sketch_is_fitted_on_the_paper_and_hidden_curves_are_left_out(print_by_dialog, editor, tmp_path):
    document = drawing(None, "", [(0, 0), (2, 0)], 1.0)
    far = replace(make_curve([(50, 50), (60, 60)], name="far", family=HERMITE), visible=False)
    path = print_by_dialog(replace(document, curves=(*document.curves, far)))
    assert editor.status == "Printed to out.pdf, fitted on the paper."
    _, _, width, height = (each * 25.4 / 72 for each in media_box(path.read_bytes()))
    left, top, right, bottom = inked_box(path, tmp_path)
    # As large as it can be, in the middle, and as high as half its width.
    assert right - left > 0.8 * width
    assert (left + right, top + bottom) == pytest.approx((width, height), abs=12)
    assert (right - left) / (bottom - top) == pytest.approx(2.0, rel=0.02)


@needs_ghostscript
@pytest.mark.usefixtures("editor")
def test_a_page_larger_than_the_paper_keeps_its_size_and_says_that_it_is_cut(tmp_path):
    document = drawing(Page(0, 0, 400, 400))
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setOutputFileName(str(tmp_path / "cut.pdf"))
    printer.setPageLayout(
        QPageLayout(QPageSize(QPageSize.PageSizeId.A4), QPageLayout.Orientation.Portrait, QMarginsF())
    )
    printer.setFullPage(True)
    said = print_drawing(to_print(document, silent), document, printer)
    assert said == "cut at the edges of the paper, for the page is larger"
    left, _, right, _ = inked_box(tmp_path / "cut.pdf", tmp_path)
    # From −75 to 25 mm, of which the paper shows what is right of its edge.
    assert (left, right) == pytest.approx((0, 25), abs=0.4)


@pytest.mark.qt_log_ignore("QPdfEngine|QPainter::begin")
@pytest.mark.usefixtures("editor")
def test_a_printer_that_does_not_begin_is_told_of(tmp_path):
    document = drawing()
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setOutputFileName(str(tmp_path / "no folder" / "out.pdf"))
    with pytest.raises(ExchangeError, match="did not begin"):
        print_drawing(to_print(document, silent), document, printer)


def test_escape_prints_nothing(editor, tmp_path):
    editor.session.commit(drawing(), "Begin")
    editor.key(Qt.Key.Key_P, Qt.KeyboardModifier.ControlModifier)
    dialog = editor.window.findChild(QPrintDialog, "printDialog")
    QTest.keyClick(dialog, Qt.Key.Key_Escape)
    assert not dialog.isVisible()
    assert "Printed" not in editor.status
