"""Analysis panel: switches of the overlays, their settings and measurements."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QAction, QIcon
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.analysis import Analysis
from app.document.expression import ExpressionError
from app.document.words import number
from app.labels import Label
from app.overrides import Guarded
from app.panels.action_switch import mirror
from app.panels.field_edit import NumberEdit, read_number
from app.panels.number_text import decimal_mark, exact_text
from app.panels.setting_slider import SettingSlider, count_slider, scale_slider
from app.panels.tool_buttons import action_button, tool_button
from app.plotting.pens import SIGN, sign_pixmap
from app.theme import theme_of
from app.view_model.analysis.settings import Ghost, Overlay, all_ghosts

_NOTES_MS = 60
"""Milliseconds that the words may lag behind a drag."""


class AnalysisPanel(Guarded, QScrollArea):
    """A switch for each overlay, beside it how it is drawn, and below it what it says."""

    def __init__(
        self, analysis: Analysis, actions: Callable[[str], QAction], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("analysisPanel")
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._analysis, self._actions = analysis, actions
        self._refusal = ""
        self._notes: dict[Overlay, Label] = {}
        self._sliders: dict[str, tuple[Overlay, SettingSlider]] = {}
        self._ghost_boxes: dict[Ghost, QCheckBox] = {}
        self._problem = _note("analysisProblem")
        self._rows = QGridLayout()
        self._rows.setHorizontalSpacing(10)
        self._rows.setVerticalSpacing(7)
        self._rows.setColumnStretch(1, 1)
        self._build()
        self._connect()
        self._render_theme()
        self._render()

    def _build(self) -> None:
        self._add("overlayComb", Overlay.COMB, "comb_scale", scale_slider("combScale", "Length of the teeth"))
        for name, overlay, field in (
            ("overlayVelocities", Overlay.VELOCITIES, "velocity_scale"),
            ("overlayAccelerations", Overlay.ACCELERATIONS, "acceleration_scale"),
        ):
            slider = scale_slider(field.replace("_s", "S"), "Length of the arrows")
            self._add(name, overlay, field, slider)
        self._add("overlayCircle", Overlay.CIRCLE)
        ticks = count_slider("tickCount", "Number of steps", 2, 100)
        self._add("overlayTicks", Overlay.TICKS, "tick_count", ticks)
        self._add("overlayMarks", Overlay.MARKS)
        self._add("overlayBezier", Overlay.BEZIER)
        self._add("overlayPolygon", Overlay.POLYGON)
        self._add("overlayBand", Overlay.BAND)
        count = count_slider("ensembleCount", "Number of curves", 1, 200)
        self._add("overlayEnsemble", Overlay.ENSEMBLE, "ensemble_count", count)
        self._errors = self._make_errors()
        self._rows.addWidget(self._errors, self._rows.rowCount(), 0, 1, 2)
        title = Label("Ghosts: the same points, otherwise")
        title.setObjectName("ghostsTitle")
        self._rows.addWidget(title, self._rows.rowCount(), 0, 1, 2)
        for ghost in all_ghosts():
            self._add_ghost(ghost)
        content = QWidget()
        layout = QVBoxLayout(content)
        layout.setContentsMargins(12, 12, 12, 12)
        layout.addWidget(self._problem)
        layout.addLayout(self._rows)
        layout.addStretch(1)
        self.setWidget(content)
        # No row is ever cut off: there is no scroll bar for that.
        bar = self.verticalScrollBar().sizeHint().width()
        self.setMinimumWidth(content.minimumSizeHint().width() + bar)

    def _add(self, name: str, overlay: Overlay, field: str = "", slider: SettingSlider | None = None) -> None:
        row = self._rows.rowCount()
        self._rows.addWidget(self._switch(name), row, 0)
        if slider is not None:
            self._rows.addWidget(slider, row, 1)
            self._sliders[field] = (overlay, slider)
            slider.moved.connect(lambda value: self._analysis.change(**{field: value}))
        note = self._notes[overlay] = _note(f"{name}Note")
        note.setIndent(24)
        self._rows.addWidget(note, row + 1, 0, 1, 2)

    def _switch(self, name: str) -> QCheckBox:
        action = self._actions(name)
        box = QCheckBox(action.text())
        box.setObjectName(f"{name}Switch")
        box.setAccessibleName(action.text())
        mirror(box, action)
        return box

    def _make_errors(self) -> QWidget:
        """Return the fields that band and ensemble share, and the button for other random numbers."""
        self.point_error = NumberEdit(
            "pointError",
            "Error of the points",
            "Largest error of every point; velocities and accelerations stay (a number or an expression)",
            _error_size,
        )
        self.parameter_error = NumberEdit(
            "parameterError",
            "Error of the parameters",
            "Largest error of every t; for the band to first order (a number or an expression)",
            _error_size,
        )
        seed = action_button(self._actions("newSeed"))
        errors = QWidget()
        layout = QHBoxLayout(errors)
        layout.setContentsMargins(24, 0, 0, 0)
        layout.setSpacing(6)
        for label, edit in (("ε points", self.point_error), ("δ in t", self.parameter_error)):
            layout.addWidget(Label(label))
            layout.addWidget(edit, 1)
        layout.addWidget(seed)
        return errors

    def _add_ghost(self, ghost: Ghost) -> None:
        row = self._rows.rowCount()
        box = self._ghost_boxes[ghost] = self._switch(ghost.action_name)
        box.setIconSize(SIGN)
        words = box.text()
        use = tool_button(f"use_{ghost.name}", f"Use {words}", f"Make this the curve: {words}", text="Use")
        use.clicked.connect(lambda: self._analysis.ghost_chosen.emit(ghost))
        self._rows.addWidget(box, row, 0)
        self._rows.addWidget(use, row, 1, Qt.AlignmentFlag.AlignRight)

    def _connect(self) -> None:
        self._notes_due = QTimer(self, singleShot=True, interval=_NOTES_MS)
        self._notes_due.timeout.connect(self._render_notes)
        self._analysis.changed.connect(self._render)
        self._analysis.noted.connect(self._note_soon)
        for edit, field in ((self.point_error, "point_error"), (self.parameter_error, "parameter_error")):
            edit.entered.connect(partial(self._set_error, field))
            edit.refused.connect(self._refuse)
            edit.left.connect(lambda: self._refuse(""))

    # Rendering: nothing here writes back

    def _render(self) -> None:
        settings, mark = self._analysis.settings, decimal_mark()
        for field, (overlay, slider) in self._sliders.items():
            slider.render_value(getattr(settings, field))
            slider.setEnabled(overlay in settings.overlays)
        self._errors.setVisible(bool(settings.overlays & {Overlay.BAND, Overlay.ENSEMBLE}))
        for edit, value in (
            (self.point_error, settings.point_error or 0.0),
            (self.parameter_error, settings.parameter_error),
        ):
            edit.show_text(exact_text(value, mark).removesuffix(f"{mark}0"), number(value, 6, mark))
        self._render_notes()

    def _note_soon(self) -> None:
        if not self._notes_due.isActive():
            self._notes_due.start()

    def _render_notes(self) -> None:
        for overlay, label in self._notes.items():
            text = self._analysis.notes.get(overlay, "")
            if label.text() != text:
                label.setText(text)
            label.setVisible(bool(text))
        problem = self._refusal or self._analysis.problem
        self._problem.setText(f"⚠ {problem}" if problem else "")
        self._problem.setVisible(bool(problem))

    def _render_theme(self) -> None:
        theme = theme_of(self.palette())
        for label in self._notes.values():
            label.setStyleSheet(f"color: {theme.muted.name()}")
        self._problem.setStyleSheet(f"color: {theme.warning.name()}")
        for ghost, box in self._ghost_boxes.items():
            box.setIcon(QIcon(sign_pixmap(ghost, theme, self.devicePixelRatioF())))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_notes_due"):
            self._render_theme()

    # What the person did

    def _set_error(self, field: str, value: float) -> None:
        self._analysis.change(**{field: value})
        self._render()

    def _refuse(self, reason: str) -> None:
        self._refusal = reason
        self._render_notes()


def _error_size(text: str) -> float:
    """Return the size of an error that was typed."""
    value = read_number(text)
    if value < 0:
        raise ExpressionError("The size of an error cannot be negative.")
    return value


def _note(name: str) -> Label:
    label = Label()
    label.setObjectName(name)
    label.setWordWrap(True)
    # A long word never widens the window.
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    return label
