"""Texts on paths: put there, taken off, and on the other side."""

from __future__ import annotations

from uuid import uuid4

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import TEXT_PATH
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU
from ...document.contents import texts_at
from ...document.several_curves import named
from ...session.session import Session
from ...workbench.context import WindowContext
from .. import text


def _on_paths(session: Session) -> list[int]:
    """Return the places of the texts among what is chosen that lie along paths."""
    texts = texts_at(session.document, session.selected.marked)
    return [place for place, form in texts.items() if form.along is not None]


def _is_with_path(now: Situation) -> bool:
    session = now.session
    return text.along.text_and_path(session.document, session.selected.marked) is not None


_ON_PATH = Need("a text on a path", lambda now: bool(_on_paths(now.session)))


class AlongCommands:
    """Puts texts on paths and takes them off."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "putOnPath",
        "Put on Path",
        TEXT_PATH,
        icon="text-on-path",
        needs=Need("a text and a curve", _is_with_path),
        keywords="text along curve circle bend follow",
    )
    @also(CHOSEN_MENU(56))
    def _put(self) -> None:
        """Let the chosen text run along the chosen curve, which it follows from then on."""
        session = self._session
        found = text.along.text_and_path(session.committed, session.selected.marked)
        if found is None:
            return
        place, path = found
        words, curve = (named(session.committed, {each}) for each in found)
        done = session.change(
            f"Put {words} on path",
            lambda document: text.along.put_on_path(document, place, path, lambda: uuid4().hex),
        )
        if done:
            session.selected.choose({place})
            unseen = text.remarks.of_shown(session.committed.curves[place])
            session.say(f"{words} lies along {curve} and follows it. {unseen}".rstrip())

    @action("removeFromPath", "Remove from Path", TEXT_PATH, needs=_ON_PATH, keywords="text straight along")
    @also(CHOSEN_MENU(57))
    def _remove(self) -> None:
        """Make the chosen texts straight; the curves that they lay along stay."""
        session, places = self._session, _on_paths(self._session)
        session.change(
            f"Remove {named(session.committed, places)} from path",
            lambda document: text.along.removed_from_path(document, places),
        )

    @action("flipSide", "Other Side of Path", TEXT_PATH, needs=_ON_PATH, keywords="text flip inside outside")
    @also(CHOSEN_MENU(58))
    def _flip(self) -> None:
        """Put the chosen texts on the other side of their paths, where they run the other way."""
        session, places = self._session, _on_paths(self._session)
        session.change(
            f"Put {named(session.committed, places)} on the other side",
            lambda document: text.along.flipped(document, places),
        )
