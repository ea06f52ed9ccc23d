"""Command sets of a window, and the rendering of a session in them: from values to widgets, never back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from ..actions.declaration import Action, all_declared, declared_widgets
from ..actions.menus import BarPosition
from ..appearance.theme import Theme
from ..document.differences import reshaped_curves
from ..document.limits import EditError
from ..document.model import Document
from ..features import command_sets
from ..session import Message, MessageKind
from ..tasks.task import DelayedCall, TaskOwner, close_all
from ..view_model.curve.curve_view import CurveView
from ..widgets.controls import ToolbarWidget
from ..workbench.context import WindowContext, hooks
from ..workbench.docks import declared_panels
from ..workbench.document_files import title_of
from .drops import Drops
from .menus import ContextMenus
from .messages import Messages
from .window_commands import FocusCommands, ProgramCommands

COMMAND_SETS: tuple[type, ...] = (FocusCommands, *command_sets(), ProgramCommands)
"""All command sets, in the order of their actions in menu sections, and of their tabs."""

_Set = TypeVar("_Set")


def all_actions() -> tuple[Action, ...]:
    """Return all actions of a window, in the order of the menus."""
    return tuple(declared.action for declared in all_declared(COMMAND_SETS))


class Commands:
    """Command sets of one window, connected to its actions and hooks.

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
        self._follow, self._render = self._hooks("follow_drag"), self._hooks("render_panel")
        # The hooks that have something to show; others are not called while only points move.
        self._following = self._follow
        self._show_document = self._hooks("show_document")
        self.drops = Drops(context, self._sets.values())
        self.context_menus = ContextMenus(context, self._sets, self.attempt)
        self._had_scrub = False
        context.store.changed.connect(self.wake)
        context.analysis.added.connect(self.wake)
        for dock in context.docks.all:
            dock.visibilityChanged.connect(self.wake)
        for commands in self._sets.values():
            context.actions.bind(commands, self._run)

    def _hooks(self, name: str) -> list[Callable[..., object]]:
        return hooks(self._sets.values(), name)

    def __getitem__(self, kind: type[_Set]) -> _Set:
        commands = self._sets[kind]
        assert isinstance(commands, kind)
        return commands

    def _run(self, action: Action, handler: Callable[[], object], _checked: bool = False) -> None:
        """Run an action, after cancelling a gesture in flight where the action may change the document."""
        if action.interrupts:
            self._context.cancel_gesture()
        if action.field:
            store = self._context.store
            store.change(**{action.field: not getattr(store.state, action.field)})
        self.attempt(handler)
        self._context.actions.show_checked(action.name)
        self.wake()

    def widgets(self) -> dict[BarPosition, ToolbarWidget]:
        """Return the widgets of the toolbar by position."""
        return dict(
            pair for kind, commands in self._sets.items() for pair in declared_widgets(kind, commands)
        )

    def follow_scrub(self, t: float | None) -> None:
        """Update panels, and actions where the scrub line has appeared or disappeared."""
        self.wake()
        if (t is not None) != self._had_scrub:
            self._had_scrub = t is not None
            self._context.actions.render()

    def attempt(self, handler: Callable[[], object]) -> None:
        """Call `handler`, and show the reason of an `EditError` in the status line."""
        try:
            handler()
        except EditError as reason:
            self._context.session.refuse(str(reason))

    def escape(self) -> None:
        """Cancel a gesture, or else return from a panel to the canvas, or else step back."""
        if self._context.cancel_gesture() or self[FocusCommands].back_to_canvas():
            return
        # Later features come first; a hook that returns true has used the key.
        any(escape() for escape in reversed(self._hooks("escape")))

    def build_dock(self, name: str, *parent: QWidget) -> QWidget:
        """Build the panel of a dock, when the window is built or when the dock is first shown."""
        return next(
            build(commands, *parent)
            for kind, commands in self._sets.items()
            for panel, build in declared_panels(kind)
            if panel.name == name
        )

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        for set_theme in self._hooks("set_theme"):
            set_theme(theme)

    def close(self) -> None:
        """End background work, before the window is destroyed."""
        for close in self._hooks("close"):
            close()
        close_all(self._context.window.findChildren(TaskOwner))

    def follow_drag(self, view: CurveView) -> None:
        """Call the hooks `follow_drag`, and remember those that have something to show."""
        asked = self._following
        following = [follow for follow in asked if follow(view)]
        if self._following is asked:
            self._following = following

    def wake(self, *_changed: object) -> None:
        """Call all hooks `follow_drag` again: they may have something to show now."""
        self._following = [*self._follow]

    def show_document(self) -> None:
        """Call the hooks `show_document`."""
        for show in self._show_document:
            show()

    def render_panels(self, view: CurveView) -> None:
        """Call the hooks `render_panel`, and update the message on the canvas."""
        for render in self._render:
            render(view)
        self.messages.render(view)


_PANELS_MS = 100
"""Delay of the panels during a drag, in milliseconds; canvas and basis functions have none."""


