"""Bounds of clipped curves: those of what is seen, and no work where nothing is clipped."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.clip import Clip
from app.document.model import Document, make_curve
from app.document.several_curves import whole_curves
from app.document.style import Style
from app.document.transforms import Edge
from app.exchange.drawing.trim import painted_box
from app.exchange.svg.reader import read_svg
from app.families import HERMITE
from app.view_model.boxes.alignment import align_curves
from app.view_model.boxes.bounds import bounds_of
from app.view_model.boxes.resizing import resized
from app.view_model.curve.curve_view import view_of
from tests.effort import calls_of

# y up: an ellipse of 40 × 30 in a square of 40, a bar cut on its left, and one all hidden.
DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100">
<clipPath id="e"><ellipse cx="30" cy="30" rx="20" ry="15"/></clipPath>
<clipPath id="h"><path d="M60 0H100V100H60Z"/></clipPath>
<path id="Square" d="M10 10H50V50H10Z" stroke="#000" stroke-width="2" clip-path="url(#e)"/>
<path id="Bar" d="M50 60H90V70H50Z" stroke="#000" stroke-width="2" fill="none" clip-path="url(#h)"/>
<path id="Gone" d="M0 80H20V90H0Z" clip-path="url(#h)"/></svg>"""


@pytest.fixture
def document():
    return replace(read_svg(DRAWING.encode(), None).document, page=None)


def views_of(document):
    return [view_of(curve) for curve in document.curves]


def box(document, *places, clipped=True, as_drawn=False):
    views, group = views_of(document), whole_curves(document, places)
    for view in views if as_drawn else ():
        view.drawn_box  # noqa: B018 - as while they are dragged
    return corners(bounds_of(views, group, as_drawn=as_drawn, clipped=clipped))


def corners(bounds):
    return pytest.approx(np.array([bounds.low, bounds.high]).ravel().tolist(), abs=1e-9)


def at(document, place):
    (curve,) = [each for each in document.curves if each.name == place]
    return document.curves.index(curve)


@pytest.mark.parametrize("as_drawn", [False, True])
def test_the_box_is_that_of_what_is_seen(document, as_drawn):
    seen = {"Square": (10, -45, 50, -15), "Bar": (60, -70, 90, -60), "Gone": (0, -90, 20, -80)}
    for name, expected in seen.items():
        assert box(document, at(document, name), as_drawn=as_drawn) == expected
    # What is hidden altogether is nothing beside what is seen.
    assert box(document, 0, 1, 2, as_drawn=as_drawn) == (10, -70, 90, -15)
    assert box(document, 0, clipped=False) == (10, -50, 50, -10)


@pytest.mark.parametrize("places", [(0,), (1,), (0, 1)])
def test_what_is_seen_gets_the_size_that_is_typed(document, places):
    views, group = views_of(document), whole_curves(document, places)
    before = bounds_of(views, group)
    new = document
    for axis, length in ((0, 120.0), (1, 12.0)):
        new = resized(new, views_of(new), group, axis, length, before.low)
    after = bounds_of(views_of(new), group)
    assert after.size == pytest.approx((120.0, 12.0), abs=1e-9)
    assert after.low == pytest.approx(before.low, abs=1e-9)
    clips = [each.curves[places[0]].style.clips for each in (document, new)]
    assert np.ptp(clips[1][0].rings[0].numbers[::2]) > np.ptp(clips[0][0].rings[0].numbers[::2])


def test_what_is_seen_is_aligned_and_is_what_a_picture_shows(document):
    new = align_curves(document, views_of(document), (0, 1), Edge.LEFT)
    left = [bounds_of(views_of(new), whole_curves(new, {place})).low[0] for place in (0, 1)]
    assert left == pytest.approx([10.0, 10.0], abs=1e-9)
    one = replace(document, curves=document.curves[:1])
    assert painted_box(one).ravel().tolist() == pytest.approx([10.0, -45.0, 50.0, -15.0], abs=1e-9)
    nothing = replace(one.curves[0], style=replace(one.curves[0].style, clips=(Clip(),)))
    assert painted_box(replace(one, curves=(nothing,)))[0].tolist() == pytest.approx([9.0, -51.0])


def test_where_nothing_is_clipped_nothing_more_is_done():
    curves = [make_curve([(k, 0), (k + 1, 3)], name=f"C{k}", family=HERMITE) for k in range(50)]
    styled = [replace(curve, style=Style(width=0.1 + at % 3)) for at, curve in enumerate(curves)]
    document = Document(tuple(styled))
    views, group = views_of(document), whole_curves(document, range(50))
    for as_drawn in (False, True):
        measured = [
            partial(bounds_of, views, group, as_drawn=as_drawn, clipped=clipped) for clipped in (True, False)
        ]
        assert measured[0]() == measured[1]()
        assert calls_of(measured[0]) == calls_of(measured[1])
