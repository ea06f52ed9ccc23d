"""The curve itself and its handles under the hand, with real mouse events."""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from app.document import curve_edits, point_edits, rule_edits
from app.document.limits import EditError
from app.document.model import Document, ParametrizationKind, derivatives_of, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.view_model.bend import Bend, BendWith
from app.view_model.curve.curve_view import view_of
from curvecore import LagrangeCurve, bezier_segments, chord_length
from curvecore.bezier.flatten import segment_distance

SHIFT = Qt.KeyboardModifier.ShiftModifier
CTRL = Qt.KeyboardModifier.ControlModifier
ALT = Qt.KeyboardModifier.AltModifier
NO_KEYS = Qt.KeyboardModifier.NoModifier
INSERTS = "Double click: insert a point"
POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0))


def with_everything_set(view):
    """The curve with the velocities and accelerations that the rules gave it set by hand."""
    points = tuple(
        point.with_derivatives([view.derivative_of(index, order) for order in (1, 2, 3)], ())
        for index, point in enumerate(view.source.points)
    )
    return replace(view.source, points=points)


def ruled(editor, family, kind):
    """Give the curve of `arch` a family and a rule, at once."""
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, family)
    editor.session.commit(rule_edits.set_parametrization(document, 0, kind, []), "Begin again")


def middle(editor, segment=1, share=0.4):
    """The parameter and the point of the curve at a share of a segment."""
    t = editor.parameters[segment] + share * (editor.parameters[segment + 1] - editor.parameters[segment])
    x, y = editor.session.active_view.curve.evaluate(t)
    return t, (float(x), float(y))


def keys_of(family, *keys):
    """Return keys to hold; without derivatives all bend as none does, which one family is to show."""
    return keys if family.derivatives or family is LAGRANGE else keys[:1]


def test_the_grabbed_point_stays_under_the_pointer(arch):
    kinds = (ParametrizationKind.CHORD_LENGTH, ParametrizationKind.UNIFORM)
    for family in FAMILIES:
        for keys, kind in product(keys_of(family, NO_KEYS, CTRL, ALT), kinds):
            ruled(arch, family, kind)
            _, start = middle(arch)
            target = (start[0] - 0.4, start[1] + 0.7)
            arch.press(start, keys=keys)
            for share in (0.3, 0.6, 1.0):
                to = tuple(np.add(start, np.multiply(share, np.subtract(target, start))))
                arch.move(to, keys=keys)
                _, now = middle(arch)
                # The press and the move are on whole pixels.
                assert math.dist(now, to) < 1.5 * arch.pixel, (family, keys, kind)
            arch.release(target, keys=keys)
            assert arch.session.undo_stack.undoText().startswith("Bend curve at t = 0."), (family, keys, kind)
            if keys == CTRL:
                assert all(point.velocity is None for point in arch.curve.points), (family, kind)
            is_same = [point.position for point in arch.curve.points] == list(POINTS)
            assert is_same == (keys == NO_KEYS and bool(family.derivatives)), (family, keys, kind)


def test_an_insertion_is_one_step_that_undo_reverts(arch):
    document, steps = arch.session.document, arch.session.undo_stack.count()
    arch.bend(0.45, (1.5, 3.0))
    assert arch.session.undo_stack.count() == steps + 1
    arch.trigger("undo")
    assert arch.session.document is document


def test_bending_can_be_cancelled(arch):
    document = arch.session.document
    _, start = middle(arch)
    arch.press(start)
    arch.move((start[0], start[1] + 1))
    assert arch.session.document != document
    arch.escape()
    arch.release(start)
    assert arch.session.document is document


def test_a_click_on_the_curve_selects_the_ends_of_its_segment_and_displays_the_position(arch):
    document = arch.session.document
    t, place = middle(arch)
    arch.click(place)
    assert arch.session.selection == {1, 2}
    assert arch.session.document is document
    ends, shown, _ = arch.status.split(" · ")
    assert ends == "2 points selected"
    shown = float(shown.removeprefix("t = "))
    assert shown == pytest.approx(t, abs=2e-3)
    assert "c(t) = (" in arch.status


