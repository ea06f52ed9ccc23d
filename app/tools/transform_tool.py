"""The tool of a transform that a key begins: no button is down, and further keys change it."""

from __future__ import annotations

from app.tools.marks import GestureMarks
from app.tools.pointer import Cursor, Hint
from app.tools.tool import Tool, ToolContext
from app.tools.transform import Transform, TransformKind

_KEYS = frozenset("0123456789.-xygsr") | {"backspace", "tab", "enter"}


class TransformTool(Tool):
    """Lets the selected points, or curves, follow the pointer until Enter, a click or Escape.

    Parameters
    ----------
    transform
        What it begins with.
    """

    cursor = Cursor.ARROW
    lasts_one_gesture = True

    def __init__(self, transform: Transform) -> None:
        self._transform = transform

    def begin(self, context: ToolContext) -> None:
        """Begin; the document follows the pointer from now on."""
        context.drags.press_at_once(context.pointer, self._transform)

    def press(self, context: ToolContext) -> None:
        """Make it a step of the history."""
        context.drags.release(context.pointer)

    def hover(self, context: ToolContext) -> Hint:
        """Follow the pointer."""
        self.move(context)
        return Hint()

    def claims(self, key: str) -> bool:
        """Whether a key is for the transform: a digit, ".", "-", "x", "y" …."""
        return key in _KEYS

    def key(self, context: ToolContext, key: str) -> bool:
        """Take a key: a digit, ".", "-", "tab", "x", "y", "g", "s", "r", "backspace" or "enter"."""
        if key == "enter":
            context.drags.release(context.pointer)
            return True
        changed = self._transform.with_key(key)
        if changed is None:
            return False
        self._transform = changed
        context.drags.exchange(context.pointer, changed)
        return True

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the amount, the axis that is locked, and what is snapped to."""
        caught = context.snappers.caught
        return GestureMarks(snap=caught, note=context.note(), axis=self._transform.locked_axis)


def begin_transform(kind: TransformKind, context: ToolContext) -> TransformTool | None:
    """Begin to transform the target, or say why not; nothing selected means all points."""
    if refusal := context.target.refusal_of_keys:
        context.host.refuse(refusal)
        return None
    tool = TransformTool(context.target.transform(kind, context.pointer))
    tool.begin(context)
    return tool
