"""A process of its own for the drawings of others, with a limit of time and memory.

A file can be made to keep a parser busy for hours, or to fill the memory; the process that reads it is
then ended, and the window goes on.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Callable

import msgspec

from app.document.format import FormatError, validate
from app.exchange.cubics_in import Imported
from app.exchange.drawing import ExchangeError

SECONDS = 20.0
"""The longest that a file may take to be read."""

MEMORY = 400 * 2**20
"""Bytes that reading may need beyond what the program itself does, where the system can limit that."""

_START = "import sys; sys.path[:] = sys.argv[2:]; from app.exchange.child import main; main(sys.argv[1])"


class _Request(msgspec.Struct):
    """What the child shall do."""

    reader: str
    tolerance: float | None
    data: bytes


class _Answer(msgspec.Struct):
    """What came of it: one or the other."""

    result: Imported | None = None
    problem: str = ""


def limited(
    reader: str, data: bytes, tolerance: float | None, *, seconds: float = SECONDS, memory: int = MEMORY
) -> Imported:
    """Return what a reader makes of the content of a file, in a process with limits.

    Parameters
    ----------
    reader
        "svg" or "dxf".
    data
        The content.
    tolerance
        See the reader.
    seconds, memory
        The limits; memory in bytes.

    Raises
    ------
    ExchangeError
        What the reader raises, and where a limit is reached.
    """
    request = msgspec.msgpack.encode(_Request(reader, tolerance, data))
    # One thread: each would reserve memory of its own.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    try:
        done = subprocess.run(
            [sys.executable, "-c", _START, str(memory), *sys.path],
            input=request,
            capture_output=True,
            timeout=seconds,
            env=environment,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise ExchangeError(f"Reading takes longer than {seconds:g} s; it was stopped.") from None
    except OSError as problem:
        raise ExchangeError(f"No process could be started to read it ({problem.strerror}).") from None
    try:
        answer = msgspec.msgpack.decode(done.stdout, type=_Answer)
    except msgspec.DecodeError:
        raise ExchangeError("Reading needs more memory than is allowed; it was stopped.") from None
    if answer.result is None:
        raise ExchangeError(answer.problem)
    return answer.result


def main(memory: str) -> None:
    """Read a request from standard input and write the answer to standard output."""
    request = msgspec.msgpack.decode(sys.stdin.buffer.read(), type=_Request)
    sys.stdout.buffer.write(msgspec.msgpack.encode(answer_to(request, int(memory))))


def answer_to(request: _Request, memory: int) -> _Answer:
    """Return what the reader says, whatever it may raise."""
    try:
        reader = reader_of(request.reader)
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


def reader_of(name: str) -> Callable[[bytes, float | None], Imported]:
    """Return the reader of that name; `limited` runs it in a process of its own."""
    # Each brings a library that takes a while to import.
    if name == "dxf":
        from app.exchange.dxf import read_dxf  # noqa: PLC0415

        return read_dxf
    from app.exchange.svg_in import read_svg  # noqa: PLC0415

    return read_svg


def _limit_memory(extra: int) -> None:
    """Let this process take no more than `extra` bytes beyond what it has; only Linux counts that."""
    if sys.platform != "linux":
        return
    import resource  # noqa: PLC0415

    with contextlib.suppress(OSError, ValueError), open("/proc/self/statm", encoding="ascii") as file:  # noqa: PTH123
        pages = int(file.read().split()[0])
        most = pages * resource.getpagesize() + extra
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (most, hard))
