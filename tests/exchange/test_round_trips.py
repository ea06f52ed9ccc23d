"""Several curves out and in again: tables of points, tables of samples, SVG with what else was drawn."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import point_edits, rule_edits
from app.document.model import Document, Point, make_curve
from app.document.style import Style
from app.exchange.cubics_in import ImportResult
from app.exchange.drawing.styles import DARK
from app.exchange.errors import ExchangeError
from app.exchange.files import export, import_file
from app.exchange.formats.tables import points_table, sampled_table
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.table.columns import ColumnMapping
from app.exchange.table.thinning import Thinning, thin_out
from app.families import HERMITE, QUINTIC_HERMITE
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row
from tests.tables import document_of_table, read_table

SQUARE = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
NAMES = ["Pond", "=Arch, #1", "Line", "Line 2"]


@pytest.fixture
def document():
    """A closed cubic with a corner, a quintic with a hostile name, two Lagrange curves of one name."""
    pond = replace(
        make_curve(SQUARE, name="Pond", family=HERMITE), closed=True, style=Style(stroke="#0072b2")
    )
    arch = make_curve([(0.0, 5.0), (1.0, 7.0), (3.0, 5.5)], name=NAMES[1], family=QUINTIC_HERMITE)
    line = make_curve([(0.0, 9.0), (1 / 3, 9.5), (2.0, 9.0)], name="Line")
    other = make_curve([(0.0, 10.0), (2.0, 11.0)], name="Line")
    result = point_edits.make_corner(Document((pond, arch, line, other)), 0, 2, (1.0, 3.0), (-4.0, 0.5))
    return point_edits.make_corner(result, 1, 1, None, None)


def curves_of(document):
    return [view_of(curve).curve for curve in document.curves]


def assert_same_shapes(one, other):
    for first, second in zip(curves_of(one), curves_of(other), strict=True):
        assert first.domain == second.domain
        t = np.linspace(*first.domain, 301)
        np.testing.assert_allclose(first.evaluate(t), second.evaluate(t), rtol=0, atol=1e-14)


@pytest.mark.parametrize("ending", [".points.csv", ".points.tsv"])
def test_a_table_of_points_gives_the_same_curves(document, ending, tmp_path):
    path = tmp_path / f"all{ending}"
    assert export(document, path).deviation == 0
    back = import_file(path)
    assert isinstance(back, ImportResult)
    assert [curve.name for curve in back.document.curves] == NAMES
    families = [(curve.family, curve.is_closed) for curve in document.curves]
    assert [(curve.family, curve.is_closed) for curve in back.document.curves] == families
    corners = [[point.corner for point in curve.points] for curve in document.curves]
    assert [[point.corner for point in curve.points] for curve in back.document.curves] == corners
    assert_same_shapes(document, back.document)
    # And once more: nothing is lost on the way.
    export(back.document, path)
    assert import_file(path).document == back.document


def test_manual_parameters_of_a_closed_curve_are_read_back(tmp_path):
    curve = replace(make_curve(SQUARE, family=HERMITE), closed=True)
    frozen = rule_edits.freeze_parameters(Document((curve,)), 0, [2.0, 2.5, 4.0, 7.0])
    path = tmp_path / "a.points.csv"
    export(frozen, path)
    back = import_file(path).document
    assert [point.t for point in back.curves[0].points] == [2.0, 2.5, 4.0, 7.0]
    assert_same_shapes(frozen, back)


def test_empty_columns_are_not_written(document):
    line = Document((document.curves[2],))
    assert points_table(line).text.splitlines()[0] == "curve,family,t,x,y"
    assert "vx_after" in points_table(document).text.splitlines()[0]


def test_samples_of_several_curves_are_read_as_several_curves(document, tmp_path):
    smooth = Document(
        tuple(curve for curve in document.curves if not any(point.corner for point in curve.points))
    )
    path = tmp_path / "a.csv"
    export(smooth, path, Options(format_options={"samples": 400}))
    back = import_file(path).document
    assert len(back.curves) == len(smooth.curves)
    for first, second in zip(curves_of(smooth), curves_of(back), strict=True):
        t = np.linspace(*first.domain, 500)
        assert np.abs(first.evaluate(t) - second.evaluate(t)).max() < 1e-7


def test_selected_columns_of_samples_are_written(document):
    text = sampled_table(document, Options(format_options={"samples": 3, "columns": ("y", "x")})).text
    assert text.splitlines()[0] == "curve,x,y"
    with pytest.raises(ExchangeError, match="A table can have the columns t, x, y"):
        sampled_table(document, Options(format_options={"columns": ("z",)}))


def test_rows_of_different_curves_may_be_mixed():
    table = read_table(b"curve,x,y\na,0,0\nb,5,5\na,1,0\nb,6,5\n")
    first, second = document_of_table(table).document.curves
    assert (first.name, [point.position for point in first.points]) == ("a", [(0, 0), (1, 0)])
    assert (second.name, [point.position for point in second.points]) == ("b", [(5, 5), (6, 5)])


@each_row(
    ("text", "sentence"),
    [
        ("curve,t,x,y\na,0,0,0\nb,1,1,1\na,0,2,2\n", "Row 4: t must increase from row to row."),
        (
            "curve,family,x,y\na,spline,0,0\na,spline,1,0\n",
            "Row 2, column 2 must be one of lagrange, hermite",
        ),
        ("curve,x,y\na,0,0\nb,1,1\na,3,4\n", "The table has only one row of numbers"),
        ("x,y,vx,vy\n0,0,1,\n1,1,1,1\n", "Row 2, column 4 is empty, but vy is needed."),
    ],
)
def test_an_error_in_one_of_several_curves_names_its_row(text, sentence):
    with pytest.raises(ExchangeError) as refusal:
        document_of_table(read_table(text.encode()))
    assert str(refusal.value).startswith(sentence)


def test_a_column_that_is_left_out_may_hold_anything():
    text = "\n".join(f"{i};n/a;{i * i}" for i in range(5)).encode()
    with pytest.raises(ExchangeError, match="is not a number"):
        read_table(text)
    table = read_table(text, mapping=ColumnMapping(x=0, y=2))
    document = document_of_table(table, ColumnMapping(x=0, y=2)).document
    assert [point.position for point in document.curves[0].points] == [(i, i * i) for i in range(5)]
    with pytest.raises(ExchangeError, match="Row 6 has 2 cells"):
        read_table(text + b"\n1;2", mapping=ColumnMapping(x=0, y=2))


def test_an_empty_pair_of_cells_is_estimated():
    document = document_of_table(read_table(b"x,y,vx,vy\n0,0,1,2\n1,1,,\n")).document
    assert [point.velocity for point in document.curves[0].points] == [(1, 2), None]


def test_a_polyline_is_thinned_by_its_chords():
    """Douglas and Peucker keep the corners of a staircase, and nothing between."""
    steps = np.array([(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (3, 2)], dtype=float)
    share = np.linspace(0, 1, 200, endpoint=False)[:, None]
    points = np.concatenate([a + share * (b - a) for a, b in itertools.pairwise(steps)])
    kept = thin_out(np.vstack([points, steps[-1:]]), None, 1e-9, Thinning.POLYLINE)
    assert kept.rows.tolist() == [0, 200, 400, 600, 800, 1000]
    assert kept.deviation > 0.01  # the spline through the corners swings


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3])
def test_a_thinned_polyline_stays_within_the_tolerance(tolerance):
    t = np.linspace(0, 7, 4001)
    points = np.column_stack([np.cos(t) * t, np.sin(t)])
    kept = thin_out(points, None, tolerance, Thinning.POLYLINE)
    chords = points[kept.rows]
    x = np.linspace(0, 1, 40)[:, None, None]
    dense = (chords[:-1] * (1 - x) + chords[1:] * x).reshape(-1, 2)
    nearest = [np.hypot(*(dense - point).T).min() for point in points[::37]]
    assert max(nearest) <= tolerance * 1.001 + np.abs(np.diff(chords, axis=0)).max() / 39
    assert len(kept.rows) < 30 * tolerance**-0.5


def test_a_picture_with_all_decorations_reads_back_as_its_curves(document):
    plain = svg_of(document).text
    full = svg_of(document, Options(points=True, handles=True, grid=True, basis=0)).text
    for name in ("grid", "handles", "basis", "points"):
        assert f'<g id="{name}"' in full
        assert f'<g id="{name}"' not in plain
    one, other = read_svg(plain.encode()), read_svg(full.encode())
    dark = read_svg(svg_of(document, Options(style=DARK)).data)
    assert one.document == other.document == dark.document
    assert [curve.name for curve in one.document.curves] == ["Pond", NAMES[1], "Line", "Line"]
    assert [curve.style.stroke for curve in one.document.curves] == ["#0072b2", "", "", ""]


def test_handles_are_drawn_where_the_control_points_are():
    curve = replace(
        make_curve([(0.0, 0.0), (3.0, 0.0)], family=HERMITE),
        points=(Point(0.0, 0.0, velocity=(3.0, 6.0)), Point(3.0, 0.0, velocity=(3.0, -6.0))),
    )
    text = svg_of(Document((curve,)), Options(handles=True)).text
    assert "M 0 0 L 1 -2 M 3 0 L 2 -2" in text
