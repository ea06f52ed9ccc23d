"""Clones follow their originals."""

import math
from functools import partial

import numpy as np
import pytest
from msgspec.structs import replace

from app.document import clones
from app.document.clone_maps import map_of
from app.document.clones import add_clones, followed, original_of, settled, unlinked
from app.document.curve_edits import remove_curve, reverse_curve
from app.document.edits import delete_points, insert_points, move_points, set_family
from app.document.model import Document, Point, make_curve
from app.document.several_curves import add_copies, add_imported, mapped, stepped, whole_curves
from app.document.transforms import rotation, scaling
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.view_model.curve.curve_view import view_of
from curvecore import cubic_path
from tests.effort import noted_calls

LEAF = replace(
    make_curve([(0, 0), (3, 1), (4, 4)], name="Leaf", family=HERMITE),
    points=(Point(0, 0, velocity=(3.0, 1.0)), Point(3, 1), Point(4, 4, corner=True, velocity=(1.0, 2.0))),
)


def changed(document, edit):
    return settled(edit(document), document, document)


@pytest.fixture
def pair():
    """A curve, another one, and a clone of the first, turned and elsewhere."""
    document = Document((LEAF, make_curve([(9, 9), (8, 7)], name="Other")))
    added = add_clones(document, [0], lambda: "leaf").document
    clone = whole_curves(added, [1])
    turned = changed(added, lambda each: mapped(each, clone, rotation(30, (2.0, 1.0))))
    return changed(turned, lambda each: stepped(each, whole_curves(each, [1]), (5.0, -1.0)))


def test_a_clone_is_a_copy_that_knows_where_it_is_from(pair):
    assert [curve.name for curve in pair.curves] == ["Leaf", "Leaf copy", "Other"]
    by = map_of(pair.curves[1].clone)
    for one, other in zip(pair.curves[0].points, pair.curves[1].points, strict=True):
        assert math.dist(by.point(one.position), other.position) < 1e-12


@pytest.mark.parametrize(
    "edit",
    [
        lambda d: move_points(d, 0, [1], (1.0, 2.0)),
        lambda d: insert_points(d, 0, 1, [Point(1.0, 1.0)]),
        lambda d: delete_points(d, 0, [1]),
        lambda d: set_family(d, 0, LAGRANGE),
        lambda d: reverse_curve(d, 0, [0.0, 0.5, 1.0]),
        lambda d: mapped(d, whole_curves(d, [0]), scaling(2.0, 0.5, (1.0, 1.0))),
    ],
)
def test_it_follows_what_becomes_of_its_original(pair, edit):
    after = changed(pair, edit)
    original, clone, _ = after.curves
    assert clone.clone == pair.curves[1].clone
    assert clone.points != pair.curves[1].points or clone.family is not pair.curves[1].family
    # Not its points alone: all of the curve is the image of the original.
    by = map_of(clone.clone)
    for t in (0.0, 0.2, 0.5, 0.9):
        place = view_of(original).curve.evaluate([t])[0]
        assert view_of(clone).curve.evaluate([t])[0] == pytest.approx(by.point(tuple(place)))


def test_it_follows_a_drag_from_where_that_began(pair):
    shown = pair
    for x in (0.5, 1.0, 1.5):
        dragged = move_points(pair, 0, [2], (x, 0.0))
        shown = followed(dragged, pair, shown)
        assert shown.curves[1].points == settled(dragged, pair, pair).curves[1].points
        # What stays is the same object: a drag costs what changes.
        assert shown.curves[1].points[1] is pair.curves[1].points[1]
    assert settled(shown, pair, shown) == shown


@pytest.mark.parametrize(
    ("family", "is_one"), [(HERMITE, True), (LAGRANGE, False), (FAMILIES.named("b_spline"), False)]
)
def test_stretched_it_is_one_where_the_stretched_curve_goes_through_its_points(pair, family, is_one):
    """Where parameters hang on distances, another curve goes through stretched points; handles hold it."""
    sides = {"corner": True, "velocity": (1.0, 2.0), "velocity_after": (2.0, -1.0)}
    explicit = tuple(replace(point, **sides) for point in LEAF.points)
    document = add_clones(
        Document((replace(LEAF, family=family, points=explicit),)), [0], lambda: "x"
    ).document
    after = changed(document, lambda d: mapped(d, whole_curves(d, [1]), scaling(2.0, 0.5, (1.0, 1.0))))
    clone = after.curves[1].clone
    assert (clone is not None) == is_one
    if clone is not None:
        after = changed(after, lambda d: move_points(d, 0, [1], (1.0, 1.0)))
        before, now = (cubic_path(view_of(curve).curve, 1.0).control_points for curve in after.curves)
        image = [[map_of(clone).point(tuple(place)) for place in piece] for piece in before]
        np.testing.assert_allclose(now, image, atol=1e-9)


