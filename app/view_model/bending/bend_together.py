"""A pull divided: one part bends the curve, the other takes it along as a whole.

Where a rule gives the parameters, c(t*) answers to a bend u = (ux, uy) with some F(u), not with u, and far
away there may be no u at all with the answer that is wanted. Every rule lets a shift m of all points pass
unchanged, though, so u and m = Δ − F(u) together always meet a pull Δ, whatever u. Of these the one of least
norm is wanted,

    a |u|² + 2 b u·m + n |m|²,      a = Σ w_i²,   b = the sum of w_i over the points,   n points,

where the bend changes datum i by w_i u. That is a problem of least squares in two unknowns, solved by the
damped Gauss-Newton method (Nocedal & Wright, Numerical Optimization, 2006, pp. 258–262) with a Jacobian that
begins as differences and is kept up to date by Broyden's rule. It begins from u = 0 every time, so the
result depends on the pull alone and not on the way there; and it may stop early, for every u is exact.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

_STEPS = 3
_FIRST_STAGE = 0.5
_MOST_STAGES = 40  # 3**40 times the curve: beyond, the first of them is a longer one
_SMALL_STEP = 1e-2
_DIFFERENCE = 1e-4
_LEAST_DAMPING, _FIRST_DAMPING = 1e-9, 1e-3


class Shares(msgspec.Struct, frozen=True):
    """A pull divided: what bends the curve, and what shifts all of its points."""

    bend: FloatArray
    shift: FloatArray


class QuadraticCost(msgspec.Struct, frozen=True):
    """The squared norm of a bend u and a shift m together: a |u|² + 2 b u·m + n |m|²."""

    a: float
    b: float
    n: float

    def of(self, u: FloatArray, m: FloatArray) -> float:
        """Return the cost."""
        return float(self.a * (u @ u) + 2 * self.b * (u @ m) + self.n * (m @ m))

    def step(self, u: FloatArray, m: FloatArray, slope: FloatArray, damping: float) -> FloatArray:
        """Return the damped Gauss-Newton step from u, where a bend by du shifts by −slope du less."""
        cross = self.b * slope
        normal = self.a * np.eye(2) - cross - cross.T + self.n * (slope.T @ slope)
        normal[[0, 1], [0, 1]] *= 1 + damping
        (p, q), (_, r) = normal.tolist()
        x, y = (slope.T @ (self.b * u + self.n * m) - self.a * u - self.b * m).tolist()
        determinant = p * r - q * q
        if not determinant > 0.0:
            return np.zeros(2)
        return np.array([(r * x - q * y) / determinant, (p * y - q * x) / determinant])


def divided(
    answer: Callable[[FloatArray], FloatArray | None],
    pull: FloatArray,
    cost: QuadraticCost,
    size: float,
    slope: FloatArray,
) -> Shares:
    """Divide a pull so that bend and shift together are the least change, or nearly.

    Parameters
    ----------
    answer
        The move (2,) of the grabbed point by a bend (2,); None where there is no curve.
    pull
        The move that is wanted, (2,).
    cost
        The norm of a change.
    size
        The size of the curve.
    slope
        From `slope_at_rest`; it serves for every pull.
    """
    search = _Search(answer, cost, slope)
    for share in _stages(float(np.hypot(*pull)) / size):
        search.improve(share * pull)
    return Shares(search.bend, pull - search.answer)


def _stages(length: float) -> list[float]:
    """Return the shares of a pull by which to go: a far pull in steps of three times as far each.

    None where the curve is so small beside the pull that no number says how far that is: it is moved.
    """
    if not 0.0 < length < math.inf:
        return []
    steps = math.ceil(math.log(length / _FIRST_STAGE, 3)) if length > _FIRST_STAGE else 0
    return [3.0**-step for step in range(min(steps, _MOST_STAGES), -1, -1)]


class _Search:
    """The best bend so far, what it does, and the Jacobian there."""

    def __init__(
        self, answer: Callable[[FloatArray], FloatArray | None], cost: QuadraticCost, slope: FloatArray
    ) -> None:
        self._answer, self._cost, self._slope = answer, cost, slope
        self.bend, self.answer = np.zeros(2), np.zeros(2)
        self._damping = _FIRST_DAMPING

    def improve(self, pull: FloatArray) -> None:
        """Take some steps towards the least change that meets `pull`."""
        least = self._cost.of(self.bend, pull - self.answer)
        self._damping = min(self._damping, _FIRST_DAMPING)
        for _ in range(_STEPS):
            step = self._cost.step(self.bend, pull - self.answer, self._slope, self._damping)
            if step @ step <= _SMALL_STEP**2 * (pull @ pull):
                return
            bend = self.bend + step
            answer = self._answer(bend)
            cost = math.inf if answer is None else self._cost.of(bend, pull - answer)
            if answer is not None:
                self._slope = broyden(self._slope, step, answer - self.answer)
            if answer is not None and cost < least:
                self.bend, self.answer, least = bend, answer, cost
                self._damping = max(self._damping / 10, _LEAST_DAMPING)
            else:
                self._damping = max(self._damping, _FIRST_DAMPING) * 100


def slope_at_rest(answer: Callable[[FloatArray], FloatArray | None], size: float) -> FloatArray:
    """Return the Jacobian of `answer` at no bend, by differences; where there is none, the identity."""
    h = _DIFFERENCE * size
    columns = [answer(np.array(way) * h) for way in ((1.0, 0.0), (0.0, 1.0))]
    if columns[0] is None or columns[1] is None:
        return np.eye(2)
    return np.column_stack([columns[0], columns[1]]) / h


def broyden(slope: FloatArray, step: FloatArray, answer: FloatArray) -> FloatArray:
    """Return the Jacobian that also explains that `step` gave `answer`."""
    updated: FloatArray = slope + np.outer(answer - slope @ step, step) / (step @ step)
    return updated
