"""Lines cut where others cross them: against closed forms, and against the line that they were."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from curvecore import CurveError, cut_line

KAPPA = 0.5522847498307936


def straight(*places):
    """A line of straight pieces through some places."""
    return np.array([np.linspace(a, b, 4) for a, b in pairwise(np.asarray(places, float))])


def circle():
    """The unit circle of four pieces, from (1, 0) on, counterclockwise."""
    first = np.array([[1, 0], [1, KAPPA], [KAPPA, 1], [0, 1]])
    turns = [np.linalg.matrix_power(np.array([[0, 1], [-1, 0]]), k) for k in range(4)]
    pieces = np.array([first @ turn for turn in turns])
    pieces[-1, 3] = pieces[0, 0]
    return pieces


def test_a_circle_is_cut_where_a_line_crosses_it_and_its_seam_is_no_cut():
    parts = cut_line(circle(), [straight((-2, 0.6), (2, 0.6))], closed=True)
    assert len(parts) == 2
    for part, other in zip(parts, reversed(parts), strict=True):
        assert part[-1, 3] == pytest.approx(other[0, 0], abs=1e-14)
        assert abs(part[0, 0, 1] - 0.6) < 1e-12
        # The cubic circle is rounder than the true one by 2.7e-4 at most.
        assert abs(abs(part[0, 0, 0]) - 0.8) < 4e-4
    assert sum(map(len, parts)) == 6


@pytest.mark.parametrize("seed", range(20))
def test_parts_end_to_end_are_the_line(seed):
    rng = np.random.default_rng(seed)
    ends = rng.uniform(-1, 1, (5, 2))
    line = np.array([[a, *rng.uniform(-1, 1, (2, 2)), b] for a, b in pairwise(ends)])
    knives = [straight(*rng.uniform(-1, 1, (3, 2))) for _ in range(3)]
    parts = cut_line(line, knives)
    assert (parts[0][0, 0] == line[0, 0]).all()
    assert (parts[-1][-1, 3] == line[-1, 3]).all()
    for before, after in pairwise(parts):
        assert np.abs(before[-1, 3] - after[0, 0]).max() < 1e-13
        assert min(_distance(after[0, 0], piece) for knife in knives for piece in knife) < 1e-8
    # A second method: signs of dense samples on either side of each straight piece.
    s = np.linspace(0, 1, 4001)[:, None]
    dense = np.concatenate(
        [
            (1 - s) ** 3 * p[0] + 3 * s * (1 - s) ** 2 * p[1] + 3 * s * s * (1 - s) * p[2] + s**3 * p[3]
            for p in line
        ]
    )
    assert len(parts) - 1 == sum(_crossings(dense, piece) for knife in knives for piece in knife)


def _distance(place, piece):
    (a, b), way = piece[[0, 3]], piece[3] - piece[0]
    share = np.clip((place - a) @ way / (way @ way), 0, 1)
    return np.hypot(*(a + share * way - place)) if len(b) else 0.0


def _crossings(dense, piece):
    a, way = piece[0], piece[3] - piece[0]
    side = (dense - a) @ np.array([-way[1], way[0]])
    along = (dense - a) @ way / (way @ way)
    changes = np.flatnonzero(side[1:] * side[:-1] < 0)
    return int(((along[changes] > 0) & (along[changes] < 1)).sum())


def test_a_joint_of_the_knife_on_the_line_cuts_it_once():
    parts = cut_line(straight((0, 0), (4, 0)), [straight((1, 1), (2, 0), (3, -1))])
    assert [part[[0, -1], [0, 3], 0].round(9).tolist() for part in parts] == [[0, 2], [2, 4]]


def test_what_runs_along_it_cuts_at_both_of_its_ends():
    parts = cut_line(straight((0, 0), (4, 0)), [straight((1, 0), (3, 0))])
    assert [part[[0, -1], [0, 3], 0].round(9).tolist() for part in parts] == [[0, 1], [1, 3], [3, 4]]


def test_a_line_that_only_begins_or_ends_on_another_is_whole():
    knives = [straight((0, -1), (0, 1)), straight((4, -1), (4, 1))]
    (part,) = cut_line(straight((0, 0), (4, 0)), knives)
    assert part[[0, -1], [0, 3], 0].tolist() == [0, 4]


def test_a_loop_that_begins_and_ends_on_the_knife_is_a_part():
    # x = t³ − t, y = t² from −2 to 2 crosses itself at (0, 1), where t is −1 and 1.
    loop = np.array([[[-6, 4], [26 / 3, -4 / 3], [-26 / 3, -4 / 3], [6, 4]]])
    parts = cut_line(loop, [straight((-0.5, 0.5), (0.5, 1.5))])
    ends = [part[place] for part in parts for place in ((0, 0), (-1, 3))]
    assert np.abs(np.array(ends) - [[-6, 4], [0, 1], [0, 1], [0, 1], [0, 1], [6, 4]]).max() < 1e-6


def test_nothing_that_cuts_leaves_the_line_as_it_was():
    line = circle()
    (part,) = cut_line(line, [straight((2, 2), (3, 3))], closed=True)
    assert part.tolist() == line.tolist()
    (alone,) = cut_line(line, [])
    assert alone.tolist() == line.tolist()


def test_a_closed_line_has_to_end_where_it_begins():
    with pytest.raises(CurveError, match="must end where it begins"):
        cut_line(straight((0, 0), (1, 0)), [], closed=True)
    with pytest.raises(CurveError, match=r"others\[1\] must have the shape"):
        cut_line(circle(), [circle(), [[0.0, 1.0]]])
