"""SVG: well-formed, exact where it can be, within the stated deviation elsewhere."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from app.appearance import theme
from app.document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    make_curve,
)
from app.exchange.cubics_in import guessed_letters
from app.exchange.drawing.styles import DARK, INK, LIGHT
from app.exchange.errors import ExchangeError
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import number, svg_of
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of
from curvecore.bezier.control_points import bezier_segments, cubic_shape
from tests.rows import each_row

SVG = "{http://www.w3.org/2000/svg}"


def paths(text):
    """Every path as pieces (k, 4, 2), y as in the file."""
    found = []
    for element in ET.fromstring(text.encode()).iter(f"{SVG}path"):
        _, start, *pieces = re.split("([MCL])", element.get("d"))[1:]
        pen, control = [float(v) for v in start.split()], []
        for letter, numbers in zip(pieces[::2], pieces[1::2], strict=True):
            piece = [float(v) for v in numbers.split()]
            if letter == "L":
                piece = np.linspace(pen, piece, 4)[1:].ravel().tolist()
            control.append(np.array([*pen, *piece]).reshape(4, 2))
            pen = piece[4:]
        found.append(np.array(control))
    return found


def upright(pieces):
    return pieces * [1, -1]


def stated(text):
    """The deviation in the comment, which is also in the metadata, and the tolerance."""
    pattern = r"Largest deviation from the true curves: (?:about )?(\S+) \(tolerance ([^,)]+)"
    comment, metadata = re.findall(pattern, text)
    assert comment == metadata
    return tuple(map(float, comment))


def core(document):
    return view_of(document.curves[0]).curve


def measured(pieces, curve, parameters, samples=40):
    """The largest distance of points on the pieces from the stretch of the curve that each follows."""
    s, worst = np.linspace(0, 1, samples), 0.0
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3])
    for piece, start, end in zip(pieces, parameters[:-1], parameters[1:], strict=True):
        points, t = weights.T @ piece, np.linspace(start, end, 1001)
        apart = np.hypot(*(points[:, None] - curve.evaluate(t)).T).T
        t, nearest = t[np.argmin(apart, axis=1)], apart.min(axis=1)
        for _ in range(6):  # Newton's steps to the foot of the perpendicular
            velocity = curve.evaluate(t, 1)
            ahead = np.einsum("kd,kd->k", points - curve.evaluate(t), velocity)
            t = np.clip(t + ahead / np.maximum(np.square(velocity).sum(axis=1), 1e-300), start, end)
        worst = max(worst, np.minimum(nearest, np.hypot(*(points - curve.evaluate(t)).T)).max())
    return worst


@each_row("tolerance", [1e-1, 1e-3, 1e-5, 1e-7])
def test_the_path_stays_within_the_stated_deviation(sketch, tolerance):
    text = svg_of(sketch, Options(tolerance=tolerance)).text
    (pieces,) = paths(text)
    curve = core(sketch)
    deviation, said_tolerance = stated(text)
    assert said_tolerance == tolerance
    parameters = cubic_shape(curve, tolerance).parameters
    assert len(pieces) == len(parameters) - 1
    size = np.abs(pieces).max()
    assert measured(upright(pieces), curve, parameters) <= deviation + 20 * 2**-53 * size
    assert deviation <= tolerance * 1.01


def test_the_default_tolerance_is_relative_to_the_size(example):
    text = svg_of(example).text
    deviation, tolerance = stated(text)
    (pieces,) = paths(text)
    size = np.ptp(pieces.reshape(-1, 2), axis=0).max()
    assert 0.5e-5 * size < tolerance < 1e-4 * size
    assert deviation <= tolerance * 1.01


def test_a_cubic_hermite_curve_is_written_bit_for_bit():
    document = Document((make_curve([(0.1, 1 / 3), (2.0, -0.7), (3.3, 1e-7)], family=HERMITE),))
    text = svg_of(document).text
    (pieces,) = paths(text)
    np.testing.assert_array_equal(upright(pieces), bezier_segments(core(document)))
    assert stated(text)[0] == 0


@each_row(
    ("value", "text"),
    [
        (32.29999999999999, "32.3"),
        (1.4999999999999998, "1.5"),
        (-0.30000000000000004, "-0.3"),
        (7.000000000000001e-20, "7e-20"),
        (120000000000.00002, "120000000000"),
        (1 / 3, "0.3333333333333333"),
        (0.1234567890123, "0.1234567890123"),
        (0.30000000000001, "0.30000000000001"),
        (-0.0, "0"),
    ],
)
def test_numbers_have_all_reliable_digits(value, text):
    assert number(value) == text
    assert float(text) == pytest.approx(value, rel=2e-15, abs=0)


def test_the_stated_deviation_is_never_rounded_down(sketch):
    if sketch.curves[0].family is HERMITE:
        return
    exact = cubic_shape(core(sketch), 1e-3).deviation
    assert exact <= stated(svg_of(sketch, Options(tolerance=1e-3)).text)[0] <= 1.01 * exact


def view_box(text):
    return [float(v) for v in ET.fromstring(text.encode()).get("viewBox").split()]


def test_the_view_box_holds_the_curve_with_a_margin(example):
    text = svg_of(example).text
    left, top, width, height = view_box(text)
    (pieces,) = paths(text)
    t = np.linspace(*core(example).domain, 4001)
    on_curve = core(example).evaluate(t) * [1, -1]
    for low, size, values in ((left, width, on_curve[:, 0]), (top, height, on_curve[:, 1])):
        margin = 0.05 * max(width, height)
        assert low + margin < values.min()
        assert values.max() < low + size - margin
    assert min(width, height) >= 0.19 * max(width, height)
    assert len(pieces)


def test_the_nominal_size_keeps_the_shape(sketch):
    for keywords in ({}, {"width": 300}):
        root = ET.fromstring(svg_of(sketch, Options(**keywords)).data)
        _, _, width, height = map(float, root.get("viewBox").split())
        assert float(root.get("width")) / float(root.get("height")) == pytest.approx(width / height, rel=1e-4)
    assert root.get("width") == "300"


@each_row("decimals", [0, 1, 3, 8])
def test_rounded_coordinates_stay_within_the_stated_deviation(sketch, decimals):
    """Decimals are those of pixels: a unit of 250 pixels has three more."""
    text = svg_of(sketch, Options(tolerance=1e-4, format_options={"decimals": decimals})).text
    (pieces,) = paths(text)
    (data,) = (path.get("d") for path in ET.fromstring(text.encode()).iter(f"{SVG}path"))
    pixels = float(ET.fromstring(text.encode()).get("width")) / view_box(text)[2]
    more = sum(pixels > 10.0**power * (1 + 1e-6) for power in range(9))
    assert all(len(digits) <= decimals + more for digits in re.findall(r"\.(\d+)", data))
    path = cubic_shape(core(sketch), 1e-4)
    moved = np.hypot(*(upright(pieces) - path.control_points).reshape(-1, 2).T).max()
    # The deviation is stated with three digits, rounded up.
    assert path.deviation + moved <= stated(text)[0] * (1 + 1e-12)
    assert stated(text)[0] <= 1.01 * (path.deviation + moved)
    assert moved <= 0.71 * 10.0 ** -(decimals + more)
    assert moved * pixels <= 0.71 * 10.0**-decimals * (1 + 1e-6)


def test_lines_stay_lines_with_rounded_coordinates():
    """At four decimals 7 of 12 lines of a letter became cubics: thirds of them were rounded."""
    letter = '<path d="M0 0L.7801 -.9107L1.0103 -.9107L2 1"/>'
    document = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg">{letter}</svg>'.encode()).document
    for decimals in ("all", 0, 1, 2, 4):
        (path,) = ET.fromstring(svg_of(document, Options(format_options={"decimals": decimals})).data).iter(
            f"{SVG}path"
        )
        assert re.sub("[^A-Z]", "", path.get("d")) == "MLLL"


def test_points_are_discs_in_a_separate_group(sketch):
    assert "circle" not in svg_of(sketch).text
    root = ET.fromstring(svg_of(sketch, Options(points=True)).data)
    (group,) = [each for each in root.iter(f"{SVG}g") if each.get("id") == "points"]
    centres = [(float(each.get("cx")), -float(each.get("cy"))) for each in group]
    assert centres == [point.position for point in sketch.curves[0].points]


def test_names_are_labels_and_harmless():
    name = "a<b>&\"'\x00\x1b\ud800]]>--> ‖c′‖"
    curve = make_curve([(0, 0), (1, 1)], name=name)
    root = ET.fromstring(svg_of(Document((curve, curve))).data)
    labels = [
        each.get("{http://www.inkscape.org/namespaces/inkscape}label") for each in root.iter(f"{SVG}path")
    ]
    assert labels == ["a<b>&\"'\ufffd\ufffd\ufffd]]>--> ‖c′‖"] * 2
    ids = [each.get("id") for each in root.iter(f"{SVG}path")]
    assert ids == ["a_b_--_c", "a_b_--_c_2"]


def test_curves_that_cannot_be_drawn_are_mentioned(half_drawn):
    text = svg_of(half_drawn).text
    assert len(paths(text)) == 1
    root = ET.fromstring(text.encode())
    assert "“begun <&>”: A curve needs at least two points." in root.find(f"{SVG}metadata").text
    # Inkscape made that the description of the layer.
    assert root.find(f"{SVG}desc") is None


def test_the_colours_match_the_window():
    for style, window in ((LIGHT, theme.LIGHT), (DARK, theme.DARK)):
        assert (style.ink, style.paper) == (window.ink.name(), window.paper.name())
    assert (INK.ink, INK.paper) == (LIGHT.ink, None)


def test_paper_covers_the_view_box(sketch):
    assert 'id="paper"' not in svg_of(sketch).text
    text = svg_of(sketch, Options(style=DARK)).text
    (paper,) = ET.fromstring(text.encode()).iter(f"{SVG}rect")
    assert [float(paper.get(key)) for key in ("x", "y", "width", "height")] == view_box(text)
    assert paper.get("fill") == "#15181c"


@each_row("scale", [1e-28, 1e-9, 1.0, 1e11])
def test_every_size_in_reach_is_drawn(scale):
    points = (np.random.default_rng(3).normal(size=(5, 2)) * scale).tolist()
    text = svg_of(Document((make_curve(points),))).text
    assert np.abs(paths(text)[0]).max() < 100 * scale
    assert "nan" not in text


def refusal(document, **keywords):
    with pytest.raises(ExchangeError) as caught:
        svg_of(document, Options(**keywords))
    return str(caught.value)


def test_coordinates_out_of_range_for_pictures_are_refused(nothing):
    wild = make_curve([(i, (-1) ** i) for i in range(150)], name="wild")
    assert refusal(Document((wild,))).startswith("“wild” oscillates beyond 1e+30 between points")
    tiny = Document((make_curve([(0, 0), (1e-200, 1e-200)]),))
    assert refusal(tiny) == "The drawing is 1e-200 across; pictures can be 1e-30 to 1e+30."
    far = Document((make_curve([(1e12, 0), (1e12 + 0.001, 0)]),))
    assert refusal(far).endswith("from the origin: too small for a picture.")
    assert refusal(nothing).startswith("There is nothing to draw. “dot”: ")
    assert "Error" not in refusal(nothing)


def test_coincident_points_at_the_origin_are_refused():
    rule = Parametrization(ParametrizationKind.UNIFORM)
    document = Document((Curve("", HERMITE, rule, (Point(0.0, 0.0), Point(0.0, 0.0))),))
    assert refusal(document) == "There is nothing to draw: all points coincide."


@each_row("tolerance", [0.0, -1.0, float("nan"), float("inf")])
def test_the_tolerance_is_positive(sketch, tolerance):
    assert refusal(sketch, tolerance=tolerance) == "The tolerance must be a positive number."


def test_a_tolerance_out_of_reach_is_stated():
    points = np.random.default_rng(5).normal(size=(30, 2)).tolist()
    text = svg_of(Document((make_curve(points),)), Options(tolerance=1e-17)).text
    assert "which was not reached" in text
    assert stated(text)[0] > 1e-17


def test_the_kinds_of_points_are_not_guessed_for_pieces_without_length():
    """A copied curve of which nothing was left in pixels raised a warning of NumPy's."""
    piece = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, 2.0], [3.0, 0.0]])
    assert guessed_letters(np.array([piece, piece + piece[3]]), closed=False) != ""
    nowhere = np.full((4, 2), piece[3])
    for pieces in ([nowhere], [nowhere, nowhere], [piece, nowhere]):
        for closed in (False, True):
            assert guessed_letters(np.array(pieces), closed=closed) == ""


