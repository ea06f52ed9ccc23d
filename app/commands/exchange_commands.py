"""Import and export: what comes in from other files, what goes out to them and to the clipboard."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog, QWidget

from app.commands.curve_clipboard import put_on_clipboard
from app.commands.file_work import FileWork
from app.commands.import_series import ImportSeries
from app.commands.parts import Handlers, Parts
from app.document.import_edits import add_imported
from app.document.model import Document
from app.document.words import count_of, listed
from app.exchange.formats import (
    FORMATS,
    Kind,
    Written,
    ending_in,
    format_of,
    is_document,
    with_ending,
)
from app.exchange.options import Options
from app.exchange.reading import import_file
from app.exchange.writing import export
from app.file_commands import file_stem
from app.storage.files import StorageError, read
from app.tasks.progress import Report, part
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.exchange.choice import ExportChoice
    from app.exchange.cubics_in import Imported
    from app.exchange.table.prepared import Prepared
    from app.exchange.table.source import TableSource
    from app.exchange.table.table import Preview
    from app.panels.export_dialog import ExportDialog
    from app.panels.import_drawing_dialog import ImportDrawingDialog
    from app.panels.import_table_dialog import ImportTableDialog

# Readers, writers and dialogs are imported when they are wanted: at the start nobody waits for them.

_SVG_TYPE = "image/svg+xml"
_COPY_WIDTH = 1600
_MOST_REMARKS = 3


class ExchangeCommands:
    """Files of other formats, in and out, beside the window's own thread."""

    def __init__(self, parts: Parts, work: FileWork) -> None:
        self._parts, self._work = parts, work
        self._session, self._preferences = parts.session, parts.preferences
        self._dialog: ExportDialog | None = None
        self._documents = self._meant_for = 0
        self._series = ImportSeries(self._begin, lambda: not work.jobs.is_busy, parts.message_bar.warn)
        work.jobs.ended.connect(self._series.go_on)
        parts.session.opened.connect(self._count_document)
        parts.session.document_changed.connect(self._show_in_dialog)
        parts.session.active_changed.connect(self._show_in_dialog)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "importFile": self._ask_and_import,
            "exportPicture": self._ask_and_export,
            "copyImage": self._copy_image,
            "copyPathData": self._copy_path_data,
        }

    def render(self, view: CurveView) -> None:
        """Enable what needs a curve."""
        for name in ("copyImage", "copyPathData"):
            self._parts.actions[name].setEnabled(view.curve is not None or len(self._session.views) > 1)

    # In

    def _ask_and_import(self) -> None:
        folder = str(self._preferences.last_folder)
        names, _ = QFileDialog.getOpenFileNames(self._parts.window, "Import", folder, _filters())
        if names and not self._work.refuse_second():
            self.import_files([Path(name) for name in names])

    def import_file(self, path: Path) -> None:
        """Read a file of another format and ask what is to become of it, or say why it cannot be read."""
        if not self._work.refuse_second():
            self.import_files([path])

    def import_files(self, paths: Iterable[Path]) -> None:
        """Import these one after the other, each when the one before has been answered."""
        if not self._series.is_busy:
            self._meant_for = self._documents
        self._series.add(paths)

    def close(self) -> None:
        """Forget what waits to be imported."""
        self._series.skip_rest()

    def _begin(self, path: Path) -> None:
        def work(report: Report) -> Imported | _OpenTable:
            form = format_of(path, FORMATS.read)
            if form.kind is not Kind.TABLE:
                return import_file(path, report=report)
            report(0.0, "Reading")
            data = read(path)
            if is_document(data):
                return import_file(path, report=report)
            return _opened_table(data, ending_in(path, form))

        def done(found: Imported | _OpenTable) -> None:
            if self._meant_for != self._documents:
                self._give_up()
                return
            try:
                self._ask_about(path, found)
            except Exception:
                self._series.end()
                raise

        if self._meant_for != self._documents:
            # It has waited for other work, and another document must not get its curves.
            self._give_up()
        else:
            self._work.start(f"Reading {path.name}", work, done, path, "imported", self._series.end)

    def _count_document(self) -> None:
        self._documents += 1

    def _give_up(self) -> None:
        """Leave out what was meant for another document than there is now."""
        names = listed(self._series.skip_rest())
        self._session.refuse(f"{names} not imported, for another document was opened meanwhile.")
        self._series.end()

    def _ask(self, dialog: ImportDrawingDialog | ImportTableDialog) -> None:
        """Show the dialog of an import until it is answered or another document is opened."""

        def leave() -> None:
            dialog.rejected.disconnect(self._series.end)
            dialog.reject()
            self._give_up()

        def skip_rest() -> None:
            names = listed(self._series.skip_rest())
            dialog.reject()
            self._session.say(f"{names} left out.")

        def forget() -> None:
            self._session.opened.disconnect(leave)
            self._series.changed = None

        self._session.opened.connect(leave)
        dialog.finished.connect(forget)
        dialog.rejected.connect(self._series.end)
        dialog.foot.rest_skipped.connect(skip_rest)
        dialog.foot.show_turn(self._series.turn)
        self._series.changed = dialog.foot.show_turn
        _open(dialog)

    def _ask_about(self, path: Path, found: Imported | _OpenTable) -> None:
        if isinstance(found, _OpenTable):
            self._ask_about_table(path, found)
        else:
            self._ask_where(path, found)

    def _ask_where(self, path: Path, found: Imported) -> None:
        from app.panels.import_drawing_dialog import ImportDrawingDialog  # noqa: PLC0415

        dialog = ImportDrawingDialog(path.name, found, self._parts.window)
        dialog.chosen.connect(lambda taken, anew: self._take_in(path, taken.document, taken.deviation, anew))
        self._ask(dialog)

    def _ask_about_table(self, path: Path, table: _OpenTable) -> None:
        from app.panels.import_table_dialog import ImportTableDialog  # noqa: PLC0415

        dialog = ImportTableDialog(path.name, path.stem, table.source, table.preview, self._parts.window)
        dialog.chosen.connect(lambda prepared, anew: self._take_table(path, prepared, anew))
        self._ask(dialog)

    def _take_table(self, path: Path, prepared: Prepared, anew: bool) -> None:
        assert prepared.document is not None
        self._take_in(path, prepared.document, prepared.deviation, anew)

    def _take_in(self, path: Path, new: Document, deviation: float, anew: bool) -> None:
        """Add the curves, and go on with the next file."""
        try:
            self._add(path, new, deviation, anew)
        finally:
            # What comes next of the series goes where this one went.
            self._meant_for = self._documents
            self._series.end()

    def _add(self, path: Path, new: Document, deviation: float, anew: bool) -> None:
        """Add the curves as one step, to this document or to a new one."""
        if anew:
            if not self._parts.files.may_discard():
                return
            self._session.new()
        document, first = add_imported(self._session.document, new)
        if not self._session.change(f"Import {path.name}", lambda _: document, active=first):
            return
        if first > 0:
            # What came to others is put in its place as a whole.
            self._session.choose_curves(range(first, first + len(new.curves)))
        self._preferences.last_folder = path.parent
        # What is in sight stays where the person put it, but for a document that holds nothing else.
        if first == 0 or not self._parts.canvas.shows_curves_from(first):
            self._parts.actions["fitView"].trigger()
        count = sum(len(curve.nodes) for curve in new.curves)
        what = f"{count_of(len(new.curves), 'curve')}, {count_of(count, 'point')}"
        exact = f"at most {deviation:.2g} from the file" if deviation else "exact"
        self._session.say(f"Imported {path.name}: {what}, {exact}.")

    # Out

    def _ask_and_export(self) -> None:
        from app.exchange.choice import choice_from  # noqa: PLC0415
        from app.panels.export_dialog import ExportDialog  # noqa: PLC0415

        if self._dialog is None:
            self._dialog = ExportDialog(choice_from(self._preferences.export_choice), self._parts.window)
            self._dialog.chosen.connect(self._ask_where_to)
            self._dialog.finished.connect(self._forget_dialog)
        self._show_in_dialog()
        _open(self._dialog)

    def _forget_dialog(self) -> None:
        self._dialog = None

    def _show_in_dialog(self) -> None:
        if self._dialog is not None:
            preferences, session = self._preferences, self._session
            self._dialog.show_document(
                session.document,
                session.active_index,
                preferences.unit_name,
                with_estimates=preferences.with_estimates,
            )

    def _ask_where_to(self, choice: ExportChoice) -> None:
        from app.exchange.choice import text_of  # noqa: PLC0415

        self._preferences.export_choice = text_of(choice)
        start = self._preferences.last_folder / f"{file_stem(self._session)}{choice.ending}"
        kind = f"{choice.format.title} (*{choice.ending})"
        name, _ = QFileDialog.getSaveFileName(self._parts.window, "Export", str(start), kind)
        if not name:
            return
        path = with_ending(Path(name), choice.ending)
        if path != Path(name) and path.exists():
            # The dialog asked about the name that was typed, if it asked at all.
            there = StorageError("It is there already; choose it in the list to replace it.")
            self._work.refuse(path, "written", there)
            return
        preferences = self._preferences
        with_estimates = preferences.with_estimates
        active, unit = self._session.active_index, preferences.unit_name
        self.export(path, choice.options(active, unit, with_estimates=with_estimates))

    def export(self, path: Path, options: Options | None = None) -> None:
        """Write the document in the format that the ending names, and say how exactly."""
        document, unit = self._session.document, self._preferences.unit_name

        def work(report: Report) -> Written:
            return export(document, path, (options or Options(unit=unit)).reporting(report))

        self._work.start(
            f"Writing {path.name}", work, lambda written: self._say_written(path, written), path, "written"
        )

    def _say_written(self, path: Path, written: Written) -> None:
        self._preferences.last_folder = path.parent
        away = written.deviation
        what = f"at most {away:.2g} from the true curve" if away else "exact"
        if written.pixels is not None:
            # Pixels are not exact, whatever they were painted from.
            what = f"{written.pixels[0]} × {written.pixels[1]} pixels"
        self._session.say(f"Wrote {path.name}, {what}.")
        self._warn_of(written.remarks)

    def _warn_of(self, remarks: Sequence[str]) -> None:
        """Say what was left out of a file that was written."""
        more = [f"And {len(remarks) - _MOST_REMARKS} more."] if len(remarks) > _MOST_REMARKS else []
        if remarks:
            self._parts.message_bar.warn(" ".join([*remarks[:_MOST_REMARKS], *more]))

    # To the clipboard

    def _copy_image(self) -> None:
        """Put the curves on the clipboard as a PNG without paper and as SVG."""
        document, unit = self._session.document, self._preferences.unit_name

        def work(report: Report) -> tuple[bytes, bytes]:
            from app.exchange.drawing.image import png_file  # noqa: PLC0415
            from app.exchange.svg.writer import svg_of  # noqa: PLC0415

            options = Options(width=_COPY_WIDTH, transparent=True, report=part(report, 0.0, 0.5))
            png = png_file(document, options).data
            return png, svg_of(document, unit=unit, report=part(report, 0.5, 1.0)).encode()

        self._work.start("Drawing", work, self._put_image, Path("The image"), "copied")

    def _put_image(self, pictures: tuple[bytes, bytes]) -> None:
        from PySide6.QtGui import QImage  # noqa: PLC0415

        png, svg = pictures
        data = QMimeData()
        data.setData("image/png", png)
        data.setData(_SVG_TYPE, svg)
        data.setImageData(QImage.fromData(png))
        put_on_clipboard(data)
        self._session.say("Copied the curves as an image: PNG without paper, and SVG.")

    def _copy_path_data(self) -> None:
        document = self._session.document

        def work(report: Report) -> Written:
            from app.exchange.formats.formulas import svg_path_data  # noqa: PLC0415

            return svg_path_data(document, report=report)

        def done(written: Written) -> None:
            QGuiApplication.clipboard().setText(written.text)
            self._session.say("Copied the curves as SVG path data.")
            self._warn_of(written.remarks)

        self._work.start("Writing path data", work, done, Path("The path data"), "copied")


@dataclass(frozen=True)
class _OpenTable:
    """A table that was read so far that somebody can say what its columns are."""

    source: TableSource
    preview: Preview


def _opened_table(data: bytes, ending: str) -> _OpenTable:
    from app.exchange.table.source import TableSource  # noqa: PLC0415

    source = TableSource(data, ending)
    return _OpenTable(source, source.preview())


def _filters() -> str:
    """Return the kinds of files for the dialog that asks for one."""
    everything = f"Curves and tables ({' '.join(each.patterns for each in FORMATS.read)})"
    kinds = [f"{each.plural} ({each.patterns})" for each in FORMATS.read]
    return ";;".join([everything, *kinds, "All files (*)"])


def _open(dialog: QWidget) -> None:
    dialog.show()
    dialog.raise_()
    dialog.activateWindow()
