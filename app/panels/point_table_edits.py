"""What typing, pasting and resetting in the point table make of the document. No Qt."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise

import msgspec
import numpy as np
from msgspec.structs import replace

from app.document import edits
from app.document.edits import EditError
from app.document.model import Document, Node, Vector
from app.families import Family
from app.view_model.appending import with_nodes_appended
from app.view_model.curve_view import CurveView, Floats, appended_parameter, view_of
from app.view_model.jets import explicit_sides


class Column(msgspec.Struct, frozen=True):
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


class TableValues(msgspec.Struct, frozen=True):
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
            jets = np.array(view.sides.before[: len(nodes)])
            if shows_ahead(view, 0):
                jets[0] = view.sides.after[0]
            values[:, X:] = jets.reshape(len(nodes), -1)
    else:
        values[:, X : X + 2] = view.points
    given = _shown_given(view)
    if not view.is_current:
        values[:, 3:] = given.reshape(len(nodes), 4)[:, : len(columns) - 3]
        if view.source.is_manual:
            values[:, T] = view.arrays.times
    missing = np.isnan(given[..., :1]).repeat(2, axis=-1)
    estimated[:, 3:] = missing.reshape(len(nodes), 4)[:, : len(columns) - 3]
    return TableValues(values, estimated)


def _shown_given(view: CurveView) -> Floats:
    """Return what the person set, on the side that the table shows, (n, 2, 2); NaN where nothing is set."""
    given = view.arrays.given
    shown = np.array(given[:, 0])
    if len(shown) and shows_ahead(view, 0):
        shown[0] = given[0, 1]
    return shown


def shows_ahead(view: CurveView, index: int) -> bool:
    """Whether the table has the derivatives after a corner: at the first point, which has no others.

    At every other corner it has those before it.
    """
    return index == 0 and not view.source.is_closed and view.source.nodes[0].corner


def _given(view: CurveView, index: int, order: int) -> Vector | None:
    """Return the derivative that the person set, on the side that the table shows."""
    before, after = explicit_sides(view.source.nodes[index], order)
    return after if shows_ahead(view, index) else before


# One cell


def set_cell(
    document: Document, curve: int, view: CurveView, index: int, column: Column, value: float
) -> Document:
    """Set one number of point `index`; at a corner its derivatives are those before the point."""
    if column.order < 0:
        _refuse_beyond_closing(view, index, value)
        return edits.set_parameter(document, curve, index, value, _knot_parameters(view))
    if column.order == 0:
        position = _with_component(view.source.nodes[index].position, column.component, value)
        return edits.set_position(document, curve, index, position)
    vector = _with_component(_derivative(view, index, column.order), column.component, value)
    change = edits.set_velocity if column.order == 1 else edits.set_acceleration
    return change(document, curve, index, vector, ahead=shows_ahead(view, index))


def fill_cells(
    document: Document, curve: int, view: CurveView, cells: Mapping[int, Sequence[Column]], value: float
) -> Document:
    """Put one number into all `cells`: the columns of each row."""
    timed = [row for row, columns in cells.items() if columns[0].order < 0]
    if len(timed) > 1:
        raise EditError("Every point needs a t of its own.")
    nodes = list(view.source.nodes)
    for row, columns in cells.items():
        nodes[row] = _overwritten(view, row, columns, np.full(len(columns), value))
    document = edits.set_nodes(document, curve, nodes)
    return _with_parameters(document, curve, view, timed[0], np.array([value])) if timed else document


def _refuse_beyond_closing(view: CurveView, index: int, t: float) -> None:
    """Refuse a t of the last point of a closed curve at or after its return to the first."""
    if not (view.source.is_closed and index == len(view.source.nodes) - 1):
        return
    end = view.source.parametrization.end
    if t >= end:
        raise EditError(
            f"The t of point {index} must be less than {end:g}, where the curve returns to its first point."
        )


def _with_component(vector: Vector, component: int, value: float) -> Vector:
    return (value, vector[1]) if component == 0 else (vector[0], value)


def _derivative(view: CurveView, index: int, order: int) -> Vector:
    """Return the derivative that is shown now: the component that is not typed keeps it."""
    ahead = shows_ahead(view, index)
    estimate = view.velocity_of if order == 1 else view.acceleration_of
    shown = _given(view, index, order) or estimate(index, ahead=ahead)
    if shown is None:
        raise EditError(f"There is nothing to estimate the other component from. {view.problem}")
    return shown


def _knot_parameters(view: CurveView) -> list[float]:
    """Return the parameters at the knots: of a closed curve also that of its return to the first point."""
    own = _parameters(view)[: len(view.source.nodes)]
    return [*own, view.source.parametrization.end] if view.source.is_closed else own


def _parameters(view: CurveView) -> list[float]:
    """Return the parameters in force, to freeze the others at; of a closed curve, the return included."""
    if view.is_current:
        return [float(t) for t in view.parameters]
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
            name = _field(column, ahead=shows_ahead(view, index))
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


def _field(column: Column, *, ahead: bool) -> str:
    return ("velocity" if column.order == 1 else "acceleration") + ("_after" if ahead else "")


def _with_parameters(document: Document, curve: int, view: CurveView, top: int, given: Floats) -> Document:
    """Freeze the parameters with `given` from point `top` on."""
    count = len(document.curves[curve].nodes)
    kept = [] if len(given) == count else _parameters(view)[: len(view.source.nodes)]
    parameters = [*kept[:top], *(edits.checked(float(t), "A t") for t in given), *kept[top + len(given) :]]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise EditError(
                f"The t of point {index} must be greater than {before:g}, the t of point {index - 1}."
            )
    if view.source.is_closed:
        parameters = [*parameters, _closing(view, parameters)]
    return edits.freeze_parameters(document, curve, parameters)


def _closing(view: CurveView, parameters: Sequence[float]) -> float:
    """Return where a closed curve returns to its start: where it did, or a mean step after the last point."""
    end, last = view.source.parametrization.end, parameters[-1]
    return end if end > last else last + (last - parameters[0]) / (len(parameters) - 1)


def _append_to_closed(document: Document, curve: int, before: CurveView, new: Sequence[Node]) -> Document:
    """Append points to a closed curve with manual parameters: what leads back now leads through them."""
    times = _knot_parameters(before)
    step = times[-1] - times[-2]
    document = edits.insert_nodes(document, curve, len(before.source.nodes), new)
    more = (times[-1] + step * (offset + 1) for offset in range(len(new)))
    return edits.freeze_parameters(document, curve, [*times, *more])


def _append(document: Document, curve: int, view: CurveView, new: Sequence[Node]) -> Document:
    """Append points; the handles that the person set stay where they are."""
    before = view_of(document.curves[curve], view)
    if before.source.is_manual and before.source.is_closed:
        return _append_to_closed(document, curve, before, new)
    if before.source.is_manual:
        first = appended_parameter(before, new[0])
        step = first - (before.source.nodes[-1].t or 0.0) if before.source.nodes else 1.0
        new = [replace(node, t=first + step * offset) for offset, node in enumerate(new)]
    return with_nodes_appended(document, curve, before, new)


# Back to the rules


def explicit_orders(nodes: Sequence[Node], indices: Collection[int], orders: Collection[int]) -> set[int]:
    """Return which of the derivatives `orders` the person set at any of `indices`."""
    found = set()
    for index in indices:
        for order in orders:
            if any(side is not None for side in explicit_sides(nodes[index], order)):
                found.add(order)
    return found


def keepers(view: CurveView, rows: Collection[int], columns: Sequence[Column]) -> tuple[list[int], set[int]]:
    """Return the points whose own derivatives a paste into `columns` left as they were, and which these are.

    Moved points that keep a velocity set for another place make kinks that nobody asked for.
    """
    if not any(column.order == 0 for column in columns):
        return [], set()
    kept = {1, 2} - {column.order for column in columns}
    shown = kept & set(range(1, view.source.family.derivatives + 1))
    nodes = view.source.nodes
    found = [row for row in rows if explicit_orders(nodes, [row], shown)]
    return found, explicit_orders(nodes, found, shown)


def keeping_sentence(indices: Sequence[int], orders: Collection[int]) -> str:
    """Return "Point 8 keeps its own velocity"."""
    names = [name for order, name in ((1, "velocity"), (2, "acceleration")) if order in orders]
    if len(indices) == 1:
        return f"Point {indices[0]} keeps its own {' and '.join(names)}"
    plural = " and ".join({"velocity": "velocities", "acceleration": "accelerations"}[name] for name in names)
    return f"{len(indices)} points keep their own {plural}"


def reset_name(indices: Collection[int], orders: Collection[int]) -> str:
    """Return the name of a reset in the history."""
    what = "derivatives" if len(orders) > 1 else "velocity" if 1 in orders else "acceleration"
    if len(indices) == 1:
        return f"Reset {what} of point {next(iter(indices))}"
    return f"Reset {what} of {len(indices)} points"
