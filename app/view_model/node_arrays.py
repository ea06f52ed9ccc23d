"""The numbers in a curve's nodes as arrays; made anew only for nodes that are other values now."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import TypeVar

import msgspec
import numpy as np

from app.document.kept_handles import DERIVATIVES
from app.document.model import Node, Vector
from curvecore.arrays import BoolArray, FloatArray, IntArray

Column = TypeVar("Column", FloatArray, BoolArray)

_NONE = (np.nan, np.nan)

_beside_place = operator.attrgetter("t", "corner", *(name for _, name in DERIVATIVES))


class NodeArrays(msgspec.Struct, frozen=True, eq=False):
    """What n nodes hold; NaN stands for None. An array that did not change is the same object as before.

    Attributes
    ----------
    nodes
        The document's values.
    points
        Positions, (n, 2).
    times
        Manual parameters, (n,).
    corners
        Which nodes are corners, (n,).
    given
        Derivatives that the person set: ``[i, side, order - 1]``, side 0 before and 1 after the node,
        order 1 the velocity and 2 the acceleration; (n, 2, 2, 2).
    """

    nodes: tuple[Node, ...]
    points: FloatArray
    times: FloatArray
    corners: BoolArray
    given: FloatArray


def arrays_of(nodes: tuple[Node, ...], previous: NodeArrays | None = None) -> NodeArrays:
    """Return the arrays of `nodes`; rows of nodes that `previous` has too are taken from there."""
    if previous is None or len(previous.nodes) != len(nodes):
        return NodeArrays(nodes, *_columns(nodes))
    differs = np.fromiter(map(operator.is_not, nodes, previous.nodes), dtype=bool, count=len(nodes))
    rows = np.flatnonzero(differs)
    old = (previous.points, previous.times, previous.corners, previous.given)
    if not len(rows):
        return NodeArrays(nodes, *old)
    changed = [(nodes[row], previous.nodes[row]) for row in rows.tolist()]
    if all(_moved_alone(node, before) for node, before in changed):
        return NodeArrays(nodes, _with_rows(old[0], rows, _places([node for node, _ in changed])), *old[1:])
    fresh = _columns([node for node, _ in changed])
    return NodeArrays(
        nodes,
        _with_rows(old[0], rows, fresh[0]),
        _with_rows(old[1], rows, fresh[1]),
        _with_rows(old[2], rows, fresh[2]),
        _with_rows(old[3], rows, fresh[3]),
    )


def _moved_alone(node: Node, before: Node) -> bool:
    """Whether all that two nodes hold is the same object but for their places: as in a drag."""
    return all(map(operator.is_, _beside_place(node), _beside_place(before)))


def _columns(nodes: Sequence[Node]) -> tuple[FloatArray, FloatArray, BoolArray, FloatArray]:
    points = _places(nodes)
    times = np.array([np.nan if node.t is None else node.t for node in nodes], dtype=float)
    corners = np.array([node.corner for node in nodes], dtype=bool)
    given = np.array([_given(node) for node in nodes], dtype=float).reshape(-1, 2, 2, 2)
    for column in (points, times, corners, given):
        # Views of one curve after the other share what did not change.
        column.setflags(write=False)
    return points, times, corners, given


def _places(nodes: Sequence[Node]) -> FloatArray:
    return np.array([(node.x, node.y) for node in nodes], dtype=float).reshape(-1, 2)


def _given(node: Node) -> tuple[Vector, Vector, Vector, Vector]:
    velocity, acceleration = node.velocity or _NONE, node.acceleration or _NONE
    if not node.corner:
        return velocity, acceleration, velocity, acceleration
    return velocity, acceleration, node.velocity_after or _NONE, node.acceleration_after or _NONE


def _with_rows(old: Column, rows: IntArray, fresh: Column) -> Column:
    # By their bytes: NaN is NaN, and a comparison of NumPy's takes ten times as long.
    if old[rows].tobytes() == fresh.tobytes():
        return old
    result = old.copy()
    result[rows] = fresh
    result.setflags(write=False)
    return result
