"""SVG in: lengths, places and transforms as CSS has them. Expected numbers follow from the specifications."""

import numpy as np
import pytest

from app.exchange.svg.reader import read_svg
from app.view_model.curve.curve_view import view_of
from app.view_model.extents import extent_of
from curvecore import bezier_segments
from tests.rows import each_row


def read(body, attributes='width="200" height="100"'):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{body}</svg>'
    return read_svg(text.encode())


def box(curve):
    """The box around a curve, y down as in the file: left, top, right, bottom."""
    pieces = np.concatenate([bezier_segments(piece) for piece in view_of(curve).pieces])
    (left, bottom), (right, top) = extent_of(pieces)
    return left, -top, right, -bottom


def boxes(body, **more):
    return [pytest.approx(box(curve), abs=1e-9) for curve in read(body, **more).document.curves]


RECT = '<rect width="{0}" height="{0}"/>'


@each_row(
    ("body", "size"),
    [
        (RECT.format("2em"), 32),
        (RECT.format("2ex"), 16),
        (RECT.format("2CH"), 16),
        (RECT.format("2rem"), 32),
        ('<rect width="2em" height="2em" font-size="10"/>', 20),
        ('<rect width="2em" height="2em" style="font-size: 10pt"/>', 80 / 3),
        ('<rect width="2em" height="2em" style="font: italic 700 10px/1.5 \'My Font\', serif"/>', 20),
        ('<rect width="2em" height="2em" style="font: expanded large serif"/>', 36),
        (f'<style>rect {{ font-size: 1.5em }}</style><g font-size="10">{RECT.format("2em")}</g>', 30),
        # Of the parent, one within the other; `rem` is of the root whatever stands between.
        (f'<g font-size="50%"><g font-size="2ex">{RECT.format("2em")}</g></g>', 16),
        (f'<g font-size="3rem">{RECT.format("2em")}</g>', 96),
        (f'<g font-size="64">{RECT.format("2rem")}</g>', 32),
        (f'<g font-size="xx-large">{RECT.format("2em")}</g>', 64),
        (f'<g font-size="12"><g font-size="larger">{RECT.format("1em")}</g></g>', 14.4),
        (f'<g font-size="12"><g font-size="smaller">{RECT.format("1em")}</g></g>', 10),
        (f'<g font-size="12"><g font-size="inherit">{RECT.format("1em")}</g></g>', 12),
        (f'<g font-size="12"><g font-size="initial">{RECT.format("1em")}</g></g>', 16),
        # Invalid ones count as not given.
        (f'<g font-size="12"><g font-size="-3">{RECT.format("1em")}</g></g>', 12),
        (f'<g font-size="12"><g font-size="huge">{RECT.format("1em")}</g></g>', 12),
        # A copy has the font of the place where it is used.
        (f'<defs><g id="a">{RECT.format("1em")}</g></defs><use href="#a" font-size="20"/>', 20),
        (f'<defs><symbol id="a">{RECT.format("1em")}</symbol></defs><use href="#a" font-size="20"/>', 20),
    ],
)
def test_lengths_in_units_of_a_font(body, size):
    """All were left out, or counted as 0, without a word for a stroke."""
    found = read(body)
    (curve,) = found.document.curves
    assert box(curve) == pytest.approx((0, 0, size, size))
    assert found.remarks == ()


def test_a_file_of_a_size_in_units_of_its_font():
    for size, rest in (("10", 'font-size="10"'), ("16", ""), ("24", 'style="font-size:150%"')):
        attributes = f'width="10em" height="5rem" viewBox="0 0 100 50" {rest}'
        found = read('<path d="M0 0L10 10"/><line y2="1rem" x2="50%"/>', attributes)
        first, second = found.document.curves
        assert found.document.unit == "px"
        scale = float(size) / 10
        assert first.points[-1].position == pytest.approx((10 * scale, -10 * scale))
        assert second.points[-1].position == pytest.approx((50 * scale, -float(size) * scale))


