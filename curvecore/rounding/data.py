"""Data of a curve that is computed by the methods of `rounding`."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray, IntArray, parameter_array, stacked_jets
from curvecore.errors import CurveError
from curvecore.rounding.rounded_data import round_significant

_NAMES = ("velocities", "accelerations", "jerks")


class Data(NamedTuple):
    """Checked data of a curve.

    Attributes
    ----------
    parameters : ndarray, shape (n,)
    jets : ndarray, shape (n, R, dim)
        R = 1 for one polynomial, 2 and 3 for piecewise Hermite curves.
    """

    parameters: FloatArray
    jets: FloatArray

    @classmethod
    def of(cls, points: ArrayLike, parameters: ArrayLike, *derivatives: ArrayLike | None) -> Self:
        """Return checked data; the derivatives are velocities, accelerations and jerks."""
        given = dict(zip(_NAMES, derivatives, strict=True))
        jets = stacked_jets(points, **{name: values for name, values in given.items() if values is not None})
        for below, above in pairwise(_NAMES):
            if given[below] is None and given[above] is not None:
                raise CurveError(f"{above} need {below} beside them")
        return cls(parameter_array(parameters, len(jets)), jets)

    def rounded(self, digits: int) -> Self:
        """Return data of so many significant digits; raise CurveError where that makes parameters equal."""
        parameters = round_significant(self.parameters, digits)
        equal = np.flatnonzero(np.diff(parameters) <= 0)
        if len(equal):
            first = int(equal[0])
            raise CurveError(f"to {digits} digits parameters[{first}] and parameters[{first + 1}] are equal")
        return type(self)(parameters, round_significant(self.jets, digits))

    def segments(self, t: FloatArray) -> IntArray:
        """Return the polynomial that counts at each t."""
        if self.jets.shape[1] == 1:
            return np.zeros(len(t), dtype=np.intp)
        return np.searchsorted(self.parameters[1:-1], t, side="right")

    def stretch(self, segment: int) -> tuple[FloatArray, FloatArray]:
        """Return the parameters and jets that make a polynomial."""
        if self.jets.shape[1] == 1:
            return self.parameters, self.jets
        return self.parameters[segment : segment + 2], self.jets[segment : segment + 2]
