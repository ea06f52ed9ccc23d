"""Paths of PathPlanner and trajectories of Choreo, against the formulas of their own libraries."""

from __future__ import annotations

import json
from itertools import pairwise
from math import cos, sin

import numpy as np
import pytest

from app.exchange.errors import ExchangeError
from app.exchange.files import ImportOptions, foreign_file, import_file
from app.exchange.formats.robot_paths import read_pathplanner, read_trajectories
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row


def xy_object(pair):
    return None if pair is None else {"x": float(pair[0]), "y": float(pair[1])}


def path_of(controls, **more):
    """A path of PathPlanner 2025 by its Bézier pieces (k, 4, 2)."""
    ends = [None, *(piece[2] for piece in controls)], [*(piece[1] for piece in controls), None]
    anchors = [controls[0][0], *(piece[3] for piece in controls)]
    waypoints = [
        {"anchor": xy_object(a), "prevControl": xy_object(b), "nextControl": xy_object(c), "isLocked": False}
        for a, b, c in zip(anchors, *ends, strict=True)
    ]
    return json.dumps(
        {"version": "2025.0", "waypoints": waypoints, "goalEndState": {"velocity": 0}} | more
    ).encode()


def bezier(piece, s):
    """De Casteljau's scheme, as PathPlanner's cubicLerp."""
    level = np.array(piece, dtype=float)
    while len(level) > 1:
        level = (1 - s) * level[:-1] + s * level[1:]
    return level[0]


def chained(random, count, *, smooth):
    """Random Bézier pieces that follow each other, with handles on one line at the joints or not."""
    pieces = random.normal(size=(count, 4, 2))
    pieces[1:, 0] = pieces[:-1, 3]
    if smooth:
        share = random.uniform(0.2, 3, size=(count - 1, 1))
        pieces[1:, 1] = pieces[1:, 0] + share * (pieces[:-1, 3] - pieces[:-1, 2])
    return pieces


@pytest.mark.parametrize("smooth", [True, False])
@pytest.mark.parametrize("seed", range(5))
def test_a_path_of_pathplanner_is_its_bezier_pieces(smooth, seed, tmp_path):
    random = np.random.default_rng(seed)
    pieces = chained(random, 5, smooth=smooth)
    path = tmp_path / "a.path"
    path.write_bytes(path_of(pieces))
    found = read_pathplanner(path.read_bytes())
    assert found.deviation == 0.0  # up to 1e-15 were told of handles in one line but for rounding
    (curve,) = found.document.curves
    assert len(curve.points) == 6
    assert all(point.velocity for point in curve.points)
    core = view_of(curve).curve
    for k, piece in enumerate(pieces):
        start, end = core.breaks[k : k + 2]
        for s in random.uniform(size=8):
            assert core.evaluate(start + (end - start) * s) == pytest.approx(bezier(piece, s), abs=1e-12)


@pytest.mark.usefixtures("drawings_read_here")
def test_a_path_is_recognised_by_its_content_and_other_content_gives_a_remark(tmp_path):
    """“This JSON is no table”."""
    path = tmp_path / "a.json"
    piece = [[2, 7], [3, 7], [4, 6], [4, 5]]
    more = {"eventMarkers": [{}, {}], "rotationTargets": [{}], "pointTowardsZones": [{}, {}]}
    path.write_bytes(b"\xef\xbb\xbf\n" + path_of([piece], **more))
    assert foreign_file(path).form.title == "PathPlanner path"
    found = import_file(path)
    assert found.remarks == (
        "1 rotation target left out.",
        "2 point towards zones left out.",
        "2 event markers left out.",
    )
    (curve,) = found.document.curves
    assert [point.velocity for point in curve.points] == [(3.0, 0.0), (0.0, -3.0)]


def test_paths_of_2023_have_anchor_points_and_markers():
    content = path_of([[[0, 0], [1, 0], [2, 1], [3, 1]]], markers=[{"position": 0.5, "names": ["drop"]}])
    found = read_pathplanner(content.replace(b'"anchor"', b'"anchorPoint"'))
    (curve,) = found.document.curves
    assert found.remarks == ("1 marker left out.",)
    assert [(point.x, point.y) for point in curve.points] == [(0, 0), (3, 1)]


@each_row(
    ("old", "new", "sentence"),
    [
        ('"x": 3.0', '"x": "a"', "Waypoints[1].anchor.x must be a number, not text."),
        ('"x": 3.0, ', "", "Waypoints[1].anchor.x is missing."),
        ('"prevControl": {"x": 2.0, "y": 1.0}', '"prevControl": null', "Waypoint 2 has no prev control."),
        ('"nextControl": {"x": 1.0, "y": 0.0}', '"nextControl": null', "Waypoint 1 has no next control."),
        ('"anchor": {"x": 3.0, "y": 1.0}', '"anchor": null', "Waypoint 2 has no anchor."),
        (
            '"x": 3.0',
            '"x": 3e13',
            "The file contains no curves. "
            "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Path.",
        ),
        ('"version"', "version", "It is not JSON; line 1, column 2: object keys must be strings."),
        ("waypoints", "ways", "Waypoints is missing."),
    ],
)
def test_invalid_pathplanner_paths_are_refused_with_their_position(old, new, sentence):
    text = path_of([[[0, 0], [1, 0], [2, 1], [3, 1]]]).decode()
    assert old in text
    with pytest.raises(ExchangeError) as refusal:
        read_pathplanner(text.replace(old, new).encode())
    assert str(refusal.value) == sentence


