"""Dialog for the export of a motion: format, size and length."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QWidget

from ...exchange.drawing.film import FASTEST, FILMS, LARGEST_WIDTH, MOST_FRAMES
from ...qt.labels import Label
from ...widgets.boxes import form_of, row_of
from ...widgets.controls import check_box, choice_box, push_button
from ...widgets.fields import RangedDoubleSpinBox, RangedSpinBox
from ...widgets.frames import FittedDialog


class MotionDialog(FittedDialog):
    """Asks how large and how long; not modal.

    Signals
    -------
    accepted_as
        A film is wanted in this `FilmFormat`.
    """

    accepted_as = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("motionDialog", "Export Motion", parent)
        tip = "GIF and APNG play in every browser; MP4 takes ffmpeg"
        self.format_box = choice_box("filmFormat", "Format", tip, (each.title for each in FILMS))
        self.width_box = RangedSpinBox(
            "filmWidth", "Width", "Width of the picture; the height follows", (64, LARGEST_WIDTH)
        )
        self.width_box.setSingleStep(16)
        self.width_box.setValue(640)
        self.width_box.setSuffix(" px")
        self.fps_box = RangedSpinBox(
            "filmFps", "Frames a second", "How many pictures there are in a second", (1, FASTEST)
        )
        self.fps_box.setValue(25)
        self.seconds_box = RangedDoubleSpinBox(
            "filmSeconds", "Length", "Length of the film: one round of the motion", (0.1, 3600.0)
        )
        self.seconds_box.setSingleStep(0.5)
        self.seconds_box.setSuffix(" s")
        self.points_check = check_box("filmPoints", "Points", "Draw the points too", "Draw the points")
        self.points_check.setChecked(True)
        self._frames = Label(name="filmFrames")
        self._export = push_button(
            "filmExport", "Export…", "Choose a file and write the motion there", "Export"
        )
        self._export.setDefault(True)
        self._lay_out()
        # The numbers below are told whoever changes them.
        for box in (self.width_box, self.fps_box, self.seconds_box):
            box.valueChanged.connect(self._count)
        self._export.clicked.connect(self._accept)

    def _lay_out(self) -> None:
        form_of(
            ("Format", self.format_box),
            ("Width", self.width_box),
            ("Frames a second", self.fps_box),
            ("Length", self.seconds_box),
            ("Draw", self.points_check),
            margins=(16, 16, 16, 4),
            across=16,
            down=10,
            parent=self.body,
        )
        foot = QWidget()
        row_of((self._frames, 1), self._export, margins=0, parent=foot)
        self.hold(foot, wished=QSize(240, 160))

    def open_for(self, seconds: float) -> None:
        """Show the dialog, with the length that the motion has at its speed."""
        self.seconds_box.setValue(seconds)
        self._enable_formats()
        self._count()
        self.bring_up()
        self.format_box.setFocus()

    def _enable_formats(self) -> None:
        model = self.format_box.model()
        flags = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
        for place, missing in enumerate(each.missing() for each in FILMS):
            # Qt's own model of a box has items, which is where an entry is switched off.
            model.item(place).setFlags(Qt.ItemFlag.NoItemFlags if missing else flags)  # type: ignore[attr-defined]
            self.format_box.setItemData(place, missing, Qt.ItemDataRole.ToolTipRole)

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
