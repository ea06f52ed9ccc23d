"""Documents and files: opening and saving with their questions, new documents, file names."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from ..document.curve_edits import empty_curve_like
from ..document.model import Document, empty_document
from ..document.plain_numbers import with_plain_numbers
from ..exchange.formats import DOCUMENT_ENDING, FORMATS, can_import, endings_of, file_filters, format_of
from ..qt.labels import breakable
from ..session import Session
from ..settings.preferences import Preferences
from ..storage.examples import first_sketch
from ..storage.files import StorageError, load
from ..storage.format_error import FormatError
from ..storage.open_file import LoadedDocument, is_large
from ..storage.resources import is_resource
from ..tasks.progress import Report, part
from ..tasks.task import Work
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.transformed import views_ahead

NEW_NAME = empty_document().curves[0].name
"""The name that a curve has before anyone gives it one."""


def as_usual(document: Document, preferences: Preferences) -> Document:
    """Return a document with the unit and the grid of new documents."""
    return replace(document, unit=preferences.unit_name, grid_spacing=preferences.grid_spacing)


def blank_document(preferences: Preferences) -> Document:
    """Return a new document with the settings of the preferences."""
    curve = preferences.new_curve
    document = as_usual(Document((curve,)), preferences)
    return document.with_curve(0, replace(curve, style=preferences.new_style))


def ask_about_changes(session: Session, window: QWidget) -> int:
    """Ask whether to save, discard or keep unsaved changes; return the button."""
    text, explanation = _question_about(session)
    question = QMessageBox(window)
    question.setObjectName("saveChanges")
    question.setWindowTitle("Curvebench")
    question.setTextFormat(Qt.TextFormat.PlainText)
    question.setIcon(QMessageBox.Icon.Question)
    question.setText(breakable(text))
    question.setInformativeText(explanation)
    buttons = QMessageBox.StandardButton
    question.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    question.setDefaultButton(buttons.Save)
    answer = question.exec()
    # Else each message box would remain a child of the window.
    question.setParent(None)
    return answer


def _question_about(session: Session) -> tuple[str, str]:
    """Return the question about unsaved changes, and its explanation."""
    files, file = session.files, session.files.file
    is_named = files.path is not None or files.origin.title
    name = short_name(title_of(session)) if is_named else "the sketch"
    why = f"{file.change.value} " if file is not None and file.has_lost_document else ""
    if files.has_changes:
        return f"Save the changes to {name}?", f"{why}They are lost if you do not save them."
    return f"Save {name} as shown here?", f"{why}The document shown here is lost if you do not save it."


StartWork = Callable[[str, Work, Callable[[Any], object], Path, str, Callable[[str], object]], bool]
"""Function that starts work: title, work, receiver of the result, file, participle, receiver of a failure.

