"""Conditions of actions: the words for the person, and the predicate."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from ..document.selection import NONE_SELECTED
from .state import ActionState


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
    is_met: Callable[[ActionState], bool]
    why: Callable[[ActionState], str] | None = None
    is_so: bool = False

    def reason(self, state: ActionState) -> str:
        """Return what is said where it is missing; empty for the usual sentence."""
        return self.why(state) if self.why is not None else ""


NOTHING = Need("", lambda _state: True)
SOME_CURVE = Need("a curve", lambda state: not state.is_blank)
CHOSEN = Need(
    "a curve that is chosen or edited",
    lambda state: state.has_selected_curve or state.is_blank,
    why=lambda _state: NONE_SELECTED,
)
HIGHLIGHTED = Need(
    "a curve or a point",
    lambda state: state.has_selected_curve and not state.is_blank,
    why=lambda state: "" if state.is_blank else NONE_SELECTED,
)
CURVE_WITH_POINTS = Need(
    "a curve with points",
    lambda state: state.has_selected_curve and (state.point_count > 0 or state.selected_curve_count > 1),
    why=lambda state: "" if state.has_selected_curve else NONE_SELECTED,
)
HERMITE_CURVE = Need("a Hermite curve", lambda state: state.has_derivatives)
HERMITE_POINTS = Need(
    "selected points of a Hermite curve",
    lambda state: state.selected_count > 0 and state.has_derivatives and state.is_current,
)
CURVE_THROUGH_TWO = Need("a curve through two points or more", lambda state: state.is_current)
CURVE_DRAWN = Need(CURVE_THROUGH_TWO.words, lambda state: state.has_curve)
UNLOCKED_CURVE = Need(
    "a curve through two points or more that is not locked",
    lambda state: state.is_current and not state.is_locked,
)
TWO_POINTS = Need("two points or more", lambda state: state.point_count > 1)
SECOND_CURVE = Need("a second curve", lambda state: state.curve_count > 1)
