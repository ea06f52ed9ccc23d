"""Tables in: columns of numbers become curves, all rows of them or as few as a tolerance takes."""

from __future__ import annotations

import numpy as np

from app.document.format import FormatError, validate
from app.document.model import Curve, Document, Family, Node, Parametrization, ParametrizationKind, Vector
from app.exchange.drawing import ExchangeError, Floats
from app.exchange.table_file import ROLES, Mapping, Table, guessed
from app.exchange.thinning import thinned


def document_of_table(
    table: Table,
    mapping: Mapping | None = None,
    *,
    family: Family = Family.HERMITE,
    name: str = "Table",
    thin: float | None = None,
) -> tuple[Document, float]:
    """Return a document with one curve through the rows of a table, and how far it is from them at most.

    Parameters
    ----------
    table
        At least two rows.
    mapping
        Which columns are what; by default a guess from the titles.
    family
        Of the curve. A column of velocities or accelerations that the family does not have is left out.
    name
        Of the curve.
    thin
        None to take every row; otherwise the rows are thinned out to as few points as a cubic Hermite curve
        needs to stay within this distance of every row.

    Raises
    ------
    ExchangeError
        If the rows cannot be the points of a curve, with the row.
    """
    chosen = mapping or guessed(table.titles)
    if chosen is None:
        raise ExchangeError("The table has one column only; a curve needs x and y.")
    columns = {role: getattr(chosen, role) for role in ROLES}
    for role, column in columns.items():
        if column is not None and not 0 <= column < table.values.shape[1]:
            raise ExchangeError(f"There is no column {column + 1} for {role}.")
    values = {role: table.values[:, column] for role, column in columns.items() if column is not None}
    for role, column in values.items():
        if np.isnan(column).any():
            line = table.line_of(int(np.argmax(np.isnan(column))))
            raise ExchangeError(f"Row {line}, column {columns[role] + 1} is empty; it gives {role}.")
    if len(table.values) < 2:
        raise ExchangeError("The table has one row of numbers; a curve needs two points.")
    t = values.get("t")
    if t is not None and not (np.diff(t) > 0).all():
        row = int(np.argmin(np.diff(t) > 0)) + 1
        raise ExchangeError(f"Row {table.line_of(row)}: t must increase from row to row.")
    points = np.column_stack([values["x"], values["y"]])
    if thin is not None:
        kept = thinned(points, t, thin)
        curve = _manual_curve(name, Family.HERMITE, kept.parameters, points[kept.rows])
        return _checked(curve), kept.deviation
    return _checked(_full_curve(name, family, points, t, values)), 0.0


def _full_curve(
    name: str, family: Family, points: Floats, t: Floats | None, values: dict[str, Floats]
) -> Curve:
    curve = _manual_curve(name, family, t, points)
    nodes = list(curve.nodes)
    for order, field in enumerate(("velocity", "acceleration"), start=1):
        pair = ("vx", "vy") if order == 1 else ("ax", "ay")
        if order > family.derivatives or not set(pair) <= set(values):
            continue
        vectors = zip(values[pair[0]].tolist(), values[pair[1]].tolist(), strict=True)
        nodes = [_with(node, field, vector) for node, vector in zip(nodes, vectors, strict=True)]
    return Curve(name, family, curve.parametrization, tuple(nodes))


def _with(node: Node, field: str, vector: Vector) -> Node:
    if field == "velocity":
        return Node(node.x, node.y, node.t, vector)
    return Node(node.x, node.y, node.t, node.velocity, vector)


def _manual_curve(name: str, family: Family, t: Floats | None, points: Floats) -> Curve:
    """Return a curve with parameters t, or by chord length without."""
    if t is None:
        nodes = tuple(Node(x, y) for x, y in points.tolist())
        return Curve(name, family, Parametrization(), nodes)
    rule = Parametrization(ParametrizationKind.MANUAL, start=float(t[0]), end=float(t[-1]))
    data = zip(points.tolist(), t.tolist(), strict=True)
    return Curve(name, family, rule, tuple(Node(x, y, at) for (x, y), at in data))


def _checked(curve: Curve) -> Document:
    document = Document((curve,))
    try:
        validate(document)
    except FormatError as problem:
        raise ExchangeError(f"The table cannot become a curve: {problem}.") from problem
    return document