Returns whether the work has begun.
"""

_READ = 0.1
"""Share of the progress for reading the file."""


class DocumentFiles:
    """Opening and saving of documents, with the questions to the person.

    Parameters
    ----------
    window
        Parent of the dialogs.
    warn
        Shows why something could not be done.
    """

    def __init__(
        self, session: Session, preferences: Preferences, window: QWidget, warn: Callable[[str], None]
    ) -> None:
        self._session, self._preferences = session, preferences
        self._window, self._warn = window, warn
        self.refused: Callable[[Path, str, StorageError], None] = lambda _path, sentence, _why: warn(sentence)
        """Says why a document was not saved, and what can be done about it."""
        self.beside: StartWork | None = None
        """Does work beside the window; without it every document is opened at once."""
        self.open_foreign: Callable[[Path], object] | None = None
        """Opens a file of another format as a new document."""
        self.trace: Callable[[Sequence[Path]], str] = lambda _paths: ""
        """Puts the first of these pictures behind the curves; returns what it says of the others."""
        self.open_window: Callable[[str], DocumentFiles] | None = None
        """Opens a window, with what the action of a name begins, and returns its files; None where somebody
        else keeps the windows. Without a name the window is unused, as at the start.
        """
        self.show_elsewhere: Callable[[Path], bool] = lambda _path: False
        """Brings another window that has a file to the front; returns whether there is one."""
        self.take_opened: Callable[[Path, Any], object] = lambda _path, _content: None
        """Begins with what was read of a file of another format."""
        self._after_opening: list[Callable[[str], object]] | None = None
        session.files.blank = lambda: blank_document(preferences)
        self._prepare_sketch()

    def _prepare_sketch(self) -> None:
        """Give the first sketch of a session the unit and the grid of new documents."""
        session, sketch = self._session, with_plain_numbers(first_sketch())
        is_begun, usual = session.files.path is not None or session.undo_stack.count(), self._preferences
        if is_begun or session.document != sketch:
            return
        if sketch != as_usual(sketch, usual):
            session.files.begin(as_usual(sketch, usual))

    def new(self) -> None:
        """Start an empty document, after asking about unsaved changes."""
        if not self.may_discard():
            return
        self.remember_rules()
        self._session.files.begin(blank_document(self._preferences))

    def remember_rules(self) -> None:
        """Use the family and the rules of the active curve for new documents.

        Those of the first sketch, of examples and of lessons were no choice of the person's.
        """
        files = self._session.files
        if files.origin.copied is None and not files.is_untouched:
            self._preferences.new_curve = empty_curve_like(self._session.active_curve)

    def ask_and_open(self) -> None:
        """Show a dialog and open a document, or a file of another format."""
        folder = str(self._preferences.last_folder)
        name, _ = QFileDialog.getOpenFileName(self._window, "Open", folder, file_filters())
        if name:
            self.open_beside(Path(name))

    def elsewhere(self, action: str = "") -> DocumentFiles | None:
        """Open a new window for an action and return its files; None where this window is unused.

        That is where nothing was done yet: a document that somebody works in stays.
        """
        if self.open_window is None or self._session.files.is_untouched:
            return None
        self.remember_rules()
        return self.open_window(action)

    def open_beside(self, path: Path) -> None:
        """Open a file in a new window, or in this one while it is unused.

        One that is open in another window is shown there.
        """
        if self.show_elsewhere(path):
            return
        files = self._session.files
        is_foreign = self.open_foreign is not None and can_import(path)
        if is_foreign or files.is_untouched or path.absolute() == files.path:
            # A file of another format gets its window after it was read.
            self.open(path)
        elif not is_large(path) and (problem := self.why_not(path)):
            self._warn(problem)
        else:
            (self.elsewhere() or self).open(path)

    def open(self, path: Path) -> None:
        """Open the document at `path` after asking about unsaved changes; a large one in the background.

        A file of another format becomes a new document.
        """
        if self.open_foreign is not None and can_import(path):
            self.open_foreign(path)
        elif self.beside is not None and is_large(path) and not is_resource(path):
            self._open_large(path, self.beside)
        else:
            self._open(path, self._session.open, remember=not is_resource(path))

    def _open_large(self, path: Path, beside: StartWork) -> None:
        """Read a document and compute its curves in the background, with progress."""
        begun = self._session.files.origin

        def done(loaded: tuple[LoadedDocument, list[CurveView]]) -> None:
            reading, views = loaded
            opener = partial(self._session.open, reading=reading, views=views)
            try:
                if self._session.files.origin is begun:
                    self._open(path, opener, remember=True, is_read=True)
                else:
                    why = "because another document was opened in the meantime"
                    self._session.refuse(f"{path.name} was not opened {why}.")
            finally:
                self._end_opening()

        if beside(f"Opening {path.name}", partial(_read, path), done, path, "opened", self._end_opening):
            self._after_opening = []

    def _end_opening(self, problem: str = "") -> None:
        waiting, self._after_opening = self._after_opening or [], None
        if problem:
            self._warn(problem)
        for then in waiting:
            then(problem)

    def after_opening(self, then: Callable[[str], object]) -> None:
        """Call `then` when the document that is being opened is there; at once where none is.

        `then` is called with the reason why it was not opened; empty where it was.
        """
        if self._after_opening is None:
            then("")
        else:
            self._after_opening.append(then)

    def why_not(self, path: Path) -> str:
        """Return the sentence why a document cannot be opened; empty where it can."""
        try:
            load(path)
        except (FormatError, StorageError) as problem:
            return _sentence(f"{path.name} was not opened", problem)
        return ""

    def open_example(self, path: Path, text: str = "Open Example") -> bool:
        """Open a copy of an example or a lesson, without a file; return whether it is open.

        Unsaved work stays in the history, below a step called `text`, without a question.
        """
        session, files = self._session, self._session.files
        session.cancel()
        leaves_work = files.path is None and files.is_modified
        read = partial(files.open_copy, text=text)
        is_open = self._open(path, read, remember=False, asks=files.path is not None)
        if is_open and leaves_work:
            session.offer("Your previous work is kept.", "goBack")
        return is_open

    def _open(
        self,
        path: Path,
        opener: Callable[[Path], object],
        *,
        remember: bool,
        asks: bool = True,
        is_read: bool = False,
    ) -> bool:
        try:
            if not is_read:
                load(path)  # nobody is asked to part with a drawing for a file that cannot be opened
            if asks and not self.may_discard():
                return False
            opener(path)
        except (FormatError, StorageError) as problem:
            self._warn(_sentence(f"{path.name} was not opened", problem))
            return False
        if remember:
            self._remember(path)
        return True

    def save(self) -> bool:
        """Save to the file of the document, or ask for one; return whether it was saved."""
        file = self._session.files.file
        path = self._session.files.path
        is_locked = self._session.files.is_read_only and file and not file.take_if_free()
        if path is None or is_locked or is_misnamed(path):
            return self.ask_and_save()
        return self._save(path)

    def overwrite(self) -> bool:
        """Save to the file of the document although it was changed elsewhere; return whether it was saved."""
        return self._session.files.path is not None and self._save(self._session.files.path, overwrite=True)

    def ask_and_save(self) -> bool:
        """Ask for a file and save there; return whether it was saved."""
        path = self._ask_where()
        return path is not None and self._save(path)

    def _ask_where(self) -> Path | None:
        """Ask for a file for the document; None where none was chosen or the name is refused."""
        start = self._proposed_path()
        name, _ = QFileDialog.getSaveFileName(self._window, "Save As", str(start), SAVED_KINDS)
        if not name:
            return None
        path = path_to_save(Path(name))
        reason = why_not_saved_as(path.name)
        if path != Path(name) and path.exists():
            # The dialog has asked only about the name without the suffix.
            reason = f"“{path.name}” already exists. To replace it, select it in the list of files."
        if not reason:
            return path
        self.refused(path, f"{path.name} was not saved. {reason}", StorageError(reason))
        return None

    def _proposed_path(self) -> Path:
        path, stem = self._session.files.path, file_stem(self._session)
        start = path or self._preferences.last_folder / (stem + SUFFIX)
        if path is not None and is_misnamed(path):
            start = path.with_name(stem + SUFFIX)
        if self._session.files.is_read_only:
            start = start.with_name(f"{stem} copy{SUFFIX}")
        return start

    def _save(self, path: Path, *, overwrite: bool = False) -> bool:
        file = self._session.files.file
        was_older = file is not None and file.is_older and file.is_at(path)
        try:
            self._session.save(path, overwrite=overwrite)
        except FormatError as problem:
            self._warn(_sentence(f"{path.name} was not saved", problem))
            return False
        except StorageError as problem:
            self.refused(path, _sentence(f"{path.name} was not saved", problem), problem)
            return False
        self._remember(path)
        remark = " The old version is kept in the same folder." if was_older else ""
        self._session.say(f"Saved {path.name}.{remark}")
        return True

    def _remember(self, path: Path) -> None:
        self._preferences.add_recent_file(path)
        self._preferences.last_folder = path.parent

    def may_discard(self) -> bool:
        """Ask about unsaved changes; return whether the document may be replaced."""
        self._session.cancel()
        # The watch may be waiting for another program to finish writing.
        self._session.files.check()
        if not self._session.files.is_modified:
            return True
        answer = self._ask_about_changes()
        if answer == QMessageBox.StandardButton.Save:
            return self.save()
        return answer == QMessageBox.StandardButton.Discard

    def _ask_about_changes(self) -> int:
        return ask_about_changes(self._session, self._window)

    def release(self) -> None:
        """Release the lock of the file."""
        if self._session.files.file is not None:
            self._session.files.file.close()


def _read(path: Path, report: Report) -> tuple[LoadedDocument, list[CurveView]]:
    """Return a document and the views of its curves."""
    report(0.0, "Reading")
    reading = LoadedDocument.of(path)
    report_part = part(report, _READ, 1.0)
    return reading, views_ahead(reading.document.curves, lambda share: report_part(share, "Computing curves"))


def _sentence(what: str, problem: Exception) -> str:
    """Return the message of a failure; a FormatError is a clause, other errors are sentences."""
    if isinstance(problem, FormatError):
        return f"{what}: {problem}."
    return f"{what}. {problem}"


SUFFIX = DOCUMENT_ENDING
SAVED_KINDS = f"Curvebench documents (*{SUFFIX});;All files (*)"
"""File filters of the Save As dialog."""

_LONGEST_STEM = 80


def short_name(name: str) -> str:
    """Return a name, shortened in the middle where it is long."""
    half = _LONGEST_STEM // 2
    return name if len(name) <= _LONGEST_STEM else f"{name[:half]}…{name[-half:]}"


def title_of(session: Session) -> str:
    """Return the title of the document: the name of its file, of the example, or “Untitled”."""
    files = session.files
    return files.path.name if files.path is not None else files.origin.title or "Untitled"


def file_stem(session: Session) -> str:
    """Return a file name for the document, without ending."""
    if (path := session.files.path) is not None:
        return path.stem if is_misnamed(path) else path.name.removesuffix(SUFFIX)
    curves = session.document.curves
    drawn = "Sketch" if len(curves) > 1 else curves[0].name
    return valid_stem(session.files.origin.file_stem or drawn)


def valid_stem(name: str) -> str:
    """Return a valid file name without ending from any name."""
    name = "".join(character for character in name if character.isprintable())
    # Characters that some systems do not allow in file names.
    return re.sub(r'[<>:"/\\|?*]+', " ", name).strip(" .")[:_LONGEST_STEM] or "curve"


def is_misnamed(path: Path) -> bool:
    """Return whether a document has the ending of another format."""
    return bool(why_not_saved_as(path.name))


def path_to_save(typed: Path) -> Path:
    """Return the path of a document for a typed name.

    What is neither JSON nor a file of a known format by its name gets the suffix of documents.
    """
    name, known = typed.name.lower(), (".json", *endings_of(FORMATS.written))
    return typed if name.endswith(known) else typed.with_name(typed.name + SUFFIX)


def why_not_saved_as(name: str) -> str:
    """Return the reason why no document may have such a name; empty where it may.

    With the ending of another format no program would open the document, not even this one.
    """
    name = name.lower()
    others = tuple(ending for ending in endings_of(FORMATS.written) if ending != SUFFIX)
    if not name.endswith(others):
        return ""
    title = format_of(name, FORMATS.written).title
    return f"Documents are saved as {SUFFIX}. To write a {title}, use File › Export."
