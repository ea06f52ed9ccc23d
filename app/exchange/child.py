"""A process of its own for the drawings of others, with a limit of time and memory.

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
from typing import IO

import msgspec

from ..storage.coding import from_plain, to_plain
from ..storage.format_error import FormatError
from ..storage.validation import validate
from ..tasks.progress import Report, silent
from . import READER_PROCESS
from .cubics_in import Imported
from .errors import ExchangeError

if sys.platform == "linux":
    import resource

SECONDS = 10.0
"""The longest that a file of up to `SMALL` bytes may take to be read."""

SMALL = 2**16
SECONDS_PER_MB = 120.0
"""Seconds for every further 2**20 bytes: a file that makes a parser work for hours can be small, and an
honest large one takes its time, of short paths some 13 s of a processor that may be busy otherwise. Whoever
waits can cancel.
"""

_POLL = 0.05

Reader = Callable[[bytes, float | None], Imported]
"""Function of the content of a file and a tolerance."""

MEMORY = 400 * 2**20
"""Bytes that reading may need beyond what the program itself does, where the system can limit that."""

_NO_MEMORY = 3
"""Exit code of a process that had no memory left, not even to say so."""

_START = f"import sys; sys.path[:] = sys.argv[2:]; from {__name__} import main; main(sys.argv[1])"


class Request(msgspec.Struct):
    """Message to the child: a reader and a file."""

    module: str
    reader: str
    tolerance: float | None
    data: bytes


class _Answer(msgspec.Struct):
    """Message of the child: a result or a problem."""

    result: Imported | None = None
    problem: str = ""


def limited(
    reader: Reader,
    data: bytes,
    tolerance: float | None,
    *,
    seconds: float | None = None,
    memory: int = MEMORY,
    report: Report = silent,
) -> Imported:
    """Return what a reader makes of the content of a file, in a process with limits.

    Parameters
    ----------
    reader
        A function at the top level of its module.
    data
        The content.
    tolerance
        See the reader.
    seconds, memory
        The limits, by default `seconds_for` the file and `MEMORY`; memory in bytes.
    report
        Called all the time; when it raises, the process is ended.

    Raises
    ------
    ExchangeError
        What the reader raises, and where a limit is reached.
    """
    request = msgspec.msgpack.encode(Request(reader.__module__, reader.__name__, tolerance, data))
    seconds = seconds_for(len(data)) if seconds is None else seconds
    output, code = _output_of(request, memory, seconds, report)
    try:
        answer = msgspec.msgpack.decode(output, type=_Answer, dec_hook=from_plain)
    except msgspec.DecodeError:
        raise ExchangeError(_why_silent(code)) from None
    return _result_of(answer)


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


def _why_silent(code: int) -> str:
    """Return what to say of a process that ended without an answer, by its exit code."""
    # By a signal, or by what is one on Windows: C code that is refused memory breaks down.
    if code == _NO_MEMORY or not 0 <= code < 2**8:
        return "Reading needs more memory than is allowed; it was stopped."
    return f"The process that reads drawings ended without an answer (code {code})."


def _command(memory: int) -> list[str]:
    """Return the command line of the process."""
    if getattr(sys, "frozen", False):
        # The executable of a bundle is the program itself, not an interpreter that could be told what to run.
        return [sys.executable, READER_PROCESS, str(memory)]
    return [sys.executable, "-c", _START, str(memory), *sys.path]


def seconds_for(size: int) -> float:
    """Return how long a file of `size` bytes may take to be read."""
    return SECONDS + SECONDS_PER_MB * max(size - SMALL, 0) / 2**20


def _output_of(request: bytes, memory: int, seconds: float, report: Report) -> tuple[bytes, int]:
    """Return what the process answers, and its exit code."""
    # One thread: each would reserve memory of its own.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    began = time.monotonic()
    # Not by a pipe: Python before 3.12 stops feeding it after the first timeout.
    with _passing_file(request) as question:
        try:
            process = subprocess.Popen(
                _command(memory),
                stdin=question,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=environment,
            )
        except OSError as problem:
            raise ExchangeError(f"No process could be started to read it ({problem.strerror}).") from None
        with process:
            try:
                return _awaited(process, began, seconds, report), process.returncode
            finally:
                process.kill()


def _passing_file(content: bytes) -> IO[bytes]:
    """Return a file without a name that holds the content, to be read from its beginning."""
    try:
        file = tempfile.TemporaryFile()  # noqa: SIM115 - whoever asked for it closes it
        file.write(content)
        file.seek(0)
    except OSError as problem:
        raise ExchangeError(f"It cannot be passed on to be read ({problem.strerror}).") from None
    return file


def _awaited(process: subprocess.Popen[bytes], began: float, seconds: float, report: Report) -> bytes:
    while True:
        spent = time.monotonic() - began
        if spent > seconds:
            raise ExchangeError(f"Reading takes longer than {seconds:.3g} s; it was stopped.")
        # Nobody knows how far a foreign parser is: half of what is left is always ahead.
        report(1 - 0.5 ** (4 * spent / seconds), "Reading")
        with contextlib.suppress(subprocess.TimeoutExpired):
            return process.communicate(timeout=_POLL)[0]


def main(memory: str) -> None:
    """Read a request from standard input and write the answer to standard output."""
    # Not sys.stdin and sys.stdout: a bundle without a console has none, but it has what was handed to it.
    with open(0, "rb", closefd=False) as question, open(1, "wb", closefd=False) as answer:
        try:
            request = msgspec.msgpack.decode(question.read(), type=Request)
            answer.write(msgspec.msgpack.encode(answer_to(request, int(memory)), enc_hook=to_plain))
        except MemoryError:
            sys.exit(_NO_MEMORY)


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


def _limit_memory(extra: int) -> None:
    """Let this process take no more than `extra` bytes beyond what it has; only Linux counts that."""
    if sys.platform != "linux":
        return
    with contextlib.suppress(OSError, ValueError), open("/proc/self/statm", encoding="ascii") as file:  # noqa: PTH123
        pages = int(file.read().split()[0])
        most = pages * resource.getpagesize() + extra
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
