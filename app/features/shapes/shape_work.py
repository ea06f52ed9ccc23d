"""Work on shapes: what is made of the chosen ones, at once or beside the window."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

from ...document.edits import EditError
from ...document.model import Document
from ...document.words import count_of, number
from ...view_model.regions import Combined, named_operands
from ...workbench.context import WindowContext
from .chosen_shapes import meant

_PATIENCE_S = 0.08
"""Seconds of computing that need no thread of their own."""


class _TakesLong(Exception):  # noqa: N818 - nothing has gone wrong
    """A computation is better done beside the window."""


class ShapeWork:
    """Computes what becomes of the chosen shapes, and makes a step of it."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work

    def compute(self, title: str, make: Callable[..., Combined]) -> None:
        """Put what is made of the chosen shapes into the document, at once or when it has been computed."""
        session = self._session
        document, views, curves = session.committed, session.views, meant(session)
        work = partial(make, document, views, curves)
        until = 0.0

        def hurry(_share: float, _word: str) -> None:
            nonlocal until
            # From the first report on: what computes may have to be imported before.
            until = until or time.monotonic() + _PATIENCE_S
            if time.monotonic() > until:
                raise _TakesLong

        what = f"{title} of {named_operands(document, curves)}"
        try:
            self._put(what, document, work(report=hurry))
        except EditError as reason:
            session.refuse(str(reason))
        except _TakesLong:
            self._work.compute(what, lambda report: work(report=report), partial(self._put, what, document))

    def _put(self, what: str, before: Document, made: Combined) -> None:
        """Make what was computed for a document the current one, and choose the outcome."""
        session = self._session
        if session.committed is not before:
            session.refuse(f"{what} was dropped: the drawing was changed meanwhile.")
            return
        if not session.change(what, lambda _: made.document, active=min(made.places)):
            return
        session.selected.choose(made.places)
        told = f"{count_of(made.shapes, 'shape')}, {count_of(len(made.places), 'outline')}"
        within = f"{number(made.deviation, 1)} {session.document.unit}".rstrip()
        followed = f"; followed within {within}" if made.deviation else ""
        session.say(f"{what}: {told}{followed}.")
