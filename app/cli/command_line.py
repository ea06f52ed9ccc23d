"""The command line: open the editor, render a document without a display, print facts about it."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections.abc import Sequence
from contextlib import nullcontext

from .. import __version__, cli, exchange, storage
from ..diagnostics.log import LEVELS, logged
from ..exchange import READER_PROCESS
from ..tasks.processor_limit import PROCESSOR_LIMIT, limit_processor_time
from .output import RefusalError, one_line, print_text, reason_of

_INTERRUPTED = 130
"""The exit code that a shell expects of a program that Ctrl+C ended."""

_COMMANDS = ("render", "convert", "info", "lesson")

_DESCRIPTION = """\
Sketch parametric polynomial curves and see why they go where they go.

  curvebench [FILE ...]            open the editor, one window for each document
  curvebench render FILE -o OUT    write a picture of FILE, without a display
  curvebench convert IN OUT        read and write tables, drawings, code and formulas
  curvebench info FILE             print facts about the curves in FILE
  curvebench lesson [NAME]         open the editor with a lesson, or list the lessons
"""
_EPILOG = "To open a file named “render”, “convert”, “info” or “lesson”, write ./render and so on."


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0, or 1 with one line on stderr.

    Parameters
    ----------
    arguments
        The words after the program's name; by default those of this process.

    Raises
    ------
    SystemExit
        With code 2 for wrong usage, 0 after ``--help`` and ``--version``.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if isinstance(sys.stdout, io.TextIOWrapper):
        # A terminal that cannot show α still shows the rest.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        options, words = common_options().parse_known_args(words)
        families = cli.families.families_of_files(options.families) if options.families else nullcontext()
        if options.processor_limit:
            limit_processor_time(options.processor_limit)
        with logged(options.log), families:
            code = _run(words)
        print_text(end="")  # flushes the output of others
    except BrokenPipeError:
        # The reader of the output is gone (``| head``): leave quietly, as Unix programs do. Otherwise the
        # interpreter would try to flush, and complain, once more on its way out.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        return _INTERRUPTED
    except RefusalError as problem:
        message = str(problem)
    except OSError as problem:
        # Any other error of the system: name the command, its files and the reason.
        is_sentence = isinstance(problem, storage.files.StorageError)
        failed = f"{' '.join(['curvebench', *words])} failed: {reason_of(problem)}."
        message = str(problem) if is_sentence else failed
    else:
        return code
    print(f"curvebench: {one_line(message)}", file=sys.stderr)
    return 1


def common_options() -> argparse.ArgumentParser:
    """Return the parser of the options that every command has, wherever they stand.

    These are parsed first, as the families decide on the values of other options.
    """
    parser = argparse.ArgumentParser("curvebench", add_help=False, allow_abbrev=False)
    parser.add_argument(
        "--log",
        type=str.upper,
        choices=LEVELS,
        metavar="LEVEL",
        default="",
        help=f"log the actions of the program ({', '.join(LEVELS)}), without names and points",
    )
    parser.add_argument(
        "--families",
        action="append",
        default=[],
        metavar="FILE.py",
        help="run this file and use the curve families that it defines; can be repeated",
    )
    parser.add_argument(PROCESSOR_LIMIT, type=float, default=0.0, help=argparse.SUPPRESS)
    return parser


def _run(words: list[str]) -> int:
    if words[:1] == [READER_PROCESS] and len(words) == 2:
        # A bundle starts itself for this: it contains no other interpreter.

        exchange.reader_main.main(words[1])
        return 0
    if words and words[0] in _COMMANDS:
        return cli.commands.run_command(words)
    files = _editor_parser().parse_args(words).files
    return cli.start.edit(files)


def _editor_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "curvebench",
        usage="curvebench [FILE ...]  |  curvebench render | convert | info | lesson …",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        parents=[common_options()],
    )
    parser.add_argument("--version", action="version", version=f"curvebench {__version__}")
    parser.add_argument("files", nargs="*", metavar="FILE", help="documents (*.curve.json), files to import")
    return parser
