"""Fits of few points near many rows with errors, beside SciPy's smoothing spline of the same rows.

    python -m pytest tests/bench/bench_fits.py -s

SciPy's has one pass at parameters that it is given, in Fortran; here these are found, too, the number of
points is searched, and the largest deviation is kept, not the mean square.
"""

from __future__ import annotations

from time import process_time

import numpy as np
import pytest
import targets
from scipy.interpolate import splprep

from app.families import FAMILIES
from curvecore import fit

MOST = 100.0
"""Times SciPy's processor time; before the rounds were cut it was 70 to 1000, and more than a minute."""

T = np.linspace(0.0, 1.0, 10_000)
ROWS = np.stack([10.0 * T, np.sin(6.0 * np.pi * T) * (1.0 + T)], axis=1)
ROWS += 0.01 * np.random.default_rng(1).normal(size=ROWS.shape)


@pytest.mark.parametrize("tolerance", [0.036, 0.02])
@pytest.mark.parametrize("family", FAMILIES, ids=str)
def test_ten_thousand_rows_near_their_errors(family, tolerance):
    ours, peer = [], []
    for _ in range(3):
        began = process_time()
        splprep(ROWS.T, u=T, s=2.02)
        peer.append(process_time() - began)
        began = process_time()
        found = fit(ROWS, family.curve_class, tolerance=tolerance)
        ours.append(process_time() - began)
    assert found.deviation <= tolerance or found.is_scattered
    name = f"fit of 10,000 rows within {tolerance:g}, {family.title}"
    assert targets.at_most(name, min(ours) / min(peer), MOST, "times")
