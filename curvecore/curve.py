"""What every curve family offers."""

from __future__ import annotations

from typing import Protocol

from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray

__all__ = ["Curve"]


class Curve(Protocol):
    """A parametric curve that is linear in its data.

    c(t) = sum over i, r of B_ir(t) d_ir, where d_i0 = p_i = c(t_i) and, for
    the families that have them, d_i1 = c'(t_i) and d_i2 = c''(t_i), all per
    unit of t. Curves are immutable: their arrays are read-only copies.
    """

    @property
    def points(self) -> FloatArray:
        """The points p_i, shape (n, dim)."""

    @property
    def parameters(self) -> FloatArray:
        """The parameters t_i, shape (n,), strictly increasing."""

    @property
    def jets(self) -> FloatArray:
        """The data d_ir, shape (n, R, dim)."""

    @property
    def domain(self) -> tuple[float, float]:
        """The first and the last parameter."""

    @property
    def degree(self) -> int:
        """The degree of the polynomial, or of each polynomial piece."""

    def evaluate(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return the order-th derivative at t: (dim,) for a scalar, (m, dim) for shape (m,)."""

    def basis(self, t: ArrayLike, order: int = 0) -> FloatArray:
        """Return the order-th derivatives of all B_ir at t, shape (m, n, R)."""

    def with_jets(self, jets: ArrayLike) -> Curve:
        """Return a curve with the same parameters and other data, shape (n, R, dim)."""
