"""SVG in: paths and basic shapes become cubic Hermite curves, with their styles, groups and names.

Coordinates are those of the file in the unit of its size, with y turned up. Nothing outside the file is ever
read, and no DTD or entity inside it. What does not come in as it is drawn is told, element by element.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.model import Document
from ..cubics_in import Imported, ImportedPath, Look, imported
from ..errors import ExchangeError
from ..missed import Missed
from .basic_shapes import LENGTHS, polyline, shape_of_lengths
from .cascade import Cascade
from .clips import Clips
from .groups import GroupNames, settled
from .lengths import length
from .matrices import box_of, combined, fitted_box, is_uneven, largest_scale, mean_scale, moved, transform_of
from .names import name_of, shown_name
from .our_own import OurOwn
from .paint import Paints
from .path_data import Subpath, read_path_data
from .properties import Flaw, StyleReader
from .sheet import sheet_of
from .state import State, Window
from .xml_tree import MAX_DEPTH, MAX_ELEMENTS, parsed, reference_of, tag_of

MAX_PATHS = 2_000

_CONTAINERS = {"svg", "g", "a", "switch", "symbol"}
_SHAPES = {"path", "polyline", "polygon", *LENGTHS}
_ONLY_WHEN_USED = {"defs", "symbol", "clipPath", "mask", "marker", "pattern"}
_NO_CURVES = {
    "text": Flaw("text is no curve", "left out; as paths it would come in"),
    "flowRoot": Flaw("text is no curve", "left out; as paths it would come in"),
    "image": Flaw("a picture is no curve", "left out"),
    "foreignObject": Flaw("it is of another kind than SVG", "left out"),
    "script": Flaw("programs are not run", "left out"),
    "animate": Flaw("motion is not taken over", "it comes in as it begins"),
}
_NO_CURVES |= dict.fromkeys(("set", "animateMotion", "animateTransform"), _NO_CURVES["animate"])
_EFFECTS = {
    "mask": Flaw("a mask covers some of it", "it comes in whole"),
    "filter": Flaw("a filter changes it", "it comes in without"),
    "mix-blend-mode": Flaw("it is blended with what lies below", "it covers that"),
}
_CLIPPED = Flaw("a clip path cuts some of it off", "it comes in whole")
_CUT_OFF = Flaw("the view box around it cuts some of it off", "it comes in whole")
_TRANSPARENT = Flaw("it is transparent as a whole", "each of its shapes is")
_UNEVEN = Flaw("its transform makes the stroke uneven", "it has the mean width all along")
_NO_LENGTHS = Flaw("its lengths hang on a font or on a size that nobody says", "left out")
_ONE_POINT = Flaw("it is a single point", "left out")
_UNPAINTED = "it has neither a stroke nor a fill"


def read_svg(data: bytes, tolerance: float | None = None) -> Imported:
    """Return the curves of an SVG file.

    Cubic and quadratic pieces and lines are taken exactly but for rounding; arcs, circles and ellipses
    become cubics, one for each quarter turn.

    Parameters
    ----------
    data
        The whole file.
    tolerance
        Largest distance from arcs, in the unit of the file's size; by default 2.8e-4 of their radius.

    Raises
    ------
    ExchangeError
        With the element, for anything that is no SVG or that is hostile: a DTD, entities, elements that
        use themselves, more than `MAX_ELEMENTS` elements, broken data.
    """
    root = parsed(data)
    if tag_of(root) != "svg":
        raise ExchangeError(f"This is no SVG file: it begins with <{tag_of(root)[:40]}>.")
    reader = _Reader(root, tolerance)
    paths = reader.all_paths()
    found = imported(paths, tuple(reader.missed))
    document = msgspec.structs.replace(found.document, unit=reader.sheet.unit, page=reader.sheet.page)
    return replace(found, document=document)


class _Reader:
    """Walks the tree of one file.

    Attributes
    ----------
    sheet
        Its size.
    missed
        What does not come in as it is.
    """

    def __init__(self, root: ET.Element, tolerance: float | None) -> None:
        self._root, self._tolerance = root, tolerance
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}
        self._by_id = {element.get("id", ""): element for element in root.iter()}
        self._ours = OurOwn(root)
        self.sheet = sheet_of(root, is_nominal=self._ours.has_nominal_size)
        self._cascade = Cascade(root)
        self.missed: list[Missed] = list(self._cascade.missed)
        self._styles = StyleReader(Paints(self._by_id, self._cascade.of))
        self._clips = Clips(root, self._by_id)
        self._names = GroupNames()
        self._visited = self._found = 0
        self._unpainted: list[tuple[int, ET.Element]] = []
        """Shapes of which nothing is seen, by the number of the first path that comes after them."""

    def all_paths(self) -> list[ImportedPath]:
        """Return the paths of the file."""
        state = State(self.sheet.matrix, self.sheet.viewport)
        paths = list(self._paths(self._root, state, depth=0))
        seen = [path for path in paths if path.look.style.is_painted]
        # A file of nothing else is one of lines that nobody painted yet.
        if not seen:
            paths = [replace(path, look=replace(path.look, style=self._ours.ink)) for path in paths]
        for _, element in self._unpainted:
            self._miss(element, Flaw(_UNPAINTED, "left out" if seen else "it comes in as a line"))
        return settled(seen or paths)

    def _paths(self, element: ET.Element, state: State, depth: int) -> Iterator[ImportedPath]:
        """Yield the paths of an element and those in it."""
        self._visited += 1
        if self._visited > MAX_ELEMENTS:
            raise ExchangeError(f"The file draws more than {MAX_ELEMENTS} elements.")
        tag = tag_of(element)
        if element.get("requiredExtensions") or self._ours.is_no_curve(element):
            return
        state = self._entered(element, state)
        if tag in _NO_CURVES:
            if state.properties.is_visible:
                self._miss(element, _NO_CURVES[tag])
        elif tag in _SHAPES:
            yield from self._shape(element, tag, state)
        elif tag == "use":
            yield from self._used(element, state, depth)
        elif tag in _CONTAINERS:
            yield from self._contained(element, tag, state, depth)
