"""The history: steps with the values before and after each, and which changes are one step."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from pathlib import Path

import msgspec
import shiboken6
from msgspec.structs import replace
from PySide6.QtCore import QObject
from PySide6.QtGui import QUndoCommand, QUndoStack

from ..document.fields import NO_SCROLL, Scroll
from ..document.model import Document
from ..document.selection import SelectionState
from ..qt.overrides import SafeOverrides

_RUN_SECONDS = 1.0
"""Changes of the same run that follow each other as quickly as this are one step."""


class DocumentOrigin(msgspec.Struct, frozen=True, eq=False):
    """Origin of a document: one more of them each time something is opened, or begun again.

    Attributes
    ----------
    copied
        The file that it is a copy of (a lesson, an example); None for any other.
    title
        What it is called until it is saved; empty for "Untitled".
    before
        The beginning of the document that it was opened in the place of, as a step of the history; None where
        the history begins with it.
    file_stem
        Name for its file without ending; empty for that of a curve.
    is_disposable
        Whether it is the first sketch or an empty document, which may be replaced while unchanged.
    """

    copied: Path | None = None
    title: str = ""
    before: DocumentOrigin | None = None
    file_stem: str = ""
    is_disposable: bool = False


class HistoryState(msgspec.Struct, frozen=True):
    """State of the session in the history: a document, the active curve, and the origin of the document.

    Attributes
    ----------
    selection
        Before a step, all that was selected: undo restores it where curves of it return, or where the curves
        selected since are removed. None after the step.
    scroll
        The visible part of the plane, and that at the other end of a step that has changed it.
    """

    document: Document
    active: int
    origin: DocumentOrigin
    selection: SelectionState | None = None
    scroll: Scroll = NO_SCROLL


class UndoStep(SafeOverrides, QUndoCommand):
    """A step from one state to the next; the values are computed before it is made.

    One that `joins` becomes a part of the step before it. `restore` brings a state back.
    """

    def __init__(
        self,
        restore: Callable[[HistoryState], None],
        before: HistoryState,
        after: HistoryState,
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
        self.setObsolete(self._after == replace(self._before, selection=None))
        return True

    def redo(self) -> None:
        """Bring back the state after the step; called by Qt, also when it is pushed."""
        self._restore(self._after)

    def undo(self) -> None:
        """Bring back the state before the step; called by Qt."""
        self._restore(self._before)


class History:
    """The steps that can be undone and redone.

    A step holds the `HistoryState` before and after it, and undo restores the whole state: nothing is
    computed backwards. Changes of one run, such as quick presses of an arrow key, become one step.

    Parameters
    ----------
    restore
        Brings a state back; called whenever a step is made, undone or redone.

    Attributes
    ----------
    stack
        The steps.
    clock
        Tells the seconds between the changes of a run; tests give their own.
    is_pushing
        Whether a step is being made, not undone or redone.
    """

    def __init__(self, parent: QObject, restore: Callable[[HistoryState], None]) -> None:
        self.stack = QUndoStack(parent)
        self.clock: Callable[[], float] = time.monotonic
        self.is_pushing = False
        self._restore = restore
        # The run that the last step belongs to, and when that was.
        self._run: tuple[Hashable, float] | None = None

    def push(self, before: HistoryState, after: HistoryState, text: str, run: Hashable = None) -> None:
        """Make the step `text`; one that goes on the `run` of the last step becomes a part of it."""
        last_run, time = self._run or (None, 0.0)
        joins = run is not None and last_run == run and self.clock() - time <= _RUN_SECONDS
        steps = self.stack.index()
        self.is_pushing = True
        self.stack.push(UndoStep(self._restore, before, after, text, joins=joins))
        self.is_pushing = False
        # Where the change has taken its run back, the last step is another one.
        is_there = self.stack.index() >= steps
        self._run = (run, self.clock()) if run is not None and is_there else None

    def note_scroll(self, scroll: Scroll) -> None:
        """Record the parts of the plane that undo and redo of the last step return to."""
        step = self.stack.command(self.stack.index() - 1)
        if isinstance(step, UndoStep):
            step._before = replace(step._before, scroll=scroll)
            step._after = replace(step._after, scroll=scroll[::-1])

    def drop(self) -> None:
        """Delete all steps without a word, before the stack goes.

        Where Python's collector takes apart a session and its stack in an unlucky order, the steps go first,
        and the stack deletes them once more (PySide 6.11): the process dies.
        """
        if shiboken6.isValid(self.stack):
            self.stack.blockSignals(True)
            self.stack.clear()

    def end_run(self) -> None:
        """Make the next change a step of its own."""
        self._run = None

    @property
    def state(self) -> HistoryState | None:
        """State after the last step, hence the present one; None where there is no step."""
        index = self.stack.index()
        step = self.stack.command(index - 1 if index else 0) if self.stack.count() else None
        if not isinstance(step, UndoStep):
            return None
        return step._after if index else step._before
