"""How a curve came here from another one: by an affine map that takes the one to the other."""

from __future__ import annotations

from typing import Generic, TypeVar

import msgspec

from curvecore.arrays import FloatArray

from .flattener import Polyline

Root = TypeVar("Root")


class Carry(msgspec.Struct, Generic[Root], frozen=True, eq=False, gc=False):
    """The map x -> x A^T + b from the curve of a view to another one.

    Attributes
    ----------
    root
        The view, whose curve is none that was carried itself.
    matrix
        A, (2, 2).
    shift
        b, (2,).
    stretch
        By how much the map makes lengths longer at most.
    """

    root: Root
    matrix: FloatArray
    shift: FloatArray
    stretch: float

    def mapped(self, line: Polyline) -> Polyline:
        """Return a polyline of the curve of the view, after the map."""
        points = line.points @ self.matrix.T + self.shift
        return Polyline(line.parameters, points, line.deviation * self.stretch)
