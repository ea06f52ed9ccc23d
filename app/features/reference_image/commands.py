"""The picture to trace: add, find again, move, remove."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, log10
from pathlib import Path

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QDockWidget, QFileDialog, QWidget

from ...actions.declaration import action, also, switch
from ...actions.menus import FILE_IMAGE, IMAGE_BUTTONS
from ...actions.needs import Need
from ...canvas.image_layer import ImageFileError, read_image
from ...document.model import ReferenceImage
from ...document.plane_edits import set_image, set_image_file, set_image_opacity
from ...document.words import names_with_verb
from ...state.window_state import WindowState
from ...storage.files import IMAGE_PATTERNS
from ...tools.reference_image import MOVE_IMAGE
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits, SliderGesture
from .panel import STEPS, ImagePanel

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
