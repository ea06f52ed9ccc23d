"""What the pen knows of the curves that it draws: neither in the document nor in its history."""

from __future__ import annotations

from . import hints
from .editing_session import EditingSession
from .pointer import Hit

_Key = tuple[int, str]


class PenSession:
    """Curves that are finished, and those that have been drawn since the pen was taken in hand.

    Curves are known by their places and names.
    """

    def __init__(self) -> None:
        self._finished: set[_Key] = set()
        # How many points each had when the pen began to draw it.
        self._drawn: dict[_Key, int] = {}

    def reset(self) -> None:
        """Forget everything; another document is open."""
        self._finished.clear()
        self.begin()

    def begin(self) -> None:
        """Forget which curves are drawn: the pen is taken in hand."""
        self._drawn.clear()

    @property
    def has_drawn(self) -> bool:
        """Whether anything has been drawn since the pen was taken in hand."""
        return bool(self._drawn)

    def is_finished(self, session: EditingSession) -> bool:
        """Whether the person has finished the curve that is edited, so that the next press begins another."""
        return key_of(session) in self._finished and hints.can_finish(session.active_view)

    def goes_on_at(self, hit: Hit, session: EditingSession) -> bool:
        """Whether a click on what is hit goes on with the curve: on either end of one that is not drawn."""
        view = session.active_view
        is_either = hints.is_end(hit, view) or hints.is_beginning(hit, view)
        return is_either and not self.is_drawn(session) and not view.source.locked

    def is_drawn(self, session: EditingSession) -> bool:
        """Whether the pen is drawing the curve that is edited."""
        return (
            session.selected.is_editing and key_of(session) in self._drawn and not self.is_finished(session)
        )

    def finish(self, session: EditingSession) -> None:
        """Take note that the curve that is edited is finished."""
        self._finished.add(key_of(session))

    def draw(self, key: _Key, count: int) -> None:
        """Take note that a curve is drawn, which has had so many points before."""
        if key in self._finished:
            self._drawn.pop(key, None)
        self._finished.discard(key)
        self._drawn.setdefault(key, count)

    def own_points(self, session: EditingSession) -> int:
        """Return how many points at the end of the curve that is edited the pen has drawn."""
        if not self.is_drawn(session) or session.active_view.source.is_closed:
            return 0
        return max(0, len(session.active_view.source.points) - self._drawn[key_of(session)])


def key_of(session: EditingSession) -> tuple[int, str]:
    """Return the place and the name of the curve that is edited."""
    return session.active_index, session.active_view.source.name
