"""Connects the actions of a window to what they do."""

from __future__ import annotations

from app.commands.clipboard_commands import ClipboardCommands
from app.commands.context_menus import ContextMenus
from app.commands.curve_commands import CurveCommands
from app.commands.edit_commands import EditCommands
from app.commands.help_commands import HelpCommands
from app.commands.image_commands import ImageCommands
from app.commands.lesson_commands import LessonCommands
from app.commands.messages import Messages
from app.commands.overlay_commands import OverlayCommands
from app.commands.parts import CommandSet, Handlers, LiveSet, Parts
from app.commands.rail_commands import RailCommands
from app.commands.selection_commands import SelectionCommands
from app.commands.snap_commands import SnapCommands
from app.commands.tangent_commands import TangentCommands
from app.commands.tool_commands import ToolCommands
from app.commands.view_commands import ViewCommands
from app.view_model.curve_view import CurveView


class Commands:
    """All commands of one window."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self.view = ViewCommands(parts)
        self.messages = Messages(parts)
        self.snap = SnapCommands(parts)
        self.images = ImageCommands(parts, self.messages)
        curves = CurveCommands(parts)
        self.lessons = LessonCommands(parts)
        self._live: tuple[LiveSet, ...] = (OverlayCommands(parts),)
        self._sets: tuple[CommandSet, ...] = (
            *self._live,
            EditCommands(parts),
            SelectionCommands(parts),
            curves,
            TangentCommands(parts),
            ClipboardCommands(parts),
            self.snap,
            self.view,
            HelpCommands(parts),
            self.lessons,
            RailCommands(parts),
            self.images,
            ToolCommands(parts, self.snap.apply_preferences),
        )
        self.context_menus = ContextMenus(parts, curves)
        for handlers in (self._file_handlers(), *(each.handlers() for each in self._sets)):
            for name, handler in handlers.items():
                parts.actions[name].triggered.connect(lambda _checked=False, handler=handler: handler())

    def _file_handlers(self) -> Handlers:
        files = self._parts.files
        return {
            "newDocument": self._new,
            "openDocument": files.ask_and_open,
            "saveDocument": files.save,
            "saveDocumentAs": files.ask_and_save,
            "exportPicture": files.ask_and_export,
            "quit": self._parts.window.close,
        }

    def _new(self) -> None:
        self._parts.files.new()
        if not self._parts.session.active_curve.nodes:
            self._parts.actions["addTool"].trigger()

    def follow(self, view: CurveView) -> None:
        """Show what follows a drag frame by frame."""
        for each in self._live:
            each.follow(view)

    def render(self, view: CurveView) -> None:
        """Check and enable actions, and show the line on the canvas, as `view` has it."""
        for each in self._sets:
            each.render(view)
        self.messages.render(view)
