"""A slider that changes the document."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QAbstractSlider

from app.document.model import Document
from app.panels.live_slider import LiveSlider
from app.session import Session
from app.tools.drag_machine import CANCELLED


class SliderEdit(QObject):
    """Changes the document by a slider: live in a drag, which is one step; at once by key, wheel or click.

    Parameters
    ----------
    slider
        The slider, which owns this.
    session
        The document to change.
    edit
        Returns the document for a position of the slider, and the same one where nothing changes.
    name
        Returns the name of the step for a position.

    Signals
    -------
    finished
        A drag has ended, one way or the other: what is, is to be shown.
    """

    finished = Signal()

    def __init__(
        self,
        slider: LiveSlider,
        session: Session,
        edit: Callable[[Document, int], Document],
        name: Callable[[int], str],
    ) -> None:
        super().__init__(slider)
        self._slider, self._session, self._edit, self._name = slider, session, edit, name
        self._is_dropped = False
        slider.actionTriggered.connect(self._act)
        slider.sliderReleased.connect(self._release)
        slider.cancelled.connect(self._cancel)
        session.interrupted.connect(self._forget)

    def _act(self, action: int) -> None:
        session, position = self._session, self._slider.sliderPosition()
        document = self._edit(session.committed, position)
        if action == QAbstractSlider.SliderAction.SliderMove.value and self._slider.isSliderDown():
            if not self._is_dropped:
                session.preview(document)
        else:
            session.commit(document, self._name(position))

    def _release(self) -> None:
        if not self._is_dropped:
            self._session.commit(self._session.document, self._name(self._slider.sliderPosition()))
        self._is_dropped = False
        self.finished.emit()

    def _cancel(self) -> None:
        self._is_dropped = True
        self._session.cancel()
        self._session.say(CANCELLED)

    def _forget(self) -> None:
        """Let go: the document is another one."""
        if self._slider.isSliderDown():
            self._is_dropped = True
            self._slider.abandon()
