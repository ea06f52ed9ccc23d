"""The options of the command line: numbers, pictures, films and tables."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable
from typing import Any

from ..document.lengths import MILLIMETRES, known_unit
from ..document.model import Document
from ..document.words import enumerated
from ..exchange.drawing.styles import DARK, LIGHT, ON_PAPER
from ..exchange.errors import ExchangeError
from ..exchange.formats import FORMATS, Format, endings_of
from ..exchange.formats.tables import COLUMNS
from ..exchange.options import AUTOMATIC, Check, OneOf, Option, Options, Real, SomeOf, Whole, all_options
from ..families import FAMILIES, HERMITE

STYLES = {"light": LIGHT, "dark": DARK}


def whole_number(text: str) -> int:
    """Return the positive whole number that was typed."""
    return int(_positive(text, int))


def _family_name(text: str) -> str:
    """Return the name of the family that was typed, by its name or its title."""
    if (family := FAMILIES.called(text)) is None:
        known = enumerated([family.name for family in FAMILIES], "or")
        raise argparse.ArgumentTypeError(f"“{text}” is not a family; use {known}")
    return family.name


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


POSITIVE: dict[str, Any] = {"type": positive_number, "metavar": "X"}
"""Arguments of `add_argument` for a positive number."""


def _unit(text: str) -> str:
    """Return the unit of length that was typed."""
    if not (unit := known_unit(text)):
        raise argparse.ArgumentTypeError(f"“{text}” is not one of {', '.join(MILLIMETRES)}")
    return unit


def add_picture_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of pictures to a command."""
    _add_size_options(parser)
    _add_look_options(parser)


def _add_size_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "--only",
        action="append",
        default=[],
        metavar="NAME",
        help="use only the curves with this name, or in a group with this name or id, such as axes_1 or "
        "'line2d_*'; can be repeated",
    )
    sides = parser.add_mutually_exclusive_group()
    sides.add_argument(
        "--width",
        type=whole_number,
        metavar="N",
        help="in pixels, which with a unit also set the resolution; for a PDF in points of 1/72 inch",
    )
    add(
        "--unit",
        type=_unit,
        metavar="U",
        help=f"unit of length ({', '.join(MILLIMETRES)}) for a document without one: SVG and PDF without "
        "--width, and TikZ, then have true size; PNG states its pixels per inch; DXF states the unit",
    )
    sides.add_argument(
        "--dpi",
        **POSITIVE,
        help="pixels of a PNG per inch of its true size, for a document with a unit; not with --width",
    )
    add(
        "--scale",
        **POSITIVE,
        default=1.0,
        help="pixels of a PNG per unit of its width, and per 1/96 inch (default: 1)",
    )


def _add_look_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add(
        "--theme",
        choices=STYLES,
        help="colours and paper (default: those of the document, or dark ink without paper)",
    )
    add("--transparent", action="store_true", help="omit the paper of --theme")
    add(
        "--points",
        action=argparse.BooleanOptionalAction,
        default=False,
        help="draw the points, also in a DXF",
    )
    add("--handles", action="store_true", help="draw the Bézier control points")
    add("--grid", action="store_true", help="draw a grid")
    add(
        "--basis",
        type=whole_number,
        nargs="?",
        const=1,
        metavar="N",
        help="draw the basis functions of the N-th curve below the picture (default: the first)",
    )


def add_motion_options(render: argparse.ArgumentParser) -> None:
    """Add the options of films to `render`."""
    add = render.add_argument_group(
        "motion",
        "A dot that moves along the first curve: OUT is a .gif, .apng or .mp4, or a .png with --motion.",
    ).add_argument
    add("--motion", choices=("once", "loop", "ping-pong"), help="the motion at the end (default: loop)")
    add("--pace", choices=("t", "length"), default="t", help="quantity that grows uniformly (default: t)")
    add("--fps", type=whole_number, default=25, metavar="N", help="frames per second (default: 25)")
    add(
        "--seconds",
        type=positive_number,
        metavar="S",
        help="duration of one round (default: the length of the domain)",
    )


CONVERT = """\
Read a file of one format and write another; print the largest deviation from the true curves. With --to,
convert many files: a file that cannot be converted is reported in one line, the others are converted, and
the exit code is 1."""

