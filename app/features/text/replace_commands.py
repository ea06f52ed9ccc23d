"""Words replaced in all texts, or in those that are chosen."""

from __future__ import annotations

from PySide6.QtCore import Qt

from ...actions.declaration import action
from ...actions.needs import Need
from ...actions.sections import TEXT_ALL
from ...actions.situation import Situation
from ...document.content import Lettering
from ...document.contents import texts_at
from ...document.several_curves import changeable
from ...document.words import count_of
from ...workbench.context import WindowContext
from .. import text


def _has_texts(now: Situation) -> bool:
    return any(isinstance(curve.form, Lettering) for curve in now.session.document.curves)


class ReplaceCommands:
    """Asks for words above the canvas, and replaces them."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._made: text.replace_bar.ReplaceBar | None = None

    @action(
        "replaceWords",
        "Replace Words…",
        TEXT_ALL,
        icon="type",
        needs=Need("a text", _has_texts),
        keywords="find search substitute change words letters all texts",
    )
    def _open(self) -> None:
        """Replace words by others in the texts that are chosen, or in all where none are."""
        self._bar.begin()
        self._follow()

    @property
    def _bar(self) -> text.replace_bar.ReplaceBar:
        if self._made is None:
            self._made = bar = text.replace_bar.ReplaceBar(self._context.central.canvas.viewport())
            bar.sought.connect(self._follow)
            bar.asked.connect(self._replace)
            bar.closed.connect(self._close)
            self._session.selected_curves_changed.connect(self._follow)
            self._session.history_changed.connect(self._follow)
        return self._made

    @property
    def _places(self) -> frozenset[int]:
        """The texts that are meant, those that are locked left out."""
        session = self._session
        document = session.committed
        chosen = [*texts_at(document, session.selected.marked)]
        meant = chosen or [*texts_at(document, range(len(document.curves)))]
        return frozenset(place for place in meant if not document.curves[place].locked)

    def _follow(self, *_: object) -> None:
        """Tell how often what is sought is there."""
        bar, session = self._bar, self._session
        if bar.isHidden() or session.is_previewing:
            return
        sought = bar.words.text()
        times, texts = text.replacing.found_in(session.committed, self._places, sought)
        where = "the chosen texts" if texts_at(session.committed, session.selected.marked) else "all texts"
        told = f"Found {count_of(times, 'time')} in {count_of(texts, 'text')}." if times else "Not found."
        bar.tell(told if sought else f"In {where}.", can_be=bool(times))

    def _replace(self, sought: str, by: str) -> None:
        session, places = self._session, self._places
        times, texts = text.replacing.found_in(session.committed, places, sought)
        done = session.change(
            f"Replace “{sought}” by “{by}”",
            lambda document: text.replacing.with_words_replaced(
                document, changeable(document, places), sought, by
            ),
            active=None,
        )
        if done:
            session.say(f"Replaced {count_of(times, 'time')} in {count_of(texts, 'text')}.")

    def _close(self) -> None:
        self._bar.hide()
        self._context.central.canvas.setFocus(Qt.FocusReason.OtherFocusReason)
