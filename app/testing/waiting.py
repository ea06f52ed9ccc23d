"""Waiting for a window, in event loops that end.

Qt keeps a flag once the application has been told to quit (`QApplication.exit`) and no `QApplication.exec` is
there to take it: every later event loop of the thread ends at once. Whoever goes on waiting then handles no
event; so `spin`, `wait_for_rest` and `deliver_events` raise `ApplicationQuitError`.
"""

from __future__ import annotations

import time

from PySide6.QtCore import QEventLoop, QMetaObject, Qt, QTimer
from PySide6.QtWidgets import QWidget

WAIT_S = 60.0
"""Seconds after which something is taken to hang: many times what the slowest machine needs."""

SHORT_MS = 300
"""Milliseconds of the slowest timer that is waited for: what follows the hand at a pace of its own."""


class ApplicationQuitError(RuntimeError):
    """The application was told to quit: event loops end at once, and nothing can be waited for."""

    def __init__(self) -> None:
        super().__init__(
            "The application was told to quit: every event loop ends at once, and nothing can be waited for. "
            "Find the call of QApplication.quit or exit (maybe by a timer of an earlier test). "
            "A QApplication.exec() in which exit(0) is called lets loops run again."
        )


def deliver_events() -> None:
    """Let Qt deliver what is pending, as an event loop does.

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
    """Let the window's events come and go for a while, and what is computed beside it get on.

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


def wait_for_rest(widget: QWidget, *, up_to_ms: int = SHORT_MS) -> None:
    """Wait until what follows the hand at a pace of its own has caught up: numbers, panels, the table, discs.

    What has a slower pace than `up_to_ms` is not waited for.

    Raises
    ------
    TimeoutError
        If it does not within `WAIT_S` seconds.
    ApplicationQuitError
        If no event loop runs any more.
    """
    deadline = time.monotonic() + WAIT_S
    while (milliseconds := _milliseconds_to_rest(widget, up_to_ms)) is not None:
        if time.monotonic() > deadline:
            raise TimeoutError(f"The window does not come to rest within {WAIT_S:g} s.")
        spin(max(milliseconds, 1))


def _milliseconds_to_rest(widget: QWidget, up_to_ms: int) -> int | None:
    """Return when the last single-shot timer of a quick pace is due that runs now; None if there is none.

    The timers are found anew each time: one may go with the widget that it belongs to.
    """
    return max(
        (
            timer.remainingTime()
            for timer in widget.findChildren(QTimer)
            if timer.isActive() and timer.isSingleShot() and timer.interval() <= up_to_ms
        ),
        default=None,
    )
