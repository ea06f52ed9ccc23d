"""Conditions of actions, as words and as a predicate.

The words complete the sentence “Close Curve” needs …: "at least two points". Where that is no good English,
`why` is the whole sentence: "Nothing to undo."
"""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from ..document.selection import NONE_SELECTED
from .state import ActionState


class Need(msgspec.Struct, frozen=True):
    """Condition under which an action can be used.

    With ``TWO_POINTS = Need("at least two points", lambda state: state.point_count > 1)`` an action is
    disabled while the active curve has fewer; its key then says "“Action” needs at least two points."

    Attributes
    ----------
    words
        Noun phrase for the sentence “Action” needs …; empty where only `why` says it.
    is_met
        Whether the condition is met.
    why
        Sentence shown where the condition is not met, or a function that returns it; empty for the usual one.
    is_redundant
        Whether the effect of the action is there already, so that the sentence is no refusal.
    """

    words: str
    is_met: Callable[[ActionState], bool]
    why: Callable[[ActionState], str] | str = ""
    is_redundant: bool = False

    def reason(self, state: ActionState) -> str:
        """Return the sentence shown where the condition is not met; empty for the usual one."""
        return self.why if isinstance(self.why, str) else self.why(state)


NOTHING = Need("", lambda _state: True)
SOME_CURVE = Need("a curve", lambda state: not state.is_blank)
SELECTED_CURVE = Need(
    "a selected curve",
    lambda state: state.has_selected_curve or state.is_blank,
    why=NONE_SELECTED,
)
HIGHLIGHTED = Need(
    "a selected curve or point",
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
CURVE_THROUGH_TWO = Need("a curve with at least two points", lambda state: state.is_current)
CURVE_DRAWN = Need(CURVE_THROUGH_TWO.words, lambda state: state.has_curve)
UNLOCKED_CURVE = Need(
    "an unlocked curve with at least two points",
    lambda state: state.is_current and not state.is_locked,
)
TWO_POINTS = Need("at least two points", lambda state: state.point_count > 1)
SECOND_CURVE = Need("a second curve", lambda state: state.curve_count > 1)
