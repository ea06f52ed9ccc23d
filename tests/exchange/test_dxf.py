"""DXF out and in, with ezdxf as the judge."""

import io
import sys

import numpy as np
import pytest

from app import exchange
from app.document.model import Document, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.formats.dxf import dxf_text, read_dxf
from app.exchange.options import Options
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of
from curvecore import bezier_segments

ezdxf = pytest.importorskip("ezdxf")


def loaded(text):
    drawing = ezdxf.read(io.StringIO(text))
    auditor = drawing.audit()
    assert not auditor.errors
    assert not auditor.fixes
    return drawing


def core(document):
    return view_of(document.curves[0]).curve


def file_with(draw):
    """The bytes of a DXF file that `draw(modelspace)` fills."""
    drawing = ezdxf.new("R2010")
    draw(drawing.modelspace())
    stream = io.StringIO()
    drawing.write(stream)
    return stream.getvalue().encode()


def points_of(curve, count=2001):
    made = view_of(curve).curve
    return made.evaluate(np.linspace(*made.domain, count))


@pytest.mark.parametrize("cubic", [False, True])
def test_ezdxf_gives_the_curve_within_the_stated_deviation(kind, cubic):
    written = dxf_text(kind, Options(tolerance=1e-4, format_options={"cubic": cubic}))
    (spline,) = loaded(written.text).modelspace()
    assert spline.dxftype() == "SPLINE"
    assert spline.fit_point_count() == 0
    curve = core(kind)
    tool = spline.construction_tool()
    t = np.linspace(*curve.domain, 301)
    points = np.array([tuple(point)[:2] for point in tool.points(t.tolist())])
    size = np.abs(curve.points).max()
    for _ in range(6 * cubic):  # cubics keep the shape: to the foot of the perpendicular
        velocity = curve.evaluate(t, 1)
        ahead = np.einsum("kd,kd->k", points - curve.evaluate(t), velocity)
        t = np.clip(t + ahead / np.square(velocity).sum(axis=1), *curve.domain)
    assert np.hypot(*(points - curve.evaluate(t)).T).max() <= written.deviation + 1e-12 * size
    assert written.deviation <= 1e-4


def test_the_degree_is_the_true_one(kind):
    (spline,) = loaded(dxf_text(kind).text).modelspace()
    degree = core(kind).degree or 3  # what is no polynomial is written as cubics
    assert spline.dxf.degree == (degree if degree <= 10 else 3)
    (spline,) = loaded(dxf_text(kind, Options(format_options={"cubic": True})).text).modelspace()
    assert spline.dxf.degree == min(degree, 3)


@pytest.mark.parametrize("count", [2, 3, 4, 6, 11])
def test_lagrange_curves_up_to_degree_10_are_one_bezier_piece(count):
    document = Document((make_curve(np.random.default_rng(count).normal(size=(count, 2)).tolist()),))
    written = dxf_text(document)
    (spline,) = loaded(written.text).modelspace()
    assert spline.dxf.degree == count - 1
    assert len(spline.control_points) == count
    assert written.deviation < 1e-12 * np.abs(spline.control_points).max()


def test_layers_and_colours(gallery):
    written = dxf_text(gallery)
    drawing = loaded(written.text)
    entities = list(drawing.modelspace())
    names = [entity.dxf.layer for entity in entities]
    assert len(set(names)) == len(names) == len(gallery.curves) - 1
    assert names[-2:] == ["Ring", "Ring 2"]
    assert drawing.layers.get("Ring").rgb == (0xC0, 0x40, 0x20)
    assert [entity.closed for entity in entities][-3:] == [True, True, True]
    assert written.text.startswith("999\nCurvebench ")
    assert written.remarks


def test_hostile_names_become_layers():
    names = ["", "a/b*c|d\n999\nEOF", "x" * 500, "‖c′‖", "\ud800"]
    document = Document(tuple(make_curve([(0, 0), (1, 1)], name=name) for name in names))
    drawing = loaded(dxf_text(document).text)
    assert len(list(drawing.modelspace())) == len(names)


