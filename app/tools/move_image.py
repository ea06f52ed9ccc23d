"""The tool that moves and scales the picture to trace."""

from __future__ import annotations

import math

from ..document.model import Document, ReferenceImage, Vector
from ..document.plane_edits import move_image, scale_image, step_image
from .drag import Drag, along_axis, axis_held, minus
from .pointer import Cursor, Hint, Part, Pointer, Stride
from .tool import Tool, ToolEvent, ToolRecord

CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
"""The corners of a picture as shares of its width and height, counterclockwise from the lower left."""

_LEAST_FACTOR = 1e-3


def corner_of(image: ReferenceImage, corner: int) -> Vector:
    """Return where a corner of the picture lies."""
    share_x, share_y = CORNERS[corner]
    return (image.x + share_x * image.width, image.y + share_y * image.height)


class MoveImage(Drag, frozen=True):
    """Drag of the picture with the pointer; Ctrl or Shift keeps to one axis."""

    start: Vector

    name = "Move image"

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        by = pointer.offset_from(self.start)
        return move_image(self.document, along_axis(by, axis_held(by, pointer)))


class ScaleImage(Drag, frozen=True):
    """Drag of a corner of the picture; the opposite corner stays, and so does the aspect."""

    corner: int
    start: Vector

    name = "Scale image"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the diagonal follow the pointer as far as it goes along it."""
        image = self.document.image
        assert image is not None
        fixed = (self.corner + 2) % 4
        anchor, tip = corner_of(image, fixed), corner_of(image, self.corner)
        diagonal, by = minus(tip, anchor), pointer.offset_from(self.start)
        length = math.hypot(*diagonal)
        # Divided twice, because the square of a length of 1e-200 would be zero.
        along = (by[0] * (diagonal[0] / length) + by[1] * (diagonal[1] / length)) / length
        return scale_image(self.document, CORNERS[fixed], max(1 + along, _LEAST_FACTOR))


class MoveImageTool(Tool):
    """Tool that moves and scales the picture to trace: points are out of reach meanwhile."""

    cursor = Cursor.ARROW
    finds_image = True

    def press(self, event: ToolEvent) -> None:
        """Begin to move the picture, or to scale it by a corner."""
        document, hit, pointer = event.session.document, event.hit, event.pointer
        if hit is None or document.image is None or document.image.locked:
            event.drags.press(pointer, None)
        elif hit.part is Part.IMAGE_CORNER:
            event.drags.press(pointer, ScaleImage(document, hit.knot, pointer.position))
        else:
            event.drags.press(pointer, MoveImage(document, pointer.position))

    def nudge(self, event: ToolEvent, direction: Vector, stride: Stride) -> bool:
        """Move the picture as far as points go by an arrow key."""
        session, way = event.session, event.step_of(stride)
        by = (direction[0] * way, direction[1] * way)
        if session.document.image is None or session.document.image.locked:
            return True
        session.change("Nudge image", lambda document: step_image(document, by), run="image")
        return True

    def hover(self, event: ToolEvent) -> Hint:
        """Return what a press here would do."""
        hit = event.hit
        if hit is None:
            return Hint("Moving the image · Drag it, or one of its corners to scale it · Escape goes back")
        if hit.part is Part.IMAGE_CORNER:
            return Hint("Drag to scale the image; the opposite corner stays · Escape cancels", grab=True)
        return Hint("Drag to move the image · Shift: along one axis · Arrows: by a step", grab=True)


MOVE_IMAGE = ToolRecord(
    name="move_image",
    make=MoveImageTool,
    hint="Drag the image to move it, a corner to scale it; Escape goes back to the points.",
)
