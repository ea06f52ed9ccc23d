"""Save a Copy: the document in another file, while this one stays the file of the document."""

from __future__ import annotations

from pathlib import Path

from msgspec.structs import replace

from ...actions.declaration import action
from ...actions.sections import FILE_SAVE
from ...storage.files import StorageError
from ...storage.format_error import FormatError
from ...storage.open_file import OpenFile
from ...storage.reasons import shown
from ...workbench.context import WindowContext


class SaveCopyCommands:
    """Writes the document elsewhere; title, changes and the file that Save writes stay as they are."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action(
        "saveCopy",
        "Save a Copy…",
        FILE_SAVE,
        "Ctrl+Alt+Shift+S",
        "save-copy",
        keywords="duplicate backup version elsewhere",
    )
    def _save_copy(self) -> None:
        """Write the document to another file, and go on with this one."""
        path = self._context.files.ask_where("Save a Copy", is_copy=True)
        if path is None:
            return
        self._session.cancel()
        if self._is_own(path):
            self._warn(path, StorageError("It is the file of this document; choose another name."))
        else:
            self._write(path)

    def _is_own(self, path: Path) -> bool:
        own = self._session.files.path
        return own is not None and own.resolve() == path.resolve()

    def _write(self, path: Path) -> None:
        """Write a document of ours; one that somebody has open is left alone."""
        session = self._session
        document = replace(session.committed, export=session.files.last_export)
        try:
            OpenFile.saved(path, document, None).close()
        except (FormatError, StorageError) as problem:
            self._warn(path, problem)
            return
        self._context.preferences.last_folder = path.parent
        session.say(f"Saved a copy as {shown(path.name)}.")

    def _warn(self, path: Path, problem: Exception) -> None:
        self._context.work.refuse(path, "saved", problem)