def test_the_hint_before_the_press_says_whether_the_points_stay(arch):
    for family in FAMILIES:
        ruled(arch, family, ParametrizationKind.CHORD_LENGTH)
        line, place = arch.window.status_line, middle(arch)[1]
        arch.hover(place)
        clicks = f"Click: select both ends · {INSERTS}" if family.interpolates else INSERTS
        if not family.derivatives:
            moved = f"the {family.point}s move"
            assert line.hint == f"Drag to bend; this family has no handles: {moved} · {clicks}", family
            continue
        keys = "Alt: move the points as well · Ctrl: move only the points"
        assert line.hint == f"Drag to bend; the points stay · {keys} · {clicks}", family
        # While a key is held, what it does.
        arch.move(place, held=False, keys=ALT)
        assert line.hint == "Drag to bend; the points move as well", family
        arch.move(place, held=False, keys=CTRL)
        assert line.hint == "Drag to bend; only the points move", family


def test_a_key_counts_before_and_during_a_bend_and_changes_the_hint(arch):
    arch.choose_family(HERMITE)
    canvas, line, place = arch.window.canvas, arch.window.status_line, middle(arch)[1]
    arch.hover((place[0], place[1] + 1))
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.ArrowCursor
    arch.hover(place)
    assert canvas.viewport().cursor().shape() == Qt.CursorShape.BitmapCursor
    canvas.setFocus()
    QTest.keyPress(canvas, Qt.Key.Key_Alt)
    arch.settle()
    assert line.hint == "Drag to bend; the points move as well"
    QTest.keyRelease(canvas, Qt.Key.Key_Alt)
    arch.settle()
    assert line.hint.startswith("Drag to bend; the points stay")
    arch.press(place)
    arch.move((2, 3))
    assert arch.status.startswith("Bend at t = 0.")
    assert ": the points stay · Alt: move the points as well · Ctrl: move only the points" in arch.status
    assert [point.position for point in arch.curve.points] == list(POINTS)
    QTest.keyPress(canvas, Qt.Key.Key_Alt)
    arch.settle()
    assert ": the points move as well" in arch.status
    assert [point.position for point in arch.curve.points] != list(POINTS)
    QTest.keyRelease(canvas, Qt.Key.Key_Alt)
    arch.settle()
    assert [point.position for point in arch.curve.points] == list(POINTS)
    arch.escape()


def test_a_bend_sets_only_the_estimated_handles_beside_the_segment(arch):
    arch.choose_family(HERMITE)
    start = middle(arch)[1]
    arch.drag(start, (start[0], start[1] + 0.5))
    assert [point.velocity is not None for point in arch.curve.points] == [False, True, True, False]


def test_without_handles_a_bend_moves_the_points_as_displayed_in_the_hint(arch):
    arch.choose_family(LAGRANGE)
    start = middle(arch)[1]
    arch.press(start)
    arch.move((start[0], start[1] + 0.5))
    assert "this family has no handles: the points move" in arch.status
    arch.release((start[0], start[1] + 0.5))
    assert [point.position for point in arch.curve.points] != list(POINTS)


def test_so_close_to_a_point_that_no_handle_reaches_alt_is_offered():
    view = view_of(rule_edits.set_family(Document((make_curve(POINTS),)), 0, HERMITE).curves[0])
    with pytest.raises(EditError, match="Hold Alt to move the point"):
        Bend(view, float(view.parameters[1]), BendWith.DERIVATIVES)
    Bend(view, float(view.parameters[1]), BendWith.ALL).bent((2.0, 3.0), 1e-6)