def test_strokes_in_font_units_use_the_font_of_the_declaring_element():
    body = (
        '<g font-size="20" stroke="red" style="stroke-width:.1em; stroke-dasharray:1em,2ex 4;'
        'stroke-dashoffset:1rem">'
        '<path font-size="50" d="M0 0L9 9"/></g>'
    )
    (curve,) = read(body).document.curves
    style = curve.style
    assert (style.width, style.dash, style.dash_offset) == (2, (10, 10, 2), 8)


SQUARE = (5, 7, 15, 17)


@each_row(
    "body",
    [
        # The file of the issue: no shape had a size.
        "<style>rect{width:10px;height:10px;x:5px;y:7px}</style><rect/>",
        "<rect style='x:5px;y:7px;width:10px;height:10px'/>",
        "<style>circle{cx:10px;cy:12px;r:5px}</style><circle/>",
        "<style>ellipse{cx:10px;cy:12px;rx:5px}</style><ellipse/>",
        # 5 % of 200, 12 % of 100, and a part of the diagonal over the root of two.
        "<circle style='cx:5%;cy:12%;r:3.162277660168379%'/>",
        "<rect style='x:.5em;y:7px;width:1rem;height:10px;font-size:10px' width='9'/>".replace("1rem", "2ex"),
        "<path style='d:path(\"M5 7H15V17\")'/>",
        "<style>path{d:path('M5 7\\a H15V17')}</style><path d='M0 0L99 99'/>",
        # Attributes are weaker than any rule, rules than the style, and importance counts before that.
        "<style>*{width:10px}</style><rect x='5' y='7' width='99' height='10'/>",
        "<style>#a{x:5px}rect{x:6px}.b{x:7px}</style><rect id='a' class='b' y='7' width='10' height='10'/>",
        "<style>#a{x:6px}</style><rect id='a' x='9' style='x:5px' y='7' width='10' height='10'/>",
        "<style>rect{x:5px!important}</style><rect x='9' style='x:6px' y='7' width='10' height='10'/>",
        # Values that CSS does not take do not count: without a unit, negative sizes, and other words.
        "<rect x='5' y='7' width='10' height='10' style='x:6;y:8;width:-1px;height:10px 2px'/>",
        "<path d='M5 7H15V17' style='d:M0 0L1 1'/>",
        "<style>rect{x:0;width:10px;x:5px}</style><rect y='7' height='10'/>",
        "<style type='text/less'>rect{x:9px}</style><rect x='5' y='7' width='10' height='10'/>",
        # As if nothing was declared.
        "<rect x='5' y='7' width='10' height='10' rx='3' style='rx:initial;'/>",
        "<rect x='5' y='7' width='10' height='10' style='rx:auto;ry:auto'/>",
        # On what has no outline of its own.
        "<style>use{x:5px;y:7px}</style><use href='#a' x='1'/><defs><path id='a' d='M0 0H10V10'/></defs>",
        "<svg style='x:5px;y:7px;width:10px;height:10px' viewBox='0 0 1 1'><path d='M0 0H1V1'/></svg>",
        "<style>use{width:10px;height:10px}</style><use x='5' y='7' href='#a'/>"
        "<symbol id='a' viewBox='0 0 1 1'><path d='M0 0H1V1'/></symbol>",
    ],
)
def test_positions_and_sizes_by_css_are_used(body):
    found = read(body)
    (curve,) = found.document.curves
    assert box(curve) == pytest.approx(SQUARE)
    assert found.remarks == ()


def test_radii_by_css():
    styles = ("", "rx:2px", "rx:2px;ry:0", "rx:auto;ry:5px", "ry:5%;rx:5%")
    body = "".join(f"<rect style='{style}'/>" for style in styles)
    found = read(f"<style>rect{{width:20px;height:10px}}</style>{body}")
    # Of radii of 5 no line is left at the sides, and of those of 5 % of 200 and 100 none at all.
    assert [len(curve.points) for curve in found.document.curves] == [4, 8, 4, 6, 4]
    assert found.remarks == ()


