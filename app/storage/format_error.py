"""Refusals of the content of a file, in words; and files of other programs, with a remedy."""

from __future__ import annotations

import json
import re
from typing import NamedTuple

from ..document.limits import MAX_MAGNITUDE

_LONGEST_QUOTE = 40


class FormatError(ValueError):
    """The content of a file is not a valid document, or a document cannot be written.

    The message is a clause that follows the name of the file and a colon: "it is not JSON; the file ends too
    early".
    """


# The messages of msgspec end with the path of the field, "- at `$.curves[0].x`".
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
    """Return a message of msgspec about a value as a clause that begins with the path of the field."""
    complaint, _, location = message.partition(" - at `$")
    path = location.rstrip("`").removeprefix(".")
    if match := re.fullmatch(r"Object missing required field `(.*)`", complaint):
        return f"{path}.{match[1]} is missing".removeprefix(".")
    if match := re.fullmatch(r"Object contains unknown field `(.*)`", complaint, re.DOTALL):
        return f"{path or 'the file'} has a key that this version does not know: {quoted(match[1])}"
    return f"{path or 'the file'} {_requirement(complaint)}"


def _requirement(complaint: str) -> str:
    """Return a message of msgspec about a value as a clause that follows the path of the field."""
    if match := re.fullmatch(r"Expected `array` of length (\d+)(?:, got \d+)?", complaint):
        return f"must be a list of {match[1]} numbers"
    if match := re.fullmatch(r"Expected `(.*)`, got `(.*)`", complaint):
        return f"must be {_kinds(match[1])}, not {_kinds(match[2])}"
    if match := re.fullmatch(r"Invalid enum value (.*)", complaint, re.DOTALL):
        return f"is not a value that this version knows: {quoted(match[1].strip(chr(39)))}"
    if complaint in ("Number out of range", "Integer value out of range"):
        return RANGE
    return f"is not valid: {complaint}"


def _kinds(names: str) -> str:
    """Return types as msgspec writes them, ``float | null``, in words."""
    return " or ".join(_TYPES.get(name, name) for name in names.split(" | "))


def not_json(message: str, data: bytes) -> str:
    """Return a message of msgspec about malformed JSON as a clause with line and column."""
    match = re.fullmatch(r"JSON is malformed: (.*) \(byte (\d+)\)", message)
    if match is None:
        return "it is not JSON; the file ends too early"
    return f"it is not JSON; {line_and_column(data, int(match[2]))}: {match[1]}"


def line_and_column(data: bytes, position: int) -> str:
    """Return the line and column of a byte, as a text editor shows them."""
    line = data.count(b"\n", 0, position) + 1
    line_start = data.rfind(b"\n", 0, position) + 1
    column = len(data[line_start:position].decode("utf-8", "replace")) + 1
    return f"line {line}, column {column}"


def quoted(text: str) -> str:
    """Return a text in quotation marks, shortened if it is long."""
    text = shortened(text)
    return json.dumps(text, ensure_ascii=not text.isprintable())


def shortened(text: str) -> str:
    """Return a text, shortened if it is long."""
    return text if len(text) <= _LONGEST_QUOTE else f"{text[:_LONGEST_QUOTE]}…"


# Files of other programs


class ForeignFormat(NamedTuple):
    """Format of another program that cannot be opened.

    Attributes
    ----------
    title
        Its name with an article: "a PDF".
    endings
        Lower-case endings of its files, unless another command opens them.
    marks
        First bytes of its files.
    advice
        Advice that follows “it is a PDF, ”.
    """

    title: str
    endings: tuple[str, ...]
    marks: tuple[bytes, ...]
    advice: str


_BY_INKSCAPE = "which Curvebench cannot read; open it in Inkscape and save it as SVG"
_IMAGE = "which is not a document; use File › Import for it"

FOREIGN_FORMATS = (
    ForeignFormat("a PDF", (".pdf",), (b"%PDF-",), _BY_INKSCAPE),
    ForeignFormat("an Illustrator drawing", (".ai",), (), _BY_INKSCAPE),
    ForeignFormat("PostScript", (".eps", ".ps"), (b"%!PS", b"\xc5\xd0\xd3\xc6"), _BY_INKSCAPE),
    ForeignFormat("a CorelDRAW drawing", (".cdr",), (), _BY_INKSCAPE),
    ForeignFormat("a compressed file", (), (b"\x1f\x8b",), "which is not a document"),
    ForeignFormat("a PNG picture", (), (b"\x89PNG",), _IMAGE),
    ForeignFormat("a JPEG picture", (), (b"\xff\xd8\xff",), _IMAGE),
)


def foreign_content_clause(data: bytes) -> str:
    """Return the clause that content of a foreign format cannot be opened; empty for other content."""
    return next((_clause(kind) for kind in FOREIGN_FORMATS if kind.marks and data.startswith(kind.marks)), "")


def foreign_name_clause(name: str) -> str:
    """Return the clause that a file of a foreign format, by its name, cannot be opened; empty for others."""
    name = name.lower()
    return next(
        (_clause(kind) for kind in FOREIGN_FORMATS if kind.endings and name.endswith(kind.endings)), ""
    )


def _clause(kind: ForeignFormat) -> str:
    return f"it is {kind.title}, {kind.advice}"