def test_the_change_is_the_one_of_least_norm():
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, LAGRANGE)
    view = view_of(rule_edits.freeze_parameters(document, 0, [0.0, 0.2, 0.7, 1.0]).curves[0])
    pull = (0.3, -0.2)
    target = tuple((view.curve.evaluate(0.41) + pull).tolist())
    delta = view_of(Bend(view, 0.41, BendWith.ALL).bent(target, 1e-9)).points - view.points
    # The oracle: NumPy's least-norm solution of one equation in four unknowns.
    row = view.curve.basis(np.array([0.41]))[:, :, 0]
    expected = np.linalg.lstsq(row, np.array([pull]), rcond=None)[0]
    assert delta == pytest.approx(expected, abs=1e-14)


def control_points(curve):
    """All Bézier control points, each once, in one row; those on the curve are every third or fifth."""
    pieces = bezier_segments(curve)
    return np.vstack([pieces[0, :1], *(piece[1:] for piece in pieces)])


def answers(view, knots, orders):
    """How the control points answer to the data at `knots`: a column for each datum."""
    rest, columns = control_points(view.curve), []
    for knot in knots:
        for order in orders:
            jets = view.curve.jets.copy()
            jets[knot, order] += (1.0, 0.0)
            moved = view.curve.with_jets(jets)
            columns.append((control_points(moved) - rest)[:, 0])
    return np.array(columns).T


@pytest.mark.parametrize("family", [family for family in FAMILIES if family.derivatives])
@pytest.mark.parametrize("using", [BendWith.ALL, BendWith.DERIVATIVES])
@pytest.mark.parametrize("segment", [0, 1])
@pytest.mark.parametrize("share", [0.25, 0.5, 0.72])
def test_control_points_on_both_sides_of_the_joints_change_least(family, using, segment, share):
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, family)
    view = view_of(rule_edits.freeze_parameters(document, 0, [0.0, 0.2, 0.7, 1.0]).curves[0])
    # Explicit, so that no rule answers to the points.
    view = view_of(with_everything_set(view))
    t = view.parameters[segment] + share * (view.parameters[segment + 1] - view.parameters[segment])
    pull = np.array([0.3, -0.2])
    target = tuple((view.curve.evaluate(t) + pull).tolist())
    after = view_of(Bend(view, t, using).bent(target, 1e-12))
    orders = range(int(using is BendWith.DERIVATIVES), view.curve.jets.shape[1])
    knots = (segment, segment + 1)
    answer = answers(view, knots, orders)
    # A way of a point on the curve counts five times as much as one of a handle, less in its quarter.
    price = np.ones(len(answer))
    price[:: view.curve.degree] = 5.0
    for knot, near in zip(knots, (share, 1 - share), strict=True):
        price[knot * view.curve.degree] = 1 + 4 * min(near / 0.25, 1)
    weights = view.curve.basis(np.array([t]))[0][np.ix_(knots, orders)].ravel()
    # The oracle: least squares under one condition, by the equations of Lagrange's multiplier.
    normal = 2 * (price[:, None] * answer).T @ (price[:, None] * answer)
    system = np.block([[normal, weights[:, None]], [weights[None], np.zeros((1, 1))]])
    best = np.linalg.solve(system, np.vstack([np.zeros((len(weights), 2)), pull]))[:-1]
    assert control_points(after.curve) - control_points(view.curve) == pytest.approx(answer @ best, abs=1e-12)


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_press_near_a_point_means_the_point(arch, family, side):
    """A cubic pulled by 60 pixels, 13 beside a point, had handles of 270 pixels and a loop."""
    ruled(arch, family, ParametrizationKind.CHORD_LENGTH)
    arch.window.canvas.camera.show_box((-1, 5), (-1, 3))
    arch.settle()
    before, is_point = arch.session.document, {}
    for pixels in (5, 9, 11, 15, 30):
        curve, pixel_map = arch.session.active_view.curve, arch.window.canvas.pixel_map
        end = arch.parameters[1 + side]
        t = np.linspace(arch.parameters[1], end, 2000)
        away = np.hypot(*(pixel_map.points(curve.evaluate(t)) - pixel_map.point(*POINTS[1])).T)
        start = tuple(curve.evaluate(t[np.argmax(away >= pixels)]).tolist())
        arch.drag(start, (start[0], start[1] + 60 * arch.pixel))
        is_point[pixels] = arch.point(1) != POINTS[1]
        step = "Move point 1" if is_point[pixels] else "Bend curve at t = "
        assert arch.session.undo_stack.undoText().startswith(step)
        pieces = bezier_segments(arch.session.active_view.curve)
        handles = np.vstack([pieces[:, 1] - pieces[:, 0], pieces[:, -1] - pieces[:, -2]])
        # Before they are 47 pixels of a scale of 56 long, and no segment is shorter than 2.
        assert np.hypot(*handles.T).max() < 47 / 56 + 2 / 2, pixels
        arch.trigger("undo")
        arch.session.selected.set_points([])
        assert arch.session.document == before
    assert is_point == {5: True, 9: True, 11: True, 15: False, 30: False}


