"""Export and Copy As: files of other formats, and pictures on the clipboard."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QMimeData, SignalInstance
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QFileDialog

from ... import exchange
from ...actions.declaration import action
from ...actions.menus import EDIT_COPY_AS, FILE_EXCHANGE
from ...actions.needs import Need
from ...document.model import Document
from ...document.several_curves import extract_curves, name_or_count
from ...exchange.formats import ExportResult, typed_format, with_ending
from ...storage.files import StorageError
from ...tasks.progress import Report, part
from ...workbench.clipboard import SVG, put_on_clipboard
from ...workbench.context import CommandSet, WindowContext
from ...workbench.document_files import file_stem, valid_stem
from ...workbench.file_work import WRITTEN
from .. import import_export

if TYPE_CHECKING:
    from ...exchange.export_choice import ExportChoice
    from ...exchange.options import Options
    from .export_dialog import ExportDialog

# Writers and dialogs are imported when they are used, not at the start.


class ExportCommands:
    """Export to other formats, written in a thread of its own."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._work = context, context.work
        self._session, self._preferences = context.session, context.preferences
        self._dialog: ExportDialog | None = None

    @action("exportPicture", "Export…", FILE_EXCHANGE, "Ctrl+E, Ctrl+Shift+E", "export")
    def _ask_and_export(self) -> None:
        """Export all curves or the selected ones as a picture, splines, code or numbers."""
        if self._dialog is None:
            self._dialog = import_export.export_dialog.ExportDialog(
                self._usual_choice(), self._context.window
            )
            self._dialog.export_requested.connect(self._ask_where)
            self._dialog.finished.connect(self._release_dialog)
            for changed in self._dialog_signals:
                changed.connect(self._show_in_dialog)
        self._show_in_dialog()
        self._dialog.bring_up()

    def _usual_choice(self) -> ExportChoice:
        """Return the last choice of this document, or else of any one, for selected curves if any."""
        remembered, session = exchange.export_choice, self._session
        if of_document := remembered.choice_of(session.files.last_export):
            return of_document
        usual = remembered.choice_from(self._preferences.export_choice)
        return usual.of_selected() if session.selected.whole_curves else usual

    @property
    def _dialog_signals(self) -> tuple[SignalInstance, ...]:
        """Signals after which the dialog shows something else."""
        session = self._session
        return (session.document_changed, session.active_changed, session.selected_curves_changed)

    def _release_dialog(self) -> None:
        # A dialog that is closed twice is released once.
        if self._dialog is None:
            return
        self._dialog = None
        for changed in self._dialog_signals:
            changed.disconnect(self._show_in_dialog)

    def _show_in_dialog(self) -> None:
        if self._dialog is not None:
            session = self._session
            self._dialog.show_document(
                session.document,
                session.active_index,
                session.selected.marked,
                with_estimates=self._preferences.with_estimates,
            )

    def _ask_where(self, choice: ExportChoice) -> None:
        session, last = self._session, self._session.files.last_export
        self._preferences.export_choice = exchange.export_choice.text_of(choice)
        known = exchange.export_choice.suggested_name(choice, session.document, session.selected.marked, last)
        usual = valid_stem(known or file_stem(session)) + choice.ending
        kind = f"{choice.format.title} (*{choice.ending})"
        start = str(self._preferences.last_folder / usual)
        name, _ = QFileDialog.getSaveFileName(self._context.window, "Export", start, kind)
        if not name:
            return
        form = typed_format(Path(name), choice.format)
        path, choice = with_ending(Path(name), form), replace(choice, ending=form.ending)
        if path != Path(name) and path.exists():
            # The file dialog asked about the typed name only, not about the one with an ending.
            there = StorageError("The file already exists. Select it in the list to replace it.")
            self._work.refuse(path, WRITTEN, there)
            return
        session.files.note_export(exchange.export_choice.export_record(choice, path.name, last))
        order = choice.request(
            session.document,
            session.active_index,
            session.selected.marked,
            with_estimates=self._preferences.with_estimates,
        )
        self.export(path, order.options, order.document)

    def export(self, path: Path, options: Options | None = None, document: Document | None = None) -> None:
        """Write the document, or a part of it, in the format of the ending; state its accuracy."""
        document = document or self._session.document
        options = options or exchange.options.Options(unit=document.unit)

        def work(report: Report) -> ExportResult:
            return exchange.files.export(document, path, options.reporting(report))

        self._work.start(
            f"Writing {path.name}", work, lambda written: self._say_written(path, written), path, WRITTEN
        )

    def _say_written(self, path: Path, written: ExportResult) -> None:
        self._preferences.last_folder = path.parent
        self._session.say(f"Wrote {', '.join(filter(None, (path.name, written.summary)))}.")
        self._work.warn_of(written.remarks)


