"""Reading: the name of a file decides how it is read; foreign drawings are parsed in a child process."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.document.format import FormatError, decode
from app.document.image_path import resolved
from app.document.model import Family
from app.document.storage import read
from app.exchange.drawing import ExchangeError
from app.exchange.formats import READABLE, TABLES, ending_of
from app.exchange.progress import Report, part, silent

if TYPE_CHECKING:
    from app.exchange.cubics_in import Imported


def import_file(
    path: str | os.PathLike[str],
    *,
    tolerance: float | None = None,
    thin: float | None = None,
    corners: bool = False,
    family: Family = Family.HERMITE,
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
    report
        Hears how far it has come.

    Raises
    ------
    ExchangeError
        For an unknown ending, or with the place in the file and the reason.
    StorageError
        If the file cannot be read at all.
    """
    ending = ending_of(path, READABLE)
    data = read(path)
    name = Path(path).name[: -len(ending)] or "Table"
    readers: dict[str, Callable[[], Imported]] = {
        ".curve.json": lambda: _document(data, path),
        ".json": lambda: _document(data, path),
        ".svg": lambda: _drawing("svg", data, tolerance, report),
        ".dxf": lambda: _drawing("dxf", data, tolerance, report),
        **dict.fromkeys(TABLES, lambda: _table(data, name, thin, corners, family, report)),
    }
    try:
        return readers[ending]()
    except (FormatError, ExchangeError) as problem:
        raise ExchangeError(f"“{Path(path).name}” cannot be read: {problem}") from problem
    except MemoryError:
        raise ExchangeError(f"“{Path(path).name}” takes more memory than there is.") from None


# The window starts without the readers.


def _document(data: bytes, path: str | os.PathLike[str]) -> Imported:
    from app.exchange.cubics_in import Imported  # noqa: PLC0415

    folder = os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links are kept as they are
    return Imported(resolved(decode(data), folder))


def _table(
    data: bytes, name: str, thin: float | None, corners: bool, family: Family, report: Report
) -> Imported:
    from app.exchange.cubics_in import Imported  # noqa: PLC0415
    from app.exchange.table_curve import document_of_table  # noqa: PLC0415
    from app.exchange.table_file import read_table  # noqa: PLC0415
    from app.exchange.thinning import Thinning  # noqa: PLC0415

    table = read_table(data, report=part(report, 0.0, 0.5))
    document, deviation = document_of_table(
        table,
        name=name,
        thin=thin,
        thinning=Thinning.POLYLINE if corners else Thinning.CURVE,
        family=family,
        report=part(report, 0.5, 1.0),
    )
    return Imported(document, deviation)


def _drawing(reader: str, data: bytes, tolerance: float | None, report: Report) -> Imported:
    from app.exchange.child import limited  # noqa: PLC0415

    return limited(reader, data, tolerance, report=report)
