"""Many curves in one document: what the others cost while one of them is dragged.

    python -m pytest tests/bench/bench_curves.py -s

The bound is that of the project's targets: as one curve alone plus at most 2 ms.
"""

from __future__ import annotations

import numpy as np
import pytest
from harness import Paints, Times, drag
from PySide6.QtCore import QPointF

from app.document.model import Document, Family, make_curve
from app.session import Session
from app.testing import Editor

MOST = 2.0


def document(count: int) -> Document:
    """Waves of 20 points, one above the other."""
    x = np.linspace(0, 4, 20)
    return Document(
        tuple(
            make_curve(
                np.column_stack([x, 0.02 * level + 0.7 * np.sin(3.5 * x + level)]),
                name=f"Curve {level}",
                family=Family.HERMITE,
            )
            for level in range(count)
        )
    )


def times(qtbot, count: int, shown: str) -> Times:
    """Drag a point of the first of `count` curves, with this dock in front."""
    session = Session()
    editor = Editor(qtbot, session, size=(1200, 900))
    session.commit(document(count), "Open")
    editor.show_dock(shown)
    editor.fit()
    editor.trigger("freezeParameters")
    paints = Paints()
    canvas = editor.window.canvas
    canvas.painted.connect(paints.counter("canvas"))
    start = QPointF(canvas.to_pixel(*editor.point(10)))
    found = drag(canvas.viewport(), start, paints, ["canvas"])
    editor.window.hide()
    return found


@pytest.mark.parametrize("shown", ["curveDock", "curvesDock"])
def test_a_hundred_curves_cost_little_more_than_one(qtbot, shown):
    one, hundred = times(qtbot, 1, shown), times(qtbot, 100, shown)
    print(f"\n1 curve: {one}   100 curves: {hundred}   {shown}")
    assert hundred.median <= one.median + MOST
