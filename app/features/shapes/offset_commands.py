"""Shapes made larger or smaller, by the distance that was typed last or another one."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from ...actions.declaration import action
from ...actions.sections import CURVE_OFFSETS
from ...view_model.shapes.stroke_shapes import offset_by
from ...workbench.context import WindowContext
from .. import shapes
from .chosen_shapes import A_SHAPE, beside_meant
from .shape_work import ShapeWork

if TYPE_CHECKING:
    from .distances import Distance

_USUAL_PX = 2.0
"""The distance before one was typed, at least: pixels of CSS, or of the screen without a unit of length."""


class OffsetCommands:
    """Outset and inset."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas, self._work = context.central.canvas, ShapeWork(context)
        self._made: shapes.field.OffsetField | None = None

    @property
    def field(self) -> shapes.field.OffsetField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            self._made = shapes.field.OffsetField(self._canvas.viewport())
            self._made.entered.connect(self._take)
            self._made.closed.connect(lambda: self._canvas.setFocus(Qt.FocusReason.OtherFocusReason))
            self._session.interrupted.connect(self._made.close_field)
        return self._made

    @action(
        "pathOutset",
        "Outset",
        CURVE_OFFSETS,
        "Ctrl+)",
        "path-outset",
        full_name="Outset Shapes",
        needs=A_SHAPE,
        keywords="offset path grow expand bolder larger",
    )
    def _outset(self) -> None:
        """Make the chosen shapes larger by the distance used last."""
        self._offset(grows=True)

    @action(
        "pathInset",
        "Inset",
        CURVE_OFFSETS,
        "Ctrl+(",
        "path-inset",
        full_name="Inset Shapes",
        needs=A_SHAPE,
        keywords="offset path shrink contract thinner smaller",
    )
    def _inset(self) -> None:
        """Make the chosen shapes smaller by the distance used last."""
        self._offset(grows=False)

    @action(
        "pathOffsetBy",
        "Outset or Inset by…",
        CURVE_OFFSETS,
        "Alt+Shift+O",
        "path-outset",
        full_name="Outset or Inset Shapes by…",
        needs=A_SHAPE,
        keywords="offset path exact distance grow shrink expand contract",
    )
    def _ask(self) -> None:
        """Type how far outlines of chosen shapes move, such as 2 mm; Outset and Inset then do the same."""
        self._canvas.cancel_gesture()
        self.field.open_for(self._last().words, self._session.document.unit, self._corner)

    def _offset(self, *, grows: bool) -> None:
        self._compute(self._last(), grows=grows)

    def _take(self, grows: bool, distance: Distance) -> None:
        self._context.preferences.offset_distance = distance.words
        self._compute(distance, grows=grows)

    def _compute(self, distance: Distance, *, grows: bool) -> None:
        title = "Outset" if grows else "Inset"
        way = distance.value if grows else -distance.value
        self._work.compute(f"{title} by {distance.words}", partial(offset_by, distance=way))

    def _last(self) -> Distance:
        """Return the distance used last; at first, or where the document has no such unit, a clean one."""
        words, pixel_size = self._context.preferences.offset_distance, self._canvas.camera.pixel_size
        return shapes.distances.read_again(words, self._session.document.unit, pixel_size, _USUAL_PX)

    def _corner(self) -> QPoint:
        return beside_meant(self._session, self._canvas)
