"""An edit that takes a while: made at once, or beside the window."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

import msgspec
from msgspec.structs import replace

from ..document.edits import EditError
from ..document.model import Document
from ..document.plain import plain
from ..document.shapes import tidy_shapes
from ..tasks.progress import Report, part
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.views_ahead import views_ahead
from .context import WindowContext

_PATIENCE_S = 0.08
"""Seconds of computing that need no thread of their own."""

_COMPUTED = 0.8
"""Share of the work that goes before the views of what was made."""

_Made = TypeVar("_Made", bound=msgspec.Struct)
"""What is made of a document: a value with a `document`."""


class _TakesLong(Exception):  # noqa: N818 - nothing has gone wrong
    """A computation is better done beside the window."""


class ComputedStep:
    """Computes what becomes of the document, and hands it on to be made a step of."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work

    def begin(self, what: str, make: Callable[..., _Made], put: Callable[[_Made], object]) -> None:
        """Give what is made of the document to `put`, at once or when it has been computed.

        While the window goes on, `make` reports, and the views of what it made are computed, too.
        """
        session, document = self._session, self._session.committed
        until = 0.0

        def hurry(_share: float, _word: str) -> None:
            nonlocal until
            # From the first report on: what computes may have to be imported before.
            until = until or time.monotonic() + _PATIENCE_S
            if time.monotonic() > until:
                raise _TakesLong

        def done(found: tuple[_Made, list[CurveView]]) -> None:
            if session.committed is not document:
                session.refuse(f"{what} was dropped: the drawing was changed meanwhile.")
                return
            session.expect(found[1])
            put(found[0])

        try:
            put(make(report=hurry))
        except EditError as reason:
            session.refuse(str(reason))
        except _TakesLong:
            self._work.compute(what, partial(_with_views, make, document), done)


def _with_views(
    make: Callable[..., _Made], before: Document, report: Report
) -> tuple[_Made, list[CurveView]]:
    """Return what is made of a document, and the views of the curves that are new in it."""
    made: Any = make(report=part(report, 0.0, _COMPUTED))
    known, rest = set(map(id, before.curves)), part(report, _COMPUTED, 1.0)
    # As the door of the session leaves it, whose curves the views are to be of.
    after = tidy_shapes(plain(made.document, before), before)
    new = [curve for curve in after.curves if id(curve) not in known]
    return replace(made, document=after), views_ahead(new, lambda share: rest(share, "Computing curves"))
