"""Edits by the form of the reference image."""

from __future__ import annotations

from collections.abc import Callable

from app.document.image_edits import place_image, set_image_locked, set_image_opacity
from app.document.model import Document
from app.features.reference_image.panel import STEPS, ImagePanel
from app.session import Session
from app.workbench.slider_gesture import SliderGesture


class ImageController:
    """Turns what is typed and dragged in the form into changes of the reference image."""

    def __init__(self, session: Session, panel: ImagePanel) -> None:
        self._session, self._panel = session, panel
        self._opacity = SliderGesture(
            session,
            panel.opacity,
            lambda document, position: set_image_opacity(document, position / STEPS),
            lambda position: f"Fade image to {position / STEPS:.0%}".replace("%", " %"),
        )
        panel.corner_edited.connect(self._move)
        panel.width_edited.connect(self._scale)
        panel.locked_switched.connect(self._set_locked)
        panel.refused.connect(session.refuse)

    def _move(self, x: float, y: float) -> None:
        self._change("Move image", lambda document: place_image(document, (x, y)))

    def _scale(self, width: float) -> None:
        self._change("Scale image", lambda document: place_image(document, width=width))

    def _set_locked(self, locked: bool) -> None:
        name = "Lock image" if locked else "Unlock image"
        self._change(name, lambda document: set_image_locked(document, locked))

    def _change(self, text: str, edit: Callable[[Document], Document]) -> None:
        change = self._session.change(text, edit)
        if change.refusal:
            self._panel.refuse(change.refusal)
