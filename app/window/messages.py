"""Message on the canvas: a problem with its remedy, an offer, a first step, or a greeting."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from ..actions.keymap import key_or_name
from ..state.window_state import WindowState
from ..tools.tool import TOOLS
from ..view_model.curve.curve_view import CurveView
from ..workbench.context import WindowContext

_GREETING = "Drag a point and watch its basis functions below. {} adds points, {} shows all keys."
_EMPTY = "Press P, then click on the canvas to add points. Two points make a curve."
_BEGINNINGS = frozenset(tool.empty_message or _EMPTY for tool in TOOLS)


class Messages(QObject):
    """Messages of the bar on the canvas, in step with the active curve.

    A sentence that was dismissed stays away as long as there is nothing else to say.
    """

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._bar, self._session = context.central.message_bar, context.session
        self._use_uniform, self._find_image = context.actions["useUniform"], context.actions["findImage"]
        self._first_actions = context.actions["addTool"], context.actions["showShortcuts"]
        self._store = context.store
        self._store.changed.connect(self._show_state)
        self._greeting = ""
        self._image_problem = self._store.state.image_problem
        self._dismissed = ""
        self._offered: tuple[str, Sequence[QAction]] | None = None
        self._bar.closed.connect(self._dismiss)
        self._session.gesture_ended.connect(self._reset_offer)
        self._work = context.work
        self._work.jobs.begun.connect(self._forget_remarks)
        self._session.opened.connect(self._begin_anew)
        self._session.history_changed.connect(self._reset_greeting)

    def _dismiss(self, text: str) -> None:
        """Remember a dismissed message."""
        self._dismissed = text
        if text == self._image_problem:
            self._image_problem = ""
        if text == self._greeting:
            self._greeting = ""
        if self._offered is not None and text == self._offered[0]:
            self._offered = None

    def _forget_remarks(self) -> None:
        # Those about files that are read one after the other stay.
        if self._work.is_writing:
            self.render(self._session.active_view)

    def _reset_offer(self) -> None:
        # The next message comes from the new document.
        self._offered = None

    def _begin_anew(self) -> None:
        self._dismissed = self._greeting = ""
        self._image_problem = self._store.state.image_problem
        self.render(self._session.active_view)

    def offer(self, text: str, actions: Sequence[QAction]) -> None:
        """Show a message with a button for each action, until another document is opened.

        Without a text, the message is removed.
        """
        self._offered, self._dismissed = (text, actions) if text else None, ""
        self.render(self._session.active_view)

    def greet(self) -> None:
        """Show the hint of the first start, until it is dismissed or something has been done."""
        self._greeting = _GREETING.format(*map(key_or_name, self._first_actions))
        self.render(self._session.active_view)

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.image_problem != before.image_problem:
            self._image_problem = after.image_problem
            self.render(self._session.active_view)
        elif after.uses(after.tool) != before.uses(before.tool) or after.tool is not before.tool:
            self.render(self._session.active_view)

    def _reset_greeting(self) -> None:
        if self._greeting:
            self._greeting = ""
            self.render(self._session.active_view)

    def render(self, view: CurveView) -> None:
        """Show the most urgent message about `view`."""
        text, warns = self._sentence(view)
        if text != self._dismissed:
            self._dismissed = ""
        if not text or text == self._dismissed:
            self._bar.hide()
        elif warns:
            self._bar.warn(text, self._remedy(view, text))
        else:
            offered, actions = self._offered or ("", ())
            self._bar.tell(text, actions if text == offered else ())

    def _remedy(self, view: CurveView, text: str) -> QAction | None:
        """Return the action that solves a problem; None where there is none."""
        if text == self._image_problem:
            return self._find_image
        kind = view.source.parametrization.kind
        # Uniform parameters help where points coincide.
        by_distance = kind.depends_on_points and not (view.source.family.is_missing or view.is_overdue)
        return self._use_uniform if by_distance and text == view.problem else None

    def _before_a_curve(self, view: CurveView) -> tuple[str, bool]:
        """Return the message while there is no curve, and whether it is a warning."""
        if len(view.points):
            # After the first point the status line has the hint; a bar would cover the drawing.
            return "", False
        if self._image_problem:
            return self._image_problem, True
        if self._dismissed in _BEGINNINGS:
            # A message dismissed with one tool stays dismissed with another.
            return self._dismissed, False
        state = self._store.state
        return (state.uses(state.tool) and state.tool.empty_message) or _EMPTY, False

    def _sentence(self, view: CurveView) -> tuple[str, bool]:
        """Return the most urgent message, empty for none, and whether it is a warning."""
        has_curve = len(view.points) >= 2
        if has_curve and view.problem:
            return view.problem, True
        if self._offered is not None:
            return self._offered[0], False
        if not has_curve:
            return self._before_a_curve(view)
        if self._image_problem:
            return self._image_problem, True
        if view.source.visible or not self._session.selected.is_editing:
            return self._greeting, False
        return f"“{view.source.display_name}” is hidden. It is drawn faintly while you edit it.", False
