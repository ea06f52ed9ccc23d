"""A part of the curve redrawn with the pencil: replaced, extended, closed; and what becomes a new curve."""

from __future__ import annotations

import math
import threading

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt

from app.document.derivatives import VelocityRule
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.tools.canvas import pencil
from app.view_model.curve.curve_view import view_of
from tests.gui.editor_facts import undo_text
from tests.waiting import until

SHIFT = Qt.KeyboardModifier.ShiftModifier
POINTS = ((0.0, 0.0), (2.0, 1.0), (4.0, 0.0), (6.0, 1.0), (8.0, 0.0))
RING = ((3.0, 0.0), (0.0, 3.0), (-3.0, 0.0), (0.0, -3.0))
KEPT = 1e-12
"""A point inserted, and a curve cut there, move positions below 10 by a few roundings."""


@pytest.fixture
def wave(editor):
    """A cubic curve over t = 0 to 1, and the pencil."""
    return begin(editor, make_curve(POINTS, name="Wave", family=HERMITE))


@pytest.fixture
def ring(editor):
    """A closed cubic curve, and the pencil."""
    return begin(editor, replace(make_curve(RING, name="Ring", family=HERMITE), closed=True))


def begin(editor, curve):
    editor.session.change("Begin", lambda _document: Document((curve,)))
    editor.window.canvas.camera.show_box((-6, 12), (-5, 5))
    editor.settle()
    editor.trigger("pencilTool")
    return editor


def on(editor, t):
    x, y = editor.session.active_view.curve.evaluate(t)
    return float(x), float(y)


def between(a, b, *, bulge=0.0, count=50):
    """Positions from one to another, to the left of their line by a sine."""
    u = np.linspace(0.0, 1.0, count)[:, None]
    (dx, dy), start = np.subtract(b, a), np.array(a)
    aside = bulge * np.sin(np.pi * u) * np.array([-dy, dx]) / math.hypot(dx, dy)
    return [tuple(each) for each in (start + u * np.array([dx, dy]) + aside).tolist()]


def draw(editor, line, *, keys=Qt.KeyboardModifier.NoModifier, release=True):
    editor.press(line[0], keys=keys)
    for at in line[1:]:
        editor.move(at, keys=keys)
    editor.settle()
    if release:
        editor.release(line[-1], keys=keys)
        until(lambda: not editor.window.canvas.tools.background.lines)
        editor.settle()


def farthest(editor, line):
    """Return the largest distance of a line from the active curve, in pixels, by samples of it."""
    curve = editor.session.active_view.curve
    samples = curve.evaluate(np.linspace(*curve.domain, 4000))
    apart = np.array(line)[:, None] - samples[None]
    return float(np.hypot(*apart.transpose(2, 0, 1)).min(axis=1).max()) * editor.window.canvas.pixel_map.sx


def index_near(editor, position):
    distances = [math.dist(point.position, position) for point in editor.curve.points]
    assert min(distances) < 0.1
    return distances.index(min(distances))


# A part of an open curve


@pytest.mark.parametrize("is_against", [False, True])
@pytest.mark.parametrize("family", ["hermite", "quintic_hermite", "septic_hermite"])
def test_a_stroke_from_the_curve_to_the_curve_replaces_that_part(wave, family, is_against):
    wave.choose_family(family)
    wave.trigger("pencilTool")
    before, steps = wave.session.active_view, wave.session.undo_stack.count()
    line = between(on(wave, 0.3), on(wave, 0.8), bulge=-1.5)
    draw(wave, line[::-1] if is_against else line)
    assert undo_text(wave) == "Redraw part"
    assert wave.session.undo_stack.count() == steps + 1
    assert len(wave.session.document.curves) == 1
    assert wave.status.startswith("Part redrawn: ")
    after = wave.session.active_view
    # The press is within a pixel of its parameter; up to there, and from there on, the curve is the same.
    t = np.linspace(0.0, 0.299, 60)
    assert after.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=KEPT)
    later = after.curve.domain[1] - 1.0
    t = np.linspace(0.801, 1.0, 60)
    assert after.curve.evaluate(t + later) == pytest.approx(before.curve.evaluate(t), abs=KEPT)
    # The tolerance of the pencil, the samples 0.2 px apart, and ends on the curve, not a pixel beside it.
    assert farthest(wave, line) <= 2.3
    wave.trigger("undo")
    assert wave.session.active_view.source == before.source


