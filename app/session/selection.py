"""Selected points, selected curves, hovered point and scrub line; each names something that exists."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from app.document.model import Curve
from app.document.selection import followed_curves, followed_points


class Selection:
    """Selection and the like, neither saved nor undone. Methods return whether something is another one now.

    Attributes
    ----------
    points
        Indices of the selected points of the active curve.
    curves
        Indices of the curves that are worked on together; the active one is one of them.
    hovered
        The point under the pointer, or -1.
    scrub
        The t of the scrub line, or None.
    scrub_asked
        Where the person put the scrub line: it stands there as far as the curve goes.
    """

    def __init__(self) -> None:
        self.points: frozenset[int] = frozenset()
        self.curves = frozenset({0})
        self.hovered = -1
        self.scrub: float | None = None
        self.scrub_asked: float | None = None

    def select(self, indices: Collection[int], count: int) -> bool:
        """Select those of the points `indices` that exist among `count`."""
        before = self.points
        self.points = frozenset(int(index) for index in indices if 0 <= index < count)
        return self.points != before

    def hover(self, index: int, count: int) -> bool:
        """Take note that the pointer is over point `index` of `count`, or over none."""
        before, self.hovered = self.hovered, index if 0 <= index < count else -1
        return self.hovered != before

    def scrub_to(self, t: float | None, domain: tuple[float, float] | None) -> bool:
        """Put the scrub line to `t`, or to the end of the `domain` nearer to it; away where there is none."""
        self.scrub_asked, before = t, self.scrub
        self.scrub = None if t is None or domain is None else float(min(max(t, domain[0]), domain[1]))
        return self.scrub != before

    def select_curves(self, indices: Collection[int], active: int, count: int) -> int:
        """Choose those of the curves that exist among `count`; return which of them is the active one.

        That is `active`, or the one nearest to it.
        """
        indices = {index for index in indices if 0 <= index < count}
        if active not in indices:
            active = min(indices, key=lambda index: abs(index - active), default=active)
        self.curves = frozenset({*indices, active})
        return active

    def follow_curves(self, before: Sequence[Curve], after: Sequence[Curve], active: int) -> bool:
        """Choose the same curves where they are now that `before` has become `after`."""
        old = self.curves
        kept = followed_curves(old, before, after) if len(old) > 1 else frozenset[int]()
        self.curves = kept if active in kept else frozenset({active})
        return self.curves != old

    def followed_points(self, before: Curve | None, after: Curve) -> frozenset[int]:
        """Return where the selected points of `before` are in `after`."""
        if not self.points or before is None:
            return frozenset()
        return followed_points(self.points, before.points, after.points)
