"""Documents of versions whose rules estimated derivatives from the points alone: they keep their shape."""

from __future__ import annotations

import itertools
import json
import random

import numpy as np
import pytest
from msgspec.structs import replace

import curvecore
from app.cli import main
from app.document.constraints import tie
from app.document.derivatives import AccelerationRule, JerkRule, VelocityRule
from app.document.model import Document, ParametrizationKind, make_curve
from app.document.point_edits import explicit_points
from app.families import FAMILIES, HERMITE
from app.storage.format import decode_counting, encode
from app.storage.open_file import OpenFile
from app.storage.recovery import SnapshotFile, SnapshotOrigin, list_snapshots
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

HILLS = ((0, 0), (1, 2), (2.5, 1), (4, 3), (5, 0.5), (6.5, 2), (8, 0))
WITH_RULES = [family for family in FAMILIES if family.derivatives]


def of_version(version, *curves):
    """The content of a file of an older version that holds these curves."""
    values = json.loads(encode(Document(curves))) | {"version": version}
    return json.dumps(values).encode()


def estimate(rule, curve, points, t):
    data = (points, t) if "parameters" in rule.takes else (points,)
    further = {"alpha": curve.parametrization.alpha} if "alpha" in rule.takes else {}
    return getattr(curvecore, rule.function)(*data, **further)


def older_jets(curve):
    """The jets before and after each knot by the rules of version 3, which saw the points alone."""
    t, points = view_of(curve).parameters, np.array([point.position for point in curve.points], dtype=float)
    count, closed = len(points), curve.is_closed
    corners = [i for i, point in enumerate(curve.points) if point.corner and not point.tied]
    steps = np.diff(t)
    if closed:
        cuts = [*corners, corners[0] + count] if corners else [-70, count + 70]
    else:
        cuts = sorted({0, count - 1, *corners})
    sides = np.full((2, count, curve.family.derivatives, 2), np.nan)
    for start, end in itertools.pairwise(cuts):
        rows = np.arange(start, end + 1)
        piece_t = np.concatenate([[0.0], np.cumsum(steps[rows[:-1] % len(steps)])])
        for order, rule in enumerate(curve.rules):
            values = estimate(rule, curve, points[rows % count], piece_t)
            for row, value in zip(rows.tolist(), values, strict=True):
                inside = 0 <= row < count or (closed and corners)
                if inside and row != end:
                    sides[1, row % count, order] = value
                if inside and row != start:
                    sides[0, row % count, order] = value
    for index, point in enumerate(curve.points):
        for order in range(curve.family.derivatives):
            for side, given in enumerate(point.explicit_sides(order + 1)):
                if given is not None:
                    sides[side, index, order] = given
    return t, points, sides


def older_shape(curve, share):
    """The points of the curve of version 3 at these shares of each segment, by Hermite interpolation."""
    t, points, sides = older_jets(curve)
    count, shape = len(points), []
    make = curve.family.curve_class
    for segment in range(len(t) - 1):
        start, end = segment, (segment + 1) % count
        jets = [[points[start], *sides[1, start]], [points[end], *sides[0, end]]]
        piece = make(*(np.array(row) for row in zip(*jets, strict=True)), t[segment : segment + 2])
        shape.append(piece.evaluate(t[segment] + share * (t[segment + 1] - t[segment])))
    return np.array(shape)


def shape_of(curve, share):
    view = view_of(curve)
    t = view.parameters
    return np.array([view.curve.evaluate(a + share * (b - a)) for a, b in itertools.pairwise(t)])


def mixed_curve(family, rules, random_numbers, *, closed):
    """A curve with some velocities and accelerations set, a corner, a tie and estimates between them."""
    curve = make_curve(HILLS, family=family)
    curve = replace(curve, closed=closed, velocity_rule=rules[0], acceleration_rule=rules[1])
    curve = replace(curve, jerk_rule=random_numbers.choice(list(JerkRule)))
    kind = random_numbers.choice([ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM])
    curve = replace(curve, parametrization=replace(curve.parametrization, kind=kind))

    def vector():
        return (random_numbers.uniform(-9, 9), random_numbers.uniform(-9, 9))

    def some(count):
        return [vector() if random_numbers.random() < 0.4 else None for _ in range(count)]

    points = list(curve.points)
    for index in random_numbers.sample(range(7), 4):
        what = random_numbers.choice(["set", "corner", "tie"])
        if what == "set":
            points[index] = points[index].with_derivatives(some(family.derivatives), ())
        elif what == "corner":
            cornered = points[index].as_corner()
            points[index] = cornered.with_derivatives(some(family.derivatives), some(family.derivatives))
        elif closed or 0 < index < 6:
            points[index] = tie(points[index], vector(), vector())
    return replace(curve, points=tuple(points))