def grabbed(view, share, pull, segment=1):
    """The grabbed place after a bend of the handles, and the farthest move of a handle of its segment."""
    low, high = view.parameters[segment : segment + 2]
    t = float(low + share * (high - low))
    bend = Bend(view, t, BendWith.DERIVATIVES)
    target = tuple((view.curve.evaluate(t) + pull).tolist())
    after = view_of(bend.bent(target, 1e-9), view)
    moved = (bezier_segments(after.curve) - bezier_segments(view.curve))[segment]
    way = np.hypot(*(after.curve.evaluate(t) - view.curve.evaluate(t)))
    return way / np.hypot(*pull), np.hypot(*moved.T).max(), bend.is_limited(target)


@pytest.mark.parametrize("family", [HERMITE, QUINTIC_HERMITE])
@pytest.mark.parametrize("way", [(0.0, 1.0), (-1.0, 0.2), (0.7, -0.7)])
def test_a_bend_close_to_a_point_limits_its_handles_without_a_jump(family, way):
    view = view_of(rule_edits.set_family(Document((make_curve(POINTS),)), 0, family).curves[0])
    length = 2.2  # of the segment, at least
    for share in (0.02, 0.1, 0.2, 0.8, 0.98):
        # Live: the farther the pull, the farther the handles; but never by the length of the segment.
        results = [grabbed(view, share, np.multiply(pull, way)) for pull in np.geomspace(0.01, 100.0, 60)]
        ways = [moved for _, moved, _ in results]
        assert all(a < b for a, b in pairwise(ways)), share
        nearness = 1 - min(share, 1 - share) / 0.25
        assert max(ways) < length / (2 * nearness), share
        # A pull that moves no handle by a third of the segment is exact, but within its first tenth.
        if 0.1 <= share <= 0.9:
            assert all((abs(exact - 1) < 1e-9) != limited for exact, _, limited in results)
            assert results[0][2] is False
    # No jump where the limits begin.
    for limit in (0.1, 0.25, 0.75, 0.9):
        beside = [grabbed(view, limit + d, np.multiply(1.5, way))[:2] for d in (-1e-6, 1e-6)]
        assert beside[0] == pytest.approx(beside[1], rel=1e-4)
    # In the middle it is exact, however far.
    for share in (0.25, 0.4, 0.75):
        assert grabbed(view, share, np.multiply(30.0, way))[0] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("family", [family for family in FAMILIES if family.derivatives])
def test_a_bend_close_to_a_point_moves_the_point(family):
    """Its handles used to swing three times as far as the pointer, and made a hook on both sides."""
    view = view_of(rule_edits.set_family(Document((make_curve(POINTS),)), 0, family).curves[0])
    t = float(view.parameters[1] + 0.06 * (view.parameters[2] - view.parameters[1]))
    pull = np.array([0.2, 0.3])
    after = view_of(Bend(view, t, BendWith.ALL).bent(tuple((view.curve.evaluate(t) + pull).tolist()), 1e-9))
    assert after.points[1] - view.points[1] == pytest.approx(pull, rel=0.15)
    for segment in (0, 1):
        ways = [np.linspace(*each.parameters[segment : segment + 2], 200) for each in (view, after)]
        moved = after.curve.evaluate(ways[1]) - view.curve.evaluate(ways[0])
        assert np.hypot(*moved.T).max() < 1.1 * np.hypot(*pull)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5])
