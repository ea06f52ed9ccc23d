"""Pieces of paths that are as short as roundings are none, and their neighbours meet exactly."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.exchange.cubics_in import without_roundings
from app.exchange.svg.reader import read_svg
from app.view_model.cubics import points_of_cubics
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row


def curves_in(data, transform=""):
    body = f'<path d="{data}" transform="{transform}"/>'
    return read_svg(f'<svg xmlns="http://www.w3.org/2000/svg">{body}</svg>'.encode()).document.curves


def positions(curve):
    return [(point.x, -point.y) for point in curve.points]


SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


@each_row(
    ("data", "expected"),
    [
        # The case of the issue: it was refused.
        ("M0 0C1 2 3 4 10 10C20 20 30 5 1e-14 0h0Z", [(0, 0), (10, 10)]),
        # One that is left out, or several, between, at the end, at the start, and of every kind.
        ("M0 0H10l1e-15 1e-15V10H0Z", SQUARE),
        ("M0 0H10l2e-15 0l0 2e-15l-2e-15 0l0 0V10H0Z", SQUARE),
        ("M0 0H10V10H0L1e-15 0l0 1e-15Z", SQUARE),
        ("M0 0H10V10H0L1e-15 0h0h0h0Z", SQUARE),
        ("M0 0H10V10H0L1e-15 0L0 0", SQUARE),
        ("M0 0h1e-15v1e-15L10 0V10H0Z", SQUARE),
        ("M0 0H10c0 1e-15 1e-15 0 1e-15 1e-15V10H0Z", SQUARE),
        ("M0 0H10q1e-15 0 1e-15 1e-15V10H0Z", SQUARE),
        ("M0 0H10a5 5 0 0 1 1e-15 1e-15V10H0Z", SQUARE),
        ("M0 0H10V10H0V1e-15Z", SQUARE),
        # Without Z: a residue closes the outline, as no residue does.
        ("M0 0H10V10H0V1e-15", SQUARE),
        ("M0 0H10V10H0V0", SQUARE),
        # Steps of a third add up to 3e-14 beside the start.
        ("m0 0" + "l.3 .1" * 33 + "l-9.9 -3.3 0 0z", [(k * 0.3, k * 0.1) for k in range(34)]),
        # In small and in large, and far away: what counts is the size of the coordinates.
        ("M0 0H1e-9l1e-24 0V1e-9H0Z", [(1e-9 * x / 10, 1e-9 * y / 10) for x, y in SQUARE]),
        ("M1e6 0h10l1e-10 0v10h-10z", [(1e6 + x, y) for x, y in SQUARE]),
    ],
)
def test_a_piece_as_short_as_roundings_is_left_out(data, expected):
    (curve,) = curves_in(data)
    assert len(curve.points) == len(expected)
    assert np.allclose(positions(curve), expected, rtol=1e-14, atol=3e-14 * np.abs(expected).max())
    assert curve.closed
    core = view_of(curve).curve
    assert (core.evaluate(core.domain[0]) == core.evaluate(core.domain[1])).all()


@each_row(
    ("data", "count"),
    [
        # Loops of no length, whose handles have some.
        ("M0 0H10c1 2 -1 2 0 0V10H0Z", 5),
        ("M0 0H10q1 2 0 0V10H0Z", 5),
        # Short, but no rounding.
        ("M0 0H10l1e-9 0V10H0Z", 5),
        ("M0 0H1e-9l1e-15 0V1e-9H0Z", 5),
        ("M1e6 0h10l1e-6 0v10h-10z", 5),
        # Many that go the same way come to something: each is as short as roundings of all.
        ("M0 0H100" + "l0 1e-12" * 3000 + "V100H0Z", None),
    ],
)
def test_pieces_longer_than_roundings_stay(data, count):
    (curve,) = curves_in(data)
    if count is None:
        up = [y for x, y in positions(curve) if x == 100]
        assert 3 <= len(up) < 200
        assert up[0] == 0
        assert max(up[:-1]) == pytest.approx(3000e-12, abs=100 * 3004 * 2.0**-48)
        assert all(low < high for low, high in pairwise(up))
    else:
        assert len(curve.points) == count


def test_a_piece_that_is_left_out_turns_no_line_and_no_handle():
    """The neighbour begins where the piece did, and is otherwise the same, to a rounding."""
    corner = np.array([10 + 2**-44, 2**-45])
    line = np.array([[0.0, 0.0], [10 / 3, 0.0], [20 / 3, 0.0], [10.0, 0.0]])
    short = np.linspace(line[3], corner, 4)
    # Its handles have no length.
    curve = np.array([corner, corner, [0.0, 10.0], [0.0, 10.0]])
    found = without_roundings(np.array([line, short, curve]), closed=False)
    assert found[0].tolist() == line.tolist()
    assert found[1].tolist() == [[10, 0], [10, 0], [0, 10], [0, 10]]
    found = without_roundings(np.array([curve[::-1], short[::-1], line[::-1]]), closed=False)
    third = [[Fraction(*value.as_integer_ratio()) for value in end] for end in (corner, (0.0, 0.0))]
    exact = [[float((third[0][i] * (3 - k) + third[1][i] * k) / 3) for i in (0, 1)] for k in range(4)]
    assert np.allclose(found[1], exact, rtol=2**-52, atol=0)


number = st.floats(-100, 100).map(lambda value: round(value, 3))
point = st.tuples(number, number)


@given(
    st.lists(st.tuples(point, point, point), min_size=2, max_size=6),
    st.lists(st.tuples(st.integers(0, 6), point), max_size=6),
    st.booleans(),
)
def test_an_outline_with_short_pieces_is_the_outline_without(pieces, short, closed):
    """Pieces of 1e-17 of its size, of any form, put in anywhere, change neither its points nor its form."""
    ends = [(0.0, 0.0), *(end for *_, end in pieces)]
    if closed:
        ends[-1] = ends[0]
    plain = np.array([[a, p, q, b] for (p, q, _), (a, b) in zip(pieces, pairwise(ends), strict=True)])
    size = np.abs(plain).max()
    if np.abs(plain - plain[:, :1]).max(axis=(1, 2)).min() < 1e-6 * size or size == 0:
        return
    made = list(plain)
    for place, (x, y) in short:
        at = made[min(place, len(made)) - 1][3] if place else made[0][0]
        made.insert(place, at + np.array([[0, 0], [x, y], [-y, x], [0, 0]]) * 1e-19 * size)
    assert without_roundings(np.array(made), closed=closed).tolist() == plain.tolist()


def test_rounded_ends_of_an_outline_meet_its_start():
    """Chains of short pieces, with residues, at random: one place begins and ends what is closed."""
    random = np.random.default_rng(9)
    for _ in range(200):
        scale, count = 10.0 ** random.integers(-6, 7), int(random.integers(2, 6))
        corners = random.uniform(-1, 1, (count, 2)) * scale
        residue = random.uniform(-1, 1, (count, 3, 2)) * scale * 2.0**-50
        path = np.concatenate(
            [[corner, *(corner + each)] for corner, each in zip(corners, residue, strict=True)]
        )
        path = np.vstack([path, corners[:1] + residue[0, :1], corners[:1]])
        made = np.array([np.linspace(a, b, 4) for a, b in pairwise(path)])
        kept = without_roundings(made, closed=True)
        assert len(kept) == count
        assert (kept[:, 3] == np.roll(kept[:, 0], -1, axis=0)).all()
        assert (kept[0, 0] == corners[0]).all()
        assert np.abs(kept[:, 0] - corners).max() <= 4 * scale * 2.0**-50


def test_the_shortest_piece_keeps_a_part_of_t():
    """Its speed made it a 1e-17th of the curve's interval: “pieces of too different lengths”."""
    long = [[-1.0, 0.0], [-0.9, 0.5], [-1 / 3, 0.0], [0.0, 0.0]]
    short = [[0.0, 0.0], [4e-17, 0.0], [2e-14, 1e-14], [3e-14, 1e-14]]
    back = [[3e-14, 1e-14], [0.5, 1.0], [0.6, 1.0], [0.7, 1.0]]
    pieces = np.array([long, short, back])
    points = points_of_cubics(pieces, closed=False).points
    t = [each.t for each in points]
    assert all(low < high for low, high in pairwise(t))
    # Its pieces are the same: 3 times the handles per length of t.
    for piece, (one, other) in zip(pieces, pairwise(points), strict=True):
        h = other.t - one.t
        leaving = one.velocity_after if one.corner else one.velocity
        assert np.allclose(np.array(leaving) * h, 3 * (piece[1] - piece[0]), rtol=1e-13, atol=0)
        assert np.allclose(np.array(other.velocity) * h, 3 * (piece[3] - piece[2]), rtol=1e-13, atol=1e-28)


def test_a_large_shift_of_a_file_does_not_hide_its_roundings():
    """Steps of coordinates of a million are rounded by 1e-10, wherever a transform puts them."""
    data = "m1e6 1e6" + "l.1 .7" * 40 + "l-4 -28 1e-11 1e-11z"
    (curve,) = curves_in(data, "translate(-1e6 -1e6)")
    assert (len(curve.points), curve.closed) == (41, True)
    assert math.dist(positions(curve)[-1], (4, 28)) < 1e-8
