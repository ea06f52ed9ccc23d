"""Texts put into frames that their words fill, and made lines again."""

from __future__ import annotations

from collections.abc import Callable, Collection
from functools import partial

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import TEXT_FRAME
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU
from ...document.content import Inner
from ...document.contents import texts_at
from ...document.forms import Rectangle
from ...document.model import Curve, Document
from ...document.several_curves import changeable, named
from ...document.wrapping import words_about_room
from ...session.session import Session
from ...workbench.context import WindowContext
from .. import text


def _texts(session: Session, *, flowing: bool) -> list[int]:
    """Return the places of chosen texts that fill a frame, or do not."""
    texts = texts_at(session.document, session.selected.marked)
    return [at for at, form in texts.items() if form.along is None and (form.flow is not None) == flowing]


def _has(now: Situation, *, flowing: bool) -> bool:
    return bool(_texts(now.session, flowing=flowing))


def _box_chosen(session: Session) -> Inner | None:
    """Return the box of the only rectangle that is chosen; None without one."""
    curves = [session.document.curves[place] for place in session.selected.marked]
    found = [curve for curve in curves if isinstance(curve.form, Rectangle)]
    if len(found) != 1:
        return None
    across, up = zip(*(point.position for point in found[0].points), strict=True)
    return min(across), min(up), max(across), max(up)


class FlowCommands:
    """Lets words fill frames."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._told = context.session, ""
        self._session.selected_curves_changed.connect(self._tell)
        self._session.history_changed.connect(self._tell)

    def _tell(self) -> None:
        """Say how many words of the text that is chosen do not fit, when it is another number."""
        session = self._session
        if session.is_previewing:
            return
        texts = list(texts_at(session.document, session.selected.marked).values())
        before, self._told = self._told, words_about_room(texts[0]) if len(texts) == 1 else ""
        if self._told and self._told != before:
            session.say_besides(self._told)

    @action(
        "flowIntoFrame",
        "Flow into Frame",
        TEXT_FRAME,
        icon="type",
        needs=Need("a text in lines", partial(_has, flowing=False)),
        keywords="wrap text box flow frame paragraph column width area",
    )
    @also(CHOSEN_MENU(55))
    def _flow(self) -> None:
        """Wrap the words of the chosen texts in a frame: a chosen rectangle, or one around their lines."""
        session = self._session
        places = changeable(session.document, _texts(session, flowing=False))
        box = _box_chosen(session) if len(places) == 1 else None
        flow = text.flowing.in_frame if box is None else partial(text.flowing.in_frame_of, box=box)
        self._make(places, "Flow into frame", flow)

    @action(
        "unflowText",
        "Unflow to Lines",
        TEXT_FRAME,
        icon="type",
        needs=Need("a text in a frame", partial(_has, flowing=True)),
        keywords="unwrap text box lines release",
    )
    @also(CHOSEN_MENU(56))
    def _unflow(self) -> None:
        """Keep the lines of the chosen texts as they are, without a frame that the words fill."""
        session = self._session
        places = changeable(session.document, _texts(session, flowing=True))
        self._make(places, "Unflow to lines", text.flowing.in_lines)

    def _make(self, places: Collection[int], words: str, change: Callable[[Curve], Curve]) -> None:
        def edit(document: Document) -> Document:
            for place in places:
                document = document.with_curve(place, change(document.curves[place]))
            return document

        session = self._session
        session.change(f"{words}: {named(session.document, places)}", edit, active=None)
