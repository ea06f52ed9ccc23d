"""Bounds of curves by brute force: two thousand places of each, and as many again around the outermost."""

from __future__ import annotations

import numpy as np

CLOSE = 1e-7
"""What the sampled bounds of the curves of these tests may be off: |c''| Δt² / 8 < 1e-9, and rounding."""

_PLACES = 2001


def sampled_bounds(editor, *places):
    """Return lower left and upper right corner of some curves, (2, 2); by default of the one edited."""
    views = editor.session.views
    curves = [views[place].curve for place in places or (editor.session.active_index,)]
    reached = np.vstack([_outermost(curve) for curve in curves])
    return np.array([reached.min(axis=0), reached.max(axis=0)])


def _outermost(curve):
    """Return places of a curve, close together where a coordinate is least or greatest."""
    start, end = curve.domain
    t = np.linspace(start, end, _PLACES)
    reached = curve.evaluate(t)
    step = t[1] - t[0]
    turns = t[[*reached.argmin(axis=0), *reached.argmax(axis=0)]]
    near = [np.linspace(max(at - step, start), min(at + step, end), _PLACES) for at in turns]
    return np.vstack([reached, *(curve.evaluate(each) for each in near)])


def box_shown(editor):
    """Return lower left and upper right corner of the box on the canvas, (2, 2)."""
    box = editor.window.canvas.marks.box
    return np.array([box.low, box.high])
