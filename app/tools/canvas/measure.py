"""The tool that measures a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from ...document import words
from ..marks import Marks, Ruler
from ..pointer import SNAP_KEY, STEP_KEYS, Hint, minus
from ..snapping import Snapper, stepped_from
from ..tool import Gesture, GestureRow, Tool, ToolEvent, ToolRecord

_KEYS = f"{STEP_KEYS} · {SNAP_KEY}"
"""Effects of the modifier keys while something is measured."""


class Measuring(Gesture, kw_only=True):
    """A line from the press to the pointer, both snapping; with Ctrl or Shift its angle goes in steps of 15°.

    Attributes
    ----------
    ruler
        The line with distance and angle in words; None once it is cancelled.
    """

    starts_at_press = True
    snapper: Snapper
    unit: str
    ruler: Ruler | None

    def move(self, event: ToolEvent) -> None:
        """Measure up to the pointer."""
        if self.ruler is None:
            return
        start = self.ruler.start
        end = stepped_from(start, event.pointer, self.snapper)
        dx, dy = offset = minus(end, start)
        unit = f" {self.unit}" if self.unit else ""
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {words.direction(offset)}"
        self.ruler = Ruler(start, end, text)

    def cancel(self, event: ToolEvent) -> None:
        """Remove the ruler."""
        self.ruler = None

    @property
    def visible_ruler(self) -> Ruler | None:
        """The ruler, once it has a length."""
        return self.ruler if self.ruler is not None and self.ruler.start != self.ruler.end else None

    def status(self, event: ToolEvent) -> str:
        """Return the distance, the angle and the effects of the keys."""
        return f"{self.visible_ruler.text} · {_KEYS}" if self.visible_ruler is not None else ""

    def marks(self, event: ToolEvent) -> Marks:
        """Return the ruler, and the snap of its end."""
        return Marks(ruler=self.visible_ruler, snap=event.snapping.caught)


class MeasureTool(Tool):
    """Tool that measures from the press to the pointer; the ruler stays until it is dismissed."""

    edits_points = False

    def __init__(self) -> None:
        self._measured: Measuring | None = None

    def press(self, event: ToolEvent) -> Measuring:
        """Begin to measure here."""
        snapper = event.snapping.for_new_point(-1)
        start, unit = snapper.at(event.pointer), event.session.document.unit
        self._measured = Measuring(snapper=snapper, unit=unit, ruler=Ruler(start, start, ""))
        return self._measured

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint, and preview the snap."""
        event.preview_snap(-1)
        return Hint(f"Drag to measure a distance and an angle · {_KEYS} · V returns to Select")

    def dismiss(self, event: ToolEvent) -> bool:
        """Remove the ruler; return whether there was one."""
        measured, self._measured = self._measured, None
        return measured is not None and measured.ruler is not None

    def marks(self, event: ToolEvent) -> Marks:
        """Return the ruler, or the snap of a press."""
        if self._measured is None or self._measured.ruler is None:
            return Marks(snap=event.snapping.caught)
        return Marks(ruler=self._measured.visible_ruler)


MEASURE = ToolRecord(
    name="measure",
    make=MeasureTool,
    hint="Drag to measure; V or Escape returns to Select.",
    doing="measuring",
    gestures=(GestureRow("Drag", "distance and angle; Ctrl or Shift: 15° steps; Escape removes it"),),
    rank=30,
    action="measureTool",
    title="Measure",
    full_name="Measure Tool",
    key="M",
    icon="measure",
    tip="Drag to measure a distance and an angle",
)
