"""The command line: open the editor, render a document without a display, print facts about it."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from app import __version__
from app.cli_refusals import RefusalError, load_document, one_line, reason_of, say
from app.display import has_display, missing_library, why_no_window
from app.exchange import READER_PROCESS
from app.storage.files import StorageError

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

_INTERRUPTED = 130
"""What a shell expects of a program that Ctrl+C ended."""

_COMMANDS = ("render", "convert", "info", "lesson")

_DESCRIPTION = """\
Sketch parametric polynomial curves and see why they go where they go.

  curvebench [FILE ...]            open the editor, one window for each document
  curvebench render FILE -o OUT    write a picture of FILE, without a display
  curvebench convert IN OUT        read and write tables, drawings, code and formulas
  curvebench info FILE             print facts about the curves in FILE
  curvebench lesson [NAME]         open the editor with a lesson, or list the lessons
"""
_EPILOG = "A file that is called “render”, “convert”, “info” or “lesson” opens as ./render and so on."


_WITHOUT = "“curvebench render” and “curvebench info” need none."


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0, or 1 with one line on stderr.

    Parameters
    ----------
    arguments
        What follows the program's name; by default that of this process.

    Raises
    ------
    SystemExit
        With code 2 for wrong usage, 0 after ``--help`` and ``--version``.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A terminal that knows no α shall still show the rest.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        code = _run(words)
        say(end="")  # what was printed by others
    except BrokenPipeError:
        return _leave_closed_pipe()
    except KeyboardInterrupt:
        return _INTERRUPTED
    except (RefusalError, StorageError) as problem:
        message = str(problem)
    except OSError as problem:
        # Whatever it is: which command failed, on which files, and what the system says of it.
        message = f"{' '.join(['curvebench', *words])} failed: {reason_of(problem)}."
    else:
        return code
    print(f"curvebench: {one_line(message)}", file=sys.stderr)
    return 1


def _run(words: list[str]) -> int:
    if words[:1] == [READER_PROCESS] and len(words) == 2:
        # A bundle starts itself for this: it has no interpreter besides.
        from app.exchange.child import main as read_drawing  # noqa: PLC0415

        read_drawing(words[1])
        return 0
    if words and words[0] in _COMMANDS:
        # Readers, writers and their options: the editor starts without.
        from app.cli_commands import run_command  # noqa: PLC0415

        return run_command(words, edit=_edit)
    return _edit(_editor_parser().parse_args(words).files)


def _editor_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "curvebench",
        usage="curvebench [FILE ...]  |  curvebench render | convert | info | lesson …",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"curvebench {__version__}")
    parser.add_argument("files", nargs="*", metavar="FILE", help="documents (*.curve.json), files to import")
    return parser


def _edit(files: Sequence[str], lesson: str = "") -> int:
    """Open a window for every document, or one with the first sketch; return when the last is closed.

    What is no document is imported or traced in the first window, which also says what cannot be read.
    """
    problems = _problems_of(files)
    able = [path for path in files if path not in problems]
    if problems and not able:
        raise next(iter(problems.values()))  # before any window opens
    if not has_display():
        raise RefusalError(f"There is no display to open a window on. {_WITHOUT}")
    from app.start import no_garbage_sought, open_windows  # noqa: PLC0415

    with no_garbage_sought():
        application = _application()
        windows = open_windows(able, [f"{str(each).removesuffix('.')}." for each in problems.values()])
        if lesson:
            windows[0].open_lesson(lesson)
    from app.lifecycle import Lifecycle  # noqa: PLC0415

    lifecycle = Lifecycle(application, windows)
    del windows  # a window that is closed goes
    lifecycle.start()
    code = int(application.exec())
    lifecycle.stop()
    return code


def _problems_of(files: Sequence[str]) -> dict[str, RefusalError | StorageError]:
    """Return why files cannot be opened, imported or traced; those that can be are left out.

    A large document is read once, beside its window, which says what is wrong with it.
    """
    # The list of formats: `--version` does without.
    from app.commands.given import given  # noqa: PLC0415
    from app.storage.open_file import is_large  # noqa: PLC0415

    documents = given(map(Path, files)).documents
    problems: dict[str, RefusalError | StorageError] = {}
    for path in files:
        is_document = Path(path) in documents and not is_large(Path(path))
        if is_document or not Path(path).is_file():
            try:
                load_document(path)
            except (RefusalError, StorageError) as problem:
                problems[path] = problem
    return problems


def _application() -> QApplication:
    """Return Qt's application, or refuse where Qt could open no window and would end the process."""
    try:
        # Qt takes a while to import, and the other commands do without.
        import PySide6  # noqa: PLC0415
        from PySide6.QtWidgets import QApplication  # noqa: PLC0415
    except ImportError as problem:
        if sentence := missing_library(str(problem)):
            raise RefusalError(sentence) from problem
        raise
    running = QApplication.instance()
    if isinstance(running, QApplication):
        return running
    with why_no_window(Path(str(PySide6.__file__)).parent / "Qt" / "plugins" / "platforms") as sentence:
        if sentence:
            raise RefusalError(f"{sentence} {_WITHOUT}" if "display" in sentence else sentence)
        return QApplication([sys.argv[0]])


def _leave_closed_pipe() -> int:
    """Leave quietly when the reader of the output is gone (``| head``), as Unix programs do."""
    # Otherwise the interpreter would try to flush, and complain, once more on its way out.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0
