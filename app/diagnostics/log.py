"""Log: loggers by subsystem, the last lines in memory, and all lines on standard error on request.

A module writes to the logger ``curvebench.PACKAGE``. The log contains kinds, counts, sizes, durations and
codes of errors; never names of files or curves, coordinates, texts of the person, or messages of exceptions,
which may contain any of these. Nothing is logged for a frame of a drag. Log records are kept for a while, so
their arguments must be numbers and texts, not objects such as locks.
"""

from __future__ import annotations

import logging
import sys
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager

NAME = "curvebench"
LEVELS = ("DEBUG", "INFO", "WARNING", "ERROR")
USUAL_LEVEL = "INFO"

LAST_LINES = 100
"""Number of lines that are kept, and that a crash report contains."""

FORMAT = logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s")


class LastLines(logging.Handler):
    """Log handler that keeps the last lines in memory."""

    def __init__(self) -> None:
        super().__init__()
        self.lines: deque[str] = deque(maxlen=LAST_LINES)
        self.setFormatter(FORMAT)

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a line."""
        self.lines.append(self.format(record))


_last = LastLines()


def last_lines() -> tuple[str, ...]:
    """Return the last lines of the log, the oldest first."""
    return tuple(_last.lines)


@contextmanager
def logged(level: str = "") -> Iterator[None]:
    """Keep a log in memory during a ``with`` block; with a `level`, also on standard error."""
    logger, before = logging.getLogger(NAME), logging.getLogger(NAME).level
    handlers: list[logging.Handler] = [_last]
    if level and sys.stderr is not None:
        handlers.append(logging.StreamHandler())
        handlers[-1].setFormatter(FORMAT)
    logger.setLevel(level or USUAL_LEVEL)
    for handler in handlers:
        logger.addHandler(handler)
    try:
        yield
    finally:
        for handler in handlers:
            logger.removeHandler(handler)
        logger.setLevel(before)
