"""Guides: drawn out of a ruler, dragged, dragged back."""

from __future__ import annotations

import math

from msgspec.structs import replace

from ..document.model import Axis, Document, Guide, Vector
from ..document.plane_edits import guide_label, move_guide, remove_guide
from .drag import Drag
from .marks import Marks
from .pointer import Cursor, Hint, Hit, Part, Pointer
from .snapping import Snapper
from .tool import Tool, ToolEvent

CURSORS = {0: Cursor.WIDER, 1: Cursor.HIGHER}
"""Shape of the pointer over a guide that holds x, or y."""


class MoveGuide(Drag, frozen=True):
    """Drag of a guide, at the press the last of a document or at some place in it; beyond the rulers it goes.

    Attributes
    ----------
    document
        The document at the press, with the guide.
    place
        Its place there.
    is_new
        Whether it is drawn out of a ruler.
    """

    place: int
    snapper: Snapper
    unit: str
    is_new: bool = False

    name = "Guide"
    scrolls = False
    keys = "Back to the ruler: no guide"

    def name_at(self, pointer: Pointer) -> str:
        """Return the name of the step: where the guide is, or that it is gone."""
        if _is_beyond(pointer):
            return f"Remove guide at {guide_label(self.document.guides[self.place])}"
        where = guide_label(self._guide_at(pointer))
        return f"{'Guide at' if self.is_new else 'Move guide to'} {where}"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the guide be where the pointer is, or be none over a ruler."""
        if _is_beyond(pointer):
            return remove_guide(self.document, self.place)
        return move_guide(self.document, self.place, self._guide_at(pointer).position)

    def _guide_at(self, pointer: Pointer) -> Guide:
        guide = self.document.guides[self.place]
        index = guide.axis.coordinate
        caught = self.snapper.snap(pointer.position, pointer, index)[index]
        is_snapped = self.snapper.caught is not None
        return replace(guide, position=caught if is_snapped else _clean(caught, pointer.scale))

    def readout(self, pointer: Pointer) -> str:
        """Return where the guide is."""
        if _is_beyond(pointer):
            return "Drag onto the drawing for a guide" if self.is_new else "Let go to remove the guide"
        return f"Guide {guide_label(self._guide_at(pointer), self.unit)}"

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return the place on the guide beside the pointer."""
        return self._guide_at(pointer).nearest_position(pointer.position)


def _clean(value: float, pixels_per_unit: float) -> float:
    """Return a coordinate within a pixel that has no more decimals than that takes."""
    return round(value, -math.floor(-math.log10(pixels_per_unit))) + 0.0


def _is_beyond(pointer: Pointer) -> bool:
    """Whether the pointer is over a ruler, or farther out there."""
    return pointer.pixel[0] < 0 or pointer.pixel[1] < 0


class GuidePicker:
    """The guide under the pointer, for a tool that finds guides.

    Attributes
    ----------
    lit
        Its place in the document, None for none.
    """

    def __init__(self) -> None:
        self.lit: int | None = None

    def hover(self, hit: Hit | None) -> None:
        """Take note of what lies under the pointer."""
        self.lit = hit.index if hit is not None and hit.part is Part.GUIDE else None

    def press(self, event: ToolEvent, hit: Hit) -> None:
        """Begin to drag the guide that is hit."""
        self.lit = hit.index
        snapper, unit = event.snapping.for_guide(), event.settings.unit
        event.drags.press(event.pointer, MoveGuide(event.session.document, hit.index, snapper, unit))

    def hint(self, event: ToolEvent) -> Hint | None:
        """Return what a press on the guide would do, None beside all of them."""
        if self.lit is None:
            return None
        guide = event.session.document.guides[self.lit]
        words = guide_label(guide, event.settings.unit)
        text = f"Guide {words} · Drag: move it, back to the ruler: remove it · Double-click: type its place"
        return Hint(text, grab=True, cursor=CURSORS[guide.axis.coordinate])


def hint_on_ruler(axis: Axis) -> Hint:
    """Return what a press on the ruler would do out of which guides of an axis are drawn."""
    text = "Drag onto the drawing for a guide · Double-click: type where it lies"
    return Hint(text, grab=True, cursor=CURSORS[axis.coordinate])


class GuideTool(Tool):
    """Tool that draws a guide out of a ruler, from the press on until the button is let go."""

    cursor = Cursor.MOVE
    lasts_one_gesture = True

    def __init__(self, axis: Axis, event: ToolEvent) -> None:
        document = event.session.document
        self._place = len(document.guides)
        # Where the guide lies in this document is told nowhere: over the ruler there is none.
        drawn = replace(document, guides=(*document.guides, Guide(axis, 0.0)))
        snapper, unit = event.snapping.for_guide(), event.settings.unit
        event.drags.press(event.pointer, MoveGuide(drawn, self._place, snapper, unit, is_new=True))

    def marks(self, event: ToolEvent) -> Marks:
        """Return what the guide snaps to, and which it is."""
        return Marks(snap=event.snapping.caught, guide=self._place)
