"""Twenty thousand drags leave the memory as it was.

python -m pytest tests/bench/bench_soak.py
"""

from __future__ import annotations

import gc
from pathlib import Path

import targets
from harness import send
from PySide6.QtCore import QEvent, QPointF
from PySide6.QtWidgets import QApplication

from app.session import Session
from app.testing import Editor

DRAGS, WARM = 20_000, 4_000


def resident() -> float:
    """Return the megabytes that this process holds now."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096 / 2**20


def test_soak(qtbot):
    session = Session()
    editor = Editor(qtbot, session, size=(1000, 600))
    canvas = editor.window.canvas
    viewport = canvas.viewport()
    before = 0.0
    for number in range(DRAGS):
        if number == WARM:
            before = resident()
        index = number % len(editor.curve.points)
        place = QPointF(canvas.to_pixel(*editor.point(index)))
        way = QPointF(12 if number % 2 else -12, 9 if number // len(editor.curve.points) % 2 else -9)
        send(viewport, QEvent.Type.MouseButtonPress, place, held=True)
        send(viewport, QEvent.Type.MouseMove, place + way / 2, held=True)
        send(viewport, QEvent.Type.MouseMove, place + way, held=True)
        QApplication.processEvents()
        send(viewport, QEvent.Type.MouseButtonRelease, place + way, held=False)
        # As a person would, now and then: take everything back, so that the history does not grow for ever.
        if number % 50 == 49:
            session.undo_stack.clear()
    assert targets.at_most(f"memory after {DRAGS - WARM} more drags, growth", resident() - before, 8, "MB")
