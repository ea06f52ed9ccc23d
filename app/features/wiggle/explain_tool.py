"""The tool that explains the curve where it is clicked."""

from __future__ import annotations

from ...tools.pointer import Hint, Part
from ...tools.tool import GestureRow, Tool, ToolEvent, ToolRecord


class ExplainTool(Tool):
    """Tool that moves the scrub line to the clicked point of the curve, which is explained there."""

    def press(self, event: ToolEvent) -> None:
        """Move the scrub line here."""
        hit = event.hit
        if hit is not None and hit.part is Part.CURVE:
            event.session.scrub.set(hit.t)
        else:
            event.session.refuse("Click the curve where it swings out.")

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint for a click on the curve."""
        text = "Click the curve where it swings out · V goes back to Select"
        return Hint(text, grab=event.hit is not None)


EXPLAIN = ToolRecord(
    name="explain",
    make=ExplainTool,
    hint="Click the curve where it swings out; V goes back to Select.",
    doing="explaining",
    gestures=(GestureRow("Click the curve", "explain why it swings out there"),),
)
