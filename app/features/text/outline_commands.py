"""Texts and forms made into paths."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import TEXT_OUTLINES
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU, CURVE_LIST_MENU
from ...document.content import Lettering
from ...document.model import Document
from ...document.several_curves import changeable, named
from ...document.shapes import shape_of
from ...document.words import count_of
from ...workbench.context import WindowContext
from .. import text


def _has_form(now: Situation) -> bool:
    session = now.session
    forms = (session.document.curves[place].form for place in session.selected.marked)
    return any(form is not None and (not form.is_content or isinstance(form, Lettering)) for form in forms)


class OutlineCommands:
    """Makes outlines of what is more than that."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "objectToPath",
        "Object to Path",
        TEXT_OUTLINES,
        icon="type",
        drawing_key="Ctrl+Shift+C",
        needs=Need("a text, or a shape such as a rectangle", _has_form),
        keywords="text outlines letters convert curves expand create",
    )
    @also(CHOSEN_MENU(54), CURVE_LIST_MENU(24))
    def _make_outlines(self) -> None:
        """Make outlines of the letters of the chosen texts, and plain paths of the chosen shapes."""
        session = self._session
        places = changeable(session.document, session.selected.marked)
        what = named(session.document, places)
        made = frozenset[int]()

        def edit(document: Document) -> Document:
            nonlocal made
            document, made = text.outlined.with_outlines(document, places)
            return document

        if session.change(f"Object to path: {what}", edit, active=None):
            session.selected.choose(made)
            is_one = len({shape_of(session.document, place) for place in made}) == 1
            session.say(f"{what} is {'a path' if is_one else count_of(len(made), 'curve')} now.")
