"""Reading: the name of a file decides how it is read; foreign drawings are parsed in a child process."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.exchange.drawing import ExchangeError
from app.exchange.formats import Kind, ending_of, import_format, is_document
from app.families import HERMITE, Family
from app.storage.files import read
from app.storage.format import FormatError, decode
from app.storage.image_path import resolved
from app.tasks.progress import Report, part, silent

if TYPE_CHECKING:
    from app.exchange.cubics_in import Imported


def import_file(
    path: str | os.PathLike[str],
    *,
    tolerance: float | None = None,
    thin: float | None = None,
    corners: bool = False,
    family: Family = HERMITE,
    columns: str = "",
    missing: str = "refuse",
    only: Sequence[str] = (),
    report: Report = silent,
) -> Imported:
    """Return the curves in a file of the format that its ending names.

    Parameters
    ----------
    path
        A file with one of the endings `READABLE`, in capitals or not.
    tolerance
        Of drawings: largest distance from arcs and the like, in the file's unit.
    thin
        Of tables: thin the rows out to a curve within this distance of all; by default none are left out.
    corners
        Of tables: thin them out to the corners of a polyline, not to a smooth curve.
    family
        Of tables: the curve's family, unless a column says it.
    columns
        Of tables: which column is what, as "t=time,x=pos_x,y=3", by title or number from 1; by default what
        their titles say.
    missing
        Of tables: "skip" to leave out rows without numbers, "split" to begin another curve after them.
    only
        The names of curves, or of groups of them, that are taken, such as "line2d_*"; by default all are.
    report
        Hears how far it has come.

    Raises
    ------
    ExchangeError
        For an unknown ending, or with the place in the file and the reason; for a table of which nobody
        knows what its columns are.
    StorageError
        If the file cannot be read at all.
    """
    kind = import_format(path).kind
    data = read(path)

    def found() -> Imported:
        if kind is Kind.DOCUMENT or (kind is Kind.TABLE and is_document(data)):
            return _document(data, path)
        if kind is Kind.DRAWING:
            return _drawing(path, data, tolerance, report)
        return _table(path, data, thin, corners, family, columns, missing, report)

    try:
        result = found()
    except (FormatError, ExchangeError) as problem:
        raise ExchangeError(f"“{Path(path).name}” cannot be read: {problem}") from problem
    except MemoryError:
        raise ExchangeError(f"“{Path(path).name}” takes more memory than there is.") from None
    return result.called(only) if only else result


# The window starts without the readers.


def _document(data: bytes, path: str | os.PathLike[str]) -> Imported:
    from app.exchange.cubics_in import Imported  # noqa: PLC0415

    folder = os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links are kept as they are
    return Imported(resolved(decode(data), folder))


def _drawing(path: str | os.PathLike[str], data: bytes, tolerance: float | None, report: Report) -> Imported:
    from app.exchange.child import limited  # noqa: PLC0415

    return limited(Path(path).suffix.lower().removeprefix("."), data, tolerance, report=report)


def _table(
    path: str | os.PathLike[str],
    data: bytes,
    thin: float | None,
    corners: bool,
    family: Family,
    columns: str,
    missing: str,
    report: Report,
) -> Imported:
    from app.exchange.table_columns import mapping_of, words_on  # noqa: PLC0415
    from app.exchange.table_curve import Missing, document_of_table  # noqa: PLC0415
    from app.exchange.table_layout import MissingNumber  # noqa: PLC0415
    from app.exchange.table_source import TableSource  # noqa: PLC0415
    from app.exchange.thinning import Thinning  # noqa: PLC0415

    source = TableSource(data, ending_of(path, import_format(path).endings))
    preview = source.preview()
    mapping = mapping_of(columns, preview.titles) if columns else preview.certain_mapping()
    name = Path(path).name[: -len(source.ending)] or "Table"
    try:
        table = source.table(preview.layout, mapping, Missing(missing), part(report, 0.0, 0.5))
        made = document_of_table(
            table,
            mapping,
            name=name,
            thin=thin,
            thinning=Thinning.POLYLINE if corners else Thinning.CURVE,
            family=family,
            missing=Missing(missing),
            report=part(report, 0.5, 1.0),
        )
    except MissingNumber as problem:
        raise ExchangeError(
            f"{problem} Leave such rows out with --missing skip, or end the curve there with --missing split."
        ) from None
    said = (preview.said, words_on(mapping, preview.titles), table.words_on_blocks, *made.remarks)
    return replace(made, remarks=tuple(filter(None, said)))
