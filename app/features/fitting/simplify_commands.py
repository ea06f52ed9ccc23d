"""Fewer points for the selected curves, at once."""

from __future__ import annotations

import time
from functools import partial

from msgspec.structs import replace

from ...actions.declaration import action
from ...actions.menus import ARRANGE_SHAPES
from ...actions.needs import SOME_CURVE
from ...document.groups import tidy_shapes, whole_shapes
from ...document.limits import EditError
from ...document.model import Document
from ...document.plain_numbers import plain
from ...document.several_curves import changeable, named
from ...document.words import count_of, number
from ...tasks.progress import Report, part
from ...view_model.curve.curve_view import CurveView
from ...view_model.curve.transformed import views_ahead
from ...view_model.fit import Simplified, simplified
from ...workbench.context import WindowContext

_PATIENCE_S = 0.08
"""Seconds that a person may wait for the window; what takes longer has a thread of its own."""

_COMPUTED = 0.8
"""Share of the work that goes before the views of the new curves."""


class _TakesLong(Exception):  # noqa: N818 - nothing has gone wrong
    """The computation is better done beside the window."""


class SimplifyCommands:
    """Simplify: at once, or beside the window where it takes longer than a moment."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work

    @action(
        "simplify",
        "Simplify",
        ARRANGE_SHAPES,
        "",
        "fewer-points",
        full_name="Simplify Paths",
        needs=SOME_CURVE,
        keywords="less nodes path clean",
    )
    def _simplify(self) -> None:
        """Give the chosen curves fewer points, so near that nobody sees it; corners and lines stay."""
        session, until = self._session, 0.0
        document = session.committed
        curves = changeable(document, whole_shapes(document, session.selected.marked))
        what = f"Simplify {named(document, curves)}"
        make = partial(simplified, document, session.views, curves)

        def hurry(_share: float, _word: str) -> None:
            nonlocal until
            # From the first report on: what computes may have to be imported before.
            until = until or time.monotonic() + _PATIENCE_S
            if time.monotonic() > until:
                raise _TakesLong

        def done(found: tuple[Simplified, list[CurveView]]) -> None:
            if session.committed is not document:
                session.refuse(f"{what} was dropped: the drawing was changed meanwhile.")
                return
            session.expect(found[1])
            self._put(what, found[0])

        try:
            self._put(what, make(report=hurry))
        except EditError as reason:
            session.refuse(str(reason))
        except _TakesLong:
            self._work.compute(what, partial(_with_views, make, document), done)

    def _put(self, what: str, made: Simplified) -> None:
        if self._session.change(what, lambda _: made.document):
            points = f"{count_of(made.before, 'point')} became {made.after}"
            within = f"{number(made.deviation, 2)} {self._session.document.unit}".rstrip()
            self._session.say(f"{points}; nothing moved by more than about {within}.")


def _with_views(
    make: partial[Simplified], before: Document, report: Report
) -> tuple[Simplified, list[CurveView]]:
    """Return what is made of a document, and the views of the curves that are new in it."""
    made = make(report=part(report, 0.0, _COMPUTED))
    known, rest = set(map(id, before.curves)), part(report, _COMPUTED, 1.0)
    # As the door of the session leaves it, whose curves the views are to be of.
    after = tidy_shapes(plain(made.document, before), before)
    new = [curve for curve in after.curves if id(curve) not in known]
    return replace(made, document=after), views_ahead(new, lambda share: rest(share, "Computing curves"))
