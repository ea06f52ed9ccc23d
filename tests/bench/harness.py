"""A synthetic drag with the time from each mouse move to the end of painting."""

from __future__ import annotations

import resource
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QEvent, QEventLoop, QPointF, Qt, QTimer
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QApplication, QWidget

_WARM, _MOVES = 20, 150
_PATIENCE = 5
_FEWEST = 30
"""Frames that must have been undisturbed for the others to be left out."""


class Paints:
    """Counts finished paints by name, and knows when each of them ended last."""

    def __init__(self) -> None:
        self.count: dict[str, int] = {}
        self.ended: dict[str, float] = {}

    def counter(self, name: str) -> Callable[[], None]:
        """Return what to call at the end of a paint."""
        self.count[name] = 0

        def painted() -> None:
            self.ended[name] = time.perf_counter()
            self.count[name] += 1

        return painted


@dataclass(frozen=True)
class Times:
    """Milliseconds per frame, of the frames in which no other program had the processor."""

    median: float
    p95: float

    def __str__(self) -> str:
        return f"median {self.median:6.2f} ms, p95 {self.p95:6.2f} ms"


def send(widget: QWidget, kind: QEvent.Type, place: QPointF, *, held: bool) -> None:
    """Send one mouse event with the left button."""
    nothing = Qt.MouseButton.NoButton
    button = nothing if kind == QEvent.Type.MouseMove else Qt.MouseButton.LeftButton
    buttons = Qt.MouseButton.LeftButton if held else nothing
    event = QMouseEvent(
        kind, place, widget.mapToGlobal(place), button, buttons, Qt.KeyboardModifier.NoModifier
    )
    QApplication.sendEvent(widget, event)


def pump(seconds: float) -> None:
    """Run the event loop."""
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        QApplication.processEvents()


def rest(until: float) -> None:
    """Run the event loop to a time, asleep while nothing is due: as between two moves of a mouse."""
    QApplication.processEvents()
    if (left := until - time.perf_counter()) > 0:
        loop, timer = QEventLoop(), QTimer(singleShot=True, timerType=Qt.TimerType.PreciseTimer)
        timer.timeout.connect(loop.quit)
        timer.start(round(1e3 * left))
        loop.exec()


def drag(
    widget: QWidget,
    start: QPointF,
    paints: Paints,
    awaited: Sequence[str],
    *,
    moves: int = _MOVES,
    horizontal: bool = False,
    reach: int = 40,
    pace: float = 0.0,
) -> Times:
    """Press at `start`, move, and time each move to the end of all awaited paints.

    The moves come back to back, or `pace` seconds apart, as from a mouse: what has rested is slower.
    """
    send(widget, QEvent.Type.MouseMove, start, held=False)
    send(widget, QEvent.Type.MouseButtonPress, start, held=True)
    # Past the threshold below which a press is still a click.
    send(widget, QEvent.Type.MouseMove, start + QPointF(6, 6), held=True)
    pump(0.1)
    seconds, preempted = [], []
    warm = min(_WARM, moves // 4)
    for step in range(warm + moves):
        # A triangle wave, in whole pixels, that never rests.
        away = abs((step + 6) % (2 * reach) - reach) - reach // 2
        place = start + (QPointF(away, 0) if horizontal else QPointF(step % 3 - 1, away))
        before, switches = dict(paints.count), _switches()
        began = time.perf_counter()
        send(widget, QEvent.Type.MouseMove, place, held=True)
        while any(paints.count[name] == before[name] for name in awaited):
            QApplication.processEvents()
            if time.perf_counter() - began > _PATIENCE:
                raise TimeoutError(f"no paint of {awaited} after a move")
        # What the event loop did after the paint, before it came back here, is not in the frame.
        seconds.append(max(paints.ended[name] for name in awaited) - began)
        preempted.append(_switches() > switches)
        rest(began + pace)
    send(widget, QEvent.Type.MouseButtonRelease, start, held=False)
    pump(0.05)
    milliseconds, calm = 1e3 * np.array(seconds[warm:]), ~np.array(preempted[warm:])
    if calm.sum() >= _FEWEST:
        milliseconds = milliseconds[calm]
    return Times(float(np.median(milliseconds)), float(np.percentile(milliseconds, 95)))


def _switches() -> int:
    """Return how often the system has taken the processor from this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_nivcsw
