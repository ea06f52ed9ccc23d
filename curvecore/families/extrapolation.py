"""Parameters outside the domain of a curve, as SciPy's ``extrapolate=`` treats them."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from curvecore.arrays import BoolArray, FloatArray
from curvecore.errors import CurveError

Extrapolate: TypeAlias = bool | Literal["periodic"]


class WithinDomain(NamedTuple):
    """Parameters at which a curve is to be evaluated in place of those asked for.

    Attributes
    ----------
    t : ndarray, shape (m,)
        Inside the domain where `extrapolate` is not True.
    outside : ndarray of bool, shape (m,)
        Where the curve has no value.
    """

    t: FloatArray
    outside: BoolArray


def within_domain(t: FloatArray, domain: tuple[float, float], extrapolate: Extrapolate) -> WithinDomain:
    """Return parameters inside [a, b] that stand for t, (m,).

    "periodic" takes a + (t - a) mod (b - a), which is b by rounding at most: the period is half open, so that
    b itself counts as a. What rounding is left of t - a is that of t.
    """
    first, last = domain
    nowhere = np.zeros(t.shape, dtype=np.bool_)
    if isinstance(extrapolate, str) and extrapolate == "periodic":
        return WithinDomain(np.minimum(first + np.remainder(t - first, last - first), last), nowhere)
    if not isinstance(extrapolate, (bool, np.bool_)):
        raise CurveError(f"extrapolate must be True, False or 'periodic', not {extrapolate!r}")
    if extrapolate:
        return WithinDomain(t, nowhere)
    return WithinDomain(np.clip(t, first, last), (t < first) | (t > last))
