"""Dragging the ticks of the t-rail: one, several, or all on one side."""

from __future__ import annotations

from collections.abc import Sequence

from app.document import words
from app.document.model import Document
from app.document.parameter_edits import set_parameters
from app.tools.drag import Drag
from app.tools.pointer import Pointer

_LEAST_GAP = 1e-3
"""Part of the whole interval that stays between two ticks: it can be seen, and the curve be computed."""


class DragTicks(Drag, frozen=True):
    """Drag parameters along the t-rail, all by the same way; their order is kept.

    Attributes
    ----------
    parameters
        Those in force at the press, one for each knot.
    grabbed
        The knot whose tick was pressed.
    knots
        The knots that move, the grabbed one among them.
    point
        The point of the grabbed knot, for the name of the step.
    start
        The t of the pointer at the press.
    """

    curve: int
    parameters: Sequence[float]
    grabbed: int
    knots: frozenset[int]
    point: int
    start: float

    keys = "E: all ticks on that side"

    @property
    def name(self) -> str:
        """The name of the step."""
        if len(self.knots) == 1:
            return f"Change t of point {self.point}"
        return f"Change t of {len(self.knots)} points"

    def readout(self, pointer: Pointer) -> str:
        """Return where the grabbed tick is, and how many go along."""
        by, moving = self._displacement(pointer)
        text = f"t of point {self.point} = {words.number(self.parameters[self.grabbed] + by)}"
        return f"{text}, {len(moving)} ticks by {words.number(by)}" if len(moving) > 1 else text

    def document_at(self, pointer: Pointer) -> Document:
        """Move by the whole way from the press, as far as the ticks that stay let it.

        With E held every tick from the grabbed one on, towards the side the pointer has moved to from the
        press, goes along: the spacings there stay, and only the gap behind opens.
        """
        by, moving = self._displacement(pointer)
        moved = [t + by if knot in moving else t for knot, t in enumerate(self.parameters)]
        return set_parameters(self.document, self.curve, moved)

    def _displacement(self, pointer: Pointer) -> tuple[float, frozenset[int]]:
        """Return how far the ticks move, and which."""
        by = pointer.position[0] - self.start
        count = len(self.parameters)
        moving = self.knots
        if pointer.ripple:
            moving = frozenset(range(self.grabbed, count) if by > 0 else range(self.grabbed + 1))
        return self._as_far_as_can_be(by, moving), moving

    def _as_far_as_can_be(self, by: float, moving: frozenset[int]) -> float:
        t = self.parameters
        margin = _LEAST_GAP * (t[-1] - t[0])
        for knot in moving:
            if knot > 0 and knot - 1 not in moving:
                gap = t[knot] - t[knot - 1]
                by = max(by, min(margin, gap / 2) - gap)
            if knot < len(t) - 1 and knot + 1 not in moving:
                gap = t[knot + 1] - t[knot]
                by = min(by, gap - min(margin, gap / 2))
        return by
