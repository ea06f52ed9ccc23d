"""Bounds of curves by brute force: a hundred thousand places of each."""

from __future__ import annotations

import numpy as np

CLOSE = 1e-7
"""By how much the sampled bounds of the curves of these tests may be off: |c''| Δt² / 8 < 1e-8."""


def sampled_bounds(editor, *places):
    """Return lower left and upper right corner of some curves, (2, 2); by default of the one edited."""
    views = editor.session.views
    curves = [views[place].curve for place in places or (editor.session.active_index,)]
    reached = np.vstack([curve.evaluate(np.linspace(*curve.domain, 100_001)) for curve in curves])
    return np.array([reached.min(axis=0), reached.max(axis=0)])


def box_shown(editor):
    """Return lower left and upper right corner of the box on the canvas, (2, 2)."""
    box = editor.window.canvas.marks.box
    return np.array([box.low, box.high])
