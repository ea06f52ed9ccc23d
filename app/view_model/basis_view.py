"""The basis functions of a curve, sampled for the basis panel."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from app.document.model import Family
from app.view_model.curve_view import CurveView, Floats, Integers, SimpleCurve
from curvecore import HermiteCurve, LagrangeCurve, QuinticHermiteCurve

SAMPLES = 500
"""Samples over the domain; one per two or three pixels of a wide panel."""

_LEAST_SAMPLES = 17
"""Samples of a segment, however short: its functions are at most quintic."""

_PEAK = (1.0, 2.5, 25.0)
"""What makes B_1/h and B_2/h², which peak at 0.20 and 0.017, reach almost one half."""


@dataclass(frozen=True, eq=False)
class BasisView:
    """Basis functions B_ir(t) as the panel draws them.

    Attributes
    ----------
    curve
        A core curve with these functions, one set for each knot.
    owners
        The node that each knot belongs to; the last knot of a closed curve is its first node again.
    t
        Sample parameters, (m,).
    values
        Scaled functions: (m, n, R) for a Lagrange curve; for the piecewise families (m, 2, R), the functions
        of the node before and the node after each sample, all the others being zero there.
    first
        For the piecewise families the index of the first sample of each segment and the end, (n,).
    scales
        What B_ir was multiplied with, (k, R).
    """

    curve: SimpleCurve
    owners: tuple[int, ...]
    t: Floats
    values: Floats
    first: Integers | None
    scales: Floats

    @property
    def kinds(self) -> int:
        """Number of kinds R: position, velocity, acceleration."""
        return int(self.scales.shape[1])

    @property
    def count(self) -> int:
        """Number of knots."""
        return len(self.curve.parameters)

    def function(self, index: int, kind: int) -> tuple[Floats, Floats]:
        """Return (t, scaled B) of knot `index` and derivative `kind`, where it is not zero."""
        if self.first is None:
            return self.t, self.values[:, index, kind]
        here = self.first[index]
        start = self.first[max(index - 1, 0)]
        end = self.first[min(index + 1, self.count - 1)]
        behind = self.values[start:here, 1, kind]
        ahead = self.values[here:end, 0, kind]
        return self.t[start:end], np.concatenate([behind, ahead])

    def extent(self, kinds: Collection[int]) -> tuple[float, float]:
        """Return the least and the greatest value of the functions of these kinds; (0, 0) for none."""
        drawn = self.values[:, :, [kind for kind in range(self.kinds) if kind in kinds]]
        return (float(drawn.min()), float(drawn.max())) if drawn.size else (0.0, 0.0)

    @cached_property
    def lebesgue_constant(self) -> float:
        """The largest sum of |B_i0| over the samples: the Lebesgue constant as far as can be drawn."""
        return float(np.abs(self.values[:, :, 0]).sum(axis=1).max())

    def value_at(self, t: float, kind: int) -> Floats:
        """Return the scaled functions of one kind at `t`, one for each knot."""
        values: Floats = self.curve.basis(np.array([t]))[0, :, kind] * self.scales[:, kind]
        return values


def basis_view(view: CurveView) -> BasisView | None:
    """Sample all basis functions of a curve over its domain; None where there is no curve."""
    curve = view.skeleton
    if curve is None or not view.is_current:
        return None
    scales = basis_scales(curve)
    owners = tuple(view.owner(knot) for knot in range(len(curve.parameters)))
    if isinstance(curve, LagrangeCurve):
        t = np.linspace(*curve.domain, SAMPLES)
        return BasisView(curve, owners, t, curve.basis(t) * scales, None, scales)
    return _piecewise_view(curve, owners, scales)


def _piecewise_view(
    curve: HermiteCurve | QuinticHermiteCurve, owners: tuple[int, ...], scales: Floats
) -> BasisView:
    """Sample every segment, ends included, so that joints are drawn as sharp as they are."""
    knots = curve.parameters
    spacing = np.diff(knots)
    counts = np.maximum(np.ceil(SAMPLES * spacing / spacing.sum()), _LEAST_SAMPLES).astype(int)
    first = np.concatenate([[0], np.cumsum(counts)])
    segment = np.repeat(np.arange(len(spacing)), counts)
    s = (np.arange(first[-1]) - first[segment]) / (counts[segment] - 1)
    t = knots[segment] + s * spacing[segment]
    # The last sample of a segment lies a hair before the joint, so that it is counted to that segment.
    t[first[1:] - 1] = np.nextafter(knots[1:], knots[:-1])
    t[-1] = knots[-1]
    values = curve.local_basis(t).values
    values[:, 0] *= scales[segment]
    values[:, 1] *= scales[segment + 1]
    return BasisView(curve, owners, t, values, first, scales)


def basis_scales(curve: SimpleCurve) -> Floats:
    """Return the factors that make functions of all kinds readable on one axis, (k, R).

    Velocity functions are in proportion to the spacing h, acceleration functions to h²; the longer of a
    knot's two segments stands for h, and no function of a derivative leaves −½ … ½.
    """
    spacing = np.diff(curve.parameters)
    longer = np.maximum(np.append(spacing, 0.0), np.insert(spacing, 0, 0.0))
    orders = np.arange(curve.jets.shape[1])
    factors: Floats = np.array(_PEAK[: len(orders)]) / longer[:, None] ** orders
    return factors


def basis_formulas(family: Family) -> tuple[str, ...]:
    """Return what is drawn of each kind, as formulas; h stands for the longer segment beside the point."""
    if family is Family.LAGRANGE:
        return ("Lᵢ(t)",)
    return ("B₀", "2.5·B₁ ∕ h", "25·B₂ ∕ h²")[: family.derivatives + 1]


def weights_at(view: CurveView, t: float) -> Floats:
    """Return the weight of every node's position at `t`, (n,)."""
    assert view.skeleton is not None
    return view.by_node(view.skeleton.basis(np.array([t]))[0, :, 0])
