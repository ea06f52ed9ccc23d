"""Rendering of a session in the parts of a window: from values to widgets, never back."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer

from ..document.model import Document
from ..document.steps import reshaped
from ..session import Message, MessageKind
from ..view_model.curve.curve_view import CurveView
from ..workbench.context import WindowContext
from ..workbench.document_files import title_of
from .connect import Commands

_PANELS_MS = 100
"""Lag of the panels behind a drag, in milliseconds; the canvas and the functions have none."""


class Rendering(QObject):
    """Shows what a session has, now and whenever it tells of a change."""

    def __init__(self, context: WindowContext, commands: Commands) -> None:
        super().__init__(context.window)
        self._context, self._commands, self._session = context, commands, context.session
        self._canvas = context.central.canvas
        # What the panels show; behind the session while it tells that what was selected is there no more.
        self._rendered: CurveView | None = None
        # The document that is drawn, and its curve that is edited.
        self._drawn: tuple[Document, int] | None = None
        self._panels_due = QTimer(self, singleShot=True, interval=_PANELS_MS)
        self._panels_due.timeout.connect(self._render_rest)
        self._connect()
        self._render_document()
        self._render_file()
        if self._session.files.path is None and not self._session.files.beginning.title:
            # Who opens a document came to work on it.
            commands.messages.greet()
        if context.preferences.complaint:
            context.status_line.refuse(context.preferences.complaint)

    def _connect(self) -> None:
        session = self._session
        session.document_changed.connect(self._render_document)
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
        if self._rests_but_for_edited():
            self._canvas.drawing.follow(views)
        else:
            self._render_others()
            self._commands.show_document()
            self._commands.wake()
        self._commands.follow(self._rendered)
        if not session.is_previewing:
            self._render_rest()
            return
        if drawn is not None and drawn[1] != session.active_index:
            # The gesture begins another curve, of another family perhaps.
            self._context.actions.follow()
        if not self._panels_due.isActive():
            self._panels_due.start()

    def _rests_but_for_edited(self) -> bool:
        """Whether only points of the curve that is edited are others than are drawn, as under a drag."""
        document, active = self._session.document, self._session.active_index
        drawn, self._drawn = self._drawn, (document, active)
        if drawn is None or drawn[1] != active:
            return False
        return reshaped(drawn[0], document) in ([], [active])

    def _render_rest(self) -> None:
        """Render what need not follow a drag frame by frame, when all is told of which there is news."""
        self._context.actions.follow()
        self._session.batch.then(self._render_panels)

    def _render_panels(self) -> None:
        self._panels_due.stop()
        self._commands.render(self._session.active_view)

    def _render_selection(self, selection: frozenset[int]) -> None:
        self._canvas.drawing.set_selection(selection, self._session.selected.group)
        self._render_commands()

    def _render_others(self) -> None:
        """Draw all curves but the edited one, at the end of a step: it may choose others more than once."""
        self._session.batch.then(self._draw_others)

    def _draw_others(self) -> None:
        session, selected = self._session, self._session.selected
        active = session.active_index if selected.is_editing else None
        self._canvas.drawing.render_others(session.views, active, selected.chosen, selected.edited)

    def _render_selected_curves(self) -> None:
        # What was said was about the curves that were selected before.
        self._context.status_line.clear_message()
        self._render_others()
        self._session.batch.then(self._canvas.hover_again)
        self._render_commands()

    def _render_commands(self) -> None:
        """Check and enable actions; those of a document that the panels do not show yet, together with it."""
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
            # Qt writes the title anew, whatever is there.
            window.setWindowModified(session.files.is_modified)

    def _tell(self, message: Message) -> None:
        line = self._context.status_line
        match message.kind:
            case MessageKind.INFORMATION:
                line.say(message.text)
            case MessageKind.REFUSAL:
                line.refuse(message.text)
            case MessageKind.OFFER:
                self._render_commands()
                line.clear_message()
                actions = [self._context.actions[name] for name in message.actions]
                self._commands.messages.offer(message.text, actions)
