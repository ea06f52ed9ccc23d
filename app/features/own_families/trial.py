"""Trial of a family file in another process: it may hang, print without end, or exit.

There it runs when it is used or saved, and whatever call of its functions took too long for a window.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ... import __version__
from ...document.model import Curve, Document, Parametrization, ParametrizationKind, Point
from ...families import FAMILIES
from ...families.family_file import PATIENCE, Call, FamilyFileError, use_file
from ...storage.format import encode
from ...tasks.processor_limit import PROCESSOR_LIMIT, longest_wait, was_overdue
from ...tasks.progress import Report

SECONDS = 15.0
"""Processor time, in seconds, for a file to be run and tried; what it runs has shorter limits of its own."""

_JSON_BEGINS = '{\n  "file"'
_MOST_PRINTED = 2**20
_POLL_S = 0.02
_SAYS = "curvebench: "
_START = (
    "import sys; end = 2 + int(sys.argv[1]); sys.path[:] = sys.argv[end:]; "
    f"from {__name__.partition('.')[0]}.cli import main; sys.exit(main(sys.argv[2:end]))"
)

__all__ = ["PATIENCE", "SECONDS", "FamilyFileError", "try_call", "try_out", "use_file"]


def try_out(path: Path, report: Report) -> None:
    """Run a file in another process; `report` is called all the time, and may stop it.

    Raises
    ------
    FamilyFileError
        If it holds no family that works; the text names the file without its folder.
    """
    printed = _printed_by(path, ("--families", str(path), "--version"), report)
    if not printed.rstrip().endswith(__version__):
        raise FamilyFileError(f"“{path.name}” ended the process that ran it (code 0).")


def try_call(call: Call, report: Report) -> float:
    """Make the curve of a call in another process; return the seconds it took.

    Raises
    ------
    FamilyFileError
        If there is none: a sentence, from which the file's folder is left out.
    """
    began, path = time.monotonic(), call.calls.path
    family = FAMILIES.named(call.calls.name)
    curve = Curve(
        name="",
        family=family,
        parametrization=Parametrization(ParametrizationKind.MANUAL),
        points=tuple(Point(t, 0.0, t) for t in call.parameters.tolist()),
        settings=family.settings.without_defaults(call.settings),
    )
    with tempfile.TemporaryDirectory() as folder:
        document = Path(folder) / "tried.curve.json"
        document.write_bytes(encode(Document((curve,))))
        try:
            printed = _printed_by(path, ("info", "--json", "--families", str(path), str(document)), report)
        except FamilyFileError as problem:
            raise FamilyFileError(f"{call.message}. {problem}") from None
    # What the file prints comes before.
    (facts,) = json.loads(printed[printed.rfind(_JSON_BEGINS) :])["curves"]
    if facts["domain"] is None:
        raise FamilyFileError(" ".join(facts["warnings"]))
    return time.monotonic() - began


def _printed_by(path: Path, arguments: tuple[str, ...], report: Report) -> str:
    """Return the output of the program, started with these arguments to run the file at `path`."""
    frozen = getattr(sys, "frozen", False)
    arguments = (*arguments, PROCESSOR_LIMIT, str(SECONDS))
    start = () if frozen else ("-c", _START, str(len(arguments)))
    command = [sys.executable, *start, *arguments, *(() if frozen else sys.path)]
    # One thread: each would take time to begin. No limit by a pipe: it would fill up, or the memory would.
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONIOENCODING": "utf-8"}
    began = time.monotonic()
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        with subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=output, stderr=errors, env=environment
        ) as process:
            try:
                while process.poll() is None:
                    _refuse_endless(path, began, (output.fileno(), errors.fileno()))
                    report(0.0, "Running")
                    time.sleep(_POLL_S)
            finally:
                process.kill()
        printed, error = (_end_of(file.fileno()) for file in (output, errors))
    if process.returncode == 0:
        return printed
    if was_overdue(process.returncode):
        raise FamilyFileError(f"“{path.name}” ran for longer than {SECONDS:g} s and was stopped.")
    error = error.rstrip().rpartition("\n")[2]
    if error.startswith(_SAYS):
        raise FamilyFileError(error.removeprefix(_SAYS).replace(str(path), path.name))
    raise FamilyFileError(f"“{path.name}” ended the process that ran it (code {process.returncode}).")


def _refuse_endless(path: Path, began: float, files: tuple[int, ...]) -> None:
    if time.monotonic() - began > (longest := longest_wait(SECONDS)):
        raise FamilyFileError(f"“{path.name}” has not ended after {longest:.3g} s and was stopped.")
    if any(os.fstat(file).st_size > _MOST_PRINTED for file in files):
        raise FamilyFileError(f"“{path.name}” printed more than a megabyte and was stopped.")


def _end_of(file: int) -> str:
    size = os.fstat(file).st_size
    os.lseek(file, max(size - 4096, 0), os.SEEK_SET)
    return os.read(file, 4096).decode("utf-8", errors="replace")
