"""The effect of one parameter on a curve whose velocities are estimated from the parameters, too."""

from __future__ import annotations

import numpy as np

import curvecore
from curvecore.arrays import FloatArray

from ..curve.core_curve import Sides, sides_of
from ..curve.curve_view import CurveView

_STEP = 1e-5
"""Step of the differences as a share of the narrower gap: what is left out is its square."""


def parameter_moves(view: CurveView, piece: int, t: FloatArray) -> FloatArray:
    """Return dc/dt_i at t (m,) of one piece of a current curve, (m, k, 2): points and what was set stay.

    The basis functions enter in closed form, the estimates by central differences.
    """
    core = view.pieces[piece]
    moves = np.zeros((len(t), len(view.parameters), 2))
    first = sum(len(each.parameters) - 1 for each in view.pieces[:piece])
    moves[:, first : first + len(core.parameters)] = curvecore.parameter_sensitivity(core, t)
    if core.derivatives and core.is_local:
        segment, values = core.local_basis(t)
        # After the knot at the start of the segment, before the one at its end.
        for end, slopes in enumerate(reversed(_slopes(view))):
            at = slopes[:, segment + first + end]
            moves += np.einsum("mr,imrd->mid", values[:, end, 1:], at)
    return moves


def _slopes(view: CurveView) -> Sides:
    """Return what each parameter i does to the derivatives before and after every knot, (i, k, R - 1, 2)."""
    t, gaps = view.parameters, np.diff(view.parameters)
    steps = _STEP * np.minimum(np.append(gaps, np.inf), np.insert(gaps, 0, np.inf))
    changes = []
    for index, step in enumerate(steps.tolist()):
        shift = np.zeros(len(t))
        shift[index] = step
        far, near = (sides_of(view.source, view.at_knots, t + by, view.arrays) for by in (shift, -shift))
        changes.append((np.array(far) - near)[:, :, 1:] / (2.0 * step))
    return Sides(*np.array(changes).swapaxes(0, 1))
