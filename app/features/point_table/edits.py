"""Edits of the document by filling, pasting and resetting in the point table. No Qt."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import compress

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document import point_edits, rule_edits
from ...document.derivatives import DERIVATIVES
from ...document.limits import EditError
from ...document.model import Document, Point
from ...document.words import count_of, enumerated
from ...exchange.table.clipboard import Block
from ...view_model.append import appended_parameter, with_points_appended
from ...view_model.curve.curve_view import CurveView, view_of
from ...view_model.point_columns import PARAMETER, POSITION, Column, knot_parameters


def fill_cells(
    document: Document,
    curve: int,
    view: CurveView,
    cells: Mapping[Column, Sequence[int]],
    values: Mapping[Column, float],
) -> Document:
    """Set one number of each column in all its rows."""
    for column, rows in cells.items():
        if column.order == PARAMETER and len(rows) > 1:
            raise EditError("Each point needs its own t.")
        document = column.put(document, curve, view, dict.fromkeys(rows, values[column]))
    return document


def columns_of_block(block: Block, columns: Sequence[Column], left: int) -> tuple[list[Column], FloatArray]:
    """Return the columns of the table that a block covers, in their order, and its numbers.

    Titles name the columns; without titles the block begins at the column `left`.
    """
    indices = _indices_by_title(block, columns) if block.titles else _indices_from(left, block, columns)
    needed = [
        index for column, index in indices.items() if column.set is not None and not column.is_of_handle
    ]
    # Cells of computed columns may be empty, and those of handles at the ends of a curve.
    for row, numbers in enumerate(block.rows, start=2 if block.titles else 1):
        for index in needed:
            if math.isnan(numbers[index]):
                raise EditError(f"Row {row}, column {index + 1} is empty.")
    return list(indices), np.array(block.rows, dtype=float)[:, list(indices.values())]


def _indices_from(left: int, block: Block, columns: Sequence[Column]) -> dict[Column, int]:
    width = len(block.rows[0])
    if len(columns) - left < width:
        room = count_of(len(columns) - left, "column")
        raise EditError(f"{width} columns do not fit: from {columns[left].name} on there is room for {room}.")
    return {column: index for index, column in enumerate(columns[left : left + width])}


def _indices_by_title(block: Block, columns: Sequence[Column]) -> dict[Column, int]:
    titled = {name: index for index, name in enumerate(block.titles) if name != "#"}
    if len(titled) + block.titles.count("#") < len(block.rows[0]):
        raise EditError("A column title appears twice.")
    indices = {column: titled[column.title] for column in columns if column.title in titled}
    missing = [name for name in titled if name not in {column.title for column in indices}]
    if missing:
        raise EditError(f"A curve of this family has no {missing[0]}.")
    if not indices:
        raise EditError("The copied text has no column of this table.")
    return indices


def paste_block(
    document: Document, curve: int, view: CurveView, top: int, columns: Sequence[Column], block: FloatArray
) -> Document:
    """Set a block of numbers in the rows from `top` on; rows beyond the last point append points.

    Parameters
    ----------
    columns
        The columns that the block covers, from left to right; beside derivatives, handles say the same again.
    block
        The numbers, (rows, len(columns)).
    """
    if any(column.is_derivative for column in columns):
        is_used = [not column.is_of_handle for column in columns]
        columns, block = [*compress(columns, is_used)], block[:, is_used]
    count = len(view.source.points)
    old, new = block[: max(count - top, 0)], block[max(count - top, 0) :]
    if len(new):
        _refuse_incomplete_points(columns)
    times = [index for index, column in enumerate(columns) if column.order == PARAMETER]
    for index, column in enumerate(columns):
        if len(old) and index not in times:
            document = column.put(document, curve, view, _by_row(top, old[:, index]))
    points = [_new_point(columns, row) for row in new]
    if times:
        document = point_edits.insert_points(document, curve, count, points)
        document = columns[times[0]].put(document, curve, view, _by_row(top, block[:, times[0]]))
    elif points:
        document = _append(document, curve, view, points)
    others = [index for index, column in enumerate(columns) if column.order is None]
    if points and others:
        grown = view_of(document.curves[curve], view)
        for index in others:
            document = columns[index].put(document, curve, grown, _by_row(count, new[:, index]))
    return document


def computed_note_of(columns: Iterable[Column]) -> str:
    """Return the note on computed columns: "; kappa is computed"."""
    names = [column.name for column in columns if column.set is None]
    return f"; {' and '.join(names)} {'are' if len(names) > 1 else 'is'} computed" if names else ""


def _by_row(top: int, numbers: FloatArray) -> dict[int, float]:
    return dict(enumerate(numbers.tolist(), start=top))


def _refuse_incomplete_points(columns: Sequence[Column]) -> None:
    covered = {(column.order, column.component) for column in columns}
    if not {(POSITION, 0), (POSITION, 1)} <= covered:
        raise EditError("There are more rows than points; new points need x and y.")
    for column in columns:
        if column.is_derivative and (column.order, 1 - column.component) not in covered:
            raise EditError(f"New points need both components of a derivative, not {column.name} alone.")


def _new_point(columns: Sequence[Column], row: FloatArray) -> Point:
    data: dict[int, list[float]] = {}
    for column, value in zip(columns, row.tolist(), strict=True):
        data.setdefault(-1 if column.order is None else column.order, []).append(value)
    vectors = {order: (pair[0], pair[1]) for order, pair in data.items() if order >= POSITION}
    given = [vectors.get(derivative.order) for derivative in DERIVATIVES]
    return Point(*vectors[POSITION]).with_derivatives(given, given)


def _append_to_closed(document: Document, curve: int, before: CurveView, new: Sequence[Point]) -> Document:
    """Append points to a closed curve with manual parameters: the closing segment runs through them."""
    times = knot_parameters(before)
    step = times[-1] - times[-2]
    document = point_edits.insert_points(document, curve, len(before.source.points), new)
    more = (times[-1] + step * (offset + 1) for offset in range(len(new)))
    return rule_edits.freeze_parameters(document, curve, [*times, *more])


def _append(document: Document, curve: int, view: CurveView, new: Sequence[Point]) -> Document:
    """Append points; handles that were set stay where they are."""
    before = view_of(document.curves[curve], view)
    if before.source.is_manual and before.source.is_closed:
        return _append_to_closed(document, curve, before, new)
    if before.source.is_manual:
        first = appended_parameter(before, new[0])
        step = first - (before.source.points[-1].t or 0.0) if before.source.points else 1.0
        new = [replace(point, t=first + step * offset) for offset, point in enumerate(new)]
    return with_points_appended(document, curve, before, new)


# Reset to estimates

_ORDER_NAMES = {derivative.order: derivative.name for derivative in DERIVATIVES}


def explicit_orders(points: Sequence[Point], indices: Collection[int], orders: Collection[int]) -> set[int]:
    """Return the orders of derivatives, of `orders`, that are set at any of `indices`."""
    return {k for k in orders if any(any(points[index].explicit_sides(k)) for index in indices)}


def points_with_kept_derivatives(
    view: CurveView, rows: Collection[int], columns: Sequence[Column]
) -> tuple[list[int], set[int]]:
    """Return the rows whose derivatives a paste into `columns` has kept, and the orders of these.

    Moved points with a velocity that was set for another position make unwanted kinks.
    """
    if not any(column.order == POSITION for column in columns):
        return [], set()
    orders = set(range(1, view.source.family.derivatives + 1)) - {column.order for column in columns}
    points = view.source.points
    kept_rows = [row for row in rows if explicit_orders(points, [row], orders)]
    return kept_rows, explicit_orders(points, kept_rows, orders)


def keeping_sentence(indices: Sequence[int], orders: Collection[int]) -> str:
    """Return a sentence such as "Point 8 keeps its own velocity"."""
    many = len(indices) != 1
    kinds = [DERIVATIVES[order - 1] for order in sorted(orders)]
    derivatives = enumerated([kind.plural if many else kind.name for kind in kinds])
    return (
        f"{len(indices)} points keep their own {derivatives}"
        if many
        else f"Point {indices[0]} keeps its own {derivatives}"
    )


def reset_name(indices: Collection[int], columns: Sequence[Column]) -> str:
    """Return the name of a reset in the history."""
    names = dict.fromkeys(
        _ORDER_NAMES.get(column.order or 0, column.label or column.name) for column in columns
    )
    all_are = set(_ORDER_NAMES.values()) >= names.keys()
    reset = "derivatives" if all_are and len(names) > 1 else " and ".join(names)
    if len(indices) == 1:
        return f"Reset {reset} of point {next(iter(indices))}"
    return f"Reset {reset} of {len(indices)} points"
