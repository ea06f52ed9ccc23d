"""Options of the command line that several commands share: numbers, and what goes into a picture."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from app.document.model import Document
from app.exchange import DARK, LIGHT, ExchangeError, Options

if TYPE_CHECKING:
    from app.exchange.decor import Extras

STYLES = {"light": LIGHT, "dark": DARK}


def whole_number(text: str) -> int:
    """Return the positive whole number that was typed."""
    return int(_positive(text, int))


def positive_number(text: str) -> float:
    """Return the positive number that was typed."""
    return _positive(text, float)


def _positive(text: str, kind: type[int] | type[float]) -> float:
    try:
        value = kind(text)
    except ValueError:
        value = 0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"“{text}” is not a positive number")
    return value


def add_picture_options(parser: argparse.ArgumentParser) -> None:
    """Let a command take the options of pictures."""
    parser.add_argument(
        "--width", type=whole_number, metavar="N", help="in pixels; in points of 1/72 inch for a PDF"
    )
    parser.add_argument(
        "--scale",
        type=positive_number,
        default=1.0,
        metavar="X",
        help="pixels of a PNG for each of the width, and for 1/96 inch (default: 1)",
    )
    parser.add_argument(
        "--theme", choices=STYLES, help="colours, paper included (default: light; no paper in SVG and PDF)"
    )
    parser.add_argument("--transparent", action="store_true", help="leave the paper out")
    parser.add_argument(
        "--points",
        action=argparse.BooleanOptionalAction,
        default=False,
        help="draw the points too; in a DXF as well",
    )
    parser.add_argument("--handles", action="store_true", help="draw the Bézier control points")
    parser.add_argument("--grid", action="store_true", help="draw a grid")
    parser.add_argument(
        "--basis",
        type=whole_number,
        nargs="?",
        const=1,
        metavar="N",
        help="draw the basis functions of the N-th curve below the picture (default: the first)",
    )


def picture_options(options: argparse.Namespace, document: Document) -> Options:
    """Return what was asked for of the file to write."""
    return Options(
        width=options.width,
        tolerance=options.tolerance,
        style=STYLES[options.theme] if options.theme else None,
        points=options.points,
        scale=options.scale,
        transparent=options.transparent,
        extras=_extras(options, document),
    )


def _extras(options: argparse.Namespace, document: Document) -> Extras | None:
    if not (options.handles or options.grid or options.basis):
        return None
    from app.exchange.decor import Extras  # noqa: PLC0415

    if options.basis and options.basis > len(document.curves):
        raise ExchangeError(f"There is no curve {options.basis}; the document has {len(document.curves)}.")
    return Extras(options.handles, options.grid, options.basis - 1 if options.basis else None)
