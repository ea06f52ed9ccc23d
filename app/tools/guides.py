"""Drag guides: out of a ruler, over the drawing, back to the ruler; each drag to its undo step."""

from __future__ import annotations

import math

from msgspec.structs import replace

from ..document.model import Axis, Document, Guide, Vector
from ..document.plane_edits import guide_label, move_guide, remove_guide
from .marks import Marks
from .pointer import Cursor, Hint, Pointer
from .snapping import Snapper
from .tool import Drag, ToolEvent

CURSORS = {0: Cursor.WIDER, 1: Cursor.HIGHER}
"""Shape of the pointer over a guide that holds x, or y."""


def press_on_guide(event: ToolEvent, index: int) -> MoveGuide:
    """Start to drag a guide of the document."""
    return _drag(event, event.session.document, index)


def press_on_ruler(event: ToolEvent, axis: Axis) -> MoveGuide:
    """Start to drag a new guide out of the ruler."""
    document = event.session.document
    # The position in this document is displayed nowhere: over the ruler there is no guide.
    drawn = replace(document, guides=(*document.guides, Guide(axis, 0.0)))
    drag = _drag(event, drawn, len(document.guides))
    drag.is_new = True
    return drag


def _drag(event: ToolEvent, document: Document, index: int) -> MoveGuide:
    snapper, unit = event.snapping.for_guide(), event.session.document.unit
    return MoveGuide(document=document, index=index, snapper=snapper, unit=unit)


class MoveGuide(Drag, kw_only=True):
    """Drag of a guide; over the ruler there is none.

    Attributes
    ----------
    document
        The document at the press, with the guide.
    index
        The guide in it.
    is_new
        Whether it is drawn out of a ruler.
    """

    scrolls_view = False
    index: int
    snapper: Snapper
    unit: str
    is_new: bool = False

    keys = "Back to the ruler: remove it"

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the guide at the pointer, or without it over a ruler."""
        if _is_beyond(pointer):
            return remove_guide(self.document, self.index)
        return move_guide(self.document, self.index, self._guide_at(pointer).position)

    def _guide_at(self, pointer: Pointer) -> Guide:
        guide = self.document.guides[self.index]
        axis = guide.axis.coordinate
        position = self.snapper.snap(pointer.position, pointer, axis)[axis]
        is_snapped = self.snapper.caught is not None
        return replace(guide, position=position if is_snapped else _rounded(position, pointer.scale))

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Move guide to x = 20", or that it is added or removed."""
        if _is_beyond(pointer):
            return f"Remove guide at {guide_label(self.document.guides[self.index])}"
        where = guide_label(self._guide_at(pointer))
        return f"{'Guide at' if self.is_new else 'Move guide to'} {where}"

    def amount(self, pointer: Pointer) -> str:
        """Return the label of the guide."""
        if _is_beyond(pointer):
            return "Drag onto the drawing to add a guide" if self.is_new else "Release to remove the guide"
        return f"Guide {guide_label(self._guide_at(pointer), self.unit)}"

    def position_at(self, pointer: Pointer) -> Vector | None:
        """Return the position on the guide beside the pointer."""
        return self._guide_at(pointer).nearest_position(pointer.position)

    def marks(self, event: ToolEvent) -> Marks:
        """Return the guide, and its snap."""
        return replace(super().marks(event), guide=self.index)


def _rounded(value: float, pixels_per_unit: float) -> float:
    """Return a coordinate within a pixel that has no more decimals than that takes."""
    return round(value, -math.floor(-math.log10(pixels_per_unit))) + 0.0


def _is_beyond(pointer: Pointer) -> bool:
    """Return whether the pointer is over a ruler, or farther out there."""
    return pointer.pixel[0] < 0 or pointer.pixel[1] < 0


# What a press would do


def hint_on_guide(event: ToolEvent, index: int) -> Hint:
    """Return the hint over a guide."""
    guide = event.session.document.guides[index]
    words = guide_label(guide, event.session.document.unit)
    text = f"Guide {words} · Drag: move it, back to the ruler: remove it · Double-click: type its position"
    return Hint(text, grab=True, cursor=CURSORS[guide.axis.coordinate])


def hint_on_ruler(axis: Axis) -> Hint:
    """Return the hint over the ruler out of which guides of an axis are drawn."""
    text = "Drag onto the drawing to add a guide · Double-click: type its position"
    return Hint(text, grab=True, cursor=CURSORS[axis.coordinate])
