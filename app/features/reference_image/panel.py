"""The picture to trace in numbers: where it lies, how large it is, how much of it shines through."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QCheckBox,
    QFormLayout,
    QHBoxLayout,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.appearance.theme import theme_of
from app.document.model import ReferenceImage
from app.document.words import number
from app.qt.labels import Label, tip_of
from app.qt.overrides import Guarded
from app.widgets.field_edit import NumberEdit
from app.widgets.live_slider import LiveSlider
from app.widgets.number_text import decimal_mark
from app.widgets.tool_buttons import action_button

STEPS = 100
"""Positions of the slider from nothing to all of the image."""


class ImagePanel(Guarded, QWidget):
    """A form that shows the reference image and reports what is typed.

    Signals
    -------
    corner_edited
        Another lower left corner (x, y) was typed. Who cannot use it, or a width, calls `refuse`.
    width_edited
        Another width was typed, or a height: the width that belongs to it.
    locked_switched
        The image is to be locked, or freed.
    refused
        Why a text that was typed is no number.

    Attributes
    ----------
    opacity
        The slider, in `STEPS`.
    """

    corner_edited = Signal(float, float)
    width_edited = Signal(float)
    locked_switched = Signal(bool)
    refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("imagePanel")
        self._image: ReferenceImage | None = None
        # The field that was typed in last.
        self._entry: NumberEdit | None = None
        self._refusal = self._problem_text = ""
        self.x_edit = _number_edit("imageX", "x", "x of the lower left corner")
        self.y_edit = _number_edit("imageY", "y", "y of the lower left corner")
        self.width_edit = _number_edit("imageWidth", "Width", "Width in the plane; the height follows")
        self.height_edit = _number_edit("imageHeight", "Height", "Height in the plane; the width follows")
        self.opacity = _opacity_slider()
        self._percent = Label()
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self.lock = QCheckBox("Locked")
        self.lock.setObjectName("imageLocked")
        self.lock.setToolTip("Keep the image safe from being moved and scaled")
        self._file = Label()
        self._file.setObjectName("imageFile")
        # A long name is cut, it never widens the window; the tooltip has it whole.
        self._file.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._problem = Label()
        self._problem.setObjectName("imageProblem")
        self._problem.setWordWrap(True)
        policy = self._problem.sizePolicy()
        policy.setHorizontalPolicy(QSizePolicy.Policy.Ignored)
        self._problem.setSizePolicy(policy)
        self._buttons = QHBoxLayout()
        self._lay_out()
        self._connect()
        self.render_image(None)

    def _lay_out(self) -> None:
        place, size, fade = QHBoxLayout(), QHBoxLayout(), QHBoxLayout()
        for row, widgets in (
            (place, (self.x_edit, Label("y"), self.y_edit)),
            (size, (self.width_edit, Label("×"), self.height_edit)),
        ):
            row.setSpacing(6)
            for widget in widgets:
                row.addWidget(widget, 0 if isinstance(widget, Label) else 1)
        fade.addWidget(self.opacity, 1)
        fade.addWidget(self._percent)
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.addRow("File", self._file)
        form.addRow("x", place)
        form.addRow("Size", size)
        form.addRow("Opacity", fade)
        form.addRow("", self.lock)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 12, 12, 12)
        layout.setSpacing(10)
        layout.addWidget(self._problem)
        layout.addLayout(form)
        layout.addLayout(self._buttons)
        layout.addStretch(1)

    def _connect(self) -> None:
        for edit in (self.x_edit, self.y_edit, self.width_edit, self.height_edit):
            edit.entered.connect(partial(self._report, edit))
            edit.refused.connect(partial(self._refuse_text, edit))
            edit.left.connect(self._clear_refusal)
        self.opacity.drag_ended.connect(lambda: self.render_image(self._image))
        self.lock.clicked.connect(self.locked_switched)

    def add_buttons(self, actions: Sequence[QAction]) -> None:
        """Offer these actions, too."""
        for action in actions:
            self._buttons.addWidget(action_button(action, beside=True))
        self._buttons.addStretch(1)

    # Rendering: nothing here writes back

    def render_image(self, image: ReferenceImage | None) -> None:
        """Show where `image` lies; nothing of one that is there no more."""
        self._image = image
        if image is None:
            for edit in (self.x_edit, self.y_edit, self.width_edit, self.height_edit):
                edit.show_text("")
            self._file.setText("")
            self._file.setToolTip("")
            return
        mark = decimal_mark()
        for edit, value in (
            (self.x_edit, image.x),
            (self.y_edit, image.y),
            (self.width_edit, image.width),
            (self.height_edit, image.height),
        ):
            edit.show_text(number(value, 6, mark))
            edit.setEnabled(not image.locked)
        self._file.setText(Path(image.path).name)
        self._file.setToolTip(tip_of(image.path))
        self.lock.setChecked(image.locked)
        if not self.opacity.isSliderDown():
            self.opacity.setValue(round(image.opacity * STEPS))
        self._percent.setText(f"{image.opacity:.0%}".replace("%", " %"))

    def show_problem(self, text: str) -> None:
        """Say why the picture cannot be shown; empty where it can."""
        self._problem_text = text
        self._render_problem()

    def _render_problem(self) -> None:
        text = self._refusal or self._problem_text
        self._problem.setStyleSheet(f"color: {theme_of(self.palette()).warning.name()}")
        # Paths may be broken where folders end: else a long one would widen the window.
        self._problem.setText(f"⚠ {text}".replace("/", "/\N{ZERO WIDTH SPACE}") if text else "")
        self._problem.setToolTip(tip_of(text))
        self._problem.setVisible(bool(text))

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and hasattr(self, "_buttons"):
            self._render_problem()

    # What the person did

    def _report(self, edit: NumberEdit, value: float) -> None:
        image, self._entry = self._image, edit
        if image is None:
            return
        self._clear_refusal()
        if edit is self.x_edit:
            self.corner_edited.emit(value, image.y)
        elif edit is self.y_edit:
            self.corner_edited.emit(image.x, value)
        else:
            aspect = 1.0 if edit is self.width_edit else image.width / image.height
            self.width_edited.emit(value * aspect)
        self.render_image(self._image)

    def _refuse_text(self, edit: NumberEdit, reason: str) -> None:
        self._entry = edit
        self.refuse(reason)
        self.refused.emit(reason)

    def refuse(self, reason: str) -> None:
        """Say why what was typed last cannot be taken; it stays to be mended while the cursor is there."""
        self._refusal = reason
        if self._entry is not None:
            if self._entry.hasFocus():
                self._entry.keep()
            else:
                self._entry.revert()
        self._render_problem()

    def _clear_refusal(self) -> None:
        self._refusal = ""
        self._render_problem()


def _number_edit(name: str, label: str, what: str) -> NumberEdit:
    return NumberEdit(name, f"{label} of the image", f"{what} (a number or an expression, Enter to set)")


def _opacity_slider() -> LiveSlider:
    slider = LiveSlider(Qt.Orientation.Horizontal)
    slider.setObjectName("imageOpacity")
    slider.setAccessibleName("Opacity of the image")
    slider.setToolTip("How much of the image is seen; Escape cancels a drag")
    slider.setRange(0, STEPS)
    return slider
