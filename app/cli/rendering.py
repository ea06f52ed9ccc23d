"""The command ``render``: pictures and films."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from .. import exchange
from ..document.words import enumerated
from ..exchange.drawing.film import FILMS, Film, first_round, write_film
from ..exchange.drawing.styles import LIGHT, ON_PAPER
from ..exchange.files import export
from ..exchange.formats import FORMATS, endings_of
from ..exchange.options import AUTOMATIC
from ..view_model.motion_settings import Pace, Repeat
from .documents import document_of
from .options import (
    POSITIVE,
    STYLES,
    add_format_options,
    add_motion_options,
    add_picture_options,
    options_of_formats,
    picture_options,
)
from .output import RefusalError, TerminalProgress, print_remarks

if TYPE_CHECKING:
    from ..document.model import Document


def add_options(render: argparse.ArgumentParser) -> None:
    """Add files and the options of pictures and films to `render`."""
    render.add_argument("file", metavar="FILE")
    render.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="OUT",
        help=f"the file to write; its name ends in {', '.join(_picture_endings())}",
    )
    render.add_argument(
        "--tolerance",
        **POSITIVE,
        help=f"largest deviation from the true curves, in the document's unit (default: {AUTOMATIC})",
    )
    add_picture_options(render)
    add_format_options(render, FORMATS.pictures)
    add_motion_options(render)


def _drawn_document(options: argparse.Namespace) -> Document:
    """Return the document to draw: all of it, or the curves that --only names."""
    document = document_of(options.file).document
    if options.only:
        document = exchange.cubics_in.ImportResult(document).named(options.only).document
    return document


def render(options: argparse.Namespace) -> int:
    """Write the picture or film that was asked for, and return the exit code."""
    name = options.output.lower()
    pictures, films = endings_of(FORMATS.pictures), endings_of(FILMS)
    # An ending of both is a film where a motion is asked for.
    if name.endswith(films) and (options.motion or not name.endswith(pictures)):
        return _render_film(options)
    if not name.endswith(pictures):
        if Path(options.output).is_dir():
            raise RefusalError(f"“{options.output}” is a folder. Choose a file.")
        known = enumerated(_picture_endings(), "or")
        raise RefusalError(f"“{options.output}” has no known file extension for pictures; use {known}.")
    document = _drawn_document(options)
    with TerminalProgress() as report:
        values = options_of_formats(options, FORMATS.pictures)
        picture = replace(picture_options(options, document), format_options=values)
        result = export(document, options.output, picture.reporting(report))
    print_remarks(result.remarks)
    return 0


def _picture_endings() -> tuple[str, ...]:
    """Return the endings of the files that `render` writes, each once."""
    return tuple(dict.fromkeys((*endings_of(FORMATS.pictures), *endings_of(FILMS))))


def _render_film(options: argparse.Namespace) -> int:
    document, repeat = _drawn_document(options), Repeat(options.motion or "loop")
    film = Film(
        width=options.width or Film.width,
        fps=options.fps,
        seconds=options.seconds or first_round(document, repeat),
        repeat=repeat,
        pace=Pace(options.pace),
        style=STYLES[options.theme] if options.theme else ON_PAPER.get(document.paper, LIGHT),
        points=options.points,
    )
    write_film(document, options.output, film)
    return 0
