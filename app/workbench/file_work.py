"""Background work of a window: reading and writing of files, and long computations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject

from ..document.limits import EditError
from ..exchange.errors import ExchangeError
from ..session import Session
from ..storage.files import StorageError
from ..storage.format_error import FormatError
from ..tasks.task import SingleTask, Work

WRITTEN = "written"
"""Word for the work that writes a file, in its errors."""

_MOST_REMARKS = 3
_EXPECTED = (ExchangeError, StorageError, FormatError)


class FileWork:
    """Background work for one window, one task at a time.

    Parameters
    ----------
    warn
        Shows why something was not done.

    Attributes
    ----------
    jobs
        What is being done.
    is_writing
        Whether the last work writes a file.
    """

    def __init__(self, session: Session, warn: Callable[[str], object], window: QObject) -> None:
        self._session, self._warning = session, warn
        self.jobs = SingleTask(window)
        self._stopped: Callable[[], object] = lambda: None
        self.is_writing = False

    def start(
        self,
        title: str,
        work: Work,
        done: Callable[[Any], object],
        path: Path,
        what: str,
        left: Callable[[str], object] | None = None,
    ) -> bool:
        """Start work for a file; errors are reported as “file was not `what`”.

        Where nothing comes of it, `left` is called with that sentence, or with an empty one where the person
        has stopped the work; by default the sentence is shown. Returns False, and does nothing but to say so,
        while there is other work.
        """
        leave = left or self._warn

        def failed(problem: Exception) -> None:
            if isinstance(problem, _EXPECTED):
                leave(why_not(path, what, problem))
                return
            leave("")
            raise problem

        if self.refuse_second():
            return False
        self._stopped, self.is_writing = lambda: leave(""), what == WRITTEN
        return self.jobs.start(title, work, done, failed)

    def compute(self, title: str, work: Work, done: Callable[[Any], object]) -> bool:
        """Start a computation for the document; an `EditError` is shown, and nothing changes.

        Returns False, and does nothing but to say so, while there is other work.
        """

        def failed(problem: Exception) -> None:
            if not isinstance(problem, EditError):
                raise problem
            self._session.refuse(str(problem))

        if self.refuse_second():
            return False
        self._stopped = lambda: None
        return self.jobs.start(title, work, done, failed)

    def refuse_second(self) -> bool:
        """Return whether a task is running, and say so."""
        if self.jobs.is_busy:
            self._session.refuse(f"{self.jobs.title} is still running. Stop it first.")
        return self.jobs.is_busy

    def refuse(self, path: Path, what: str, problem: Exception) -> None:
        """Show why something was not done with a file."""
        self._warn(why_not(path, what, problem))

    def warn_of(self, remarks: Sequence[str]) -> None:
        """Show remarks about omissions, at most three of them."""
        more = [f"And {len(remarks) - _MOST_REMARKS} more."] if len(remarks) > _MOST_REMARKS else []
        self._warn(" ".join([*remarks[:_MOST_REMARKS], *more]))

    def _warn(self, sentence: str) -> None:
        if sentence:
            self._warning(sentence)

    def cancel(self) -> None:
        """Stop the running task, and say so."""
        if self.jobs.is_busy:
            # Other work may begin as soon as this has ended.
            title, leave = self.jobs.title, self._stopped
            stopped = self.jobs.cancel()
            end = "was stopped. Nothing has changed" if stopped else "can no longer be stopped"
            self._session.say(f"{title} {end}.")
            if stopped:
                leave()


def why_not(path: Path, what: str, problem: Exception) -> str:
    """Return the sentence why something was not done with a file."""
    # Some errors are clauses; those of readers name the file already.
    reason = f"{str(problem).removesuffix('.')}."
    named = what == "imported" and path.name in reason
    return reason if named else f"{path.name} was not {what}. {reason}"