CIRCLES = [
    ('<circle cx="3" cy="4" r="2"/>', ("3", "4", "2", None)),
    ('<circle cx="3" cy="4" r="2" transform="translate(1 1) scale(2)"/>', ("7", "9", "4", None)),
    ('<circle cx="3" cy="4" r="2" transform="rotate(30 3 4)"/>', ("3", "4", "2", "rotate(30 3 4)")),
    ('<circle cx="3" cy="4" r="2" fill="none" stroke="#c04020" stroke-width="0.5"/>', ("3", "4", "2", None)),
    ('<ellipse cx="3" cy="4" rx="2" ry="2"/>', ("3", "4", "2", None)),
]


@each_row(("element", "expected"), CIRCLES)
def test_a_circle_is_written_as_one_and_read_as_the_same_curve(element, expected):
    (curve,) = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg">{element}</svg>'.encode()).document.curves
    text = svg_of(Document((curve,))).text
    (circle,) = ET.fromstring(text.encode()).iter(f"{SVG}circle")
    assert tuple(map(circle.get, ("cx", "cy", "r", "transform"))) == expected
    s = np.linspace(0.0, 1.0, 4001)
    quarter = [(1, 0), (1, 4 / 3 * (np.sqrt(2) - 1)), (4 / 3 * (np.sqrt(2) - 1), 1), (0, 1)]
    bernstein = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)
    off = float(expected[2]) * np.abs(np.hypot(*(bernstein @ np.array(quarter)).T) - 1).max()
    assert off * (1 - 1e-6) <= stated(text)[0] <= 1.01 * off
    (back,) = read_svg(text.encode()).document.curves
    assert back.style == curve.style
    assert back.closed
    for point, other in zip(back.points, curve.points, strict=True):
        assert point.position == pytest.approx(other.position, abs=1e-14)
        assert point.velocity == pytest.approx(other.velocity, abs=1e-12)


