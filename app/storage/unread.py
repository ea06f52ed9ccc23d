"""Files of other programs that are not read here, and what to do with them."""

from __future__ import annotations

from typing import NamedTuple


class Unread(NamedTuple):
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

UNREAD = (
    Unread("a PDF", (".pdf",), (b"%PDF-",), _BY_INKSCAPE),
    Unread("an Illustrator drawing", (".ai",), (), _BY_INKSCAPE),
    Unread("PostScript", (".eps", ".ps"), (b"%!PS", b"\xc5\xd0\xd3\xc6"), _BY_INKSCAPE),
    Unread("a CorelDRAW drawing", (".cdr",), (), _BY_INKSCAPE),
    Unread("a compressed file", (), (b"\x1f\x8b",), "which is no document"),
    Unread("a PNG picture", (), (b"\x89PNG",), _PLACED),
    Unread("a JPEG picture", (), (b"\xff\xd8\xff",), _PLACED),
)


def clause_about(data: bytes) -> str:
    """Return, as a clause, why a file with this content is not read; empty of what may be."""
    return next((_clause(each) for each in UNREAD if each.marks and data.startswith(each.marks)), "")


def clause_about_name(name: str) -> str:
    """Return, as a clause, why a file of this name is not read; empty of what may be."""
    name = name.lower()
    return next((_clause(each) for each in UNREAD if each.endings and name.endswith(each.endings)), "")


def _clause(kind: Unread) -> str:
    return f"it is {kind.title}, {kind.advice}"
