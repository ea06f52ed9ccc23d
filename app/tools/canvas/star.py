"""The tool that draws a star or a polygon: a drag goes from its middle to its first corner."""

from __future__ import annotations

import math

from msgspec.structs import replace

from ...document import words
from ...document.edits import EditError
from ...document.form_edits import drawn_place, with_form_drawn
from ...document.forms import CORNERS, RATIOS, Star
from ...document.model import Document, Vector
from ...document.style import Style
from ...view_model.formed import formed
from ..drag import Drag
from ..drags import stepped_from
from ..form_tool import HANDLE_GESTURES, FormTool
from ..marks import GestureMarks, Note
from ..pointer import STEP_KEYS, Hint, Pointer
from ..snapping import Snapper
from ..tool import GestureRow, ToolContext, ToolRecord
from ..typed_amount import TypedAmount

_TYPED = frozenset("0123456789.") | {"backspace", "tab", "enter"}
_SIDES = ("its corners", "its ratio")
_HINT = "Drag to draw a star, from its middle to a corner"
_USUAL = Star(0.0, 0.0, 1.0)
_TOO_LATE = (
    "Type the number of corners while you drag; later it has a field (Ctrl+Shift+M). "
    "The toolbar changes the family, or V and then the digit."
)


class DrawStar(Drag, frozen=True):
    """A drag from the middle of a star to its first corner.

    Attributes
    ----------
    active, layer
        The curve that was edited at the press, and the layer to draw in.
    model
        The star that corners and ratio come from.
    style
        Of what is drawn.
    typed
        Corners and ratio as typed meanwhile.
    """

    active: int
    model: Star
    start: Vector
    snapper: Snapper
    unit: str
    style: Style
    typed: TypedAmount = TypedAmount()
    layer: str = ""

    @property
    def name(self) -> str:
        """The name of the step."""
        return f"Draw {self.star.word}"

    @property
    def keys(self) -> str:
        """Effects of the modifier keys, and what else can be typed."""
        at = self.typed.at
        return f"{STEP_KEYS} · digits: {_SIDES[at]}, Tab: {_SIDES[1 - at]}"

    @property
    def star(self) -> Star:
        """The star by its corners and its ratio, which may have been typed."""
        corners, ratio = (self.typed if self.typed.is_pair else self.typed.after_tab(None)).pair(math.nan)
        star = self.model
        if CORNERS[0] <= corners <= CORNERS[1] and corners.is_integer():
            star = replace(star, corners=corners)
        return replace(star, ratio=ratio) if RATIOS[0] <= ratio <= RATIOS[1] else star

    def with_key(self, key: str) -> DrawStar | None:
        """Return the drag after a digit, ".", "backspace" or "tab"; None for any other key."""
        typed = self.typed.after_tab(None) if key == "tab" else self.typed.after(key)
        return None if typed is None else replace(self, typed=typed)

    def star_at(self, pointer: Pointer) -> Star:
        """Return the star with its first corner at the pointer."""
        end = stepped_from(self.start, pointer, self.snapper)
        across, up = end[0] - self.start[0], end[1] - self.start[1]
        angle = math.degrees(math.atan2(up, across))
        return replace(self.star.at(self.start), radius=math.hypot(across, up), angle=angle)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the star."""
        star = self.star_at(pointer)
        if not star.radius:
            raise EditError("Drag away from the middle of the star.")
        return with_form_drawn(self.document, self.active, star, self.style, self.layer)

    def readout(self, pointer: Pointer) -> str:
        """Return corners and radius, with a mark where a digit goes that is typed."""
        star, at = self.star_at(pointer), self.typed.at
        shown = [words.number(star.corners), words.number(star.ratio)]
        for place, text in enumerate(self.typed.fields):
            if text or (self.typed.is_pair and place == at):
                shown[place] = f"{text}{'|' if place == at else ''}"
        radius = f"radius {words.number(star.radius)} {self.unit}".rstrip()
        return f"{shown[0]} corners · ratio {shown[1]} · {radius}"


class StarTool(FormTool):
    """Tool that draws stars and polygons, and changes forms by their handles."""

    how = _HINT

    def __init__(self) -> None:
        # As the last one was.
        self._model = _USUAL
        self._drag: DrawStar | None = None

    def begin(self, context: ToolContext) -> None:
        """Begin at the middle."""
        host, snapper = context.host, context.snappers.for_new(-1)
        self._model = _edited(context) or self._model
        active, unit, layer = host.active_index, context.settings.unit, host.selected.layer
        self._drag = DrawStar(
            host.document,
            active,
            self._model,
            snapper.at(context.pointer),
            snapper,
            unit,
            host.model.style,
            layer=layer,
        )
        place = drawn_place(host.document, active, layer)
        context.drags.press(context.pointer, self._drag, lambda: self.click(context), active=place)

    def end(self) -> None:
        """Drop the drag; the next star is like it."""
        super().end()
        if self._drag is not None:
            self._model = self._drag.star
        self._drag = None

    def reset(self) -> None:
        """Begin with the usual star in another document."""
        self._model = _USUAL

    def claims(self, context: ToolContext, key: str) -> bool:
        """Whether a key is for what is typed: a digit also after the drag, when it would be a shortcut."""
        return key.isdigit() or (self._drag is not None and key in _TYPED)

    def key(self, context: ToolContext, key: str) -> bool:
        """Take what is typed of corners and ratio while it is dragged; "enter" ends that."""
        if self._drag is None:
            if key.isdigit():
                context.host.refuse(_TOO_LATE)
            return key.isdigit()
        if key == "enter":
            context.drags.release(context.pointer)
            return True
        changed = self._drag.with_key(key)
        if changed is not None:
            self._drag = changed
            context.drags.exchange(context.pointer, changed)
        return changed is not None

    def marks(self, context: ToolContext) -> GestureMarks:
        """Return its numbers beside the pointer, too."""
        marks, drag, pointer = super().marks(context), self._drag, context.pointer
        if drag is None or not context.drags.progress_at(pointer):
            return marks
        return replace(marks, note=Note(pointer.position, drag.readout(pointer), drag.start))

    def hint(self, context: ToolContext) -> Hint:
        """Return what a press beside all handles would do."""
        return Hint(f"{_HINT} · {STEP_KEYS} · V goes back to Select")


def _edited(context: ToolContext) -> Star | None:
    """Return the star that is edited; None where none is."""
    now = formed(context.host.active_view.source)
    return now.form if now is not None and isinstance(now.form, Star) else None


STAR = ToolRecord(
    name="star",
    make=StarTool,
    hint=f"{_HINT}; V or Escape goes back to selecting.",
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
