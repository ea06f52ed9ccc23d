"""Connects the actions of a window to what they do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from PySide6.QtWidgets import QWidget

from app.commands.chosen_commands import ChosenCommands
from app.commands.clipboard_commands import ClipboardCommands
from app.commands.context_menus import ContextMenus
from app.commands.curve_commands import CurveCommands
from app.commands.disk_commands import DiskCommands
from app.commands.drops import Drops
from app.commands.edit_commands import EditCommands
from app.commands.error_plot import ErrorPlotCommands
from app.commands.exchange_commands import ExchangeCommands
from app.commands.file_work import FileWork
from app.commands.focus_commands import FocusCommands
from app.commands.fresh_hints import FreshHints
from app.commands.help_commands import HelpCommands
from app.commands.hodograph_commands import HodographCommands
from app.commands.image_commands import ImageCommands
from app.commands.joint_commands import JointCommands
from app.commands.laboratory_commands import LaboratoryCommands
from app.commands.lesson_commands import LessonCommands
from app.commands.messages import Messages
from app.commands.motion_commands import MotionCommands
from app.commands.overlay_commands import OverlayCommands
from app.commands.parts import CommandSet, Handlers, LiveSet, Parts
from app.commands.plot_commands import PlotCommands
from app.commands.rail_commands import RailCommands
from app.commands.recovery_commands import RecoveryCommands
from app.commands.selection_commands import SelectionCommands
from app.commands.snap_commands import SnapCommands
from app.commands.tangent_commands import TangentCommands
from app.commands.teaching_commands import TeachingCommands
from app.commands.tool_commands import ToolCommands
from app.commands.view_commands import ViewCommands
from app.commands.wiggle_commands import WiggleCommands
from app.tasks.owner import TaskOwner, close_all
from app.view_model.curve_view import CurveView

_DURING_A_GESTURE = {
    "undo",  # takes the gesture back, and nothing else
    "selectTool", "addTool", "measureTool",
    "moveSelection", "scaleSelection", "rotateSelection",
    "toggleTransformBox", "commandPalette",
}  # fmt: skip
"""Commands of the menus File, Edit and Curve that a gesture in flight may go on beside, or that end it."""


class Commands:
    """All commands of one window."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self.view = ViewCommands(parts)
        self.focus = FocusCommands(parts)
        self.messages = Messages(parts)
        self.hints = FreshHints(parts)
        self.snap = SnapCommands(parts)
        self.images = ImageCommands(parts, self.messages)
        self.recovery = RecoveryCommands(parts)
        self.work = FileWork(parts)
        parts.files.beside = self.work.start
        self.exchange = ExchangeCommands(parts, self.work)
        self.drops = Drops(parts, self.exchange.import_files, self.images.add)
        curves = CurveCommands(parts)
        self.hodograph = HodographCommands(parts)
        self.joints = JointCommands(parts)
        self.laboratory = LaboratoryCommands(parts)
        self.wiggle = WiggleCommands(parts)
        self.tangents = TangentCommands(parts)
        self.motion = MotionCommands(parts, self.work)
        self._teaching = TeachingCommands(parts, self.laboratory.open, self.wiggle.explain_widest)
        self._live: tuple[LiveSet, ...] = (
            OverlayCommands(parts),
            PlotCommands(parts),
            self.hodograph,
            self.laboratory,
            self.wiggle,
            self.motion,
        )
        self.lessons = LessonCommands(parts)
        self._sets: tuple[CommandSet, ...] = (*self._live, *self._other_sets(curves))
        self.context_menus = ContextMenus(parts, curves, self.wiggle.explain_at, self.tangents.straighten_at)
        self._interrupting = {
            spec.name
            for menu in ("File", "Edit", "Curve")
            for spec, _action in parts.actions.of_menu(menu)
            if spec.name not in _DURING_A_GESTURE
        }
        self._connect()

    def _other_sets(self, curves: CurveCommands) -> tuple[CommandSet, ...]:
        parts = self._parts
        return (
            self.joints,
            ErrorPlotCommands(parts, self.laboratory),
            EditCommands(parts),
            SelectionCommands(parts),
            curves,
            ChosenCommands(parts),
            self.tangents,
            ClipboardCommands(parts),
            self.snap,
            self.view,
            self.focus,
            HelpCommands(parts),
            self.lessons,
            RailCommands(parts),
            self.images,
            DiskCommands(parts),
            self.recovery,
            self.work,
            self.exchange,
            ToolCommands(parts, self.snap.apply_preferences),
        )

    def _connect(self) -> None:
        for handlers in (self._file_handlers(), *(each.handlers() for each in self._sets)):
            for name, handler in handlers.items():
                self._parts.actions[name].triggered.connect(partial(self._run, name, handler))

    def _run(self, name: str, handler: Callable[[], object], _checked: bool = False) -> None:
        """Carry out a command; one that could change the document does not find a gesture's preview there."""
        if name in self._interrupting:
            self._parts.cancel_gesture()
        handler()

    def leave_panel(self) -> bool:
        """Take a gesture back, or go to the canvas from a panel; return whether there was either."""
        return self._parts.cancel_gesture() or self.focus.back_to_canvas()

    def _build_analysis(self) -> QWidget:
        from app.panels.analysis_panel import AnalysisPanel  # noqa: PLC0415 - late, as all of them

        return AnalysisPanel(self._parts.analysis, self._parts.actions.__getitem__)

    def _file_handlers(self) -> Handlers:
        files = self._parts.files
        return {
            "newDocument": self._new,
            "openDocument": files.ask_and_open,
            "saveDocument": files.save,
            "saveDocumentAs": files.ask_and_save,
            "quit": self._parts.window.close,
        }

    def _new(self) -> None:
        self._parts.files.new()
        if not self._parts.session.active_curve.nodes:
            self._parts.actions["addTool"].trigger()

    def build_dock(self, name: str) -> QWidget:
        """Return the content of a dock that is shown for the first time."""
        builders: Mapping[str, Callable[[], QWidget]] = {
            "analysisDock": self._build_analysis,
            "hodographDock": self.hodograph.build,
            "jointsDock": self.joints.build,
            "laboratoryDock": self.laboratory.build_panel,
            "lessonsDock": self.lessons.build,
            "wiggleDock": self.wiggle.build_panel,
        }
        return builders[name]()

    def close(self) -> None:
        """Let what runs beside the window end; called before the window goes."""
        self.exchange.close()
        self.recovery.close()
        close_all(self._parts.window.findChildren(TaskOwner))

    def follow(self, view: CurveView) -> None:
        """Show what follows a drag frame by frame."""
        for each in self._live:
            each.follow(view)

    def render(self, view: CurveView) -> None:
        """Check and enable actions, and show the line on the canvas, as `view` has it."""
        for each in self._sets:
            each.render(view)
        self._teaching.render(view)
        self.messages.render(view)
