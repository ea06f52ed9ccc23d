"""Files to be imported one after the other: the next is asked about when this one has been answered."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec


class SeriesPosition(msgspec.Struct, frozen=True):
    """Number of a file in a series of imports, from 1, and the count of files."""

    number: int = 1
    count: int = 1

    @property
    def waiting(self) -> int:
        """Number of files that come after it."""
        return self.count - self.number


class ImportSeries:
    """Files that are imported one after the other.

    Parameters
    ----------
    begin
        Begins the import of a file; it ends with a call of `end`, whatever its outcome.
    is_free
        Whether a file can be read now.
    warn
        Shows a warning about files that could not be imported.

    Attributes
    ----------
    changed
        Called with the new position when files are added during the dialog of another.
    """

    def __init__(
        self, begin: Callable[[Path], None], is_free: Callable[[], bool], warn: Callable[[str], None]
    ) -> None:
        self._begin, self._is_free, self._warn = begin, is_free, warn
        self._now: Path | None = None
        self._waiting: list[Path] = []
        self._number = 0
        self._problems: list[str] = []
        self.changed: Callable[[SeriesPosition], object] | None = None

    @property
    def is_busy(self) -> bool:
        """Whether a file is being imported, or waits."""
        return self._now is not None or bool(self._waiting)

    @property
    def position(self) -> SeriesPosition:
        """Position of the file that is being imported."""
        return SeriesPosition(self._number, self._number + len(self._waiting))

    def add(self, paths: Iterable[Path]) -> None:
        """Import files after those that wait."""
        self._waiting += paths
        if self.changed is not None:
            self.changed(self.position)
        self.go_on()

    def go_on(self) -> None:
        """Begin the next file, if it can be read now."""
        if self._now is None and self._waiting and self._is_free():
            self._now = self._waiting.pop(0)
            self._number += 1
            self._begin(self._now)

    def end(self, problem: str = "") -> None:
        """Go on with the next file; `problem` is the reason why this one was not imported."""
        self._now = None
        self._problems += [problem] if problem else []
        if self._problems:
            # All of them each time, as an import removes the sentence.
            self._warn(" ".join(self._problems))
        if not self._waiting:
            self._number, self._problems = 0, []
        self.go_on()

    def skip_rest(self) -> list[str]:
        """Forget the files that wait; return their names, after that of the current file."""
        left = [path.name for path in (self._now, *self._waiting) if path is not None]
        self._waiting.clear()
        return left
