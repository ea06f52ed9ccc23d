"""Boolean operations on shapes: a record for each, and what becomes of the document.

Shapes are taken with the insides that their fill rules say, whether they are filled or not; open curves are
closed by straight lines. A group is one operand, all of its shapes united; where it is all that is chosen,
what is in it are the operands. What comes out are cubic Hermite curves in the place of the hindmost, with
its style. Pieces that are not cut keep their handles.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial
from itertools import chain, islice
from typing import TYPE_CHECKING, TypeAlias, TypeVar

import msgspec
import numpy as np
from msgspec.structs import replace

import curvecore
from curvecore import CurveError
from curvecore.arrays import FloatArray

from ...document.contents import refuse_contents
from ...document.curve_tree import Node, NodeKind
from ...document.edits import EditError
from ...document.model import Curve, Document, Parametrization, ParametrizationKind
from ...document.shape_edits import objects
from ...document.shapes import shape_of, shapes, tidy_shapes
from ...document.style import FillRule, Style
from ...document.words import names_of
from ...families import HERMITE
from ...tasks.progress import Report, part, silent
from ..curve.curve_view import CurveView
from .cubics import RELATIVE_TOLERANCE, points_of_cubics

if TYPE_CHECKING:
    from curvecore import Region, WindingRule

Computed = TypeVar("Computed")

Combine: TypeAlias = "Callable[[Sequence[Region], Callable[[float], object]], Sequence[Region]]"
"""Returns what becomes of regions, the hindmost first; tells a share that is done."""


class PathOperation(msgspec.Struct, frozen=True, kw_only=True):
    """A boolean operation on shapes.

    Attributes
    ----------
    name
        The name of its action.
    title
        What people call it.
    key
        The keys of that, comma separated.
    drawing_key
        The same in drawings, where it differs.
    icon
        A file of resources/icons, without suffix.
    tip
        What becomes of the shapes.
    keywords
        Other words by which the palette finds it.
    least
        How many shapes it takes at least.
    combine
        What it does with the insides of shapes and groups.
    """

    name: str
    title: str
    key: str
    drawing_key: str | None = None
    icon: str
    tip: str
    keywords: str = ""
    least: int = 2
    combine: Combine


# Keys are Inkscape's where they are free, and those of Figma. In a sketch Ctrl++ and Ctrl+- zoom.
PATH_OPERATIONS = (
    PathOperation(
        name="pathUnion",
        title="Union",
        key="Alt+Shift+U",
        drawing_key="Ctrl++, Ctrl+=, Alt+Shift+U",
        icon="path-union",
        tip="Make one outline around all chosen shapes; of a single one without its own crossings",
        keywords="boolean add unite merge weld remove overlap path",
        least=1,
        combine=lambda regions, told: [curvecore.union(regions, progress=told)],
    ),
    PathOperation(
        name="pathDifference",
        title="Difference",
        key="Alt+Shift+S",
        drawing_key="Ctrl+-, Alt+Shift+S",
        icon="path-difference",
        tip="Take the shapes in front away from the hindmost one",
        keywords="boolean subtract minus front punch cut out path",
        combine=lambda regions, told: [curvecore.difference(regions[0], regions[1:], progress=told)],
    ),
    PathOperation(
        name="pathIntersection",
        title="Intersection",
        key="Ctrl+*, Alt+Shift+I",
        icon="path-intersection",
        tip="Keep what lies in all chosen shapes",
        keywords="boolean intersect common overlap path",
        combine=lambda regions, told: [curvecore.intersection(regions, progress=told)],
    ),
    PathOperation(
        name="pathExclusion",
        title="Exclusion",
        key="Ctrl+^, Alt+Shift+E",
        icon="path-exclusion",
        tip="Keep what lies in an odd number of the chosen shapes: of two, in one but not in both",
        keywords="boolean xor exclude symmetric difference path",
        combine=lambda regions, told: [curvecore.exclusion(regions, progress=told)],
    ),
    PathOperation(
        name="pathDivision",
        title="Division",
        key="Ctrl+/, Alt+Shift+V",
        icon="path-division",
        tip="Cut the hindmost shape into parts along the outlines of those in front",
        keywords="boolean divide split slice knife path",
        combine=lambda regions, told: curvecore.division(regions[0], regions[1:], progress=told),
    ),
)
"""The operations, in the order of the menu."""


class Combined(msgspec.Struct, frozen=True):
    """A document in which shapes were combined.

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