def test_an_outline_removed_by_css_is_not_imported():
    found = read(
        "<path d='M0 0L1 1' style='d:none'/><rect width='5' height='5' style='width:0'/><path d='M0 0L2 2'/>"
    )
    assert [box(curve) for curve in found.document.curves] == [(0, 0, 2, 2)]


def test_unsupported_lengths_give_a_remark():
    found = read(
        "<style>rect{width:calc(1px + 2em);height:5px}circle{r:var(--r)}</style>"
        "<rect id='a'/><circle id='b'/><path d='M0 0L2 2'/>"
    )
    assert len(found.document.curves) == 1
    assert found.remarks == ("2 shapes with lengths of unknown size left out: a and b.",)


@each_row("width", ["2vw", "calc(1px + 1em)", "var(--w)", "2%"])
def test_a_stroke_of_unknown_width_gives_a_remark(width):
    """It was lost without a word."""
    line = f'<path id="a" d="M0 0L2 2" stroke="red" style="stroke-width:{width}" transform="scale(3)"/>'
    found = read(line, "")
    (curve,) = found.document.curves
    assert curve.style.width == pytest.approx(3)
    assert found.remarks == ("1 stroke of unknown width imported with a width of 1: a.",)


def test_unsupported_positions_give_a_remark():
    line = '<path id="a" d="M0 0L2 2"/>'
    found = read(
        line + '<use id="b" href="#a" x="2vw" y="5"/><svg style="x:calc(1px)" y="7">' + line + "</svg>"
    )
    assert [box(curve) for curve in found.document.curves] == [(0, 0, 2, 2), (0, 5, 2, 7), (0, 7, 2, 9)]
    assert found.remarks == ("2 elements with lengths of unknown size, which were ignored: b x and Svg 4 x.",)


@each_row(
    ("style", "width"),
    [
        ("width:40px;height:20px", 40),
        ("width:100%;height:auto", 80),
        ("width:50vw;height:calc(1px)", 80),
        ("", 80),
    ],
)
def test_a_size_of_the_file_by_css(style, width):
    """A picture that is stretched to its page keeps the size that its attributes say."""
    found = read("<path d='M0 0L100 0'/>", f"width='80' height='40' viewBox='0 0 100 50' style='{style}'")
    (curve,) = found.document.curves
    assert curve.points[-1].x == pytest.approx(width)


def test_a_clip_by_css_is_applied_only_where_it_contains_the_shape():
    style = "<style>#c rect{{x:0;y:0;width:{0}px;height:{0}px}}</style>"
    clip = style + "<clipPath id='c'><rect width='1'/></clipPath>"
    for size, said in ((9, ()), (8, ("1 clip path not applied: a.",))):
        found = read(clip.format(size) + "<g id='a' clip-path='url(#c)'><path d='M0 0L9 9'/></g>")
        assert found.remarks == said


def placed(body, **more):
    """The points of the curves, y down as in the file."""
    return [[(each.x, -each.y) for each in curve.points] for curve in read(body, **more).document.curves]


# From (20, 10) to (40, 10), turned by a right angle about the origin, about its start, and about (100, 50).
LINE = '<path d="M20 10H40" {}/>'
ABOUT_ORIGIN, ABOUT_START, ABOUT_MIDDLE = (
    [(-10, 20), (-10, 40)],
    [(20, 10), (20, 30)],
    [(140, -30), (140, -10)],
)


