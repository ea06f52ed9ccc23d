"""The tool that measures a distance and an angle; nothing in the document changes."""

from __future__ import annotations

import math

from app.document import words
from app.document.model import Vector
from app.tools.drag import minus, plus
from app.tools.drags import in_steps
from app.tools.marks import GestureMarks, Ruler
from app.tools.pointer import Hint
from app.tools.snapping import with_snap
from app.tools.tool import Tool, ToolContext, ToolRecord

_KEYS = "Shift: steps of 15° · Ctrl: snap, or not"
"""Effects of the modifier keys while something is measured."""


class MeasureTool(Tool):
    """Measures from the press to the pointer, both snapping; the ruler stays until it is dismissed.

    With Shift its angle goes in steps of 15°.
    """

    def __init__(self) -> None:
        self._ruler: Ruler | None = None
        self._measuring = False

    @property
    def is_busy(self) -> bool:
        """Whether the end of the ruler follows the pointer."""
        return self._measuring

    def press(self, context: ToolContext) -> None:
        """Begin to measure here."""
        start = context.snappers.for_points((), -1).at(context.pointer)
        self._ruler, self._measuring = Ruler(start, start, ""), True

    def move(self, context: ToolContext) -> None:
        """Measure up to the pointer."""
        if not self._measuring or self._ruler is None:
            return
        start = self._ruler.start
        end = _end(context, start)
        dx, dy = minus(end, start)
        unit = f" {context.settings.unit}" if context.settings.unit else ""
        direction = words.angle(math.degrees(math.atan2(dy, dx)))
        length = f"{words.number(math.hypot(dx, dy))}{unit}"
        text = f"{length} · Δx {words.number(dx)} · Δy {words.number(dy)} · {direction}"
        self._ruler = Ruler(start, end, text)

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
            self._ruler = None
        super().cancel(context)

    def end(self) -> None:
        """Let the ruler stay where it is."""
        self._measuring = False

    def dismiss(self) -> bool:
        """Remove the ruler; return whether there was one."""
        ruler, self._ruler = self._ruler, None
        return ruler is not None

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the ruler, and what its end, or a press, has snapped to."""
        ruler = self._ruler
        return GestureMarks(
            ruler=ruler if ruler is not None and ruler.start != ruler.end else None,
            snap=context.snappers.caught if ruler is None or self._measuring else None,
        )

    def progress(self, context: ToolContext) -> str:
        """Return what is measured, and what the keys would change."""
        if not self._measuring or self._ruler is None or not self._ruler.text:
            return ""
        return with_snap(f"{self._ruler.text} · {_KEYS}", context.snappers.caught)


def _end(context: ToolContext, start: Vector) -> Vector:
    snapper, pointer = context.snappers.now, context.pointer
    assert snapper is not None
    if not pointer.shift:
        return snapper.at(pointer)
    # An angle that is held leaves nothing to be drawn elsewhere.
    snapper.reset()
    return plus(start, in_steps(pointer.way_from(start)))


MEASURE = ToolRecord(
    name="measure",
    make=MeasureTool,
    hint="Drag to measure; V or Escape goes back to selecting.",
    action="measureTool",
    title="Measure",
    full_name="Measure Tool",
    key="M",
    icon="measure",
    tip="Drag to measure a distance and an angle",
)
