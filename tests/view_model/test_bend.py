"""A pull of any length beside the size of the curve ends in few steps."""

import math

import numpy as np
import pytest

from app.view_model.bend import QuadraticCost, divided


@pytest.mark.parametrize("size", [1.0, 1e-300, 5e-324])
def test_a_pull_of_any_length_is_divided_in_few_steps(size):
    """Far beyond every number the stages went on for ever, and took all memory: inf / 3 is inf."""
    asked = []

    def answer(bend):
        asked.append(bend)
        return bend

    pull = np.array([3e11, 4e11])
    shares = divided(answer, pull, QuadraticCost(1.0, 0.5, 3), size, np.eye(2))
    assert len(asked) <= 41 * 8
    assert math.isfinite(float(np.hypot(*shares.bend)))
    # Bend and shift together meet the pull, whatever each does.
    assert shares.bend + shares.shift == pytest.approx(pull, rel=1e-12)
