"""The tool that measures a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from app.document import words
from app.document.model import Vector
from app.tools.drags import in_steps
from app.tools.marks import GestureMarks, Ruler
from app.tools.pointer import Hint, Pointer
from app.tools.snapping import Snapper, with_snap
from app.tools.tool import Gesture, Tool, ToolContext, ToolRecord

_KEYS = "Shift: steps of 15° · Ctrl: snap, or not"
"""Effects of the modifier keys while something is measured."""


class Measurement:
    """A line from the press to the pointer, both snapping; with Shift its angle goes in steps of 15°.

    Attributes
    ----------
    ruler
        What is measured.
    snapper
        Snaps its ends.
    """

    def __init__(self, pointer: Pointer, snapper: Snapper, unit: str) -> None:
        self.snapper, self._unit = snapper, unit
        self._start = snapper.snap(pointer.position, pointer)
        self.ruler = Ruler(self._start, self._start, "")

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        end = self._end(pointer)
        dx, dy = end[0] - self._start[0], end[1] - self._start[1]
        unit = f" {self._unit}" if self._unit else ""
        direction = words.angle(math.degrees(math.atan2(dy, dx)))
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {direction}"
        self.ruler = Ruler(self._start, end, text)

    def _end(self, pointer: Pointer) -> Vector:
        if not pointer.shift:
            return self.snapper.snap(pointer.position, pointer)
        # An angle that is held leaves nothing to be drawn elsewhere.
        self.snapper.reset()
        x, y = self._start
        dx, dy = in_steps((pointer.position[0] - x, pointer.position[1] - y))
        return (x + dx, y + dy)

    def progress(self) -> str:
        """Return what is measured, and what the keys would change."""
        return f"{self.ruler.text} · {_KEYS}" if self.ruler.text else ""

    @property
    def is_something(self) -> bool:
        """Whether there is a distance to show."""
        return self.ruler.start != self.ruler.end


class MeasureTool(Tool):
    """Measures from the press to the pointer; the ruler stays until it is dismissed."""

    def __init__(self) -> None:
        self._measured: Measurement | None = None
        self._measuring = False

    @property
    def is_busy(self) -> bool:
        """Whether the end of the ruler follows the pointer."""
        return self._measuring

    def press(self, context: ToolContext) -> None:
        """Begin to measure here."""
        snapper = context.snappers.for_points((), -1)
        self._measured = Measurement(context.pointer, snapper, context.settings.unit)
        self._measuring = True

    def move(self, context: ToolContext) -> None:
        """Measure up to the pointer."""
        if self._measuring and self._measured is not None:
            self._measured.move(context.pointer)

    def release(self, context: ToolContext) -> None:
        """Measure up to the pointer, and leave the ruler there."""
        self.move(context)

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        context.preview_snap(-1)
        return Hint(f"Drag to measure a distance and an angle · {_KEYS} · V goes back to Select")

    def cancel(self, context: ToolContext) -> None:
        """Remove the ruler that is drawn."""
        if self._measuring:
            self._measured = None
        super().cancel(context)

    def end(self) -> None:
        """Let the ruler stay where it is."""
        self._measuring = False

    def dismiss(self) -> bool:
        """Remove the ruler; return whether there was one."""
        measured, self._measured = self._measured, None
        return measured is not None

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the ruler, and what its end, or a press, has snapped to."""
        measured, caught = self._measured, context.snappers.caught
        if measured is None:
            return GestureMarks(snap=caught)
        return GestureMarks(
            ruler=measured.ruler if measured.is_something else None, snap=caught if self._measuring else None
        )

    def progress(self, context: ToolContext) -> str:
        """Return what is measured."""
        if not self._measuring or self._measured is None:
            return ""
        return with_snap(self._measured.progress(), context.snappers.caught)


MEASURE = ToolRecord(
    name="measure",
    make=MeasureTool,
    hint="Drag to measure; V or Escape goes back to selecting.",
    doing="measuring",
    gestures=(Gesture("Drag", "distance and angle; Shift: 15° steps; Escape puts it away"),),
    place=30,
    action="measureTool",
    title="Measure",
    full_name="Measure Tool",
    key="M",
    icon="measure",
    tip="Drag to measure a distance and an angle",
)
