"""Import of files in other formats."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog

from ... import exchange
from ...actions.declaration import action
from ...actions.menus import FILE_EXCHANGE
from ...document.groups import shape_count_label
from ...document.limits import EditError
from ...document.model import Document
from ...document.style import Style
from ...document.words import count_of, distance_text, names_with_verb
from ...exchange import table
from ...exchange.formats import ContentKind, file_filters
from ...storage.files import IMAGE_PATTERNS, IMAGE_SUFFIXES
from ...tasks.progress import Report
from ...workbench.context import WindowContext
from .. import import_export
from .export_commands import CopyCommands, ExportCommands
from .import_series import MANY_POINTS, ImportSeries, intake, points_of, rest_message

if TYPE_CHECKING:
    from ...exchange.cubics_in import ImportResult
    from ...exchange.table.source import PreparedTable, TableSource
    from ...exchange.table.table import Preview
    from ...view_model.paste import AddedCurves
    from .import_drawing_dialog import ImportDrawingDialog
    from .import_table_dialog import ImportTableDialog

# Readers and dialogs are imported when they are used, not at the start.

_NOT_IMPORTED = "{} not imported because another document was opened in the meantime."


class ImportCommands:
    """Import of files in other formats, read in a thread of their own."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._work = context, context.work
        self._session, self._preferences = context.session, context.preferences
        self._document_number = self._target_number = 0
        self._series = ImportSeries(
            self._begin, lambda: not self._work.jobs.is_busy, context.central.message_bar.warn
        )
        self._opened: Path | None = None
        context.files.open_foreign = self._open
        context.files.take_opened = self._take_opened
        self._work.jobs.ended.connect(self._series.go_on)
        context.session.opened.connect(self._count_document)

    @action("importFile", "Import…", FILE_EXCHANGE, "Ctrl+I", "import")
    def _ask_and_import(self) -> None:
        """Import curves from SVG, DXF, tables, GPX, robot paths or documents, or a picture to trace."""
        folder, kinds = str(self._preferences.last_folder), file_filters(IMAGE_PATTERNS)
        names, _ = QFileDialog.getOpenFileNames(self._context.window, "Import", folder, kinds)
        paths = [Path(name) for name in names]
        pictures = [path for path in paths if path.suffix.lower() in IMAGE_SUFFIXES]
        if others := self._context.files.trace(pictures):
            self._context.central.message_bar.warn(others)
        drawings = [path for path in paths if path not in pictures]
        if drawings and not self._work.refuse_second():
            self.import_files(drawings)

    def import_files(self, paths: Iterable[Path], opened: Path | None = None) -> None:
        """Import files one after the other, each after the dialog of the one before.

        The file `opened` becomes a document of its own.
        """
        if not self._series.is_busy:
            self._target_number, self._opened = self._document_number, None
        self._opened = opened or self._opened
        self._series.add(paths)

    def _open(self, path: Path) -> None:
        """Import a file as a new document, unless the user adds it to this one."""
        if not self._work.refuse_second():
            self.import_files([path], opened=path)

    def close(self) -> None:
        """Forget the files that wait to be imported."""
        self._series.skip_rest()

    def _begin(self, path: Path) -> None:
        def work(report: Report) -> ImportResult | _OpenTable:
            report(0.0, "Reading")
            file = exchange.files.foreign_file(path)
            if file.form.kind is not ContentKind.TABLE:
                return exchange.files.import_file(path, report=report)
            source = table.source.TableSource(file.data, file.form.read)
            return _OpenTable(source, source.preview())

        def done(content: ImportResult | _OpenTable) -> None:
            if self._target_number != self._document_number:
                self._drop_stale()
                return
            try:
                self._show_dialog_for(path, content)
            except Exception:
                self._series.end()
                raise

        if self._target_number != self._document_number:
            # Another document was opened while the file waited, and must not get its curves.
            self._drop_stale()
        else:
            self._work.start(f"Reading {path.name}", work, done, path, "imported", self._series.end)

    def _count_document(self) -> None:
        self._document_number += 1

    def _drop_stale(self) -> None:
        """Drop the files that were meant for a document that is no longer open."""
        names = names_with_verb(self._series.skip_rest())
        self._session.refuse(_NOT_IMPORTED.format(names))
        self._series.end()

    def _ask(self, dialog: ImportDrawingDialog | ImportTableDialog) -> None:
        """Show the dialog of an import until it is answered or another document is opened."""

        def leave() -> None:
            dialog.rejected.disconnect(self._series.end)
            dialog.reject()
            self._drop_stale()

        def skip_rest() -> None:
            names = names_with_verb(self._series.skip_rest())
            dialog.reject()
            self._session.say(f"{names} skipped.")

        def release() -> None:
            self._session.opened.disconnect(leave)
            self._series.changed = None

        self._session.opened.connect(leave)
        dialog.finished.connect(release)
        dialog.rejected.connect(self._series.end)
        dialog.foot.rest_skipped.connect(skip_rest)
        dialog.foot.show_position(self._series.position)
        self._series.changed = dialog.foot.show_position
        dialog.bring_up()

    def _show_dialog_for(self, path: Path, content: ImportResult | _OpenTable) -> None:
        if path == self._opened and not isinstance(content, _OpenTable) and self._skips_dialog(path, content):
            self._add_result(path, content, True)
            return
        dialogs, parent = import_export, self._context.window
        verbs = dialogs.work_dialog.Verb
        verb = verbs.OPEN if path == self._opened else verbs.IMPORT
        dialog: ImportDrawingDialog | ImportTableDialog
        if isinstance(content, _OpenTable):
            dialog = dialogs.import_table_dialog.ImportTableDialog(
                verb, path.name, path.stem, content.source, content.preview, parent
            )
        else:
            dialog = dialogs.import_drawing_dialog.ImportDrawingDialog(
                verb, path.name, content, partial(self._rest_message, content.document), parent
            )
        dialog.import_requested.connect(partial(self._add_result, path))
        self._ask(dialog)

    def _skips_dialog(self, path: Path, result: ImportResult) -> bool:
        """Whether a file is opened without a dialog: it has no remarks, or is known."""
        return not result.remarks or self._is_recent(path)

    def _is_recent(self, path: Path) -> bool:
        """Whether a file was opened or saved here lately, so that its remarks are known."""
        return path.absolute() in self._preferences.recent_files

    def _add_result(self, path: Path, result: ImportResult | PreparedTable, anew: bool) -> None:
        """Begin a document with the curves or add them, then go on with the next file."""
        files, session = self._context.files, self._session
        assert result.document is not None
        if anew and (self._hand_over(path, result) or not files.may_discard()):
            self._end_turn()
            return
        new, begins = result.document, anew or session.files.is_untouched
        target = self._target(anew)
        rest = self._loss_message(path, result) + self._rest_message(new, anew)

        def work(report: Report) -> AddedCurves:
            return intake(target, new, lambda share: report(share, "Computing curves"))

        def done(arrival: AddedCurves) -> None:
            try:
                if self._target_number != self._document_number:
                    session.refuse(_NOT_IMPORTED.format(names_with_verb([path.name])))
                    return
                if not begins and session.committed is not target:
                    arrival = intake(session.committed, new)
                factor = exchange.units.factor_between(new.unit, arrival.document.unit)
                style = session.template_curve.style
                if self._commit_curves(path, arrival, begins=begins, anew=anew):
                    verb = "Opened" if anew and path == self._opened else "Imported"
                    deviation = result.deviation * factor
                    done_so = f"{verb} {path.name}"
                    self._select_added(arrival, style, is_brought=not anew)
                    self._show_added(done_so, path, arrival, deviation, rest)
            finally:
                self._end_turn()

        self._target_number = self._document_number
        if points_of(new) < MANY_POINTS:
            done(intake(target, new))
        else:
            self._work.start(f"Importing {path.name}", work, done, path, "imported", self._series.end)

    def _hand_over(self, path: Path, result: ImportResult | PreparedTable) -> bool:
        """Hand the result to another window, where one is meant for it; return whether there is one."""
        other = self._context.files.elsewhere()
        if other is not None:
            other.take_opened(path, result)
        return other is not None

    def _loss_message(self, path: Path, result: ImportResult | PreparedTable) -> str:
        """Return the remarks on a file that is opened without a dialog."""
        is_asked = path != self._opened or not self._is_recent(path)
        return "" if is_asked else "".join(f"{remark} " for remark in result.remarks)

    def _take_opened(self, path: Path, result: ImportResult | PreparedTable) -> None:
        """Begin a document with a result that another window has read."""
        self._target_number, self._opened = self._document_number, path
        self._add_result(path, result, True)

    def _target(self, anew: bool) -> Document:
        """Return the document that curves go to."""
        files = self._session.files
        return files.blank() if anew or files.is_untouched else self._session.committed

    def _rest_message(self, new: Document, anew: bool) -> str:
        return rest_message(self._target(anew), new)

    def _end_turn(self) -> None:
        # The next file of the series goes to the same document.
        self._target_number = self._document_number
        self._series.end()

    def _commit_curves(self, path: Path, arrival: AddedCurves, *, begins: bool, anew: bool) -> bool:
        """Begin a document with the added curves, or add them as a step; return whether that worked."""
        session, step = self._session, f"Import {path.name}"
        if not begins:
            session.expect(arrival.views)
            return bool(session.change(step, lambda _: arrival.document, active=arrival.indices.start))
        try:
            session.files.begin_imported(arrival.document, path.stem, "" if anew else step, arrival.views)
        except EditError as reason:
            session.refuse(str(reason))
            return False
        if path == self._opened:
            self._preferences.add_recent_file(path.absolute())
        return True

    def _select_added(self, arrival: AddedCurves, style: Style, *, is_brought: bool) -> None:
        """Select curves that were added to others; the next curve drawn does not get their style."""
        added, document, selected = arrival.indices, arrival.document, self._session.selected
        if len(added) < len(document.curves) or (is_brought and len(added) > 1):
            # Added curves are selected, ready to be moved as a whole, except locked ones.
            selected.select_imported(
                [index for index in added if document.curves[index].is_selectable], style
            )
        elif len(added) > 1:
            selected.select_imported((), self._session.files.blank().curves[0].style)

    def _show_added(self, done: str, path: Path, arrival: AddedCurves, deviation: float, rest: str) -> None:
        """Show the imported curves, and describe them in the status line."""
        added, document = arrival.indices, arrival.document
        curves, is_all = document.curves[added.start : added.stop], len(added) == len(document.curves)
        self._preferences.last_folder = path.parent
        # The view stays, unless the document holds nothing else or the curves are outside it.
        central = self._context.central
        if is_all:
            central.fit()
        elif not central.canvas.framing.shows_curves(added):
            self._context.actions["fitView"].trigger()
        count = sum(len(curve.points) for curve in curves)
        exact = distance_text(deviation, "the file")
        what = f"{shape_count_label(curves)}, {count_of(count, 'point')}, {exact}" if count else "no curves"
        self._session.say(f"{done}: {what}. {rest}".rstrip())


@dataclass(frozen=True)
class _OpenTable:
    """A table whose columns wait for their roles."""

    source: TableSource
    preview: Preview


COMMAND_SETS = (
    ImportCommands,
    ExportCommands,
    CopyCommands,
)
