"""Basis and cardinal functions of a curve, sampled for the basis panel, and the growth of errors.

The growth of errors of the points is the Lebesgue function Λ(t) and its largest value, the constant Λ. Where
velocities or accelerations are estimated they follow the points, so it is the cardinal functions of the
points that count, Λ(t) = Σ |Cᵢ(t)|. Errors of the data, where estimated derivatives count as given, are
another question: they grow by Σ |Bᵢ₀(t)|, which is 1 for every Hermite curve.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from functools import cached_property, reduce
from itertools import pairwise

import msgspec
import numpy as np

import curvecore
from curvecore import lebesgue_constant
from curvecore.analysis.cardinal import CardinalBasis, by_point
from curvecore.analysis.stability import lebesgue_constants
from curvecore.arithmetic import LARGEST
from curvecore.arrays import FloatArray, IntArray
from curvecore.drag.moved_parameters import MovedParameters

from ..families import Family
from .curve.core_curve import SetDerivative, Sides, moved_with_set, sides_of, unbounded
from .curve.curve_view import CurveView, ParametricCurve
from .geometry import OneSided, crowded_at_ends, one_sided, segment_at

SAMPLES = 400
"""Samples over the domain; one per two or three pixels of a wide panel."""

_MANY = 100
"""Functions of a Lagrange curve from which on those from before a parameter moved are used."""

_MOST_FINE = 400
"""Segments above which each is narrower than a few pixels, and sampled only at its ends and thirds."""

_FINE = 33

_ROUNDS, _FINER, _PEAKS = 3, 9, 16
"""Rounds of finer samples of Λ(t), their number beside each of the highest, and how many these are."""

_MOST_UNEVEN = 65
"""Knots up to which a segment has samples in proportion to its length; above, all have the same number."""

_LEAST_SAMPLES = 17
"""Samples of a segment, however short: its functions are at most of degree 7."""

_MOST_SCALED = 1e300

_FACTORS = ((1.0,), (1.0, 2.5), (1.0, 2.5, 25.0), (1.0, 2.0, 15.0, 250.0))
"""By the number of derivatives of a family, the factors with which B_k ∕ hᵏ reach almost one half.