_CONVERT_USAGE = """\
curvebench convert IN OUT [options]
       curvebench convert IN ... -o FOLDER --to ENDING [-j N] [options]"""


def add_convert_options(convert: argparse.ArgumentParser) -> None:
    """Add files and the options of tables and pictures to `convert`."""
    convert.usage = _CONVERT_USAGE
    convert.set_defaults(parser=convert)  # for errors about its files
    add = convert.add_argument
    read, written = (", ".join(endings_of(formats)) for formats in (FORMATS.read, FORMATS.written))
    add(
        "files",
        nargs="+",
        metavar="IN OUT",
        help=f"the file to read, whose name ends in {read}, and the file to write; with --to, files to read",
    )
    add("-o", "--output", metavar="FOLDER", help="with --to: the folder of the files; created if needed")
    add(
        "--to",
        metavar="ENDING",
        help=f"write a file for each file that is read, with this ending: {written}",
    )
    add(
        "-j",
        "--jobs",
        type=whole_number,
        metavar="N",
        help="with --to: read N drawings at a time (default: by their size, at most one per processor)",
    )
    add(
        "--tolerance",
        **POSITIVE,
        help=f"largest deviation where a format cannot hold the curve itself (default: {AUTOMATIC})",
    )
    add(
        "--json",
        action="store_true",
        help="print the result as JSON, with everything that was left out or changed",
    )
    _add_table_options(convert)
    _add_fit_options(convert)
    add_picture_options(convert)
    add_format_options(convert, FORMATS.written)


def convert_usage_problem(options: argparse.Namespace) -> str:
    """Return the problem of the files that were named; empty for IN OUT, and for many with --to."""
    if options.to is not None:
        return "" if options.output is not None else "--to needs a folder: -o FOLDER"
    if options.output is not None or options.jobs is not None:
        return "-o and -j need --to ENDING"
    match len(options.files):
        case 1:
            return "the following arguments are required: OUT"
        case 2:
            return ""
    return "many files need -o FOLDER --to ENDING"


_DEST = "own_"
"""Before the names of options of single formats, beside those that all have."""


def add_format_options(parser: argparse.ArgumentParser, formats: Iterable[Format]) -> None:
    """Add the options of single formats to a command."""
    for option in _listed_options(formats):
        try:
            parser.add_argument(option.flag, dest=f"{_DEST}{option.name}", help=option.help, **_typed(option))
        except argparse.ArgumentError as problem:
            raise ValueError(f"“{option.name}” of a format needs another flag: {problem}") from None


def _listed_options(formats: Iterable[Format]) -> list[Option[Any]]:
    """Return the options of single formats that the command line has."""
    return [option for option in all_options(form.options for form in formats) if option.help]


def _typed(option: Option[Any]) -> dict[str, Any]:
    """Return the arguments of `add_argument` for an option."""
    match option:
        case Check():
            return {"action": argparse.BooleanOptionalAction if option.default else "store_true"}
        case OneOf():
            return {"choices": [str(choice) for choice in option.choices], "default": str(option.default)}
        case SomeOf():
            return {"type": _some_of(option), "default": option.default, "metavar": "A,B"}
        case Whole():
            return {
                "type": _parser_within_limits(option, int, "whole number"),
                "default": option.default,
                "metavar": "N",
            }
        case Real():
            return {
                "type": _parser_within_limits(option, float, "number"),
                "default": option.default,
                "metavar": "X",
            }
    raise NotImplementedError(f"{type(option).__name__} is not an argument of the command line")


def _parser_within_limits(
    option: Whole | Real, kind: Callable[[str], float], words: str
) -> Callable[[str], float]:
    """Return a parser of numbers within the limits of an option."""
    least, greatest = option.limits

    def read(text: str) -> float:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not least <= value <= greatest:
            raise argparse.ArgumentTypeError(f"“{text}” is not a {words} from {least:g} to {greatest:g}")
        return value

    return read


def _some_of(option: SomeOf) -> Callable[[str], tuple[str, ...]]:
    """Return a parser of some of the choices of an option, with commas between."""

    def read(text: str) -> tuple[str, ...]:
        words = tuple(text.split(","))
        if not set(words) <= set(option.choices):
            raise argparse.ArgumentTypeError(f"“{text}” can only contain {', '.join(option.choices)}")
        return words

    return read


