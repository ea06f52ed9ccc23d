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
from collections.abc import Callable
from importlib import import_module
from math import inf
from pathlib import Path
from typing import Self

import msgspec

from ..storage.coding import from_plain, to_plain
from ..storage.format_error import FormatError
from ..storage.validation import validate
from ..tasks.processor_limit import limit_processor_time, longest_wait, was_overdue
from ..tasks.progress import Report, silent
from . import READER_PROCESS
from .cubics_in import Imported
from .errors import ExchangeError

if sys.platform == "linux":
    import resource

SECONDS = 10.0
"""Processor time, in seconds, that reading a file of up to `SMALL` bytes may take."""

SMALL = 2**16
SECONDS_PER_MB = 120.0
"""Seconds for every further 2**20 bytes: a file that makes a parser work for hours can be small, and an
honest large one takes its time, of short paths some 13 s. Whoever waits can cancel.
"""

_FIRST_POLL_S, _POLL_S = 0.001, 0.05
"""Seconds between two looks for an answer: small drawings are read in milliseconds."""

Reader = Callable[[bytes, float | None], Imported]
"""Function of the content of a file and a tolerance."""

MEMORY = 400 * 2**20
"""Bytes that reading may need beyond what the program itself does, where the system can limit that."""

_NO_MEMORY = 3
"""Exit code of a process that had no memory left, not even to say so."""

_START = f"import sys; sys.path[:] = sys.argv[2:]; from {__name__} import main; main(sys.argv[1])"

_QUESTION, _ANSWER, _UNFINISHED = "question", "answer", "unfinished"
"""Names of the files by which the processes talk, in a folder of their own."""


class Request(msgspec.Struct):
    """Message to the child: a reader, a file and the limits; see `ReaderProcess.read`."""

    module: str
    reader: str
    tolerance: float | None
    data: bytes
    memory: int = MEMORY
    seconds: float = SECONDS


class _Answer(msgspec.Struct):
    """Message of the child: a result or a problem."""

    result: Imported | None = None
    problem: str = ""


class ReaderProcess:
    """Child process that reads drawings, one after the other, each with limits.

    It starts with the first drawing. One that reaches a limit ends it, and the next one has another process.
    A context manager: the process ends with it.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._request: Request | None = None

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
            If there can be no process, or the content cannot be passed on.
        """
        seconds = seconds_for(len(data)) if seconds is None else seconds
        request = Request(reader.__module__, reader.__name__, tolerance, data, memory, seconds)
        if request == self._request:
            return
        if self._request is not None or (self._process is not None and self._process.poll() is not None):
            self.end()
        process, folder = self._started()
        try:
            (folder / _QUESTION).write_bytes(msgspec.msgpack.encode(request))
        except OSError as problem:
            raise _not_passed_on(problem) from None
        assert process.stdin is not None
        with contextlib.suppress(OSError):  # it has ended: `read` says why
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
    ) -> Imported:
        """Return what a reader makes of the content of a file.

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
            Called all the time; when it raises, the process is ended.

        Raises
        ------
        ExchangeError
            What the reader raises, and where a limit is reached.
        """
        self.begin(reader, data, tolerance, seconds=seconds, memory=memory)
        try:
            answer = msgspec.msgpack.decode(self._awaited(report), type=_Answer, dec_hook=from_plain)
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
                    # One thread: each would reserve memory of its own.
                    env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                )
            except OSError as problem:
                raise ExchangeError(f"No process could be started to read it ({problem.strerror}).") from None
        return self._process, Path(self._folder.name)

    def _awaited(self, report: Report) -> bytes:
        """Return the answer as soon as it is there."""
        assert self._request is not None
        process, folder = self._started()
        seconds, began, pause = self._request.seconds, time.monotonic(), _FIRST_POLL_S
        while not (folder / _ANSWER).exists():
            if process.poll() is not None and not (folder / _ANSWER).exists():
                raise ExchangeError(_why_silent(process.returncode, seconds))
            spent = time.monotonic() - began
            if spent > (longest := longest_wait(seconds)):
                raise ExchangeError(f"Reading has not ended after {longest:.3g} s; it was stopped.")
            # Nobody knows how far a foreign parser is: half of what is left is always ahead.
            report(1 - 0.5 ** (4 * spent / seconds), "Reading")
            time.sleep(pause)
            pause = min(2 * pause, _POLL_S)
        answer = (folder / _ANSWER).read_bytes()
        (folder / _ANSWER).unlink()
        return answer


