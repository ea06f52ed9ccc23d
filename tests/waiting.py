"""Waiting for conditions, with the one limit of the suite: no test asks how long anything takes."""

from __future__ import annotations

import time
from collections.abc import Callable

# Seconds. Only a test that is going to fail waits this long, on the busiest machine.
LIMIT = 60.0
LIMIT_MS = int(1000 * LIMIT)


def until(condition: Callable[[], object]) -> None:
    """Let the windows' events come and go until `condition` holds.

    Raises
    ------
    TimeoutError
        If it does not within the limit.
    """
    from app.testing import spin

    deadline = time.monotonic() + LIMIT
    while not condition():
        if time.monotonic() > deadline:
            raise TimeoutError(f"The condition does not hold within {LIMIT:g} s.")
        spin(2)
