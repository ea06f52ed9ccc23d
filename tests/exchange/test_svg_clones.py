"""Clones of SVG files are clones here, and go back as such."""

import re
from pathlib import Path

import pytest
from msgspec.structs import replace

from app.document.clones import add_clones, original_of, settled, unlinked
from app.document.edits import move_points
from app.document.several_curves import (
    add_copies,
    mapped,
    scaled_strokes,
    stepped,
    whole_curves,
)
from app.document.transforms import rotation, scaling
from app.exchange.corner import from_lower_left
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.view_model.curve.curve_view import view_of
from curvecore import cubic_path

CLONES = (Path(__file__).parents[1] / "data" / "overwrite" / "clones.svg").read_bytes()
LEAF, MOVED, TURNED, NESTED, BOX, DISC, BOX_2, DISC_2, FIRST, SECOND = range(10)


@pytest.fixture(scope="module")
def document():
    """The file as it is opened, whose page stands on the origin."""
    return from_lower_left(read_svg(CLONES).document)


def changed(document, edit):
    return settled(edit(document), document, document)


def test_what_a_use_shows_comes_in_as_clones(document):
    originals = [original_of(document, place) for place in range(len(document.curves))]
    # What is a symbol has no original that would move all its places.
    assert originals == [-1, LEAF, LEAF, TURNED, -1, -1, BOX, DISC, -1, -1]
    # Nothing of it is another one for that.
    assert settled(document, document, replace(document, curves=())) == document
    plain = read_svg(CLONES.replace(b"<use", b"<none")).document
    assert [curve.name for curve in plain.curves] == ["leaf", "box", "disc"]


@pytest.mark.parametrize(
    ("edited", "follow"),
    [(LEAF, {MOVED, TURNED, NESTED}), (TURNED, {NESTED}), (DISC, {DISC_2}), (FIRST, set())],
)
def test_they_follow_what_they_are_clones_of(document, edited, follow):
    after = changed(document, lambda d: move_points(d, edited, [0], (1.0, 2.0)))
    others = {place for place, curve in enumerate(after.curves) if curve != document.curves[place]}
    assert others == {edited, *follow}
    if edited == LEAF:
        was, now = (each.curves[TURNED].points[0] for each in (document, after))
        # Turned by a quarter and enlarged, y up.
        assert (now.x - was.x, now.y - was.y) == pytest.approx((3.0, -1.5))


def test_one_that_is_enlarged_goes_on_to_look_like_its_original(document):
    style = replace(document.curves[LEAF].style, width=2.0, fill="#112233")
    after = changed(document, lambda d: d.with_curve(LEAF, replace(d.curves[LEAF], style=style)))
    assert [after.curves[place].style.fill for place in (MOVED, TURNED, NESTED)] == ["#112233"] * 3
    assert [after.curves[place].style.width for place in (MOVED, TURNED)] == pytest.approx([2.0, 3.0])


@pytest.mark.parametrize("place", [MOVED, NESTED, BOX_2, DISC_2])
def test_stretched_it_stays_one(document, place):
    after = changed(document, lambda d: mapped(d, whole_curves(d, [place]), scaling(2.0, 0.5, (1.0, 1.0))))
    assert after.curves[place].clone is not None


# Written anew


def uses(text):
    """What each `use` is called, shows and is moved by."""
    pattern = r'<use id="(\w+)"(?: inkscape:label="\w+")? xlink:href="#(\w+)" transform="([^"]+)"'
    return [match.groups() for match in re.finditer(pattern, text)]


def sites(curve):
    return cubic_path(view_of(curve).curve, 1.0).control_points.ravel().tolist()


def written(document):
    return svg_of(document, Options(unit="mm"))


def styled(d, place, **fields):
    return d.with_curve(place, replace(d.curves[place], style=replace(d.curves[place].style, **fields)))


def test_the_original_may_lie_in_front_and_be_hidden_with_its_layer(document):
    behind = replace(document, curves=(*document.curves[1:], document.curves[0]))
    text = written(behind).text
    assert text.index('xlink:href="#leaf"') < text.index('id="leaf"')
    hidden = replace(document.curves[LEAF], groups=("Two",), visible=False)
    away = replace(behind, curves=(*document.curves[1:], hidden), layers=("One", "Two"))
    again = read_svg(written(away).text.encode()).document
    assert len(uses(written(away).text)) == 5
    assert [curve.name for curve in again.curves if not curve.visible] == ["leaf"]


