"""What typing, pasting and resetting in the point table make of the document. No Qt."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from msgspec.structs import replace

from app.document import edits
from app.document.edits import EditError
from app.document.model import Document, Family, Node, Vector
from app.view_model.curve_view import CurveView, Floats, appended_parameter, view_of


@dataclass(frozen=True)
class Column:
    """A column of the point table.

    Attributes
    ----------
    name
        Its title.
    order
        -1 for the parameter, 0 for the position, 1 for the velocity, 2 for the acceleration.
    component
        0 for x, 1 for y.
    meaning
        What it holds, in words.
    """

    name: str
    order: int
    component: int
    meaning: str

    @property
    def is_derivative(self) -> bool:
        """Whether a rule may estimate it."""
        return self.order > 0


COLUMNS = (
    Column("t", -1, 0, "Parameter: the curve passes the point at this t"),
    Column("x", 0, 0, "Position, x"),
    Column("y", 0, 1, "Position, y"),
    Column("vx", 1, 0, "Velocity per unit of t, x"),
    Column("vy", 1, 1, "Velocity per unit of t, y"),
    Column("ax", 2, 0, "Acceleration per unit of t squared, x"),
    Column("ay", 2, 1, "Acceleration per unit of t squared, y"),
)
T = 0
X = 1


def columns_of(family: Family) -> tuple[Column, ...]:
    """Return the columns that a family has."""
    return COLUMNS[: 3 + 2 * family.derivatives]


@dataclass(frozen=True)
class TableValues:
    """What the table shows: numbers (n, columns), NaN where there is none, and which are estimated."""

    values: Floats
    estimated: np.ndarray


def table_values(view: CurveView) -> TableValues:
    """Return the numbers of `view`; where the rules give no curve, only what the person set."""
    nodes = view.source.nodes
    columns = columns_of(view.source.family)
    values = np.full((len(nodes), len(columns)), np.nan)
    estimated = np.zeros(values.shape, dtype=bool)
    if view.is_current and view.curve is not None:
        values[:, T] = view.parameters[: len(nodes)]
        values[:, X : X + 2] = view.points
        if view.sides is not None:
            values[:, X:] = view.sides.before[: len(nodes)].reshape(len(nodes), -1)
    else:
        values[:, X : X + 2] = view.points
    if not view.is_current:
        for row, node in enumerate(nodes):
            _fill_given(values[row], node, manual=view.source.is_manual)
    missing = np.isnan(view.arrays.given[:, 0])
    estimated[:, 3:] = missing.reshape(len(nodes), 4)[:, : len(columns) - 3]
    return TableValues(values, estimated)


def _fill_given(row: Floats, node: Node, *, manual: bool) -> None:
    if manual and node.t is not None:
        row[T] = node.t
    given = (*(node.velocity or (np.nan, np.nan)), *(node.acceleration or (np.nan, np.nan)))
    row[3:] = given[: len(row) - 3]


# One cell


def set_cell(
    document: Document, curve: int, view: CurveView, index: int, column: Column, value: float
) -> Document:
    """Set one number of point `index`."""
    if column.order < 0:
        return edits.set_parameter(document, curve, index, value, _parameters(view))
    if column.order == 0:
        position = _with_component(view.source.nodes[index].position, column.component, value)
        return edits.set_position(document, curve, index, position)
    vector = _with_component(_derivative(view, index, column.order), column.component, value)
    change = edits.set_velocity if column.order == 1 else edits.set_acceleration
    return change(document, curve, index, vector)


def _with_component(vector: Vector, component: int, value: float) -> Vector:
    return (value, vector[1]) if component == 0 else (vector[0], value)


def _derivative(view: CurveView, index: int, order: int) -> Vector:
    """Return the derivative that is shown now: the component that is not typed keeps it."""
    node = view.source.nodes[index]
    given = node.velocity if order == 1 else node.acceleration
    shown = given or (
        view.velocity_of(index, ahead=False) if order == 1 else view.acceleration_of(index, ahead=False)
    )
    if shown is None:
        raise EditError(f"There is nothing to estimate the other component from. {view.problem}")
    return shown


def _parameters(view: CurveView) -> list[float]:
    """Return the parameters in force, to freeze the others at."""
    if view.is_current:
        return [float(t) for t in view.parameters[: len(view.source.nodes)]]
    given = [node.t for node in view.source.nodes if view.source.is_manual and node.t is not None]
    if len(given) < len(view.source.nodes):
        raise EditError(f"There are no parameters to change. {view.problem}")
    return given


# A block of cells


def paste_block(
    document: Document, curve: int, view: CurveView, top: int, columns: Sequence[Column], block: Floats
) -> Document:
    """Put a block of numbers into the rows from `top` on; rows beyond the last point append points.

    Parameters
    ----------
    columns
        The columns the block covers, from left to right.
    block
        The numbers, (rows, len(columns)).
    """
    count = len(view.source.nodes)
    _refuse_incomplete_points(columns, appended=top + len(block) > count)
    old = [
        _overwritten(view, top + offset, columns, row)
        for offset, row in enumerate(block[: max(count - top, 0)])
    ]
    new = [_new_node(columns, row) for row in block[max(count - top, 0) :]]
    nodes = view.source.nodes
    document = edits.set_nodes(document, curve, (*nodes[:top], *old, *nodes[top + len(old) :]))
    if columns[0].order < 0:
        document = edits.insert_nodes(document, curve, count, new)
        return _with_parameters(document, curve, view, top, block[:, 0])
    return _append(document, curve, view, new) if new else document


def _refuse_incomplete_points(columns: Sequence[Column], *, appended: bool) -> None:
    covered = {(column.order, column.component) for column in columns}
    if appended and not {(0, 0), (0, 1)} <= covered:
        raise EditError("There are more rows than points; rows that make new points need x and y.")
    for column in columns:
        if appended and column.is_derivative and (column.order, 1 - column.component) not in covered:
            raise EditError(f"New points need both components; {column.name} stands alone.")


def _overwritten(view: CurveView, index: int, columns: Sequence[Column], row: Floats) -> Node:
    node = view.source.nodes[index]
    position = node.position
    derivatives: dict[str, Vector] = {}
    for column, number in zip(columns, row, strict=True):
        value = float(number)
        if column.order == 0:
            position = _with_component(position, column.component, value)
        elif column.is_derivative:
            name = _field(column)
            old = derivatives[name] if name in derivatives else _derivative(view, index, column.order)
            derivatives[name] = _with_component(old, column.component, value)
    return replace(node, x=position[0], y=position[1], **derivatives)


def _new_node(columns: Sequence[Column], row: Floats) -> Node:
    given = {column: float(value) for column, value in zip(columns, row, strict=True)}
    pairs: dict[int, list[float]] = {0: [], 1: [], 2: []}
    for column, value in given.items():
        if column.order >= 0:
            pairs[column.order].append(value)
    vectors = {order: (pair[0], pair[1]) for order, pair in pairs.items() if len(pair) == 2}
    return Node(*vectors[0], velocity=vectors.get(1), acceleration=vectors.get(2))


def _field(column: Column) -> str:
    return "velocity" if column.order == 1 else "acceleration"


def _with_parameters(document: Document, curve: int, view: CurveView, top: int, given: Floats) -> Document:
    """Freeze the parameters with `given` from point `top` on."""
    count = len(document.curves[curve].nodes)
    kept = [] if len(given) == count else _parameters(view)
    parameters = [*kept[:top], *(edits.checked(float(t), "A t") for t in given), *kept[top + len(given) :]]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise EditError(
                f"The t of point {index} must be greater than {before:g}, the t of point {index - 1}."
            )
    return edits.freeze_parameters(document, curve, parameters)


def _append(document: Document, curve: int, view: CurveView, new: Sequence[Node]) -> Document:
    """Append points; the handles that the person set stay where they are."""
    before = view_of(document.curves[curve], view)
    if before.source.is_manual:
        first = appended_parameter(before, new[0])
        step = first - (before.source.nodes[-1].t or 0.0) if before.source.nodes else 1.0
        new = [replace(node, t=first + step * offset) for offset, node in enumerate(new)]
        return edits.insert_nodes(document, curve, len(before.source.nodes), new)
    grown = edits.insert_nodes(document, curve, len(before.source.nodes), new)
    squeeze = _squeeze(before, view_of(grown.curves[curve]))
    document = edits.append_node(document, curve, new[0], squeeze=squeeze)
    return edits.insert_nodes(document, curve, len(before.source.nodes) + 1, new[1:])


def _squeeze(before: CurveView, after: CurveView) -> float:
    """Return by which factor the parameters of the old points shrink when points are appended."""
    count = len(before.source.nodes)
    if count < 2 or not (before.is_current and after.is_current):
        return 1.0
    old, new = before.parameters, after.parameters
    return float((new[count - 1] - new[0]) / (old[-1] - old[0]))


# Back to the rules


def explicit_orders(nodes: Sequence[Node], indices: Collection[int], orders: Collection[int]) -> set[int]:
    """Return which of the derivatives `orders` the person set at any of `indices`."""
    found = set()
    for index in indices:
        if 1 in orders and nodes[index].velocity is not None:
            found.add(1)
        if 2 in orders and nodes[index].acceleration is not None:
            found.add(2)
    return found


def reset_name(indices: Collection[int], orders: Collection[int]) -> str:
    """Return the name of a reset in the history."""
    what = "derivatives" if len(orders) > 1 else "velocity" if 1 in orders else "acceleration"
    if len(indices) == 1:
        return f"Reset {what} of point {next(iter(indices))}"
    return f"Reset {what} of {len(indices)} points"
