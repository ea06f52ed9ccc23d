"""Derivatives that were all set, as in drawings, need no estimates."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

import curvecore
from app.document.model import Point, make_curve
from app.families import HERMITE
from app.view_model.curve.curve_view import view_of
from tests.effort import noted_calls


def path(without: int = -1):
    """Four corners with velocities on both sides, but for one after a point."""
    corners = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, 0.0)]
    points = tuple(
        Point(x, y, corner=True, velocity=(1.0, 0.5), velocity_after=None if at == without else (2.0, -1.0))
        for at, (x, y) in enumerate(corners)
    )
    return replace(make_curve(corners, name="Path", family=HERMITE), points=points)


@pytest.mark.parametrize(("without", "asked"), [(-1, 0), (1, 1)])
def test_only_stretches_that_lack_a_derivative_are_estimated(monkeypatch, without, asked):
    """Of a map of 3,000 paths it was two thirds of the time that it took to make the curves."""
    calls = noted_calls(monkeypatch, curvecore, "natural_spline_velocities")
    curve = view_of(path(without)).curve
    assert len(calls) == asked
    t = curve.parameters
    step = 1e-9 * (t[-1] - t[0])
    assert np.allclose(curve.evaluate(t[:1], 1), [[2.0, -1.0]])
    assert np.allclose(curve.evaluate(t[2:3] + step, 1), [[2.0, -1.0]], atol=1e-5)
    assert np.allclose(curve.evaluate(t[2:3] - step, 1), [[1.0, 0.5]], atol=1e-5)
