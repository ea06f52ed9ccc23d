"""What strokes cover, and regions offset by a distance: against closed forms and distances of samples."""

import math

import numpy as np
import pytest

from curvecore import CurveError, Region, StrokeCap, StrokeJoin, dashed, offset, stroked

LINE = [[[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [6.0, 0.0]]]
ELBOW = [*LINE, [[6.0, 0.0], [6.0, 2.0], [6.0, 4.0], [6.0, 6.0]]]
LINES = {
    "S": [[[0, 0], [9, 6], [-5, 6], [4, 0]]],
    "loop": [[[0, 0], [12, 8], [-8, 8], [4, 0]]],
    "cusp": [[[0, 0], [4, 4], [0, 4], [4, 0]]],
    "hairpin": [[[0, 0], [0, 5], [0.2, 5], [0.2, 0]]],
    "at rest at its ends": [[[0, 0], [0, 0], [5, 1], [5, 1]], [[5, 1], [5, 1], [3, 5], [3, 5]]],
}
BOX = Region.of_polygon([[0, 0], [4, 0], [4, 4], [0, 4]])


@pytest.mark.parametrize(
    ("cap", "area"),
    [(StrokeCap.BUTT, 12.0), (StrokeCap.SQUARE, 16.0), (StrokeCap.ROUND, 12.0 + math.pi)],
)
def test_caps(cap, area):
    # Round ones are cubic: 4.2e-6 of the radius too large at eighths of a circle.
    assert stroked([LINE], 2.0, tolerance=1e-6, cap=cap).area == pytest.approx(area, rel=1e-5)


@pytest.mark.parametrize(
    ("join", "limit", "corner"),
    [
        (StrokeJoin.MITER, 4.0, 1.0),
        (StrokeJoin.MITER, 1.0, 0.5),
        (StrokeJoin.BEVEL, 4.0, 0.5),
        (StrokeJoin.ROUND, 4.0, math.pi / 4.0),
    ],
)
def test_joins(join, limit, corner):
    """Two bars of 6 x 2 that share a square of 1 on the inner side of their corner."""
    found = stroked([ELBOW], 2.0, tolerance=1e-6, join=join, cap=StrokeCap.BUTT, miter_limit=limit)
    assert found.area == pytest.approx(24.0 - 1.0 + corner, rel=1e-5)


@pytest.mark.parametrize("width", [0.2, 1.0, 3.0])
@pytest.mark.parametrize("name", LINES)
def test_a_round_stroke_covers_what_is_nearer_than_half_its_width(name, width):
    line = np.array(LINES[name], dtype=float)
    found = stroked([line], width, tolerance=1e-4)
    s = np.linspace(0.0, 1.0, 4001)
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)
    samples = (weights @ line).reshape(-1, 2)
    places = np.random.default_rng(1).uniform(-4.0, 8.0, (500, 2))
    away = np.abs(places[:, None] - samples)
    away = np.hypot(away[..., 0], away[..., 1]).min(axis=1)
    # Not where the tolerance, or the distance of samples, leaves it open.
    clear = np.abs(away - width / 2.0) > 5e-3
    assert clear.sum() > 400
    assert (found.contains(places[clear]) == (away[clear] < width / 2.0)).all()
    assert all(np.abs(np.roll(each[:, 0], -1, axis=0) - each[:, 3]).max() == 0.0 for each in found.contours)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
def test_the_outline_keeps_the_tolerance(tolerance):
    """Every place of the outline of a smooth arch is half the width from it; fewer pieces for less."""
    arch = np.array([[[0.0, 0.0], [0.0, 4.0], [6.0, 4.0], [6.0, 0.0]]])
    (contour,) = stroked([arch], 1.0, tolerance=tolerance, cap=StrokeCap.BUTT).contours
    s = np.linspace(0.0, 1.0, 20001)
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)
    samples = weights @ arch[0]
    sides = [
        each for each in contour if np.ptp(each[:, 1]) > 0.0 and np.abs(np.diff(each, 2, axis=0)).max() > 0.01
    ]
    away = np.concatenate([weights[::1000] @ each for each in sides])
    distance = np.abs(away[:, None] - samples)
    distance = np.hypot(distance[..., 0], distance[..., 1]).min(axis=1)
    assert np.abs(distance - 0.5).max() <= tolerance + 1e-7
    assert len(sides) <= 4 * (tolerance ** (-1 / 5))


