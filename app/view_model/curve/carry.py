"""How a curve came here from another one: by an affine map that takes the one to the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from curvecore.arrays import FloatArray

from .flattener import Polyline

if TYPE_CHECKING:
    from .curve_view import CurveView

_MOST_TOLERANCES = 2e4
"""Size of a curve in tolerances up to which the whole of it is flattened to be carried along."""


class Carry(msgspec.Struct, frozen=True, eq=False, gc=False):
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

    root: CurveView
    matrix: FloatArray
    shift: FloatArray
    stretch: float

    def polyline(self, tolerance: float) -> Polyline | None:
        """Return the curve as a polyline; None where it is better flattened as far as it is seen."""
        own = tolerance / self.stretch if self.stretch > 0.0 else 0.0
        low, high = self.root.drawn_box
        if not float((high - low).max()) <= _MOST_TOLERANCES * own:
            return None
        return mapped(self.root.flattened(own), self.matrix, self.shift, self.stretch)


def mapped(line: Polyline, matrix: FloatArray, shift: FloatArray, stretch: float) -> Polyline:
    """Return a polyline after a map."""
    return Polyline(line.parameters, line.points @ matrix.T + shift, line.deviation * stretch)
