"""Moving and scaling the picture to trace with the mouse."""

from __future__ import annotations

import math

import msgspec

from app.document.edits import EditError
from app.document.image_edits import move_image, scale_image
from app.document.model import Document, ReferenceImage, Vector
from app.tools.machine import DragMachine, Host
from app.tools.pointer import Hint, Hit, Part, Pointer

CORNERS = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
"""The corners of a picture as shares of its width and height, counterclockwise from the lower left."""

_LEAST_FACTOR = 1e-3


def corner_of(image: ReferenceImage, corner: int) -> Vector:
    """Return where a corner of the picture lies."""
    share_x, share_y = CORNERS[corner]
    return (image.x + share_x * image.width, image.y + share_y * image.height)


class MoveImage(msgspec.Struct, frozen=True):
    """Move the picture with the pointer; Shift keeps to one axis."""

    document: Document
    start: Vector
    name: str = "Move image"

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press."""
        by = (pointer.position[0] - self.start[0], pointer.position[1] - self.start[1])
        if pointer.shift:
            by = (by[0], 0.0) if abs(by[0]) >= abs(by[1]) else (0.0, by[1])
        return move_image(self.document, by)


class ScaleImage(msgspec.Struct, frozen=True):
    """Scale the picture by a corner; the opposite corner stays, and so does the aspect."""

    document: Document
    corner: int
    start: Vector
    name: str = "Scale image"

    def document_at(self, pointer: Pointer) -> Document:
        """Let the diagonal follow the pointer as far as it goes along it."""
        image = self.document.image
        assert image is not None
        fixed = (self.corner + 2) % 4
        anchor, tip = corner_of(image, fixed), corner_of(image, self.corner)
        diagonal = (tip[0] - anchor[0], tip[1] - anchor[1])
        by = (pointer.position[0] - self.start[0], pointer.position[1] - self.start[1])
        length = math.hypot(*diagonal)
        # Divided twice, because the square of a length of 1e-200 would be zero.
        along = (by[0] * (diagonal[0] / length) + by[1] * (diagonal[1] / length)) / length
        return scale_image(self.document, CORNERS[fixed], max(1 + along, _LEAST_FACTOR))


class ImageTool:
    """The canvas's gestures while the picture is moved: points are out of reach."""

    def __init__(self, host: Host) -> None:
        self._host = host
        self._machine = DragMachine(host)

    @property
    def is_pressed(self) -> bool:
        """Whether a gesture is in flight."""
        return self._machine.is_pressed

    def press(self, pointer: Pointer) -> None:
        """Begin a gesture."""
        document, hit = self._host.document, pointer.hit
        if hit is None or document.image is None or document.image.locked:
            self._machine.press(pointer, None)
        elif hit.part is Part.IMAGE_CORNER:
            self._machine.press(pointer, ScaleImage(document, hit.knot, pointer.position))
        else:
            self._machine.press(pointer, MoveImage(document, pointer.position))

    def move(self, pointer: Pointer) -> None:
        """Follow the pointer."""
        self._machine.move(pointer)

    def release(self, pointer: Pointer) -> None:
        """End the gesture."""
        self._machine.release(pointer)

    def cancel(self) -> bool:
        """Drop the gesture in flight; return whether there was one."""
        return self._machine.cancel()

    def forget(self) -> None:
        """Drop the gesture in flight; the document is somebody else's now."""
        self._machine.forget()

    def nudge(self, by: Vector) -> None:
        """Move the picture by a little."""
        document = self._host.document
        if document.image is None or document.image.locked:
            return
        try:
            self._host.commit(move_image(document, by), "Nudge image", run="image")
        except EditError as reason:
            self._host.refuse(str(reason))

    def hover(self, pointer: Pointer) -> Hint:
        """Return what a press here would do."""
        self._host.set_hovered(-1)
        hit = pointer.hit
        if hit is None:
            return Hint("Moving the image · Drag it, or one of its corners to scale it · Escape goes back")
        return _hint_for(hit)


def _hint_for(hit: Hit) -> Hint:
    if hit.part is Part.IMAGE_CORNER:
        return Hint("Drag to scale the image; the opposite corner stays · Escape cancels", grab=True)
    return Hint("Drag to move the image · Shift: along one axis · Arrows: by a pixel", grab=True)
