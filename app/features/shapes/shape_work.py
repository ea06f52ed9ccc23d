"""Work on shapes: what is made of the chosen ones, at once or beside the window."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ...document.words import count_of, number
from ...view_model.shapes.regions import Combined, named_operands
from ...workbench.computed_step import ComputedStep
from .chosen_shapes import meant


class ShapeWork(ComputedStep):
    """Computes what becomes of the chosen shapes, and makes a step of it."""

    def compute(self, title: str, make: Callable[..., Combined]) -> None:
        """Put what is made of the chosen shapes into the document, at once or when it has been computed."""
        session = self._session
        document, views, curves = session.committed, session.views, meant(session)
        what = f"{title} of {named_operands(document, curves)}"
        self.begin(what, partial(make, document, views, curves), partial(self._put, what))

    def _put(self, what: str, made: Combined) -> None:
        """Make what was computed the current document, and choose the outcome."""
        session = self._session
        if not session.change(what, lambda _: made.document, active=min(made.places)):
            return
        session.selected.choose(made.places)
        told = f"{count_of(made.shapes, 'shape')}, {count_of(len(made.places), 'outline')}"
        within = f"{number(made.deviation, 1)} {session.document.unit}".rstrip()
        followed = f"; followed within {within}" if made.deviation else ""
        session.say(f"{what}: {told}{followed}.")
