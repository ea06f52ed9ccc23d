"""SVG in: exactly what the file draws, and nothing that would do harm."""

import itertools
import math
import socket
from pathlib import Path

import msgspec
import numpy as np
import pytest

from app.document.constraints import is_straight
from app.document.model import Document, Point, make_curve
from app.exchange.cubics_in import arc
from app.exchange.drawing.styles import DARK
from app.exchange.errors import ExchangeError
from app.exchange.options import Options
from app.exchange.svg.coordinates import transform_of
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.svg.xml_tree import parse_xml
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of
from app.view_model.point_kinds import kind_at
from curvecore import bezier_segments, joint_report
from curvecore.bezier.control_points import cubic_shape
from tests.effort import calls_of
from tests.rows import each_row


def svg(body, attributes=""):
    head = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"{head} {attributes}>{body}</svg>".encode()


def curves(body):
    return read_svg(svg(body)).document.curves


def pieces(curve):
    """The control points (k, 4, 2) of a curve, y down as in the file."""
    return np.concatenate([bezier_segments(piece) for piece in view_of(curve).pieces]) * [1, -1]


def near(actual, expected):
    np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-13 * max(1.0, np.abs(expected).max()))


def test_cubics_are_imported_exactly():
    (curve,) = curves('<path d="M1 2 C3 4 5 -6 7 8 S 9 1 2 3.5 c 1,1 -2 .5-3-4"/>')
    expected = [
        [[1, 2], [3, 4], [5, -6], [7, 8]],
        [[7, 8], [9, 22], [9, 1], [2, 3.5]],
        [[2, 3.5], [3, 4.5], [0, 4], [-1, -0.5]],
    ]
    near(pieces(curve), expected)
    assert curve.family is HERMITE
    assert [point.corner for point in curve.points] == [False, False, True, False]


def test_lines_are_straight_and_have_corners():
    (curve,) = curves('<path d="M0 0 L3 0 v3 H0 l -3-3"/>')
    assert [point.corner for point in curve.points] == [False, True, True, True, False]
    near(pieces(curve)[1], [[3, 0], [3, 1], [3, 2], [3, 3]])


def test_quadratics_are_raised_exactly():
    (curve,) = curves('<path d="M0 0 Q 3 6 6 0 T 12 0"/>')
    near(pieces(curve), [[[0, 0], [2, 4], [4, 4], [6, 0]], [[6, 0], [8, -4], [10, -4], [12, 0]]])
    assert not any(point.corner for point in curve.points)


@each_row("tolerance", [None, 1e-2, 1e-4, 1e-6, 1e-9])
def test_arcs_are_imported_within_the_stated_deviation(tolerance):
    data = svg('<path d="M10 0 A10 10 0 1 0 0 10"/>')
    result = read_svg(data, tolerance)
    (curve,) = result.document.curves
    core = view_of(curve).curve
    distance = np.hypot(*core.evaluate(np.linspace(0, 1, 4001)).T)
    worst = np.abs(distance - 10).max()
    assert 0.5 * result.deviation <= worst + 1e-13 <= result.deviation + 2e-13
    if tolerance is not None:
        assert result.deviation <= tolerance
    assert [point.corner for point in curve.points] == [False] * len(curve.points)


