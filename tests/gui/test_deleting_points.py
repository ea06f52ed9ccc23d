"""Points deleted from curves that were shaped by hand: the shape stays as far as it can."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence

from app.document.constraints import is_straight
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.view_model.point_kinds import SMOOTH, kind_at

CTRL = Qt.KeyboardModifier.ControlModifier


def sampled(view, count):
    return view.curve.evaluate(np.linspace(*view.curve.domain, count))


def distance(before, after):
    """How far a curve is from another, at most."""
    pairs = sampled(before, 400)[:, None] - sampled(after, 8000)[None]
    return np.hypot(*pairs.transpose(2, 0, 1)).min(axis=1).max()


def circle(count):
    """A circle of so many points, and handles as long as for arcs."""
    angles = 2 * math.pi * np.arange(count) / count
    curve = replace(make_curve([(math.cos(t), math.sin(t)) for t in angles], family=HERMITE), closed=True)
    speed = 4 * count * math.tan(math.pi / 2 / count)
    return replace(
        curve,
        points=tuple(replace(each, velocity=(-each.y * speed, each.x * speed)) for each in curve.points),
    )


def test_a_circle_without_one_of_its_points_stays_a_circle(editor):
    """The circle of four points was pulled in by two fifths of its radius."""
    editor.session.commit(Document((circle(4),), unit="mm"), "Begin")
    editor.fit()
    before = editor.session.active_view
    editor.select([1])
    editor.key(Qt.Key.Key_Delete)
    view = editor.session.active_view
    # The best cubic over half a circle with these directions is 0.0133 off.
    assert distance(before, view) == pytest.approx(0.0133, abs=3e-4)
    said = "Deleted 1 point. The shape changed by up to 0.013 mm; Ctrl+Del keeps the handles instead."
    assert editor.status == said
    assert [kind_at(view, index) for index in (0, 1)] == [SMOOTH] * 2
    # Quarters are 0.0003 off: what was not touched is the same.
    assert [distance_of(view, each) < 1e-3 for each in range(3)] == [False, True, True]
    editor.trigger("undo")
    editor.select([1])
    editor.key(Qt.Key.Key_Delete, CTRL)
    assert distance(before, editor.session.active_view) > 0.4
    assert len(editor.curve.points) == 3


def distance_of(view, segment):
    """How far a segment is from the circle."""
    start, end = view.parameters[segment : segment + 2]
    places = view.curve.evaluate(np.linspace(start, end, 65))
    return np.abs(np.hypot(*places.T) - 1).max()


def test_the_segment_in_place_of_a_zigzag_has_no_fold(editor):
    """The best fit had handles of 275 and 363 pixels across each other: it went back on its way."""
    zigzag = [(0, 0), (1, 1.5), (2, 0), (3, 1.5), (4, 0), (5, 1.5), (6, 0)]
    editor.session.commit(Document((make_curve(zigzag, family=HERMITE),)), "Begin")
    editor.fit()
    editor.select(range(7))
    editor.key(Qt.Key.Key_S, Qt.KeyboardModifier.ShiftModifier)
    for gone in ([4], [2, 3, 4]):
        before = editor.session.active_view
        editor.select(gone)
        editor.key(Qt.Key.Key_Delete)
        after = editor.session.active_view
        assert (np.diff(sampled(after, 2000)[:, 0]) > 0).all()
        # The zigzag is as high.
        assert distance(before, after) < 1.5
        editor.trigger("undo")


def test_deleting_points_keeps_lines_straight_and_estimates_estimated(editor):
    editor.new()
    editor.choose_family(HERMITE)
    editor.trigger("addTool")
    for place in [(0, 0), (1, 0.2), (2, 0), (2, 2), (0, 2)]:
        editor.click(place, keys=Qt.KeyboardModifier.AltModifier)
    editor.trigger("selectTool")
    editor.select([1])
    editor.key(Qt.Key.Key_Backspace)
    assert [is_straight(editor.curve, segment) for segment in range(3)] == [True] * 3
    smooth = make_curve([(0, 0), (1, 1), (2, 0), (3, 1)], family=HERMITE)
    editor.session.commit(Document((smooth,)), "Begin")
    editor.select([1])
    editor.key(Qt.Key.Key_Delete)
    assert not editor.curve.has_derivatives


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("F7", "F7 keeps the handles instead."),
        ("", "“Delete, Leaving the Handles” keeps the handles instead."),
    ],
)
def test_the_hint_after_deletion_names_the_assigned_key(editor, keys, said):
    editor.session.commit(Document((circle(4),), unit="mm"), "Begin")
    keymap = editor.window.context.actions.keymap
    keymap.assign("deleteLeavingHandles", [QKeySequence(keys)] if keys else [])
    editor.select([1])
    editor.key(Qt.Key.Key_Delete)
    keymap.reset("deleteLeavingHandles")
    assert editor.status.endswith(said)