Of a quintic they peak at 0.20 and 0.017, of a septic at 0.23, 0.029 and 0.0014.
"""


class BasisView(msgspec.Struct, frozen=True, eq=False, dict=True):
    """Basis functions B_ir(t) as the panel draws them.

    Attributes
    ----------
    curve
        A core curve with these functions, one set for each knot.
    owners
        The point that each knot belongs to; the last knot of a closed curve is its first point again.
    t
        Sample parameters, (m,).
    values
        Scaled functions: (m, n, R) for a Lagrange curve; for the piecewise families (m, 2, R), the functions
        of the point before and the point after each sample, all the others being zero there.
    first
        For the piecewise families the index of the first sample of each segment and the end, (n,).
    scales
        The factors of the B_ir, (k, R).
    known
        Computes the functions of a Lagrange curve after a few parameters moved; None where they are few.
    """

    curve: ParametricCurve
    owners: tuple[int, ...]
    t: FloatArray
    values: FloatArray
    first: IntArray | None
    scales: FloatArray
    known: MovedParameters | None = None

    @property
    def kinds(self) -> int:
        """Number of kinds R: position, velocity, acceleration."""
        return int(self.scales.shape[1])

    @property
    def count(self) -> int:
        """Number of knots."""
        return len(self.curve.parameters)

    @property
    def point_count(self) -> int:
        """Number of points: one less than knots, where the last knot is the first point again."""
        return self.count - (self.owners[-1] == 0)

    @property
    def drawn(self) -> range:
        """The knots whose functions are drawn: one of each point, or both where they lie side by side."""
        return range(self.count if self.first is not None or self.is_coarse else self.point_count)

    def function(self, index: int, kind: int) -> tuple[FloatArray, FloatArray]:
        """Return (t, scaled B) of knot `index` and derivative `kind`, where it is not zero."""
        if self.is_coarse:
            t, values = self.fine_functions(index)
            return t, values[:, kind]
        if self.first is None:
            return self.t, self.values[:, index, kind]
        here = self.first[index]
        start = self.first[max(index - 1, 0)]
        end = self.first[min(index + 1, self.count - 1)]
        behind = self.values[start:here, 1, kind]
        ahead = self.values[here:end, 0, kind]
        return self.t[start:end], np.concatenate([behind, ahead])

    def inside_support(self, index: int) -> slice:
        """Return the samples where the function of knot `index` may differ from 0; not if piecewise."""
        return self._inside_supports([index])[0]

    @cached_property
    def supports(self) -> list[slice]:
        """The slices of all knots."""
        return self._inside_supports(range(self.count))

    def _inside_supports(self, knots: Iterable[int]) -> list[slice]:
        low, high = np.array([self._support(knot) for knot in knots]).T
        first, end = np.searchsorted(self.t, low), np.searchsorted(self.t, high, side="right")
        return [slice(*ends) for ends in zip(first.tolist(), end.tolist(), strict=True)]

    def _support(self, knot: int) -> tuple[float, float]:
        # The function of the first point of a closed curve has a part at each end.
        return self.curve.support(knot) if self.point_count == self.count else self.curve.domain

    @property
    def is_coarse(self) -> bool:
        """Whether the samples are too few to show one function by itself."""
        return self.first is not None and self.count > _MOST_FINE

    def fine_functions(self, index: int) -> tuple[FloatArray, FloatArray]:
        """Return (t, scaled B) of knot `index` of a piecewise curve, all kinds (m, R), sampled finely."""
        segments = np.arange(max(index - 1, 0), min(index + 1, self.count - 1))
        t, values = self.fine_segments(segments, _FINE - 1)
        columns = [values[row, :, index - segment] for row, segment in enumerate(segments.tolist())]
        return t.ravel(), np.concatenate(columns)

    @cached_property
    def most_bent(self) -> float:
        """The largest |d²B ∕ ds²| of a scaled function of a piecewise curve, s in 0 … 1 over a segment."""
        unit = self.curve.with_data(np.zeros((2, self.kinds, 2)), [0.0, 1.0])
        bends = unit.basis(np.linspace(0.0, 1.0, _FINE), 2) * np.array(_FACTORS[self.kinds - 1])
        return float(np.abs(bends).max())

    def fine_segments(self, segments: IntArray, chords: int) -> tuple[FloatArray, FloatArray]:
        """Return (t, scaled B) over segments of a piecewise curve, each in so many steps, ends included.

        t is (k, chords + 1); the values are (k, chords + 1, 2, R), of the point before and the point after.
        """
        assert self.curve.is_local
        start, end = self.curve.parameters[segments], self.curve.parameters[segments + 1]
        # The last one lies just before the joint, so that it belongs to this segment.
        t: FloatArray = np.linspace(start, np.nextafter(end, start), chords + 1, axis=1)
        functions = self.curve.local_basis(t.ravel()).values
        scales = np.stack([self.scales[segments], self.scales[segments + 1]], axis=1)
        return t, functions.reshape(*t.shape, 2, self.kinds) * scales[:, None]

    def envelope(self, kind: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return (t, least, greatest value of all functions of one kind there); per segment if coarse."""
        values = self.values[:, :, kind]
        if self.first is None:
            low, high = values.min(axis=1), values.max(axis=1)
            if 2 * self.count > len(self.t):
                # The functions swing faster than they are sampled: without this so would the outline.
                low, high = _spread(np.minimum, low), _spread(np.maximum, high)
            return self.t, low, high
        by_segment = values.reshape(self.count - 1, -1).T
        # Column by column: along a short axis NumPy's reductions take many times as long.
        low, high = reduce(np.minimum, by_segment), reduce(np.maximum, by_segment)
        middles = (self.curve.parameters[:-1] + self.curve.parameters[1:]) / 2
        start, end = self.curve.domain
        t = np.concatenate([[start], middles, [end]])
        return t, np.pad(low, 1, mode="edge"), np.pad(high, 1, mode="edge")

    def extent(self, kinds: Collection[int]) -> tuple[float, float]:
        """Return the least and the greatest value of the functions of these kinds; (0, 0) for none."""
        ends = [self._extents[kind] for kind in self.drawn_kinds(kinds)]
        return (min(low for low, _ in ends), max(high for _, high in ends)) if ends else (0.0, 0.0)

    def drawn_kinds(self, kinds: Collection[int]) -> list[int]:
        """Return the kinds, of these, that the curve has; an only kind is always drawn."""
        return [kind for kind in range(self.kinds) if kind in kinds or self.kinds == 1]

    @cached_property
    def _extents(self) -> list[tuple[float, float]]:
        kinds = [self.values[:, :, kind] for kind in range(self.kinds)]
        return [(float(values.min()), float(values.max())) for values in kinds]

    @cached_property
    def lebesgue_constant(self) -> float:
        """Λ of the points, by finer and finer samples beside the highest; infinite beyond all floats."""
        assert not self.curve.is_local
        t, functions = self.t, self.values
        with np.errstate(over="ignore"):
            for _ in range(_ROUNDS):
                sums = np.abs(functions[:, : self.point_count, 0]).sum(axis=1)
                middle = np.clip(np.argsort(sums)[-_PEAKS:], 1, len(t) - 2)
                t = np.unique(np.linspace(t[middle - 1], t[middle + 1], _FINER))
                functions = _functions(self.curve, t, self.owners)
            return float(np.abs(functions[:, : self.point_count, 0]).sum(axis=1).max())

    def value_at(self, t: float, kind: int) -> FloatArray:
        """Return the scaled functions of one kind at `t`, one for each knot."""
        values = _functions(self.curve, np.array([t]), self.owners)
        return values[0, :, kind] * self.scales[:, kind]


