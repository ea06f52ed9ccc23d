"""The tool of a transform that a key begins: no button is down, and further keys change it."""

from __future__ import annotations

from .marks import GestureMarks
from .pointer import Cursor, Hint
from .tool import Tool, ToolContext
from .transform import TransformKind
from .transform_drags import transforming

_KEYS = frozenset("0123456789.-xygsr") | {"backspace", "tab", "enter"}


class TransformTool(Tool):
    """Tool in which selected points or curves, or else all points, follow the pointer until a key or a click.

    Parameters
    ----------
    kind
        The transform that it begins with.
    context
        That of the key that begins it.
    """

    cursor = Cursor.ARROW
    lasts_one_gesture = True

    def __init__(self, kind: TransformKind, context: ToolContext) -> None:
        self._transform = transforming(context, kind)
        context.drags.press_at_once(context.pointer, self._transform)

    def press(self, context: ToolContext) -> None:
        """Make it a step of the history."""
        context.drags.release(context.pointer)

    def hover(self, context: ToolContext) -> Hint:
        """Follow the pointer."""
        self.move(context)
        return Hint()

    def claims(self, context: ToolContext, key: str) -> bool:
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
        target = context.target
        return GestureMarks(
            frame=target.box,
            pivot=target.pivot if self._transform.kind is TransformKind.MOVE else self._transform.centre,
            snap=context.snappers.caught,
            note=context.note(),
            axis=self._transform.locked_axis,
        )
