"""The commands that need no window, and the lessons: render, convert, info, lesson."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from .. import cli, exchange
from ..document.limits import EditError
from ..document.words import enumerated
from ..exchange.drawing.animation import FILMS, first_round, write_film
from ..exchange.drawing.film import Film
from ..exchange.errors import ExchangeError
from ..exchange.files import ImportOptions, export, import_file
from ..exchange.formats import FORMATS, can_import, endings_of
from ..exchange.table.family_word import FamilyWord, read_family_word
from ..families import FAMILIES, HERMITE
from ..features.lessons.lesson import LessonError, find_lesson, lesson_names, load_lesson
from ..storage.format import Decoded
from ..tasks.progress import Report, part
from ..view_model.animation.motion_settings import Pace, Repeat
from ..view_model.curve.curve_view import view_of
from ..view_model.fitting.least_squares import Fitted, fitted_to_curve
from .command_line import common_options
from .documents import load_document
from .options import (
    STYLES,
    add_convert_options,
    add_motion_options,
    add_own_options,
    add_picture_options,
    columns_to_read,
    own_options,
    picture_options,
    positive_number,
)
from .printed_facts import facts_as_json, facts_as_text
from .refusals import RefusalError, one_line, say

if TYPE_CHECKING:
    from ..document.model import Document
    from ..exchange.cubics_in import Imported

_CONVERT = "Read a file of one format and write another; prints the largest deviation from the true curves."

_MANY_CURVES = 20
"""Curves beyond which it is said how to take some of them."""

_PATIENCE = 0.2
"""Seconds of work without a word, and between two words."""


def run_command(words: Sequence[str]) -> int:
    """Run the command that `words` begin with and return the exit code.

    Raises
    ------
    RefusalError
        If what was asked cannot be done.
    """
    options = _command_parser().parse_args(words)
    _tell(FAMILIES.problems)
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
    add_convert_options(add("convert", help="read and write other formats", description=_CONVERT))
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
            _tell([found.left_out.sentence(Path(options.file).name)])
        return found
    with _told_on_terminals() as report:
        source = import_file(options.file, ImportOptions(), report=report)
    _tell(source.remarks)
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
    with _told_on_terminals() as report:
        wanted = replace(picture_options(options, document), own=own_options(options, FORMATS.pictures))
        made = export(document, options.output, wanted.reporting(report))
    _tell(made.remarks)
    return 0


def _tell(remarks: Iterable[str]) -> None:
    """Print what was left out or is otherwise, line by line, beside the output."""
    for remark in remarks:
        print(f"curvebench: {one_line(remark)}", file=sys.stderr)


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


def _family_of(options: argparse.Namespace) -> FamilyWord:
    try:
        return read_family_word(" ".join([options.family or HERMITE.name, *options.setting]))
    except ValueError as problem:
        raise RefusalError(f"--setting must be of {problem}.") from None


def _import_options(options: argparse.Namespace, read: FamilyWord) -> ImportOptions:
    return ImportOptions(
        tolerance=options.tolerance,
        thin=options.thin,
        corners=options.corners,
        family=read.family,
        settings=read.settings,
        columns=columns_to_read(options),
        missing=options.missing,
        only=options.only,
    )


def _convert(options: argparse.Namespace) -> int:
    word = _family_of(options)
    # What is fitted is near all rows, whatever the family: the curve through them is not that.
    read = FamilyWord(HERMITE) if _wants_fit(options) else word

    with _told_on_terminals() as report:
        source = import_file(options.file, _import_options(options, read), report=part(report, 0.0, 0.4))
    with _told_on_terminals() as report:
        document, fits = _fitted(source.document, options, word, part(report, 0.4, 0.7))
        wanted = replace(
            picture_options(options, document),
            own=own_options(options, FORMATS.written),
            report=part(report, 0.7, 1.0),
        )
        written = export(document, options.output, wanted)
    fitted = [f"“{fit.curve.name}”: {fit.words}" for fit in fits]
    remarks = [*source.remarks, *_on_groups(source, options.only), *fitted, *written.remarks]
    off = max((fit.deviation for fit in fits), default=0.0)
    total = exchange.parts.rounded_up(source.deviation + off + written.deviation)
    if options.json:
        _say_json({"output": options.output, "deviation": total, "remarks": remarks})
    else:
        _tell(remarks)
        say(f"{one_line(options.output)}: largest deviation from the true curves {total:g}")
    return 0


def _say_json(content: dict[str, Any]) -> None:
    say(json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False))


def _wants_fit(options: argparse.Namespace) -> bool:
    return options.fit is not None or options.fit_tolerance is not None


def _fitted(
    document: Document, options: argparse.Namespace, word: FamilyWord, report: Report
) -> tuple[Document, list[Fitted]]:
    """Return the document with fewer points, where that was asked for, and what came of each curve."""
    if not _wants_fit(options):
        if options.keep_times:
            raise RefusalError("--keep-times goes with --fit or --fit-tolerance.")
        return document, []
    fits = []
    share = 1.0 / len(document.curves)
    for place, curve in enumerate(document.curves):
        model = replace(curve, family=word.family, settings=word.settings) if options.family else curve
        try:
            fit = fitted_to_curve(
                view_of(curve),
                model,
                count=options.fit,
                tolerance=options.fit_tolerance,
                keeps_times=options.keep_times,
                report=part(report, place * share, (place + 1) * share),
            )
        except EditError as problem:
            raise RefusalError(f"“{curve.name}”: {problem}") from None
        if options.fit_tolerance is not None and fit.deviation > options.fit_tolerance:
            raise RefusalError(
                f"“{curve.name}”: no {model.family.title} curve within {options.fit_tolerance:g} was found; "
                f"the nearest has {fit.words} Try another --family, a larger tolerance, "
                f"or --fit {len(fit.curve.points)}."
            )
        fits.append(fit)
    return replace(document, curves=tuple(fit.curve for fit in fits)), fits


def _on_groups(source: Imported, only: Sequence[str]) -> tuple[str, ...]:
    """Return what could be taken alone, where there are more curves than somebody may have meant."""
    count = len(source.document.curves)
    if only or not source.has_groups or count <= _MANY_CURVES:
        return ()
    return (f"These are {count} curves; --only NAME takes those of a group. There is {source.contents()}.",)


def _info(options: argparse.Namespace) -> int:
    found = _document_of(options)
    document = found.document
    with _told_on_terminals() as report:
        facts = exchange.facts.facts_of(document, report)
    if options.json:
        curves = [facts_as_json(each) for each in facts]
        _say_json(
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


@contextmanager
def _told_on_terminals() -> Iterator[Report]:
    """Lend a report that writes how far work has come to a terminal, from 0.2 s on; the line goes with it."""
    began = last = perf_counter()

    def report(share: float, word: str) -> None:
        nonlocal last
        now = perf_counter()
        if share < 1.0 and sys.stderr.isatty() and now - began > _PATIENCE and now - last > _PATIENCE:
            last = now
            print(f"\r{word}: {share:.0%}\033[K", end="", file=sys.stderr, flush=True)

    try:
        yield report
    finally:
        if last > began:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def _lesson(options: argparse.Namespace) -> int:
    if options.name is None:
        for number, name in enumerate(lesson_names(), start=1):
            say(f"{number:2}  {name.partition('_')[2]:28}{load_lesson(name).title}")
        return 0
    try:
        return cli.start.edit((), find_lesson(options.name))
    except LessonError as problem:
        raise RefusalError(str(problem)) from None


_COMMAND_OF = {"render": _render, "convert": _convert, "info": _info, "lesson": _lesson}
