"""The shapes among curves: what of the document an action on them works on, and what comes in their place."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import msgspec
from msgspec.structs import replace

import curvecore
from curvecore.arrays import FloatArray

from ...document.curve_tree import Node, NodeKind
from ...document.edits import EditError
from ...document.model import Curve, Document
from ...document.shape_edits import objects
from ...document.shapes import shape_of, shapes, tidy_shapes
from ...document.words import names_of
from ..curve.curve_view import CurveView
from ..fitting.cubics import RELATIVE_TOLERANCE
from ..fitting.simplifying import size_of


class Combined(msgspec.Struct, frozen=True):
    """A document in which others came in the place of shapes.

    Attributes
    ----------
    document
        The document.
    places
        Where the outcome is in it.
    shapes
        Of how many shapes that is.
    deviation
        How far what was no cubic is from what it was; 0 where all were.
    """

    document: Document
    places: frozenset[int]
    shapes: int
    deviation: float


def chosen_shapes(document: Document, curves: Collection[int]) -> list[range]:
    """Return the places of the curves of each shape among those chosen, the hindmost first."""
    return sorted({shape_of(document, place) for place in curves}, key=lambda places: places.start)


def operands(document: Document, curves: Collection[int]) -> list[Node]:
    """Return the groups and shapes among some curves, the hindmost first; of a single group what is in it."""
    nodes = objects(document, curves)
    while len(nodes) == 1 and nodes[0].kind is NodeKind.GROUP:
        nodes = list(nodes[0].parts)
    return nodes


def named_operands(document: Document, curves: Collection[int]) -> str:
    """Return the names of the groups and shapes among some curves, the hindmost first."""
    return names_of([node.name for node in operands(document, curves)])


def replaced(document: Document, made: Mapping[range, Sequence[Curve]]) -> tuple[Document, frozenset[int]]:
    """Return the document with other curves in the places of shapes, and where these are."""
    curves, places = list[Curve](), set[int]()
    for shape in shapes(document.curves):
        new = made.get(shape)
        if new is not None:
            places.update(range(len(curves), len(curves) + len(new)))
        curves += document.curves[shape.start : shape.stop] if new is None else new
    after = tidy_shapes(replace(document, curves=tuple(curves)))
    return after, frozenset(places)


def name_of_shape(document: Document, places: range) -> str:
    """Return the name of a shape, or of the curve that it is."""
    first = document.curves[places.start]
    return first.shape or first.name


def taken_names(document: Document) -> set[str]:
    """Return the names of all curves, shapes and groups."""
    return {name for curve in document.curves for name in (curve.name, curve.shape, *curve.groups)}


class Names:
    """Names of the outcome: that of the hindmost shape, then numbered ones that nobody has."""

    def __init__(self, base: str, taken: Collection[str]) -> None:
        self._base, self._taken, self._number = base, taken, 1

    def next(self) -> str:
        """Return another name."""
        name = self._base
        while self._number > 1 and (name == self._base or name in self._taken):
            name, self._number = f"{self._base} {self._number}", self._number + 1
        self._number = max(self._number, 2)
        return name


def outlines_of(views: Sequence[CurveView], size: float = 0.0) -> tuple[list[FloatArray], float]:
    """Return curves as cubic pieces, and how far these are from them at most.

    Raises
    ------
    EditError
        If there is no curve.
    """
    tolerance = max(RELATIVE_TOLERANCE * (size or size_of(views)), 1e-300)
    outlines, deviation = list[FloatArray](), 0.0
    for view in views:
        if not view.is_current or view.curve is None:
            raise EditError(f"“{view.source.seen_name}” has no outline. {view.problem}")
        path = curvecore.cubic_path(view.curve, tolerance)
        outline = path.control_points.copy()
        if view.source.is_closed:
            outline[-1, 3] = outline[0, 0]
        outlines.append(outline)
        deviation = max(deviation, float(path.deviation))
    return outlines, deviation
