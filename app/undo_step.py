"""A step of the history: the values before and after it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import msgspec
from PySide6.QtGui import QUndoCommand, QUndoStack

from app.document.model import Document
from app.overrides import Guarded


class Beginning(msgspec.Struct, frozen=True, eq=False):
    """Where a document began: one more of them each time something is opened, or begun again.

    Attributes
    ----------
    copied
        The file that it is a copy of (a lesson, an example); None for any other.
    title
        What it is called until it is saved; empty for "Untitled".
    before
        The beginning of the document that it was opened in the place of, as a step of the history; None where
        the history begins with it.
    """

    copied: Path | None = None
    title: str = ""
    before: Beginning | None = None


class State(msgspec.Struct, frozen=True):
    """What undo brings back: a document, which of its curves was edited, and where it began."""

    document: Document
    active: int
    beginning: Beginning


class UndoStep(Guarded, QUndoCommand):
    """A step from one state to the next; the values are computed before it is made.

    One that `joins` becomes a part of the step before it. `restore` brings a state back.
    """

    def __init__(
        self,
        restore: Callable[[State], None],
        before: State,
        after: State,
        text: str,
        *,
        joins: bool = False,
    ) -> None:
        super().__init__(text)
        self._restore, self._before, self._after, self._joins = restore, before, after, joins

    def id(self) -> int:
        """Return a number that all steps share; called by Qt."""
        return 1  # Qt asks only commands of one number whether they can be merged

    def mergeWith(self, other: QUndoCommand) -> bool:  # noqa: N802
        """Take in `other` if it joins; called by Qt."""
        if not isinstance(other, UndoStep) or not other._joins:
            return False
        self._after = other._after
        # There and back again is no step.
        self.setObsolete(self._after == self._before)
        return True

    def redo(self) -> None:
        """Bring back the state after the step; called by Qt, when it is pushed too."""
        self._restore(self._after)

    def undo(self) -> None:
        """Bring back the state before the step; called by Qt."""
        self._restore(self._before)


def state_at_index(stack: QUndoStack) -> State | None:
    """Return what the history says is there now: what its last step led to; None where it is empty."""
    index = stack.index()
    step = stack.command(index - 1 if index else 0) if stack.count() else None
    if not isinstance(step, UndoStep):
        return None
    return step._after if index else step._before
