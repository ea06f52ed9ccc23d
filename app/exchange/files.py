"""Files in the formats that their names end in, read and written; drawings are parsed in a child process."""

from __future__ import annotations

import os
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from .. import exchange
from ..document.model import Document
from ..families import HERMITE, NO_SETTINGS, Family, FamilySettingValues
from ..storage.files import document_in, read, write
from ..storage.format_error import FormatError, foreign_name_clause
from ..tasks.progress import FINAL, Report, silent
from . import table
from .errors import ExchangeError
from .formats import FORMATS, ContentKind, ExportResult, Format, ending_in, format_in, format_of
from .options import DEFAULT, Options

if TYPE_CHECKING:
    from .cubics_in import ImportResult
    from .reader_process import ReaderProcess


@dataclass(frozen=True)
class ImportOptions:
    """Options of imports; each format uses those that concern it.

    Attributes
    ----------
    tolerance
        Drawings: largest distance from arcs and the like, in the file's unit.
    thin
        Tables: thin the rows out to a curve within this distance of all; by default all are kept.
    corners
        Tables: thin the rows out to the corners of a polyline, not to a smooth curve.
    family
        Tables: family of the curve, unless a column names one.
    settings
        Tables: settings of that family other than its defaults.
    columns
        Tables: roles of the columns, as "t=time,x=pos_x,y=3", by title or number; by default those that
        their titles name.
    missing
        Tables: "skip" to leave out rows without numbers, "split" to begin another curve after them.
    only
        Names of the curves or groups to import, such as "line2d_*"; by default all.
    """

    tolerance: float | None = None
    thin: float | None = None
    corners: bool = False
    family: Family = HERMITE
    settings: FamilySettingValues = NO_SETTINGS
    columns: str = ""
    missing: str = "refuse"
    only: Sequence[str] = ()


@dataclass(frozen=True)
class ForeignFile:
    """File that is to be imported.

    Attributes
    ----------
    name
        Name without the ending.
    form
        The format, by the content, or else by the ending.
    data
        The content.
    """

    name: str
    form: Format
    data: bytes


def foreign_file(path: str | os.PathLike[str]) -> ForeignFile:
    """Return a file and its format.

    Raises
    ------
    ExchangeError
        For an unknown ending.
    StorageError
        If the file cannot be read.
    """
    named, data = format_to_read(path), read(path)
    return ForeignFile(Path(path).name[: -len(ending_in(path, named))], format_in(data, named), data)


def begin_import(path: str | os.PathLike[str], options: ImportOptions, process: ReaderProcess) -> None:
    """Begin to read a drawing in a process; `import_file` waits for the result or raises its error."""
    with suppress(ExchangeError, OSError, MemoryError):
        file = foreign_file(path)
        if file.form.kind is ContentKind.DRAWING:
            assert file.form.read is not None
            process.begin(file.form.read, file.data, options.tolerance)


def import_file(
    path: str | os.PathLike[str],
    options: ImportOptions | None = None,
    *,
    report: Report = silent,
    process: ReaderProcess | None = None,
) -> ImportResult:
    """Return the curves in a file of the format that its ending names.

    Parameters
    ----------
    path, options
        The file, and the options of its format.
    report
        Called now and then; may raise `Cancelled`.
    process
        Process that reads drawings; by default one for this file alone.

    Raises
    ------
    ExchangeError
        For an unknown ending, or with the position in the file and the reason; for a table whose columns
        have unknown roles.
    StorageError
        If the file cannot be read at all.
    """
    options = options or ImportOptions()
    format_to_read(path)  # its refusal names the file
    try:
        result = _content_of(Path(path), foreign_file(path), options, report, process)
    except (FormatError, ExchangeError) as problem:
        raise ExchangeError(f"“{Path(path).name}” cannot be read: {problem}") from problem
    except MemoryError:
        raise ExchangeError(f"“{Path(path).name}” needs more memory than is available.") from None
    return result.named(options.only) if options.only else result


def format_to_read(path: str | os.PathLike[str]) -> Format:
    """Return the format of a file that is read.

    Raises
    ------
    ExchangeError
        For an unknown ending; for known kinds that are not read the message says what to do.
    """
    if clause := foreign_name_clause(os.fspath(path)):
        raise ExchangeError(f"{clause[0].upper()}{clause[1:]}.")
    return format_of(path, FORMATS.read)


def _content_of(
    path: Path,
    file: ForeignFile,
    options: ImportOptions,
    report: Report,
    process: ReaderProcess | None,
) -> ImportResult:
    form = file.form
    if form.kind is ContentKind.DOCUMENT:
        opened = document_in(file.data, path)
        remarks = (opened.left_out.sentence(path.name),) if opened.left_out else ()
        return exchange.cubics_in.ImportResult(opened.document, remarks=remarks)
    if form.kind is ContentKind.DRAWING:
        assert form.read is not None
        read_in_process = exchange.reader_process.read_in_process if process is None else process.read
        return read_in_process(form.read, file.data, options.tolerance, report=report)
    return table.source.import_table(
        file.name, table.source.TableSource(file.data, form.read), options, report
    )


def export(document: Document, path: str | os.PathLike[str], options: Options = DEFAULT) -> ExportResult:
    """Write a document with at least one curve that can be drawn.

    Raises
    ------
    ExchangeError
        For an unknown ending, or if the document cannot be written in that format.
    StorageError
        If the file cannot be written; an old one stays unchanged.
    """
    options = replace(options, path=os.fspath(path))
    if options.width is not None and options.width < 1:
        raise ExchangeError("The width must be at least 1.")
    form = format_of(path, FORMATS.written)
    options.report(0.0, "Writing")
    assert form.write is not None
    written = form.write(document, options)
    options.report(FINAL, "Writing")
    write(path, written.data)
    return written
