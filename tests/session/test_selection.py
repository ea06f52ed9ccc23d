"""What is selected, chosen, hovered and scrubbed names what exists, whatever is asked for."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.document.model import make_curve
from app.session.selection import Selection

CURVES = tuple(make_curve([(place, 0.0), (place, 1.0)], name=name) for place, name in enumerate("ABC"))
indices = st.sets(st.integers(-3, 8))


@given(indices, st.integers(0, 5))
def test_points_that_do_not_exist_are_not_selected(asked, count):
    selection = Selection()
    assert selection.select(asked, count) == bool(selection.points)
    assert selection.points == asked & set(range(count))
    assert not selection.select(asked, count)


@given(indices, st.integers(0, 4), st.integers(1, 5))
def test_the_active_curve_is_one_of_those_chosen(asked, active, count):
    active = min(active, count - 1)
    selection = Selection()
    wanted = selection.select_curves(asked, active, count)
    existing = asked & set(range(count))
    assert selection.curves == existing | {wanted}
    # The one asked for, or the nearest of those chosen.
    nearest = min((abs(index - active) for index in existing), default=0)
    assert abs(wanted - active) == (0 if active in existing else nearest)


@pytest.mark.parametrize(
    ("asked", "domain", "expected"),
    [
        (0.25, (0.0, 1.0), 0.25),
        (-1.0, (0.0, 1.0), 0.0),
        (2.0, (0.0, 1.0), 1.0),
        (0.5, None, None),
        (None, (0.0, 1.0), None),
    ],
)
def test_the_scrub_line_stays_on_the_curve(asked, domain, expected):
    selection = Selection()
    assert selection.scrub_to(asked, domain) == (expected is not None)
    assert selection.scrub == expected
    assert selection.scrub_asked == asked
    # On a longer curve it stands where it was asked for.
    selection.scrub_to(selection.scrub_asked, (-5.0, 5.0))
    assert selection.scrub == asked


@given(st.integers(-3, 8), st.integers(0, 5))
def test_no_point_is_hovered_that_does_not_exist(index, count):
    selection = Selection()
    selection.hover(index, count)
    assert selection.hovered == (index if 0 <= index < count else -1)


def test_chosen_curves_are_followed_to_their_new_places():
    selection = Selection()
    selection.select_curves({0, 2}, 2, 3)
    a, b, c = CURVES
    assert selection.follow_curves(CURVES, (c, a, b), 0)
    assert selection.curves == {0, 1}
    # Of several that are gone the active one stays, alone.
    assert selection.follow_curves((c, a, b), (b,), 0)
    assert selection.curves == {0}


def test_selected_points_are_followed_to_where_they_are():
    selection = Selection()
    selection.select([1], 2)
    before = CURVES[0]
    assert selection.followed_points(before, make_curve([(0.0, 1.0), (7.0, 7.0), (8.0, 8.0)])) == {0}
    assert selection.followed_points(before, make_curve([(9.0, 9.0), (5.0, 5.0)])) == {1}
    assert selection.followed_points(None, before) == frozenset()
