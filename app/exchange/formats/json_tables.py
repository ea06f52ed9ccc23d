"""JSON, read as tables: lists of points, records, columns, and the lines of GeoJSON."""

from __future__ import annotations

import codecs
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import accumulate
from typing import Any, TypeVar

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...storage.format_error import in_words, not_json
from ..errors import ExchangeError
from ..table.columns import numbered_titles
from ..table.table import RowProblem, Table, table_of
from ..unique_names import numbered
from . import ContentKind, Format

_GEO = """Feature FeatureCollection GeometryCollection LineString MultiLineString Polygon MultiPolygon
Point MultiPoint"""
_KINDS = (
    'a list of points [[x, y], …], of curves [[[x, y], …], …] or of records [{"x": …, "y": …}, …], '
    'columns {"x": […], "y": […]}, or GeoJSON with lines'
)


def read_json(data: bytes) -> Table:
    """Return the numbers of a JSON file as a table.

    Raises
    ------
    ExchangeError
        If it is not JSON, or not a table, with the row of a value that is not a number.
    """
    content: Any = json_in(data, object)
    if isinstance(content, dict) and content.get("type") in _GEO.split():
        return _lines(content)
    if isinstance(content, dict) and content and all(isinstance(column, list) for column in content.values()):
        return _columns(content)
    if isinstance(content, list) and content and all(isinstance(item, dict) for item in content):
        return _records(content)
    if _is_points(content):
        return table_of(_numbers(content), numbered_titles(len(content[0])))
    if isinstance(content, list) and content and all(map(_is_points, content)):
        rows = [point for curve in content for point in curve]
        blocks = tuple(accumulate(map(len, content[:-1])))
        return table_of(_numbers(rows), numbered_titles(len(rows[0])), blocks=blocks)
    raise ExchangeError(f"The JSON file is not a table; it can be {_KINDS}.")


def _is_points(content: object) -> bool:
    """Whether something is a list of lists without lists in the first of them."""
    return (
        isinstance(content, list)
        and bool(content)
        and all(isinstance(item, list) for item in content)
        and len(content[0]) > 1
        and not any(isinstance(value, list | dict) for value in content[0])
    )


def _columns(content: dict[str, list[object]]) -> Table:
    lengths = set(map(len, content.values()))
    if len(lengths) != 1:
        raise ExchangeError("The columns differ in length.")
    return table_of(_numbers(list(zip(*content.values(), strict=True))), tuple(map(str, content)))


def _records(content: list[dict[str, object]]) -> Table:
    """Return the numbers of records; keys whose value in the first record is text are left out."""
    titles = [str(key) for key, value in content[0].items() if not isinstance(value, str | list | dict)]
    others = [f"“{str(key)[:40]}”" for key in content[0] if key not in titles]
    remark = f"Columns that are not numbers were left out: {', '.join(others[:8])}." if others else ""
    rows = [[item.get(key) for key in titles] for item in content]
    return table_of(_numbers(rows), tuple(titles), remark=remark)


def _numbers(rows: Sequence[Sequence[object]]) -> FloatArray:
    """Return rows of numbers, NaN for null; refuse other values with their cell."""
    width = len(rows[0]) if rows else 0
    for number, row in enumerate(rows, start=1):
        if not isinstance(row, list | tuple) or len(row) != width:
            raise RowProblem(f" does not have {width} numbers like the first row.", number)
        for column, value in enumerate(row, start=1):
            if type(value) not in (int, float, type(None)):
                raise RowProblem(f": “{str(value)[:20]}” is not a number.", number, column)
    try:
        return np.array(rows, dtype=float).reshape(len(rows), width)
    except OverflowError:
        raise ExchangeError("A number is outside −1e12 to 1e12.") from None


# GeoJSON