# In its place


def cloned(d, places):
    """Clones of curves, moved, as by Alt+D and a drag."""
    added = add_clones(d, places, "new".__str__)
    return stepped(added.document, whole_curves(added.document, added.places), (7.0, -9.0))


def larger(d, place):
    group = whole_curves(d, [place])
    return scaled_strokes(mapped(d, group, scaling(2.0, 2.0, (0.0, 150.0))), group, 2.0, 2.0)


def use(name, of, at):
    return f'+<use id="{name}" inkscape:label="{name.replace("_", " ")}" xlink:href="#{of}" {at}/>'


WHOLE = 'width="100%" height="100%"'
EDITS = {
    "nothing": (lambda d: d, []),
    "an original is bent": (
        lambda d: move_points(d, LEAF, [0], (1.0, 1.0)),
        ['-<path id="leaf"', '+<path id="leaf"'],
    ),
    "an original has another colour": (
        lambda d: styled(d, LEAF, fill="#112233"),
        ['-style="fill:#ff8800;', '+style="fill:#112233;'],
    ),
    "a clone is moved": (
        lambda d: stepped(d, whole_curves(d, [MOVED]), (3.0, 4.0)),
        [
            '-<use xlink:href="#leaf" id="moved" x="0" y="0"',
            '+<use xlink:href="#leaf" id="moved" x="3" y="-4"',
        ],
    ),
    "a clone is turned": (
        lambda d: mapped(d, whole_curves(d, [MOVED]), rotation(90.0, (0.0, 150.0))),
        [
            '-<use xlink:href="#leaf" id="moved"',
            f'+<use xlink:href="#leaf" id="moved" x="0" y="0" {WHOLE} transform="matrix(0,-1,1,0,',
        ],
    ),
    "a clone is enlarged": (
        lambda d: larger(d, MOVED),
        [
            '-<use xlink:href="#leaf" id="moved"',
            f'+<use xlink:href="#leaf" id="moved" x="0" y="0" {WHOLE} transform="matrix(2,0,0,2,',
        ],
    ),
    "an original is cloned": (lambda d: cloned(d, [LEAF]), [use("leaf_copy", "leaf", 'x="7" y="9"')]),
    "a clone is cloned": (lambda d: cloned(d, [TURNED]), [use("turned_copy", "turned", 'x="7" y="9"')]),
    "a group is cloned": (
        lambda d: cloned(d, [BOX, DISC]),
        [
            '+<g id="pair_copy" inkscape:label="pair copy">',
            use("box_copy", "box", 'x="7" y="9"'),
            use("disc_copy", "disc", 'x="7" y="9"'),
            "+</g>",
        ],
    ),
    "an original and its clone are copied": (
        lambda d: add_copies(d, [LEAF, MOVED]).document,
        ['+<path id="leaf_copy"', use("moved_copy", "leaf_copy", 'x="50" y="10"')],
    ),
    "a clone is unlinked": (
        lambda d: unlinked(d, [NESTED]),
        ['-<use xlink:href="#turned"', '+<path id="nested"'],
    ),
    "a clone is bent": (
        lambda d: move_points(d, NESTED, [0], (1.0, 1.0)),
        ['-<use xlink:href="#turned"', '+<path id="nested"'],
    ),
    "one of a clone of a group is moved": (
        lambda d: stepped(d, whole_curves(d, [DISC_2]), (3.0, 4.0)),
        [
            '-<use href="#pair"',
            '+<g id="both_2"',
            '+<use id="box_2" inkscape:label="box" xlink:href="#box" y="30"/>',
            '+<use id="disc_2" inkscape:label="disc" xlink:href="#disc" x="3" y="26"/>',
            "+</g>",
        ],
    ),
    "a place of a symbol is moved": (
        lambda d: stepped(d, whole_curves(d, [FIRST]), (3.0, 4.0)),
        ['-<use xlink:href="#hidden" id="first"', '+<use xlink:href="#hidden" id="first" x="103" y="96"'],
    ),
}
