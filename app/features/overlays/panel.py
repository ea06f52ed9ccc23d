"""Analysis panel: switches of the overlays, their settings and measurements."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QIcon, QPalette
from PySide6.QtWidgets import (
    QCheckBox,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from ...appearance.theme import FollowsTheme, Theme
from ...document.expression import ExpressionError
from ...plotting.pens import SIGN, sign_pixmap
from ...qt.labels import MUTED, WARNING, Label
from ...state.window_state import Analysis
from ...tasks.task import DelayedCall
from ...view_model.analysis.ghost import Ghost, all_ghosts
from ...view_model.analysis.overlay import OVERLAYS, ErrorSize, Overlay
from ...view_model.settings import Count, Factor, OwnedSetting, SwitchSetting
from ...widgets.boxes import Part, column_of, grid_of, remove_widgets, row_of
from ...widgets.controls import action_button, check_box, mirror, tool_button
from ...widgets.fields import NumberEdit, read_number
from ...widgets.frames import scroll_vertically
from ...widgets.sliders import SettingSlider, slider_of

_NOTES_MS = 60
"""Milliseconds by which the notes may lag behind a drag."""


class AnalysisPanel(FollowsTheme, QScrollArea):
    """A switch for each overlay, with its settings beside it and its note below."""

    def __init__(
        self, analysis: Analysis, actions: Callable[[str], QAction], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        scroll_vertically(self, "analysisPanel")
        self._analysis, self._actions = analysis, actions
        self._refusal = ""
        self._notes: dict[Overlay, Label] = {}
        self._sliders: list[tuple[Overlay, Factor | Count, SettingSlider]] = []
        self._checks: list[tuple[Overlay, SwitchSetting, QCheckBox]] = []
        self._error_fields: dict[ErrorSize, NumberEdit] = {}
        self._ghost_boxes: dict[Ghost, QCheckBox] = {}
        self._use_buttons: dict[Ghost, QToolButton] = {}
        self._problem = _note("analysisProblem", WARNING)
        self._rows = grid_of(10, 7, stretched=[1])
        self._build()
        self._connect()
        self.follow_theme()
        self._render()

    def _build(self) -> None:
        for overlay in OVERLAYS:
            self._add(overlay)
        self._errors = self._make_errors()
        self._rows.addWidget(self._errors, self._rows.rowCount(), 0, 1, 2)
        title = Label("Ghosts: the same points under other rules", name="ghostsTitle")
        self._rows.addWidget(title, self._rows.rowCount(), 0, 1, 2)
        for ghost in all_ghosts():
            self._add_ghost(ghost)
        content = QWidget()
        column_of(self._problem, self._rows, 1, margins=12, parent=content)
        self.setWidget(content)
        # No row is cut off: there is no horizontal scroll bar.
        bar = self.verticalScrollBar().sizeHint().width()
        self.setMinimumWidth(content.minimumSizeHint().width() + bar)

    def _add(self, overlay: Overlay) -> None:
        row = self._rows.rowCount()
        self._rows.addWidget(self._switch(overlay.action_name), row, 0)
        for below, control in enumerate(filter(None, map(partial(self._control, overlay), overlay.settings))):
            self._rows.addWidget(control, row + below, 1)
        note = self._notes[overlay] = _note(f"{overlay.action_name}Note")
        note.setIndent(24)
        self._rows.addWidget(note, self._rows.rowCount(), 0, 1, 2)

    def _control(self, overlay: Overlay, setting: OwnedSetting[float]) -> QWidget | None:
        """Return the slider or check box of a setting; None where it has another field, or none."""
        if isinstance(setting, SwitchSetting):
            return self._check(overlay, setting)
        return self._slider(overlay, setting) if isinstance(setting, Factor | Count) else None

    def _slider(self, overlay: Overlay, setting: Factor | Count) -> SettingSlider:
        slider = slider_of(setting)
        slider.moved.connect(lambda value: self._analysis.set_value(setting, value))
        self._sliders.append((overlay, setting, slider))
        return slider

    def _check(self, overlay: Overlay, setting: SwitchSetting) -> QCheckBox:
        box = check_box(setting.name, setting.label, setting.tip or setting.label)
        box.clicked.connect(lambda checked: self._analysis.set_value(setting, checked))
        self._checks.append((overlay, setting, box))
        return box

    def _switch(self, name: str) -> QCheckBox:
        action = self._actions(name)
        box = check_box(f"{name}Switch", action.text(), "", action.text())
        mirror(box, action)
        return box

    def _make_errors(self) -> QWidget:
        """Return the fields that overlays share, and the button for another seed."""
        seed = action_button(self._actions("newSeed"))
        errors = QWidget()
        parts: list[Part] = []
        for setting in dict.fromkeys(candidate for overlay in OVERLAYS for candidate in overlay.settings):
            if isinstance(setting, ErrorSize):
                field = NumberEdit(setting.name, setting.label, setting.tip, _error_size)
                self._error_fields[setting] = field
                parts += [setting.short, (field, 1)]
        row_of(*parts, seed, margins=(24, 0, 0, 0), spacing=6, parent=errors)
        return errors

    def _add_ghost(self, ghost: Ghost) -> None:
        row = self._rows.rowCount()
        box = self._ghost_boxes[ghost] = self._switch(ghost.action_name)
        box.setIconSize(SIGN)
        words = box.text()
        use = self._use_buttons[ghost] = tool_button(
            f"use_{ghost.name}", f"Use {words}", f"Apply to the curve: {words}", text="Use"
        )
        use.clicked.connect(lambda: self._analysis.ghost_adopted.emit(ghost))
        self._rows.addWidget(box, row, 0)
        self._rows.addWidget(use, row, 1, Qt.AlignmentFlag.AlignRight)

    def follow_ghosts(self) -> None:
        """Add rows for new ghosts below the others, and remove those of ghosts that are gone."""
        present = all_ghosts()
        for ghost in present:
            if ghost not in self._ghost_boxes:
                self._add_ghost(ghost)
        for ghost in self._ghost_boxes.keys() - set(present):
            remove_widgets(self._rows, (self._ghost_boxes.pop(ghost), self._use_buttons.pop(ghost)))
        self.set_theme(self.theme)

    def _connect(self) -> None:
        self._notes_due = DelayedCall(self, _NOTES_MS, self._render_notes)
        self._analysis.changed.connect(self._render)
        self._analysis.noted.connect(self._notes_due.start_if_idle)
        for setting, edit in self._error_fields.items():
            edit.entered.connect(partial(self._set_error, setting))
            edit.refused.connect(self._refuse)
            edit.left.connect(lambda: self._refuse(""))

    # Rendering: nothing here writes back

    def _render(self) -> None:
        settings = self._analysis.settings
        for overlay, setting, slider in self._sliders:
            slider.render_value(settings.value(setting))
            slider.setEnabled(overlay in settings.overlays)
        for overlay, switch, box in self._checks:
            box.setChecked(settings.value(switch))
            box.setEnabled(overlay in settings.overlays)
        wanted = {setting for overlay in settings.overlays for setting in overlay.settings}
        self._errors.setVisible(not wanted.isdisjoint(self._error_fields))
        for error, edit in self._error_fields.items():
            edit.show_number(settings.value(error), 6)
        self._render_notes()

    def _render_notes(self) -> None:
        for overlay, label in self._notes.items():
            label.show_text(self._analysis.notes.get(overlay, ""))
        self._problem.show_problem(self._refusal or self._analysis.problem)

    def set_theme(self, theme: Theme) -> None:
        for ghost, box in self._ghost_boxes.items():
            box.setIcon(QIcon(sign_pixmap(ghost.style, theme, self.devicePixelRatioF())))

    # Input of the person

    def _set_error(self, setting: ErrorSize, value: float) -> None:
        self._analysis.set_value(setting, value)
        self._render()

    def _refuse(self, reason: str) -> None:
        self._refusal = reason
        self._render_notes()


def _error_size(text: str) -> float:
    """Return the size of a typed error."""
    value = read_number(text)
    if value < 0:
        raise ExpressionError("The size of an error cannot be negative.")
    return value


def _note(name: str, role: QPalette.ColorRole = MUTED) -> Label:
    label = Label(name=name, wordWrap=True, role=role)
    # A long word must not widen the window.
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
    return label
