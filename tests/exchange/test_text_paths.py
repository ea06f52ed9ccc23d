"""Texts on paths in SVG files: read as they are drawn, kept as such in place and written anew."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.along_edits import along_of
from app.document.contents import corners_of
from app.document.several_curves import add_copies, mapped, moved, remove_curves, whole_curves
from app.document.transforms import Affine
from app.exchange.corner import from_lower_left
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.contents import letters_of, measured
from app.session.along_paths import along_paths
from app.storage.format import decode, encode

pytestmark = pytest.mark.usefixtures("qapp")

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'width="200mm" height="200mm" viewBox="0 0 200 200">'
)
CIRCLE = '<path id="c" d="M100 40A60 60 0 0 1 100 160A60 60 0 0 1 100 40Z" fill="none" stroke="#888"/>'
FONT = 'font-family="DejaVu Sans" font-size="12"'
FILE = (
    f'{HEAD}<!-- kept --><g transform="translate(3 4) scale(0.9)">{CIRCLE}'
    f'<text id="t" {FONT} text-anchor="middle"><textPath id="tp" xlink:href="#c" startOffset="25%">'
    'IOI <tspan fill="#f00">XX</tspan></textPath></text></g></svg>'
)
CURVE, TEXT = range(2)


def read(text):
    return measured(from_lower_left(read_svg(text.encode()).document))


def places(document, place=TEXT):
    """The middles of the letters of a text."""
    curve = document.curves[place]
    found = letters_of(curve.form, corners_of(curve), curve.style)
    boxes = [np.concatenate([each.reshape(-1, 2) for each in glyph.contours]) for glyph, _ in found]
    return np.array([(each.min(axis=0) + each.max(axis=0)) / 2 for each in boxes])


def changed(document, edit):
    """The document after a step of the history."""
    return along_paths(edit(document), document)


def shifted(document, curves=(CURVE,), by=(7.0, -3.0)):
    return changed(document, lambda now: moved(now, whole_curves(now, curves), by))


def test_letters_stand_upright_on_a_circle_about_where_they_are_anchored():
    document = read(FILE)
    letters = places(document)
    middle = np.array([3 + 0.9 * 100, 200 - (4 + 0.9 * 100)])
    off = letters - middle
    # Half the height of a capital above the circle, a quarter turn from its top.
    assert np.hypot(*off.T) == pytest.approx(0.9 * (60 + 0.729 * 12 / 2), abs=0.2)
    angles = np.degrees(np.arctan2(-off[:, 1], off[:, 0]))
    assert (np.diff(angles) > 0).all()
    assert (angles[0] + angles[-1]) / 2 == pytest.approx(0, abs=3)


@pytest.mark.parametrize(
    ("said", "start", "is_share", "is_flipped"),
    [
        ('startOffset="10"', 10.0, False, False),
        ('startOffset="50%" side="right"', 0.5, True, True),
        ('startOffset="2em"', 24.0, False, False),
        ('startOffset="what"', 0.0, False, False),
    ],
)
def test_it_says_where_it_starts_and_on_which_side(said, start, is_share, is_flipped):
    text = f'{HEAD}{CIRCLE}<text {FONT}><textPath href="#c" {said}>abc</textPath></text></svg>'
    along = along_of(read(text).curves[TEXT])
    assert (along.start, along.is_share, along.is_flipped) == (start, is_share, is_flipped)
    again = along_of(read(svg_of(read(text)).text).curves[TEXT])
    assert (again.start, again.is_share, again.is_flipped) == (start, is_share, is_flipped)


def test_it_follows_its_path_and_both_together_and_copies_follow_the_copy():
    document = read(FILE)
    before = places(document)
    assert places(shifted(document)) == pytest.approx(np.add(before, (7, -3)), abs=1e-6)
    assert places(shifted(document, (CURVE, TEXT))) == pytest.approx(np.add(before, (7, -3)), abs=1e-6)
    # Moved by itself it stays so far from the path, and follows that.
    apart = shifted(document, (TEXT,))
    assert places(apart) == pytest.approx(np.add(before, (7, -3)), abs=1e-6)
    assert places(shifted(apart)) == pytest.approx(np.add(before, (14, -6)), abs=1e-6)
    # Turned and enlarged with it, it is so as a whole; and follows.
    by = Affine(-1.0, -2.0, 2.0, -1.0, (0.0, 0.0))
    turned = changed(document, lambda now: mapped(now, whole_curves(now, (CURVE, TEXT)), by))
    assert places(turned) == pytest.approx(before @ np.array([[0, 2], [-2, 0]]), abs=1e-6)
    assert places(shifted(turned)) == pytest.approx(np.add(places(turned), (7, -3)), abs=1e-6)
    both = changed(document, lambda now: add_copies(now, (CURVE, TEXT)).document)
    copy, text = (
        next(at for at, each in enumerate(both.curves) if each.name == name)
        for name in (f"{document.curves[place].name} copy" for place in (CURVE, TEXT))
    )
    assert along_of(both.curves[text]).of == both.curves[copy].identity != both.curves[CURVE].identity
    assert places(shifted(both, (copy,)), text) == pytest.approx(np.add(before, (7, -3)), abs=1e-6)


def test_without_its_path_it_is_straight_and_alone_elsewhere_as_it_was():
    document = read(FILE)
    gone = changed(document, lambda now: remove_curves(now, {CURVE}))
    assert along_of(gone.curves[0]) is None
    assert np.ptp(places(gone, 0)[:, 1]) < 0.1
    alone = replace(document, curves=document.curves[TEXT:])
    there = along_paths(alone, replace(alone, curves=()))
    assert along_of(there.curves[0]).of == ""
    assert places(there, 0) == pytest.approx(places(document))


def test_a_path_that_is_drawn_nowhere_is_a_course_of_its_own():
    text = f'{HEAD}<defs>{CIRCLE}</defs><text {FONT}><textPath href="#c">abc</textPath></text></svg>'
    document = read(text)
    assert along_of(document.curves[0]).of == ""
    assert places(read(svg_of(document).text), 0) == pytest.approx(places(document, 0), abs=1e-6)


def _along(curve, **fields):
    return replace(curve, form=replace(curve.form, along=replace(curve.form.along, **fields)))


def _worded(curve):
    (line,) = curve.form.lines
    first, *others = line.runs
    line = replace(line, runs=(replace(first, words="OO "), *others))
    return replace(curve, form=replace(curve.form, lines=(line,)))


def test_it_is_stored():
    document = read(FILE)
    assert decode(encode(document)) == document


def test_it_is_written_in_the_units_of_its_path_wherever_it_was_read():
    document = read(FILE)
    again = read(svg_of(document).text)
    assert places(again) == pytest.approx(places(document), abs=1e-5)
    assert math.isclose(again.curves[TEXT].form.lines[0].runs[0].size, 0.9 * 12)
