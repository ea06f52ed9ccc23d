"""Revert to Saved: what the file of the document holds, of whatever format it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ... import exchange
from ...actions.declaration import action
from ...actions.needs import Need
from ...actions.sections import FILE_SAVE
from ...actions.situation import Situation
from ...document.edits import EditError
from ...storage.foreign import Foreign
from ...storage.reasons import shown
from ...tasks.progress import Report
from ...view_model.pieces.arrivals import Arrival
from ...workbench.contents_here import as_here
from ...workbench.context import WindowContext
from .. import import_export

if TYPE_CHECKING:
    from ...exchange.cubics_in import Imported


def _has_file(now: Situation) -> bool:
    files = now.session.files
    return files.path is not None or files.foreign is not None


class RevertCommands:
    """Reads the file again; that is a step of the history, which Undo takes back."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action(
        "revertToSaved",
        "Revert to Saved",
        FILE_SAVE,
        "",
        "reset",
        keywords="reload discard changes again file",
        needs=Need("a document with a file", _has_file),
    )
    def _revert(self) -> None:
        """Go back to what the file holds; Undo brings back what was here."""
        session, foreign = self._session, self._session.files.foreign
        if session.files.path is not None or foreign is None:
            self._context.actions["reloadFile"].trigger()
            return
        path, begun, intake = foreign.path, session.files.beginning, import_export.intake

        def work(report: Report) -> tuple[Imported, Arrival]:
            found = as_here(exchange.reading.import_file(path, report=report))
            return found, intake.intake(session.files.blank(), found.document)

        def done(read: tuple[Imported, Arrival]) -> None:
            if session.files.beginning is begun:
                self._put(foreign, *read)
            else:
                session.refuse(f"{shown(path.name)} was not read again, for another document was opened.")

        self._context.work.start(f"Reading {shown(path.name)}", work, done, path, "read again")

    def _put(self, foreign: Foreign, found: Imported, arrival: Arrival) -> None:
        session, path = self._session, foreign.path
        origin = import_export.intake.origin_of(path, arrival, found)
        try:
            session.files.begin_imported(
                arrival.document, path.stem, "Revert to Saved", arrival.views, origin
            )
        except EditError as reason:
            session.refuse(str(reason))
            return
        session.undo_stack.setClean()
        session.file_changed.emit()
        session.say(f"Reverted to {shown(path.name)}; Undo brings back what was here.")