def test_corners_are_where_the_stroke_turns_away_and_smooth_points_where_it_goes_on(wave):
    """From the crest at t = 1/4 on along the curve, then with a steep end into it."""
    a, b = on(wave, 0.25), on(wave, 0.75)
    vx, vy = wave.session.active_view.curve.evaluate(0.25, 1)
    along = (a[0] + 1.2 * vx / math.hypot(vx, vy), a[1] + 1.2 * vy / math.hypot(vx, vy))
    low = (b[0], -2.0)
    bend = [(along[0] + (low[0] - along[0]) * u, along[1] - 2.0 * u**2) for u in np.linspace(0, 1, 30)]
    line = between(a, along, count=15) + bend[1:] + between(bend[-1], b, count=20)[1:]
    draw(wave, line)
    first, last = (wave.curve.points[index_near(wave, at)] for at in (a, b))
    assert first.position == POINTS[1]
    assert (first.corner, last.corner) == (False, True)
    # One velocity on both sides: the stroke is passed at the speed of the curve.
    view = wave.session.active_view
    t = float(view.parameters[index_near(wave, a)])
    slopes = [view.curve.evaluate(t + side * 1e-9, 1) for side in (-1, 1)]
    assert slopes[0] == pytest.approx(slopes[1], abs=1e-6)


def test_points_that_keep_their_estimates_are_not_set(wave):
    """The C² spline ends at what is set, so that the rest of it is the same spline."""
    draw(wave, between(on(wave, 0.3), on(wave, 0.8), bulge=-1.5))
    given = [point.velocity is not None for point in wave.curve.points]
    assert given == [False, False, *[True] * (len(given) - 3), False]


def test_points_that_a_local_rule_sees_far_away_are_not_set(editor):
    points = [(float(x), math.sin(x)) for x in range(12)]
    curve = replace(make_curve(points, family=HERMITE), velocity_rule=VelocityRule.CATMULL_ROM)
    wave = begin(editor, curve)
    draw(wave, between(points[7], points[9], bulge=0.7))
    assert not any(point.velocity for point in wave.curve.points[:6])
    assert wave.message == ""


def test_points_that_a_local_rule_would_move_are_named_and_can_be_reset(editor):
    points = [(float(x), math.sin(2 * x)) for x in range(12)]
    wave = begin(editor, replace(make_curve(points, family=HERMITE), velocity_rule=VelocityRule.AKIMA))
    draw(wave, between(on(wave, 0.55), on(wave, 0.72), bulge=0.7))
    assert wave.message.endswith("were set to keep the shape.")
    given = sum(point.velocity is not None for point in wave.curve.points)
    wave.trigger("resetKept")
    assert sum(point.velocity is not None for point in wave.curve.points) < given


def test_the_part_and_the_effect_are_shown_while_it_is_drawn_and_escape_leaves_no_trace(wave):
    before, steps = wave.session.document, wave.session.undo_stack.count()
    wave.hover(on(wave, 0.3))
    assert wave.window.status_line.hint.startswith(
        "Drag from here back to it to redraw a part · Shift: a new curve"
    )
    line = between(on(wave, 0.3), on(wave, 0.8), bulge=1.0)
    draw(wave, line[:25], release=False)
    marks = wave.window.canvas.marks
    assert marks.replaced == ()
    assert "end on the curve: redraw that part" in wave.status
    for at in line[25:]:
        wave.move(at)
    wave.settle()
    wave.window.canvas.show_status()
    marks = wave.window.canvas.marks
    expected = [on(wave, t) for t in (0.3, 0.8)]
    assert [marks.replaced[0], marks.replaced[-1]] == [pytest.approx(each, abs=0.02) for each in expected]
    assert wave.status.startswith("Release: redraw part")
    wave.escape()
    assert wave.window.canvas.marks.replaced == ()
    wave.release(line[-1])
    assert wave.session.document == before
    assert wave.session.undo_stack.count() == steps


# Ends of an open curve


