"""Changes of the document by a form, live by its sliders."""

from __future__ import annotations

from collections.abc import Callable

from ..document.model import Document
from ..session import Session
from ..tools.tool import CANCELLED
from ..widgets.fields import FieldForm
from ..widgets.sliders import LiveSlider


class FormEdits:
    """Edits of a form; a refused input stays in the form, with the reason."""

    def __init__(self, session: Session, form: FieldForm) -> None:
        self._session, self._form = session, form
        form.edited.connect(self._change)
        form.refused.connect(session.refuse)

    def _change(self, text: str, edit: Callable[[Document, int], Document]) -> None:
        session = self._session
        if refusal := session.change(text, lambda document: edit(document, session.active_index)).refusal:
            self._form.refuse(refusal)


class SliderGesture:
    """Edits by a slider: a live preview in a drag, which is one step; one step for key, wheel or click.

    Parameters
    ----------
    edit
        Returns the document for a position of the slider, and the same one where nothing changes.
    name
        Returns the name of the step for a position.
    """

    def __init__(
        self,
        session: Session,
        slider: LiveSlider,
        edit: Callable[[Document, int], Document],
        name: Callable[[int], str],
    ) -> None:
        self._session, self._slider, self._edit, self._name = session, slider, edit, name
        slider.dragged.connect(self._preview)
        slider.dropped.connect(self._commit)
        slider.chosen.connect(self._change)
        slider.cancelled.connect(self._cancel)
        session.gesture_ended.connect(slider.abandon)

    def _preview(self, position: int) -> None:
        self._session.preview(self._edit(self._session.committed, position))

    def _commit(self, position: int) -> None:
        self._session.commit(self._session.document, self._name(position))

    def _change(self, position: int) -> None:
        self._session.change(self._name(position), lambda document: self._edit(document, position))

    def _cancel(self) -> None:
        self._session.cancel()
        self._session.say(CANCELLED)


def cancel_preview(session: Session) -> None:
    """Cancel the preview of a value, if there is one."""
    if session.is_previewing:
        session.cancel()
        session.say(CANCELLED)