def test_hermite_curves_are_read_back_exactly(kind):
    (curve,) = kind.curves
    result = read_dxf(dxf_text(kind).text.encode("utf-8", "replace"))
    (back,) = result.document.curves
    assert (back.name, back.style.stroke) == (curve.name, curve.style.stroke)
    if curve.family is not HERMITE:
        return
    mine = np.concatenate([bezier_segments(piece) for piece in view_of(curve).pieces])
    theirs = np.concatenate([bezier_segments(piece) for piece in view_of(back).pieces])
    np.testing.assert_allclose(theirs, mine, rtol=0, atol=1e-13 * np.abs(mine).max() + result.deviation)
    assert back.closed == curve.is_closed


def test_higher_degrees_are_read_back_within_the_tolerance(kind):
    written = dxf_text(kind, Options(tolerance=1e-5))
    result = read_dxf(written.text.encode(), 1e-4)
    allowed = written.deviation + result.deviation
    assert result.deviation <= 1e-4
    mine, theirs = points_of(kind.curves[0]), points_of(result.document.curves[0], 20001)
    size = np.abs(mine).max()
    step = np.hypot(*np.diff(theirs, axis=0).T).max()
    for point in mine[::40]:
        assert np.hypot(*(theirs - point).T).min() <= allowed + step + 1e-12 * size


def test_a_uniform_spline_of_another_program():
    points = [(0, 0), (1, 3), (3, 3), (4, 0), (6, 1), (7, 4)]
    for degree in (1, 2, 3):
        data = file_with(lambda space, d=degree: space.add_open_spline(points, degree=d))
        result = read_dxf(data)
        (curve,) = result.document.curves
        tool = ezdxf.math.BSpline(points, order=degree + 1)
        spline = np.array([tuple(point)[:2] for point in tool.approximate(400)])
        mine = points_of(curve, 20001)
        for point in spline[::7]:
            assert np.hypot(*(mine - point).T).min() < 2e-3
        assert result.deviation < 1e-8
        assert any(point.corner for point in curve.points) == (degree == 1)


def test_corners_a_rounding_apart_are_one():
    """They made “pieces of too different lengths”, and the file was refused."""
    doubled = [(0, 0), (1e-16, 0), (3, 0), (3, 1e-16), (3, 1e-15), (3, 4), (1e-15, 1e-15)]

    def draw(space):
        space.add_lwpolyline(doubled, close=True)
        space.add_lwpolyline([(100, 0), (100, 7), (100, 7 + 1e-14), (105, 9)])
        space.add_polyline2d([(0, 0), (0, 1e13)])

    result = read_dxf(file_with(draw))
    triangle, line = result.document.curves
    assert [point.position for point in triangle.points] == [(0, 0), (3, 0), (3, 4)]
    assert triangle.closed
    assert [point.position for point in line.points] == [(100, 0), (100, 7), (105, 9)]
    # One beyond limits leaves the others, too.
    assert result.remarks == (
        "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Polyline 3.",
    )


def test_lines_polylines_and_arcs():
    def draw(space):
        space.add_line((0, 0), (3, 4), dxfattribs={"layer": "L", "color": 1})
        space.add_lwpolyline([(0, 0), (1, 0), (1, 1)], close=True)
        space.add_lwpolyline([(0, 0, 0, 0, 1), (2, 0, 0, 0, 0)])
        space.add_circle((1, 2), 5)
        space.add_arc((0, 0), 2, 30, 120)
        space.add_ellipse((0, 0), (3, 0), 0.5)
        space.add_text("no")

    result = read_dxf(file_with(draw), 1e-4)
    line, triangle, half, circle, arc, ellipse = result.document.curves
    assert (line.name, line.style.stroke, len(line.points)) == ("L", "#ff0000", 2)
    assert triangle.closed
    assert [point.corner for point in triangle.points] == [True] * 3
    assert np.abs(np.hypot(*(points_of(half) - [1, 0]).T) - 1).max() < 1e-4
    assert circle.closed
    assert not any(point.corner for point in circle.points)
    assert np.abs(np.hypot(*(points_of(circle) - [1, 2]).T) - 5).max() <= result.deviation <= 1e-4
    assert np.abs(np.hypot(*points_of(arc).T) - 2).max() < 1e-4
    assert np.abs(np.hypot(*(points_of(ellipse) / [3, 1.5]).T) - 1).max() < 1e-4
    assert result.remarks == ("1 TEXT left out.",)