@each_row(
    ("attributes", "points"),
    [
        ('transform="rotate(90)"', ABOUT_ORIGIN),
        ('transform="rotate(90)" transform-origin="20 10"', ABOUT_START),
        ('transform="rotate(90)" transform-origin="20px 1e1px 5px"', ABOUT_START),
        ('transform="rotate(90)" transform-origin="10% 10%"', ABOUT_START),
        (
            'transform="rotate(90)" transform-origin="1.25em 1ex" font-size="16" style="font-size:20px"',
            [(25, 5), (25, 25)],
        ),
        ('transform="rotate(90)" transform-origin="center"', ABOUT_MIDDLE),
        ('transform="rotate(90)" transform-origin="50%"', ABOUT_MIDDLE),
        ('transform="rotate(90)" transform-origin="center 50px"', ABOUT_MIDDLE),
        ('transform="rotate(90)" transform-origin="left top"', ABOUT_ORIGIN),
        ('transform="rotate(90)" transform-origin="top left"', ABOUT_ORIGIN),
        ('transform="rotate(90)" transform-origin="top"', [(90, -80), (90, -60)]),
        ('transform="rotate(90)" transform-origin="bottom right"', [(290, -80), (290, -60)]),
        ('transform="rotate(90)" transform-origin="10% top"', [(10, 0), (10, 20)]),
        ('style="transform:rotate(90deg)"', ABOUT_ORIGIN),
        ('style="transform:rotate(100grad)"', ABOUT_ORIGIN),
        ('style="transform:rotate(0.25turn)"', ABOUT_ORIGIN),
        ('style="transform:rotate(1.5707963267948966rad)"', ABOUT_ORIGIN),
        ('style="transform:RotateZ(90deg);transform-origin:20px 10px"', ABOUT_START),
        # Of the file and of a rule: the stronger one alone.
        ('transform="scale(9)" style="transform:rotate(90deg)"', ABOUT_ORIGIN),
        ('transform="scale(9)" style="transform:none"', [(20, 10), (40, 10)]),
        ('transform="scale(9)" style="transform:initial"', [(20, 10), (40, 10)]),
        ('transform="none"', [(20, 10), (40, 10)]),
        ('transform-origin="50 50"', [(20, 10), (40, 10)]),
        # CSS takes numbers for lengths and angles only where they are 0.
        ('transform="scale(2)" style="transform:rotate(90)"', [(40, 20), (80, 20)]),
        ('transform="rotate(90)" style="transform-origin:20 10"', ABOUT_ORIGIN),
        ('transform="scale(2)" style="transform:rotate(0) translate(0,5px)"', [(20, 15), (40, 15)]),
        ('style="transform:translate(10%,10%)"', [(40, 20), (60, 20)]),
        (
            'style="transform:translate3d(1cm,0,9px) translateZ(2px)"',
            [(20 + 96 / 2.54, 10), (40 + 96 / 2.54, 10)],
        ),
        ('style="transform:scale(200%,.5)"', [(40, 5), (80, 5)]),
        ('style="transform:scaleX(2) scaley(3)"', [(40, 30), (80, 30)]),
        ('style="transform:skew(45deg,0)"', [(30, 10), (50, 10)]),
        ('style="transform:matrix(1,0,0,1,5,6)"', [(25, 16), (45, 16)]),
        # As optimisers write it: a sign or a point begins the next number.
        ('transform="translate(10-5)scale(.5.25)"', [(20, -2.5), (30, -2.5)]),
        ('transform="rotate(90-10-10)"', [(-30, 20), (-30, 40)]),
        ('style="translate:10px;rotate:90deg;scale:2"', [(-10, 40), (-10, 80)]),
        ('style="translate:10% 5px;transform:scale(2)"', [(60, 25), (100, 25)]),
        ('style="translate:none;scale:none" transform="translate(1)"', [(21, 10), (41, 10)]),
    ],
)
def test_transforms_have_their_origin(attributes, points):
    body = LINE.format(attributes)
    assert np.array(placed(body)) == pytest.approx(np.array([points]))
    assert read(body).remarks == ()