def _lines(content: dict[str, Any]) -> Table:
    """Return the lines of GeoJSON, by name, as columns lon and lat."""
    lost: Counter[str] = Counter()
    lines = list(_lines_in(content, "Line", lost))
    if not lines:
        raise ExchangeError(f"The GeoJSON file contains no lines. {_loss_remark(lost)}".strip())
    titles = zip(numbered([name for name, _ in lines]), lines, strict=True)
    names = [title for title, (_, line) in titles for _point in line]
    points = [point for _, line in lines for point in line]
    values = _numbers([point[:2] if isinstance(point, list) else [point] for point in points])
    if values.shape[1] != 2:
        raise ExchangeError("A point of the GeoJSON has no longitude and latitude.")
    whole = np.column_stack([np.full(len(values), np.nan), values])
    return table_of(whole, ("curve", "lon", "lat"), words={0: names}, remark=_loss_remark(lost))


def _lines_in(content: object, name: str, lost: Counter[str]) -> Iterator[tuple[str, list[Any]]]:
    """Yield the lines in a GeoJSON object with the names of their features, and count other geometries."""
    if not isinstance(content, dict):
        return
    kind = content.get("type")
    if kind == "FeatureCollection":
        for number, feature in enumerate(_list(content, "features"), start=1):
            yield from _lines_in(feature, f"{name} {number}", lost)
    elif kind == "Feature":
        properties = content.get("properties")
        name_property = properties.get("name") if isinstance(properties, dict) else None
        title = " ".join(name_property.split())[:200] if isinstance(name_property, str) else ""
        yield from _lines_in(content.get("geometry"), title or name, lost)
    elif kind == "GeometryCollection":
        for geometry in _list(content, "geometries"):
            yield from _lines_in(geometry, name, lost)
    elif kind == "LineString":
        yield name, _list(content, "coordinates")
    elif kind == "MultiLineString":
        for line in _list(content, "coordinates"):
            yield name, line if isinstance(line, list) else []
    else:
        lost[str(kind)[:20]] += 1


def _list(content: dict[str, Any], key: str) -> list[Any]:
    value = content.get(key)
    if not isinstance(value, list):
        raise ExchangeError(f"The GeoJSON is damaged: a {content.get('type')} without {key}.")
    return value


def _loss_remark(lost: Counter[str]) -> str:
    words = ", ".join(f"{count} {kind}" for kind, count in sorted(lost.items()))
    return f"Left out: {words}." if words else ""


MOST_BYTES = 32 * 2**20
"""Largest JSON file in bytes: as Python's own numbers it takes several times as much."""

Content = TypeVar("Content")


def json_in(data: bytes, kind: type[Content]) -> Content:
    """Return the content of a JSON file.

    Raises
    ------
    ExchangeError
        With the position, for invalid JSON or other types; for more than `MOST_BYTES`.
    """
    if len(data) > MOST_BYTES:
        raise ExchangeError(f"The JSON file is larger than {MOST_BYTES >> 20} MB.")
    try:
        return msgspec.json.decode(data.removeprefix(codecs.BOM_UTF8), type=kind)
    except UnicodeDecodeError:
        raise ExchangeError("The file is not UTF-8 text.") from None
    except msgspec.ValidationError as problem:
        raise ExchangeError(_sentence(in_words(str(problem)))) from None
    except msgspec.DecodeError as problem:
        raise ExchangeError(_sentence(not_json(str(problem), data))) from None
    except RecursionError:
        raise ExchangeError("The file is nested too deeply.") from None


def is_object(data: bytes) -> bool:
    """Whether a content begins as a JSON object does."""
    return data[:64].lstrip(b"\xef\xbb\xbf \t\r\n")[:1] == b"{"


def _sentence(clause: str) -> str:
    return f"{clause[0].upper()}{clause[1:]}."


JSON = Format(
    endings=(".json", ".geojson"),
    title="JSON or GeoJSON",
    rank=62,
    kind=ContentKind.TABLE,
    plural="JSON and GeoJSON",
    read=read_json,
)
