"""The tool that moves and scales the reference image."""

from __future__ import annotations

import math

from ..document.model import Document, ReferenceImage, Vector
from ..document.plane_edits import move_image, scale_image, step_image
from .nudge import DIRECTIONS
from .pointer import Cursor, Hint, Part, Pointer, along_axis, axis_held, minus
from .tool import Drag, Gesture, Tool, ToolEvent, ToolRecord

CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
"""The corners of an image as shares of its width and height, counterclockwise from the lower left."""

_LEAST_FACTOR = 1e-3


def corner_of(image: ReferenceImage, corner: int) -> Vector:
    """Return the position of a corner of the image."""
    share_x, share_y = CORNERS[corner]
    return (image.x + share_x * image.width, image.y + share_y * image.height)


class MoveImage(Drag, kw_only=True):
    """Drag of the image with the pointer. Ctrl or Shift keeps to one axis."""

    start: Vector

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the image moved by the whole offset from the press."""
        offset = pointer.offset_from(self.start)
        return move_image(self.document, along_axis(offset, axis_held(offset, pointer)))

    def undo_text(self, pointer: Pointer) -> str:
        """Return the name of the step."""
        return "Move image"


class ScaleImage(Drag, kw_only=True):
    """Drag of a corner of the image; the opposite corner and the aspect stay."""

    corner: int
    start: Vector

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the diagonal as long as the pointer has moved along it."""
        image = self.document.image
        assert image is not None
        fixed = (self.corner + 2) % 4
        anchor, tip = corner_of(image, fixed), corner_of(image, self.corner)
        diagonal, offset = minus(tip, anchor), pointer.offset_from(self.start)
        length = math.hypot(*diagonal)
        # Divided twice, because the square of a length of 1e-200 would be zero.
        along = (offset[0] * (diagonal[0] / length) + offset[1] * (diagonal[1] / length)) / length
        return scale_image(self.document, CORNERS[fixed], max(1 + along, _LEAST_FACTOR))

    def undo_text(self, pointer: Pointer) -> str:
        """Return the name of the step."""
        return "Scale image"


class MoveImageTool(Tool):
    """Tool that moves and scales the reference image: points are out of reach meanwhile."""

    cursor = Cursor.ARROW
    hits = frozenset({Part.IMAGE, Part.IMAGE_CORNER})
    edits_points = False

    def press(self, event: ToolEvent) -> Gesture | None:
        """Begin to move the image, or to scale it by a corner."""
        document, hit, start = event.session.document, event.hit, event.pointer.position
        if hit is None or document.image is None or document.image.locked:
            return None
        if hit.part is Part.IMAGE_CORNER:
            return ScaleImage(document=document, corner=hit.knot, start=start)
        return MoveImage(document=document, start=start)

    def key(self, event: ToolEvent, key: str) -> bool:
        """Move the image by an arrow key as far as points move."""
        if key not in DIRECTIONS:
            return False
        (x, y), step, image = DIRECTIONS[key], event.key_step(), event.session.document.image
        if image is not None and not image.locked:
            by = (x * step, y * step)
            event.session.change("Nudge image", lambda document: step_image(document, by), run="image")
        return True

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint."""
        hit = event.hit
        if hit is None:
            return Hint("Drag the image to move it, a corner to scale it · Escape returns to the points")
        if hit.part is Part.IMAGE_CORNER:
            return Hint("Drag to scale the image; the opposite corner stays · Escape cancels", grab=True)
        return Hint("Drag to move the image · Shift: along one axis · Arrows: by a step", grab=True)


MOVE_IMAGE = ToolRecord(
    name="move_image",
    make=MoveImageTool,
    hint="Drag the image to move it, a corner to scale it; Escape returns to the points.",
)
