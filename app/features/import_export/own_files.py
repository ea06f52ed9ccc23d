"""Each chosen object exported to a file of its own, into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog, QMessageBox

from ... import exchange
from ...document.words import count_of
from ...workbench.context import WindowContext

if TYPE_CHECKING:
    from ...exchange.choice import ExportChoice
    from ...exchange.each import OwnFile
    from ...exchange.formats import Written


class OwnFiles:
    """Asks for a folder, and writes a file there for each object that is chosen."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    def ask(self, choice: ExportChoice) -> None:
        """Ask where to, and about files that are there already."""
        window, preferences = self._context.window, self._context.preferences
        name = QFileDialog.getExistingDirectory(window, "Export to Folder", str(preferences.last_folder))
        if not name:
            return
        folder, session = Path(name), self._session
        estimates, chosen = preferences.with_estimates, session.selected.chosen
        files = exchange.each.own_files(choice, session.document, chosen, with_estimates=estimates)
        there = [each.name for each in files if (folder / each.name).exists()]
        if there and not self._may_replace(folder, there):
            return
        preferences.export_choice = exchange.choice.text_of(choice)

        def done(written: Sequence[Written]) -> None:
            preferences.last_folder = folder
            session.say(f"Wrote {count_of(len(files), 'file')} to {folder.name}: {_listed(files)}.")
            self._context.work.warn_of([remark for each in written for remark in each.remarks])

        self._context.work.start(
            f"Writing {count_of(len(files), 'file')}",
            lambda report: exchange.each.write_all(folder, files, report),
            done,
            folder,
            "written",
        )

    def _may_replace(self, folder: Path, names: Sequence[str]) -> bool:
        what = f"“{names[0]}” is" if len(names) == 1 else f"{len(names)} of these files are"
        question = f"{what} in “{folder.name}” already. Replace?"
        return (
            QMessageBox.question(self._context.window, "Export", question) == QMessageBox.StandardButton.Yes
        )


def _listed(files: Sequence[OwnFile]) -> str:
    names = [each.name for each in files]
    return ", ".join(names if len(names) <= 3 else [*names[:2], "…"])