@each_row("family", WITH_RULES)
@pytest.mark.parametrize("closed", [False, True])
def test_curves_that_mix_set_and_estimated_derivatives_keep_their_shape(family, closed):
    numbers, share = random.Random(f"{family.name}{closed}"), np.linspace(0, 1, 9)
    for rules in itertools.product(VelocityRule, AccelerationRule):
        for _ in range(3):
            curve = mixed_curve(family, rules, numbers, closed=closed)
            was = older_shape(curve, share)
            opened = decode_counting(of_version(3, curve))
            (now,) = opened.document.curves
            # Estimates and sampling each round at the size of the derivatives times powers of h.
            assert shape_of(now, share) == pytest.approx(was, abs=1e-11 * (1 + np.abs(was).max()))
            changed = sum(a != b for a, b in zip(now.points, curve.points, strict=True))
            assert opened.left_out.points_set == changed
            again = decode_counting(encode(opened.document))
            assert (again.document, again.left_out.points_set) == (opened.document, 0)


@each_row("family", WITH_RULES)
def test_a_curve_without_set_derivatives_or_without_estimates_is_not_changed(family):
    plain = make_curve(HILLS, family=family)
    vectors = [(1.0, 2.0)] * family.derivatives
    full = replace(plain, points=tuple(point.with_derivatives(vectors, ()) for point in plain.points))
    opened = decode_counting(of_version(3, plain, replace(full, name="b")))
    assert [each.points for each in opened.document.curves] == [plain.points, full.points]
    assert not opened.left_out


def test_local_rules_estimate_what_they_did_and_nothing_is_set():
    curve = replace(make_curve(HILLS, family=HERMITE), velocity_rule=VelocityRule.BESSEL)
    points = (*curve.points[:3], replace(curve.points[3], velocity=(1.0, 2.0)), *curve.points[4:])
    opened = decode_counting(of_version(3, replace(curve, points=points)))
    assert opened.document.curves[0].points == points
    assert not opened.left_out


# Doors: wherever an older document comes in


def hills():
    """A Hermite curve of seven points, a velocity set at the fourth: the two beside it would move."""
    curve = make_curve(HILLS, name="Hills", family=HERMITE)
    set_there = replace(curve.points[3], velocity=(2.0, -9.0))
    return replace(curve, points=(*curve.points[:3], set_there, *curve.points[4:]))


def is_kept(curve):
    share = np.linspace(0, 1, 9)
    return shape_of(curve, share) == pytest.approx(older_shape(hills(), share), abs=1e-12)


MESSAGE = "was made with an older version: 2 points were set to keep the shape."


def test_only_the_points_beside_what_was_set_are_set():
    (curve,) = decode_counting(of_version(3, hills())).document.curves
    assert explicit_points(curve, range(7)) == {2, 3, 4}
    assert curve.points[3] == hills().points[3]
    assert is_kept(curve)
    assert not is_kept(hills())


@pytest.mark.parametrize("version", [1, 2, 3])
def test_a_file_is_opened_with_its_shape_and_not_overwritten_until_it_is_saved(tmp_path, version):
    path = tmp_path / "hills.curve.json"
    path.write_bytes(old := of_version(version, hills()))
    opened = OpenFile.open(path)
    assert is_kept(opened.document.curves[0])
    assert (opened.file.is_older, opened.file.left_out.points_set) == (True, 2)
    assert opened.file.left_out.sentence(path.name) == f"“hills.curve.json” {MESSAGE}"
    assert path.read_bytes() == old
    OpenFile.saved(path, opened.document, opened.file).close()
    assert (tmp_path / f"hills.curve.json.v{version}.bak").read_bytes() == old
    again = decode_counting(path.read_bytes())
    assert (again.document, again.left_out.points_set) == (opened.document, 0)


def test_a_snapshot_of_an_older_version_is_restored_with_its_shape(tmp_path, monkeypatch):
    monkeypatch.setattr("app.storage.recovery.encode", lambda document: of_version(3, *document.curves))
    file = SnapshotFile(tmp_path)
    file.write(Document((hills(),)), SnapshotOrigin())
    file.leave()
    (snapshot,) = list_snapshots(tmp_path).snapshots
    assert is_kept(snapshot.document.curves[0])
    assert snapshot.left_out.message_about("It") == f"It {MESSAGE}"


def test_the_command_line_keeps_the_shape_and_says_so(tmp_path, capsys):
    path, now = tmp_path / "hills.curve.json", tmp_path / "now.curve.json"
    path.write_bytes(of_version(3, hills()))
    for words in (["info", str(path)], ["convert", str(path), str(now)]):
        assert main(words) == 0
        assert capsys.readouterr().err == f"curvebench: “hills.curve.json” {MESSAGE}\n"
    assert is_kept(decode_counting(now.read_bytes()).document.curves[0])


def test_features_left_out_and_points_that_were_set_are_said_together():
    values = json.loads(of_version(2, hills())) | {"kept_texts": [{}]}
    left_out = decode_counting(json.dumps(values).encode()).left_out
    assert left_out.message_about("It") == (
        "It was made with a version that had more features: 1 text was left out. "
        "2 points were set to keep the shape."
    )
