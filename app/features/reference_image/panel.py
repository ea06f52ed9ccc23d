"""The picture to trace in numbers: where it lies, how large it is, how much of it shines through."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QSizePolicy, QWidget

from ...document.model import ReferenceImage, Vector
from ...document.plane_edits import place_image, set_image_locked
from ...qt.labels import Label, tip_of
from ...widgets.boxes import column_of, form_of, row_of
from ...widgets.controls import action_button, check_box, named
from ...widgets.fields import FieldForm, NumberEdit
from ...widgets.sliders import LiveSlider

STEPS = 100
"""Positions of the slider from nothing to all of the image."""


class ImagePanel(FieldForm):
    """A form that shows the reference image, and asks for changes of it.

    Attributes
    ----------
    opacity
        The slider, in `STEPS`.
    """

    def __init__(self, buttons: Sequence[QAction], parent: QWidget | None = None) -> None:
        super().__init__("imagePanel", "imageProblem", parent)
        self._image: ReferenceImage | None = None
        self.x_edit = _number_edit("imageX", "x", "x of the lower left corner")
        self.y_edit = _number_edit("imageY", "y", "y of the lower left corner")
        self.width_edit = _number_edit("imageWidth", "Width", "Width in the plane; the height follows")
        self.height_edit = _number_edit("imageHeight", "Height", "Height in the plane; the width follows")
        self._edits = (self.x_edit, self.y_edit, self.width_edit, self.height_edit)
        self.opacity = _opacity_slider()
        self._percent = Label()
        self._percent.setMinimumWidth(self._percent.fontMetrics().horizontalAdvance("100 %"))
        self.lock = check_box("imageLocked", "Locked", "Protect the image from being moved and scaled")
        self._file = Label(name="imageFile")
        # A long name is elided and never widens the window; the tooltip shows all of it.
        self._file.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        policy = self.problem.sizePolicy()
        policy.setHorizontalPolicy(QSizePolicy.Policy.Ignored)
        self.problem.setSizePolicy(policy)
        self._lay_out(buttons)
        self._connect()
        self.follow_theme()
        self.render_image(None)

    def _lay_out(self, buttons: Sequence[QAction]) -> None:
        fields = form_of(
            ("File", self._file),
            ("x", row_of((self.x_edit, 1), "y", (self.y_edit, 1), spacing=6)),
            ("Size", row_of((self.width_edit, 1), "×", (self.height_edit, 1), spacing=6)),
            ("Opacity", row_of((self.opacity, 1), self._percent)),
            ("", self.lock),
        )
        below = row_of(*(action_button(action, beside=True) for action in buttons), 1)
        column_of(self.problem, fields, below, 1, margins=12, spacing=10, parent=self)

    def _connect(self) -> None:
        self.watch(*self._edits)
        self.x_edit.entered.connect(partial(self._move, 0))
        self.y_edit.entered.connect(partial(self._move, 1))
        self.width_edit.entered.connect(self._scale)
        self.height_edit.entered.connect(self._scale_by_height)
        self.opacity.drag_ended.connect(self._render_again)
        self.lock.clicked.connect(self._set_locked)

    # Rendering: nothing here writes back

    def render_image(self, image: ReferenceImage | None) -> None:
        """Show the numbers of `image`; empty without one."""
        self._image = image
        if image is None:
            for edit in self._edits:
                edit.show_text("")
            self._file.setText("")
            self._file.setToolTip("")
            return
        corner = (image.x, image.y)
        for edit, value in zip(self._edits, (*corner, image.width, image.height), strict=True):
            edit.show_number(value, 6)
            edit.setEnabled(not image.locked)
        self._file.setText(Path(image.path).name)
        self._file.setToolTip(tip_of(image.path))
        self.lock.setChecked(image.locked)
        if not self.opacity.isSliderDown():
            self.opacity.setValue(round(image.opacity * STEPS))
        self._percent.setText(f"{image.opacity:.0%}".replace("%", " %"))

    def _render_again(self) -> None:
        self.render_image(self._image)

    def show_problem(self, text: str) -> None:
        """Show why the image cannot be shown; empty where it can."""
        # Paths may be wrapped after folders, so that a long one does not widen the window.
        super().show_problem(text.replace("/", "/\N{ZERO WIDTH SPACE}"))
        self.problem.setToolTip(tip_of(text))

    # User input

    def _move(self, axis: int, value: float) -> None:
        if (image := self._image) is not None:
            corner = (value, image.y) if axis == 0 else (image.x, value)
            self._ask("Move image", corner, image.width)

    def _scale(self, width: float) -> None:
        if (image := self._image) is not None:
            self._ask("Scale image", (image.x, image.y), width)

    def _ask(self, text: str, corner: Vector, width: float) -> None:
        """Ask for the image with this lower left corner and width."""
        self.edited.emit(text, lambda document, _curve: place_image(document, corner, width))
        self._render_again()

    def _scale_by_height(self, height: float) -> None:
        if (image := self._image) is not None:
            self._scale(height * (image.width / image.height))

    def _set_locked(self, locked: bool) -> None:
        name = "Lock image" if locked else "Unlock image"
        self.edited.emit(name, lambda document, _curve: set_image_locked(document, locked))


def _number_edit(name: str, label: str, what: str) -> NumberEdit:
    return NumberEdit(name, f"{label} of the image", f"{what} (a number or an expression, Enter to set)")


def _opacity_slider() -> LiveSlider:
    tip = "Opacity of the image; Escape cancels a drag"
    slider = named(LiveSlider(), "imageOpacity", "Opacity of the image", tip)
    slider.setRange(0, STEPS)
    return slider