def _spread(combine: np.ufunc, values: FloatArray) -> FloatArray:
    """Combine every sample with the two on either side of it."""
    padded = np.pad(values, 2, mode="edge")
    return reduce(combine, (padded[by : by + len(values)] for by in range(5)))


def basis_view(view: CurveView, previous: BasisView | None = None) -> BasisView | None:
    """Return all basis functions of a curve sampled over its domain; None where there is no curve.

    `previous` lends functions from before a parameter moved: those that do not depend on it, or are many.
    """
    curve = view.basis_curve
    if curve is None or not view.is_current:
        return None
    if previous is not None and _are_idle_moves(curve, previous.curve):
        return msgspec.structs.replace(previous, curve=curve)
    scales = basis_scales(curve, closed=view.source.is_closed)
    count = len(view.source.points)
    owners = tuple(knot % count for knot in range(len(curve.parameters)))
    if curve.is_local:
        return _piecewise_view(curve, owners, scales)
    if len(owners) < _MANY or not curve.is_one_polynomial:
        t = _samples_over(curve)
        return BasisView(curve, owners, t, _functions(curve, t, owners), None, scales)
    return _many_functions(curve, owners, scales, previous)


def _functions(curve: ParametricCurve, t: FloatArray, owners: tuple[int, ...]) -> FloatArray:
    """Return the functions of all knots at t (m,), (m, knots, R): both knots of one point have their sum.

    Those of the first point of a piecewise curve need no sum.
    """
    values = curve.basis(t)
    return values if curve.is_local else by_point(values, max(owners) + 1)[:, list(owners)]


