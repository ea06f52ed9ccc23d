"""Values derived from the facts of actions, computed again only where a fact that they read has changed."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Set
from typing import Any, Generic, TypeVar, cast

import msgspec

from ..state.window_state import WindowState
from .state import ActionState

_Key = TypeVar("_Key", bound=Hashable)
_Value = TypeVar("_Value")

_WINDOW = "window"
"""The fact that has facts of its own: an action that shows the grid does not depend on the tool."""


class DerivedValues(Generic[_Key, _Value]):
    """Values by key, each computed from an `ActionState` and from nothing else."""

    def __init__(self, computes: Mapping[_Key, Callable[[ActionState], _Value]]) -> None:
        self._computes = computes
        # The facts that each has read; none of those that are yet to be computed.
        self._reads: dict[_Key, set[str]] = {}

    def renewed(self, state: ActionState, changed: Set[str]) -> Iterator[tuple[_Key, _Value]]:
        """Yield the values for `state` that read any of the facts `changed`, and those not computed yet."""
        reads = self._reads
        for key in [
            each for each in self._computes if each not in reads or not reads[each].isdisjoint(changed)
        ]:
            read = set[str]()
            value = self._computes[key](cast("ActionState", _Reader(state, read)))
            reads[key] = read
            yield key, value


class _Reader:
    """A record of facts that notes the names of those that are read."""

    def __init__(self, facts: ActionState | WindowState, read: set[str], prefix: str = "") -> None:
        self._facts, self._read_names, self._prefix = facts, read, prefix

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - as the type of the fact
        if name not in self._facts.__struct_fields__:
            # A property or method: the facts that it reads are noted in turn.
            return getattr(type(self._facts), name).__get__(self)
        if name == _WINDOW:
            return _Reader(getattr(self._facts, name), self._read_names, f"{name}.")
        self._read_names.add(self._prefix + name)
        return getattr(self._facts, name)


def changed_facts(before: ActionState, after: ActionState) -> Set[str]:
    """Return the names of facts that differ; those of the window begin with "window."."""
    return _differences(before, after) - {_WINDOW} | {
        f"{_WINDOW}.{name}" for name in _differences(before.window, after.window)
    }


def _differences(before: msgspec.Struct, after: msgspec.Struct) -> set[str]:
    if before is after:
        return set()
    return {name for name in after.__struct_fields__ if getattr(before, name) != getattr(after, name)}
