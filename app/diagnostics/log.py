"""The log: loggers by subsystem, the last lines in memory, and on standard error where they are asked for.

A module writes to the logger ``curvebench.PACKAGE``. The log tells kinds, counts, sizes, durations and codes
of errors: no name of a file or of a curve, no number of a point, no text of the person; a sentence that an
exception brings along may hold any of them. Nothing is logged for a frame of a drag. What is logged is kept
for a while, so arguments are numbers and texts: a lock would else be held.
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
"""Lines that are kept, and that a crash report brings along."""

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
    """Have a log meanwhile, in memory; on standard error too where a `level` is asked for."""
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
