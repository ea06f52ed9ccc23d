"""Paths of PathWeaver, against WPILib's own matrix of quintic Hermite splines, which they are drawn with."""

from __future__ import annotations

import numpy as np
import pytest

from app.document.model import Document, Point, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.files import export, foreign_file, import_file
from app.exchange.options import Options
from app.families import FAMILIES, HERMITE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

HEAD = "X,Y,Tangent X,Tangent Y,Fixed Theta,Reversed,Name\n"
# Rows are powers 5 to 0 of s; columns x0, x0', x0'', x1, x1', x1'' (QuinticHermiteSpline.java of WPILib).
WPILIB = np.array(
    [
        [-6.0, -3.0, -0.5, 6.0, -3.0, 0.5],
        [15.0, 8.0, 1.5, -15.0, 7.0, -1.0],
        [-10.0, -6.0, -1.5, 10.0, -4.0, 0.5],
        [0.0, 0.0, 0.5, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    ]
)


def text_of(rows):
    """A file with rows x, y, tangent x, tangent y, reversed."""
    lines = [f"{x!r},{y!r},{u!r},{v!r},true,{'true' if back else 'false'}," for x, y, u, v, back in rows]
    return HEAD + "\n".join(lines) + "\n"


def at(rows, t):
    """The path at t, as PathWeaver draws it: a reversed piece from its end to its start."""
    k = min(int(t), len(rows) - 2)
    first, last, s = rows[k], rows[k + 1], t - k
    if first[4]:
        first, last, s = last, first, 1 - s
    powers = s ** np.arange(5, -1, -1)
    return [powers @ WPILIB @ (first[j], first[j + 2], 0, last[j], last[j + 2], 0) for j in (0, 1)]


def random_rows(seed, count=6):
    random = np.random.default_rng(seed)
    backward = random.random(count) < (0.4 if seed % 2 else 0.0)
    backward[-1] = backward[-2]
    if backward[0]:  # which way it is driven at first no curve says
        backward[:] = ~backward
    return [
        (*row, bool(back))
        for row, back in zip(random.normal(size=(count, 4)).tolist(), backward, strict=True)
    ]


@pytest.mark.parametrize("seed", range(8))
def test_a_pathweaver_path_is_read_as_in_pathweaver_and_written_unchanged(seed, tmp_path):
    rows, path = random_rows(seed), tmp_path / "a.csv"
    path.write_text(text_of(rows))
    found = import_file(path)
    (curve,) = found.document.curves
    assert curve.family is QUINTIC_HERMITE
    assert all(point.velocity for point in curve.points)
    view = view_of(curve)
    assert view.curve.domain == (0, len(rows) - 1)
    for t in np.random.default_rng(seed).uniform(0, len(rows) - 1, 40):
        assert view.curve.evaluate(t) == pytest.approx(at(rows, t), abs=1e-12)
    again = tmp_path / "a.pathweaver.csv"
    assert export(found.document, again).deviation == 0
    assert again.read_text() == text_of(rows)
    assert import_file(again).document.curves[0].points == curve.points


def test_tangents_are_velocities(tmp_path):
    """The columns were left out, and the points came with estimated velocities."""
    path = tmp_path / "a.path.csv"
    path.write_text(
        text_of([(1.0, 2.0, 2.0, 0.0, False), (4.0, 3.5, 1.5, 1.5, False), (6.0, 6.0, 0.0, 2.5, False)])
    )
    (curve,) = import_file(path).document.curves
    assert [point.velocity for point in curve.points] == [(2.0, 0.0), (1.5, 1.5), (0.0, 2.5)]
    assert [point.acceleration for point in curve.points] == [(0.0, 0.0)] * 3


def test_a_file_of_an_old_version_has_fewer_columns(tmp_path):
    path = tmp_path / "Left - Left Cube.path"  # an ending of PathPlanner, too
    path.write_text(
        "x,y,TANGENT X,Tangent Y,Fixed Theta\n8.590428240085988,18.40432011464992,1.0,1.0,false\n"
        "11.016179215930306,18.00606249175011,7.855193235484615,-1.5706722062045402,false\n"
    )
    assert foreign_file(path).form.title == "PathWeaver path"
    (curve,) = import_file(path).document.curves
    assert curve.name == "Left - Left Cube"
    assert curve.points[1].velocity == (7.855193235484615, -1.5706722062045402)


@each_row(
    ("text", "sentence"),
    [
        (HEAD + "1,2,3,4,true,false,\n", "only one row of numbers; a curve needs two points"),
        (HEAD + "1,2,3,4,true,false,\n1,2,3,four,true,false,\n", "Row 3, column 4: “four” is not a number"),
        (HEAD + "1,2,3,4,true,false,\n,2,3,4,true,false,\n", "Row 3, column 2 is empty, but x is needed"),
        (HEAD + "1,2,3,4,true,perhaps,\n1,2,3,4,true,false,\n", "Row 2: “perhaps” is neither true nor false"),
        (HEAD + "1,2,3,4,true,false,\n1,2,3\n", "Row 3 has 3 cells; the first row has 7"),
        (HEAD, "no rows of numbers"),
        ("X,Y,Tangent X,Tangent Y\n1,2,3,1e13\n", "Row 2, column 4 must lie between"),
    ],
)
def test_invalid_pathweaver_paths_are_refused_with_their_position(text, sentence, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(text)
    with pytest.raises(ExchangeError) as refusal:
        import_file(path)
    assert sentence in str(refusal.value)


@each_row("family", ["lagrange", "hermite", "cubic_spline", "quintic_hermite"])
@each_row("tolerance", [1e-1, 1e-3])
def test_other_curves_become_waypoints_within_the_tolerance(family, tolerance, tmp_path):
    points = [(0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0)]
    document = Document((make_curve(points, family=FAMILIES.named(family)),))
    path = tmp_path / "a.pathweaver.csv"
    done = export(document, path, Options(tolerance=tolerance))
    assert 0 < done.deviation <= tolerance
    rows = [(*map(float, line.split(",")[:4]), False) for line in path.read_text().splitlines()[1:]]
    core, count = view_of(document.curves[0]).curve, len(rows) - 1
    t = np.linspace(0, count, 10 * count + 1)
    truth = core.evaluate(core.domain[0] + np.ptp(core.domain) * t / count)
    worst = np.hypot(*(truth - [at(rows, each) for each in t]).T).max()
    # A bound, and not a large one: 1 / cos(π / 8) is 1.08.
    assert 0.8 * done.deviation < worst <= done.deviation


def test_a_file_has_one_path(tmp_path):
    curves = [make_curve([(k, 0.0), (k + 1.0, 1.0)], name=f"Curve {k}") for k in range(2)]
    done = export(Document(tuple(curves)), tmp_path / "a.pathweaver.csv")
    assert done.remarks == ("“Curve 1” was left out: a PathWeaver file has one path.",)
    assert done.text.splitlines()[1].startswith("0.0,0.0,")


def test_a_corner_is_refused_where_the_tolerance_allows_no_bend(tmp_path):
    corner = Point(1.0, 1.0, None, (1.0, 0.0), corner=True, velocity_after=(0.0, 1.0))
    curve = make_curve([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], family=HERMITE)
    points = (curve.points[0], corner, curve.points[2])
    document = Document((type(curve)("Bent", curve.family, curve.parametrization, points),))
    path = tmp_path / "a.pathweaver.csv"
    with pytest.raises(ExchangeError, match=r"“Bent” needs more than 10,000 waypoints\. Choose a larger"):
        export(document, path, Options(tolerance=1e-9))
    assert 0 < export(document, path, Options(tolerance=0.01)).deviation <= 0.01
