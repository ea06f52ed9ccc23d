"""Files and drawings dragged over the window, and files named at the start; they are only read."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QDropEvent

from ..document.model import Vector
from ..document.words import count_of, names_of, names_with_verb
from ..storage.files import StorageError
from ..storage.format_error import FormatError
from ..workbench.context import WindowContext, hooks
from .given_files import GivenFiles, given_files

MOST_WINDOWS = 12
"""Largest number of documents that one drop opens: not a hundred windows for the content of a folder."""

OpenWindow = Callable[[Path], None]


def dropped(event: QDropEvent) -> GivenFiles:
    """Return the dragged files."""
    urls = event.mimeData().urls()
    paths = (Path(url.toLocalFile()) for url in urls if url.isLocalFile())
    return given_files(paths, elsewhere=sum(not url.isLocalFile() for url in urls))


def accepted(event: QDropEvent) -> GivenFiles | None:
    """Accept a drag of files as a copy and return them; None without files, or where only a move is possible.

    For the answer "move" the file manager would delete the dragged files.
    """
    files = dropped(event)
    is_local = bool(files.documents or files.imports or files.pictures)
    if not is_local or not event.possibleActions() & Qt.DropAction.CopyAction:
        event.ignore()
        return None
    event.setDropAction(Qt.DropAction.CopyAction)
    event.accept()
    return files


class Drops:
    """Handler of dropped files and drawings; it reports files that are not used.

    Attributes
    ----------
    open_window
        Opens a document in a window of its own; None where somebody else keeps the windows.
    """

    def __init__(
        self,
        context: WindowContext,
        takers: Collection[object],
    ) -> None:
        self._context = context
        self._import = hooks(takers, "import_files")
        self._holds, self._paste = hooks(takers, "holds_drawing"), hooks(takers, "paste_dropped")
        self.open_window: OpenWindow | None = None

    def take(self, files: GivenFiles, problems: Iterable[str] = ()) -> None:
        """Open documents, import files one after the other, and trace a picture.

        The messages `problems` about other files are shown together with those about omitted ones.
        """
        left = [*problems, *self._open(files.documents)]
        # Else a large document, which is opened later, would replace the one that they were added to.
        self._context.files.after_opening(
            lambda problem: self._add(files, [problem, *left] if problem else left)
        )

    def accepts_drawing(self, event: QDropEvent) -> bool:
        """Accept a drag of curves that are in no file, such as text out of a browser, as a copy."""
        can_copy = bool(event.possibleActions() & Qt.DropAction.CopyAction)
        if not can_copy or not any(holds(event.mimeData()) for holds in self._holds):
            return False
        event.setDropAction(Qt.DropAction.CopyAction)
        event.accept()
        return True

    def take_drawing(self, event: QDropEvent, position: Vector) -> None:
        """Add the curves of an accepted drag at a position."""
        for paste in self._paste:
            paste(event.mimeData(), position)

    def _add(self, files: GivenFiles, left: list[str]) -> None:
        """Import and trace files, and report those `left` out with the reasons."""
        if others := self._context.files.trace(files.pictures):
            left.append(others)
        if files.elsewhere:
            left.append(
                f"Skipped {count_of(files.elsewhere, 'link')} to files that are not on this computer."
            )
        for import_files in self._import:
            import_files(files.imports)
        if left:
            self._context.central.message_bar.warn(" ".join(left))

    def _open(self, documents: tuple[Path, ...]) -> list[str]:
        """Open the first document here and the others in new windows; return reports of those left out."""
        files = self._context.files
        if len(documents) < 2:
            for path in documents:
                files.open(path)
            return []
        problems = {path: files.why_not(path) for path in documents}
        able = [path for path, problem in problems.items() if not problem]
        if able:
            files.open(able[0])
        others, left = able[1:], [problem for problem in problems.values() if problem]
        beside = others[: MOST_WINDOWS - 1] if self.open_window is not None else []
        left += self._open_beside(beside)
        if len(others) > len(beside):
            most = f"a drop opens at most {MOST_WINDOWS} documents" if beside else "there is only one window"
            left.append(f"{_listed(others[len(beside) :])} not opened: {most}.")
        return left

    def _open_beside(self, paths: list[Path]) -> list[str]:
        opened, left = [], []
        for path in paths:
            assert self.open_window is not None
            try:
                self.open_window(path)
                opened.append(path)
            except (FormatError, StorageError) as problem:
                # The file was readable a moment ago.
                left.append(f"{path.name} was not opened. {problem}")
        if opened:
            windows = "a new window" if len(opened) == 1 else "new windows"
            names = names_of([path.name for path in opened])
            self._context.session.say(f"Opened {names} in {windows}.")
        return left


def _listed(paths: Iterable[Path]) -> str:
    return names_with_verb([path.name for path in paths])
