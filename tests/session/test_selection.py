"""What is selected, hovered and scrubbed names what exists, whatever is asked for."""

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from app.document.model import Document, Point, make_curve
from app.document.point_group import group_points, points_of
from app.document.selection import all_points
from app.session import Session
from tests.rows import each_row

A, B, C = (make_curve([(place, 0.0), (place, 1.0)], name=name) for place, name in enumerate("ABC"))
indices = st.sets(st.integers(-3, 8))


def session_with(*curves, active=0):
    session = Session()
    session.change("Begin", lambda _document: Document(curves), active=active)
    return session


def with_points(count):
    return session_with(make_curve([(float(x), 0.0) for x in range(count)]))


@given(indices, st.integers(0, 5))
def test_points_that_do_not_exist_are_not_selected(asked, count):
    session, told = with_points(count), []
    session.selection_changed.connect(told.append)
    session.selected.set_points(asked)
    assert session.selection == asked & set(range(count))
    session.selected.set_points(asked)
    assert told == ([session.selection] if session.selection else [])


@given(indices, st.integers(0, 4), st.integers(1, 5))
def test_the_active_curve_is_among_the_selected_curves(asked, active, count):
    active = min(active, count - 1)
    session = session_with(*(make_curve([(0.0, 0.0), (1.0, 1.0)], name=str(n)) for n in range(count)))
    session.selected.set_curves(asked, active)
    wanted = session.active_index
    existing = asked & set(range(count))
    assert session.selected.curves == existing | {wanted}
    # The one asked for, or the nearest of those selected.
    nearest = min((abs(index - active) for index in existing), default=0)
    assert abs(wanted - active) == (0 if active in existing else nearest)


@each_row(
    ("asked", "has_curve", "expected", "later"),
    [
        (0.25, True, 0.25, -2.5),
        (-1.0, True, 0.0, -5.0),
        (2.0, True, 1.0, 5.0),
        (0.5, False, None, 0.5),
        (None, True, None, None),
    ],
)
def test_the_scrub_line_stays_on_the_curve(asked, has_curve, expected, later):
    session, told = with_points(2 if has_curve else 1), []
    session.scrub_changed.connect(told.append)
    session.scrub.set(asked)
    assert session.scrub.t == expected
    assert told == ([] if expected is None else [expected])
    # Over another interval it keeps its relative place; without a curve it stands where it was asked for.
    curve = make_curve([(0.0, 0.0), (1.0, 0.0)])
    longer = replace(curve, parametrization=replace(curve.parametrization, start=-5.0, end=5.0))
    session.change("Make it longer", lambda _document: Document((longer,)))
    assert session.scrub.t == later


@given(st.integers(-3, 8), st.integers(0, 5))
def test_no_point_is_hovered_that_does_not_exist(index, count):
    session, told = with_points(count), []
    session.hovered_changed.connect(told.append)
    session.selected.set_hovered(index)
    assert session.selected.hovered == (index if 0 <= index < count else -1)
    assert told == ([index] if 0 <= index < count else [])


def test_the_selection_follows_curves_to_their_new_indices():
    session, told = session_with(A, B, C), []
    session.selected.set_curves({0, 2}, 2)
    session.selected_curves_changed.connect(told.append)
    session.change("Move C to the front", lambda _document: Document((C, A, B)), active=0)
    assert session.selected.curves == {0, 1}
    # Of several that are gone the active one stays, alone.
    session.change("Keep B", lambda _document: Document((B,)))
    assert session.selected.curves == {0}
    assert told == [{0, 1}, {0}]


def test_the_selection_follows_points_to_their_new_indices():
    def selected_after(points):
        session = session_with(A)
        session.selected.set_points([1])
        session.change("Other points", lambda _document: Document((make_curve(points),)))
        return session.selection

    assert selected_after([(0.0, 1.0), (7.0, 7.0), (8.0, 8.0)]) == {0}
    assert selected_after([(9.0, 9.0), (5.0, 5.0)]) == {1}


def test_points_are_selected_only_in_edited_curves_and_the_active_curve_has_some():
    shape = [replace(curve, shape="S") for curve in (A, B)]
    session, told = session_with(*shape, C), []
    session.selection_changed.connect(told.append)
    selected = session.selected
    everywhere = group_points((curve, frozenset({-1, 0, 1, 7})) for curve in range(4))
    selected.set_group(everywhere)
    assert dict(selected.group.parts) == {0: {0, 1}, 1: {0, 1}}
    selected.set_group(points_of(1, [1]))
    assert (session.active_index, session.selection, selected.curves) == (1, {1}, {1})
    selected.select_whole({0, 1})
    assert told[-1] == frozenset()
    selected.set_group(everywhere)
    assert (selected.is_editing, dict(selected.group.parts)) == (True, {0: {0, 1}, 1: {0, 1}})
    # Of the active one nothing is left: then nothing is selected.
    session.change("Fewer", lambda _document: Document((shape[0], replace(shape[1], points=()), C)))
    assert (session.active_index, selected.group.parts) == (1, ())


def test_selected_points_follow_their_curves():
    session = session_with(C, replace(A, shape="S"), replace(B, shape="S"), active=1)
    session.selected.set_group(all_points(session.document, session.selected.active_curves))
    c, a, b = session.document.curves
    longer = replace(b, points=(*b.points, Point(5.0, 5.0)))
    session.change("A point more", lambda _document: Document((c, a, longer)))
    assert dict(session.selected.group.parts) == {1: {0, 1}, 2: {0, 1}}
    session.selected.set_group(points_of(2, [0]).joined(points_of(1, [1])))
    session.change("The other way round", lambda _document: Document((c, longer, a)))
    assert dict(session.selected.group.parts) == {1: {0}, 2: {1}}
    # What is another value is looked for in its place, where the other one is now.
    session.change("Again, and changed", lambda _document: Document((c, a, b)))
    assert dict(session.selected.group.parts) == {1: {1}}


def test_points_of_a_new_curve_are_not_selected():
    session = session_with(B, A, active=1)
    session.selected.set_points([1])
    session.change("Another curve", lambda _document: Document((B, A, C)), active=2)
    assert session.selection == frozenset()