_WIDTH = 1600
_TEXT, _PNG = "text/plain", "image/png"

_Written = dict[str, "ExportResult"]
"""Contents of the clipboard, by their media types; the first has the remarks."""

_ANY_CURVE = Need("a curve with at least two points", lambda state: state.has_curve or state.curve_count > 1)


class CopyCommands(CommandSet):
    """Copies as SVG, as an image and as path data."""

    @action("copySvg", "Copy as SVG", EDIT_COPY_AS, needs=_ANY_CURVE, keywords="inkscape, figma, markup")
    def _copy_svg(self) -> None:
        """Copy the selected curves, or all curves, as SVG for drawing programs and as text."""

        def work(document: Document, report: Report) -> _Written:
            pixels = exchange.svg_for_clipboard(document, part(report, 0.0, 0.5))
            return {SVG: pixels, _TEXT: exchange.svg_for_clipboard(document, part(report, 0.5, 1.0), False)}

        self._start("Writing SVG", "The SVG", "as SVG", work)

    @action("copyImage", "Copy as Image", EDIT_COPY_AS, "Ctrl+Shift+C", needs=_ANY_CURVE)
    def _copy_image(self) -> None:
        """Copy the selected curves, or all curves, as PNG and SVG on the paper of the document, if any."""

        def work(document: Document, report: Report) -> _Written:
            style = exchange.drawing.styles.ON_PAPER.get(document.paper)
            options = exchange.options.Options(
                width=_WIDTH, style=style, transparent=style is None, report=part(report, 0.0, 0.5)
            )
            png = exchange.png_file(document, options)
            return {_PNG: png, SVG: exchange.svg_for_clipboard(document, part(report, 0.5, 1.0))}

        on = "" if self._session.document.paper else " without a background"
        self._start("Drawing", "The image", f"as an image (PNG and SVG{on})", work)

    @action("copyPathData", "Copy as SVG Path", EDIT_COPY_AS, needs=_ANY_CURVE)
    def _copy_path_data(self) -> None:
        """Copy the selected curves, or all curves, as SVG path data."""

        def work(document: Document, report: Report) -> _Written:
            return {_TEXT: exchange.svg_path_data(document, exchange.options.Options(report=report))}

        self._start("Writing path data", "The path data", "as SVG path data", work)

    def _start(self, title: str, name: str, how: str, work: Callable[[Document, Report], _Written]) -> None:
        """Do work on the copied curves beside the window, and put the result on the clipboard."""
        document, selected = self._session.document, self._session.selected.whole_curves
        what = "the drawing"
        if selected:
            document, what = extract_curves(document, selected), name_or_count(document, selected)

        def put(written: _Written) -> None:
            data = QMimeData()
            for kind, result in written.items():
                data.setData(kind, result.data)
            if _PNG in written:
                data.setImageData(QImage.fromData(written[_PNG].data))
            put_on_clipboard(data)
            self._session.say(f"Copied {what} {how}.")
            self._context.work.warn_of(next(iter(written.values())).remarks)

        self._context.work.start(title, lambda report: work(document, report), put, Path(name), "copied")
