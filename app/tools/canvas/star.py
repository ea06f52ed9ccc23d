"""The tool that draws a star or a polygon: a drag goes from its middle to its first corner."""

from __future__ import annotations

import math

from msgspec.structs import replace

from ...document import words
from ...document.edits import EditError
from ...document.forms import CORNERS, RATIOS, Star
from ...view_model.shapes.formed import formed
from ..drags import stepped_from
from ..form_tool import HANDLE_GESTURES, Begun, DrawForm, FormTool
from ..pointer import STEP_KEYS, Pointer
from ..tool import GestureRow, ToolContext, ToolRecord

_USUAL = Star(0.0, 0.0, 1.0)


class DrawStar(DrawForm, frozen=True, kw_only=True):
    """A drag from the middle of a star to its first corner.

    Attributes
    ----------
    model
        The star that corners and ratio come from, while they are not typed.
    """

    model: Star

    modifiers = STEP_KEYS
    sides = ("its corners", "its ratio")

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Draw {self.star.word}"

    @property
    def star(self) -> Star:
        """The star by its corners and its ratio, which may have been typed."""
        corners, ratio = (self.typed if self.typed.is_pair else self.typed.after_tab(None)).pair(math.nan)
        star = self.model
        if CORNERS[0] <= corners <= CORNERS[1] and corners.is_integer():
            star = replace(star, corners=corners)
        return replace(star, ratio=ratio) if RATIOS[0] <= ratio <= RATIOS[1] else star

    def star_at(self, pointer: Pointer) -> Star:
        """Return the star with its first corner at the pointer."""
        start = self.begun.start
        end = stepped_from(start, pointer, self.begun.snapper)
        across, up = end[0] - start[0], end[1] - start[1]
        angle = math.degrees(math.atan2(up, across))
        return replace(self.star.at(start), radius=math.hypot(across, up), angle=angle)

    def form_at(self, pointer: Pointer) -> Star:
        """Return the star where it has any size."""
        star = self.star_at(pointer)
        if not star.radius:
            raise EditError("Drag away from the middle of the star.")
        return star

    def readout(self, pointer: Pointer) -> str:
        """Return corners and radius, with a mark where a digit goes that is typed."""
        star, at = self.star_at(pointer), self.typed.at
        shown = [words.number(star.corners), words.number(star.ratio)]
        for place, text in enumerate(self.typed.fields):
            if text or (self.typed.is_pair and place == at):
                shown[place] = f"{text}{'|' if place == at else ''}"
        radius = f"radius {words.number(star.radius)} {self.begun.unit}".rstrip()
        return f"{shown[0]} corners · ratio {shown[1]} · {radius}"


class StarTool(FormTool):
    """Tool that draws stars and polygons, and changes forms by their handles."""

    how = "Drag to draw a star, from its middle to a corner"
    modifiers = STEP_KEYS
    too_late = "Type the number of corners while you drag; later it has a field"

    def __init__(self) -> None:
        super().__init__()
        # As the last one was.
        self._model = _USUAL

    def drag(self, context: ToolContext, begun: Begun) -> DrawStar:
        """Return the drag of a star like the one that is edited, or else the last one."""
        self._model = _edited(context) or self._model
        return DrawStar(context.host.document, begun, model=self._model)

    def end(self) -> None:
        """Drop the drag; the next star is like it."""
        if isinstance(self._drag, DrawStar):
            self._model = self._drag.star
        super().end()

    def reset(self) -> None:
        """Begin with the usual star in another document."""
        self._model = _USUAL


def _edited(context: ToolContext) -> Star | None:
    """Return the star that is edited; None where none is."""
    now = formed(context.host.active_view.source)
    return now.form if now is not None and isinstance(now.form, Star) else None


STAR = ToolRecord(
    name="star",
    make=StarTool,
    hint=f"{StarTool.how}; V or Escape goes back to selecting.",
    beginning="Drag on the canvas to draw a star.",
    doing="drawing stars",
    gestures=(
        GestureRow("Drag", "draw a star from its middle to a corner"),
        GestureRow("Ctrl, Shift", "a corner at steps of 15°"),
        GestureRow(
            "Digits, Tab while dragging", "type the number of its corners, and its ratio: 1 is a polygon"
        ),
        *HANDLE_GESTURES,
    ),
    place=27,
    action="starTool",
    title="Star",
    full_name="Star Tool",
    key="*",
    icon="star",
    tip=f"Draw a star or a polygon: drag from its middle to a corner; {STEP_KEYS}",
    in_menu=True,
    in_toolbar=False,
    keywords="polygon triangle pentagon hexagon regular corners",
)
