"""SVG in: paths and basic shapes become cubic Hermite curves, with their styles, groups and names.

Coordinates are those of the file in the unit of its size, with y turned up. Nothing outside the file is ever
read. What does not come in as it is drawn is told, by kind and count.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field, replace

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.groups import tidy_shapes
from ...document.style import Style
from ...document.words import enumerated
from ...view_model.stroke_box import extent_of, half_width
from ..cubics_in import Imported, ImportedPath, Look, imported, parted
from ..drawing.outlines import Outline, painted_extent
from ..errors import ExchangeError, Flaw, Missed
from ..units import shifted
from .cascade import Cascade
from .context import Drawn, Group, Window, clip_box, is_seen, settled, with_line
from .coordinates import (
    Box,
    Viewport,
    box_of,
    combined,
    fitted_box,
    is_uneven,
    largest_scale,
    mean_scale,
    moved,
    sheet_of,
    shifting,
    transform_of,
)
from .own_files import OurOwn
from .shapes import LENGTHS, SHAPES, Subpath, UnknownLengthError, invalid_lengths, length_of, outline_of
from .styles import Paints, Properties, share_of, style_of
from .xml_tree import (
    INSENSITIVE,
    MAX_DEPTH,
    MAX_ELEMENTS,
    NODE_TYPES,
    Elements,
    name_of,
    parsed,
    shown_name,
    speaks_to_us,
    tag_of,
)

MAX_PATHS = 10_000

_CONTAINERS = {"svg", "g", "a", "switch", "symbol"}
_ONLY_WHEN_USED = {"defs", "symbol", "clipPath", "mask", "marker", "pattern"}
_NOT_APPLIED = "not applied"
_CLIPPED = Flaw("clip path", _NOT_APPLIED)
_CUT = Flaw("element", "came whole, beyond the view box")
_TRANSPARENT = Flaw("group", "came with the opacity on each shape separately")
_UNEVEN = Flaw("stroke", "of uneven width came with the mean width")
_NO_LENGTHS = Flaw("shape", "with lengths of unknown size left out")
_UNUSABLE = Flaw("reference", "to elements outside the file left out")
_CIRCULAR = Flaw("circular reference")
_UNKNOWN = Flaw("element", "with lengths of unknown size, which count as not given")
_INVALID = Flaw("element", "with invalid lengths, which count as not given")
_BEYOND = Flaw("element", "beyond all numbers left out")
_NO_TRANSFORM = Flaw("transform", _NOT_APPLIED)
_MAX_MEASURING = 20
"""Elements within each other whose transforms need to know what they hold."""

_WITH_SIZE = ("text", "flowRoot", "image", "foreignObject")
_NOTHING: Iterable[Drawn] = ()

_MOTION = Flaw("animation", "not played")
_TEXT = Flaw("text")

_NOT_READ = {
    "text": _TEXT,
    "flowRoot": _TEXT,
    "image": Flaw("picture"),
    "foreignObject": Flaw("foreign object"),
    "script": Flaw("script", "not run"),
    **dict.fromkeys(("animate", "set", "animateMotion", "animateTransform"), _MOTION),
}
"""Elements that show something else than curves, and what becomes of them."""

_EFFECTS = {
    "filter": Flaw("filter", _NOT_APPLIED),
    "mask": Flaw("mask", _NOT_APPLIED),
    "mix-blend-mode": Flaw("blend mode", _NOT_APPLIED),
}
_NO_EFFECT = ("none", "normal")
_WITH_LENGTHS = (*LENGTHS, "use", "svg")


def read_svg(data: bytes, tolerance: float | None = None) -> Imported:
    """Return the curves of an SVG file; of one without any, the edges of its page as guides.

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
        For anything that is no SVG or that is hostile: entities beyond bounds, more than `MAX_ELEMENTS`
        elements.
    """
    return _read(data, tolerance)[0]


def read_svg_above(data: bytes, tolerance: float | None = None) -> Imported:
    """Return the same; of a file of others whose corner is the origin it lies above the x axis."""
    found, reader = _read(data, tolerance)
    frame = reader.sheet.frame
    if reader.ours.is_so or frame is None or (frame.left, frame.top) != (0.0, 0.0):
        return found
    return replace(found, document=shifted(found.document, (0.0, frame.height)))


def _read(data: bytes, tolerance: float | None) -> tuple[Imported, _Reader]:
    root = parsed(data)
    if tag_of(root) != "svg":
        raise ExchangeError(f"This is no SVG file: it begins with <{tag_of(root)[:40]}>.")
    reader = _Reader(root, tolerance)
    found = imported(reader.all_paths(), reader.missed)
    guides = () if found.has_curves else reader.sheet.edges
    document = msgspec.structs.replace(found.document, unit=reader.sheet.unit, guides=guides)
    return replace(found, document=tidy_shapes(document)), reader


@dataclass(frozen=True, eq=False)
class State:
    """State that an element passes on to those in it.

    Attributes
    ----------
    matrix
        (2, 3), to the document's plane.
    viewport
        What percentages are parts of.
    around
        The elements that it is in, and those that a `use` shows, with the `use`.
    is_used
        Whether a `use` shows it.
    groups
        Those around it, the outermost first.
    windows
        The boxes that it is shown in, but for that of the file.
    is_locked
        Whether Inkscape keeps it from being touched.
    copied
        What the element is called that a `use` copies; empty for any other.
    """

    matrix: FloatArray
    viewport: Viewport
    properties: Properties = field(default_factory=Properties)
    around: tuple[ET.Element, ...] = ()
    is_used: bool = False
    groups: tuple[Group, ...] = ()
    windows: tuple[Window, ...] = ()
    is_locked: bool = False
    copied: str = ""


class _Reader:
    """Walks the tree of one file.

    Attributes
    ----------
    sheet
        Its size.
    missed
        What does not come in as it is.
    ours
        What only files of our own say.
    """

    def __init__(self, root: ET.Element, tolerance: float | None = None) -> None:
        self._root, self._tolerance = root, tolerance
        self.ours = OurOwn(root)
        self.missed = _Missing(root)
        self._cascade = Cascade(root, self.missed)
        font_size = self._cascade.of(root).get("font-size", "")
        self.sheet = sheet_of(root, font_size, is_nominal=self.ours.has_nominal_size)
        self._elements = elements = Elements.within(root, self._cascade.of)
        self._paints = Paints(elements)
        self._found = 0
        self._shapes: list[ET.Element] = []
        self._measuring = 0
        # Shared with those that measure: how many elements were drawn, and how many measured; and boxes.
        self._visits = [0, 0]
        self._extents: dict[tuple[object, ...], FloatArray] = {}

    def all_paths(self) -> list[ImportedPath]:
        """Return the paths of the file; of those that nobody painted only where there are no others."""
        drawn = list(self._drawn(self._root, State(self.sheet.matrix, self.sheet.viewport), depth=0))
        seen = [each for each in drawn if is_seen(each)]
        flaw = Flaw(
            "shape", "without stroke and fill " + ("left out" if seen else "came with a plain stroke")
        )
        unseen = [each for each in drawn if not is_seen(each) and each.path.look.visible]
        for number in dict.fromkeys(each.element for each in unseen):
            self.missed.note_of(self._shapes[number - 1], flaw)
        return settled(seen or [with_line(each) for each in drawn])

    def _drawn(self, element: ET.Element, state: State, depth: int) -> Iterator[Drawn]:
        """Yield the paths of an element and those in it."""
        self._visits[self._measuring > 0] += 1
        if max(self._visits) > MAX_ELEMENTS:
            raise ExchangeError(f"The file draws more than {MAX_ELEMENTS} elements.")
        if element.get("requiredExtensions") or self.ours.is_no_curve(element):
            return
        declared = self._cascade.of(element)
        state = self._entered(element, declared, self._transformed(element, declared, state, depth))
        if not np.isfinite(state.matrix).all():
            self.missed.note_at(element, _BEYOND)
            return
        yield from self._content(element, declared, state, depth)

    def _content(
        self, element: ET.Element, declared: Mapping[str, str], state: State, depth: int
    ) -> Iterator[Drawn]:
        """Yield the paths of an element and those in it, in its own state."""
        tag, first, found = tag_of(element), len(self._shapes), _NOTHING
        if self._measuring and not state.properties.is_displayed:
            return
        if self._measuring and tag in _WITH_SIZE:
            raise UnknownLengthError
        if tag in _NOT_READ and state.properties.is_visible:
            self.missed.note_of(element, _NOT_READ[tag])
        elif tag in SHAPES:
            found = self._shape(element, tag, declared, state)
        elif tag == "use":
            found = self._used(element, state, depth)
        elif tag in _CONTAINERS:
            found = self._contained(element, tag, state, depth)
        yield from found
        count = len(self._shapes) - first
        if count and state.properties.is_visible:
            self._note_effects(element, declared, state, is_many=count > 1)

    def _transformed(
        self, element: ET.Element, declared: Mapping[str, str], state: State, depth: int
    ) -> State:
        """Return the state around an element as its transform changes it."""
        text = element.get("transform", "").strip()
        if text.lower() in ("", "none"):
            return state
        box, corner = self._viewport(element, declared, state), (0.0, 0.0)
        kind = declared.get("transform-box", "").lower()
        try:
            if kind in _BOXES:
                (x, y), (right, bottom) = self._extent(element, declared, state, depth, kind)
                box, corner = box.sized(right - x, bottom - y), (x, y)
            matrix = transform_of(text, box, element.get("transform-origin", ""), corner)
        except ExchangeError as problem:
            if self._measuring:
                raise UnknownLengthError from None
            self.missed.note_at(element, _NO_TRANSFORM, str(problem))
            return state
        return replace(state, matrix=combined(state.matrix, matrix))

    def _extent(
        self, element: ET.Element, declared: Mapping[str, str], state: State, depth: int, kind: str
    ) -> FloatArray:
        """Return the corners, (2, 2), of a box around an element, in its own units."""
        key = (element, *state.around, _BOXES[kind])
        if key not in self._extents:
            probe = copy(self)
            probe._measuring, probe._shapes, probe.missed = self._measuring + 1, [], self.missed.emptied()
            inner = probe._entered(element, declared, replace(state, matrix=np.eye(2, 3), windows=()))
            try:
                if self._measuring == _MAX_MEASURING:
                    raise UnknownLengthError
                paths = [each.path for each in probe._content(element, declared, inner, depth)]
            except UnknownLengthError:
                raise ExchangeError(f"in its {kind}") from None
            with np.errstate(all="ignore"):
                corners = [_BOXES[kind](path) for path in paths] or [np.zeros((2, 2))]
            self._extents[key] = np.array([np.min(corners, axis=(0, 1)), np.max(corners, axis=(0, 1))])
        return self._extents[key]

    def _viewport(self, element: ET.Element, declared: Mapping[str, str], state: State) -> Viewport:
        """Return the viewport with the font of an element."""
        size = declared.get("font-size", "")
        return state.viewport if element is self._root else state.viewport.with_font(size)

    def _entered(self, element: ET.Element, declared: Mapping[str, str], state: State) -> State:
        state = replace(state, viewport=self._viewport(element, declared, state))
        matrix, windows = state.matrix, state.windows
        if tag_of(element) in _WITH_LENGTHS and (invalid := invalid_lengths(element)):
            self.missed.note_at(element, _INVALID, enumerated(invalid))
        if tag_of(element) == "use":
            x, y = (self._length(element, name, state) or 0.0 for name in ("x", "y"))
            matrix = combined(matrix, shifting(x, y))
        if (box := clip_box(self._elements, declared, state.viewport)) is not None:
            windows = (*windows, Window(box, matrix, element, _CLIPPED))
        return replace(
            state,
            matrix=matrix,
            around=(*state.around, element),
            windows=windows,
            properties=state.properties.entered(declared, state.viewport),
            # What is locked where it is drawn is not so where it is used.
            is_locked=state.is_locked or (not state.is_used and element.get(INSENSITIVE) == "true"),
        )

    def _contained(self, element: ET.Element, tag: str, state: State, depth: int) -> Iterator[Drawn]:
        name, state = state.copied or name_of(element), replace(state, copied="")
        if tag == "g" or (depth > 0 and name):
            state = replace(state, groups=(*state.groups, Group(self._visits[0], name)))
        if tag == "svg" and depth > 0:
            x, y = (self._length(element, name, state) or 0.0 for name in ("x", "y"))
            state = self._in_view_box(element, element, state, (x, y))
        for child in element:
            if tag_of(child) not in _ONLY_WHEN_USED and speaks_to_us(child):
                yield from self._drawn(child, state, depth + 1)
                if tag == "switch":
                    break

    def _in_view_box(
        self, element: ET.Element, sized: ET.Element, state: State, corner: tuple[float, float]
    ) -> State:
        """Return the state in a view box, whose size another element may say."""
        width, height = (
            self._length(sized, name, state) or self._length(element, name, state) or whole
            for name, whole in (("width", state.viewport.width), ("height", state.viewport.height))
        )
        box = box_of(element.get("viewBox", ""))
        if width is None or height is None or width <= 0 or height <= 0:
            return replace(state, matrix=combined(state.matrix, shifting(*corner)))
        place: Box = (*corner, width, height)
        windows = state.windows
        if self._cascade.of(element).get("overflow") != "visible":
            windows = (*windows, Window(place, state.matrix, sized, _CUT))
        if box is None:
            matrix = combined(state.matrix, shifting(*corner))
            return replace(
                state, matrix=matrix, viewport=state.viewport.sized(width, height), windows=windows
            )
        fit = fitted_box(box, place, element.get("preserveAspectRatio", ""))
        matrix = combined(state.matrix, fit)
        return replace(state, matrix=matrix, viewport=state.viewport.sized(*box[2:]), windows=windows)

    def _used(self, element: ET.Element, state: State, depth: int) -> Iterator[Drawn]:
        target = self._elements.used(element)
        if target is None:
            self.missed.note_of(element, _UNUSABLE)
            return
        if depth > MAX_DEPTH or target in state.around:
            self.missed.note_at(element, _CIRCULAR)
            return
        # Of several within each other the outermost is what a person sees as the copy.
        name = state.copied or name_of(element) or f"{name_of(target)} copy"
        state = replace(state, is_used=True, copied=name)
        if tag_of(target) in ("symbol", "svg"):
            state = self._in_view_box(target, element, state, (0.0, 0.0))
            declared = self._cascade.of(target)
            state = self._transformed(target, declared, state, depth + 1)
            yield from self._contained(target, "symbol", self._entered(target, declared, state), depth + 1)
        else:
            yield from self._drawn(target, state, depth + 1)

    def _shape(
        self, element: ET.Element, tag: str, declared: Mapping[str, str], state: State
    ) -> Iterator[Drawn]:
        stretch = largest_scale(state.matrix)
        tolerance = self._tolerance / stretch if self._tolerance is not None and stretch > 0 else None
        try:
            with np.errstate(all="ignore"):
                subpaths, error = outline_of(element, state.viewport, tolerance)
        except UnknownLengthError:
            self.missed.note_at(element, _NO_LENGTHS)
            return
        except ExchangeError:
            self.missed.note_at(element, _BEYOND)
            return
        if error:
            self.missed.note_at(element, Flaw(tag, "drawn only up to an error in the data"), error)
        drawn = [each for each in subpaths if each.has_length or (state.properties.has_caps and each.is_line)]
        if not drawn:
            return
        self._shapes.append(element)
        name = state.copied or self.missed.name_of(element)
        keeps_width = declared.get("vector-effect") == "non-scaling-stroke"
        scale = self.sheet.pixel if keeps_width else mean_scale(state.matrix)
        look = self._look(element, state, scale, keeps_width=keeps_width)
        look = replace(look, shape=name) if len(drawn) > 1 else look
        if look.visible:
            self._note_windows(state, drawn, look.style)
        sizes = [(len(each.controls), each.closed) for each in drawn]
        letters = parted(element.get(NODE_TYPES, ""), sizes)
        for index, subpath in enumerate(drawn):
            self._found += 1
            if self._found > MAX_PATHS:
                raise ExchangeError(f"The file has more than {MAX_PATHS} paths.")
            path = ImportedPath(
                name if len(drawn) == 1 else f"{name} ({index + 1})",
                look,
                moved(subpath.cleaned, state.matrix),
                subpath.closed,
                subpath.deviation * stretch,
                letters[index],
                look.style.has_caps,
            )
            yield Drawn(path, len(self._shapes), state.groups)

    def _note_windows(self, state: State, drawn: Iterable[Subpath], style: Style) -> None:
        """Tell which of the boxes that a shape is shown in cut some of it off."""
        if state.windows:
            extent = extent_of(np.concatenate([moved(each.cleaned, state.matrix) for each in drawn]))
            reach = half_width(style)
            for window in state.windows:
                if not window.holds(extent, reach):
                    self.missed.note_of(window.element, window.flaw)

    def _look(self, element: ET.Element, state: State, scale: float, *, keeps_width: bool) -> Look:
        style, flaws = style_of(state.properties, self._paints, state.viewport, scale)
        if style.has_stroke and not keeps_width and is_uneven(state.matrix):
            flaws = (*flaws, _UNEVEN)
        if state.properties.is_visible:
            self.missed.note_of(element, *flaws)
        visible = state.properties.is_visible
        return Look(self.ours.restored(style), visible=visible, locked=state.is_locked)

    def _length(self, element: ET.Element, name: str, state: State) -> float | None:
        try:
            return length_of(element, name, state.viewport)
        except UnknownLengthError:
            self.missed.note_at(element, _UNKNOWN, name)
            return None

    def _note_effects(
        self, element: ET.Element, declared: Mapping[str, str], state: State, *, is_many: bool
    ) -> None:
        """Tell what an element that holds shapes does to them beside their styles."""
        found = [flaw for name, flaw in _EFFECTS.items() if declared.get(name, "none") not in _NO_EFFECT]
        is_clipped = declared.get("clip-path", "none") != "none"
        if is_clipped and clip_box(self._elements, declared, state.viewport) is None:
            found.append(_CLIPPED)
        if is_many and share_of(declared.get("opacity", "1")) < 1:
            found.append(_TRANSPARENT)
        self.missed.note_of(element, *found)
        for child in element:
            if _NOT_READ.get(tag_of(child)) is _MOTION:
                self.missed.note_of(child, _MOTION)


def _fill_box(path: ImportedPath) -> FloatArray:
    return extent_of(path.pieces)


def _stroke_box(path: ImportedPath) -> FloatArray:
    outline = Outline("", path.pieces, path.pieces[:0, 0], 0.0, path.closed, path.look.style)
    return painted_extent(outline)


_BOXES = {
    "fill-box": _fill_box,
    "content-box": _fill_box,
    "stroke-box": _stroke_box,
    "border-box": _stroke_box,
}
"""Returns the corners of the box of a path, for each `transform-box` but the view box."""


class _Missing(Missed):
    """What is missed of the elements of one file."""

    def __init__(self, root: ET.Element) -> None:
        super().__init__()
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}

    def emptied(self) -> _Missing:
        """Return another one of the same file, of which nothing is missed."""
        other = copy(self)
        other._names = {}
        return other

    def name_of(self, element: ET.Element) -> str:
        """Return the name of an element, or else its tag and its number in the file, from 1."""
        return name_of(element) or f"{tag_of(element).capitalize()} {self._number[element]}"

    def note_of(self, element: ET.Element, *flaws: Flaw) -> None:
        """Take note of what is missed of an element, once, however often that is used."""
        for flaw in flaws:
            self.note(flaw, element, shown_name(element))

    def note_at(self, element: ET.Element, flaw: Flaw, where: str = "") -> None:
        """Take note of an error in an element, and where in it, once for each flaw."""
        self.note(flaw, element, f"{self.name_of(element)} {where}".strip())
