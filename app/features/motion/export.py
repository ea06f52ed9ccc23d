"""Asks for the size and the length of a film, and writes it beside the window."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QApplication, QFileDialog

from ...appearance.theme import theme_of
from ...exchange.drawing.film import Film, FilmFormat, write_film
from ...exchange.drawing.styles import DARK, LIGHT
from ...tasks.progress import Report
from ...view_model.motion import round_of
from ...view_model.motion_settings import MotionSettings
from ...workbench.context import WindowContext
from ...workbench.document_files import file_stem
from .dialog import MotionDialog


class MotionExport:
    """Asks how a motion shall be written, and writes it."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._dialog: MotionDialog | None = None
        self._settings = MotionSettings()

    def ask(self, settings: MotionSettings) -> None:
        """Let the person say how large and how long."""
        view = self._context.session.active_view
        if view.curve is None:
            return
        self._settings = settings
        if self._dialog is None:
            self._dialog = MotionDialog(self._context.window)
            self._dialog.accepted_as.connect(self._ask_where)
        start, end = view.curve.domain
        self._dialog.open_for(round_of(end - start, settings.repeat) / settings.speed)

    def _ask_where(self, form: FilmFormat) -> None:
        context, ending = self._context, form.ending
        start = context.preferences.last_folder / f"{file_stem(context.session)}{ending}"
        kinds = f"{form.title} (*{ending})"
        name, _ = QFileDialog.getSaveFileName(context.window, "Export Motion", str(start), kinds)
        if name:
            path = Path(name)
            self.write(path if path.suffix else path.with_name(path.name + ending), self._film())

    def _film(self) -> Film:
        assert self._dialog is not None
        dialog, settings = self._dialog, self._settings
        return Film(
            curve=self._context.session.active_index,
            width=dialog.width_box.value(),
            fps=dialog.fps_box.value(),
            seconds=dialog.seconds_box.value(),
            repeat=settings.repeat,
            pace=settings.pace,
            compared=settings.compared,
            style=DARK if theme_of(QApplication.palette()).name == "dark" else LIGHT,
            points=dialog.points_check.isChecked(),
        )

    def write(self, path: Path, film: Film) -> None:
        """Write the motion of the document as it is now."""
        document = self._context.session.document

        def work(report: Report) -> None:
            write_film(document, path, film, report=report)

        def done(_result: None) -> None:
            self._context.preferences.last_folder = path.parent
            self._context.session.say(f"Wrote {path.name}, {film.frames} frames.")

        self._context.work.start(f"Writing {path.name}", work, done, path, "written")
