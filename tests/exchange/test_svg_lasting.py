"""What things are lasts over an SVG file, in words of Inkscape or our own; others see the outlines."""

import re

import numpy as np
import pytest
from msgspec.structs import astuple, replace

from app.document.form_edits import formed_anew
from app.document.forms import Ellipse, Star
from app.document.model import Document, Page, make_curve
from app.document.text import Text, TextAlign
from app.document.transforms import Affine, rotation, transform_points
from app.exchange.formats.pictures import read
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.writer import svg_of
from app.view_model.curve.curve_view import view_of
from app.view_model.shapes.formed import formed, with_form

PAGE = Page(0.0, 0.0, 100.0, 100.0)
HEAD = """<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100"
 xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
 xmlns:s="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd">"""
# As Inkscape 1.2 writes them: of eight digits, in steps.
NOTED = (
    's:type="star" inkscape:flatsided="false" s:sides="5" s:cx="50" s:cy="40" s:r1="30" s:r2="12" '
    's:arg1="0.3" s:arg2="0.928318" inkscape:rounded="0" inkscape:randomized="0" '
)
RUNS = (
    "M 78.660095,48.865606 57.190178,49.607359 50.424764,69.996993 43.084746,49.807102 21.602424,49.673555 "
    "38.53596,36.453764 32.024569,15.981593 49.830088,28.001203 67.288149,15.482253 61.359028,36.130572 Z"
)
INKSCAPE = f"""{HEAD}
<path id="star" {NOTED} d="{RUNS}" fill="#d00" transform="rotate(10,44.553365,53.331682)"/>
<path id="polygon" s:type="star" inkscape:flatsided="true" s:sides="6" s:cx="20" s:cy="70" s:r1="10"
 s:r2="8.6599998" s:arg1="0.3" s:arg2="0.8236" inkscape:rounded="0" inkscape:randomized="0" fill="#00d"
 d="m 29.553365,72.955202 -7.335963,6.795856
 -9.553365,-2.955202 -2.217402,-9.751058 7.335963,-6.795856 9.553365,2.955202 z"/>
<path id="circle" s:type="arc" s:cx="70" s:cy="80" s:rx="10" s:ry="5" fill="#0d0"
 d="M 80,80 A 10,5 0 1 1 60,80 10,5 0 1 1 80,80 Z"/>
</svg>
"""


def corners(curve):
    return np.array([point.position for point in curve.points])


def is_near(curve, other, room=1e-9):
    return np.abs(corners(curve) - corners(other)).max() <= room


@pytest.mark.parametrize("by", [None, rotation(33.0, (0.0, 0.0)), Affine(-2.0, 0.0, 0.0, 0.0, (30.0, 0.0))])
@pytest.mark.parametrize("fields", [{}, {"corners": 7.0, "ratio": 0.3, "angle": 20.0}, {"ratio": 1.0}])
def test_a_star_is_one_to_inkscape_and_comes_back_turned_and_mirrored(fields, by):
    document = Document((formed_anew(make_curve(()), Star(30.0, 40.0, 20.0, **fields)),), page=PAGE)
    if by is not None:
        document = transform_points(document, 0, range(len(document.curves[0].points)), by)
    text = svg_of(document).data.decode()
    (curve,), (own,) = read(text.encode(), None).document.curves, document.curves
    assert is_near(curve, own)
    now, then = formed(curve).form, formed(own).form
    assert astuple(now)[:5] == pytest.approx(astuple(then)[:5])
    assert f'sodipodi:sides="{then.corners:.0f}" ' in text
    assert text.count(f'inkscape:flatsided="{str(then.is_polygon).lower()}"') == 1
    # Where its corners are by these numbers, the path has some.
    told = {name: float(value) for name, value in re.findall(r'sodipodi:(\w+)="([-.\de]+)"', text)}
    first, second = (
        (told["cx"] + told[far] * np.cos(told[angle]), told["cy"] + told[far] * np.sin(told[angle]))
        for far, angle in (("r1", "arg1"), ("r2", "arg2"))
    )
    places = corners(curve) * (1.0, -1.0) + (0.0, 100.0)
    for place in [first, second] if not then.is_polygon else [first]:
        assert np.hypot(*(places - place).T).min() < 1e-9


def test_a_skewed_star_is_a_path():
    document = Document((formed_anew(make_curve(()), Star(30.0, 40.0, 20.0)),), page=PAGE)
    points = range(len(document.curves[0].points))
    skewed = transform_points(document, 0, points, Affine(0.0, 0.5, 0.0, 0.0, (30.0, 40.0)))
    assert b"sodipodi:type" not in svg_of(skewed).data


