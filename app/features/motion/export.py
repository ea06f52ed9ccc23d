"""Export of a motion: a dialog for format, size and length, and the film written beside the window."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from ...appearance.theme import theme_of
from ...exchange.drawing.film import FASTEST, FILMS, LARGEST_WIDTH, MOST_FRAMES, Film, FilmFormat, write_film
from ...exchange.drawing.styles import DARK, LIGHT, ON_PAPER
from ...qt.labels import Label
from ...tasks.progress import Report
from ...view_model.motion import round_duration
from ...view_model.motion_settings import MotionSettings
from ...widgets.boxes import form_of, row_of
from ...widgets.controls import check_box, choice_box, push_button
from ...widgets.fields import RangedDoubleSpinBox, RangedSpinBox
from ...widgets.frames import FittedDialog
from ...workbench.context import WindowContext
from ...workbench.document_files import file_stem
from ...workbench.file_work import WRITTEN


class MotionDialog(FittedDialog):
    """Dialog for format, size and length; not modal.

    Signals
    -------
    accepted_as
        The person asks for a film in this `FilmFormat`.
    """

    accepted_as = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("motionDialog", "Export Motion", parent)
        tip = "GIF and APNG play in every browser; MP4 needs ffmpeg"
        self.format_box = choice_box(
            "filmFormat", "Format", tip, (film_format.title for film_format in FILMS)
        )
        self.width_box = RangedSpinBox(
            "filmWidth", "Width", "Width of the picture; the height follows", (64, LARGEST_WIDTH)
        )
        self.width_box.setSingleStep(16)
        self.width_box.setValue(640)
        self.width_box.setSuffix(" px")
        self.fps_box = RangedSpinBox(
            "filmFps", "Frames per second", "Number of frames per second", (1, FASTEST)
        )
        self.fps_box.setValue(25)
        self.seconds_box = RangedDoubleSpinBox(
            "filmSeconds", "Length", "Length of the film: one round of the motion", (0.1, 3600.0)
        )
        self.seconds_box.setSingleStep(0.5)
        self.seconds_box.setSuffix(" s")
        self.points_check = check_box(
            "filmPoints", "Points", "Draw the points in the film", "Draw the points"
        )
        self.points_check.setChecked(True)
        self._frames = Label(name="filmFrames")
        self._export = push_button(
            "filmExport", "Export…", "Choose a file and export the motion to it", "Export"
        )
        self._export.setDefault(True)
        self._lay_out()
        # The line below follows any change of these.
        for box in (self.width_box, self.fps_box, self.seconds_box):
            box.valueChanged.connect(self._count)
        self._export.clicked.connect(self._accept)

    def _lay_out(self) -> None:
        form_of(
            ("Format", self.format_box),
            ("Width", self.width_box),
            ("Frames per second", self.fps_box),
            ("Length", self.seconds_box),
            ("Draw", self.points_check),
            margins=(16, 16, 16, 4),
            across=16,
            down=10,
            parent=self.body,
        )
        foot = QWidget()
        row_of((self._frames, 1), self._export, margins=0, parent=foot)
        self.hold(foot, preferred=QSize(240, 160))

    def open_for(self, seconds: float) -> None:
        """Show the dialog, with the length of the motion at its speed."""
        self.seconds_box.setValue(seconds)
        self._enable_formats()
        self._count()
        self.bring_up()
        self.format_box.setFocus()

    def _enable_formats(self) -> None:
        model = self.format_box.model()
        flags = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        for row, missing in enumerate(film_format.missing() for film_format in FILMS):
            # Qt's own model of a box has items, which is where an entry is switched off.
            model.item(row).setFlags(Qt.ItemFlag.NoItemFlags if missing else flags)  # type: ignore[attr-defined]
            self.format_box.setItemData(row, missing, Qt.ItemDataRole.ToolTipRole)

    def _count(self) -> None:
        frames = max(2, round(self.fps_box.value() * self.seconds_box.value()))
        limits = (self.width_box.problem, self.fps_box.problem, self.seconds_box.problem)
        problem = next(filter(None, limits), "")
        if not problem and frames > MOST_FRAMES:
            problem = f"{frames} frames; at most {MOST_FRAMES} are possible"
        self._frames.setText(problem or f"{frames} frames")
        self._export.setEnabled(not problem)

    def _accept(self) -> None:
        self.hide()
        self.accepted_as.emit(FILMS[self.format_box.currentIndex()])


class MotionExport:
    """Export of a motion: the dialog, the file name, and the work beside the window."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._dialog: MotionDialog | None = None
        self._settings = MotionSettings()

    def ask(self, settings: MotionSettings) -> None:
        """Open the dialog."""
        view = self._context.session.active_view
        if view.curve is None:
            return
        self._settings = settings
        if self._dialog is None:
            self._dialog = MotionDialog(self._context.window)
            self._dialog.accepted_as.connect(self._ask_where)
        start, end = view.curve.domain
        self._dialog.open_for(round_duration(end - start, settings.repeat) / settings.speed)

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
        dialog, settings, session = self._dialog, self._settings, self._context.session
        theme = DARK if theme_of(QApplication.palette()).name == "dark" else LIGHT
        return Film(
            curve=session.active_index,
            width=dialog.width_box.value(),
            fps=dialog.fps_box.value(),
            seconds=dialog.seconds_box.value(),
            repeat=settings.repeat,
            pace=settings.pace,
            compared=settings.compared,
            style=ON_PAPER.get(session.document.paper, theme),
            points=dialog.points_check.isChecked(),
        )

    def write(self, path: Path, film: Film) -> None:
        """Write the motion of the present document."""
        document = self._context.session.document

        def work(report: Report) -> None:
            write_film(document, path, film, report=report)

        def done(_result: None) -> None:
            self._context.preferences.last_folder = path.parent
            self._context.session.say(f"Exported {path.name}: {film.frames} frames.")

        self._context.work.start(f"Writing {path.name}", work, done, path, WRITTEN)