@each_row(
    ("attributes", "remark"),
    [
        ('style="transform:rotate3d(1,0,0,45deg)"', "a “rotate3d(1,0,0,45deg)”"),
        ('style="transform:rotateX(45deg)"', "a “rotateX(45deg)”"),
        ('style="transform:translate(calc(1px + 1em))"', "a at character 1"),
        ('style="rotate:x 45deg"', "a “rotate(x 45deg)”"),
        ('transform="translate(2vw)"', "a “translate(2vw)”"),
        ('transform="scale(2)" transform-origin="calc(1px)"', "a about “calc(1px)”"),
        ('transform="scale(2)" transform-origin="middle"', "a about “middle”"),
        ('transform="rotate(1,2)"', "a “rotate(1,2)”"),
        ('transform="scale(2,,,3) x"', "a at character 13"),
    ],
)
def test_unsupported_transforms_give_a_remark(attributes, remark):
    body = f'<path id="a" d="M1 2H3" {attributes}/>'
    assert placed(body) == [[(1, 2), (3, 2)]]
    assert read(body).remarks == (f"1 transform not applied: {remark}.",)


def test_percentages_of_an_unknown_size_give_a_remark():
    found = read('<path id="a" d="M1 2H3" transform="scale(2)" transform-origin="center"/>', "")
    assert found.remarks == ("1 transform not applied: a about “center”.",)


def test_a_transform_is_about_a_position_in_the_nearest_view_box():
    """That begins at the origin of its coordinates, whatever part of them it shows."""
    turned = '<path d="M0 0H1" transform="rotate(90)" transform-origin="center"/>'
    ((first, second),) = placed(turned, attributes='viewBox="-5 -5 20 10"')
    assert np.array([first, second]) == pytest.approx(np.array([(15, -5), (15, -4)]))
    inner = f'<svg x="10" y="10" width="40" height="40" viewBox="0 0 20 20">{turned}</svg>'
    ((first, second),) = placed(inner)
    assert np.array([first, second]) == pytest.approx(np.array([(50, 10), (50, 12)]))


def test_a_use_is_rotated_about_its_origin_before_its_shift():
    line = '<defs><path id="a" d="M0 0H1"/></defs>'
    copy = '<use href="#a" x="3" transform="rotate(90)" transform-origin="5 0"/>'
    ((first, second),) = placed(line + copy)
    assert np.array([first, second]) == pytest.approx(np.array([(5, -2), (5, -1)]))


def test_a_clip_rotated_by_css_is_not_a_box():
    clip = '<clipPath id="c"><rect width="9" height="9" style="{}"/></clipPath>'
    body = '<g id="a" clip-path="url(#c)"><path d="M0 0L9 9"/></g>'
    assert read(clip.format("") + body).remarks == ()
    said = ("1 clip path not applied: a.",)
    assert read(clip.format("transform:rotate(9deg)") + body).remarks == said


BOXES = "<style>#a{{transform-box:{box};{style}}}</style>{body}"
RECT_OF_20 = '<rect id="a" x="60" y="50" width="20" height="10" stroke="red" stroke-width="4" {}/>'
GROUP = (
    '<g id="a"><rect x="30" y="20" width="5" height="5" transform="scale(2)"/>'
    '<path d="M80 50v10" visibility="hidden"/>'
    '<path d="M0 0H999" display="none"/><g display="none"><path d="M0 0H999"/></g><g/></g>'
)


