"""The cardinal functions of a curve's points, sampled for the basis panel."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from curvecore.analysis.cardinal import CardinalBasis
from curvecore.arrays import FloatArray

from ..curve.curve_view import CurveView
from .basis_view import BasisView, segment_samples

_MOST_EACH = 64
"""Points up to which every function is sampled; of more, the least and the greatest at each t."""

_SEEN, _FINE = 12, 33
"""Segments to either side of its point in which a function can be told from 0, and samples of each."""


class CardinalView(BasisView, frozen=True, eq=False, dict=True):
    """Cardinal functions Cᵢ(t) as the panel draws them: one of each knot, and no others.

    Attributes
    ----------
    cardinal
        The functions.
    values
        (m, knots, 1); of many points the least and the greatest value at each sample, (m, 2, 1).
    """

    cardinal: CardinalBasis | None = None

    @property
    def is_coarse(self) -> bool:
        """Whether the samples are those of the outline alone."""
        return self.count > _MOST_EACH

    def fine_functions(self, index: int) -> tuple[FloatArray, FloatArray]:
        """Return (t, C) of the point at knot `index`, (m, 1), as far from it as it can be seen."""
        knots = self.curve.parameters[max(index - _SEEN, 0) : index + _SEEN + 1]
        t = np.concatenate([np.linspace(*ends, _FINE) for ends in pairwise(knots.tolist())])
        return t, self._at(t)[:, [self.owners[index]]]

    def _support(self, knot: int) -> tuple[float, float]:
        return self.curve.domain

    def value_at(self, t: float, kind: int) -> FloatArray:
        """Return the functions at `t`, one for each knot."""
        return self._at(np.array([t]))[0, list(self.owners)]

    def _at(self, t: FloatArray) -> FloatArray:
        assert self.cardinal is not None
        values: FloatArray = self.cardinal.basis(t)
        return values


def cardinal_view(view: CurveView) -> CardinalView | None:
    """Sample the cardinal functions of a piecewise curve over its domain; None where there are none."""
    curve, cardinal = view.basis_curve, view.cardinal
    if curve is None or cardinal is None:
        return None
    t = segment_samples(curve.parameters).t
    owners = tuple(view.owner(knot) for knot in range(len(curve.parameters)))
    if len(owners) <= _MOST_EACH:
        values = cardinal.basis(t)[:, list(owners)]
    else:
        # All the others are 0 there.
        near = np.pad(cardinal.local(t).values, ((0, 0), (0, 1)))
        values = np.stack([near.min(axis=1), near.max(axis=1)], axis=1)
    scales = np.ones((len(owners), 1))
    return CardinalView(curve, owners, t, values[:, :, None], None, scales, cardinal=cardinal)
