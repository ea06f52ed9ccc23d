"""The file of a table, whatever its format; what was read is kept for the next choice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from ...tasks.progress import Report, part, silent
from ..cubics_in import Imported
from ..errors import ExchangeError
from .columns import ColumnMapping, mapping_of, words_on
from .curves import Missing, TableOptions, document_of_table
from .layout import MissingNumber, TextLayout, cells_of_row
from .lines import plain_utf_8
from .table import Preview, Table, cells_at, preview_of
from .text import preview_table, read_table
from .thinning import Thinning

if TYPE_CHECKING:
    from ..files import ImportOptions


class TableSource:
    """The content of one file.

    Attributes
    ----------
    data
        The content.
    lines
        About how many rows it has.
    """

    def __init__(self, data: bytes, read_whole: Callable[[bytes], Table] | None = None) -> None:
        """Keep the content, and the reader of its format; None for a table of text."""
        self.data, self._read_whole = data, read_whole
        self._is_text = read_whole is None
        self._whole: Table | None = None
        self._read: tuple[TextLayout, ColumnMapping, bool, Table] | None = None
        self.lines = data.count(b"\n") if self._is_text else 0

    def preview(self, layout: TextLayout | None = None) -> Preview:
        """Return the first rows, and what the columns seem to be.

        Raises
        ------
        ExchangeError
            If it is no table.
        """
        if self._is_text:
            return preview_table(self.data, layout)
        whole = self._all()
        self.lines = len(whole.values)
        return preview_of(whole)

    def table(
        self,
        layout: TextLayout,
        mapping: ColumnMapping,
        missing: Missing = Missing.REFUSE,
        report: Report = silent,
    ) -> Table:
        """Return the numbers in the columns of a mapping.

        Raises
        ------
        ExchangeError
            With the place of what is no number.
        """
        if not self._is_text:
            return self._all()
        allows_missing = missing is not Missing.REFUSE
        known = self._read
        if known is not None and known[:3] == (layout, mapping, allows_missing):
            return known[3]
        table = read_table(self.data, layout, mapping, allows_missing=allows_missing, report=report)
        self._read = (layout, mapping, allows_missing, table)
        return table

    def cells(self, layout: TextLayout, number: int) -> tuple[str, ...]:
        """Return the cells of the row that a problem names by this number; none where there is none."""
        if self._is_text:
            return cells_of_row(plain_utf_8(self.data), layout, number)
        whole = self._all()
        place = number - whole.first_row
        return cells_at(whole, place) if 0 <= place < len(whole.values) else ()

    def _all(self) -> Table:
        if self._whole is None:
            assert self._read_whole is not None
            self._whole = self._read_whole(self.data)
        return self._whole


def import_table(name: str, source: TableSource, options: ImportOptions, report: Report) -> Imported:
    """Return what a table holds, whose file has that `name` without its ending."""
    preview, missing = source.preview(), Missing(options.missing)
    mapping = mapping_of(options.columns, preview.titles) if options.columns else preview.certain_mapping()
    try:
        table = source.table(preview.layout, mapping, missing, part(report, 0.0, 0.5))
        made = document_of_table(
            table,
            mapping,
            TableOptions(
                name=name or TableOptions.name,
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
