"""Shapes combined by the areas they cover: union, difference, intersection, exclusion, division."""

from __future__ import annotations

import time
from functools import partial

from ...actions.declaration import Action, action_for_each, also_for_each
from ...actions.needs import Need
from ...actions.sections import CURVE_PATHS
from ...actions.situation import Situation
from ...actions.strips import CURVE_LIST_MENU, CURVE_MENU
from ...document.edits import EditError
from ...document.model import Document
from ...document.words import count_of, number
from ...view_model.regions import (
    PATH_OPERATIONS,
    Combined,
    PathOperation,
    combined_by,
    named_shapes,
    operands,
)
from ...workbench.context import WindowContext
from .chosen_shapes import meant

_PATIENCE_S = 0.08
"""Seconds of computing that need no thread of their own."""


class _TakesLong(Exception):  # noqa: N818 - nothing has gone wrong
    """A computation is better done beside the window."""


def _enough(operation: PathOperation) -> Need:
    def is_met(now: Situation) -> bool:
        curves = meant(now.session)
        if operation.least < 2:
            return bool(curves) and not now.is_blank
        return len(operands(now.session.document, curves)) >= operation.least

    words = "a shape" if operation.least < 2 else "two chosen shapes or more"
    return Need(words, is_met)


class PathCommands:
    """Boolean operations on the chosen shapes."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work

    @action_for_each(
        PATH_OPERATIONS,
        lambda operation: Action(
            operation.name,
            operation.title,
            CURVE_PATHS,
            operation.key,
            operation.icon,
            tip=operation.tip,
            full_name=f"{operation.title} of Shapes",
            needs=_enough(operation),
            keywords=operation.keywords,
        ),
    )
    @also_for_each(lambda operation: (CURVE_MENU(44), CURVE_LIST_MENU(55)))
    def _combine(self, operation: PathOperation) -> None:
        session = self._session
        document, views, curves = session.committed, session.views, meant(session)
        work = partial(combined_by, operation, document, views, curves)
        until = time.monotonic() + _PATIENCE_S

        def hurry(_share: float, _word: str) -> None:
            if time.monotonic() > until:
                raise _TakesLong

        what = f"{operation.title} of {named_shapes(document, curves)}"
        try:
            self._put(what, document, work(hurry))
        except EditError as reason:
            session.refuse(str(reason))
        except _TakesLong:
            self._work.compute(what, work, partial(self._put, what, document))

    def _put(self, what: str, before: Document, made: Combined) -> None:
        """Make what was computed for a document the current one, and choose the outcome."""
        session = self._session
        if session.committed is not before:
            session.refuse(f"{what} was dropped: the drawing was changed meanwhile.")
            return
        if not session.change(what, lambda _: made.document, active=made.places.start):
            return
        session.selected.choose(made.places)
        told = f"{count_of(made.shapes, 'shape')}, {count_of(len(made.places), 'outline')}"
        followed = f"; followed within {number(made.deviation, 2)}" if made.deviation else ""
        session.say(f"{what}: {told}{followed}.")
