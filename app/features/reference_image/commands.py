"""The picture to trace: the panel with its numbers, and the actions that add, find, move and remove it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import ceil, log10
from pathlib import Path

from PySide6.QtGui import QAction, QImage
from PySide6.QtWidgets import QDockWidget, QFileDialog, QSizePolicy, QWidget

from ...actions.declaration import action, also, switch
from ...actions.menus import FILE_IMAGE, IMAGE_BUTTONS
from ...actions.needs import Need
from ...canvas.image_layer import ImageFileError, read_image
from ...document.model import ReferenceImage, Vector
from ...document.plane_edits import (
    place_image,
    set_image,
    set_image_file,
    set_image_locked,
    set_image_opacity,
)
from ...document.words import names_with_verb
from ...qt.labels import Label, tip_of
from ...state.window_state import WindowState
from ...storage.files import IMAGE_PATTERNS
from ...tools.reference_image import MOVE_IMAGE
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import column_of, form_of, row_of
from ...widgets.controls import action_button, check_box, named
from ...widgets.fields import FieldForm, NumberEdit
from ...widgets.sliders import LiveSlider
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits, SliderGesture

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


_PICTURES = f"Pictures ({IMAGE_PATTERNS});;All files (*)"
_MISSING = "The reference image is not shown. {}"
_SHARE = 0.8
"""Part of the canvas that a new picture fills."""

_AN_IMAGE = Need("a reference image", lambda state: state.is_image_locked is not None)


class ImageCommands:
    """Commands for the reference image: read its file, add, move and remove it.

    Attributes
    ----------
    panel
        Form of the image, once its dock has been shown.
    """

    panel: ImagePanel | None = None

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session, self._actions = context.session, context.actions
        self._is_loaded = False
        self._loaded_path = ""
        self._pixels: QImage | None = None
        self._problem = ""
        self._image: ReferenceImage | None = None
        # Docks in front when the panel appeared; they return when it is hidden.
        self._in_front_before: list[QDockWidget] = []
        self._dock = context.docks["imageDock"]
        # The same file may have changed when another document names it.
        context.session.opened.connect(self._reset_file)
        context.files.trace = self.trace_first
        context.store.changed.connect(self._show_state)
        self._show_dock(False)

    @Panel("imageDock", "Image")
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form of the image, with its buttons."""
        panel = self.panel = ImagePanel(self._actions.in_bar(IMAGE_BUTTONS)[1], parent)
        self._edits = FormEdits(self._session, panel)
        self._opacity = SliderGesture(
            self._session,
            panel.opacity,
            lambda document, position: set_image_opacity(document, position / STEPS),
            lambda position: f"Fade image to {position / STEPS:.0%}".replace("%", " %"),
        )
        self._render_panel()
        return panel

    def render_panel(self, view: CurveView) -> None:
        """Show the image of the document, or why it cannot be shown."""
        image = self._session.document.image
        if image == self._image and self._is_loaded:
            return
        self._is_loaded = True
        if image is not None and image.path != self._loaded_path:
            self._load(image.path)
        if image is None:
            self._loaded_path, self._pixels, self._problem = "", None, ""
        had_one, self._image = self._image is not None, image
        self._context.central.canvas.drawing.set_image(image, self._pixels)
        self._render_panel()
        self._context.store.change(image_problem=self._problem and _MISSING.format(self._problem))
        if image is None or image.locked:
            self._context.store.change(moves_image=False)
        if had_one != (image is not None):
            self._show_dock(image is not None)

    def _render_panel(self) -> None:
        if self.panel is not None:
            self.panel.render_image(self._image)
            self.panel.show_problem(self._problem)

    def _show_dock(self, visible: bool) -> None:
        """Show the panel while there is an image; without one it is disabled and hidden."""
        dock = self._dock
        dock.setEnabled(visible)
        dock.toggleViewAction().setVisible(visible)
        state = self._context.store.state
        in_front: list[QDockWidget] = [
            other for other in self._context.docks.side if not other.visibleRegion().isEmpty()
        ]
        covered = self._context.window.tabifiedDockWidgets(dock) if dock in in_front and not visible else []
        dock.setVisible(visible and state.side_panel and not state.presentation)
        # A tab that appears is raised, and one that is hidden raises its neighbour; undo and redo
        # must not switch tabs.
        for other in (*in_front, *(other for other in covered if other in self._in_front_before)):
            if other is not dock and not other.isHidden():
                other.raise_()
        self._in_front_before = in_front if visible else []

    def _load(self, path: str) -> None:
        self._loaded_path, self._pixels, self._problem = path, None, ""
        try:
            self._pixels = read_image(path)
        except ImageFileError as problem:
            self._problem = str(problem)

    def _reset_file(self) -> None:
        self._is_loaded, self._loaded_path = False, ""
        self.render_panel(self._session.active_view)

    # User input

    @action("addImage", "Reference Image…", FILE_IMAGE, icon="image")
    def _ask_and_add(self) -> None:
        """Show a PNG or JPEG picture behind the curves, to trace it."""
        path = self._ask("Reference Image")
        if path is not None:
            self.trace(path)

    def trace_first(self, paths: Sequence[Path]) -> str:
        """Trace the first of these pictures; return a sentence on the others."""
        for path in paths[:1]:
            self.trace(path)
        others = [path.name for path in paths[1:]]
        return f"{names_with_verb(others)} not traced: a document has one reference image." if others else ""

    def trace(self, path: Path) -> None:
        """Show a picture behind the curves in the middle of the visible area, or warn."""
        name = str(path.absolute())
        pixels = self._read(name)
        if pixels is None:
            return
        x_min, y_min, x_max, y_max = self._context.central.canvas.pixel_map.box
        scale = _SHARE * min((x_max - x_min) / pixels.width(), (y_max - y_min) / pixels.height())
        width, height = pixels.width() * scale, pixels.height() * scale
        x, y = (x_min + x_max - width) / 2, (y_min + y_max - height) / 2
        # Rounded to decimals that are visible on the screen: 0, not −4.4e−16.
        decimals = ceil(-log10(self._context.central.canvas.camera.pixel_size))
        x, y = round(x, decimals) + 0.0, round(y, decimals) + 0.0
        image = ReferenceImage(name, x, y, width, height)
        if self._session.change("Add image", lambda document: set_image(document, image)):
            self._dock.raise_()
            self._session.say(
                "To move or scale the image, use File › Reference Image › Move Image; to fade it, the panel."
            )

    @switch(
        "moves_image",
        "moveImage",
        "Move Image",
        FILE_IMAGE,
        icon="move",
        needs=Need("an unlocked reference image", lambda state: state.is_image_locked is False),
    )
    @also(IMAGE_BUTTONS(10))
    def _toggle_moving(self) -> None:
        """Drag the reference image and scale it by its corners; meanwhile points cannot be edited."""
        if self._context.store.state.moves_image:
            self._session.say(MOVE_IMAGE.hint)

    @action("findImage", "Find Image…", FILE_IMAGE, needs=_AN_IMAGE)
    @also(IMAGE_BUTTONS(11))
    def _ask_and_find(self) -> None:
        """Locate the file of the reference image."""
        path = self._ask("Find Image")
        if path is not None:
            self.find(path)

    def find(self, path: Path) -> None:
        """Show another file at the position of the image, or warn."""
        name = str(path.absolute())
        pixels = self._read(name)
        if pixels is not None:
            aspect = pixels.width() / pixels.height()
            self._session.change("Find image", lambda document: set_image_file(document, name, aspect))

    def _ask(self, title: str) -> Path | None:
        folder = str(self._context.preferences.last_folder)
        name, _ = QFileDialog.getOpenFileName(self._context.window, title, folder, _PICTURES)
        return Path(name) if name else None

    def _read(self, path: str) -> QImage | None:
        """Return the picture at `path`, or warn."""
        try:
            return read_image(path)
        except ImageFileError as problem:
            self._context.central.message_bar.warn(str(problem))
            return None

    @action("removeImage", "Remove Image", FILE_IMAGE, needs=_AN_IMAGE)
    @also(IMAGE_BUTTONS(12))
    def _remove(self) -> None:
        """Remove the reference image from the document."""
        self._session.change("Remove image", lambda document: set_image(document, None))

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.moves_image != before.moves_image:
            self._context.central.canvas.choose_tool(MOVE_IMAGE if after.moves_image else after.tool)


COMMAND_SETS = (ImageCommands,)