NO_CIRCLES = [
    '<ellipse cx="3" cy="4" rx="2" ry="2.000001"/>',
    '<circle cx="3" cy="4" r="2" transform="skewX(1)"/>',
    '<rect width="2" height="2" rx="0.9"/>',
    '<path d="M1 0C1 .55 .55 1 0 1C-.55 1-1 .55-1 0C-1-.55-.55-1 0-1C.55-1 1-.55 1 0Z"/>',
    '<path d="M1 0A1 1 0 0 1 -1 0A1 1 0 0 1 1 0M3 0L4 1"/>',
]


@each_row("element", NO_CIRCLES)
def test_what_is_not_exactly_a_circle_stays_a_path(element):
    document = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg">{element}</svg>'.encode()).document
    root = ET.fromstring(svg_of(document).data)
    assert not list(root.iter(f"{SVG}circle"))
    assert len(list(root.iter(f"{SVG}path"))) == 1


def test_a_circle_with_rounded_numbers_stays_within_the_stated_deviation():
    """A circle about 1/3, 2/3 with a radius of 5/7, of one decimal: the farthest point moves by 0.061."""
    data = f'<svg xmlns="http://www.w3.org/2000/svg"><circle cx="{1 / 3}" cy="{2 / 3}" r="{5 / 7}"/></svg>'
    document = read_svg(data.encode()).document
    text = svg_of(document, Options(format_options={"decimals": 1, "svg_scale": 1.0})).text
    (circle,) = ET.fromstring(text.encode()).iter(f"{SVG}circle")
    assert tuple(map(circle.get, ("cx", "cy", "r"))) == ("0.3", "0.7", "0.7")
    moved = np.hypot(1 / 3 - 0.3, 2 / 3 - 0.7) + 5 / 7 - 0.7
    assert moved <= stated(text)[0] <= 1.1 * moved
