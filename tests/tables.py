"""Tables as the program reads them: laid out, and with the columns taken for, what a look at them says."""

from __future__ import annotations

from app.exchange.table import curves, text
from app.exchange.table.columns import guess
from app.exchange.table.curves import TableOptions
from app.exchange.table.table import preview_of
from app.tasks.progress import silent


def read_table(data, mapping=None):
    """The numbers of a table of text."""
    preview = text.preview_table(data)
    return text.read_table(data, preview.layout, mapping or preview.mapping or preview.certain_mapping())


def document_of_table(table, mapping=None, options=None, *, report=silent):
    """The curves through the rows of a table."""
    mapping = mapping or guess(table.titles).mapping or preview_of(table).certain_mapping()
    return curves.document_of_table(table, mapping, options or TableOptions(), report=report)
