"""What can be drawn over the curve: switches and their settings."""

from __future__ import annotations

from collections.abc import Callable
from math import log10

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QCheckBox, QGridLayout, QSlider, QVBoxLayout, QWidget

from app.analysis import Analysis

_STEPS = 20
"""Steps of a slider for one power of ten."""


class AnalysisPanel(QWidget):
    """A switch for each overlay, and beside it how it is drawn."""

    def __init__(
        self, analysis: Analysis, actions: Callable[[str], QAction], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.setObjectName("analysisPanel")
        self._analysis = analysis
        self._rows = QGridLayout()
        self._rows.setVerticalSpacing(8)
        self._add_switch(actions, "overlayComb")
        self.comb_slider = self._add_scale("combScale", "Length of the comb's teeth")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 12, 12, 12)
        layout.addLayout(self._rows)
        layout.addStretch(1)
        # Emitted for whatever the person does with a slider, and for nothing else.
        self.comb_slider.actionTriggered.connect(
            lambda _action: analysis.change(comb_scale=10 ** (self.comb_slider.sliderPosition() / _STEPS))
        )
        analysis.changed.connect(self._render)
        self._render()

    def _add_switch(self, actions: Callable[[str], QAction], name: str) -> None:
        action = actions(name)
        box = QCheckBox(action.text())
        box.setObjectName(f"{name}Switch")
        box.setAccessibleName(action.text())
        box.setToolTip(action.toolTip())
        box.setChecked(action.isChecked())
        box.clicked.connect(action.trigger)
        action.toggled.connect(box.setChecked)
        self._rows.addWidget(box, self._rows.rowCount(), 0)

    def _add_scale(self, name: str, label: str) -> QSlider:
        slider = QSlider(Qt.Orientation.Horizontal)
        slider.setObjectName(name)
        slider.setRange(-_STEPS, _STEPS)
        slider.setAccessibleName(label)
        slider.setToolTip(label)
        self._rows.addWidget(slider, self._rows.rowCount() - 1, 1)
        return slider

    def _render(self) -> None:
        self.comb_slider.setValue(round(_STEPS * log10(self._analysis.settings.comb_scale)))
