"""The picture to trace in numbers: where it lies, how large it is, how much of it shines through."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QCheckBox,
    QFormLayout,
    QHBoxLayout,
    QSizePolicy,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.document.edits import EditError
from app.document.expression import ExpressionError, parse_number
from app.document.image_edits import place_image, set_image_locked, set_image_opacity
from app.document.model import Document, ReferenceImage
from app.labels import Label, tip_of
from app.overrides import Guarded
from app.panels.field_edit import FieldEdit
from app.panels.live_slider import LiveSlider
from app.panels.number_text import decimal_mark, rounded_text
from app.panels.slider_edit import SliderEdit
from app.session import Session
from app.theme import theme_of

_STEPS = 100


class ImagePanel(Guarded, QWidget):
    """A form for the reference image; what is typed becomes an edit."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("imagePanel")
        self._session = session
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
            edit.committed.connect(lambda text, edit=edit: self._type_number(edit, text))
            edit.left.connect(self._forget_refusal)
        fading = SliderEdit(
            self.opacity,
            self._session,
            lambda document, position: set_image_opacity(document, position / _STEPS),
            lambda position: _fade_name(position / _STEPS),
        )
        fading.finished.connect(lambda: self.render_image(self._session.document.image))
        self.lock.clicked.connect(self._set_locked)

    def add_buttons(self, actions: Sequence[QAction]) -> None:
        """Offer these actions, too."""
        for action in actions:
            button = QToolButton()
            button.setDefaultAction(action)
            button.setObjectName(f"{action.objectName()}Button")
            button.setAccessibleName(action.text())
            button.setIconSize(QSize(16, 16))
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
            self._buttons.addWidget(button)
        self._buttons.addStretch(1)

    # Rendering: nothing here writes back

    def render_image(self, image: ReferenceImage | None) -> None:
        """Show where `image` lies; nothing of one that is there no more."""
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
            edit.show_text(rounded_text(value, mark))
            edit.setEnabled(not image.locked)
        self._file.setText(Path(image.path).name)
        self._file.setToolTip(tip_of(image.path))
        self.lock.setChecked(image.locked)
        if not self.opacity.isSliderDown():
            self.opacity.setValue(round(image.opacity * _STEPS))
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

    def _type_number(self, edit: FieldEdit, text: str) -> None:
        image = self._session.document.image
        if image is None:
            return
        try:
            value = parse_number(text, decimal_mark())
            corner, width = (image.x, image.y), image.width
            if edit is self.x_edit:
                corner = (value, image.y)
            elif edit is self.y_edit:
                corner = (image.x, value)
            elif edit is self.width_edit:
                width = value
            else:
                width = value * (image.width / image.height)
            name = "Move image" if edit in (self.x_edit, self.y_edit) else "Scale image"
            self._commit(lambda document: place_image(document, corner, width), name)
        except (EditError, ExpressionError) as reason:
            self._refuse(str(reason), edit, text)
        self.render_image(self._session.document.image)

    def _refuse(self, reason: str, edit: FieldEdit, typed: str) -> None:
        self._refusal = reason
        if edit.hasFocus():
            edit.keep(typed)
        else:
            edit.revert()
        self._session.refuse(reason)
        self._render_problem()

    def _forget_refusal(self) -> None:
        self._refusal = ""
        self._render_problem()

    def _commit(self, edit: Callable[[Document], Document], text: str) -> None:
        self._session.interrupt()
        document = edit(self._session.document)
        self._forget_refusal()
        self._session.commit(document, text)

    def _set_locked(self, locked: bool) -> None:
        name = "Lock image" if locked else "Unlock image"
        self._commit(lambda document: set_image_locked(document, locked), name)


def _fade_name(share: float) -> str:
    return f"Fade image to {share:.0%}".replace("%", " %")


def _number_edit(name: str, label: str, what: str) -> FieldEdit:
    return FieldEdit(name, f"{label} of the image", f"{what} (a number or an expression, Enter to set)")


def _opacity_slider() -> LiveSlider:
    slider = LiveSlider(Qt.Orientation.Horizontal)
    slider.setObjectName("imageOpacity")
    slider.setAccessibleName("Opacity of the image")
    slider.setToolTip("How much of the image is seen; Escape cancels a drag")
    slider.setRange(0, _STEPS)
    return slider
