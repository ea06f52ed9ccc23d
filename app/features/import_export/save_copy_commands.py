"""Save a Copy: the document in another file, while this one stays the file of the document."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from msgspec.structs import replace

from ... import exchange
from ...actions.declaration import action
from ...actions.sections import FILE_SAVE
from ...document.model import Document
from ...storage.files import StorageError
from ...storage.format_error import FormatError
from ...storage.open_file import OpenFile
from ...storage.reasons import shown
from ...workbench.context import WindowContext
from ...workbench.file_names import is_svg
from .overwrite_commands import Done, written_to


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
        elif is_svg(path):
            self._write_svg(path)
        else:
            self._write(path)

    def _is_own(self, path: Path) -> bool:
        files = self._session.files
        own = files.path or (files.foreign.path if files.foreign is not None else None)
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
        self._tell(path)

    def _write_svg(self, path: Path) -> None:
        """Write an SVG, with all else in that which the document was opened from."""
        document, origin = self._session.committed, self._session.files.foreign
        work = partial(written_to, path.absolute(), origin, document)
        done = partial(self._tell_of_svg, path, document)
        self._context.work.start(f"Writing {shown(path.name)}", work, done, path, "saved")

    def _tell_of_svg(self, path: Path, document: Document, done: Done) -> None:
        lasting = exchange.lasting
        self._tell(path, lasting.words_about_loss(document, path), *done.written.changes)
        self._context.work.warn_of(done.written.remarks)

    def _tell(self, path: Path, *more: str) -> None:
        self._context.preferences.last_folder = path.parent
        self._session.say(" ".join(filter(None, [f"Saved a copy as {shown(path.name)}.", *more])))

    def _warn(self, path: Path, problem: Exception) -> None:
        self._context.work.refuse(path, "saved", problem)
