"""Edits of several curves at once, and a choice that follows its curves."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from app.document.group_edits import move_into, order_after_step
from app.document.limits import EditError
from app.document.model import Document, Point, make_curve
from app.document.point_edits import append_point
from app.document.point_group import points_of
from app.document.rule_edits import set_family
from app.document.selection import followed_curves
from app.document.several_curves import (
    active_after_removal,
    add_curves,
    duplicate_curves,
    move_group,
    name_or_count,
    remove_curves,
    reorder_curves,
    set_appearance,
    set_style,
    transform_group,
    whole_curves,
)
from app.document.transforms import rotation
from app.families import HERMITE
from tests.rows import each_row


def names(document):
    return "".join(curve.name for curve in document.curves)


@pytest.fixture
def four():
    curves = [make_curve([(0, level), (1, level)], name=name) for level, name in enumerate("ABCD")]
    turning = Point(
        2.0, 0.0, velocity=(1.0, 0.0), acceleration=(0.0, 3.0), corner=True, velocity_after=(0.0, 2.0)
    )
    curves[1] = replace(curves[1], points=(*curves[1].points, turning))
    return Document(tuple(curves))


def locked(document, *places):
    return set_appearance(document, places, locked=True)


def test_whole_curves_are_rotated_with_explicit_derivatives(four):
    turned = transform_group(four, whole_curves(four, {1, 3}), rotation(90.0, (0.0, 0.0)))
    assert turned.curves[1].points[2] == Point(
        0.0, 2.0, velocity=(0.0, 1.0), acceleration=(-3.0, 0.0), corner=True, velocity_after=(-2.0, 0.0)
    )
    assert [point.position for point in turned.curves[3].points] == [(-3.0, 0.0), (-3.0, 1.0)]
    assert turned.curves[0] is four.curves[0]
    assert turned.curves[2] is four.curves[2]


def test_some_points_of_one_curve_can_be_transformed(four):
    after = move_group(four, points_of(2, [1]), (0.5, 0.25))
    assert [point.position for point in after.curves[2].points] == [(0.0, 2.0), (1.5, 2.25)]


def test_a_transform_beyond_the_limits_changes_nothing(four):
    far = replace(four.curves[3], points=(Point(9e11, 0.0), Point(0.0, 0.0)))
    with pytest.raises(EditError, match="1e12"):
        move_group(four.with_curve(3, far), whole_curves(four, {0, 3}), (2e11, 0.0))


@each_row(
    ("places", "sentence"),
    [
        ((1,), "“B” is locked. Unlock it in the list of curves to change it."),
        ((1, 3), "“B” and “D” are locked. Unlock them in the list of curves to change them."),
        ((0, 1, 3), "“A”, “B” and “D” are locked. Unlock them in the list of curves to change them."),
    ],
)
@each_row(
    "act",
    [
        lambda document: move_group(document, whole_curves(document, {0, 1, 3}), (1.0, 0.0)),
        lambda document: remove_curves(document, {0, 1, 3}),
    ],
)
def test_a_refusal_names_the_locked_curves(four, places, sentence, act):
    with pytest.raises(EditError) as refused:
        act(locked(four, *places))
    assert str(refused.value) == sentence


def test_unselected_locked_curves_do_not_block_edits(four):
    document = locked(four, 2)
    assert names(remove_curves(document, {0, 3})) == "BC"
    assert move_group(document, whole_curves(document, {0, 1}), (1.0, 0.0)).curves[0].points[0].x == 1.0


def test_only_given_parts_of_the_appearance_change(four):
    after = set_appearance(four, {0, 2}, visible=False, colour="#d55e00")
    assert [(curve.visible, curve.style.stroke, curve.locked) for curve in after.curves] == [
        (False, "#d55e00", False),
        (True, "", False),
        (False, "#d55e00", False),
        (True, "", False),
    ]
    assert after.curves[1] is four.curves[1]


def test_copies_follow_the_last_original_in_order(four):
    document = set_appearance(four, {0}, visible=False, locked=True)
    document = set_style(document, {2}, stroke="#0072b2", width=3.0, fill="#f0e442")
    after = duplicate_curves(document, {0, 2}).document
    assert [curve.name for curve in after.curves] == ["A", "B", "C", "A copy", "C copy", "D"]
    copy = after.curves[3]
    assert (copy.visible, copy.locked, copy.style) == (True, False, document.curves[0].style)
    # As they look: a copy used to be in the next colour.
    assert after.curves[4].style == document.curves[2].style


def test_copies_of_copies_are_numbered(four):
    document = four
    for curve in (0, 1, 2):
        document = duplicate_curves(document, {curve}).document
    assert [curve.name for curve in document.curves[:5]] == ["A", "A copy", "A copy 2", "A copy 3", "B"]
    pasted = add_curves(document, [document.curves[4], make_curve([], name="New")], 1)
    assert [curve.name for curve in pasted.curves[:3]] == ["A", "B copy", "New"]


def test_the_curve_at_the_removed_index_becomes_active(four):
    assert [active_after_removal(four, {1, 2}, active) for active in (1, 2)] == [1, 1]
    assert active_after_removal(four, {2, 3}, 3) == 1
    assert active_after_removal(four, {0, 1, 2, 3}, 2) == 0


def test_one_curve_is_named_and_several_are_counted(four):
    assert (name_or_count(four, {2}), name_or_count(four, {0, 2})) == ("C", "2 curves")


@given(st.permutations(range(6)), st.sets(st.integers(0, 5)), st.sets(st.integers(0, 5)))
def test_a_selection_follows_its_curves(order, chosen, gone):
    before = [make_curve([(0, number)], name="same") for number in range(6)]
    after = [before[number] for number in order if number not in gone]
    kept = followed_curves(chosen, before, after)
    assert {id(after[place]) for place in kept} == {id(before[place]) for place in chosen - gone}


def test_a_selection_stays_on_changed_curves(four):
    document = set_family(append_point(four, 1, Point(9.0, 9.0)), 3, HERMITE)
    assert followed_curves({1, 3}, four.curves, document.curves) == {1, 3}
    lowered = move_into(four, {1}, 3).document
    assert followed_curves({1, 3}, four.curves, lowered.curves) == {2, 3}
    assert followed_curves({1, 3}, four.curves, four.curves) == {1, 3}


@each_row(
    ("chosen", "step", "order"),
    [({1}, 1, "ACBD"), ({0, 1}, 1, "CABD"), ({2, 3}, 1, "ABCD"), ({1, 3}, 1, "ACBD"), ({0, 2}, -1, "ACBD")],
)
def test_selected_curves_step_together(four, chosen, step, order):
    assert names(reorder_curves(four, order_after_step(four, chosen, step))) == order


@each_row(
    ("chosen", "at", "order"),
    [({0, 1}, 4, "CDAB"), ({0, 3}, 1, "ADBC"), ({1, 3}, 0, "BDAC"), ({0, 2}, 3, "BACD")],
)
def test_selected_curves_are_dropped_together(four, chosen, at, order):
    assert names(move_into(four, chosen, at).document) == order
