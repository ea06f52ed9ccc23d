"""The tool that places text: a click says where its baseline begins, or which text is edited again."""

from __future__ import annotations

from ...document.texts import words_of
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
        context.surface.write_at(self._snapper.at(context.pointer))

    def progress(self, context: ToolContext) -> str:
        """Return what letting go does."""
        return with_snap("Let go where the text begins · Escape cancels", context.snappers.caught)


class Opening(Gesture):
    """A press on a text that is there; where it is let go there, too, that is edited."""

    def release(self, context: ToolContext) -> None:
        """Ask for other words."""
        if (curve := _letter_at(context)) >= 0:
            context.surface.open_text(curve)

    def progress(self, context: ToolContext) -> str:
        """Return what letting go does."""
        return "Let go to edit the text · Escape cancels"


class TextTool(Tool):
    """Tool that places text, or edits what is there; whoever shows the plot asks for the words."""

    cursor = Cursor.TEXT

    def press(self, context: ToolContext) -> None:
        """Begin to place a text, or to edit one."""
        self.gesture = Opening() if _letter_at(context) >= 0 else Placing(context)

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        if (curve := _letter_at(context)) >= 0:
            words = words_of(context.host.document, curve)
            return Hint(f"Click to edit the text “{words}” · Shift: begin another one here")
        context.preview_snap(-1)
        return Hint(f"{_HINT} · {SNAP_KEY} · V goes back to Select")


def _letter_at(context: ToolContext) -> int:
    """Return the topmost text or letter at the pointer, by its place; −1 for none, or with Shift."""
    if context.pointer.shift or not context.pointer.is_there:
        return -1
    document = context.host.document
    return next(
        (place for place in context.surface.curves_at(context.pointer) if words_of(document, place)), -1
    )


TEXT = ToolRecord(
    name="text",
    make=TextTool,
    hint=f"{_HINT}; V or Escape goes back to selecting.",
    beginning="Click on the canvas where a text shall begin.",
    doing="writing",
    gestures=(
        GestureRow("Click", "type a text whose baseline begins here"),
        GestureRow("Click a text", "edit it again, where it is now; Shift begins another one there"),
        GestureRow("Enter, Escape", "make its outlines, one shape for each letter; give it up"),
        GestureRow("Shift+Enter, Ctrl+Enter", "another line"),
    ),
    place=28,
    action="textTool",
    title="Text",
    full_name="Text Tool",
    key="Shift+T",
    icon="type",
    tip="Click and type: words become outlines of letters, as curves; click them to edit the text again",
    in_menu=True,
    in_toolbar=False,
    keywords="letters words type font lettering outlines glyphs write object to path",
)
