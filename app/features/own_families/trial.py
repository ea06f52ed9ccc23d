"""A process of its own that runs a file of families first: it may hang, print without end, or exit."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ... import __version__
from ...families.family_file import FamilyFileError, use_file
from ...tasks.progress import Report

SECONDS = 15.0
"""The longest that a file may take to be run and tried out; what it runs has shorter limits of its own."""

_MOST_PRINTED = 2**20
_POLL_S = 0.02
_SAYS = "curvebench: "
_START = (
    "import sys; sys.path[:] = sys.argv[4:]; "
    f"from {__name__.partition('.')[0]}.cli import main; sys.exit(main(sys.argv[1:4]))"
)

__all__ = ["SECONDS", "FamilyFileError", "try_out", "use_file"]


def try_out(path: Path, report: Report) -> None:
    """Run a file in a process of its own; `report` is called all the time, and may stop it.

    Raises
    ------
    FamilyFileError
        If it holds no family that works; the text names the file without its folder.
    """
    arguments = ["--families", str(path), "--version"]
    frozen = getattr(sys, "frozen", False)
    command = (
        [sys.executable, *arguments] if frozen else [sys.executable, "-c", _START, *arguments, *sys.path]
    )
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
        printed, said = (_end_of(each.fileno()) for each in (output, errors))
    if process.returncode == 0 and printed.rstrip().endswith(__version__):
        return
    said = said.rstrip().rpartition("\n")[2]
    if said.startswith(_SAYS):
        raise FamilyFileError(said.removeprefix(_SAYS).replace(str(path), path.name))
    raise FamilyFileError(f"“{path.name}” ended the process that ran it (code {process.returncode}).")


def _refuse_endless(path: Path, began: float, files: tuple[int, ...]) -> None:
    if time.monotonic() - began > SECONDS:
        raise FamilyFileError(f"“{path.name}” ran for longer than {SECONDS:g} s and was stopped.")
    if any(os.fstat(each).st_size > _MOST_PRINTED for each in files):
        raise FamilyFileError(f"“{path.name}” printed more than a megabyte and was stopped.")


def _end_of(file: int) -> str:
    size = os.fstat(file).st_size
    os.lseek(file, max(size - 4096, 0), os.SEEK_SET)
    return os.read(file, 4096).decode("utf-8", errors="replace")
