"""The picture to trace: add, find again, move, remove."""

from __future__ import annotations

from math import ceil, log10
from pathlib import Path

from PySide6.QtGui import QAction, QActionGroup, QImage
from PySide6.QtWidgets import QDockWidget, QFileDialog

from app.canvas.image_file import ImageFileError, read_image
from app.commands.messages import Messages
from app.commands.parts import Handlers, Parts
from app.document.image_edits import set_image, set_image_file
from app.document.model import ReferenceImage
from app.tools.image_tool import ImageTool
from app.view_model.curve_view import CurveView

_PICTURES = "Pictures (*.png *.jpg *.jpeg);;All files (*)"
_MISSING = "The reference image is not shown. {}"
_SHARE = 0.8
"""Part of the canvas that a new picture fills."""


class ImageCommands:
    """Reads the picture that the document names, and changes what it names."""

    def __init__(self, parts: Parts, messages: Messages) -> None:
        self._parts, self._messages = parts, messages
        self._session, self._actions = parts.session, parts.actions
        self._is_loaded = False
        self._loaded_path = ""
        self._pixels: QImage | None = None
        self._problem = ""
        self._shown: ReferenceImage | None = None
        # What stood in front when the panel came; it comes back when the panel goes.
        self._in_front_before: list[QDockWidget] = []
        names = ("moveImage", "findImage", "removeImage")
        parts.image_panel.add_buttons([self._actions[name] for name in names])
        # Another document may name the same file, which may have changed meanwhile.
        parts.session.opened.connect(self._forget_file)
        # Choosing what the mouse does to points gives it back to them.
        tools = self._actions["selectTool"].actionGroup()
        assert tools is not None
        self._tools, self._tool_before = tools, tools.checkedAction()
        tools.triggered.connect(self._leave_moving)
        self._show_dock(False)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "addImage": self._ask_and_add,
            "moveImage": self._toggle_moving,
            "findImage": self._ask_and_find,
            "removeImage": self._remove,
        }

    def render(self, view: CurveView) -> None:
        """Show the picture of the document, or say why it cannot be shown."""
        image = self._session.document.image
        if image is self._shown and self._is_loaded:
            return
        self._is_loaded = True
        if image is not None and image.path != self._loaded_path:
            self._load(image.path)
        if image is None:
            self._loaded_path, self._pixels, self._problem = "", None, ""
        had_one, self._shown = self._shown is not None, image
        self._parts.canvas.set_image(image, self._pixels)
        self._parts.image_panel.render_image(image)
        self._parts.image_panel.show_problem(self._problem)
        self._messages.set_image_problem(self._problem and _MISSING.format(self._problem))
        self._enable(image)
        if had_one != (image is not None):
            self._show_dock(image is not None)

    def _enable(self, image: ReferenceImage | None) -> None:
        can_move = image is not None and not image.locked
        self._actions["moveImage"].setEnabled(can_move)
        if not can_move:
            self._leave_moving()
        for name in ("findImage", "removeImage"):
            self._actions[name].setEnabled(image is not None)

    def _show_dock(self, shown: bool) -> None:
        """Show the panel while there is a picture; without one it is disabled and stays away."""
        dock = self._parts.image_dock
        dock.setEnabled(shown)
        dock.toggleViewAction().setVisible(shown)
        side_panel = self._actions["toggleSidePanel"].isChecked()
        presenting = self._actions["presentation"].isChecked()
        in_front = [each for each in self._parts.docks if not each.visibleRegion().isEmpty()]
        covered = self._parts.window.tabifiedDockWidgets(dock) if dock in in_front and not shown else []
        dock.setVisible(shown and side_panel and not presenting)
        # A tab that appears comes to the front, and one that goes brings its neighbour there; undo and redo
        # must not turn the page over.
        for each in (*in_front, *(each for each in covered if each in self._in_front_before)):
            if each is not dock and not each.isHidden():
                each.raise_()
        self._in_front_before = in_front if shown else []

    def _load(self, path: str) -> None:
        self._loaded_path, self._pixels, self._problem = path, None, ""
        try:
            self._pixels = read_image(path)
        except ImageFileError as problem:
            self._problem = str(problem)

    def _forget_file(self) -> None:
        self._is_loaded, self._loaded_path = False, ""
        self.render(self._session.active_view)

    # What the person did

    def _ask_and_add(self) -> None:
        path = self._ask("Reference Image")
        if path:
            self.add(path)

    def add(self, path: str) -> None:
        """Put the picture at `path` behind the curves, in the middle of what is visible."""
        pixels = self._read(path)
        if pixels is None:
            return
        x_min, y_min, x_max, y_max = self._parts.canvas.pixel_map.box
        scale = _SHARE * min((x_max - x_min) / pixels.width(), (y_max - y_min) / pixels.height())
        width, height = pixels.width() * scale, pixels.height() * scale
        x, y = (x_min + x_max - width) / 2, (y_min + y_max - height) / 2
        # As many decimals as make a difference on the screen: 0, not −4.4e−16.
        decimals = ceil(-log10(self._parts.canvas.pixel_size))
        x, y = round(x, decimals) + 0.0, round(y, decimals) + 0.0
        image = ReferenceImage(path, x, y, width, height)
        if self._session.change("Add image", lambda document: set_image(document, image)):
            self._parts.image_dock.raise_()
            self._session.say("File › Move Image drags and scales the image; the panel fades it.")

    def _ask_and_find(self) -> None:
        path = self._ask("Find Image")
        if path:
            self.find(path)

    def find(self, path: str) -> None:
        """Show the picture at `path` where the present one lies."""
        pixels = self._read(path)
        if pixels is not None:
            aspect = pixels.width() / pixels.height()
            self._session.change("Find image", lambda document: set_image_file(document, path, aspect))

    def _ask(self, title: str) -> str:
        folder = str(self._parts.preferences.last_folder)
        name, _ = QFileDialog.getOpenFileName(self._parts.window, title, folder, _PICTURES)
        return str(Path(name).absolute()) if name else ""

    def _read(self, path: str) -> QImage | None:
        """Return the picture at `path`, or say why there is none."""
        try:
            return read_image(path)
        except ImageFileError as problem:
            self._parts.message_bar.warn(str(problem))
            return None

    def _remove(self) -> None:
        self._session.change("Remove image", lambda document: set_image(document, None))

    def _leave_moving(self, _tool: QAction | None = None) -> None:
        if self._actions["moveImage"].isChecked():
            self._actions["moveImage"].setChecked(False)
            self._toggle_moving()

    def _toggle_moving(self) -> None:
        moving = self._actions["moveImage"].isChecked()
        self._parts.canvas.set_image_tool(ImageTool(self._session) if moving else None)
        self._light_tools(lit=not moving)
        if moving:
            self._session.say(
                "Drag the image to move it, a corner to scale it; Escape goes back to the points."
            )

    def _light_tools(self, *, lit: bool) -> None:
        """Let no tool for points look as if it were in use while the mouse has the picture."""
        policy = QActionGroup.ExclusionPolicy
        if not lit:
            self._tool_before = self._tools.checkedAction() or self._tool_before
            self._tools.setExclusionPolicy(policy.ExclusiveOptional)
            if self._tool_before is not None:
                self._tool_before.setChecked(False)
            return
        if self._tools.checkedAction() is None and self._tool_before is not None:
            self._tool_before.setChecked(True)
        self._tools.setExclusionPolicy(policy.Exclusive)
