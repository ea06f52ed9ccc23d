"""Bezier arcs of a curve that are sorted out and halved, as searches do."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from curvecore.arrays import BoolArray, FloatArray, IntArray
from curvecore.bezier.bernstein_algebra import subdivided


class Arcs(NamedTuple):
    """Stretches of a curve as Bezier arcs.

    Attributes
    ----------
    controls : ndarray, shape (k, degree + 1, dim)
        Control points.
    start, end : ndarray, shape (k,)
        Where each begins and ends, in t or in another measure along the curve.
    """

    controls: FloatArray
    start: FloatArray
    end: FloatArray

    def taken(self, chosen: BoolArray | IntArray) -> Arcs:
        """Return some of the arcs."""
        return Arcs(*(each[chosen] for each in self))

    def halved(self) -> Arcs:
        """Return both halves of every arc, one after the other."""
        middle = 0.5 * self.start + 0.5 * self.end
        return Arcs(
            subdivided(self.controls),
            np.stack((self.start, middle), axis=1).ravel(),
            np.stack((middle, self.end), axis=1).ravel(),
        )


def joined_arcs(parts: Iterable[Arcs]) -> Arcs:
    """Return the arcs of all parts."""
    return Arcs(*(np.concatenate(column) for column in zip(*parts, strict=True)))
