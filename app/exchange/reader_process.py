"""A process of its own for the drawings of others, with a limit of processor time and memory.

A file can be made to keep a parser busy for hours, or to fill the memory; the process that reads it is
then ended, and the window goes on.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Self

import msgspec

from ..storage.coding import decode_hook
from ..tasks.processor_limit import longest_wait, was_overdue
from ..tasks.progress import Report, silent
from . import READER_PROCESS
from .cubics_in import ImportResult
from .errors import ExchangeError
from .reader_main import (
    ANSWER,
    MEMORY,
    NO_MEMORY,
    QUESTION,
    SECONDS,
    Reader,
    ReadRequest,
    ReadResponse,
    main,
    response_to,
)

SMALL = 2**16
SECONDS_PER_MB = 120.0
"""Seconds for every further 2**20 bytes: a file that makes a parser work for hours can be small, and an
honest large one takes its time, of short paths some 13 s. Whoever waits can cancel.
"""

_FIRST_POLL_S, _POLL_S = 0.001, 0.05
"""Seconds between two looks for an answer: small drawings are read in milliseconds."""

_START = f"import sys; sys.path[:] = sys.argv[2:]; from {main.__module__} import main; main(sys.argv[1])"


class ReaderProcess:
    """Child process that reads drawings, one after the other, each with limits.

    The process starts with the first drawing. One that reaches a limit ends it, and the next has another.
    A context manager: the process ends with it.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._request: ReadRequest | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_problem: object) -> None:
        self.end()

    def begin(
        self,
        reader: Reader,
        data: bytes,
        tolerance: float | None,
        *,
        seconds: float | None = None,
        memory: int = MEMORY,
    ) -> None:
        """Begin to read; `read` with the same arguments then waits for the rest only.

        Raises
        ------
        ExchangeError
            If the process cannot be started, or the content cannot be passed to it.
        """
        seconds = seconds_for(len(data)) if seconds is None else seconds
        request = ReadRequest(reader.__module__, reader.__name__, tolerance, data, memory, seconds)
        if request == self._request:
            return
        if self._request is not None or (self._process is not None and self._process.poll() is not None):
            self.end()
        process, folder = self._started()
        try:
            (folder / QUESTION).write_bytes(msgspec.msgpack.encode(request))
        except OSError as problem:
            raise _not_passed_on(problem) from None
        assert process.stdin is not None
        with contextlib.suppress(OSError):  # the process has ended: `read` reports why
            process.stdin.write(b"\n")
        self._request = request

    def read(
        self,
        reader: Reader,
        data: bytes,
        tolerance: float | None,
        *,
        seconds: float | None = None,
        memory: int = MEMORY,
        report: Report = silent,
    ) -> ImportResult:
        """Read the content of a file, and return the result of the reader.

        Parameters
        ----------
        reader
            A function at the top level of its module.
        data
            The content.
        tolerance
            See the reader.
        seconds, memory
            The limits, by default `seconds_for` the file and `MEMORY`; processor time, and bytes.
        report
            Called repeatedly; when it raises, the process is ended.

        Raises
        ------
        ExchangeError
            Errors of the reader, and limits that are reached.
        """
        self.begin(reader, data, tolerance, seconds=seconds, memory=memory)
        try:
            answer = msgspec.msgpack.decode(
                self._wait_for_answer(report), type=ReadResponse, dec_hook=decode_hook
            )
        except BaseException:
            self.end()
            raise
        self._request = None
        return _result_of(answer)

    def end(self) -> None:
        """End the process, whatever it does."""
        self._request = None
        if self._process is not None:
            with self._process as process:
                process.kill()
            self._process = None
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _started(self) -> tuple[subprocess.Popen[bytes], Path]:
        """Return the process, and the folder of its messages."""
        if self._folder is None:
            try:
                self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
            except OSError as problem:
                raise _not_passed_on(problem) from None
        if self._process is None:
            try:
                self._process = subprocess.Popen(
                    _command(self._folder.name),
                    bufsize=0,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    # One thread, as each reserves memory of its own.
                    env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                )
            except OSError as problem:
                raise ExchangeError(f"The reader could not be started ({problem.strerror}).") from None
        return self._process, Path(self._folder.name)

    def _wait_for_answer(self, report: Report) -> bytes:
        """Return the answer as soon as it is there."""
        assert self._request is not None
        process, folder = self._started()
        seconds, began, pause = self._request.seconds, time.monotonic(), _FIRST_POLL_S
        while not (folder / ANSWER).exists():
            if process.poll() is not None and not (folder / ANSWER).exists():
                raise ExchangeError(_exit_message(process.returncode, seconds))
            spent = time.monotonic() - began
            if spent > (longest := longest_wait(seconds)):
                raise ExchangeError(f"Reading did not finish within {longest:.3g} s and was stopped.")
            # The progress of a foreign parser is unknown: the share approaches 1 without reaching it.
            report(1 - 0.5 ** (4 * spent / seconds), "Reading")
            time.sleep(pause)
            pause = min(2 * pause, _POLL_S)
        answer = (folder / ANSWER).read_bytes()
        (folder / ANSWER).unlink()
        return answer


def read_in_process(
    reader: Reader,
    data: bytes,
    tolerance: float | None,
    *,
    seconds: float | None = None,
    memory: int = MEMORY,
    report: Report = silent,
) -> ImportResult:
    """Read the content of a file in a process of its own, and return the result of the reader.

    See `ReaderProcess.read` for the parameters and errors.
    """
    with ReaderProcess() as process:
        return process.read(reader, data, tolerance, seconds=seconds, memory=memory, report=report)


def read_in_this_process(reader: Reader, data: bytes) -> ImportResult:
    """Read a small content in this process, and return the result of the reader.

    Raises
    ------
    ExchangeError
        As `read_in_process`, but for the limits.
    """
    return _result_of(response_to(ReadRequest(reader.__module__, reader.__name__, None, data)))


def _result_of(answer: ReadResponse) -> ImportResult:
    if answer.result is None:
        raise ExchangeError(answer.problem)
    return answer.result


def _not_passed_on(problem: OSError) -> ExchangeError:
    return ExchangeError(f"The file cannot be passed to its reader process ({problem.strerror}).")


def _exit_message(code: int, seconds: float) -> str:
    """Return the message about a process that ended without an answer, by its exit code."""
    if was_overdue(code):
        return f"Reading needs more than {seconds:.3g} s of processor time and was stopped."
    # Ended by a signal, or its equivalent on Windows: C code crashes when it is refused memory.
    if code == NO_MEMORY or not 0 <= code < 2**8:
        return "Reading needs more memory than is allowed and was stopped."
    return f"The process that reads drawings ended without an answer (code {code})."


def _command(folder: str) -> list[str]:
    """Return the command line of the process."""
    if getattr(sys, "frozen", False):
        # The executable of a bundle is the program itself, not an interpreter.
        return [sys.executable, READER_PROCESS, folder]
    return [sys.executable, "-c", _START, folder, *sys.path]


def seconds_for(size: int) -> float:
    """Return the limit of processor time, in seconds, for reading a file of `size` bytes."""
    return SECONDS + SECONDS_PER_MB * max(size - SMALL, 0) / 2**20