@pytest.mark.parametrize(
    ("distance", "join", "area"),
    [
        (1.0, StrokeJoin.MITER, 36.0),
        (1.0, StrokeJoin.BEVEL, 34.0),
        (1.0, StrokeJoin.ROUND, 32.0 + math.pi),
        (-1.0, StrokeJoin.MITER, 4.0),
        (-1.0, StrokeJoin.ROUND, 4.0),
        (-3.0, StrokeJoin.ROUND, 0.0),
    ],
)
def test_a_box_larger_and_smaller(distance, join, area):
    found = offset(BOX, distance, tolerance=1e-6, join=join)
    assert found.area == pytest.approx(area, rel=1e-5)
    if join is not StrokeJoin.ROUND or distance < 0.0:
        assert [len(each) for each in found.contours] == (
            [8 if join is StrokeJoin.BEVEL else 4] if area else []
        )


def test_holes_shrink_where_the_outline_grows():
    ring = Region([*BOX.contours, Region.of_polygon([[1, 1], [1, 3], [3, 3], [3, 1]]).contours[0]])
    assert offset(ring, 0.5, tolerance=1e-6, join=StrokeJoin.MITER).area == pytest.approx(25.0 - 1.0)
    assert offset(ring, -0.25, tolerance=1e-6, join=StrokeJoin.MITER).area == pytest.approx(12.25 - 6.25)
    assert len(offset(ring, 1.5, tolerance=1e-6).contours) == 1


@pytest.mark.parametrize("width", [0.0, -1.0, math.nan])
def test_no_width(width):
    with pytest.raises(CurveError, match="width"):
        stroked([LINE], width, tolerance=1e-3)


def sampled_length(line):
    """Length of cubic pieces by chords: less by some 1e-9 of it, at a cusp by the last chords."""
    s = np.linspace(0.0, 1.0, 40001)
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)
    return float(np.hypot(*np.diff(weights @ line, axis=1).transpose(2, 0, 1)).sum())


@pytest.mark.parametrize("start", [0.0, 0.4, 0.9, -7.3])
@pytest.mark.parametrize("name", LINES)
def test_dashes_and_gaps_are_as_long_as_the_pattern_has_them(name, start):
    """All but the first and the last, which the ends of the line cut; they lie on the line, in order."""
    line = np.array(LINES[name], dtype=float)
    whole = sampled_length(line)
    found = dashed(line, [0.7, 0.5], start=start)
    lengths = [sampled_length(dash) for dash in found]
    assert lengths[1:-1] == pytest.approx([0.7] * (len(found) - 2), abs=2e-5)
    began = (-start) % 1.2
    wanted = np.clip(whole - began - 1.2 * np.arange(-1, len(found)), 0.0, 0.7)
    wanted[0] = min(max(began - 0.5, 0.0), 0.7)
    assert sum(lengths) == pytest.approx(wanted.sum(), abs=1e-4)
    assert all((dash[1:, 0] == dash[:-1, 3]).all() for dash in found)


def test_a_dash_goes_on_over_the_end_of_a_closed_line():
    """Around a square of 4 x 4, 0.5 into dashes of 2 and gaps of 1: the last 1.5 begin the first."""
    (square,) = BOX.contours
    dashes = dashed(square, [2.0, 1.0], start=0.5, closed=True)
    assert [round(sampled_length(dash), 9) for dash in dashes] == [3.0, 2.0, 2.0, 2.0, 2.0]
    assert dashes[0][0, 0].tolist() == [0.0, 1.5]
    assert dashed(square, [20.0, 1.0], closed=True)[0].tolist() == square.tolist()


@pytest.mark.parametrize("lengths", [[], [0.0, 0.0], [1.0, -1.0], [math.nan], [1e-9]])
def test_no_pattern(lengths):
    with pytest.raises(CurveError, match="lengths"):
        dashed(LINE, lengths)