@pytest.mark.parametrize("angle", np.radians([10, 45, 90]))
def test_the_bound_of_an_arc_is_sharp(angle):
    piece = arc(np.zeros(2), np.eye(2) * 7, 0.3, angle, tolerance=None)
    (controls,) = piece.pieces
    s = np.linspace(0, 1, 2001)[:, None]
    cubic = sum(
        weight * control
        for weight, control in zip(
            ((1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3), controls, strict=True
        )
    )
    worst = np.abs(np.hypot(*cubic.T) - 7).max()
    assert 0.99 * piece.deviation - 1e-14 <= worst <= piece.deviation + 1e-14


@each_row(("large", "sweep"), [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_the_flags_of_an_arc(large, sweep):
    # From (1, 0) to (0, 1), with y down: the centre is (0, 0) or (1, 1).
    (curve,) = read_svg(svg(f'<path d="M1 0A1 1 0 {large}{sweep}0 1"/>'), 1e-6).document.curves
    middle = view_of(curve).curve.evaluate(np.linspace(0, 1, 101)) * [1, -1]
    centre = np.array([0, 0]) if large != sweep else np.array([1, 1])
    np.testing.assert_allclose(np.hypot(*(middle - centre).T), 1, atol=1e-5)
    length = np.hypot(*np.diff(middle, axis=0).T).sum()
    assert length == pytest.approx(math.pi * (1.5 if large else 0.5), rel=1e-3)


def test_an_ellipse_too_small_grows_and_an_arc_without_radius_is_a_line():
    (curve,) = curves('<path d="M0 0 A1 2 30 0 1 10 0"/>')
    assert np.abs(view_of(curve).curve.evaluate(1.0) * [1, -1] - [10, 0]).max() < 1e-12
    (line,) = curves('<path d="M0 0 A0 2 30 0 1 9 0"/>')
    near(pieces(line), [[[0, 0], [3, 0], [6, 0], [9, 0]]])


def test_closed_subpaths_are_closed_curves():
    square, loop = curves('<path d="M0 0h4v4h-4z m10 0 c 9 9 -9 9 0 0 z"/>')
    assert square.closed
    assert len(square.points) == 4
    assert all(point.corner for point in square.points)
    assert loop.closed
    assert len(loop.points) == 2
    assert (square.name, loop.name) == ("Path 2 (1)", "Path 2 (2)")
    assert len(curves('<path d="M0 0 1 1 2 0Z L 5 5"/>')) == 2


def test_a_circle_is_smooth_all_round():
    result = read_svg(svg('<circle cx="1" cy="2" r="3"/>'))
    (curve,) = result.document.curves
    assert curve.closed
    assert len(curve.points) == 4
    assert not any(point.corner for point in curve.points)
    points = view_of(curve).curve.evaluate(np.linspace(0, 1, 999)) - [1, -2]
    assert np.abs(np.hypot(*points.T) - 3).max() <= result.deviation * 1.001 <= 3 * 2.8e-4


def test_basic_shapes():
    body = (
        '<rect x="1" y="2" width="4" height="3"/><rect width="4" height="3" rx="1"/>'
        '<ellipse cx="0" cy="0" rx="2" ry="1"/><line x1="0" y1="0" x2="1cm" y2="0"/>'
        '<polyline points="0,0 1,1 2,0"/><polygon points="0 0 1 1 2 0"/>'
        '<rect width="0" height="2"/><circle r="0"/><polyline points=""/>'
    )
    found = curves(body)
    assert [(len(c.points), c.closed) for c in found] == [
        (4, True), (8, True), (4, True), (2, False), (3, False), (3, True),
    ]  # fmt: skip
    assert found[3].points[1].x == pytest.approx(96 / 2.54)


def test_transforms_and_groups():
    (curve,) = curves(
        '<g transform="translate(10,20) rotate(90)"><g transform="scale(2)">'
        '<path transform="matrix(1 0 0 1 1 0) skewX(0)" d="M0 0L3 0"/></g></g>'
    )
    near(pieces(curve)[0, [0, 3]], [[10, 22], [10, 28]])
    (turned,) = curves('<line x2="1" transform="rotate(180, 5, 5)"/>')
    near(pieces(turned)[0, [0, 3]], [[10, 10], [9, 10]])


def test_a_use_is_drawn_and_definitions_are_not():
    body = (
        '<defs><path id="a" d="M0 0L1 0"/></defs><use href="#a" x="5"/><use xlink:href="#a" y="2"/>'
        '<clipPath><path d="M0 0L1 1"/></clipPath><symbol id="s"><path d="M0 0 2 2"/></symbol>'
        '<use href="#s"/>'
    )
    found = curves(body)
    assert [(c.points[0].x, -c.points[0].y) for c in found] == [(5, 0), (0, 2), (0, 0)]


def test_copies_by_use_get_names_from_label_id_or_content():
    """As Inkscape calls them: by label or id, or else after what they show."""
    body = (
        '<path id="a" d="M0 0L1 0"/><g id="b"><path id="c" d="M0 0L1 1"/><path id="d" d="M0 0L2 1"/></g>'
        '<use href="#a"/><use href="#a" id="use1"/><use id="use2" href="#use1"/>'
        '<use href="#a"><title>Twin</title></use><use href="#b"/><use href="#b" id="use3"/>'
    )
    found = [(*curve.groups, curve.name) for curve in curves(body)]
    assert found == [
        ("a",), ("b", "c"), ("b", "d"), ("a copy",), ("use1",), ("use2",), ("Twin",),
        ("b copy", "c"), ("b copy", "d"), ("use3", "c"), ("use3", "d"),
    ]  # fmt: skip


def test_elements_not_displayed_are_imported_hidden():
    body = (
        '<path d="M0 0L1 0"/><path d="M0 0L1 1" display="none"/>'
        '<g style="visibility:hidden"><path d="M0 0L1 1"/><path visibility="visible" d="M0 0L1 1"/></g>'
        '<g style="display:none"><path visibility="visible" d="M0 0L1 1"/></g>'
    )
    assert [curve.visible for curve in curves(body)] == [True, False, False, True, False]


def test_names_and_colours():
    body = (
        '<g stroke="#F00"><path d="M0 0L1 0"><title> the  red </title></path>'
        '<path id="b" style="stroke: rgb(1, 2, 255)" d="M0 0L1 0"/></g>'
        '<path d="M0 0L1 0" fill="orange"/><path stroke="black" d="M0 0L1 0"/>'
        '<path stroke="url(#g)" d="M0 0L1 0"/>'
    )
    assert [(c.name, c.style.colour) for c in curves(body)] == [
        ("the red", "#ff0000"), ("b", "#0102ff"), ("Path 6", "#ffa500"), ("Path 7", "#000000"),
        ("Path 8", "#000000"),
    ]  # fmt: skip


def test_cairo_writes_colours_in_percent():
    (curve,) = curves('<path d="M0 0L1 0" stroke="rgb(100%, 50.2%, 0%)"/>')
    assert curve.style.stroke == "#ff8000"


def test_a_written_svg_is_read_within_the_stated_deviation(kind):
    (curve,) = kind.curves
    result = read_svg(svg_of(kind, Options(tolerance=1e-4, points=True, style=DARK)).data)
    (back,) = result.document.curves
    core, copy = view_of(curve).curve, view_of(back).curve
    path = cubic_shape(core, 1e-4)
    assert back.name == curve.name
    assert len(copy.parameters) == len(path.parameters)
    size = np.abs(core.points).max()
    got = np.concatenate([bezier_segments(piece) for piece in view_of(back).pieces])
    assert np.abs(got - path.control_points).max() <= result.deviation + 1e-12 * size
    assert result.deviation <= 1e-9 * size


def test_smooth_joints_of_a_written_svg_stay_smooth():
    curve = make_curve([(0, 0), (1, 2), (3, 1), (4, 4), (9, 0)], family=HERMITE)
    result = read_svg(svg_of(Document((curve,))).data)
    read = view_of(result.document.curves[0])
    assert read.corners == []
    # Point 1 lies between equal chords; the handles of the others are tied. Nothing jumps: it is one piece.
    assert read.two_sided == [2, 3]
    assert len(read.pieces) == 1
    ring = msgspec.structs.replace(curve, closed=True)
    (back,) = read_svg(svg_of(Document((ring,))).data).document.curves
    core = view_of(ring).curve
    assert back.closed
    assert core.parameters.size == len(back.points) + 1
    assert view_of(back).corners == []
    assert len(view_of(back).pieces) == 1


@each_row(
    ("ahead", "kind"),
    [
        # Behind (10, 5) a handle of 5; ahead as long a one, one of 2, turned by a rounding, by 2°, and back.
        ("15 5", "point-symmetric"),
        ("12 5", "point-smooth"),
        ("12 5.008", "point-smooth"),
        ("12 5.07", "point-corner"),
        ("8 5", "point-corner"),
    ],
)
def test_handles_on_one_line_are_tied(ahead, kind):
    result = read_svg(svg(f'<path d="M0 0C0 5 5 5 10 5C{ahead} 20 5 20 10"/>'))
    (curve,) = result.document.curves
    view = view_of(curve)
    assert kind_at(view, 1).name == kind
    if kind == "point-smooth":
        (joint,) = joint_report(view.curve)
        assert joint.geometric >= 1
        # The curve moves by at most 4/9 of the way of the handle's tip.
        assert result.deviation <= 0.008001 * 4 / 9


def test_the_handle_beside_a_straight_piece_is_tied_to_the_piece():
    (curve,) = curves('<path d="M0 0L10 0C14 0 20 5 20 10L20 20C20 25 10 20 0 0Z"/>')
    assert [kind_at(view_of(curve), index).name for index in range(1, 4)] == ["point-smooth"] * 3
    assert [is_straight(curve, segment) for segment in range(4)] == [True, False, True, False]


def test_a_corner_of_a_written_svg_stays_the_only_one():
    points = [
        Point(0.0, 0.0),
        Point(1.0, 2.0),
        Point(2.0, 0.0, corner=True),
        Point(3.0, 3.0),
        Point(4.0, 0.0),
    ]
    curve = msgspec.structs.replace(make_curve([(0, 0)], family=HERMITE), points=tuple(points))
    (back,) = read_svg(svg_of(Document((curve,))).data).document.curves
    assert [point.corner for point in back.points] == [False, False, True, False, False]


P = '<path d="{}"/>'


CUT = "1 path imported only up to an error in the data: Path 2 "
INVALID = "1 element with invalid lengths, which were ignored: "
NO_CURVE = [
    (P.format("L0 0"), CUT + "at character 1, “L0 0”."),
    (P.format("M0 0 L1"), CUT + "at the end."),
    (
        P.format("M0 0 L1e13 0"),
        "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Path 2.",
    ),
    # Of 7e12 in t from 0 to 1: the document could not be saved, and the whole file was refused.
    (
        P.format("M0 0L9e11 0 0 0 9e11 0 0 0 9e11 0 0 0 9e11 9e11"),
        "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Path 2.",
    ),
    (
        '<path d="M0 0l1e308 0l1e308 0" stroke="red" stroke-linecap="round"/>',
        "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Path 2.",
    ),
    ('<circle id="a" r="five"/>', INVALID + "a r “five”."),
    ('<rect width="-1" height="2"/>', INVALID + "Rect 2 width “-1”."),
    ('<polyline points="0"/>', "1 polyline imported only up to an error in the data: Polyline 2 at the end."),
    ('<use id="a" href="#a"/>', "1 circular reference left out: a."),
    ('<g id="a"><use id="b" href="#a"/></g>', "1 circular reference left out: b."),
    ('<svg id="a"><use href="#a"/></svg>', "1 circular reference left out: Use 3."),
    (
        '<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>',
        "2 circular references left out: Use 5 and Use 3.",
    ),
    (
        '<g transform="scale(1e200)scale(1e200)"><path d="M0 0L1 1"/></g>',
        "1 element with coordinates out of range left out: G 2.",
    ),
    ('<rect width="1e308in" height="1"/>', "1 element with coordinates out of range left out: Rect 2."),
    ("", ""),
    ("<text/>", "1 text left out."),
    (P.format("M5 5Z"), ""),
]


@each_row(("body", "remark"), NO_CURVE)
def test_a_file_without_a_curve_is_an_empty_document(body, remark):
    """All of these were refused."""
    found = read_svg(svg(body))
    assert [curve.points for curve in found.document.curves] == [()]
    assert found.remarks == ((remark,) if remark else ())
    with pytest.raises(ExchangeError) as refusal:
        found.with_curves()
    assert str(refusal.value) == f"The file contains no curves. {remark}".rstrip()


@each_row(("body", "remark"), [row for row in NO_CURVE if row[1]])
def test_an_error_in_one_element_leaves_the_others(body, remark):
    found = read_svg(svg(body + P.format("M3 4H5")))
    assert [[point.position for point in curve.points] for curve in found.document.curves] == [
        [(3, -4), (5, -4)]
    ]
    assert found.remarks == (remark,)


@each_row(
    ("body", "same", "remark"),
    [
        ('<path d="M1 2L3 4" transform="scale(nan)"/>', P.format("M1 2L3 4"), "Path 2 “scale(nan)”"),
        ('<path d="M1 2L3 4" transform="fly(1)"/>', P.format("M1 2L3 4"), "Path 2 “fly(1)”"),
        ('<path d="M1 2L3 4" transform="scale(2) oops"/>', P.format("M1 2L3 4"), "Path 2 at character 9"),
        (
            '<path d="M1 2L3 4" style="transform:rotate(1deg,2px)"/>',
            P.format("M1 2L3 4"),
            "Path 2 “rotate(1deg,2px)”",
        ),
        ('<rect x="2" y="one" width="3" height="4"/>', P.format("M2 0H5V4H2Z"), "Rect 2 y “one”"),
        (
            '<rect rx="-1" ry="1" width="3" height="4"/>',
            '<rect ry="1" width="3" height="4"/>',
            "Rect 2 rx “-1”",
        ),
        ('<ellipse rx="2" ry="-1em"/>', '<circle r="2"/>', "Ellipse 2 ry “-1em”"),
        ('<line x1="?" y1="1 2" x2="3" y2="4"/>', P.format("M0 0L3 4"), "Line 2 x1 “?” and y1 “1 2”"),
        (
            '<use x="#" y="2" href="#a"/><path id="a" d="M1 2L3 4"/>',
            '<use y="2" href="#a"/><path id="a" d="M1 2L3 4"/>',
            "Use 2 x “#”",
        ),
        (
            '<svg x="left" y="2">' + P.format("M1 2L3 4") + "</svg>",
            '<svg y="2">' + P.format("M1 2L3 4") + "</svg>",
            "Svg 2 x “left”",
        ),
        (P.format("M0 0L1 1 x"), P.format("M0 0L1 1"), "Path 2 at character 10, “x”"),
        ('<polygon points="0 0 1 1 2 0 5"/>', P.format("M0 0L1 1 2 0Z"), "Polygon 2 at the end"),
    ],
)
def test_invalid_values_are_ignored(body, same, remark):
    """As browsers do: an invalid attribute is none, and data end at their error."""
    one, other = (read_svg(svg(each)) for each in (body, same))
    assert [curve.points for curve in one.document.curves] == [
        curve.points for curve in other.document.curves
    ]
    assert other.remarks == ()
    assert len(one.remarks) == 1
    assert one.remarks[0].endswith(f": {remark}.")


def test_a_curve_of_too_many_pieces_is_left_out_and_the_others_stay(monkeypatch):
    monkeypatch.setattr("app.exchange.cubics_in.MAX_PIECES", 3)
    found = read_svg(svg(P.format("M0 0h1v1h1v1M5 5h1v1h1M9 9h1v1h1v1")))
    assert [curve.name for curve in found.document.curves] == ["Path 2 (2)"]
    assert found.remarks == ("2 curves of more than 100000 pieces left out: Path 2 (1) and Path 2 (3).",)


@each_row(
    ("attributes", "edges"),
    [
        ('viewBox="0 0 40 40" width="200" height="200"', [0, 200, -200, 0]),
        ('viewBox="-10 -20 40 80" width="4cm" height="8cm"', [-1, 3, -6, 2]),
        ('viewBox="1 2 30 40"', [1, 31, -42, -2]),
        ('width="210mm" height="297mm"', [0, 210, -297, 0]),
        ("", []),
    ],
)
def test_an_empty_page_keeps_its_size_as_guides(attributes, edges):
    found = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}><g id="layer1"/></svg>'.encode())
    guides = found.document.guides
    assert [each.axis.value for each in guides] == ["x", "x", "y", "y"][: len(edges)]
    assert [each.position for each in guides] == pytest.approx(edges)


def test_files_that_are_no_svg_are_refused_with_the_place():
    with pytest.raises(ExchangeError, match="The file is not XML: line 1, column 90"):
        read_svg(svg("<path"))


def test_bombs_are_refused():
    with pytest.raises(ExchangeError, match="more than 10000 elements"):
        read_svg(svg("<g/>" * 10_001))
    with pytest.raises(ExchangeError, match="nested deeper than 200 levels"):
        read_svg(svg("<g>" * 100_000))
    doubling = "".join(f'<g id="g{i}"><use href="#g{i + 1}"/><use href="#g{i + 1}"/></g>' for i in range(14))
    with pytest.raises(ExchangeError, match="more than 10000 paths"):
        read_svg(svg(f'<path d="{"M0 0L1 1" * 10_001}"/>'))
    empty = doubling.replace("g14", "nothing")
    with pytest.raises(ExchangeError, match="draws more than 10000 elements"):
        read_svg(svg(empty + '<g id="nothing"/>'))


ILLUSTRATOR = (
    '<?xml version="1.0" encoding="{encoding}"?>\n<!-- Generator: Adobe Illustrator 16.0.0 -->\n'
    '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" '
    '"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd"{subset}>\n{svg}'
)
LINE = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L3 4"/></svg>'


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_a_plain_doctype_is_ignored(encoding):
    """As matplotlib and Illustrator write it; all of these files used to be refused."""
    text = ILLUSTRATOR.format(encoding=encoding, subset="", svg=LINE)
    (curve,) = read_svg(text.encode(encoding)).document.curves
    assert [point.position for point in curve.points] == [(0, 0), (3, -4)]
    broken = text.replace("</svg>", "</g>")
    with pytest.raises(ExchangeError, match="not XML: line 4, column 63"):
        read_svg(broken.encode(encoding))


# As Illustrator writes it, as Sodipodi did (Matplotlib's hand.svg has that), and others by hand.
NAME_SPACES = (
    ' [\n\t<!ENTITY ns_svg "http://www.w3.org/2000/svg">\n\t<!ENTITY ns_xlink "http://www.w3.org/1999/xlink">\n]',
    LINE.replace("http://www.w3.org/2000/svg", '&ns_svg;" xmlns:xlink="&ns_xlink;'),
)
SUBSETS = {
    "Illustrator": NAME_SPACES,
    "Sodipodi": ('[\n <!ATTLIST svg\n  xmlns:xlink CDATA #FIXED "http://www.w3.org/1999/xlink">\n]', LINE),
    "default name space": (
        "[<!ATTLIST svg xmlns CDATA #FIXED 'http://www.w3.org/2000/svg'>]",
        '<svg><path d="M0 0L3 4"/></svg>',
    ),
    "default value": ("[<!ATTLIST path d CDATA 'M0 0L3 4'>]", LINE.replace('d="M0 0L3 4"', "")),
    "part of an attribute": ('[<!ENTITY end "L3 4">]', LINE.replace("L3 4", "&end;")),
    "elements": ("[<!ENTITY line \"<path d='M0 0L3 4'/>\">]", LINE.replace('<path d="M0 0L3 4"/>', "&line;")),
    "four deep": (
        '[<!ENTITY a "3"><!ENTITY b "L&a;"><!ENTITY c "&b; 4"><!ENTITY d "M0 0&c;">]',
        LINE.replace("M0 0L3 4", "&d;"),
    ),
    "nothing": ("[]", LINE),
}


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1"])
@each_row("name", SUBSETS)
def test_internal_entities_of_a_doctype_are_read(name, encoding):
    subset, body = SUBSETS[name]
    text = ILLUSTRATOR.format(encoding=encoding, subset=subset, svg=body)
    (curve,) = read_svg(text.encode(encoding)).document.curves
    assert [point.position for point in curve.points] == [(0, 0), (3, -4)]


def test_text_that_a_doctype_adds_is_bounded():
    """64 KB: by entities, however they are used and in whichever encoding, and by default values."""

    def read(subset, body):
        for encoding in ("utf-8", "utf-16", "iso-8859-1"):
            yield parse_xml(ILLUSTRATOR.format(encoding=encoding, subset=subset, svg=body).encode(encoding))

    half = 2**15
    entity, body = f'[<!ENTITY ä "{half * "x"}">]', '<svg id="{}"/>'
    assert [len(root.get("id")) for root in read(entity, body.format(2 * "&ä;"))] == [2 * half] * 3
    defaults = f'[<!ATTLIST g d CDATA "{(half - 2) * "x"}">]'
    assert [len(root[1].get("d")) for root in read(defaults, "<svg><g/><g/></svg>")] == [half - 2] * 3
    inside = entity.replace("]", '<!ENTITY b "&#38;ä;">]')
    for subset, used in (
        (entity, body.format(3 * "&ä;")),
        (inside, body.format("&ä;&b;&b;")),
        (entity.replace("]", f'<!ATTLIST svg id CDATA "{3 * "&ä;"}">]'), "<svg/>"),
        (defaults, "<svg><g/><g/><g/></svg>"),
        (defaults.replace("g d", "s:g d"), '<s:svg xmlns:s="s"><s:g/><s:g/><s:g/></s:svg>'),
    ):
        with pytest.raises(ExchangeError, match="Entities and default values of the DOCTYPE exceed 64 KB"):
            list(read(subset, used))


@each_row(
    ("subset", "sentence"),
    [
        (
            '<!ENTITY a ""><!ENTITY b "&a;"><!ENTITY c "&b;"><!ENTITY d "&c;"><!ENTITY e "&d;">',
            "“e” is nested deeper than 4",
        ),
        ('<!ENTITY a "&a;">', "“a” uses “&a;”, which is not declared before it"),
        ('<!ENTITY a "&b;"><!ENTITY b "&a;">', "“a” uses “&b;”, which"),
        ('<!ENTITY a SYSTEM "file:///etc/passwd">', "an entity outside the file, which is not supported"),
        ('<!NOTATION n SYSTEM "n"><!ENTITY a SYSTEM "a" NDATA n>', "an entity outside the file"),
        ('<!ENTITY % a "b">', "a parameter entity, which is not supported"),
        # Expat would skip all that follows, and then drop the entities in attributes.
        ('%a;<!ENTITY b "L9 9">', "a parameter entity, .* delete everything from “<!DOCTYPE” to “]>”"),
    ],
)
def test_external_and_parameter_entities_are_refused(subset, sentence):
    text = ILLUSTRATOR.format(encoding="utf-8", subset=f"[{subset}]", svg=LINE)
    with pytest.raises(ExchangeError, match=sentence):
        read_svg(text.encode())


def test_nothing_that_a_doctype_points_to_is_fetched(tmp_path):
    (tmp_path / "a.dtd").write_text('<!ENTITY a "L9 9">', encoding="utf-8")
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.setblocking(False)
        port = server.getsockname()[1]
        addresses = (f"http://127.0.0.1:{port}/a.dtd", (tmp_path / "a.dtd").as_uri())
        for address, subset in itertools.product(addresses, ("", '[<!ENTITY b "L8 8">]')):
            doctype = f'<!DOCTYPE svg SYSTEM "{address}"{subset}>'
            assert read_svg((doctype + LINE).encode()).document.curves
            # Expat itself would drop the entity from the data and go on.
            with pytest.raises(ExchangeError, match="An entity “&…;” is not declared in the file: line 1"):
                read_svg((doctype + LINE.replace("L3 4", "L3 4&a;")).encode())
        with pytest.raises(BlockingIOError):
            server.accept()


def test_a_picture_of_curvebench_is_recognised_by_its_metadata():
    document = Document((make_curve([(0, 0), (1, 1), (2, 0)], family=HERMITE),))
    found = read_svg(svg_of(document).text.encode()).document
    # The size and the line of a picture that nobody asked for are no part of the document.
    assert (found.unit, found.curves[0].style) == ("", document.curves[0].style)


def test_an_svg_of_matplotlib_is_read():
    """20 of the 24 SVG files in a scientific Python environment begin with a DOCTYPE.

    This one is of Matplotlib 3.11: `Figure().subplots().plot([0, 1, 2], [0, 1, 0], gid="tent")`, no axes.
    """
    data = (Path(__file__).parents[1] / "data/matplotlib.svg").read_bytes()
    assert b"<!DOCTYPE svg PUBLIC" in data
    tent = read_svg(data).document.curves[-1]
    assert tent.style.stroke == "#d04010"
    (x0, low), (x1, high), (x2, end) = (point.position for point in tent.points)
    assert (x1 - x0, end) == pytest.approx((x2 - x1, low))
    assert high > low


def test_other_xml_is_refused():
    with pytest.raises(ExchangeError, match="not an SVG file: it begins with <html>"):
        read_svg(b"<html/>")
    with pytest.raises(ExchangeError, match="The file is empty"):
        read_svg(b" ")
    with pytest.raises(ExchangeError, match="not XML"):
        read_svg(b"<?xml version='1.0' encoding='klingon'?><svg/>")


def test_a_path_of_twice_the_length_is_twice_the_work():
    def calls_for(count):
        data = svg('<path d="M0 0' + "".join(f"C{i} 1 {i} 2 {i + 1} 3" for i in range(count)) + '"/>')
        read = []
        calls = calls_of(lambda: read.extend(read_svg(data).document.curves))
        assert [len(curve.points) for curve in read] == [count + 1]
        return calls

    assert calls_for(2000) < 2.2 * calls_for(1000)


def test_a_long_transform_is_read_in_one_pass():
    """What was left of it was copied for every call: 64 MB for these 32 kB, and quadratically more."""

    class Watched(str):
        __slots__ = ()
        copied = 0

        def __getitem__(self, place):
            found = str.__getitem__(self, place)
            Watched.copied += len(found)
            return found

    text = Watched("scale(1)" * 4000)
    assert transform_of(text).tolist() == [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    assert Watched.copied <= len(text)


def test_of_elements_of_one_id_the_first_is_used():
    """As in browsers; it was the last."""
    twice = P.format('M1 1h1" id="a') + P.format('M5 5h1" id="a')
    (curve,) = read_svg(svg(f'<defs>{twice}</defs><use href="#a"/>')).document.curves
    assert curve.points[0].position == (1, -1)
