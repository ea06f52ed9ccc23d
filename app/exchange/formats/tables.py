"""Tables in: of text, arrays of NumPy, JSON."""

from __future__ import annotations

from ..table.json_table import read_json
from ..table.numpy_array import read_array
from . import ContentKind, Format

TEXT_TABLE = Format(
    endings=(".csv", ".tsv", ".txt", ".dat"),
    title="Table",
    rank=60,
    kind=ContentKind.TABLE,
    plural="Tables",
)
NPY = Format(
    endings=(".npy",),
    title="NumPy array",
    rank=61,
    kind=ContentKind.TABLE,
    plural="NumPy arrays",
    read=read_array,
)
JSON = Format(
    endings=(".json", ".geojson"),
    title="JSON or GeoJSON",
    rank=62,
    kind=ContentKind.TABLE,
    plural="JSON and GeoJSON",
    read=read_json,
)
