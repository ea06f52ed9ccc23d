r"""Formats of files, one record each: `FORMATS` finds those that the modules of this package define.

Dialogs, their filters, dropped files and the command line read the registry, and so do the tests: nothing
else lists formats, except the manual. The modules are imported when it is first asked; what takes long to
import (Qt, ezdxf) they import when they use it.

To add a format, add a module here, and a row in the manual (``07_files.md``), which a test shows::

    # app/exchange/formats/gcode.py
    from curvecore import flatten_pieces
    from . import Format, ExportResult
    from ..exported_curves import curves_of
    from ..options import TOLERANCE, Real

    FEED = Real(
        name="feed",
        label="Feed",
        tip="Millimetres per minute",
        help="of G-code: millimetres per minute (default: %(default)s)",
        default=600.0,
        limits=(1.0, 1e5),
    )

    def write(document, options):
        curves, deviation = curves_of(document, options), 0.0
        lines = ["G21", f"F{options[FEED]:g}"]
        for curve in curves:  # the visible ones; the loop reports its progress
            line = flatten_pieces(curve.core, curves.tolerance)
            deviation = max(deviation, line.reached)
            points = curve.core.evaluate(line.parameters).tolist()
            lines += [f"G{int(k > 0)} X{x!r} Y{y!r}" for k, (x, y) in enumerate(points)]
        return ExportResult("\n".join(lines) + "\n", deviation, curves.remarks)

    GCODE = Format(
        endings=(".gcode",),
        title="G-code",
        description="Straight moves for a plotter.",
        rank=125,  # after PGFPlots: lists of formats and the rows of the manual are sorted by it
        options=(TOLERANCE, FEED),
        write=write,
    )

The export form makes a widget for each option and, with a `help`, the command line an argument. An option
that means the same as another format's is that one, imported (`TOLERANCE`, ``tables.SAMPLES``); two different
options of one name are refused.

The deviation is that of the file from the true curves: 0 only if the file, read again, gives the same curves;
`is_bound=False` where it was measured; None if the file holds no curves. Tests over the registry hold every
format to these rules:

- The deviation of a curve of any family is at most the tolerance, or `deviation_limit` times as large.
- A document of one curve is written without a remark; so is a dot, a curve of length 0, unless `writes_dots`
  is False.

A format that is read has `kind` and `read`; one whose files share an ending with another says by
`recognises` which contents are its own. The test to copy is `tests/gui/test_new_format.py` for a format that
is read, `tests/exchange/test_format_recipe.py` for one that is only written; add a round trip to
`tests/exchange`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from ...document.words import distance_text, enumerated
from ...view_model.registry import Registry
from ..errors import ExchangeError

if TYPE_CHECKING:
    from ...document.model import Document
    from ..drawing.image import PicturePreview
    from ..options import Option, Options

DOCUMENT_ENDING = ".curve.json"


@dataclass(frozen=True)
class ExportResult:
    """Result of a writer, ``ExportResult(text, deviation)``: content and accuracy of the file.

    Attributes
    ----------
    content
        Content of the file.
    deviation
        Largest distance of the file's curves from the true ones, in the document's unit; None if the file
        holds no curves.
    is_bound
        Whether the deviation is a bound; otherwise it was measured at many parameters.
    remarks
        One sentence for every curve that was left out.
    pixels
        Width and height of a picture in pixels; None of everything else.
    """

    content: str | bytes
    deviation: float | None = 0.0
    remarks: tuple[str, ...] = ()
    is_bound: bool = True
    pixels: tuple[int, int] | None = None

    @property
    def text(self) -> str:
        """The content of a file of text."""
        return self.content if isinstance(self.content, str) else self.content.decode()

    @property
    def data(self) -> bytes:
        """The content as it stands in the file."""
        return self.content.encode() if isinstance(self.content, str) else self.content

    @property
    def summary(self) -> str:
        """Accuracy of the file, or the pixels of a picture, as text; empty if the file holds no curves."""
        if self.pixels is not None:
            # Pixels are not exact, whatever they were painted from.
            return f"{self.pixels[0]} × {self.pixels[1]} pixels"
        if self.deviation is None:
            return ""
        return distance_text(self.deviation, "the true curve", is_bound=self.is_bound)


class ContentKind(Enum):
    """Way in which a file that is read becomes curves."""

    DOCUMENT = auto()
    DRAWING = auto()
    TABLE = auto()


@dataclass(frozen=True)
class FileKind:
    """A kind of files, known by the endings of their names.

    Attributes
    ----------
    endings
        Endings in lower case; a new file gets the first.
    title
        Name of one file of the kind.
    """

    endings: tuple[str, ...]
    title: str

    @property
    def ending(self) -> str:
        """The ending that a new file gets."""
        return self.endings[0]

    @property
    def patterns(self) -> str:
        """Names of such files, as file dialogs take them."""
        return " ".join(f"*{ending}" for ending in self.endings)


@dataclass(frozen=True, kw_only=True)
class Format(FileKind):
    """A format of documents, as the export and import dialogs have it.

    Attributes
    ----------
    description
        Description in a sentence; a format without one is not in the export dialog.
    rank
        Rank in lists, which are sorted by it.
    options
        Options of the format.
    hidden
        Function of the values, by the options' names, that returns the options without effect.
    write
        Writer; None if the format is not written. Long work reports to `Options.report`.
    preview
        Preview of a picture, of at most so many pixels; see `image.PicturePreview`.
    kind
        Kind of the content that is read; None if such files are not read.
    plural
        Name of such files in the import dialog; by default the title with an s.
    read
        Reader of the content of a file; None for documents and for tables of text. That of a table takes the
        content and returns a `Table`. That of a drawing takes the content and the tolerance and returns an
        `ImportResult`; it stands at the top level of its module, for another process calls it by name.
    recognises
        Test of a content in a file with the ending of another format; None for no such test.
    deviation_limit
        Largest deviation, in multiples of the tolerance: above 1 where the format rounds numbers, infinite
        where its usual options ask for no tolerance.
    writes_dots
        Whether a curve of length 0 is written.
    """

    description: str = ""
    rank: int = 1000
    options: tuple[Option[Any], ...] = ()
    hidden: Callable[[Mapping[str, Any]], Sequence[Option[Any]]] = lambda _values: ()
    write: Callable[[Document, Options], ExportResult] | None = None
    preview: Callable[[Document, Options, tuple[int, int]], PicturePreview] | None = None
    kind: ContentKind | None = None
    plural: str = ""
    read: Callable[..., Any] | None = None
    recognises: Callable[[bytes], bool] | None = None
    deviation_limit: float = 1.0
    writes_dots: bool = True

    @property
    def name(self) -> str:
        """The name in the program: the first ending."""
        return self.ending

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which formats are sorted in lists."""
        return (self.rank,)