@each_row(
    ("kind", "style", "body", "expected"),
    [
        # Of 20 by 10 at (60, 50), turned about its middle, about its corner, and about those of its stroke.
        ("fill-box", "transform:rotate(90deg);transform-origin:center", RECT_OF_20, (65, 45, 75, 65)),
        ("content-box", "transform:rotate(90deg);transform-origin:50% 50%", RECT_OF_20, (65, 45, 75, 65)),
        ("fill-box", "transform:rotate(90deg)", RECT_OF_20, (50, 50, 60, 70)),
        ("FILL-BOX", "transform:rotate(90deg);transform-origin:10px 1px", RECT_OF_20, (61, 41, 71, 61)),
        ("stroke-box", "transform:rotate(90deg)", RECT_OF_20, (46, 50, 56, 70)),
        ("border-box", "transform:rotate(90deg);transform-origin:left bottom", RECT_OF_20, (60, 64, 70, 84)),
        ("fill-box", "transform:translate(100%,-50%)", RECT_OF_20, (80, 45, 100, 55)),
        ("stroke-box", "translate:100% -50%", RECT_OF_20, (84, 43, 104, 53)),
        ("view-box", "transform:translate(10%,10%)", RECT_OF_20, (80, 60, 100, 70)),
        # The group is a box from (60, 40) to (80, 60): what is hidden counts, what is not displayed does not.
        ("fill-box", "transform:rotate(90deg);transform-origin:center", GROUP, (70, 40, 80, 50)),
        ("fill-box", "transform:scale(2);transform-origin:right", GROUP, (40, 30, 60, 50)),
        (
            "fill-box",
            "transform:rotate(90deg);transform-origin:center",
            '<defs><path id="p" d="M0 0H20V10"/></defs><use id="a" href="#p" x="60" y="50"/>',
            (65, 45, 75, 65),
        ),
        (
            "fill-box",
            "transform:translate(100%)",
            '<circle id="a" cx="20" cy="20" r="10"/>',
            (30, 10, 50, 30),
        ),
        ("fill-box", "transform:translate(100%)", "<g id='a'><g/></g><path d='M1 1L2 2'/>", (1, 1, 2, 2)),
    ],
)
def test_transforms_in_the_box_of_the_element_itself(kind, style, body, expected):
    found = read(BOXES.format(box=kind, style=style, body=body.format("")))
    curve = next(each for each in found.document.curves if each.visible)
    assert box(curve) == pytest.approx(expected)
    assert found.remarks == ()


def test_an_attribute_is_no_transform_box():
    body = RECT_OF_20.format('transform="rotate(90)" transform-box="fill-box" transform-origin="60 50"')
    (curve,) = read(body).document.curves
    assert box(curve) == pytest.approx((50, 50, 60, 70))


def test_a_box_around_text_is_not_known():
    style = "transform:scale(2);transform-origin:center"
    body = '<g id="a"><path d="M1 1L2 2"/><text x="5" y="5">Tree</text></g>'
    found = read(BOXES.format(box="fill-box", style=style, body=body))
    assert [box(curve) for curve in found.document.curves] == [(1, 1, 2, 2)]
    assert found.remarks == ("1 transform not applied: a in its fill-box.", "1 text left out: Tree.")


def test_boxes_within_boxes_are_measured_once():
    """Each group doubles what is in it, about its corner; measured anew for each, 20 are a million visits."""
    style = "<style>g{transform-box:fill-box;transform:scale(2)}</style>"
    for depth in (20, 190):
        found = read(style + "<g>" * depth + '<path d="M3 5h1v1"/>' + "</g>" * depth)
        (curve,) = found.document.curves
        assert box(curve) == pytest.approx((3, 5, 3 + 2.0**20, 5 + 2.0**20))
        # More than 20 are told, not followed.
        assert [each[:26] for each in found.remarks] == ["170 transforms not applied"] * (depth > 20)


def test_a_circular_use_has_no_box():
    style = "<style>g{transform-box:fill-box;transform:scale(2)}</style>"
    found = read(style + '<g id="a"><path d="M3 5L4 6"/><use id="b" href="#a" x="9"/></g>')
    assert [box(curve) for curve in found.document.curves] == [(3, 5, 5, 7)]
    assert found.remarks == ("1 circular reference left out: b.",)


@each_row(
    "attributes",
    [
        'transform="rotate({commas})"',
        'transform="rotate(1{blanks}a)"',
        'stroke-dasharray="{digits}"',
        'style="font:1{letters}"',
        'font-size="1{blanks}x"',
    ],
)
def test_long_values_are_read_in_one_pass(attributes):
    """Each of these took 4 s or more for a tenth of its length, and quadratically more."""
    many = 200_000
    long = {"commas": "," * many, "blanks": " " * many, "digits": "1" * many, "letters": "e" * many}
    assert placed(f'<path d="M1 2H3" {attributes.format(**long)}/>') == [[(1, 2), (3, 2)]]
