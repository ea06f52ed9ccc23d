"""The eyedroppers: a click gives what is chosen the colour that is seen there."""

from __future__ import annotations

from functools import partial

from ...document.several_curves import named
from ..curve_picker import meant_shapes
from ..marks import GestureMarks, Note
from ..pointer import Hint, Hit
from ..tool import GestureRow, Tool, ToolContext, ToolRecord

_OTHER = {"fill": "stroke", "stroke": "fill"}
_NOTHING = "Choose a curve first: it gets the colour."


class EyedropperTool(Tool):
    """Tool that picks colours for the "fill" or the "stroke" of what is chosen; with Shift for the other."""

    finds_other_curves = True

    def __init__(self, paint: str) -> None:
        self._paint = paint
        # The colour under the pointer; empty while that is elsewhere.
        self._seen = ""

    def press(self, context: ToolContext) -> None:
        """Begin a click."""
        context.drags.press(context.pointer, None, partial(self._pick, context))

    def _pick(self, context: ToolContext) -> None:
        if meant_shapes(context.host):
            context.surface.give_colour(self._paint_for(context), context.surface.colour_at(context.pointer))
        else:
            context.host.refuse(_NOTHING)

    def _paint_for(self, context: ToolContext) -> str:
        return _OTHER[self._paint] if context.pointer.shift else self._paint

    def hover(self, context: ToolContext) -> Hint:
        """Return the colour here, and what a click gives it to."""
        self._seen = context.surface.colour_at(context.pointer) if context.pointer.is_there else ""
        if not self._seen:
            return Hint()
        curves = meant_shapes(context.host)
        if not curves:
            return Hint(f"{self._seen} · {_NOTHING}")
        what = f"{self._paint_for(context)} of {named(context.host.document, curves)}"
        other = "" if context.pointer.shift else f" · Shift: its {_OTHER[self._paint]}"
        return Hint(f"{self._seen} · Click: {what}{other} · V goes back to Select")

    def lit(self, hit: Hit | None) -> int:
        """Light up no point."""
        return -1

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return the colour beside the pointer."""
        place = context.pointer.position
        return GestureMarks(note=Note(place, self._seen, place)) if self._seen else GestureMarks()


def _tool(paint: str, *, place: int, title: str, key: str, name: str) -> ToolRecord:
    """Return the tool that picks colours for a paint."""
    other = _OTHER[paint]
    return ToolRecord(
        name=name,
        make=partial(EyedropperTool, paint),
        hint=f"Click a colour for the {paint} of what is chosen, Shift: {other}; V or Escape goes back.",
        doing="picking colours",
        gestures=(
            GestureRow("Click", f"give the {paint} of what is chosen the colour seen there"),
            GestureRow("Shift+click", f"give it to the {other}"),
        ),
        place=place,
        action=f"{name}Tool",
        title=title,
        full_name=f"{title} Tool",
        key=key,
        icon="eyedropper" if paint == "fill" else f"{paint}-eyedropper",
        tip=f"Pick a colour seen in the drawing for the {paint} of what is chosen; Shift: for its {other}",
        in_menu=paint == "fill",
        in_toolbar=False,
        keywords="eyedropper dropper pipette pick colour color sample",
    )


EYEDROPPER = _tool("fill", place=31, title="Eyedropper", key="F7", name="eyedropper")
STROKE_EYEDROPPER = _tool(
    "stroke", place=32, title="Eyedropper for Strokes", key="Shift+F7", name="strokeEyedropper"
)
