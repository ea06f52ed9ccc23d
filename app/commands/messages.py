"""The line on the canvas: what is wrong, what to do first, or a greeting."""

from __future__ import annotations

from PySide6.QtCore import QObject

from app.commands.parts import Parts
from app.view_model.curve_view import CurveView

_GREETING = (
    "Drag a point and watch the basis functions below. "
    "P adds points, 1 2 3 switch the family, F1 shows all keys."
)
_EMPTY = "Click on the canvas to add points; two of them make a curve."


class Messages(QObject):
    """Keeps the line in step with the active curve."""

    def __init__(self, parts: Parts) -> None:
        super().__init__(parts.window)
        self._bar, self._session = parts.message_bar, parts.session
        self._greeting = ""
        self._image_problem = ""
        self._bar.closed.connect(self._forget_image_problem)

    def _forget_image_problem(self) -> None:
        """Say it once: the panel of the image goes on saying it."""
        self._image_problem = ""

    def set_image_problem(self, text: str) -> None:
        """Say what is wrong with the picture to trace, as long as nothing more urgent is; empty: nothing."""
        if text != self._image_problem:
            self._image_problem = text
            self.render(self._session.active_view)

    def greet(self) -> None:
        """Show the hint of the first start, until it is put away or something has been done."""
        self._greeting = _GREETING
        self._bar.closed.connect(self._forget_greeting)
        self._session.opened.connect(self._forget_greeting)
        self._session.history_changed.connect(self._forget_greeting)
        self.render(self._session.active_view)

    def _forget_greeting(self) -> None:
        self._greeting = ""
        self.render(self._session.active_view)

    def render(self, view: CurveView) -> None:
        """Show what `view` needs said."""
        if len(view.points) < 2:
            self._bar.tell(_EMPTY)
        elif view.problem:
            self._bar.warn(view.problem)
        elif self._image_problem:
            self._bar.warn(self._image_problem)
        elif not view.source.visible:
            self._bar.tell(f"“{view.source.name}” is hidden; it is drawn faintly while you edit it.")
        elif self._greeting:
            self._bar.tell(self._greeting)
        else:
            self._bar.hide()
