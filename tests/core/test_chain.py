"""Curves end to end."""

from __future__ import annotations

import numpy as np
import pytest

from curvecore import Chain, CurveError, HermiteCurve, LagrangeCurve, cubic_path, flatten_parameters
from curvecore.families.chain import joint_of_row

T = np.array([0.0, 1.0, 2.5, 3.0, 4.0])
POINTS = np.array([[0, 0], [1, 2], [3, 1], [4, 4], [5, 0]], dtype=float)
VELOCITIES = np.array([[1, 1], [2, 0], [0, -1], [1, 3], [0, 0]], dtype=float)


def corner_at_two() -> Chain:
    after = VELOCITIES[2:].copy()
    after[0] = (2.0, 2.0)
    return Chain([HermiteCurve(POINTS[:3], VELOCITIES[:3], T[:3]), HermiteCurve(POINTS[2:], after, T[2:])])


def test_a_chain_of_the_halves_of_a_curve_is_that_curve():
    whole = HermiteCurve(POINTS, VELOCITIES, T)
    halves = Chain(
        [HermiteCurve(POINTS[:3], VELOCITIES[:3], T[:3]), HermiteCurve(POINTS[2:], VELOCITIES[2:], T[2:])]
    )
    t = np.linspace(-0.5, 4.5, 101)
    for order in range(4):
        assert np.array_equal(halves.evaluate(t, order), whole.evaluate(t, order))
    assert np.array_equal(halves.parameters, T)
    assert np.array_equal(halves.points, POINTS)
    assert halves.domain == whole.domain


def test_the_basis_and_the_data_give_the_curve_also_at_a_corner():
    chain = corner_at_two()
    t = np.array([-0.2, 0.0, 0.7, 2.4999, 2.5, 2.6, 4.0, 4.1])
    for order in range(3):
        together = np.einsum("mir,ird->md", chain.basis(t, order), chain.jets)
        # Both sum the same few terms of size up to some hundred in another order.
        assert together == pytest.approx(chain.evaluate(t, order), abs=1e-12)
    assert joint_of_row(chain).tolist() == [0, 1, 2, 2, 3, 4]


def test_at_a_corner_the_later_piece_counts():
    chain = corner_at_two()
    assert chain.evaluate(2.5).tolist() == [3.0, 1.0]
    assert chain.evaluate(2.5, 1).tolist() == [2.0, 2.0]
    assert chain.evaluate(np.nextafter(2.5, 0), 1) == pytest.approx([0.0, -1.0], abs=1e-12)


def test_with_jets_puts_new_data_on_the_same_parameters():
    chain = corner_at_two()
    moved = chain.with_jets(chain.jets + np.array([[1.0, 2.0], [0.0, 0.0]]))
    assert moved.evaluate(1.3) == pytest.approx(chain.evaluate(1.3) + np.array([1.0, 2.0]), abs=1e-14)


def test_flattening_and_paths_go_through_every_corner():
    chain = corner_at_two()
    assert set(T) <= set(flatten_parameters(chain, 0.01))
    path = cubic_path(chain, 0.01)
    assert path.deviation == 0.0
    assert len(path.control_points) == 4
    assert path.parameters.tolist() == T.tolist()


def test_pieces_that_do_not_meet_are_refused():
    first = LagrangeCurve([[0.0], [1.0]], [0.0, 1.0])
    second = LagrangeCurve([[0.0], [1.0]], [1.5, 2.0])
    with pytest.raises(CurveError, match=r"pieces\[1\] must begin at t = 1.0"):
        Chain([first, second])
    with pytest.raises(CurveError, match="at least one curve"):
        Chain([])
    with pytest.raises(CurveError, match="jets of the shape"):
        Chain([first, HermiteCurve([[0.0], [1.0]], [[0.0], [1.0]], [1.0, 2.0])])
