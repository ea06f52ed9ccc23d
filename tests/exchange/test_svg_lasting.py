"""What things are lasts over an SVG file, in words of Inkscape or our own; others see the outlines."""

import re

import numpy as np
import pytest
from msgspec.structs import astuple, replace

from app.document.form_edits import formed_anew
from app.document.forms import Ellipse, Star
from app.document.model import Document, Page, make_curve
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