def limited(
    reader: Reader,
    data: bytes,
    tolerance: float | None,
    *,
    seconds: float | None = None,
    memory: int = MEMORY,
    report: Report = silent,
) -> Imported:
    """Return what a reader makes of the content of a file, in a process of its own.

    See `ReaderProcess.read` for the parameters and errors.
    """
    with ReaderProcess() as process:
        return process.read(reader, data, tolerance, seconds=seconds, memory=memory, report=report)


def at_once(reader: Reader, data: bytes) -> Imported:
    """Return what a reader makes of a content so small that it needs no process of its own.

    Raises
    ------
    ExchangeError
        As `limited`, but for the limits.
    """
    return _result_of(answer_to(Request(reader.__module__, reader.__name__, None, data)))


def _result_of(answer: _Answer) -> Imported:
    if answer.result is None:
        raise ExchangeError(answer.problem)
    return answer.result


def _not_passed_on(problem: OSError) -> ExchangeError:
    return ExchangeError(f"It cannot be passed on to be read ({problem.strerror}).")


def _why_silent(code: int, seconds: float) -> str:
    """Return what to say of a process that ended without an answer, by its exit code."""
    if was_overdue(code):
        return f"Reading takes more than {seconds:.3g} s of the processor; it was stopped."
    # By a signal, or by what is one on Windows: C code that is refused memory breaks down.
    if code == _NO_MEMORY or not 0 <= code < 2**8:
        return "Reading needs more memory than is allowed; it was stopped."
    return f"The process that reads drawings ended without an answer (code {code})."


def _command(folder: str) -> list[str]:
    """Return the command line of the process."""
    if getattr(sys, "frozen", False):
        # The executable of a bundle is the program itself, not an interpreter that could be told what to run.
        return [sys.executable, READER_PROCESS, folder]
    return [sys.executable, "-c", _START, folder, *sys.path]


def seconds_for(size: int) -> float:
    """Return how many seconds of the processor a file of `size` bytes may take to be read."""
    return SECONDS + SECONDS_PER_MB * max(size - SMALL, 0) / 2**20


def main(folder: str) -> None:
    """Answer the question in a folder, again for each line of the standard input."""
    here = Path(folder)
    # Not sys.stdin: a bundle without a console has none, but it has what was handed to it.
    with open(0, "rb", closefd=False) as lines:
        while lines.readline():
            try:
                _answer_in(here)
            except MemoryError:
                sys.exit(_NO_MEMORY)


def _answer_in(folder: Path) -> None:
    request = msgspec.msgpack.decode((folder / _QUESTION).read_bytes(), type=Request)
    import_module(request.module)  # the start does not count
    limit_processor_time(request.seconds)
    answer = msgspec.msgpack.encode(answer_to(request, request.memory), enc_hook=to_plain)
    limit_processor_time(inf)
    _limit_memory(None)
    (folder / _UNFINISHED).write_bytes(answer)
    (folder / _UNFINISHED).replace(folder / _ANSWER)


def answer_to(request: Request, memory: int | None = None) -> _Answer:
    """Return what the reader says, whatever it may raise; with so much memory, if that is limited."""
    try:
        reader: Reader = getattr(import_module(request.module), request.reader)
        if memory is not None:
            _limit_memory(memory)
        result = reader(request.data, request.tolerance)
        validate(result.document)
    except ExchangeError as problem:
        return _Answer(problem=str(problem))
    except FormatError as problem:
        return _Answer(problem=f"The file cannot become a document: {problem}.")
    except MemoryError:
        return _Answer(problem="Reading needs more memory than is allowed; it was stopped.")
    except RecursionError:
        return _Answer(problem="The file is nested too deeply.")
    except Exception as problem:
        # Whatever a file nobody thought of makes a parser raise, it shall end here.
        return _Answer(problem=f"The file is damaged ({type(problem).__name__}).")
    return _Answer(result)


def _limit_memory(extra: int | None) -> None:
    """Let this process take no more than `extra` bytes beyond what it has, or as much as it may at all.

    Only Linux counts that.
    """
    if sys.platform != "linux":
        return
    with contextlib.suppress(OSError, ValueError):
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        most = hard
        if extra is not None:
            pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
            most = pages * resource.getpagesize() + extra
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
