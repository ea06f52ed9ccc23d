"""The command sets of a window: made, and connected to the actions that they declare."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from PySide6.QtWidgets import QWidget

from ..actions.declaration import Action, all_declared, declared_widgets
from ..actions.menus import BarPosition
from ..appearance.theme import Theme
from ..document.edits import EditError
from ..features import command_sets
from ..tasks.owner import TaskOwner, close_all
from ..view_model.curve.curve_view import CurveView
from ..widgets.controls import ToolbarWidget
from ..workbench.context import WindowContext, hooks
from ..workbench.docks import declared_panels
from .context_menus import ContextMenus
from .drops import Drops
from .focus_commands import FocusCommands
from .messages import Messages
from .program_commands import ProgramCommands

COMMAND_SETS: tuple[type, ...] = (FocusCommands, *command_sets(), ProgramCommands)
"""All command sets. Actions in a section of a menu, and tabs, stand in the order of their sets here."""

_Set = TypeVar("_Set")


def all_actions() -> tuple[Action, ...]:
    """Return all actions of a window, in the order of the menus."""
    return tuple(each.action for each in all_declared(COMMAND_SETS))


class Commands:
    """All commands of one window.

    Attributes
    ----------
    messages
        The line on the canvas.
    drops
        What becomes of files that are dropped on the window.
    """

    def __init__(self, context: WindowContext, command_sets: Sequence[type]) -> None:
        self._context = context
        self.messages = Messages(context)
        context.connect_plot(context.central.canvas)
        self._sets = {kind: kind(context) for kind in command_sets}
        context.central.fill(self._sets)
        self._follow, self._render = self._hooks("follow"), self._hooks("render")
        # Those that have something to show; all others are not asked while only points move.
        self._following = self._follow
        self._show_document = self._hooks("show_document")
        self.drops = Drops(context, self._sets.values())
        self.context_menus = ContextMenus(context, self._sets, self.attempt)
        self._had_scrub = False
        context.store.changed.connect(self.wake)
        context.analysis.added.connect(self.wake)
        for dock in context.docks.all:
            dock.visibilityChanged.connect(self.wake)
        for each in self._sets.values():
            context.actions.bind(each, self._run)

    def _hooks(self, name: str) -> list[Callable[..., object]]:
        return hooks(self._sets.values(), name)

    def __getitem__(self, kind: type[_Set]) -> _Set:
        commands = self._sets[kind]
        assert isinstance(commands, kind)
        return commands

    def _run(self, action: Action, handler: Callable[[], object], _checked: bool = False) -> None:
        """Carry out an action; one that could change the document does not find a gesture's preview there."""
        if action.interrupts:
            self._context.cancel_gesture()
        if action.field:
            store = self._context.store
            store.change(**{action.field: not getattr(store.state, action.field)})
        self.attempt(handler)
        self._context.actions.take_back_click(action.name)
        self.wake()

    def widgets(self) -> dict[BarPosition, ToolbarWidget]:
        """Return what stands in the toolbar besides actions."""
        return dict(pair for kind, each in self._sets.items() for pair in declared_widgets(kind, each))

    def follow_scrub(self, t: float | None) -> None:
        """Show whether there is a scrub line; where it stands is no matter of actions."""
        self.wake()
        if (t is not None) != self._had_scrub:
            self._had_scrub = t is not None
            self._context.actions.render()

    def attempt(self, handler: Callable[[], object]) -> None:
        """Do something; where it is refused, say why."""
        try:
            handler()
        except EditError as reason:
            self._context.session.refuse(str(reason))

    def escape(self) -> None:
        """Take a gesture back, or go to the canvas from a panel, or else step back."""
        if self._context.cancel_gesture() or self[FocusCommands].back_to_canvas():
            return
        # Those of features that stand further down come first; one that returns true has taken the key.
        any(escape() for escape in reversed(self._hooks("escape")))

    def build_dock(self, name: str, *parent: QWidget) -> QWidget:
        """Return what stands in a dock; called when the window is built, or when it is first shown."""
        return next(
            build(commands, *parent)
            for kind, commands in self._sets.items()
            for panel, build in declared_panels(kind)
            if panel.name == name
        )

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        for set_theme in self._hooks("set_theme"):
            set_theme(theme)

    def close(self) -> None:
        """Let what runs beside the window end; called before the window goes."""
        for close in self._hooks("close"):
            close()
        close_all(self._context.window.findChildren(TaskOwner))

    def follow(self, view: CurveView) -> None:
        """Show what follows a drag frame by frame."""
        asked = self._following
        following = [follow for follow in asked if follow(view)]
        if self._following is asked:
            self._following = following

    def wake(self, *_changed: object) -> None:
        """Ask all again who show what follows a drag: they may have something to show by now."""
        self._following = [*self._follow]

    def show_document(self) -> None:
        """Show what a document has beside its curves."""
        for show in self._show_document:
            show()

    def render(self, view: CurveView) -> None:
        """Show in panels, and in the line on the canvas, what there is with `view`."""
        for render in self._render:
            render(view)
        self.messages.render(view)