@pytest.mark.parametrize("is_last", [True, False])
def test_a_stroke_from_an_end_extends_the_curve(wave, is_last):
    before = wave.session.active_view
    end = POINTS[-1 if is_last else 0]
    wave.hover(end)
    assert wave.window.status_line.hint.startswith("Drag to extend the curve")
    # Down, at first in the direction of the curve.
    way = 1 if is_last else -1
    line = between(end, (end[0] + 2 * way, -3.0), bulge=0.3 * way)
    draw(wave, line)
    assert undo_text(wave) == "Extend curve"
    assert wave.status.startswith("Curve extended: ")
    assert len(wave.session.document.curves) == 1
    after, t = wave.session.active_view, np.linspace(0.0, 1.0, 99)
    shift = 0.0 if is_last else after.curve.domain[1] - 1.0
    assert after.curve.evaluate(t + shift) == pytest.approx(before.curve.evaluate(t), abs=KEPT)
    assert farthest(wave, line) <= 2.2
    assert not wave.curve.points[index_near(wave, end)].corner


def test_an_end_stays_where_it_is_when_the_stroke_begins_a_few_pixels_beside_it(wave):
    pixel = 1 / wave.window.canvas.pixel_map.sx
    beside = (POINTS[-1][0] + 5 * pixel, POINTS[-1][1] + 4 * pixel)
    draw(wave, between(beside, on(wave, 0.4), bulge=1.0))
    assert undo_text(wave) == "Redraw part"
    assert wave.curve.points[-1].position == POINTS[-1]


@pytest.mark.parametrize("is_against", [False, True])
def test_a_stroke_from_end_to_end_closes_the_curve(wave, is_against):
    before, t = wave.session.active_view, np.linspace(0.0, 1.0, 99)
    line = between(POINTS[-1], POINTS[0], bulge=2.5)
    draw(wave, line[::-1] if is_against else line)
    assert undo_text(wave) == "Close curve"
    assert wave.status.startswith("Curve closed: ")
    assert wave.curve.is_closed
    assert wave.session.active_view.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=KEPT)
    assert farthest(wave, line) <= 2.2


def test_undo_of_a_stray_stroke_leaves_the_curve_as_edited(wave):
    """No curve was selected after it, and the stroke from end to end was a loose “Curve 2”."""
    x, y = POINTS[1]
    draw(wave, between((x, y), (x, y + 2.0)))
    assert len(wave.session.document.curves) == 2
    wave.trigger("undo")
    assert wave.session.selected.is_editing
    draw(wave, between(POINTS[-1], POINTS[0], bulge=2.5))
    assert undo_text(wave) == "Close curve"
    assert len(wave.session.document.curves) == 1


# Closed curves


@pytest.mark.parametrize("is_against", [False, True])
def test_of_a_closed_curve_the_part_nearer_to_the_stroke_is_replaced(ring, is_against):
    """A chord cuts off the cap above it; what begins at point 0 still does."""
    before = ring.session.active_view
    line = between(on(ring, 0.1), on(ring, 0.4))
    draw(ring, line[::-1] if is_against else line)
    assert undo_text(ring) == "Redraw part"
    assert ring.curve.is_closed
    assert ring.curve.points[0].position == RING[0]
    assert RING[1] not in [point.position for point in ring.curve.points]
    after, t = ring.session.active_view, np.linspace(0.0, 0.099, 30)
    assert after.curve.domain[0] == 0.0
    assert after.curve.evaluate(t) == pytest.approx(before.curve.evaluate(t), abs=KEPT)
    t = np.linspace(0.401, 1.0, 60)
    assert after.curve.evaluate(t + after.curve.domain[1] - 1.0) == pytest.approx(
        before.curve.evaluate(t), abs=KEPT
    )
    assert [point.corner for point in ring.curve.points[1:3]] == [True, True]


def test_a_stroke_around_the_long_part_of_a_closed_curve_replaces_that(ring):
    before = ring.session.active_view
    a, b = on(ring, 0.1), on(ring, 0.4)
    turns = np.linspace(math.atan2(a[1], a[0]), math.atan2(b[1], b[0]) - 2 * math.pi, 90)
    around = [(4.2 * math.cos(turn), 4.2 * math.sin(turn)) for turn in turns]
    draw(ring, [a, *around, b])
    positions = [point.position for point in ring.curve.points]
    assert RING[1] in positions
    assert not {RING[0], RING[2], RING[3]} & set(positions)
    t = np.linspace(0.101, 0.399, 60)
    after = view_of(ring.curve).curve.evaluate(t)
    assert after == pytest.approx(before.curve.evaluate(t), abs=KEPT)


