"""Refusals of the content of a file, in words; and files of other programs, with what to do with them."""

from __future__ import annotations

import json
import re
from typing import NamedTuple

from ..document.limits import MAX_MAGNITUDE

_LONGEST_QUOTE = 40


class FormatError(ValueError):
    """The bytes are no Curvebench document, or the values cannot be written as one.

    The message is a clause to follow the file's name and a colon: "it is not JSON; the file ends too early".
    """


# What msgspec says, and the same for people. Its message ends with the place, "- at `$.curves[0].x`".
RANGE = f"must lie between -{MAX_MAGNITUDE:g} and {MAX_MAGNITUDE:g}".replace("e+", "e")
_TYPES = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "array": "a list",
    "object": "an object {…}",
    "bool": "true or false",
    "null": "null",
}


def in_words(message: str) -> str:
    """Return msgspec's objection to a value as a sentence that starts with the place in the file."""
    complaint, _, path = message.partition(" - at `$")
    place = path.rstrip("`").removeprefix(".")
    if match := re.fullmatch(r"Object missing required field `(.*)`", complaint):
        return f"{place}.{match[1]} is missing".removeprefix(".")
    if match := re.fullmatch(r"Object contains unknown field `(.*)`", complaint, re.DOTALL):
        return f"{place or 'the file'} has a key that this version does not know: {quoted(match[1])}"
    return f"{place or 'the file'} {_requirement(complaint)}"


def _requirement(complaint: str) -> str:
    """Return what msgspec says of a value as a clause that follows its place."""
    if match := re.fullmatch(r"Expected `array` of length (\d+)(?:, got \d+)?", complaint):
        return f"must be a list of {match[1]} numbers"
    if match := re.fullmatch(r"Expected `(.*)`, got `(.*)`", complaint):
        return f"must be {_kinds(match[1])}, not {_kinds(match[2])}"
    if match := re.fullmatch(r"Invalid enum value (.*)", complaint, re.DOTALL):
        return f"is not a choice that this version knows: {quoted(match[1].strip(chr(39)))}"
    if complaint in ("Number out of range", "Integer value out of range"):
        return RANGE
    return f"is not valid: {complaint}"


def _kinds(names: str) -> str:
    """Return msgspec's ``float | null`` in words."""
    return " or ".join(_TYPES.get(name, name) for name in names.split(" | "))


def not_json(message: str, data: bytes) -> str:
    """Return msgspec's objection to the text with its line and column."""
    match = re.fullmatch(r"JSON is malformed: (.*) \(byte (\d+)\)", message)
    if match is None:
        return "it is not JSON; the file ends too early"
    return f"it is not JSON; {line_and_column(data, int(match[2]))}: {match[1]}"


def line_and_column(data: bytes, position: int) -> str:
    """Return the place of a byte as an editor of text shows it."""
    line = data.count(b"\n", 0, position) + 1
    line_start = data.rfind(b"\n", 0, position) + 1
    column = len(data[line_start:position].decode("utf-8", "replace")) + 1
    return f"line {line}, column {column}"


def quoted(text: str) -> str:
    """Return text in quotation marks, shortened where it is long."""
    text = shortened(text)
    return json.dumps(text, ensure_ascii=not text.isprintable())


def shortened(text: str) -> str:
    """Return text, or its beginning where it is long."""
    return text if len(text) <= _LONGEST_QUOTE else f"{text[:_LONGEST_QUOTE]}…"


# Files of other programs


class ForeignFormat(NamedTuple):
    """A kind of files.

    Attributes
    ----------
    title
        What one of them is.
    endings
        Of their names, in small letters; none of those that other ways lead to.
    marks
        What the file begins with.
    advice
        What to do, to follow “it is a PDF, ”.
    """

    title: str
    endings: tuple[str, ...]
    marks: tuple[bytes, ...]
    advice: str


_BY_INKSCAPE = "which is not read here; open it in Inkscape and save it as SVG"
_PLACED = "which is no document; File › Import takes it"

FOREIGN_FORMATS = (
    ForeignFormat("a PDF", (".pdf",), (b"%PDF-",), _BY_INKSCAPE),
    ForeignFormat("an Illustrator drawing", (".ai",), (), _BY_INKSCAPE),
    ForeignFormat("PostScript", (".eps", ".ps"), (b"%!PS", b"\xc5\xd0\xd3\xc6"), _BY_INKSCAPE),
    ForeignFormat("a CorelDRAW drawing", (".cdr",), (), _BY_INKSCAPE),
    ForeignFormat("a compressed file", (), (b"\x1f\x8b",), "which is no document"),
    ForeignFormat("a PNG picture", (), (b"\x89PNG",), _PLACED),
    ForeignFormat("a JPEG picture", (), (b"\xff\xd8\xff",), _PLACED),
)


def foreign_content_clause(data: bytes) -> str:
    """Return, as a clause, why a file with this content is not read; empty of what may be."""
    return next((_clause(each) for each in FOREIGN_FORMATS if each.marks and data.startswith(each.marks)), "")


def foreign_name_clause(name: str) -> str:
    """Return, as a clause, why a file of this name is not read; empty of what may be."""
    name = name.lower()
    return next(
        (_clause(each) for each in FOREIGN_FORMATS if each.endings and name.endswith(each.endings)), ""
    )


def _clause(kind: ForeignFormat) -> str:
    return f"it is {kind.title}, {kind.advice}"