def test_moved_with_its_original_it_stays_a_clone(pair):
    both = changed(pair, lambda d: stepped(d, whole_curves(d, [0, 1]), (1.0, 2.0)))
    assert both.curves[1].clone is not None
    assert (
        changed(both, lambda d: move_points(d, 0, [1], (1.0, 0.0))).curves[1].points != both.curves[1].points
    )


@pytest.mark.parametrize(
    "edit",
    [
        lambda d: move_points(d, 1, [1], (1.0, 2.0)),
        lambda d: set_family(d, 1, LAGRANGE),
        lambda d: delete_points(d, 1, [1]),
        lambda d: remove_curve(d, 0),
        lambda d: unlinked(d, [1]),
    ],
)
def test_a_curve_of_its_own_it_is_when_it_runs_otherwise_or_its_original_goes(pair, edit):
    after = changed(pair, edit)
    (copy,) = [curve for curve in after.curves if curve.name == "Leaf copy"]
    assert copy.clone is None
    assert clones.words_about_unlinked(pair, after) == "“Leaf copy” is no clone any more."


def test_copies_of_clones_follow_the_copy_of_their_original_where_there_is_one(pair):
    after = changed(pair, lambda d: add_copies(d, [0, 1]).document)
    assert [curve.name for curve in after.curves] == [
        "Leaf",
        "Leaf copy",
        "Leaf copy 2",
        "Leaf copy 3",
        "Other",
    ]
    assert [bool(curve.identity) for curve in after.curves] == [True, False, True, False, False]
    for edited, follows in ((0, [1, 1, 0, 0, 0]), (2, [0, 0, 1, 1, 0])):
        moved = changed(after, lambda d, place=edited: move_points(d, place, [1], (1.0, 0.0)))
        assert [new != old for new, old in zip(moved.curves, after.curves, strict=True)] == follows
    alone = changed(pair, lambda d: add_copies(d, [1]).document)
    moved = changed(alone, lambda d: move_points(d, 0, [1], (1.0, 0.0)))
    assert [new != old for new, old in zip(moved.curves, alone.curves, strict=True)] == [1, 1, 1, 0]
    # Once more, and from a file: there is such an identity there.
    more = changed(after, lambda d: add_imported(d, pair)[0])
    identities = [curve.identity for curve in more.curves if curve.identity]
    assert len(set(identities)) == len(identities) == 3
    assert [original_of(more, place) for place in (1, 3, 6)] == [0, 2, 5]


def test_a_clone_of_a_clone_follows_both(pair):
    chain = add_clones(pair, [1], lambda: "second").document
    chain = changed(chain, lambda d: stepped(d, whole_curves(d, [2]), (10.0, 0.0)))
    moved = changed(chain, lambda d: move_points(d, 0, [1], (1.0, 0.0)))
    assert moved.curves[2].points[1].x - moved.curves[1].points[1].x == pytest.approx(10.0)
    assert moved.curves[1].points[1] != chain.curves[1].points[1]


def test_its_style_follows_while_it_is_that_of_its_original(pair):
    def coloured(place, colour, d):
        curve = d.curves[place]
        return d.with_curve(place, replace(curve, style=curve.style.in_colour(colour)))

    red = changed(pair, partial(coloured, 0, "#ff0000"))
    assert red.curves[1].style == red.curves[0].style
    green = changed(changed(red, partial(coloured, 1, "#00ff00")), partial(coloured, 0, "#0000ff"))
    assert green.curves[1].style.stroke == "#00ff00"


def test_without_clones_nothing_is_looked_for(pair, monkeypatch):
    """At every move of a drag, in documents of thousands of curves."""
    plain = unlinked(pair, [1])
    built, looked = (
        noted_calls(monkeypatch, clones, "_Following"),
        noted_calls(monkeypatch, clones, "_has_clones"),
    )
    shown = plain
    for x in (1.0, 2.0, 3.0):
        shown = followed(moved := move_points(plain, 0, [1], (x, 0.0)), plain, shown)
        assert shown is moved
    assert (len(built), len(looked)) == (0, 1)
