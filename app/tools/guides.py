"""Guides: drawn out of a ruler, dragged, dragged back."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import NamedTuple

from msgspec.structs import replace

from ..document.guide_edits import locked_words, move_guide, place_words, remove_guide
from ..document.model import Axis, Document, Guide, Vector
from ..document.readings import readings_of
from ..document.transforms import decimal_sum
from ..document.words import number
from .drag import Drag
from .drag_machine import EditingHost
from .marks import GestureMarks
from .pointer import Cursor, Hint, Hit, Part, Pointer, Stride
from .snapping import Snapper
from .tool import Tool, ToolContext

CURSORS = {0: Cursor.WIDER, 1: Cursor.HIGHER}
"""Shape of the pointer over a guide that holds x, or y."""

_KEYS = "Arrow keys: move it · Del: remove it"


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
            return f"Remove guide at {place_words(self.document.guides[self.place], self.readings)}"
        where = place_words(self._guide_at(pointer), self.readings)
        return f"{'Guide at' if self.is_new else 'Move guide to'} {where}"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the guide be where the pointer is, or be none over a ruler."""
        if _is_beyond(pointer):
            return remove_guide(self.document, self.place)
        return move_guide(self.document, self.place, self._guide_at(pointer))

    def _guide_at(self, pointer: Pointer) -> Guide:
        guide = self.document.guides[self.place]
        if guide.lean:
            return self._leaning_at(pointer, guide)
        index = guide.axis.coordinate
        caught = self.snapper.snap(pointer.position, pointer, index)[index]
        is_snapped = self.snapper.caught is not None
        return replace(guide, position=caught if is_snapped else self._clean(index, caught, pointer.scale))

    def _leaning_at(self, pointer: Pointer, guide: Guide) -> Guide:
        """Return a guide that leans, through what the pointer is at; it is that point that it leans about."""
        place = self.snapper.at(pointer)
        if self.snapper.caught is None:
            x, y = (self._clean(axis, value, pointer.scale) for axis, value in enumerate(place))
            place = (x, y)
        return guide.through(place[guide.axis.coordinate], place[guide.axis.other.coordinate])

    def _clean(self, axis: int, value: float, pixels_per_unit: float) -> float:
        """Return a coordinate within a pixel that is told with no more decimals than that takes."""
        decimals = -math.floor(-math.log10(pixels_per_unit))
        return self.readings.meant_at(axis, round(self.readings.shown_at(axis, value), decimals))

    def readout(self, pointer: Pointer) -> str:
        """Return where the guide is."""
        if _is_beyond(pointer):
            return "Drag onto the drawing for a guide" if self.is_new else "Let go to remove the guide"
        return f"Guide {place_words(self._guide_at(pointer), self.readings, self.unit)}"

    def place_at(self, pointer: Pointer) -> Vector | None:
        """Return the place on the guide beside the pointer."""
        return self._guide_at(pointer).beside(pointer.position)


def _is_beyond(pointer: Pointer) -> bool:
    """Whether the pointer is over a ruler, or farther out there."""
    return pointer.pixel[0] < 0 or pointer.pixel[1] < 0


class NudgeGuide(Drag, frozen=True):
    """Move of a guide by a key, wherever the pointer is; it is added in decimal numbers."""

    place: int
    step: float
    unit: str

    name = "Nudge guide"

    @property
    def _guide(self) -> Guide:
        guide = self.document.guides[self.place]
        return replace(guide, position=decimal_sum(guide.position, self.step))

    def readout(self, _pointer: Pointer) -> str:
        """Return where the guide is now, and the step."""
        where = place_words(self._guide, self.readings, self.unit)
        return f"Guide {where} · step {number(abs(self.step))}"

    def document_at(self, _pointer: Pointer) -> Document:
        """Move by the step."""
        return move_guide(self.document, self.place, self._guide)


class _Choice(NamedTuple):
    """The guide that was clicked, and what there was then: it is chosen as long as that is so."""

    place: int
    guides: int
    points: Collection[int]
    curves: Collection[int]

    @classmethod
    def of(cls, host: EditingHost, place: int) -> _Choice:
        selected = host.selected
        return cls(place, len(host.document.guides), selected.points, selected.chosen)


