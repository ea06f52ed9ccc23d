"""Estimates live beside what is set: they follow drags of handles, of points and of parameters."""

from __future__ import annotations

import numpy as np
import pytest

from app.document.model import Document, make_curve
from app.families import HERMITE, QUINTIC_HERMITE

POINTS = ((0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.5), (6.0, 0.0), (7.0, 2.0), (9.0, 1.0))


@pytest.fixture
def seven(editor):
    """A Hermite curve of seven points, nothing set."""
    editor.session.change("Begin", lambda _document: Document((make_curve(POINTS, family=HERMITE),)))
    editor.window.resize(1440, 900)
    editor.fit()
    return editor


def jumps(editor):
    """The jumps of c'' at the inner joints, as shares of the largest c'', (k,)."""
    curve = editor.session.active_view.curve
    before, after = (curve.joint_derivatives(before=side).values[:, 2] for side in (True, False))
    return np.linalg.norm(after[1:] - before[:-1], axis=1) / np.abs(after).max()


def velocities(editor):
    return np.array([editor.session.active_view.velocity_of(index) for index in range(7)])


def explicit(editor):
    return [index for index, point in enumerate(editor.curve.points) if point.velocity is not None]


def test_neighbours_follow_a_handle_and_curvature_stays_continuous_beside_it(seven):
    """Curvature jumped at both neighbours of a handle that was set, for their estimates ignored it."""
    seven.select_point(3)
    at_rest, x, y = velocities(seven), *seven.handle().position
    seven.press((x, y))
    for step in (0.1, 0.2, 0.4):
        # Live: at every move.
        seven.move((x + step, y + step))
        seven.settle()
        moved = np.linalg.norm(velocities(seven) - at_rest, axis=1)
        assert (moved > 0.0).all()
        # Each moves at most half as much as its neighbour towards the handle.
        assert (moved[3:-1] > 1.99 * moved[4:]).all()
        assert (moved[1:4] > 1.99 * moved[:3]).all()
    seven.release((x + 0.4, y + 0.4))
    assert explicit(seven) == [3]
    assert seven.handle().position == pytest.approx((x + 0.4, y + 0.4), abs=seven.pixel)
    assert jumps(seven)[2] > 0.1
    assert np.delete(jumps(seven), 2).max() < 1e-12
    seven.trigger("undo")
    assert velocities(seven) == pytest.approx(at_rest)


def test_neighbours_of_a_corner_follow_a_drag(seven):
    """All six other points were set when one became a corner: none followed any more."""
    before = seven.session.active_view.samples
    seven.select_point(3)
    seven.trigger("tangentCorner")
    assert explicit(seven) == [3]
    assert seven.session.active_view.samples == pytest.approx(before, abs=1e-12)
    for point, others in ((0, (1, 2)), (6, (4, 5))):
        at_rest = velocities(seven)
        x, y = seven.point(point)
        seven.drag_point(point, (x + 0.5, y + 0.7))
        moved = np.linalg.norm(velocities(seven) - at_rest, axis=1)
        assert (moved[list(others)] > 1e-3).all()
        assert np.delete(jumps(seven), 2).max() < 1e-12


def test_a_parameter_that_moves_takes_all_estimates_along(seven):
    seven.select_point(3)
    x, y = seven.handle().position
    seven.drag_handle((x + 0.3, y - 0.2))
    at_rest, t = velocities(seven), seven.parameters
    seven.drag_parameter(2, 0.5 * (t[2] + t[3]))
    moved = np.linalg.norm(velocities(seven) - at_rest, axis=1)
    assert (moved[:3] > 0.0).all()
    # The velocity that is set keeps them from the others.
    assert (moved[3:] == 0.0).all()
    assert np.delete(jumps(seven), 2).max() < 1e-12


def test_accelerations_of_a_quintic_follow_a_velocity_that_is_set(seven):
    seven.choose_family(QUINTIC_HERMITE)
    seven.select_point(3)
    accelerations = [seven.session.active_view.derivative_of(index, 2) for index in range(7)]
    x, y = seven.handle().position
    seven.drag_handle((x + 0.4, y + 0.4))
    view = seven.session.active_view
    after = [view.derivative_of(index, 2) for index in range(7)]
    moved = np.linalg.norm(np.subtract(after, accelerations), axis=1)
    assert (moved[1:6] > 1e-3).all()
    # The ends are free: they stay natural.
    assert moved[[0, 6]] == pytest.approx(0.0, abs=1e-12)
    assert jumps(seven).max() < 1e-12