def test_inexact_splines_are_left_out_with_a_remark():
    def draw(space):
        space.add_rational_spline([(0, 0), (1, 1), (2, 0), (3, 1)], weights=[1, 2, 1, 1])

    with pytest.raises(ExchangeError) as refusal:
        read_dxf(file_with(draw))
    assert str(refusal.value) == ("The file contains no curves. 1 SPLINE with weights left out.")


def test_fit_points_alone_are_points_to_interpolate():
    """Such a spline used to be left out."""

    def draw(space):
        space.add_spline(fit_points=[(0, 0), (1, 1), (1, 1), (2, 0)], dxfattribs={"layer": "duct"})
        ring = space.add_spline(fit_points=[(0, 0), (1, 1), (2, 0), (0, 0)])
        ring.dxf.flags |= 1
        space.add_spline(fit_points=[(5, 5), (5, 5)])

    result = read_dxf(file_with(draw))
    duct, ring = result.document.curves
    assert (duct.name, duct.closed, ring.closed) == ("duct", False, True)
    for curve in (duct, ring):
        assert [point.position for point in curve.points] == [(0, 0), (1, 1), (2, 0)]
        assert [point.velocity for point in curve.points] == [None] * 3
    assert result.remarks == (
        "2 SPLINEs with fit points only imported as the natural spline through them.",
        "1 SPLINE with fewer than two points left out.",
    )


def test_truncated_and_foreign_files_are_refused(sketch):
    data = dxf_text(sketch).text.encode()
    for share in (0.01, 0.3, 0.7, 0.99):
        with pytest.raises(ExchangeError, match=r"ends at line \d+ without EOF: it is incomplete"):
            read_dxf(data[: int(len(data) * share)])
    for wrong, sentence in [
        (b"", "The file is empty"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "binary DXF"),
        (b"0\nSECTION\0\n0\nEOF\n", "zero bytes"),
        (b"hello\n0\nEOF\n", "The DXF file is damaged"),
        (data.replace(b"SPLINE", b"SPLUNK"), "SPLUNK left out"),
    ]:
        with pytest.raises(ExchangeError, match=sentence):
            read_dxf(wrong)


def test_invalid_numbers_are_refused(sketch):
    text = dxf_text(sketch).text
    head, _, tail = text.partition("AcDbSpline")
    for bad in ("nan", "inf", "1e999", "five"):
        broken = head + "AcDbSpline" + tail.replace("\n 10\n", f"\n 10\n{bad}\n 10\n", 1)
        with pytest.raises(ExchangeError):
            read_dxf(broken.encode())


def test_without_ezdxf_the_extra_is_named(sketch, monkeypatch, forget):
    forget(exchange, "dxf_library")
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    for call in (lambda: dxf_text(sketch), lambda: read_dxf(b"0\nEOF\n")):
        with pytest.raises(
            ExchangeError, match=r"DXF needs the package ezdxf: pip install 'curvebench\[dxf\]'"
        ):
            call()


@pytest.mark.parametrize("unit", ["mm", "in", "ft", ""])
def test_the_unit_of_a_file_is_that_of_its_document(unit):
    document = Document((make_curve([(0.0, 0.0), (3.0, 4.0)], family=HERMITE),))
    back = read_dxf(dxf_text(document, Options(unit=unit)).data).document
    assert back.unit == unit
