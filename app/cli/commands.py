"""The commands that need no window, and the lessons: render, convert, info, lesson."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from .. import cli, exchange
from ..document.words import enumerated
from ..exchange.drawing.animation import FILMS, first_round, write_film
from ..exchange.drawing.film import Film
from ..exchange.errors import ExchangeError
from ..exchange.files import ImportOptions, export, import_file
from ..exchange.formats import FORMATS, can_import, endings_of
from ..families import FAMILIES
from ..features.lessons.lesson import LessonError, find_lesson, lesson_names, load_lesson
from ..storage.format import Decoded
from ..view_model.animation.motion_settings import Pace, Repeat
from .command_line import common_options
from .documents import load_document
from .options import (
    CONVERT,
    STYLES,
    add_convert_options,
    add_motion_options,
    add_own_options,
    add_picture_options,
    convert_usage_problem,
    own_options,
    picture_options,
    positive_number,
)
from .printed_facts import facts_as_json, facts_as_text
from .progress import TerminalProgress
from .refusals import RefusalError, say, say_json, tell

if TYPE_CHECKING:
    from ..document.model import Document


def run_command(words: Sequence[str]) -> int:
    """Run the command that `words` begin with and return the exit code.

    Raises
    ------
    RefusalError
        If what was asked cannot be done.
    """
    parser = _command_parser()
    options, more = parser.parse_known_args(words)
    if options.command == "convert" and not any(each.startswith("-") for each in more):
        options.files += more  # those after an option: convert IN --thin 1 OUT
    elif more:
        parser.error(f"unrecognized arguments: {' '.join(more)}")
    if options.command == "convert" and (problem := convert_usage_problem(options)):
        options.parser.error(problem)
    tell(FAMILIES.problems)
    try:
        return _COMMAND_OF[options.command](options)
    except ExchangeError as problem:
        raise RefusalError(str(problem)) from None


def _command_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("curvebench")
    commands = parser.add_subparsers(dest="command", required=True)
    add = partial(commands.add_parser, parents=[common_options()])
    render = add(
        "render",
        help="write a picture",
        description="Write a picture of a document, or of a file that convert reads.",
    )
    render.add_argument("file", metavar="FILE")
    render.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="OUT",
        help=f"the picture; ends in {', '.join(_picture_endings())}",
    )
    render.add_argument(
        "--tolerance",
        type=positive_number,
        metavar="X",
        help="largest deviation from the true curve, in the document's unit (default: 1e-5 of its size)",
    )
    add_picture_options(render)
    add_own_options(render, FORMATS.pictures)
    add_motion_options(render)
    add_convert_options(add("convert", help="read and write other formats", description=CONVERT))
    info = add("info", help="print facts", description="Print facts about a document's curves.")
    info.add_argument("file", metavar="FILE")
    info.add_argument("--json", action="store_true", help="as JSON")
    lesson = add(
        "lesson", help="open a lesson", description="Open the editor with a lesson, or list the lessons."
    )
    lesson.add_argument("name", metavar="NAME", nargs="?", help="a lesson's name or number")
    return parser


def _document_of(options: argparse.Namespace) -> Decoded:
    """Return the document that a command is about, or what a file of another format holds.

    What is left out of it is printed beside the output.
    """
    try:
        found = load_document(options.file)
    except RefusalError:
        if not can_import(Path(options.file)):
            raise
    else:
        if found.left_out:
            tell([found.left_out.sentence(Path(options.file).name)])
        return found
    with TerminalProgress() as report:
        source = import_file(options.file, ImportOptions(), report=report)
    tell(source.remarks)
    return Decoded(source.document)


def _drawn_document(options: argparse.Namespace) -> Document:
    """Return what pictures are made of: the document, or the curves of it that were asked for."""
    document = _document_of(options).document
    return exchange.cubics_in.Imported(document).called(options.only).document if options.only else document


def _render(options: argparse.Namespace) -> int:
    name = options.output.lower()
    pictures, films = endings_of(FORMATS.pictures), endings_of(FILMS)
    # What both can be is a film where a motion was asked for.
    if name.endswith(films) and (options.motion or not name.endswith(pictures)):
        return _render_film(options)
    if not name.endswith(pictures):
        if Path(options.output).is_dir():
            raise RefusalError(f"“{options.output}” is a folder. Choose a file.")
        known = enumerated(_picture_endings(), "or")
        raise RefusalError(f"“{options.output}” does not end in a known format for pictures; use {known}.")
    document = _drawn_document(options)
    with TerminalProgress() as report:
        wanted = replace(picture_options(options, document), own=own_options(options, FORMATS.pictures))
        made = export(document, options.output, wanted.reporting(report))
    tell(made.remarks)
    return 0


def _picture_endings() -> tuple[str, ...]:
    """Return the endings of what `render` writes, each once."""
    return tuple(dict.fromkeys((*endings_of(FORMATS.pictures), *endings_of(FILMS))))


def _render_film(options: argparse.Namespace) -> int:
    # Takes modules along that the editor does without at its start.

    document, repeat = _drawn_document(options), Repeat(options.motion or "loop")
    film = Film(
        width=options.width or Film.width,
        fps=options.fps,
        seconds=options.seconds or first_round(document, repeat),
        repeat=repeat,
        pace=Pace(options.pace),
        style=STYLES[options.theme or "light"],
        points=options.points,
    )
    write_film(document, options.output, film)
    return 0


def _info(options: argparse.Namespace) -> int:
    found = _document_of(options)
    document = found.document
    with TerminalProgress() as report:
        facts = exchange.facts.facts_of(document, report)
    if options.json:
        curves = [facts_as_json(each) for each in facts]
        say_json(
            {
                "file": options.file,
                "unit": document.unit or None,
                "left_out": dict(found.left_out.counts),
                "curves": curves,
            }
        )
    else:
        say("\n\n".join(facts_as_text(each, document.unit) for each in facts))
    return 0


def _lesson(options: argparse.Namespace) -> int:
    if options.name is None:
        for number, name in enumerate(lesson_names(), start=1):
            say(f"{number:2}  {name.partition('_')[2]:28}{load_lesson(name).title}")
        return 0
    try:
        return cli.start.edit((), find_lesson(options.name))
    except LessonError as problem:
        raise RefusalError(str(problem)) from None


def _convert(options: argparse.Namespace) -> int:
    return int(cli.converting.convert(options))  # imported where it is asked for


_COMMAND_OF = {
    "render": _render,
    "convert": _convert,
    "info": _info,
    "lesson": _lesson,
}