class Rendering(QObject):
    """Rendering of a session in the parts of its window, at each change."""

    def __init__(self, context: WindowContext, commands: Commands) -> None:
        super().__init__(context.window)
        self._context, self._commands, self._session = context, commands, context.session
        self._canvas = context.central.canvas
        # The rendered view; behind the session while the session updates its selection.
        self._rendered: CurveView | None = None
        # The drawn document and the index of its active curve.
        self._drawn: tuple[Document, int] | None = None
        self._panels_due = DelayedCall(self, _PANELS_MS, self._render_rest)
        self._connect()
        self._render_document()
        self._render_file()
        if self._session.files.path is None and not self._session.files.origin.title:
            # No greeting for someone who has opened a document.
            commands.messages.greet()
        if context.preferences.complaint:
            context.status_line.refuse(context.preferences.complaint)

    def _connect(self) -> None:
        session = self._session
        session.document_changed.connect(self._render_document)
        session.settled.connect(self._settle)
        session.active_changed.connect(self._render_document)
        session.selection_changed.connect(self._render_selection)
        session.selected_curves_changed.connect(self._render_selected_curves)
        session.hovered_changed.connect(self._canvas.drawing.set_hovered)
        session.scrub_changed.connect(self._render_scrub)
        session.file_changed.connect(self._follow_file)
        session.history_changed.connect(self._follow_file)
        session.message.connect(self._tell)

    def _render_document(self) -> None:
        session, drawn = self._session, self._drawn
        views = session.views
        view, self._rendered = views[session.active_index], session.active_view
        if not session.is_previewing:
            view.settle()
        self._canvas.drawing.render_view(view)
        if self._differs_in_active_points():
            self._canvas.drawing.follow_drag(views)
        else:
            self._render_others()
            self._commands.show_document()
            self._commands.wake()
        self._commands.follow_drag(self._rendered)
        if not session.is_previewing:
            self._render_rest()
            return
        if drawn is not None and drawn[1] != session.active_index:
            # The gesture has begun another curve, which may have another family.
            self._context.actions.follow()
        self._panels_due.start_if_idle()

    def _settle(self) -> None:
        """Render the panels that wait for the end of a drag; the curves are drawn."""
        view = self._session.active_view
        view.settle()
        self._commands.follow_drag(view)
        self._render_rest()

    def _differs_in_active_points(self) -> bool:
        """Return whether only points of the active curve differ from the drawn document, as during a drag."""
        document, active = self._session.document, self._session.active_index
        drawn, self._drawn = self._drawn, (document, active)
        if drawn is None or drawn[1] != active:
            return False
        return reshaped_curves(drawn[0], document) in ([], [active])

    def _render_rest(self) -> None:
        """Render actions and panels at the end of the current batch of changes."""
        self._context.actions.follow()
        self._session.batch.then(self._render_panels)

    def _render_panels(self) -> None:
        self._panels_due.stop()
        self._commands.render_panels(self._session.active_view)

    def _render_selection(self, selection: frozenset[int]) -> None:
        # A message was about the points that were selected before.
        self._context.status_line.clear_earlier()
        self._canvas.drawing.set_selection(selection, self._session.selected.group)
        self._render_commands()

    def _render_others(self) -> None:
        """Draw all curves but the edited one, once at the end of a batch of changes."""
        self._session.batch.then(self._draw_others)

    def _draw_others(self) -> None:
        session, selected = self._session, self._session.selected
        active = session.active_index if selected.is_editing else None
        self._canvas.drawing.render_others(
            session.views, active, selected.whole_curves, selected.active_curves
        )

    def _render_selected_curves(self) -> None:
        # The message was about the previous selection.
        self._context.status_line.clear_message()
        self._render_others()
        self._session.batch.then(self._canvas.hover_again)
        self._render_commands()

    def _render_commands(self) -> None:
        """Render actions and panels, unless the document is about to be rendered anyway."""
        if self._session.batch or self._session.active_view is self._rendered:
            self._render_rest()

    def _render_scrub(self, t: float | None) -> None:
        self._canvas.drawing.set_scrub(t)
        self._context.status_line.readouts.show_scrub(t)
        self._commands.follow_scrub(t)

    def _follow_file(self) -> None:
        self._session.batch.then(self._render_file)

    def _render_file(self) -> None:
        session, window = self._session, self._context.window
        name = title_of(session).replace("[*]", "[*][*]")
        window.setWindowFilePath(str(session.files.path) if session.files.path is not None else "")
        read_only = " (read-only)" if session.files.is_read_only else ""
        window.setWindowTitle(f"{name}[*]{read_only} – Curvebench")
        if window.isWindowModified() != session.files.is_modified:
            # Setting the flag makes Qt write the title again.
            window.setWindowModified(session.files.is_modified)

    def _tell(self, message: Message) -> None:
        line = self._context.status_line
        match message.kind:
            case MessageKind.INFORMATION:
                line.say(message.text, is_hint=message.is_hint)
            case MessageKind.REFUSAL:
                line.refuse(message.text)
            case MessageKind.OFFER:
                self._render_commands()
                line.clear_message()
                actions = [self._context.actions[name] for name in message.actions]
                self._commands.messages.offer(message.text, actions)
