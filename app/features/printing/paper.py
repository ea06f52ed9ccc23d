"""The printer's paper for a document, and the system's dialog about it."""

from __future__ import annotations

from PySide6.QtCore import QMarginsF, QSizeF
from PySide6.QtGui import QPageLayout, QPageSize
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtWidgets import QDialog, QWidget

from ...document.model import Document
from ...exchange.units import MILLIMETRES, known_unit


def printer_for(document: Document, name: str) -> QPrinter:
    """Return the usual printer, with paper of the size of the document's page where it has one."""
    printer = QPrinter(QPrinter.PrinterMode.HighResolution)
    printer.setDocName(name)
    printer.setCreator("Curvebench")
    page, scale = document.page, MILLIMETRES.get(known_unit(document.unit))
    if page is not None and scale is not None:
        printer.setFullPage(True)
        printer.setPageLayout(_layout_of(page.width * scale, page.height * scale))
    return printer


def restore_size(printer: QPrinter, document: Document) -> None:
    """Give a file paper of the size of the page again where that has no name.

    The dialog knows paper with a name only (Qt 6.11 on Linux), and gives what has none the size of its own
    choice.
    """
    wanted = printer_for(document, "").pageLayout()
    is_file = printer.outputFormat() is QPrinter.OutputFormat.PdfFormat
    if is_file and wanted.pageSize().id() is QPageSize.PageSizeId.Custom and document.page is not None:
        printer.setPageLayout(wanted)


def _layout_of(width: float, height: float) -> QPageLayout:
    """Return the layout of paper of a size in millimetres, under the name that it has, such as A4."""
    across = width > height
    upright = QSizeF(min(width, height), max(width, height))
    size = QPageSize(upright, QPageSize.Unit.Millimeter, "", QPageSize.SizeMatchPolicy.FuzzyMatch)
    ways = QPageLayout.Orientation
    layout = QPageLayout(size, ways.Landscape if across else ways.Portrait, QMarginsF())
    layout.setMode(QPageLayout.Mode.FullPageMode)
    return layout


def dialog_for(printer: QPrinter, window: QWidget) -> QPrintDialog:
    """Return the system's dialog about a printer: there is one page."""
    dialog = QPrintDialog(printer, window)
    dialog.setObjectName("printDialog")
    dialog.setWindowTitle("Print")
    options = QPrintDialog.PrintDialogOption
    for each in (options.PrintPageRange, options.PrintSelection, options.PrintCurrentPage):
        dialog.setOption(each, False)
    return dialog


def ask(dialog: QPrintDialog) -> None:
    """Show the dialog, and go on."""
    # Its own `open` wants a receiver.
    QDialog.open(dialog)
