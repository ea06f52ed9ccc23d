"""Changes of the document by a form."""

from __future__ import annotations

from collections.abc import Callable

from ..document.model import Document
from ..session import Session
from ..widgets.field_form import FieldForm


class FormEdits:
    """Makes the changes that a form asks for; what is refused stays in the form, which says why."""

    def __init__(self, session: Session, form: FieldForm) -> None:
        self._session, self._form = session, form
        form.edited.connect(self._change)
        form.refused.connect(session.refuse)

    def _change(self, text: str, edit: Callable[[Document, int], Document]) -> None:
        session = self._session
        if refusal := session.change(text, lambda document: edit(document, session.active_index)).refusal:
            self._form.refuse(refusal)
