"""The commands that need no window, and the lessons: which one it is, and info."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial

from .. import cli, exchange
from ..exchange.errors import ExchangeError
from ..families import FAMILIES
from .command_line import common_options
from .documents import document_of
from .options import CONVERT, add_convert_options, convert_usage_problem
from .output import RefusalError, TerminalProgress, print_json, print_remarks, print_text


def run_command(words: Sequence[str]) -> int:
    """Run the command that `words` begin with and return the exit code.

    Raises
    ------
    RefusalError
        If the command cannot be done.
    """
    parser = _command_parser(words[0])
    options, more = parser.parse_known_args(words)
    if options.command == "convert" and not any(word.startswith("-") for word in more):
        options.files += more  # files after an option: convert IN --thin 1 OUT
    elif more:
        parser.error(f"unrecognized arguments: {' '.join(more)}")
    if options.command == "convert" and (problem := convert_usage_problem(options)):
        options.parser.error(problem)
    print_remarks(FAMILIES.problems)
    try:
        return _COMMAND_OF[options.command](options)
    except ExchangeError as problem:
        raise RefusalError(str(problem)) from None


def _command_parser(command: str) -> argparse.ArgumentParser:
    """Return the parser; the options of `render` are imported for that command only."""
    parser = argparse.ArgumentParser("curvebench")
    commands = parser.add_subparsers(dest="command", required=True)
    add = partial(commands.add_parser, parents=[common_options()])
    render = add(
        "render",
        help="write a picture",
        description="Write a picture of a document, or of a file that convert reads.",
    )
    if command == "render":
        cli.rendering.add_options(render)
    add_convert_options(add("convert", help="read and write other formats", description=CONVERT))
    info = add("info", help="print facts", description="Print facts about a document's curves.")
    info.add_argument("file", metavar="FILE")
    info.add_argument("--json", action="store_true", help="as JSON")
    lesson = add(
        "lesson", help="open a lesson", description="Open the editor with a lesson, or list the lessons."
    )
    lesson.add_argument("name", metavar="NAME", nargs="?", help="name or number of a lesson")
    return parser


def _info(options: argparse.Namespace) -> int:
    decoded = document_of(options.file)
    document = decoded.document
    with TerminalProgress() as report:
        facts = exchange.facts.facts_of(document, report)
    if options.json:
        curves = [cli.info.facts_as_json(facts_of_curve) for facts_of_curve in facts]
        print_json(
            {
                "file": options.file,
                "unit": document.unit or None,
                "left_out": dict(decoded.left_out.counts),
                "curves": curves,
            }
        )
    else:
        print_text(
            "\n\n".join(cli.info.facts_as_text(facts_of_curve, document.unit) for facts_of_curve in facts)
        )
    return 0


def _render(options: argparse.Namespace) -> int:
    return cli.rendering.render(options)


def _convert(options: argparse.Namespace) -> int:
    return cli.converting.convert(options)


def _lesson(options: argparse.Namespace) -> int:
    return cli.lessons.lesson(options.name)


_COMMAND_OF = {"render": _render, "convert": _convert, "info": _info, "lesson": _lesson}