class FormatRegistry(Registry[Format]):
    """All formats: those of this package, and in tests one more.

    No two of them write, or read, files of one ending, or have two different options of one name.
    """

    @property
    def written(self) -> tuple[Format, ...]:
        """Formats that are written."""
        return tuple(form for form in self if form.write)

    @property
    def offered(self) -> tuple[Format, ...]:
        """Formats that the export dialog offers."""
        return tuple(form for form in self.written if form.description)

    @property
    def pictures(self) -> tuple[Format, ...]:
        """Formats with a preview."""
        return tuple(form for form in self.written if form.preview)

    @property
    def read(self) -> tuple[Format, ...]:
        """Formats that are read."""
        return tuple(form for form in self if form.kind)

    @staticmethod
    def _sorted(records: Iterable[Format]) -> list[Format]:
        """Return formats by rank; raise `ValueError` where two cannot be told apart."""
        formats = Registry._sorted(records)
        owners: dict[tuple[str, str], tuple[Format, object]] = {}
        for new in formats:
            claims: list[tuple[str, str, object]] = [
                ("write", ending, new) for ending in new.endings if new.write
            ]
            claims += [("read", ending, new) for ending in new.endings if new.kind]
            claims += [("have an option", option.name, option) for option in new.options]
            for verb, name, record in claims:
                owner, claimed = owners.setdefault((verb, name), (new, record))
                if claimed is not record:
                    raise ValueError(f"“{owner.title}” and “{new.title}” both {verb} “{name}”.")
        return formats