def _are_idle_moves(curve: ParametricCurve, before: ParametricCurve) -> bool:
    """Whether two curves have the same functions: only parameters without effect differ."""
    acts = ~curve.idle_parameters
    return (
        not acts.all()
        and curve.functions_key == before.functions_key
        and np.array_equal(acts, ~before.idle_parameters)
        and np.array_equal(curve.parameters[acts], before.parameters[acts])
    )


def _many_functions(
    curve: ParametricCurve, owners: tuple[int, ...], scales: FloatArray, previous: BasisView | None
) -> BasisView:
    if previous is not None and previous.known is not None and previous.curve.domain == curve.domain:
        values = previous.known.basis(curve)
        if values is not None:
            return BasisView(curve, owners, previous.t, values, None, scales, previous.known)
    t = _samples_over(curve)
    known = MovedParameters(curve, t)
    values = known.basis(curve)
    assert values is not None
    return BasisView(curve, owners, t, values, None, scales, known)


def _samples_over(curve: ParametricCurve) -> FloatArray:
    start, end = curve.domain
    t = crowded_at_ends(start, end, SAMPLES)
    # Just before and at each break, where functions may turn or jump.
    inner = curve.breaks[1:-1]
    return np.sort(np.concatenate([t, inner, np.nextafter(inner, start)])) if len(inner) else t


def segment_samples(knots: FloatArray) -> OneSided:
    """Return samples of every segment, ends included, so that joints are drawn sharply."""
    return one_sided(knots, _sample_counts(np.diff(knots)))


def _piecewise_view(curve: ParametricCurve, owners: tuple[int, ...], scales: FloatArray) -> BasisView:
    t, first = segment_samples(curve.parameters)
    segment, values = curve.local_basis(t)
    values[:, 0] *= scales[segment]
    values[:, 1] *= scales[segment + 1]
    return BasisView(curve, owners, t, values, first, scales)


