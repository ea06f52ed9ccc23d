"""The tool that places text: a click says where its baseline begins."""

from __future__ import annotations

from ..pointer import SNAP_KEY, Cursor, Hint
from ..snapping import with_snap
from ..tool import Gesture, GestureRow, Tool, ToolContext, ToolRecord

_HINT = "Click where the text begins: on its baseline, at the left"


class Placing(Gesture):
    """A press that may still be moved; where it is let go the text begins."""

    def __init__(self, context: ToolContext) -> None:
        self._snapper = context.snappers.for_new(-1)
        self._snapper.at(context.pointer)

    def move(self, context: ToolContext) -> None:
        """Snap to what is near."""
        self._snapper.at(context.pointer)

    def release(self, context: ToolContext) -> None:
        """Ask for the words."""
        context.write_at(self._snapper.at(context.pointer))

    def progress(self, context: ToolContext) -> str:
        """Return what letting go does."""
        return with_snap("Let go where the text begins · Escape cancels", context.snappers.caught)


class TextTool(Tool):
    """Tool that places text; whoever shows the plot asks for the words."""

    cursor = Cursor.TEXT

    def press(self, context: ToolContext) -> None:
        """Begin to place a text."""
        self.gesture = Placing(context)

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        context.preview_snap(-1)
        return Hint(f"{_HINT} · {SNAP_KEY} · V goes back to Select")


TEXT = ToolRecord(
    name="text",
    make=TextTool,
    hint=f"{_HINT}; V or Escape goes back to selecting.",
    beginning="Click on the canvas where a text shall begin.",
    doing="writing",
    gestures=(
        GestureRow("Click", "type a text whose baseline begins here"),
        GestureRow("Enter, Escape", "make its outlines, one shape for each letter; give it up"),
        GestureRow("Shift+Enter", "another line"),
    ),
    place=28,
    action="textTool",
    title="Text",
    full_name="Text Tool",
    key="Shift+T",
    icon="type",
    tip="Click and type: words become the outlines of their letters, which are edited as curves, not as text",
    in_menu=True,
    in_toolbar=False,
    keywords="letters words type font lettering outlines glyphs write object to path",
)
