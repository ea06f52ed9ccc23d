"""Styles of SVG files: what comes in, what goes out, and what is said of the rest."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, make_curve
from app.document.style import FillRule, LineCap, LineJoin, Style
from app.exchange.options import Options
from app.exchange.svg.coordinates import fitted_box
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.units import in_unit
from app.storage.validation import validate
from tests.rows import each_row

SVG = "{http://www.w3.org/2000/svg}"
LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
LINE = "M0 0L4 0L4 4"


def svg(body, attributes=""):
    head = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    spaces = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
    spaces += 'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd"'
    return f"{head} {spaces} {attributes}>{body}</svg>".encode()


def read(body, attributes=""):
    found = read_svg(svg(body, attributes))
    validate(found.document)
    return found


def curves(body, attributes=""):
    return read(body, attributes).document.curves


def style(attributes, around=""):
    (curve,) = curves(f'{around}<path d="{LINE}" {attributes}/>{"</g>" if around else ""}')
    return curve.style


def test_an_area_is_black_without_a_line_by_default():
    assert style("") == Style(stroke="none", fill="#000000")


def test_all_properties_of_a_stroke_are_imported():
    assert style(
        'fill="none" stroke="#0af" stroke-width="2" stroke-linecap="square" stroke-linejoin="bevel" '
        'stroke-miterlimit="7" stroke-dasharray="4 1,2" stroke-dashoffset="3" stroke-opacity="50%" '
        'opacity=".25"'
    ) == Style(
        stroke="#00aaff",
        width=2.0,
        cap=LineCap.SQUARE,
        join=LineJoin.BEVEL,
        miter_limit=7.0,
        dash=(2.0, 0.5, 1.0),
        dash_offset=1.5,
        stroke_opacity=0.125,
    )


def test_an_odd_number_of_dashes_is_imported_unchanged():
    """Written twice, 35 were more than a document may have, and the drawing was refused."""
    found = style(f'stroke="red" stroke-dasharray="{" ".join(["1"] * 35)}"')
    assert found.dash == (1.0,) * 35
    assert len(found.dashes_and_gaps) == 70


def test_fills_have_their_rule_and_opacity():
    seen = style('fill="rgba(255, 0, 0, .5)" fill-rule="evenodd" fill-opacity=".5"')
    assert (seen.fill, seen.fill_rule, seen.fill_opacity) == ("#ff0000", FillRule.EVENODD, 0.25)


@each_row(
    ("paint", "code"),
    [
        ("rebeccapurple", "#663399"),
        ("RED", "#ff0000"),
        ("#abc", "#aabbcc"),
        ("rgb(100%, 50.2%, 0%)", "#ff8000"),
        ("rgb(1 2 3 / 20%)", "#010203"),
        ("hsl(120, 100%, 25%)", "#008000"),
        ("hsl(38 92% 50%)", "#f59f0a"),
        ("currentColor", "#00ff00"),
        ("inherit", "#112233"),
        ("no colour at all", "#112233"),
        ("none", "none"),
    ],
)
def test_every_colour_of_css(paint, code):
    assert style(f'fill="{paint}"', '<g fill="#112233" color="lime">').fill == code


def test_rules_outweigh_attributes_and_style_outweighs_rules():
    sheet = (
        "<style>/* c */ .a{fill:red;stroke:red} g > .a{stroke:blue} #x{fill:lime} .b{fill:teal!important}"
        "path:hover{fill:pink} .a, .c{stroke-width:3px} .d{nonsense}</style>"
    )
    body = (
        f'{sheet}<g><path class="a" fill="gray" d="{LINE}"/>'
        f'<path class="a q" style="stroke:#123456" d="{LINE}"/>'
        f'<path id="x" class="a" d="{LINE}"/><path class="b" style="fill:red" d="{LINE}"/></g>'
    )
    seen = [curve.style for curve in curves(body)]
    assert [each.fill for each in seen] == ["#ff0000", "#ff0000", "#00ff00", "#008080"]
    assert [each.stroke for each in seen] == ["#0000ff", "#123456", "#0000ff", "none"]
    assert [each.width for each in seen] == [3.0, 3.0, 3.0, None]


def test_transforms_scale_strokes_and_dashes_stay_in_proportion():
    body = (
        f'<g transform="scale(3)"><path d="{LINE}" stroke="red" stroke-width="2" stroke-dasharray="2 6"/></g>'
    )
    (curve,) = curves(body)
    assert (curve.style.width, curve.style.dash) == (pytest.approx(6.0), pytest.approx((1.0, 3.0)))
    (kept,) = curves(body.replace("stroke-w", 'vector-effect="non-scaling-stroke" stroke-w'))
    assert kept.style.width == 2.0


def test_an_uneven_transform_gives_a_remark():
    found = read(f'<path id="a" d="{LINE}" stroke="red" transform="scale(1 4)"/>')
    assert found.document.curves[0].style.width == pytest.approx(2.0)
    assert found.remarks == ("1 stroke of uneven width imported with the mean width: a.",)


@each_row(
    ("attributes", "unit", "end"),
    [
        ('width="70mm" height="50mm" viewBox="0 0 140 100"', "mm", 2.0),
        ('width="1in" height="1in"', "in", 4 / 96),
        ('width="24" height="24" viewBox="0 0 24 24"', "px", 4.0),
        ('width="48px" viewBox="0 0 24 12"', "px", 8.0),
        ('viewBox="-2 -3 24 12"', "", 4.0),
        ('width="100%" height="100%" viewBox="0 0 8 8"', "", 4.0),
        ('width="2cm" height="1cm" viewBox="0 0 10 10"', "cm", 0.4),
        ('width="2cm" height="1cm" viewBox="0 0 10 10" preserveAspectRatio="none"', "cm", 0.8),
        ("", "", 4.0),
    ],
)
def test_units(attributes, unit, end):
    document = read(f'<path d="{LINE}"/>', attributes).document
    assert document.unit == unit
    assert document.curves[0].points[1].x == pytest.approx(end, rel=1e-12)


@each_row(
    ("ratio", "matrix"),
    [
        ("", [[2, 0, 10], [0, 2, 5]]),
        ("xMinYMax meet", [[2, 0, 0], [0, 2, 5]]),
        ("xMaxYMid slice", [[4, 0, 0], [0, 4, -5]]),
        ("none", [[4, 0, 0], [0, 2, 5]]),
    ],
)
def test_the_view_box_fills_its_viewport(ratio, matrix):
    assert (
        fitted_box((0, 0, 10, 10), (0, 5, 40, 20), ratio)[:, :2].tolist() == np.array(matrix)[:, :2].tolist()
    )
    assert fitted_box((0, 0, 10, 10), (0, 5, 40, 20), "xMidYMid")[:, 2].tolist() == [10, 5]


def test_compound_paths_are_one_shape():
    ring = "M0 0H9V9H0ZM3 3V6H6V3Z"
    found = curves(f'<path id="a" d="{ring}" fill-rule="evenodd"/><path id="a" d="{ring}"/>')
    assert [curve.shape for curve in found] == ["a", "a", "a 2", "a 2"]
    assert [curve.style.fill_rule.value for curve in found] == ["evenodd", "evenodd", "nonzero", "nonzero"]


def test_groups_and_names_are_read_in_the_dialects_of_other_programs():
    body = (
        '<g inkscape:label="Layer &lt;1>" inkscape:groupmode="layer" id="g1">'
        f'<g id="Badge_x0020_2"><path id="p" inkscape:label="Leaf" d="{LINE}"/></g>'
        f'<g><path data-name="Inner mark" id="q" d="{LINE}"/><rect width="2" height="2"/></g>'
        f'<g><path id="alone" d="{LINE}"/></g></g><g id="g1"><path id="r" d="{LINE}"/></g>'
    )
    found = curves(body)
    assert [curve.name for curve in found] == ["Leaf", "Inner mark", "Rect 7", "alone", "r"]
    outer = "Layer <1>"
    assert [curve.groups for curve in found] == [
        (outer, "Badge 2"), (outer, "Group"), (outer, "Group"), (outer,), ("g1",),
    ]  # fmt: skip


def test_hidden_and_locked_groups():
    body = (
        f'<g style="display:none"><path d="{LINE}"/></g><g sodipodi:insensitive="true"><path d="{LINE}"/></g>'
    )
    assert [(curve.visible, curve.locked) for curve in curves(body)] == [(False, False), (True, True)]


def test_use_of_symbols_with_view_boxes():
    body = (
        '<symbol id="s" viewBox="0 0 10 10"><path d="M0 0L10 10" stroke="currentColor"/></symbol>'
        '<use href="#s" x="100" y="20" width="40" height="20" color="red"/>'
    )
    (curve,) = curves(body)
    assert [point.position for point in curve.points] == [(110, -20), (130, -40)]
    assert (curve.style.stroke, curve.style.width) == ("#ff0000", pytest.approx(2.0))


CLIP = '<clipPath id="c"><{}/></clipPath><g clip-path="url(#c)"><path id="a" d="M0 0H9V9Z"/></g>'
MISSED = [
    (
        '<text id="t"><tspan x="1">Hi</tspan><textPath href="#there">Ho</textPath></text>',
        "1 text left out: t.",
    ),
    ('<flowRoot id="f"><flowPara>Hi</flowPara></flowRoot>', "1 text left out: f."),
    ('<image href="file:///etc/passwd" width="2" height="2"/>', "1 picture left out."),
    ('<use href="other.svg#a"/>', "1 reference to elements outside the file left out."),
    ('<path d="M0 0h9" fill="none"/>', "1 shape without stroke and fill left out."),
    ('<path id="a" d="M2 2h9" transform="scale(0)" stroke="red"/>', "1 single point left out: a."),
    (
        '<pattern id="p"/><rect width="2" height="2" fill="url(#p) lime"/>',
        "1 pattern imported as one colour.",
    ),
    ('<rect width="2" height="2" fill="url(#q)" stroke="red"/>', "1 missing paint left out."),
    (CLIP.format("text"), "1 clip path not applied."),
    (CLIP.format('circle r="20"'), "1 clip path not applied."),
    (CLIP.format('rect width="5" height="20"'), "1 clip path not applied."),
    (
        '<svg viewBox="0 0 4 4" width="4" height="4"><path d="M0 0H9V9Z"/><path d="M0 0H8V8Z"/></svg>',
        "1 element imported whole, beyond the view box.",
    ),
    ('<path d="M0 0H9V9Z" style="mask:url(#m)"/>', "1 mask not applied."),
    ('<path d="M0 0H9V9Z" filter="url(#m)"/>', "1 filter not applied."),
    ('<path d="M0 0H9V9Z" marker-end="url(#m)"/>', "1 shape imported without markers."),
    ('<path d="M0 0H9V9Z" style="mix-blend-mode:multiply"/>', "1 blend mode not applied."),
    (
        '<g style="mix-blend-mode:multiply"><path d="M0 0H9V9Z"/><path d="M0 0H9V9Z"/></g>',
        "1 blend mode not applied.",
    ),
    ("<style>@import url(http://localhost/a.css);</style>", "1 style rule ignored: @import."),
    ("<style>a:::b{fill:red}</style>", "1 style rule ignored: a:::b."),
    ("<style>g{fill:red;path{fill:blue}}</style>", "1 style rule ignored: path within another."),
    (
        "<style>path{@media print{fill:blue}&amp;.a{x:2px}}</style>",
        "2 style rules ignored: @media print within another and &.a within another.",
    ),
    ('<rect width="2vw" height="2"/>', "1 shape with lengths of unknown size left out: Rect 2."),
    ("<script>alert(1)</script>", "1 script not run: alert(1)."),
    ('<g><set attributeName="x"/><path d="M0 0H9V9Z"/></g>', "1 animation not played."),
    (
        '<path d="M0 0H9V9Z"><animate attributeName="d"/><animateMotion id="to"/></path>',
        "2 animations not played: to.",
    ),
    ('<use href="#there"><animate attributeName="x"/></use>', "1 animation not played."),
]


@each_row(("body", "sentence"), MISSED, ids=[sentence[:40] for _, sentence in MISSED])
def test_unsupported_content_gives_a_remark(body, sentence):
    found = read(f'{body}<path id="there" d="{LINE}"/>')
    assert found.remarks == (sentence,)
    assert found.document.curves[-1].name == "there"


def test_losses_are_counted_by_kind():
    """Each element had a sentence: a hundred gradients made a hundred lines."""
    stops = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
    shapes = "".join(
        f'<path id="{name}" d="M0 0H9V9Z" fill="url(#g)"/><text>{name}</text><image/>'
        for name in ("sky", "sea", "sand", "sun", "ship")
    )
    use = '<use href="#sky"/>' * 4
    assert read(f'<linearGradient id="g">{stops}</linearGradient>{shapes}{use}').remarks == (
        "5 gradients imported as one colour: sky, sea, sand and 2 more.",
        "5 texts left out: sky, sea, sand and 2 more.",
        "5 pictures left out.",
    )


@each_row(
    "body",
    [
        CLIP.format('rect width="20" height="20"'),
        CLIP.format('path d="M-1-1h20v20h-20z"'),
        f'<svg viewBox="0 0 4 4" width="4" height="4" overflow="visible"><path d="{LINE}"/></svg>',
        f'<svg viewBox="0 0 99 99" width="9" height="9"><path d="{LINE}"/></svg>',
        f'<path d="{LINE}"/><g display="none"><text>hidden</text></g>',
        f'<switch><foreignObject requiredExtensions="x"/><path d="{LINE}"/></switch>',
        f'<path d="{LINE}ZM5 5Z" marker-end="none" filter="none" clip-path="none" mask="none"/>',
        f'<linearGradient id="g"><stop stop-color="red"/></linearGradient><path fill="url(#g)" d="{LINE}"/>',
    ],
)
def test_content_without_effect_gives_no_remark(body):
    assert read(body).remarks == ()


def test_a_drawing_without_any_paint_is_imported_as_lines():
    found = read(f'<path d="{LINE}" fill="none"/>')
    assert found.document.curves[0].style == Style()
    assert found.remarks == ("1 shape without stroke and fill imported with a plain stroke.",)


# Out


def drawn(*parts, unit=""):
    return Document(parts, unit=unit)


def square(side, name="Square", **fields):
    points = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
    return replace(make_curve(points, name=name), closed=True, **fields)


def root_of(document, **options):
    return ET.fromstring(svg_of(document, Options(**options)).data)


def test_a_style_is_written_without_the_defaults_of_svg():
    plain = Style(stroke="none", fill="#ff0000", join=LineJoin.MITER, cap=LineCap.BUTT)
    (path,) = root_of(drawn(square(2.0, style=plain))).iter(f"{SVG}path")
    assert set(path.attrib) == {"id", "d", "fill"}
    rich = Style(
        stroke="#0000ff", width=0.5, cap=LineCap.SQUARE, join=LineJoin.MITER, miter_limit=8.0,
        dash=(2.0, 1.0), dash_offset=0.5, stroke_opacity=0.5, fill="#00ff00", fill_rule=FillRule.EVENODD,
        fill_opacity=0.25,
    )  # fmt: skip
    (path,) = root_of(drawn(square(2.0, style=rich))).iter(f"{SVG}path")
    assert {name: value for name, value in path.attrib.items() if name not in ("id", "d")} == {
        "fill": "#00ff00", "fill-rule": "evenodd", "fill-opacity": "0.25", "stroke": "#0000ff",
        "stroke-width": "0.5", "stroke-linecap": "square", "stroke-miterlimit": "8",
        "stroke-opacity": "0.5",
        # Of attributes Inkscape enlarges the width alone: among millimetres dashes of pixels grew together.
        "style": "stroke-dasharray:1,0.5;stroke-dashoffset:0.25",
    }  # fmt: skip


def test_a_shape_is_one_path_and_groups_are_groups():
    look = {"shape": "Ring", "groups": ("A", "B")}
    document = drawn(
        square(9.0, "out", **look),
        square(3.0, "in", **look),
        square(1.0, "dot", groups=("A",)),
        square(2.0, "free"),
    )
    root = root_of(document)
    ring, dot, free = root.iter(f"{SVG}path")
    assert (ring.get("id"), ring.get("d").count("M")) == ("Ring", 2)
    (outer,) = [each for each in root if each.get("id") == "A"]
    inner, second = outer
    assert second is dot
    assert list(inner) == [ring]
    assert free in list(root)


def test_ids_are_unique_and_names_are_labels():
    document = drawn(
        square(1.0, "1st leaf"), square(2.0, "paper"), square(3.0, "Ünïcode"), square(4.0, "paper")
    )
    paths = list(root_of(document).iter(f"{SVG}path"))
    assert [path.get("id") for path in paths] == ["curve_1st_leaf", "paper_2", "n_code", "paper_3"]
    assert [path.get(LABEL) for path in paths] == ["1st leaf", "paper", "Ünïcode", "paper"]


def test_a_unit_gives_the_true_size():
    document = drawn(square(2.0, style=Style(stroke="none", fill="#000000")), unit="mm")
    root = root_of(document, unit=document.unit)
    _, _, *sizes = map(float, root.get("viewBox").split())
    for name, length in zip(("width", "height"), sizes, strict=True):
        assert root.get(name).endswith("mm")
        assert float(root.get(name).removesuffix("mm")) == pytest.approx(length, rel=1e-6)
    assert root.get("style") is None
    assert not list(root.iter(f"{SVG}rect"))
    back = read_svg(svg_of(document, Options(unit="mm")).data).document
    assert back.unit == document.unit
    assert {each.position for each in document.curves[0].points} <= {
        each.position for each in back.curves[0].points
    }


def test_a_wide_line_has_room_in_the_picture():
    thin, wide = (root_of(drawn(square(2.0, style=Style(width=width)))) for width in (0.01, 1.0))
    widths = [float(root.get("viewBox").split()[2]) for root in (thin, wide)]
    assert widths[1] > widths[0] + 0.9


def test_ink_and_the_usual_width_are_read_as_defaults():
    document = drawn(square(2.0), square(3.0, "area", style=Style(stroke="none", fill="")))
    back = read_svg(svg_of(document).data).document
    assert [curve.style for curve in back.curves] == [Style(), Style(stroke="none", fill="")]


def test_lengths_are_the_same_in_another_unit():
    found = read(f'<path d="{LINE}" stroke="red"/>', 'width="1in" height="1in" viewBox="0 0 4 4"').document
    there = in_unit(found, "mm")
    assert there.unit == "mm"
    assert there.curves[0].points[1].x == pytest.approx(25.4)
    assert there.curves[0].style.width == pytest.approx(25.4 / 4)
    old, new = found.curves[0].points[1].velocity_after, there.curves[0].points[1].velocity_after
    assert new == pytest.approx(tuple(25.4 * each for each in old))
    assert in_unit(found, "s") is found
    assert in_unit(replace(found, unit=""), "mm").curves is found.curves


@each_row(
    ("text", "is_told"),
    [
        ("normal", False),
        ("fill stroke markers", False),
        ("stroke", True),
        ("markers stroke fill", True),
        ("markers", False),
    ],
)
def test_a_fill_over_its_stroke_gives_a_remark(text, is_told):
    """SVG 2, section 13.8: what is not named comes last, in the usual order."""
    found = read(f'<path d="M0 0H9V9Z" stroke="red" paint-order="{text}"/>')
    assert found.remarks == ("1 paint order not applied.",) * is_told
    assert read(f'<path d="M0 0H9V9Z" paint-order="{text}"/>').remarks == ()
