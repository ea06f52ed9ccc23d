"""A table's file, read as the person asked for it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ...tasks.progress import Report, part
from ..cubics_in import Imported
from ..errors import ExchangeError
from .columns import mapping_of, words_on
from .curves import Missing, TableOptions, document_of_table
from .layout import MissingNumber
from .source import TableSource
from .thinning import Thinning

if TYPE_CHECKING:
    from ..reading import ImportOptions


def read_table(path: Path, ending: str, data: bytes, options: ImportOptions, report: Report) -> Imported:
    """Return what a table holds, whose file at `path` has that `ending` and content."""
    source, missing = TableSource(data, ending), Missing(options.missing)
    preview = source.preview()
    mapping = mapping_of(options.columns, preview.titles) if options.columns else preview.certain_mapping()
    try:
        table = source.table(preview.layout, mapping, missing, part(report, 0.0, 0.5))
        made = document_of_table(
            table,
            mapping,
            TableOptions(
                name=path.name[: -len(ending)] or TableOptions.name,
                thin=options.thin,
                thinning=Thinning.POLYLINE if options.corners else Thinning.CURVE,
                family=options.family,
                settings=options.settings,
                missing=missing,
            ),
            report=part(report, 0.5, 1.0),
        )
    except MissingNumber as problem:
        raise ExchangeError(
            f"{problem} Leave such rows out with --missing skip, or end the curve there with --missing split."
        ) from None
    said = (preview.said, words_on(mapping, preview.titles), table.words_on_blocks, *made.remarks)
    return replace(made, remarks=tuple(filter(None, said)))