def _sample_counts(spacing: FloatArray) -> IntArray:
    """Return the number of samples of each segment."""
    if len(spacing) < _MOST_UNEVEN:
        counts: IntArray = np.ceil(SAMPLES * spacing / spacing.sum()).astype(int)
        return np.maximum(counts, _LEAST_SAMPLES)
    count = int(np.clip(4 * SAMPLES // len(spacing), 9, 33)) if len(spacing) < _MOST_FINE else 4
    return np.full(len(spacing), count)


def basis_scales(curve: ParametricCurve, *, closed: bool = False) -> FloatArray:
    """Return the factors that make functions of all kinds readable on one axis, (k, R).

    Functions of derivatives are in proportion to h, h² and so on, powers of the spacing; the longer of a
    knot's two segments stands for h, and no function of a derivative leaves −½ … ½.
    """
    orders = np.arange(curve.jets.shape[1])
    if len(orders) == 1:
        return np.ones((len(curve.parameters), 1))
    spacing = np.zeros(len(curve.parameters) + 1)
    spacing[1:-1] = np.diff(curve.parameters)
    if closed:
        spacing[[0, -1]] = spacing[[-2, 1]]
    longer = np.maximum(spacing[:-1], spacing[1:])
    with np.errstate(divide="ignore", over="ignore", under="ignore"):
        factors: FloatArray = np.array(_FACTORS[len(orders) - 1]) / longer[:, None] ** orders
    # The square of a spacing may underflow; functions that vanish with it are not drawn.
    return np.minimum(factors, _MOST_SCALED)


def basis_formulas(family: Family) -> tuple[str, ...]:
    """Return the formulas of the drawn functions, by kind; h is the longer segment beside the point."""
    if not family.derivatives:
        return ("Lᵢ(t)",) if family.curve_class.is_one_polynomial else ("Bᵢ(t)",)
    factors = _FACTORS[family.derivatives][1:]
    functions = ("B₁ ∕ h", "B₂ ∕ h²", "B₃ ∕ h³")
    return ("B₀", *(f"{factor:g}·{formula}" for factor, formula in zip(factors, functions, strict=False)))


def weights_at(view: CurveView, t: float) -> FloatArray:
    """Return the weight of every point at `t`, with the derivatives that are estimated from it, (n,)."""
    if view.cardinal is not None:
        return np.asarray(view.cardinal.basis(t))
    assert view.basis_curve is not None
    basis = view.basis_curve.basis(np.array([t]))[:, :, 0]
    return np.asarray(by_point(basis, len(view.source.points))[0])


def set_weights_at(view: CurveView, t: float) -> dict[SetDerivative, float]:
    """Return the weights at `t` of the derivatives that were set, with the estimates that follow them.

    Those without an effect there may be left out: beyond a velocity that is set nothing follows.
    """
    assert view.basis_curve is not None
    curve, arrays, segment = view.source, view.arrays, segment_at(view.parameters, t)
    count, orders = len(curve.points), curve.family.derivatives
    is_set = ~np.isnan(arrays.given[:, :, :orders, 0])
    near: set[int] = set()
    for step, knot in ((-1, segment), (1, segment + 1)):
        knots = knot + step * np.arange(count)
        points = knots % count if curve.is_closed else knots[(knots >= 0) & (knots < count)]
        nearest = np.flatnonzero(is_set[points, :, 0].any(axis=1))[:1].sum()
        near.update(points[: max(nearest + 1, orders)].tolist())
    which = [
        SetDerivative(point, order + 1, bool(side))
        for point in sorted(near)
        for side, order in np.argwhere(is_set[point]).tolist()
        if side == 0 or arrays.corners[point]
    ]
    if not which:
        return {}
    before, after = moved_with_set(curve, view.at_knots, view.parameters, arrays, which)
    ends = np.stack([after[segment], before[segment + 1]])
    basis = view.basis_curve.basis(np.array([t]))[0, segment : segment + 2, 1:]
    return dict(zip(which, np.einsum("er,erm->m", basis, ends).tolist(), strict=True))


# Cardinal functions

_MOST_SAMPLED = 64
"""Points up to which every function is sampled; of more, the least and the greatest value at each t."""

_SUPPORT, _FINE = 12, 33
"""Segments to either side of its point in which a function differs visibly from 0; samples of each."""


class CardinalView(BasisView, frozen=True, eq=False, dict=True):
    """Cardinal functions Cᵢ(t) as the panel draws them, one for each knot.

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
        return self.count > _MOST_SAMPLED

    def fine_functions(self, index: int) -> tuple[FloatArray, FloatArray]:
        """Return (t, C) of the point at knot `index`, (m, 1), where it differs visibly from 0."""
        knots = self.curve.parameters[max(index - _SUPPORT, 0) : index + _SUPPORT + 1]
        t = np.concatenate([np.linspace(*ends, _FINE) for ends in pairwise(knots.tolist())])
        return t, self._at(t)[:, [self.owners[index]]]

    def _support(self, knot: int) -> tuple[float, float]:
        return self.curve.domain

    def value_at(self, t: float, kind: int) -> FloatArray:
        """Return the functions at `t`, one for each knot."""
        return self._at(np.array([t]))[0, list(self.owners)]

    def _at(self, t: FloatArray) -> FloatArray:
        assert self.cardinal is not None
        return self.cardinal.basis(t)


def cardinal_view(view: CurveView) -> CardinalView | None:
    """Return the cardinal functions of a piecewise curve sampled over its domain; None without any."""
    curve, cardinal = view.basis_curve, view.cardinal
    if curve is None or cardinal is None:
        return None
    t = segment_samples(curve.parameters).t
    owners = tuple(view.owner(knot) for knot in range(len(curve.parameters)))
    if len(owners) <= _MOST_SAMPLED:
        values = cardinal.basis(t)[:, list(owners)]
    else:
        # All the others are 0 there.
        near = np.pad(cardinal.local(t).values, ((0, 0), (0, 1)))
        values = np.stack([near.min(axis=1), near.max(axis=1)], axis=1)
    scales = np.ones((len(owners), 1))
    return CardinalView(curve, owners, t, values[:, :, None], None, scales, cardinal=cardinal)


# The growth of errors


def growth_at(view: CurveView, t: FloatArray) -> FloatArray:
    """Return Λ(t) of the points of a current curve at t (m,)."""
    return view.cardinal.sums(t) if view.cardinal is not None else t * 0.0 + LARGEST


def growth_of_points(view: CurveView, basis: BasisView | None = None) -> float:
    """Return the Lebesgue constant Λ of the points of a curve; infinite where it is beyond all floats.

    `basis` lends functions, for many take long to compute; those on the screen may belong to another curve.
    """
    if not view.is_current or view.basis_curve is None:
        return math.nan
    return basis.lebesgue_constant if basis is not None and _lends(basis, view) else view.growth


def growth_of_data(view: CurveView, basis: BasisView | None = None) -> float:
    """Return the Lebesgue constant of the data, with velocities and accelerations fixed."""
    if not view.is_current or view.basis_curve is None:
        return math.nan
    if view.basis_curve.is_positive:
        return 1.0
    if basis is not None and _lends(basis, view):
        return basis.lebesgue_constant
    return lebesgue_constant(CardinalBasis(view.basis_curve, closed=view.source.is_closed))


def _lends(basis: BasisView, view: CurveView) -> bool:
    """Whether these are dense functions of this curve: same family, settings and parameters."""
    functions = view.basis_curve
    if functions is None or basis.curve.is_local or basis.curve.functions_key != functions.functions_key:
        return False
    if view.source.is_closed:
        return False  # the samples may be those of an open curve
    return bool(np.array_equal(basis.curve.parameters, view.parameters))


def growths_of_points(views: Sequence[CurveView]) -> list[float]:
    """Return the Lebesgue constants Λ of the points of many current curves, computed together."""
    bases = [view.cardinal for view in views]
    following = [basis for basis in bases if basis is not None and basis.follows]
    constants = map(unbounded, lebesgue_constants(following))
    return [
        math.inf
        if basis is None
        else next(constants)
        if basis.follows
        else unbounded(lebesgue_constant(basis))
        for basis in bases
    ]


# The effect of a parameter

_STEP = 1e-5
"""Step of the differences as a share of the narrower gap: their error is its square."""


def parameter_moves(view: CurveView, piece: int, t: FloatArray) -> FloatArray:
    """Return dc/dt_i at t (m,) of one piece of a current curve, (m, k, 2), with points and set values fixed.

    The basis functions enter in closed form, the estimates by central differences.
    """
    core = view.pieces[piece]
    moves = np.zeros((len(t), len(view.parameters), 2))
    first = sum(len(before.parameters) - 1 for before in view.pieces[:piece])
    moves[:, first : first + len(core.parameters)] = curvecore.parameter_sensitivity(core, t)
    if core.derivatives and core.is_local:
        segment, values = core.local_basis(t)
        # After the knot at the start of the segment, before the one at its end.
        for end, slopes in enumerate(reversed(_slopes(view))):
            at = slopes[:, segment + first + end]
            moves += np.einsum("mr,imrd->mid", values[:, end, 1:], at)
    return moves


def _slopes(view: CurveView) -> Sides:
    """Return the slopes of the derivatives at every knot by each parameter, (i, k, R - 1, 2)."""
    t, gaps = view.parameters, np.diff(view.parameters)
    steps = _STEP * np.minimum(np.append(gaps, np.inf), np.insert(gaps, 0, np.inf))
    changes = []
    for index, step in enumerate(steps.tolist()):
        shift = np.zeros(len(t))
        shift[index] = step
        far, near = (sides_of(view.source, view.at_knots, t + by, view.arrays) for by in (shift, -shift))
        changes.append((np.array(far) - near)[:, :, 1:] / (2.0 * step))
    return Sides(*np.array(changes).swapaxes(0, 1))
