"""Reading of drawings in the child process, with limits; each start pays for its imports.

See ``reader_process`` for the process that asks.
"""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable
from importlib import import_module
from math import inf
from pathlib import Path

import msgspec

from ..storage.coding import encode_hook
from ..storage.format_error import FormatError
from ..storage.validation import validate
from ..tasks.processor_limit import limit_processor_time
from .cubics_in import ImportResult
from .errors import ExchangeError

if sys.platform == "linux":
    import resource

SECONDS = 10.0
"""Processor time, in seconds, that reading a file of up to `SMALL` bytes may take."""

Reader = Callable[[bytes, float | None], ImportResult]
"""Function of the content of a file and a tolerance."""

MEMORY = 400 * 2**20
"""Bytes that reading may need beyond those of the program, where the system can limit memory."""

NO_MEMORY = 3
"""Exit code of a process that had no memory left, not even to say so."""

QUESTION, ANSWER, _UNFINISHED = "question", "answer", "unfinished"
"""Names of the files by which the processes talk, in a folder of their own."""


class ReadRequest(msgspec.Struct):
    """Message to the child process: a reader, a file and the limits; see `ReaderProcess.read`."""

    module: str
    reader: str
    tolerance: float | None
    data: bytes
    memory: int = MEMORY
    seconds: float = SECONDS


class ReadResponse(msgspec.Struct):
    """Message of the child process: a result or a problem."""

    result: ImportResult | None = None
    problem: str = ""


def main(folder: str) -> None:
    """Answer the question in a folder, again for each line of the standard input."""
    here = Path(folder)
    # Not sys.stdin: a bundle without a console has none, but it has the descriptor.
    with open(0, "rb", closefd=False) as lines:
        while lines.readline():
            try:
                _answer_in(here)
            except MemoryError:
                sys.exit(NO_MEMORY)
    # The parent is gone, or it would have ended this process.
    with contextlib.suppress(OSError):
        for path in here.iterdir():
            path.unlink()
        here.rmdir()


def _answer_in(folder: Path) -> None:
    request = msgspec.msgpack.decode((folder / QUESTION).read_bytes(), type=ReadRequest)
    import_module(request.module)  # imports do not count against the limit
    limit_processor_time(request.seconds)
    answer = msgspec.msgpack.encode(response_to(request, request.memory), enc_hook=encode_hook)
    limit_processor_time(inf)
    limit_memory(None)
    (folder / _UNFINISHED).write_bytes(answer)
    (folder / _UNFINISHED).replace(folder / ANSWER)


def response_to(request: ReadRequest, memory: int | None = None) -> ReadResponse:
    """Return the answer of the reader, also where it raises; with so much memory, if that is limited."""
    try:
        reader: Reader = getattr(import_module(request.module), request.reader)
        if memory is not None:
            limit_memory(memory)
        result = reader(request.data, request.tolerance)
        validate(result.document)
    except ExchangeError as problem:
        return ReadResponse(problem=str(problem))
    except FormatError as problem:
        return ReadResponse(problem=f"The file cannot be converted to a document: {problem}.")
    except MemoryError:
        return ReadResponse(problem="Reading needs more memory than is allowed and was stopped.")
    except RecursionError:
        return ReadResponse(problem="The file is nested too deeply.")
    except Exception as problem:
        # An unforeseen file can make a parser raise anything.
        return ReadResponse(problem=f"The file is damaged ({type(problem).__name__}).")
    return ReadResponse(result)


def limit_memory(extra: int | None) -> None:
    """Limit the memory of this process to `extra` bytes more than it has; None lifts the limit.

    Only Linux has such a limit.
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