class GuidePicker:
    """The guide under the pointer, and the one that was clicked, for a tool that finds guides.

    Attributes
    ----------
    lit
        The place in the document of the one under the pointer, None for none.
    """

    def __init__(self) -> None:
        self.lit: int | None = None
        self._host: EditingHost | None = None
        self._choice: _Choice | None = None

    @property
    def chosen(self) -> int | None:
        """The place of the guide that was clicked and that keys move; None once something else is chosen."""
        choice, host = self._choice, self._host
        if choice is None or host is None or choice != _Choice.of(host, choice.place):
            return None
        return choice.place

    @property
    def shown(self) -> int | None:
        """The place of the guide to be shown as one that is meant."""
        return self.chosen if self.lit is None else self.lit

    def let_go(self) -> bool:
        """Choose no guide any more; return whether one was chosen."""
        had, self._choice = self.chosen is not None, None
        return had

    def hover(self, context: ToolContext, hit: Hit | None) -> None:
        """Take note of what lies under the pointer."""
        self._host = context.host
        self.lit = hit.index if hit is not None and hit.part is Part.GUIDE else None

    def press(self, context: ToolContext, hit: Hit) -> None:
        """Begin to drag the guide that is hit."""
        host, self.lit = context.host, hit.index
        document, self._host, self._choice = host.document, host, _Choice.of(host, hit.index)
        snapper, unit = context.snappers.for_guide(), context.settings.unit
        said = f"Guide {place_words(document.guides[hit.index], readings_of(document), unit)} · {_KEYS}"
        moving = MoveGuide(document, hit.index, snapper, unit)
        context.drags.press(context.pointer, moving, on_click=lambda: host.say(said))

    def nudge(self, context: ToolContext, direction: Vector, stride: Stride) -> bool:
        """Move the guide that is chosen; return whether there is one."""
        place = self.chosen
        if place is None or context.settings.guides_stay:
            return False
        guide = context.host.document.guides[place]
        way = direction[guide.axis.coordinate]
        if guide.locked:
            context.host.refuse(locked_words(guide, readings_of(context.host.document)))
        elif way:
            step = way * context.step_of(stride)
            nudge = NudgeGuide(context.host.document, place, step, context.settings.unit)
            context.drags.nudge(nudge, ("guide", place))
        return True

    def hint(self, context: ToolContext) -> Hint | None:
        """Return what a press on the guide would do, None beside all of them."""
        if self.lit is None:
            return None
        guide = context.host.document.guides[self.lit]
        words = place_words(guide, readings_of(context.host.document), context.settings.unit)
        keys = (
            _KEYS
            if self.lit == self.chosen
            else "Del: remove it"
            if self._is_removable
            else "Click: choose it"
        )
        text = f"Guide {words} · Drag: move it, back to the ruler: remove it · Double-click: type · {keys}"
        return Hint(text, grab=True, cursor=CURSORS[guide.axis.coordinate])

    @property
    def _is_removable(self) -> bool:
        """Whether Delete means the guide: what is selected comes before it."""
        host = self._host
        if host is None or self.lit is None or self.lit >= len(host.document.guides):
            return False
        return not host.selected.points and not host.selected.chosen

    def claims(self, key: str) -> bool:
        """Whether a key is for the guide."""
        return key in ("delete", "backspace") and (self._is_removable or self.chosen is not None)

    def key(self, context: ToolContext, key: str) -> bool:
        """Remove the guide with Delete; return whether there was one."""
        place = self.lit if self._is_removable else self.chosen
        if place is None or not self.claims(key) or context.settings.guides_stay:
            return False
        document = context.host.document
        where = place_words(document.guides[place], readings_of(document))
        self.lit = self._choice = None
        return bool(context.host.change(f"Remove guide at {where}", lambda now: remove_guide(now, place)))


def hint_on_ruler(axis: Axis) -> Hint:
    """Return what a press on the ruler would do out of which guides of an axis are drawn."""
    text = "Drag onto the drawing for a guide · Double-click: type where it lies"
    return Hint(text, grab=True, cursor=CURSORS[axis.coordinate])


class GuideTool(Tool):
    """Tool that draws a guide out of a ruler, from the press on until the button is let go."""

    cursor = Cursor.MOVE
    lasts_one_gesture = True

    def __init__(self, axis: Axis, context: ToolContext) -> None:
        document = context.host.document
        self._place = len(document.guides)
        # Where the guide lies in this document is told nowhere: over the ruler there is none.
        drawn = replace(document, guides=(*document.guides, Guide(axis, 0.0)))
        snapper, unit = context.snappers.for_guide(), context.settings.unit
        context.drags.press(context.pointer, MoveGuide(drawn, self._place, snapper, unit, is_new=True))

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return what the guide snaps to, and which it is."""
        return GestureMarks(snap=context.snappers.caught, guide=self._place)
