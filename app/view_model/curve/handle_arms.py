"""Handles as values: those of many points at once, each in its arm."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...document.model import Vector


class Handle(msgspec.Struct, frozen=True):
    """One handle of a point.

    Attributes
    ----------
    kind
        The order of the derivative: 1 for a velocity.
    ahead
        Whether it belongs to the segment after the point.
    position
        Its place in the plane.
    anchor
        The beginning of the line to it: the point, or the handle of the derivative before.
    explicit
        Whether the person set the value; otherwise a rule estimates it.
    index
        The point that it belongs to.
    """

    kind: int
    ahead: bool
    position: Vector
    anchor: Vector
    explicit: bool
    index: int = 0


class Handles(msgspec.Struct, frozen=True, eq=False):
    """Handles of points, in arms: those on one side of a point, each hanging on the one before.

    Attributes
    ----------
    indices, ahead
        The point of each arm, and whether the arm lies on the segment after it; (a,).
    places
        The point and then the handles of its arm, by the orders of the derivatives, (a, 1 + orders, 2).
    explicit
        Whether the person set the derivatives, (a, orders).
    """

    indices: IntArray
    ahead: BoolArray
    places: FloatArray
    explicit: BoolArray

    def __len__(self) -> int:
        return self.explicit.size

    def __getitem__(self, number: int) -> Handle:
        arm, order = divmod(number, self.explicit.shape[1])
        (x0, y0), (x, y) = self.places[arm, order : order + 2].tolist()
        side, is_explicit = bool(self.ahead[arm]), bool(self.explicit[arm, order])
        return Handle(order + 1, side, (x, y), (x0, y0), is_explicit, int(self.indices[arm]))

    def __iter__(self) -> Iterator[Handle]:
        return map(self.__getitem__, range(len(self)))

    @property
    def positions(self) -> FloatArray:
        """Their places in the plane, one arm after the other, (k, 2)."""
        return self.places[:, 1:].reshape(-1, 2)

    @property
    def lines(self) -> FloatArray:
        """The lines from what they hang on, (k, 4)."""
        return np.concatenate([self.places[:, :-1], self.places[:, 1:]], axis=2).reshape(-1, 4)

    def of_velocities(self) -> Handles:
        """Return the handles of the velocities alone."""
        return Handles(self.indices, self.ahead, self.places[:, :2], self.explicit[:, :1])

    def of_arms(self, which: BoolArray | slice) -> Handles:
        """Return the handles of some of the arms."""
        return Handles(self.indices[which], self.ahead[which], self.places[which], self.explicit[which])


NO_HANDLES = Handles(
    np.empty(0, dtype=np.intp), np.empty(0, dtype=bool), np.empty((0, 2, 2)), np.empty((0, 1), dtype=bool)
)


class PointSides(msgspec.Struct, frozen=True, eq=False):
    """Sides of points: which points, and whether the side ahead of them is meant; (a,) each."""

    indices: IntArray
    ahead: BoolArray


NO_SIDES = PointSides(np.empty(0, dtype=np.intp), np.empty(0, dtype=np.bool_))
