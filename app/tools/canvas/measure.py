"""The tool that measures a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from ...document import words
from ..drag import minus
from ..drags import stepped_from
from ..marks import Marks, Ruler
from ..pointer import SNAP_KEY, STEP_KEYS, Hint
from ..snapping import with_snap
from ..tool import GestureRow, OldGesture, Tool, ToolEvent, ToolRecord

_KEYS = f"{STEP_KEYS} · {SNAP_KEY}"
"""Effects of the modifier keys while something is measured."""


class Measuring(OldGesture):
    """A line from the press to the pointer, both snapping; with Ctrl or Shift its angle goes in steps of 15°.

    Attributes
    ----------
    ruler
        The line with what is measured.
    """

    def __init__(self, event: ToolEvent) -> None:
        self._snapper, self._unit = event.snapping.for_new_point(-1), event.settings.unit
        start = self._snapper.at(event.pointer)
        self.ruler = Ruler(start, start, "")

    def move(self, event: ToolEvent) -> None:
        """Measure up to the pointer."""
        start = self.ruler.start
        end = stepped_from(start, event.pointer, self._snapper)
        way = minus(end, start)
        dx, dy = way
        unit = f" {self._unit}" if self._unit else ""
        direction = words.direction(way)
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {direction}"
        self.ruler = Ruler(start, end, text)

    def progress(self, event: ToolEvent) -> str:
        """Return what is measured, and what the keys would change."""
        text = self.ruler.text
        return with_snap(f"{text} · {_KEYS}", event.snapping.caught) if text else ""


class MeasureTool(Tool):
    """Tool that measures from the press to the pointer; the ruler stays until it is dismissed."""

    def __init__(self) -> None:
        self._measured: Measuring | None = None

    def takes_up(self, event: ToolEvent) -> bool:
        """Whether it works on the active curve where none is edited: never."""
        return False

    def press(self, event: ToolEvent) -> None:
        """Begin to measure here."""
        self.gesture = self._measured = Measuring(event)

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        event.preview_snap(-1)
        return Hint(f"Drag to measure a distance and an angle · {_KEYS} · V goes back to Select")

    def cancel(self, event: ToolEvent) -> None:
        """Remove the ruler that is drawn."""
        if self.gesture is not None:
            self._measured = None
        super().cancel(event)

    def dismiss(self, event: ToolEvent) -> bool:
        """Remove the ruler; return whether there was one."""
        measured, self._measured = self._measured, None
        return measured is not None

    def marks(self, event: ToolEvent) -> Marks:
        """Return the ruler, and what its end, or a press, has snapped to."""
        ruler = self._measured.ruler if self._measured is not None else None
        return Marks(
            ruler=ruler if ruler is not None and ruler.start != ruler.end else None,
            snap=event.snapping.caught if ruler is None or self.gesture is not None else None,
        )


MEASURE = ToolRecord(
    name="measure",
    make=MeasureTool,
    hint="Drag to measure; V or Escape goes back to selecting.",
    doing="measuring",
    gestures=(GestureRow("Drag", "distance and angle; Ctrl or Shift: 15° steps; Escape puts it away"),),
    rank=30,
    action="measureTool",
    title="Measure",
    in_toolbar=False,
    full_name="Measure Tool",
    key="M",
    icon="measure",
    tip="Drag to measure a distance and an angle",
)