# What becomes a new curve


def strokes(editor):
    inside, outside = on(editor, 0.3), on(editor, 0.8)
    return {
        "begins elsewhere": (between((3.0, 3.0), outside), {}),
        "ends elsewhere": (between(inside, (3.0, 3.0)), {}),
        "shift": (between(inside, outside, bulge=1.0), {"keys": SHIFT}),
    }


@pytest.mark.parametrize("name", ["begins elsewhere", "ends elsewhere", "shift"])
def test_other_strokes_are_new_curves(wave, name):
    before = wave.curve
    line, keys = strokes(wave)[name]
    draw(wave, line, **keys)
    assert undo_text(wave) == "Draw with the pencil"
    assert len(wave.session.document.curves) == 2
    assert wave.session.document.curves[0] == before


def test_a_curve_without_parts_says_why_a_new_one_is_drawn(editor):
    wave = begin(editor, make_curve(POINTS, name="Wave", family=LAGRANGE))
    wave.hover(on(wave, 0.3))
    assert "Lagrange curve is one polynomial and has no segments" in wave.window.status_line.hint
    line = between(on(wave, 0.3), on(wave, 0.8), bulge=1.0)
    draw(wave, line, release=False)
    assert wave.status.startswith("Drawing a new curve, medium (2 px) · ")
    wave.release(line[-1])
    until(lambda: not wave.window.canvas.tools.background.lines)
    assert len(wave.session.document.curves) == 2


def test_a_locked_curve_keeps_its_parts(wave):
    wave.trigger("curveLocked")
    before = wave.curve
    draw(wave, between(on(wave, 0.3), on(wave, 0.8), bulge=1.0))
    assert wave.session.document.curves[0] == before
    assert len(wave.session.document.curves) == 2


def test_a_curve_that_changed_meanwhile_is_left_alone(wave, monkeypatch):
    may_fit, redrawn = threading.Event(), pencil.redrawn

    def waiting(*arguments, **more):
        may_fit.wait()
        return redrawn(*arguments, **more)

    monkeypatch.setattr(pencil, "redrawn", waiting)
    line = between(on(wave, 0.3), on(wave, 0.8), bulge=1.0)
    draw(wave, line, release=False)
    wave.release(line[-1])
    wave.session.change(
        "Close", lambda document: document.with_curve(0, replace(document.curves[0], closed=True))
    )
    before = wave.session.document
    may_fit.set()
    until(lambda: not wave.window.canvas.tools.background.lines)
    wave.settle()
    assert wave.session.document == before
    assert wave.status == "“Wave” has changed meanwhile; draw the line again."


@pytest.mark.parametrize("is_on_point", [False, True])
def test_any_outline_of_the_edited_shape_is_redrawn(ring, is_on_point):
    """A stroke on another outline than the active one was a loose curve."""
    inner = make_curve([(x / 3, y / 3) for x, y in RING], name="Hole", family=HERMITE)
    ring.session.change(
        "Begin",
        lambda _: Document((replace(ring.curve, shape="Ring"), replace(inner, closed=True, shape="Ring"))),
    )
    ring.session.selected.activate(0)
    ring.settle()
    hole = ring.session.views[1].curve
    begin, end = hole.evaluate(0.0 if is_on_point else 0.05).tolist(), hole.evaluate(0.4).tolist()
    draw(ring, between(begin, end, bulge=0.3))
    assert undo_text(ring) == "Redraw part"
    assert len(ring.session.document.curves) == 2
    assert ring.session.active_index == 1


@pytest.mark.parametrize(
    "family", [each for each in FAMILIES if each.derivatives], ids=lambda each: each.name
)
def test_a_flick_of_two_positions_is_enough(editor, family):
    wave = begin(editor, make_curve(POINTS, name="Wave", family=family))
    a, b = on(wave, 0.3), on(wave, 0.8)
    draw(wave, [a, b])
    assert undo_text(wave) == "Redraw part"
    # Smooth where it leaves the curve by less than 30°, and thereby bent.
    assert farthest(wave, between(a, b)) <= 10.0
    assert len(wave.curve.points) == 5