def test_a_small_pull_causes_no_large_swing_in_the_next_segment(share):
    """A quintic's handles counted on one side alone: the neighbour went three times as far as the pointer."""
    view = view_of(rule_edits.set_family(Document((make_curve(POINTS),)), 0, QUINTIC_HERMITE).curves[0])
    t = float(view.parameters[1] + share * (view.parameters[2] - view.parameters[1]))
    target = view.curve.evaluate(t) + np.array([0.0, 0.2])
    after = view_of(Bend(view, t, BendWith.ALL).bent(tuple(target.tolist()), 1e-9))
    for segment in (0, 2):
        ways = [np.linspace(*each.parameters[segment : segment + 2], 200) for each in (view, after)]
        moved = after.curve.evaluate(ways[1]) - view.curve.evaluate(ways[0])
        assert np.hypot(*moved.T).max() < 0.2


@pytest.mark.parametrize(("share", "most"), [(0.5, 0.15), (0.7, 0.3), (0.85, 0.7)])
def test_points_that_were_placed_move_far_less_than_the_pointer(share, most):
    """With h v for the norm they went along by 94 hundredths of the way."""
    view = view_of(rule_edits.set_family(Document((make_curve(POINTS),)), 0, HERMITE).curves[0])
    t = float(view.parameters[1] + share * (view.parameters[2] - view.parameters[1]))
    target = tuple((view.curve.evaluate(t) + np.array([0.4, 0.3])).tolist())
    after = view_of(Bend(view, t, BendWith.ALL).bent(target, 1e-6))
    assert np.hypot(*(after.points - view.points).T).max() < most * 0.5


@pytest.mark.parametrize("family", [family for family in FAMILIES if family.derivatives])
def test_the_norm_does_not_depend_on_the_unit_of_time(family):
    slow = rule_edits.set_family(Document((make_curve(POINTS),)), 0, family)
    # No document holds a jerk by the cube of a thousandth.
    short = 1e-3 if family.derivatives < 3 else 1e-2
    fast = rule_edits.set_interval(slow, 0, 0.0, short)
    results = []
    for document, end in ((slow, 1.0), (fast, short)):
        curve = Bend(view_of(document.curves[0]), 0.4 * end, BendWith.ALL).bent((2.0, 3.0), 1e-9)
        results.append([point.position for point in curve.points])
    assert np.array(results[0]) == pytest.approx(np.array(results[1]), abs=1e-9)


@pytest.mark.parametrize(
    ("family", "using"),
    [
        pytest.param(family, using, id=f"{family.name}-{using.name}")
        for family in FAMILIES
        # Without derivatives all ways to bend are this one.
        for using in (BendWith if family.derivatives else [BendWith.POINTS])
    ],
)
@pytest.mark.parametrize("kind", list(ParametrizationKind))
def test_the_grabbed_point_follows_ten_times_as_far_as_the_curve_is_large(family, kind, using):
    # Broyden's method alone gave up on 27 of 48 such pulls of 20 points at chord length.
    random = np.random.default_rng(3)
    for count in (4, 20):
        points = random.normal(size=(count, 2)).cumsum(axis=0)
        document = Document((make_curve(points, family=family),))
        parameters = view_of(document.curves[0]).parameters.tolist()
        view = view_of(rule_edits.set_parametrization(document, 0, kind, parameters).curves[0])
        segment, share = count // 2 - 1, 0.4
        start, end = view.parameters[segment : segment + 2]
        t = float(start + share * (end - start))
        place, bend = view.curve.evaluate(t), Bend(view, t, using)
        for angle, far, accuracy in ((0.3, 10, 1e-4), (2.4, 10, 1e-4), (4.5, 10, 1e-4), (1.2, 0.1, 1e-6)):
            target = place + far * np.ptp(points) * np.array([np.cos(angle), np.sin(angle)])
            after = view_of(bend.bent(tuple(target), accuracy))
            start, end = after.parameters[segment : segment + 2]
            reached = after.curve.evaluate(start + share * (end - start))
            assert reached == pytest.approx(target, abs=2 * accuracy if far < 1 else accuracy)