def test_what_inkscape_notes_of_a_star_or_an_ellipse_is_known():
    star, polygon, circle = (formed(curve) for curve in read(INKSCAPE.encode(), None).document.curves)
    assert (type(star.form), star.form.corners, star.form.ratio, star.form.radius) == (Star, 5, 0.4, 30)
    assert (polygon.form.is_polygon, polygon.form.corners, polygon.form.radius) == (True, 6, 10)
    assert circle.form == Ellipse(60.0, 15.0, 20.0, 10.0)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        # Rounded or otherwise not what it says: the path counts. Or hostile.
        (RUNS, RUNS.replace("78.660095", "79")),
        ('sides="5"', 'sides="6"'),
        ('sides="5"', 'sides="1e300"'),
        ('sides="5"', 'sides="nan"'),
        ('r1="30"', 'r1="0"'),
        ('r2="12"', 'r2="-12"'),
        ('arg1="0.3"', 'arg1="inf"'),
        ('cx="50"', 'cx=""'),
        (RUNS, RUNS.replace("57.190178,49.607359", "C 60 60 60 60 57.190178,49.607359 L")),
    ],
)
def test_a_star_that_is_drawn_otherwise_than_noted_is_a_path(old, new):
    assert INKSCAPE.count(old) > 0
    curve = read(INKSCAPE.replace(old, new, 1).encode(), None).document.curves[0]
    assert curve.form is None


def test_in_its_file_a_star_stays_one_and_a_new_one_is_one():
    data = INKSCAPE.encode()
    document = read(data, None).document
    assert rewritten(data, document, document).data == data
    now = formed(document.curves[0])
    changed = with_form(document, 0, replace(now.form, corners=8.0, ratio=0.5), now.by)
    written = rewritten(data, changed, document).data
    assert b'<path id="star" s:type="star" inkscape:flatsided="false" s:sides="8"' in written
    assert b'transform="rotate(10,44.553365,53.331682)"' in written
    back = read(written, None).document
    assert formed(back.curves[0]).form.corners == 8
    assert is_near(back.curves[0], changed.curves[0], 1e-6)
    new = formed_anew(replace(document.curves[0], name="New"), Star(60.0, 60.0, 9.0))
    written = rewritten(data, replace(document, curves=(*document.curves, new)), document).data
    assert b's:type="star" inkscape:flatsided="false" s:sides="5" s:cx="60" s:cy="40" s:r1="9"' in written
    # With a corner of it elsewhere it is none any more.
    points = document.curves[0].points
    bent = replace(document.curves[0], points=(replace(points[0], x=points[0].x + 5.0), *points[1:]))
    written = rewritten(data, document.with_curve(0, bent), document).data
    assert b's:sides="5"' not in written
    assert b's:sides="6"' in written
    assert view_of(read(written, None).document.curves[0]).curve is not None


# Kinds of points

# Corner, smooth and symmetric, each where nobody would take it for that: handles on one line or equally long.
KINDS = "M 10 50 C 10 40 20 30 30 30 C 40 30 50 40 50 50 C 50 60 60 70 70 70 C 80 70 90 60 90 50"


def kinds(curve):
    return [(point.corner, point.tied, point.even) for point in curve.points]


def path(letters, data=KINDS):
    types = f' s:nodetypes="{letters}"' if letters else ""
    return f'{HEAD}<path id="p" d="{data}" fill="none" stroke="#000"{types}/></svg>\n'.encode()


FREE, TIED, ONE = (True, False, False), (True, True, False), (False, False, False)


@pytest.mark.parametrize(
    ("letters", "found"),
    [
        ("", [ONE, ONE, ONE]),
        ("ccccc", [FREE, FREE, FREE]),
        ("cszcc", [TIED, ONE, FREE]),
        # Not so many, or no letters of these.
        ("cccc", [ONE, ONE, ONE]),
        ("c" * 7, [ONE, ONE, ONE]),
        ("xéx?x", [ONE, ONE, ONE]),
    ],
)
def test_points_are_what_inkscape_notes_and_the_document_says(letters, found):
    data = path(letters)
    document = read(data, None).document
    assert kinds(document.curves[0])[1:-1] == found
    assert rewritten(data, document, document).data == data
    # Written anew, it says so where nobody would know, and it comes back so.
    again = svg_of(document).data
    assert (b"nodetypes" in again) == (found != [ONE, ONE, ONE])
    assert kinds(read(again, None).document.curves[0]) == kinds(document.curves[0])


def test_a_corner_is_no_smooth_point_whatever_is_noted():
    bent = KINDS.replace("C 40 30", "C 30 40")
    assert kinds(read(path("cssss", bent), None).document.curves[0])[1] == FREE


def test_even_handles_and_closed_paths_of_several_outlines_keep_their_kinds():
    closed = "M 50 20 C 66 20 80 34 80 50 C 80 66 66 80 50 80 C 34 80 20 66 20 50 C 20 34 34 20 50 20 Z"
    two = f"{closed} M 5 5 L 15 5 L 10 15 Z"
    document = read(path("csczccccc", two), None).document
    assert kinds(document.curves[0]) == [FREE, TIED, FREE, ONE]
    first = document.curves[0]
    even = replace(first.points[1], even=True)
    other = document.with_curve(0, replace(first, points=(first.points[0], even, *first.points[2:])))
    # The course is as it was: its letters alone are others.
    written = rewritten(path("csczccccc", two), other, document).data
    assert written == path("czczccccc", two)
    assert b'nodetypes="czczccccc"' in svg_of(other).data


