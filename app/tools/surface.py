"""What a tool can ask of the plot that it works on."""

from __future__ import annotations

from typing import Protocol

from .pointer import Hit, Pointer


class Finder(Protocol):
    """What a tool finds on the canvas besides the curve that is edited."""

    finds_other_curves: bool
    finds_guides: bool
    finds_image: bool


class Surface:
    """What tools work on: by default nothing lies anywhere.

    A further question is a method here, answered by the plots that know; tools ask ``context.surface``.
    """

    def hit(self, pointer: Pointer, tool: Finder) -> Hit | None:
        """Return what a tool hits at the pointer."""
        return None

    def locked_at(self, pointer: Pointer) -> int:
        """Return the place of the locked curve at the pointer, which presses go through; −1 for none."""
        return -1

    def grid_spacing(self) -> float:
        """Return the spacing of the grid at the present zoom."""
        return 1.0