def swerve(random, count=6):
    """Samples of a motion whose acceleration is constant from one to the next, in binary fractions."""
    t, state, samples = 0.0, random.integers(-64, 64, size=4) / 16, []
    for _ in range(count):
        a, step = random.integers(-64, 64, size=2) / 16, random.integers(1, 9) / 16
        x, y, vx, vy = map(float, state)
        samples.append(
            {"t": t, "x": x, "y": y, "vx": vx, "vy": vy, "ax": float(a[0]), "ay": float(a[1]), "omega": 0.0}
        )
        state = [*(state[:2] + state[2:] * step + a * step**2 / 2), *(state[2:] + a * step)]
        state = np.array(state)
        t += float(step)
    return samples


def traj(samples, **more):
    return json.dumps(
        {"name": "Far", "version": 3, "trajectory": {"sampleType": "Swerve", "samples": samples}} | more
    )


@pytest.mark.parametrize("seed", range(4))
def test_a_swerve_drive_moves_as_in_choreolib(seed, tmp_path):
    """x + v τ + a τ² / 2 from each sample on: a cubic with these ends is that parabola."""
    random = np.random.default_rng(seed)
    samples = swerve(random)
    path = tmp_path / "a.json"
    path.write_text(traj(samples))
    found = import_file(path)
    (curve,) = found.document.curves
    assert found.remarks == ("Headings, forces and events are left out.",)
    assert curve.name == "Far"
    assert [(point.t, point.velocity) for point in curve.points] == [
        (s["t"], (s["vx"], s["vy"])) for s in samples
    ]
    core = view_of(curve).curve
    for first, second in pairwise(samples):
        for t in random.uniform(first["t"], second["t"], 8):
            tau = t - first["t"]
            truth = [first[k] + first[f"v{k}"] * tau + first[f"a{k}"] * tau**2 / 2 for k in "xy"]
            assert core.evaluate(t) == pytest.approx(truth, abs=1e-12)


def test_a_differential_drive_moves_in_its_heading(tmp_path):
    path = tmp_path / "a.traj"
    samples = [
        {"t": 0.0, "x": 0.0, "y": 0.0, "heading": 0.5, "vl": 1.0, "vr": 3.0},
        {"t": 1.0, "x": 2.0, "y": 1.0, "heading": 1.0, "vl": 2.0, "vr": 1.0},
    ]
    path.write_text(traj(samples))
    (curve,) = import_file(path).document.curves
    assert curve.points[0].velocity == pytest.approx((2 * cos(0.5), 2 * sin(0.5)))
    assert curve.points[1].velocity == pytest.approx((1.5 * cos(1.0), 1.5 * sin(1.0)))


def test_files_of_2024_have_other_names_and_a_project_has_many_paths(tmp_path):
    rows = [
        {"timestamp": k, "x": k, "y": k * k, "velocityX": 1, "velocityY": 2 * k, "heading": 0}
        for k in range(3)
    ]
    (tmp_path / "a.traj").write_text(json.dumps({"samples": rows, "eventMarkers": []}))
    (curve,) = import_file(tmp_path / "a.traj").document.curves
    assert [(point.t, point.velocity) for point in curve.points] == [(0, (1, 0)), (1, (1, 2)), (2, (1, 4))]
    paths = {"Up": {"trajectory": rows}, "Down": {"trajectory": rows[:2]}, "New": {"trajectory": None}}
    (tmp_path / "a.chor").write_text(json.dumps({"version": "v0.3.1", "paths": paths}))
    found = import_file(tmp_path / "a.chor")
    assert [(each.name, len(each.points)) for each in found.document.curves] == [("Up", 3), ("Down", 2)]
    only = import_file(tmp_path / "a.chor", ImportOptions(only=["Down"])).document.curves
    assert [each.name for each in only] == ["Down"]


SAMPLE = {"t": 0.0, "x": 0.0, "y": 0.0, "vx": 1.0, "vy": 0.0}


@each_row(
    ("text", "sentence"),
    [
        (traj([SAMPLE, SAMPLE | {"t": "late"}]), "Trajectory.samples[1].t must be a number or null"),
        (traj([{"t": 0.0, "x": 0.0}]), "Trajectory.samples[0].y is missing."),
        (traj([{"t": 0.5, "x": 0.0, "y": 0.0, "vx": 1.0}]), "Sample 1 has no velocity."),
        (traj([SAMPLE, {"x": 0.0, "y": 0.0, "vx": 1.0, "vy": 2.0}]), "Sample 2 has no time."),
        (traj([]), "The file has no trajectory. Generate one in Choreo and import its .traj file."),
        (
            '{"name": "swerve", "version": 2, "type": "Swerve", "config": {}}',
            "The file has no trajectory. Generate",
        ),
        (traj([SAMPLE | {"x": 3e13}]), "Row 1, column 3 must lie between −1e12 and 1e12."),
        ("", "It is not JSON; the file ends too early."),
    ],
)
def test_invalid_trajectories_are_refused_with_their_position(text, sentence):
    with pytest.raises(ExchangeError) as refusal:
        read_trajectories(text.encode())
    assert str(refusal.value).startswith(sentence)


def test_times_that_do_not_increase_are_refused_with_the_row(tmp_path):
    (tmp_path / "a.traj").write_text(traj([SAMPLE, SAMPLE | {"x": 1.0}]))
    with pytest.raises(ExchangeError, match="Row 2: t must increase from row to row"):
        import_file(tmp_path / "a.traj")