def combined_by(
    operation: PathOperation,
    document: Document,
    views: Sequence[CurveView],
    curves: Collection[int],
    report: Report = silent,
) -> Combined:
    """Return the document with the shapes of some curves combined; `views` are those of all curves.

    Raises
    ------
    EditError
        If there are too few, if one has no outline, or if nothing would be left.
    """
    chosen = operands(document, curves)
    if len(chosen) < operation.least:
        raise EditError(f"Choose two shapes or more for {operation.title.lower()}.")
    parts = [chosen_shapes(document, node.places) for node in chosen]
    regions, deviation = regions_of(document, views, list(chain.from_iterable(parts)))
    found = computed(partial(_combined, operation, regions, list(map(len, parts)), report))
    left = [region for region in found if region.contours]
    if not left:
        what = names_of([f"“{node.name}”" for node in chosen])
        raise EditError(f"Nothing would be left: {operation.title.lower()} of {what} is empty.")
    names, first = Names(chosen[0].name, taken_names(document)), chosen[0].places.start
    # It takes the place of the group that it is made of.
    model = replace(document.curves[first], groups=chosen[0].around.groups)
    speck = RELATIVE_TOLERANCE * size_of(
        [views[place] for own in parts for places in own for place in places]
    )
    new = [curve for region in left for curve in curves_of(region, model, names.next(), speck)]
    made = {places: new if places.start == first else [] for own in parts for places in own}
    return Combined(*replaced(document, made), len(left), deviation)


def _combined(
    operation: PathOperation, regions: Sequence[Region], counts: Sequence[int], report: Report
) -> Sequence[Region]:
    """Return operands combined, each of so many of the regions."""
    united, told, rest = part(report, 0.1, 0.3), part(report, 0.3, 0.9), iter(regions)
    each = [
        _united(list(islice(rest, count)), part(united, k / len(counts), (k + 1) / len(counts)))
        for k, count in enumerate(counts)
    ]
    return operation.combine(each, lambda share: told(share, operation.title))


def computed(compute: Callable[[], Computed]) -> Computed:
    """Return what is computed; raise `EditError` where roundings hide how outlines lie."""
    try:
        return compute()
    except CurveError as problem:
        raise EditError(f"This could not be computed: {problem}.") from problem


def _united(regions: Sequence[Region], report: Report) -> Region:
    """Return the insides of all shapes of a group as one; that of a single shape as it is."""
    if len(regions) == 1:
        return regions[0]
    return curvecore.union(regions, progress=lambda share: report(share, "Union"))


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


def regions_of(
    document: Document, views: Sequence[CurveView], chosen: Sequence[range]
) -> tuple[list[Region], float]:
    """Return the insides of shapes, and how far they are from them at most."""
    regions: list[Region] = []
    deviation = 0.0
    size = size_of([views[place] for places in chosen for place in places])
    for places in chosen:
        contours, off = outlines_of([views[place] for place in places], size)
        rule = _winding_rule(document.curves[places.start].style)
        regions.append(curvecore.Region(contours, rule))
        deviation = max(deviation, off)
    return regions, deviation


def _winding_rule(style: Style) -> WindingRule:
    rules = curvecore.WindingRule
    return rules.EVEN_ODD if style.fill_rule is FillRule.EVENODD else rules.NONZERO


def outlines_of(views: Sequence[CurveView], size: float = 0.0) -> tuple[list[FloatArray], float]:
    """Return curves as cubic pieces, and how far these are from them at most.

    Raises
    ------
    EditError
        If there is no curve, or if one is the frame of a text or a picture.
    """
    refuse_contents([view.source for view in views])
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


def size_of(views: Sequence[CurveView]) -> float:
    """Return the longer side of the box around the points of curves; 1 where there are none."""
    points = [view.points for view in views if len(view.points)]
    return float(np.ptp(np.concatenate(points), axis=0).max()) if points else 1.0


def curves_of(region: Region, model: Curve, name: str, speck: float) -> list[Curve]:
    """Return the contours of a region as closed curves that look like another one, and are one shape.

    Points are no nearer together than a `speck`, within which nobody sees them apart.
    """
    region = region.without_specks(speck)
    several = len(region.contours) > 1
    return [
        Curve(
            f"{name} ({number})" if several else name,
            HERMITE,
            Parametrization(ParametrizationKind.MANUAL),
            points_of_cubics(contour[(contour != contour[:, :1]).any(axis=(1, 2))], closed=True).points,
            closed=True,
            style=model.style,
            shape=name if several else "",
            groups=model.groups,
            group_looks=model.group_looks,
            visible=model.visible,
        )
        for number, contour in enumerate(region.contours, start=1)
    ]