def options_of_formats(options: argparse.Namespace, formats: Iterable[Format]) -> dict[str, Any]:
    """Return the values of the options of single formats, by their names."""
    listed = _listed_options(formats)
    values = {option.name: getattr(options, f"{_DEST}{option.name}") for option in listed}
    for option in listed:
        if isinstance(option, OneOf):
            values[option.name] = next(one for one in option.choices if str(one) == values[option.name])
    if columns := _columns_to_write(options):
        values[COLUMNS.name] = columns
    return values


def _settings_text() -> str:
    """Return the settings of each family with their values, as text."""
    return "; ".join(
        f"{family} {setting.name}, {setting.requirement} (default: {setting.default})"
        for family in FAMILIES
        for setting in family.settings.all
    )


def _add_table_options(convert: argparse.ArgumentParser) -> None:
    add = convert.add_argument
    add(
        "--thin",
        **POSITIVE,
        help="keep only as many rows of a table as a curve within X of all rows needs",
    )
    add(
        "--corners",
        action="store_true",
        help="with --thin: keep the corners of a polyline within X of all rows (Douglas-Peucker)",
    )
    add(
        "--family",
        type=_family_name,
        metavar="NAME",
        help=f"family of a curve through the rows of a table (default: {HERMITE.name}), or of the curves of "
        "--fit and --fit-tolerance (default: that of each curve): "
        f"{enumerated([family.name for family in FAMILIES], 'or')}",
    )
    add(
        "--setting",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help=f"setting of that family: {_settings_text()}",
    )
    add(
        "--columns",
        action="append",
        default=[],
        metavar="A,B",
        help="of a table to read: the role of each column, by title or number, as in t=time,x=pos_x,y=3; of "
        "a table of samples to write: the columns t, x, y, vx, vy, ax, ay, jx, jy, curvature, length",
    )
    add(
        "--missing",
        choices=("refuse", "skip", "split"),
        default="refuse",
        help="rows without numbers: report an error, skip them or end the curve there (default: refuse)",
    )


def _add_fit_options(convert: argparse.ArgumentParser) -> None:
    group = convert.add_argument_group(
        "fewer points", "Fit curves of fewer points to those that were read, by least squares."
    )
    choice = group.add_mutually_exclusive_group()
    choice.add_argument("--fit", type=_two_or_more, metavar="K", help="K points for each curve")
    choice.add_argument(
        "--fit-tolerance",
        **POSITIVE,
        help="the fewest points for each curve that stay within X of the original",
    )
    group.add_argument(
        "--keep-times",
        action="store_true",
        help="with --fit or --fit-tolerance: keep the t of every position, as in motion, not only the shape",
    )


def _two_or_more(text: str) -> int:
    """Return the number of points that was typed."""
    if (count := whole_number(text)) < 2:
        raise argparse.ArgumentTypeError("a curve has at least two points")
    return count


def columns_to_read(options: argparse.Namespace) -> str:
    """Return the columns with a role, as in “x=2”."""
    return ",".join(column for column in options.columns if "=" in column)


def _columns_to_write(options: argparse.Namespace) -> tuple[str, ...]:
    """Return the columns to write, without a role; none for all, and for commands without tables."""
    columns = getattr(options, "columns", ())
    return tuple(name for column in columns if "=" not in column for name in column.split(","))


def picture_options(options: argparse.Namespace, document: Document) -> Options:
    """Return the options of the file to write."""
    if options.basis and options.basis > len(document.curves):
        raise ExchangeError(f"There is no curve {options.basis}; the document has {len(document.curves)}.")
    style = STYLES[options.theme] if options.theme else ON_PAPER.get(document.paper)
    return Options(
        width=options.width,
        tolerance=options.tolerance,
        style=style,
        points=options.points,
        dpi=options.dpi,
        scale=options.scale,
        unit=options.unit or document.unit,
        # As in the window: without a theme, and where the document has none, there is no paper.
        transparent=options.transparent or not style,
        handles=options.handles,
        grid=options.grid,
        basis=options.basis - 1 if options.basis else None,
    )
