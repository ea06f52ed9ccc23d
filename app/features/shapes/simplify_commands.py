"""Fewer points for the chosen curves, at once."""

from __future__ import annotations

from functools import partial

from ...actions.declaration import action
from ...actions.sections import CURVE_SHAPES
from ...document.several_curves import changeable, named
from ...document.words import count_of, number
from ...view_model.fitting.simplifying import Simplified, simplified
from ...workbench.computed_step import ComputedStep
from ...workbench.context import WindowContext
from .chosen_shapes import A_SHAPE, meant


class SimplifyCommands:
    """Simplify."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, ComputedStep(context)

    @action(
        "simplify",
        "Simplify",
        CURVE_SHAPES,
        "",
        "fewer-points",
        full_name="Simplify Paths",
        needs=A_SHAPE,
        keywords="less nodes path clean",
    )
    def _simplify(self) -> None:
        """Give the chosen curves fewer points, so near that nobody sees it; corners and lines stay."""
        session = self._session
        document, views = session.committed, session.views
        curves = changeable(document, meant(session))
        what = f"Simplify {named(document, curves)}"
        self._work.begin(what, partial(simplified, document, views, curves), partial(self._put, what))

    def _put(self, what: str, made: Simplified) -> None:
        if self._session.change(what, lambda _: made.document):
            points = f"{count_of(made.before, 'point')} became {made.after}"
            within = f"{number(made.deviation, 2)} {self._session.document.unit}".rstrip()
            self._session.say(f"{points}; nothing moved by more than {within}.")
