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
        return self.divided(2)

    def divided(self, count: int) -> Arcs:
        """Return a power of two of equal parts of every arc, one after the other."""
        share = np.arange(count + 1) / count
        cuts = (1.0 - share) * self.start[:, None] + share * self.end[:, None]
        return Arcs(subdivided(self.controls, count), cuts[:, :-1].ravel(), cuts[:, 1:].ravel())


def joined_arcs(parts: Iterable[Arcs]) -> Arcs:
    """Return the arcs of all parts."""
    return Arcs(*(np.concatenate(column) for column in zip(*parts, strict=True)))
