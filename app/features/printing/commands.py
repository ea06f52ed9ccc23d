"""Print: the page of the drawing, or a sketch's curves, on paper."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ... import exchange
from ...actions.declaration import action
from ...actions.needs import Need
from ...actions.sections import FILE_PRINT
from ...document.model import Document
from ...exchange.errors import ExchangeError
from ...tasks.progress import Report
from ...workbench.context import WindowContext
from ...workbench.file_names import file_stem
from ...workbench.undrawn import words_about_undrawn
from .. import printing

if TYPE_CHECKING:
    from PySide6.QtPrintSupport import QPrinter

    from ...exchange.drawing.drawing import Drawing


_WHAT = Path("The drawing")


class PrintCommands:
    """Asks by the system's dialog, and prints as a PDF export draws."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action(
        "print",
        "Print…",
        FILE_PRINT,
        "Ctrl+P",
        "print",
        keywords="paper printer true size",
        needs=Need("a curve through two points or more", lambda now: not now.is_blank),
    )
    def _ask_and_print(self) -> None:
        """Print the page at true size, or the visible curves of a sketch; also to a file."""
        if self._context.work.refuse_second():
            return
        paper, document = printing.paper, self._session.committed
        printer = paper.printer_for(document, file_stem(self._session))
        if undrawn := words_about_undrawn(self._session, document):
            self._context.central.message_bar.warn(undrawn)
        dialog = paper.dialog_for(printer, self._context.window)
        dialog.accepted.connect(lambda: self._print(printer, document))
        dialog.finished.connect(dialog.deleteLater)
        paper.ask(dialog)

    def _print(self, printer: QPrinter, document: Document) -> None:
        """Compute the curves beside the window, then hand them to the printer."""
        made = exchange.drawing.printed
        printing.paper.restore_size(printer, document)

        def work(report: Report) -> Drawing:
            return made.to_print(document, report)

        def done(drawing: Drawing) -> None:
            try:
                remark = made.print_drawing(drawing, document, printer)
            except ExchangeError as problem:
                self._context.work.refuse(_WHAT, "printed", problem)
                return
            where = printer.outputFileName().rpartition("/")[2] or printer.printerName()
            to = f" to {where}" if where else ""
            self._session.say(f"Printed{to}, {remark or 'at true size'}.")

        self._context.work.start("Printing", work, done, _WHAT, "printed")


COMMAND_SETS = (PrintCommands,)
