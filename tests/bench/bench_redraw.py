"""Live redraw: from the mouse move to the end of painting, beside matplotlib with SciPy in the same run.

    python -m pytest tests/bench/bench_redraw.py -s

Prints one line a case. The bounds are those of the project's targets on two ordinary cores; the ratios to
the peer hold on any machine.
"""

from __future__ import annotations

import gc

import numpy as np
import pytest
from harness import Paints, Times, drag
from PySide6.QtCore import QPointF

from app.document.model import Curve, Document, Family, Node, Parametrization, ParametrizationKind
from app.session import Session
from app.testing import Editor

SIZE = (1200, 600)


def document(n: int, family: Family, kind: ParametrizationKind) -> Document:
    """A wave of n points; at Chebyshev points for Lagrange, the only sane choice for many."""
    s = np.linspace(0, 1, n)
    if family is Family.LAGRANGE:
        s = (1 - np.cos(np.pi * s)) / 2
    x, y = 4 * s, 1 + 0.7 * np.sin(14 * s)
    nodes = tuple(Node(float(a), float(b)) for a, b in zip(x, y, strict=True))
    return Document((Curve("Wave", family, Parametrization(kind), nodes),))


@pytest.fixture
def open_wave(qtbot, tmp_path):
    """Open the editor on a wave."""

    def open_wave(n: int, family: Family, kind: ParametrizationKind) -> Editor:
        session = Session()
        editor = Editor(qtbot, session, size=SIZE)
        session.commit(document(n, family, kind), "Open")
        editor.fit()
        gc.collect()
        return editor

    return open_wave


def counted(editor: Editor) -> Paints:
    """Count the paints of both plots."""
    paints = Paints()
    editor.window.canvas.painted.connect(paints.counter("canvas"))
    editor.window.basis_panel.painted.connect(paints.counter("basis"))
    return paints


def drag_point(editor: Editor, awaited: list[str]) -> Times:
    """Drag the point in the middle."""
    # The handles of a selected point would lie in the way.
    editor.select([])
    canvas = editor.window.canvas
    place = QPointF(canvas.to_pixel(*editor.point(len(editor.curve.nodes) // 2)))
    return drag(canvas.viewport(), place, counted(editor), awaited)


def drag_tick(editor: Editor) -> Times:
    """Drag the parameter in the middle, so that every basis function changes."""
    panel = editor.window.basis_panel
    place = panel.rail_pixel(editor.parameters[len(editor.curve.nodes) // 2])
    return drag(panel.viewport(), place, counted(editor), ["canvas", "basis"], horizontal=True, reach=10)


@pytest.mark.parametrize(
    ("n", "family", "kind", "bound"),
    [
        (5, Family.LAGRANGE, ParametrizationKind.CHEBYSHEV, 6),
        (20, Family.LAGRANGE, ParametrizationKind.CHEBYSHEV, 6),
        (20, Family.HERMITE, ParametrizationKind.UNIFORM, 6),
        (20, Family.QUINTIC_HERMITE, ParametrizationKind.UNIFORM, 6),
        (100, Family.HERMITE, ParametrizationKind.UNIFORM, None),
        (1000, Family.HERMITE, ParametrizationKind.UNIFORM, None),
    ],
)
def test_a_point_dragged_at_frozen_parameters(open_wave, n, family, kind, bound):
    times = drag_point(open_wave(n, family, kind), ["canvas"])
    print(f"\npoint, {family} n = {n}: {times}")
    assert bound is None or times.median < bound


@pytest.mark.parametrize("family", [Family.HERMITE, Family.QUINTIC_HERMITE])
def test_a_point_dragged_under_chord_length(open_wave, family):
    """The parameters follow the points, so canvas and basis panel both change."""
    times = drag_point(open_wave(20, family, ParametrizationKind.CHORD_LENGTH), ["canvas", "basis"])
    print(f"\npoint, {family} n = 20, chord length: {times}")
    assert times.median < 6


@pytest.mark.parametrize("family", list(Family))
def test_a_parameter_dragged(open_wave, family):
    kind = ParametrizationKind.CHEBYSHEV if family is Family.LAGRANGE else ParametrizationKind.UNIFORM
    times = drag_tick(open_wave(20, family, kind))
    print(f"\nparameter, {family} n = 20: {times}")
    assert times.median < 6


@pytest.mark.parametrize("mode", ["naive", "blit"])
def test_faster_than_matplotlib_with_scipy(open_wave, qtbot, mode):
    from peer_matplotlib import drag_in_matplotlib

    ours = drag_point(open_wave(20, Family.LAGRANGE, ParametrizationKind.CHEBYSHEV), ["canvas"])
    peer = drag_in_matplotlib(qtbot, 20, mode=mode)
    ratio = peer.median / ours.median
    print(f"\nn = 20: Curvebench {ours}; matplotlib + SciPy, {mode}: {peer}; {ratio:.1f} times")
    assert peer.median > (5 if mode == "naive" else 1) * ours.median
