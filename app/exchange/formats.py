"""The names of the formats, and how to write them; light, for the window's start."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
from msgspec.structs import replace

from app.exchange.drawing import ExchangeError
from app.exchange.svg import INK, LIGHT, Style
from app.tasks.progress import Report, silent

if TYPE_CHECKING:
    from app.exchange.decor import Extras

SUFFIXES = (".png", ".svg", ".pdf")
"""Endings of the pictures that `export` can write."""

ENDINGS = (
    ".curve.json",
    ".coefficients.json",
    ".scipy.py",
    ".py",
    ".pgfplots.tex",
    ".tikz.tex",
    ".tikz",
    ".tex",
    ".desmos.txt",
    ".path.txt",
    ".points.csv",
    ".points.tsv",
    ".csv",
    ".tsv",
    ".dxf",
    ".svg",
    ".png",
    ".pdf",
)
"""Endings of all files that `export` can write; the first that fits counts."""


class Kind(StrEnum):
    """How what is read becomes curves."""

    DOCUMENT = "document"
    DRAWING = "drawing"
    TABLE = "table"


class ImportFormat(msgspec.Struct, frozen=True):
    """A format that is read. To add one is to add its record to `IMPORTS`.

    Attributes
    ----------
    endings
        Of its files, in small letters.
    title
        What people call such files.
    kind
        Drawings are parsed in a child process; of a table somebody says what its columns are.
    load
        Imports the reader, when it is wanted, and returns it. That of a drawing takes the content and the
        tolerance and returns what was `Imported`; that of a table takes the content and returns a `Table`.
        None for documents and for tables of text.
    """

    endings: tuple[str, ...]
    title: str
    kind: Kind
    load: Callable[[], Callable[..., Any]] | None = None


def _svg() -> Callable[..., Any]:
    from app.exchange.svg_in import read_svg  # noqa: PLC0415

    return read_svg


def _dxf() -> Callable[..., Any]:
    from app.exchange.dxf import read_dxf  # noqa: PLC0415

    return read_dxf


def _array() -> Callable[..., Any]:
    from app.exchange.table_array import read_array  # noqa: PLC0415

    return read_array


def _json() -> Callable[..., Any]:
    from app.exchange.table_json import read_json  # noqa: PLC0415

    return read_json


IMPORTS = (
    ImportFormat((".curve.json",), "Curvebench documents", Kind.DOCUMENT),
    ImportFormat((".svg",), "SVG drawings", Kind.DRAWING, _svg),
    ImportFormat((".dxf",), "DXF drawings", Kind.DRAWING, _dxf),
    ImportFormat((".csv", ".tsv", ".txt", ".dat"), "Tables", Kind.TABLE),
    ImportFormat((".npy",), "NumPy arrays", Kind.TABLE, _array),
    ImportFormat((".json", ".geojson"), "JSON and GeoJSON", Kind.TABLE, _json),
)
"""All formats that are read; the first with an ending that fits counts."""

READABLE = tuple(ending for each in IMPORTS for ending in each.endings)
"""Endings of the files that `import_file` can read."""


def import_format(path: str | os.PathLike[str]) -> ImportFormat:
    """Return the format that the ending of a file names.

    Raises
    ------
    ExchangeError
        If it names none.
    """
    ending = ending_of(path, READABLE)
    return next(each for each in IMPORTS if ending in each.endings)


def is_document(data: bytes) -> bool:
    """Whether JSON is, or claims to be, a document of Curvebench."""
    return _DOCUMENT_MARK.search(data[:_MARK_WITHIN]) is not None


_DOCUMENT_MARK = re.compile(rb'"format"\s*:\s*"curvebench"')
_MARK_WITHIN = 4096
"""Bytes in which a document says what it is."""


def can_import(path: Path) -> bool:
    """Whether a file that somebody hands over is to be imported; documents are opened."""
    name = path.name.lower()
    if not name.endswith(READABLE) or import_format(path).kind is Kind.DOCUMENT:
        return False
    return not name.endswith(".json") or (path.is_file() and not _looks_like_document(path))


def _looks_like_document(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return is_document(file.read(_MARK_WITHIN))
    except OSError:
        return True  # whoever opens it says what is wrong with it


SAMPLES = 201
"""Rows of a table of samples, unless asked otherwise."""


class Spacing(StrEnum):
    """How samples are spread along a curve."""

    T = "t"
    LENGTH = "length"
    TOLERANCE = "tolerance"


class Exported(msgspec.Struct, frozen=True):
    """What was written.

    Attributes
    ----------
    deviation
        Largest distance of what the file holds from the true curves, in the document's unit.
    remarks
        One sentence for every curve that was left out.
    pixels
        Width and height of a PNG; None of everything else.
    """

    deviation: float
    remarks: tuple[str, ...] = ()
    pixels: tuple[int, int] | None = None


class Options(msgspec.Struct, frozen=True, kw_only=True):
    """How to write; each format takes what concerns it. See `export`."""

    width: int | None = None
    tolerance: float | None = None
    style: Style | None = None
    points: bool = False
    samples: int = SAMPLES
    spacing: Spacing = Spacing.T
    scale: float = 1.0
    transparent: bool = False
    extras: Extras | None = None
    columns: tuple[str, ...] | None = None
    cubic: bool = False
    unit: str = ""
    report: Report = silent

    def reporting(self, report: Report) -> Options:
        """Return the same options with somebody who hears how far it has come."""
        return replace(self, report=report)

    @property
    def paper_style(self) -> Style:
        """The colours of a PNG, which has paper unless it is to be transparent."""
        style = self.style or LIGHT
        return replace(style, paper=None) if self.transparent else style

    @property
    def vector_style(self) -> Style:
        """The colours of an SVG or PDF, which has paper only where colours were asked for."""
        style = self.style or INK
        return replace(style, paper=None) if self.transparent else style


def ending_of(path: str | os.PathLike[str], endings: tuple[str, ...]) -> str:
    """Return the first of the endings that the name of a file has.

    Raises
    ------
    ExchangeError
        If it has none, or is a folder's.
    """
    name = Path(path).name
    for ending in endings:
        if name.lower().endswith(ending):
            return ending
    if Path(path).is_dir():
        raise ExchangeError(f"“{os.fspath(path)}” is a folder. Choose a file.")
    known = ", ".join(endings[:-1])
    raise ExchangeError(f"The name “{name}” does not end in a known format; use {known} or {endings[-1]}.")


def with_ending(path: Path, ending: str) -> Path:
    """Return `path` so that its name stands for the format of `ending`, one of `ENDINGS`.

    An ending of the same kind gives way: p.csv and p.points.csv are the same name for two formats.
    """
    lower = path.name.lower()
    known = next((each for each in ENDINGS if lower.endswith(each)), "")
    if known == ending:
        return path
    kind = ending[ending.rindex(".") :]
    replaced = known if known.endswith(kind) else kind if lower.endswith(kind) else ""
    stem = path.name[: len(path.name) - len(replaced)]
    # A name that is nothing but an ending is the name of a file all the same.
    return path.with_name((stem or path.name) + ending)