def test_a_kind_that_was_changed_is_noted_in_a_file_that_notes_none():
    document = read(path(""), None).document
    curve = document.curves[0]
    free = tuple(point.as_corner() if at == 1 else point for at, point in enumerate(curve.points))
    written = rewritten(path(""), document.with_curve(0, replace(curve, points=free)), document).data
    assert written == path("").replace(b"/></svg>", b' s:nodetypes="cczzc"/></svg>')
    assert kinds(read(written, None).document.curves[0])[1:-1] == [FREE, ONE, ONE]


# Data of our own

TEXT = Text(
    "Ä \u2028 “x”\nI", "Some Font", 3.0, 4.0, 5.0, begins=True, line_spacing=1.5, align=TextAlign.RIGHT
)
LETTER = ("M 10 10 L 60 10 L 60 40 C 60 60 40 60 10 40 Z", "M 20 15 L 30 15 L 20 25 Z")


@pytest.fixture(scope="module")
def letter():
    """A letter of two outlines, which is no clone's original."""
    data = f'{HEAD}<path id="p" d="{" ".join(LETTER)}"/></svg>'.encode()
    document = read(data, None).document
    first, second = document.curves
    known = replace(first, text=TEXT), replace(second, text=replace(TEXT, begins=False))
    return replace(document, curves=known)


def texts(data):
    return [curve.text for curve in read(data, None).document.curves]


def test_a_letter_knows_what_it_was_written_as(letter):
    data = svg_of(letter).data
    assert texts(data) == [curve.text for curve in letter.curves]
    assert data.count(b"data-curvebench=") == 1
    # Other programs move, turn and stretch it, and write few digits; a clone is no letter of the text.
    turned = data.replace(b' d="', b' transform="matrix(2 .5 -1 -3 7 8)" d="')
    assert texts(turned) == texts(data)
    assert turned.count(b"L 60 10") == 1
    assert texts(turned.replace(b"L 60 10", b"L 59.995 10.005")) == texts(data)
    used = data.replace(b"</svg>", b'<use href="#p" x="9"/></svg>')
    assert texts(used) == [*texts(data), None, None]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("L 60 10", "L 66 10"),
        ("L 60 10", ""),
        ("M 20 15 L 30 15 L 20 25 L 20 15 Z", ""),
        ("Some Font", "Some\\u0007Font"),
        ("Some Font", "F" * 300),
        ("Ä", "Ä" * 301),
        ('"size":5.0', '"size":0.0'),
        ('"size":5.0', '"size":1e999'),
        ('"size":5.0', '"size":"5"'),
        ('"x":3.0', '"x":NaN'),
        ('"x":3.0', '"x":1e13'),
        ('"align":"right"', '"align":"up"'),
        ('"seal"', '"deal"'),
        ('{"text"', '{{"text"'),
        ('{"text"', '{"text":' + "[" * 2000 + ',"text"'),
        ("Ä", "\\ud800"),
        ("Ä", "x" * 20_000),
    ],
)
def test_what_does_not_fit_or_is_nothing_that_a_document_holds_is_no_text(letter, old, new):
    found = svg_of(letter).data.decode().replace("&quot;", "'").replace("\\u00c4", "Ä")
    found = " ".join(found.replace("'", "\x00").split()).replace("\x00", '"')
    start = found.index('data-curvebench="') + len('data-curvebench="')
    end = found.index('}" ', start) + 1
    changed = found.replace(old, new, 1)
    assert changed != found
    grown = len(changed) - len(found) if found.index(old) < end else 0
    words, rest = changed[start : end + grown], changed[end + grown :]
    assert words.endswith("}")
    quoted = words.replace('"', "&quot;")
    data = f"{changed[:start]}{quoted}{rest}".encode()
    assert not any(texts(data))


def test_in_a_file_of_others_a_letter_is_noted_and_one_that_is_none_any_more_is_not(letter):
    data = f'{HEAD}<path id="p" d="{" ".join(LETTER)}"/></svg>'.encode()
    begun = read(data, None).document
    written = rewritten(data, letter, begun).data
    assert texts(written) == [curve.text for curve in letter.curves]
    document = read(written, None).document
    assert rewritten(written, document, document).data == written
    # Bent by hand it is one still, and the file says so of the shape that it is now.
    points = document.curves[1].points
    bent = replace(document.curves[1], points=(replace(points[0], x=18.0), *points[1:]))
    again = rewritten(written, document.with_curve(1, bent), document).data
    assert texts(again) == texts(written)
    curves = tuple(replace(curve, text=None) for curve in document.curves)
    assert rewritten(written, replace(document, curves=curves), document).data == data
