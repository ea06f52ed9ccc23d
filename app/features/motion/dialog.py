"""Dialog for the export of a motion: format, size and length."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QPushButton,
    QWidget,
)

from app.exchange.drawing.animation import FASTEST, FILMS, LARGEST_WIDTH, MOST_FRAMES
from app.qt.labels import Label
from app.widgets.fitting import FittedDialog
from app.widgets.told_spin import ToldDoubleSpinBox, ToldSpinBox


class MotionDialog(FittedDialog):
    """Asks how large and how long; not modal.

    Signals
    -------
    accepted_as
        A film is wanted in this `FilmFormat`.
    """

    accepted_as = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("motionDialog")
        self.setWindowTitle("Export Motion")
        self.format_box = QComboBox()
        self.format_box.addItems([each.title for each in FILMS])
        self.width_box = ToldSpinBox(
            "filmWidth", "Width", "Width of the picture; the height follows", (64, LARGEST_WIDTH)
        )
        self.width_box.setSingleStep(16)
        self.width_box.setValue(640)
        self.width_box.setSuffix(" px")
        self.fps_box = ToldSpinBox(
            "filmFps", "Frames a second", "How many pictures there are in a second", (1, FASTEST)
        )
        self.fps_box.setValue(25)
        self.seconds_box = ToldDoubleSpinBox(
            "filmSeconds", "Length", "Length of the film: one round of the motion", (0.1, 3600.0)
        )
        self.seconds_box.setSingleStep(0.5)
        self.seconds_box.setSuffix(" s")
        self.points_check = QCheckBox("Points")
        self.points_check.setChecked(True)
        self._frames = Label()
        self._frames.setObjectName("filmFrames")
        self._export = QPushButton("Export…")
        self._export.setDefault(True)
        self._name_all()
        self._lay_out()
        # The numbers below are told whoever changes them.
        for box in (self.width_box, self.fps_box, self.seconds_box):
            box.valueChanged.connect(self._count)
        self._export.clicked.connect(self._accept)

    def _name_all(self) -> None:
        names = {
            self.format_box: ("filmFormat", "Format", "GIF and APNG play in every browser; MP4 takes ffmpeg"),
            self.points_check: ("filmPoints", "Draw the points", "Draw the points too"),
            self._export: ("filmExport", "Export", "Choose a file and write the motion there"),
        }
        for widget, (name, label, tip) in names.items():
            widget.setObjectName(name)
            widget.setAccessibleName(label)
            widget.setToolTip(tip)

    def _lay_out(self) -> None:
        form = QFormLayout(self.body)
        form.setContentsMargins(16, 16, 16, 4)
        form.setVerticalSpacing(10)
        form.setHorizontalSpacing(16)
        form.addRow("Format", self.format_box)
        form.addRow("Width", self.width_box)
        form.addRow("Frames a second", self.fps_box)
        form.addRow("Length", self.seconds_box)
        form.addRow("Draw", self.points_check)
        foot = QWidget()
        row = QHBoxLayout(foot)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._frames, 1)
        row.addWidget(self._export)
        self.hold(foot, wished=QSize(240, 160))

    def open_for(self, seconds: float) -> None:
        """Show the dialog, with the length that the motion has at its speed."""
        self.seconds_box.setValue(seconds)
        self._enable_formats()
        self._count()
        self.show()
        self.raise_()
        self.activateWindow()
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
