"""Shapes combined by the areas they cover: union, difference, intersection, exclusion, division."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import partial

from ... import exchange
from ...actions.declaration import Action, action, action_for_each, also_for_each
from ...actions.needs import Need
from ...actions.sections import CURVE_OFFSETS, CURVE_PATHS
from ...actions.strips import CURVE_LIST_MENU, CURVE_MENU
from ...document.edits import EditError
from ...document.model import Document
from ...document.shapes import is_of_several
from ...document.transforms import clean_step
from ...document.words import count_of, number
from ...view_model.regions import (
    PATH_OPERATIONS,
    Combined,
    PathOperation,
    combined_by,
    named_operands,
)
from ...view_model.stroke_shapes import offset_by, strokes_as_shapes
from ...workbench.context import WindowContext
from .chosen_shapes import meant

_PATIENCE_S = 0.08
"""Seconds of computing that need no thread of their own."""

_STEP_PX = 2.0
"""By how much shapes grow or shrink: in pixels of CSS, or of the screen without a unit of length."""

_A_SHAPE = Need("a shape", lambda now: bool(meant(now.session)) and not now.is_blank)


class _TakesLong(Exception):  # noqa: N818 - nothing has gone wrong
    """A computation is better done beside the window."""


def _enough(operation: PathOperation) -> Need:
    if operation.least < 2:
        return _A_SHAPE
    return Need(
        "two chosen shapes or more",
        lambda now: is_of_several(now.session.document, meant(now.session)),
    )


class PathCommands:
    """Boolean operations on the chosen shapes."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work
        self._canvas = context.central.canvas

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
        self._compute(operation.title, partial(combined_by, operation))

    @action(
        "pathOutset",
        "Outset",
        CURVE_OFFSETS,
        "Ctrl+)",
        "path-outset",
        full_name="Outset Shapes",
        needs=_A_SHAPE,
        keywords="offset path grow expand bolder larger",
    )
    def _outset(self) -> None:
        """Make the chosen shapes larger by 2 px, in the unit of the document."""
        self._offset("Outset", 1.0)

    @action(
        "pathInset",
        "Inset",
        CURVE_OFFSETS,
        "Ctrl+(",
        "path-inset",
        full_name="Inset Shapes",
        needs=_A_SHAPE,
        keywords="offset path shrink contract thinner smaller",
    )
    def _inset(self) -> None:
        """Make the chosen shapes smaller by 2 px, in the unit of the document."""
        self._offset("Inset", -1.0)

    @action(
        "strokeToPath",
        "Stroke to Path",
        CURVE_OFFSETS,
        "Ctrl+Shift+O",
        "stroke-to-path",
        full_name="Strokes to Paths",
        needs=_A_SHAPE,
        keywords="outline stroke expand line to shape object",
    )
    def _outline_strokes(self) -> None:
        """Make shapes of the lines of the chosen shapes, with their corners and ends."""
        self._compute("Stroke to path", strokes_as_shapes)

    def _offset(self, title: str, way: float) -> None:
        unit = self._session.document.unit
        pixel = exchange.rescaled.factor_between("px", unit) if exchange.units.known_unit(unit) else 0.0
        step = _STEP_PX * pixel or clean_step(_STEP_PX * self._canvas.camera.pixel_size)
        self._compute(f"{title} by {number(step, 3)}", partial(offset_by, distance=way * step))

    def _compute(self, title: str, make: Callable[..., Combined]) -> None:
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
        followed = f"; followed within {number(made.deviation, 2)}" if made.deviation else ""
        session.say(f"{what}: {told}{followed}.")
