"""Conditions of actions: the words for the person, and the predicate."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from ..document.selection import NONE_CHOSEN
from .situation import Situation


class Need(msgspec.Struct, frozen=True):
    """Condition under which an action can be used.

    Attributes
    ----------
    words
        What must be there, to follow "needs"; empty where nothing short says it.
    is_met
        Whether it is there.
    why
        What is said where it is missing, as a sentence; empty for the usual one.
    is_so
        Whether it is missing because what is wanted is so already: that is told, and no refusal.
    """

    words: str
    is_met: Callable[[Situation], bool]
    why: Callable[[Situation], str] | None = None
    is_so: bool = False

    def reason(self, now: Situation) -> str:
        """Return what is said where it is missing; empty for the usual sentence."""
        return self.why(now) if self.why is not None else ""


NOTHING = Need("", lambda _now: True)
SOME_CURVE = Need("a curve", lambda now: not now.is_blank)
CHOSEN = Need(
    "a curve that is chosen or edited",
    lambda now: now.session.selected.means_curve,
    why=lambda _now: NONE_CHOSEN,
)

HIGHLIGHTED = Need(
    "a curve or a point",
    lambda now: now.has_highlight,
    why=lambda now: "" if now.is_blank else NONE_CHOSEN,
)
HERMITE_CURVE = Need("a Hermite curve", lambda now: now.has_derivatives)
HERMITE_POINTS = Need(
    "selected points of a Hermite curve",
    lambda now: bool(now.selection) and now.has_derivatives and now.view.is_current,
)
CURVE_THROUGH_TWO = Need("a curve through two points or more", lambda now: now.view.is_current)
CURVE_DRAWN = Need(CURVE_THROUGH_TWO.words, lambda now: now.view.curve is not None)
UNLOCKED_CURVE = Need(
    "a curve through two points or more that is not locked",
    lambda now: now.view.is_current and not now.view.source.locked,
)
SOME_LAYER = Need("a layer that new curves come into", lambda now: bool(now.session.selected.layer))
PAGE = Need("a page", lambda now: now.session.document.page is not None)
TWO_POINTS = Need("two points or more", lambda now: len(now.view.points) > 1)
SECOND_CURVE = Need("a second curve", lambda now: len(now.session.document.curves) > 1)
