"""Copies all around the pivot, in a row or in a grid: typed, seen meanwhile, made in one step."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from ...actions.declaration import action
from ...actions.needs import CHOSEN
from ...actions.sections import EDIT_TRANSFORM_AGAIN
from ...document.edits import EditError
from ...document.model import Vector
from ...document.readings import readings_of
from ...document.several_curves import named, whole_curves
from ...view_model.boxes.copies import copied
from ...workbench.context import WindowContext
from .. import transform

if TYPE_CHECKING:
    from ...view_model.boxes.copies import Copies
    from .copies_field import CopiesField, CopiesKind

_MOST_SEEN = 20_000
"""Points of copies that are seen while they are typed; more take too long for every key."""

_BESIDE = 6
"""Pixels between the field and what is copied."""


class CopiesCommands:
    """Asks how many copies there shall be and how far apart, and makes them."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas, self._target = context.central.canvas, context.central.canvas.tools.target
        self._made: CopiesField | None = None
        self._originals = frozenset[int]()
        self._about: Vector = (0.0, 0.0)
        self._corner: Vector = (0.0, 0.0)

    @property
    def field(self) -> CopiesField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            self._made = transform.copies_field.CopiesField(self._canvas.viewport())
            self._made.looked_at.connect(self._look_at)
            self._made.entered.connect(self._make)
            self._made.closed.connect(self._close)
            self._session.interrupted.connect(self._made.close_field)
        return self._made

    @action(
        "copiesAround",
        "Copies Around…",
        EDIT_TRANSFORM_AGAIN,
        "Alt+Shift+C",
        "copies-around",
        needs=CHOSEN,
        keywords="array pattern circular polar radial rotate petals flower row step repeat tile clones",
    )
    def _ask_around(self) -> None:
        """Type how many copies of what is chosen stand about its pivot, or in a row, and how far apart."""
        self._ask(transform.copies_field.CopiesKind.CIRCLE)

    @action(
        "copiesInGrid",
        "Rows and Columns…",
        EDIT_TRANSFORM_AGAIN,
        icon="copies-in-grid",
        full_name="Copies in Rows and Columns…",
        needs=CHOSEN,
        keywords="array grid pattern rectangular tile tiles step repeat matrix clones",
    )
    def _ask_grid(self) -> None:
        """Type how many columns and rows there shall be of what is chosen, and how far apart they are."""
        self._ask(transform.copies_field.CopiesKind.GRID)

    def _ask(self, kind: CopiesKind) -> None:
        self._canvas.cancel_gesture()
        session, target = self._session, self._target
        self._originals = session.selected.highlight(whole_curves=True).curves
        if not any(session.document.curves[place].points for place in self._originals):
            session.refuse(target.refusal_of_keys)
            return
        bounds = target.bounds_of(whole_curves(session.document, self._originals))
        self._about, self._corner = target.pivot or bounds.centre, bounds.high
        document = session.document
        self.field.open_for(bounds.size, document.unit, readings_of(document), self._place, kind)

    def _place(self) -> QPoint:
        return self._canvas.to_pixel(*self._corner) + QPoint(_BESIDE, 0)

    def _look_at(self, copies: Copies | None) -> None:
        session = self._session
        points = sum(len(session.committed.curves[place].points) for place in self._originals)
        if copies is None or copies.total * points > _MOST_SEEN:
            session.cancel()
            return
        try:
            made = copied(session.committed, self._originals, copies, self._about)
        except EditError:
            session.cancel()
            return
        session.preview(made.document)
        session.selected.show_choice(made.places)

    def _make(self, copies: Copies) -> None:
        session = self._session
        try:
            made = copied(session.committed, self._originals, copies, self._about)
        except EditError as reason:
            session.refuse(str(reason))
            return
        text = copies.words(readings_of(session.committed)).format(named(session.committed, self._originals))
        if session.change(text, lambda _: made.document, active=min(made.places)):
            session.selected.choose(made.places)
            session.say(f"{text}; all are chosen.")

    def _close(self) -> None:
        self._session.cancel()
        self._canvas.setFocus(Qt.FocusReason.OtherFocusReason)
