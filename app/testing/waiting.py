"""Waiting for a window, in event loops that end.

Qt keeps a flag once the application has been told to quit (`QApplication.exit`) and no `QApplication.exec` is
there to take it: every later event loop of the thread ends at once. Whoever goes on waiting then handles no
event; so whatever waits here raises `ApplicationQuitError`.
"""

from __future__ import annotations

import time

from PySide6.QtCore import QEventLoop, QMetaObject, Qt, QTimer
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from .reach import named

WAIT_S = 60.0
"""Seconds after which something is taken to hang: many times what the slowest machine needs."""

SHORT_MS = 300
"""Milliseconds of the slowest timer of what follows the hand at a pace of its own."""


class ApplicationQuitError(RuntimeError):
    """The application was asked to quit: event loops end at once, and nothing can be waited for."""

    def __init__(self) -> None:
        super().__init__(
            "The application was asked to quit: every event loop ends at once, so no wait is possible. "
            "Find the call of QApplication.quit or exit (maybe by a timer of an earlier test). "
            "A QApplication.exec() in which exit(0) is called lets loops run again."
        )


def deliver_events() -> None:
    """Deliver pending events, as an event loop does.

    Raises
    ------
    ApplicationQuitError
        If no event loop runs any more.
    """
    loop = QEventLoop()
    QMetaObject.invokeMethod(loop, "quit", Qt.ConnectionType.QueuedConnection)
    if loop.exec() == -1:
        raise ApplicationQuitError


def spin(milliseconds: int) -> None:
    """Run an event loop for a while, so that background work goes on.

    QTest.qWait keeps the interpreter to itself while it waits.

    Raises
    ------
    ApplicationQuitError
        If the application is told to quit meanwhile, or was before.
    """
    loop = QEventLoop()
    timer = QTimer(singleShot=True, timerType=Qt.TimerType.PreciseTimer)
    timer.timeout.connect(loop.quit)
    timer.start(milliseconds)
    try:
        loop.exec()
        if timer.isActive():
            raise ApplicationQuitError
    finally:
        timer.stop()


def wait_until_visible(widget: QWidget) -> None:
    """Wait until a widget that opens a little later is there, such as a submenu.

    Raises
    ------
    TimeoutError
        If it does not open within `WAIT_S` seconds.
    ApplicationQuitError
        If no event loop runs any more.
    """
    deadline = time.monotonic() + WAIT_S
    while not widget.isVisible():
        if time.monotonic() > deadline:
            raise TimeoutError(f"{named(widget)} does not open within {WAIT_S:g} s.")
        spin(1)


def wait_for_rest(widget: QWidget, *, up_to_ms: int = SHORT_MS) -> None:
    """Wait for delayed updates: numbers, panels, the table, discs.

    The clock is not waited for: single-shot timers of this pace or quicker fire at once, in their order,
    until none is left. What has a slower pace is left alone.

    Raises
    ------
    TimeoutError
        If the window is not idle within `WAIT_S` seconds.
    ApplicationQuitError
        If no event loop runs any more.
    """
    deadline = time.monotonic() + WAIT_S
    while timers := _short_timers(widget, up_to_ms):
        if time.monotonic() > deadline:
            raise TimeoutError(f"The window is not idle within {WAIT_S:g} s.")
        for timer in timers:
            # A timer may be deleted or stopped by another one.
            if isValid(timer) and timer.isActive():
                timer.stop()
                timer.timeout.emit()
        deliver_events()


def _short_timers(widget: QWidget, up_to_ms: int) -> list[QTimer]:
    """Return the single-shot timers of a quick pace that run now, the next one first."""
    timers = [
        timer
        for timer in widget.findChildren(QTimer)
        if timer.isActive() and timer.isSingleShot() and timer.interval() <= up_to_ms
    ]
    return sorted(timers, key=QTimer.remainingTime)
