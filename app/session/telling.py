"""What a session does, told as a whole to those who show all that there is."""

from __future__ import annotations

from collections.abc import Callable


class Telling:
    """Whether a session is about to tell more of what it does.

    A step changes the document, what is selected and the history, and each has a signal of its own. Who shows
    all of them together, at every one of these, would show the same several times, and what never was in
    between: it waits for the end.
    """

    def __init__(self) -> None:
        self._depth = 0
        self._waiting: dict[Callable[[], object], None] = {}

    def __bool__(self) -> bool:
        return self._depth > 0

    def __enter__(self) -> None:
        self._depth += 1

    def __exit__(self, *_raised: object) -> None:
        self._depth -= 1
        while self._waiting and not self:
            show = next(iter(self._waiting))
            # First: what it shows may change something once more.
            del self._waiting[show]
            show()

    def then(self, show: Callable[[], object]) -> None:
        """Call `show` when all is told, once; right now, where nothing is being told."""
        if self:
            self._waiting[show] = None
        else:
            show()