FORMATS = FormatRegistry(Format, __name__)


Known = TypeVar("Known", bound=FileKind)


def endings_of(formats: Sequence[FileKind]) -> tuple[str, ...]:
    """Return the endings of all formats."""
    return tuple(ending for form in formats for ending in form.endings)


def format_of(path: str | os.PathLike[str], formats: Sequence[Known]) -> Known:
    """Return the format with the longest ending that the name of a file has, in capitals or not.

    Raises
    ------
    ExchangeError
        If it has none, or names a folder.
    """
    name, endings = Path(path).name, endings_of(formats)
    if ending := _longest(name, endings):
        return next(form for form in formats if ending in form.endings)
    if Path(path).is_dir():
        raise ExchangeError(f"“{os.fspath(path)}” is a folder. Choose a file.")
    known = enumerated(endings, "or")
    raise ExchangeError(f"The name “{name}” has no known file extension; use {known}.")


def _longest(name: str, endings: Sequence[str]) -> str:
    """Return the longest ending that a name has; empty if it has none."""
    return max((ending for ending in endings if name.lower().endswith(ending)), key=len, default="")


def format_in(data: bytes, named: Format) -> Format:
    """Return the format that recognises the content of a file, or else that of its name."""
    return next((form for form in FORMATS.read if form.recognises and form.recognises(data)), named)


def ending_in(path: str | os.PathLike[str], known: Format) -> str:
    """Return the ending of the format that the name of a file has."""
    return _longest(Path(path).name, known.endings)


def typed_format(path: Path, selected: Format) -> Format:
    """Return the format that the ending of a typed name stands for.

    That is the selected one if the name has no known ending, or the last part of the selected one's: p.csv is
    the name of a table of points (``.points.csv``) where that is selected.
    """
    typed = _longest(path.name, endings_of(FORMATS.written))
    if not typed or any(ending.endswith(typed) for ending in selected.endings):
        return selected
    return next(form for form in FORMATS.written if typed in form.endings)


def with_ending(path: Path, form: Format) -> Path:
    """Return `path` with an ending of a format; the last part of one is completed."""
    if ending_in(path, form):
        return path
    typed = path.suffix.lower()
    for ending in form.endings:
        # A name that is only an ending is the name of a file as well, and has no suffix.
        if typed and ending.endswith(typed):
            return path.with_name(path.stem + ending)
    return path.with_name(path.name + form.ending)


_DOCUMENT_MARK = re.compile(rb'"format"\s*:\s*"curvebench"')
_MARK_WITHIN = 4096
"""Number of first bytes that contain the mark of a document."""


def is_document(data: bytes) -> bool:
    """Whether JSON is, or claims to be, a document of Curvebench."""
    beginning = data[:_MARK_WITHIN]
    return beginning.lstrip().startswith(b"{") and _DOCUMENT_MARK.search(beginning) is not None


def file_filters(pictures: str = "") -> str:
    """Return the filters of a file dialog for all files that are read, and for pictures by patterns."""
    read = " ".join(form.patterns for form in FORMATS.read)
    kinds = [f"{form.plural or form.title + 's'} ({form.patterns})" for form in FORMATS.read]
    if pictures:
        everything = f"Curves, tables and pictures ({read} {pictures})"
        return ";;".join([everything, *kinds, f"Pictures ({pictures})", "All files (*)"])
    return ";;".join([f"Curves and tables ({read})", *kinds, "All files (*)"])


def can_import(path: Path) -> bool:
    """Whether a file that is opened or dropped is imported; documents are opened."""
    name = path.name.lower()
    # Before the registry imports all formats: a window that opens a document starts without them.
    if name.endswith(DOCUMENT_ENDING) or not name.endswith(endings_of(FORMATS.read)):
        return False
    try:
        with path.open("rb") as file:
            return not is_document(file.read(_MARK_WITHIN))
    except OSError:
        return not name.endswith(".json")  # to open it reports the error
