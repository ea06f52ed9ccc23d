"""Numbers at the edge of what can be drawn: nothing is divided by zero, and what is asked for is seen."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.plot.layered_plot import GREATEST_SPAN
from app.plot.pixel_map import PixelMap


@pytest.fixture
def opened(editor):
    """Open curves in the editor, fitted; returns the editor."""

    def open_(*curves):
        editor.session.restore(Document(curves), None)
        editor.fit()
        editor.settle()
        return editor

    return open_


def uniform_wave(n):
    angle = np.linspace(0, 6, n)
    curve = make_curve(np.column_stack([angle, np.sin(angle)]).tolist())
    return replace(curve, parametrization=Parametrization(ParametrizationKind.UNIFORM))


@pytest.mark.parametrize("n", [40, 60, 100])
def test_wild_functions_are_fitted_about_zero_as_far_as_an_axis_reaches(opened, n):
    """At n = 60 the range was -4.1e13 to -3.1e13; at n = 100 it was empty, and every paint failed."""
    editor = opened(uniform_wave(n))
    pane, panel = editor.window.basis_pane, editor.window.basis_panel
    said = pane.extent_text
    pane._fit.click()
    editor.settle()
    _, low, _, high = panel.pixel_map.box
    least, greatest = panel.basis.extent({0})
    assert low < 0.0 < high
    assert high - low <= GREATEST_SPAN * (1 + 1e-9)
    if n > 60:
        assert (low, high) == pytest.approx((-0.6 * GREATEST_SPAN, 0.4 * GREATEST_SPAN), rel=0.2)
    if greatest < high:
        assert low < least
        assert pane.extent_text == ""
    else:
        assert pane.extent_text == said  # what they reach in truth
    assert not editor.screenshot().isNull()


@pytest.mark.parametrize("empty", [(1.0, 1.0), (2.0, 1.0), (1e25, 1e25 + 1e8), (0.0, float("nan"))])
def test_an_empty_range_has_no_map(empty):
    with pytest.raises(ValueError, match="shows nothing"):
        PixelMap.of_ranges(empty, (0.0, 1.0), 100, 100)
    with pytest.raises(ValueError, match="shows nothing"):
        PixelMap.of_ranges((0.0, 1.0), empty, 100, 100)