def test_with_a_shift_allowed_the_change_is_the_least_that_can_be():
    view = view_of(make_curve(np.random.default_rng(5).normal(size=(7, 2)).cumsum(axis=0)))
    t, pull = 0.4, np.array([0.3, -0.2])
    segment = int(np.searchsorted(view.parameters, t)) - 1
    share = (t - view.parameters[segment]) / np.diff(view.parameters)[segment]
    place = view.curve.evaluate(t)
    weights = view.curve.basis(np.array([t]))[0, :, 0]
    weights = weights / (weights @ weights)

    def change(bend):
        """What a bend and the shift that it needs do to the points."""
        points = view.points + np.outer(weights, bend)
        tau = chord_length(points)
        there = LagrangeCurve(points, tau).evaluate(tau[segment] + share * (tau[segment + 1] - tau[segment]))
        return points + (place + pull - there) - view.points

    after = view_of(Bend(view, t, BendWith.ALL).bent(tuple(place + pull), 1e-9)).points - view.points
    # The oracle: the best of a grid of bends, and of a finer one around it.
    centre, best = np.zeros(2), np.inf
    for half in (0.6, 0.06):
        grid = np.linspace(-half, half, 21)
        ways = [centre + np.array([x, y]) for x in grid for y in grid]
        sizes = [float(np.linalg.norm(change(way))) for way in ways]
        centre, best = ways[int(np.argmin(sizes))], min(best, *sizes)
    assert np.linalg.norm(after) <= best * 1.02
    assert np.linalg.norm(after) < 0.9 * np.linalg.norm(np.tile(pull, (7, 1)))


@pytest.mark.parametrize("family", FAMILIES)
def test_a_far_pull_ends_the_same_along_every_path(arch, family):
    ruled(arch, family, ParametrizationKind.CHORD_LENGTH)
    # Wide enough that nothing comes near the edge, where the view would scroll.
    arch.window.canvas.camera.show_box((-20, 20), (-12, 24))
    _, start = middle(arch, share=0.5)
    far = (start[0] - 9.0, start[1] + 13.0)
    for keys in keys_of(family, NO_KEYS, CTRL):
        results = []
        for ways in ([far], [(0, 9), (-12, 3), (13, 14), (start[0], start[1]), far]):
            arch.press(start, keys=keys)
            for to in ways:
                arch.move(to, keys=keys)
                assert arch.session.active_view.is_current, keys
                assert arch.status.startswith("Bend at t = "), keys
            line = arch.session.active_view.flattened(0.1 * arch.pixel).points
            assert segment_distance(np.array([far]), line[:-1], line[1:]).min() < 3 * arch.pixel, keys
            results.append(numbers_of(arch.curve))
            arch.escape()
            arch.release(far)
        # What was grabbed is a place of the line as drawn, whose vertices may be others after a drag.
        assert results[0] == pytest.approx(results[1], rel=1e-4, abs=0.01 * arch.pixel), keys


def numbers_of(curve):
    """Points and what was set there, one after the other."""
    vectors = [(point.position, *map(tuple, filter(None, derivatives_of(point)))) for point in curve.points]
    return [value for each in vectors for vector in each for value in vector]


