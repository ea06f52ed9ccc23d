"""The tool that places text: a click says where its baseline begins, or which text is edited again.

In drawings a drag draws a frame, which words fill.
"""

from __future__ import annotations

import math

from msgspec.structs import replace

from ...document.content import Lettering
from ...document.drawn_kinds import TEXTS
from ...document.model import Vector
from ...document.paper import DocumentKind, kind_of
from ...document.texts import words_of
from ...document.words import number
from ..drag_machine import CANCELLED, THRESHOLD
from ..form_tool import handle_hint, handle_marks, press_on_handle
from ..marks import GestureMarks
from ..pointer import SNAP_KEY, Cursor, Hint
from ..snapping import with_snap
from ..tool import Gesture, GestureRow, Tool, ToolContext, ToolRecord

_HINT = "Click where the text begins: on its baseline, at the left"


class Placing(Gesture):
    """A press that may still be moved; where it is let go the text begins. In drawings it draws a frame.

    Attributes
    ----------
    frame
        Two opposite corners of that; None before the pointer has travelled far enough.
    """

    def __init__(self, context: ToolContext) -> None:
        self._snapper, self._press = context.snappers.for_new(-1), context.pointer
        self._begun = self._snapper.at(context.pointer)
        self._has_frame = kind_of(context.host.document) is DocumentKind.DRAWING
        self.frame: tuple[Vector, Vector] | None = None

    def move(self, context: ToolContext) -> None:
        """Snap to what is near, and draw the frame on."""
        pointer = context.pointer
        place = self._snapper.at(pointer)
        is_far = math.dist(pointer.pixel, self._press.pixel) >= THRESHOLD
        if self._has_frame and (self.frame is not None or is_far):
            self.frame = (self._begun, place)

    def release(self, context: ToolContext) -> None:
        """Ask for the words."""
        self.move(context)
        if self.frame is None:
            context.surface.write_at(self._snapper.at(context.pointer))
            return
        corners = sorted({each[0] for each in self.frame}), sorted({each[1] for each in self.frame})
        if all(len(each) > 1 for each in corners):
            (left, right), (low, high) = corners
            context.surface.write_at((left, high), (right, low))

    def cancel(self, context: ToolContext) -> None:
        """Draw no frame."""
        if self.frame is not None:
            context.host.say(CANCELLED)

    def progress(self, context: ToolContext) -> str:
        """Return what letting go does."""
        words = "Let go where the text begins · Escape cancels"
        if self.frame is not None:
            (x, y), (to_x, to_y) = self.frame
            size = f"W {number(abs(to_x - x))} · H {number(abs(to_y - y))} {context.settings.unit}".rstrip()
            words = f"{size} · let go to type what fills the frame · Escape cancels"
        return with_snap(words, context.snappers.caught)


class Opening(Gesture):
    """A press on a text that is there; where it is let go there, too, that is edited."""

    def release(self, context: ToolContext) -> None:
        """Ask for other words."""
        if (curve := _letter_at(context)) >= 0:
            context.surface.open_text(curve, context.pointer.position)

    def progress(self, context: ToolContext) -> str:
        """Return what letting go does."""
        return "Let go to edit the text · Escape cancels"


class TextTool(Tool):
    """Tool that places text, or edits what is there; whoever shows the plot asks for the words."""

    cursor = Cursor.TEXT

    def press(self, context: ToolContext) -> None:
        """Begin to place a text, to edit one, or to change the frame of one that is chosen."""
        if press_on_handle(context, Lettering):
            return
        self.gesture = Opening() if _letter_at(context) >= 0 else Placing(context)

    def hover(self, context: ToolContext) -> Hint:
        """Return what a press here would do."""
        if (hint := handle_hint(context, Lettering)) is not None:
            return hint
        if (curve := _letter_at(context)) >= 0:
            words = words_of(context.host.document, curve)
            return Hint(f"Click to edit the text “{words}” · Shift: begin another one here")
        context.preview_snap(-1)
        is_drawing = kind_of(context.host.document) is DocumentKind.DRAWING
        words = f"{_HINT}{' · Drag: a frame to fill' if is_drawing else ''}"
        return Hint(f"{words} · {SNAP_KEY} · V goes back to Select")

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the frame that is drawn, and the handles of those that are chosen."""
        marks = super().marks(context)
        band = self.gesture.frame if isinstance(self.gesture, Placing) else None
        return replace(marks, band=band or marks.band, forms=handle_marks(context, Lettering))


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
        GestureRow(
            "Drag, in drawings", "draw a frame: the words typed fill it, and wrap; its handles change it"
        ),
        GestureRow("Click a text", "edit it again, from that letter on; Shift begins another text there"),
        GestureRow(
            "Drag, double, triple click in it", "choose letters, a word, a line; Shift+click chooses on"
        ),
        GestureRow("Alt+arrows, in drawings", "move the letters from the caret on by a pixel; Shift: by ten"),
        GestureRow("Enter", "begin another line"),
        GestureRow("Ctrl+Enter, a click elsewhere", "keep the text; in a sketch make a shape of each letter"),
        GestureRow("Escape", "keep the text; in a sketch give it up"),
    ),
    place=28,
    action="textTool",
    title="Text",
    full_name="Text Tool",
    key="Shift+T",
    icon="type",
    tip="Click and type; in a drawing drag a frame that the words fill. Click a text to edit it again",
    in_menu=True,
    in_toolbar=False,
    keywords="letters words type font lettering outlines glyphs write object to path",
    draws=TEXTS,
)
