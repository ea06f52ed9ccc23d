"""Labels that would overlap are stacked."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from PySide6.QtCore import QRectF

from app.plotting.text import clear_of


def test_overlapping_labels_are_moved_apart():
    """At the upper edge, where a bottom is rounded to lie below a top again, it went on for ever."""
    rng = np.random.default_rng(11)
    for _ in range(500):
        height = rng.uniform(8.0, 30.0)
        placed: list[QRectF] = []
        for left, top in rng.uniform((0.0, -30.0), (20.0, 30.0), (8, 2)):
            plate = QRectF(left, top, rng.uniform(20.0, 60.0), height)
            there = clear_of(placed, plate)
            assert (there.left(), there.size()) == (plate.left(), plate.size())
            assert there == plate or any(plate.intersects(each) for each in placed)
            placed.append(there)
        assert not any(one.intersects(other) for one, other in combinations(placed, 2))


def test_a_label_without_overlap_stays():
    plate = QRectF(0.0, 0.0, 10.0, 5.0)
    assert clear_of([QRectF(0.0, 5.0, 10.0, 5.0), QRectF(10.0, 0.0, 5.0, 5.0)], plate) == plate
    assert clear_of([QRectF(0.0, 1.0, 10.0, 5.0)], plate).bottom() == 0.0
