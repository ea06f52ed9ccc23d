"""Writes a motion beside the window, with a progress bar and a way to cancel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QRunnable, QThreadPool, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from app.commands.parts import Parts
from app.document.model import Document
from app.document.storage import StorageError
from app.exchange.animation import Film, FilmCancelled, write_film
from app.exchange.drawing import ExchangeError
from app.exchange.svg import DARK, LIGHT
from app.file_commands import file_stem
from app.panels.motion_bar import MotionBar
from app.panels.motion_dialog import FORMATS, MotionDialog
from app.theme import theme_of
from app.view_model.motion import MotionSettings, round_of


class MotionExport(QObject):
    """Asks how a motion shall be written, and writes it in a thread.

    Attributes
    ----------
    ask_name
        Lets the person choose a file; tests answer themselves.

    Signals
    -------
    ended
        The film is written, or is not going to be.
    """

    ended = Signal()

    def __init__(self, parts: Parts, bar: MotionBar) -> None:
        super().__init__(parts.window)
        self._parts, self._bar = parts, bar
        self._dialog: MotionDialog | None = None
        self._settings = MotionSettings()
        self._work: _Work | None = None
        self._pool = QThreadPool(self)
        self.ask_name: Callable[[QWidget, Path, str], str] = _ask_name
        bar.export_cancelled.connect(self.cancel)

    @property
    def is_running(self) -> bool:
        """Whether a film is being written."""
        return self._work is not None

    def ask(self, settings: MotionSettings) -> None:
        """Let the person say how large and how long."""
        view = self._parts.session.active_view
        if self.is_running or view.curve is None:
            return
        self._settings = settings
        if self._dialog is None:
            self._dialog = MotionDialog(self._parts.window)
            self._dialog.accepted_as.connect(self._ask_where)
        start, end = view.curve.domain
        self._dialog.open_for(round_of(end - start, settings.repeat) / settings.speed)

    def _ask_where(self, ending: str) -> None:
        parts = self._parts
        start = parts.preferences.last_folder / f"{file_stem(parts.session)}{ending}"
        kinds = f"{FORMATS[ending]} (*{ending})"
        name = self.ask_name(parts.window, start, kinds)
        if name:
            path = Path(name)
            self.write(path if path.suffix else path.with_name(path.name + ending), self._film())
        else:
            self.ended.emit()

    def _film(self) -> Film:
        assert self._dialog is not None
        dialog, settings = self._dialog, self._settings
        return Film(
            curve=self._parts.session.active_index,
            width=dialog.width_box.value(),
            fps=dialog.fps_box.value(),
            seconds=dialog.seconds_box.value(),
            repeat=settings.repeat,
            pace=settings.pace,
            compares=settings.compares,
            style=DARK if theme_of(QApplication.palette()).name == "dark" else LIGHT,
            points=dialog.points_check.isChecked(),
        )

    def write(self, path: Path, film: Film) -> None:
        """Write the motion of the document as it is now."""
        self._work = _Work(self._parts.session.document, path, film)
        self._work.reports.progress.connect(self._bar.show_progress)
        self._work.reports.ended.connect(self._end)
        self._bar.show_progress(0.0)
        self._bar.show()
        self._pool.start(self._work)

    def cancel(self) -> None:
        """Give the film up."""
        if self._work is not None:
            self._work.cancelled.set()

    def end(self) -> None:
        """Give the film up and wait for that; called when the window goes."""
        self.cancel()
        self._pool.waitForDone()

    def _end(self, text: str, problem: bool) -> None:
        path = self._work.path if self._work is not None else Path()
        self._work = None
        self._bar.show_progress(None)
        if problem:
            self._parts.message_bar.warn(f"{path.name} was not written. {text}")
        else:
            self._parts.session.say(text)
            self._parts.preferences.last_folder = path.parent
        self.ended.emit()


def _ask_name(window: QWidget, start: Path, kinds: str) -> str:
    return QFileDialog.getSaveFileName(window, "Export Motion", str(start), kinds)[0]


class _Reports(QObject):
    """How the window hears of the work: through signals, hence in its own thread."""

    progress = Signal(float)
    ended = Signal(str, bool)


class _Work(QRunnable):
    """One film; it sees immutable values only."""

    def __init__(self, document: Document, path: Path, film: Film) -> None:
        super().__init__()
        # Its end is told to the window, which lets go of it then.
        self.setAutoDelete(False)
        self.path = path
        self.cancelled = threading.Event()
        self.reports = _Reports()
        self._document, self._film = document, film
        self._told = 0.0

    def run(self) -> None:
        """Write; called by the pool."""
        text, problem = f"Wrote {self.path.name}, {self._film.frames} frames.", False
        try:
            write_film(
                self._document,
                self.path,
                self._film,
                progress=self._tell,
                is_cancelled=self.cancelled.is_set,
            )
        except FilmCancelled:
            text = "Cancelled; no file was written."
        except (ExchangeError, StorageError) as refusal:
            text, problem = str(refusal), True
        except Exception as fault:  # the window must hear of every end
            text, problem = f"The film could not be made ({fault}).", True
        self.reports.ended.emit(text, problem)

    def _tell(self, share: float) -> None:
        # A bar shows no finer steps.
        if share - self._told >= 0.01 or share == 1.0:
            self._told = share
            self.reports.progress.emit(share)