def test_a_corner_and_a_closed_curve_bend_on_one_side():
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, HERMITE)
    document = curve_edits.set_closed(document, 0, True)
    document = point_edits.make_corner(document, 0, 0, (1.0, 1.0), (2.0, 0.0))
    view = view_of(document.curves[0])
    t = float(view.parameters[-2:].mean())
    curve = Bend(view, t, BendWith.DERIVATIVES).bent((2.0, -1.0), 1e-9)
    assert curve.points[0].velocity_after == (2.0, 0.0)
    assert curve.points[0].velocity != (1.0, 1.0)
    assert view_of(curve).curve.evaluate(t) == pytest.approx((2.0, -1.0))


def test_derivatives_have_no_hold_on_a_joint():
    document = rule_edits.set_family(Document((make_curve(POINTS),)), 0, HERMITE)
    view = view_of(document.curves[0])
    with pytest.raises(EditError, match="cannot bend the curve so close"):
        Bend(view, float(view.parameters[1]), BendWith.DERIVATIVES)


# Handles


def velocity(editor, index=1):
    return np.array(editor.curve.points[index].velocity)


def drag_handle(editor, to, keys):
    editor.drag(editor.handle().position, to, keys=keys)


@pytest.fixture
def hermite(arch):
    arch.choose_family(HERMITE)
    arch.select_point(1)
    return arch


def test_shift_turns_a_handle_in_steps_of_fifteen_degrees(hermite):
    drag_handle(hermite, (2.0, 2.62), SHIFT)  # 31.8 degrees
    vx, vy = velocity(hermite)
    assert math.degrees(math.atan2(vy, vx)) == pytest.approx(30)
    drag_handle(hermite, (2.0, 2.03), SHIFT)
    assert velocity(hermite)[1] == 0.0


def test_shift_and_alt_change_the_length_alone(hermite):
    before = np.array(hermite.session.active_view.velocity_of(1))
    drag_handle(hermite, (3.0, 2.5), SHIFT | ALT)
    after = velocity(hermite)
    assert before[0] * after[1] == pytest.approx(before[1] * after[0])
    assert np.hypot(*after) != pytest.approx(np.hypot(*before), rel=0.1)


def test_a_dragged_handle_displays_length_and_direction(hermite):
    start = hermite.handle().position
    hermite.press(start)
    hermite.move((2.0, 3.0))
    assert hermite.status.startswith("Velocity of point 1: ")
    # The mouse meets whole pixels only.
    angle = float(hermite.status.partition(" at ")[2].partition("°")[0])
    assert angle == pytest.approx(45, abs=1)
    assert "Alt: break the handles apart · Shift+Alt: length only" in hermite.status
    hermite.escape()


def test_an_acceleration_handle_keeps_its_direction_with_shift_and_alt(arch):
    arch.choose_family(QUINTIC_HERMITE)
    arch.select_point(1)
    before = np.array(arch.session.active_view.derivative_of(1, 2))
    arch.drag(arch.handle(2).position, (2.5, 1.0), keys=SHIFT | ALT)
    after = np.array(arch.curve.points[1].acceleration)
    assert np.hypot(*after) != pytest.approx(np.hypot(*before), rel=0.1)
    assert before[0] * after[1] == pytest.approx(before[1] * after[0])


def test_at_a_corner_the_handles_move_independently(hermite):
    document = point_edits.make_corner(hermite.session.document, 0, 1, (4.0, 4.0), (4.0, -4.0))
    hermite.session.commit(document, "Make corner")
    hermite.drag_handle(to=(2, 3))
    assert hermite.curve.points[1].velocity == (4.0, 4.0)
    assert hermite.curve.points[1].velocity_after != (4.0, -4.0)
    after = hermite.curve.points[1].velocity_after
    hermite.drag_handle(to=(0, 2), ahead=False)
    assert hermite.curve.points[1].velocity_after == after
    assert hermite.curve.points[1].velocity != (4.0, 4.0)
    before = hermite.curve.points[1].velocity
    hermite.drag(hermite.point(1), (1.5, 2.5), keys=ALT)
    assert hermite.curve.points[1].velocity == before
    assert hermite.handle().position == pytest.approx((1.5, 2.5), abs=2 * hermite.pixel)
