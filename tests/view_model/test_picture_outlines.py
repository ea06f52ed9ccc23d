"""Dark and light told apart, and outlines as few pieces."""

from __future__ import annotations

import numpy as np
import pytest

from app.view_model.fitting.outline_fit import fitted_outline
from app.view_model.fitting.picture_outlines import LEVELS, dark_outlines, parting_brightness


@pytest.mark.parametrize("seed", range(5))
def test_the_parting_brightness_differs_most_between_both_sides(seed):
    rng = np.random.default_rng(seed)
    dark, light = rng.normal(0.25, 0.08, 3000), rng.normal(0.7, 0.1, 5000)
    levels = np.clip(np.concatenate([dark, light]), 0.0, 1.0 - 1e-9)
    found = parting_brightness(levels.reshape(80, 100))
    # By definition, one limit after the other, with the levels as they are counted.
    counted = (np.floor(levels * LEVELS) + 0.5) / LEVELS
    between = {}
    for limit in np.arange(1, LEVELS) / LEVELS:
        below = counted[counted < limit]
        above = counted[counted >= limit]
        if len(below) and len(above):
            between[limit] = len(below) * len(above) * (below.mean() - above.mean()) ** 2
    assert between[found] == pytest.approx(max(between.values()), rel=1e-9)


def test_two_levels_are_parted_half_way():
    brightness = np.full((10, 10), 0.9)
    brightness[3:6] = 0.1
    assert parting_brightness(brightness) == pytest.approx(0.5, abs=1.0 / LEVELS)


def test_what_reaches_the_edge_of_the_picture_is_closed_there():
    (outline,) = dark_outlines(np.zeros((30, 50)), 0.5, 4.0)
    low, high = outline.min(axis=0), outline.max(axis=0)
    assert np.abs(np.append(low, high) - [0.0, 0.0, 50.0, 30.0]).max() <= 0.5
    assert fitted_outline(outline, 0.4).shape == (4, 4, 2)


def test_specks_are_left_out():
    brightness = np.ones((40, 40))
    brightness[10, 10] = 0.0
    brightness[20:30, 20:30] = 0.0
    assert len(dark_outlines(brightness, 0.5, 4.0)) == 1


def test_pieces_close_and_stay_near_the_outline():
    angle = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    radius = 60.0 + 12.0 * np.cos(3.0 * angle)
    outline = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    pieces = fitted_outline(outline, 0.4)
    assert (pieces[1:, 0] == pieces[:-1, 3]).all()
    assert (pieces[0, 0] == pieces[-1, 3]).all()
    s = np.linspace(0, 1, 200)[:, None]
    weights = np.stack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s * s * (1 - s), s**3])
    drawn = np.einsum("wmo,kwd->kmd", weights, pieces).reshape(-1, 2)
    angles = np.arctan2(drawn[:, 1], drawn[:, 0])
    # Along the radius an error of 0.4 across counts for no more than 1.2 times as much.
    assert np.abs(np.hypot(*drawn.T) - (60.0 + 12.0 * np.cos(3.0 * angles))).max() < 0.5
    assert len(pieces) <= 12


def test_a_long_outline_can_be_given_up_in_the_middle():
    angle = np.linspace(0.0, 2.0 * np.pi, 3000, endpoint=False)
    radius = 400.0 + 40.0 * np.cos(7.0 * angle) + 9.0 * np.sin(23.0 * angle)
    outline = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)

    def stop():
        raise InterruptedError

    with pytest.raises(InterruptedError):
        fitted_outline(outline, 0.4, stop)
