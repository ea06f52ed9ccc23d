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
from ...view_model.extents import extent_of, half_width
from ..cubics_in import ImportedPath, ImportResult, Look, import_paths, split_letters
from ..drawing.outlines import Outline, painted_extent
from ..errors import ExchangeError, Loss, Losses
from ..units import shifted
from .cascade import Cascade
from .context import ClipBox, DrawnPath, Group, clip_box, is_painted, with_group_names, with_line
from .coordinates import (
    Box,
    Viewport,
    box_of,
    composed,
    fitted_box,
    is_uneven,
    largest_scale,
    mean_scale,
    page_of,
    transform_of,
    transform_points,
    translation,
)
from .own_files import OwnFile
from .shapes import LENGTHS, SHAPES, Subpath, UnknownLengthError, invalid_lengths, length_of, outline_of
from .styles import Paints, Properties, share_of, style_of
from .xml_tree import (
    INSENSITIVE,
    MAX_DEPTH,
    MAX_ELEMENTS,
    NODE_TYPES,
    Elements,
    is_for_english_readers,
    label_of,
    name_of,
    parse_xml,
    tag_of,
)

MAX_PATHS = 10_000

_CONTAINERS = {"svg", "g", "a", "switch", "symbol"}
_ONLY_WHEN_USED = {"defs", "symbol", "clipPath", "mask", "marker", "pattern"}
_NOT_APPLIED = "not applied"
_CLIPPED = Loss("clip path", _NOT_APPLIED)
_CUT = Loss("element", "imported whole, beyond the view box")
_TRANSPARENT = Loss("group", "imported with the opacity on each shape separately")
_UNEVEN = Loss("stroke", "of uneven width imported with the mean width")
_NO_LENGTHS = Loss("shape", "with lengths of unknown size left out")
_UNUSABLE = Loss("reference", "to elements outside the file left out")
_CIRCULAR = Loss("circular reference")
_UNKNOWN = Loss("element", "with lengths of unknown size, which were ignored")
_INVALID = Loss("element", "with invalid lengths, which were ignored")
_BEYOND = Loss("element", "with coordinates out of range left out")
_NO_TRANSFORM = Loss("transform", _NOT_APPLIED)
_MAX_MEASURING = 20
"""Limit of nested elements whose transforms depend on the box around their content."""

_WITH_SIZE = ("text", "flowRoot", "image", "foreignObject")
_NOTHING: Iterable[DrawnPath] = ()

_MOTION = Loss("animation", "not played")
_TEXT = Loss("text")

_NOT_READ = {
    "text": _TEXT,
    "flowRoot": _TEXT,
    "image": Loss("picture"),
    "foreignObject": Loss("foreign object"),
    "script": Loss("script", "not run"),
    **dict.fromkeys(("animate", "set", "animateMotion", "animateTransform"), _MOTION),
}
"""Elements that show something else than curves, with their loss."""

_EFFECTS = {
    "filter": Loss("filter", _NOT_APPLIED),
    "mask": Loss("mask", _NOT_APPLIED),
    "mix-blend-mode": Loss("blend mode", _NOT_APPLIED),
}
_NO_EFFECT = ("none", "normal")
_WITH_LENGTHS = (*LENGTHS, "use", "svg")


def read_svg(data: bytes, tolerance: float | None = None) -> ImportResult:
    """Return the curves of an SVG file; of one without any, the edges of its page as guides.

    Cubic and quadratic pieces and lines are read exactly but for rounding; arcs, circles and ellipses
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
        For files that are not SVG, or hostile: entities out of bounds, more than `MAX_ELEMENTS`
        elements.
    """
    return _read(data, tolerance)[0]


def read_svg_above(data: bytes, tolerance: float | None = None) -> ImportResult:
    """Return the same curves, above the x axis for files of other programs with the origin in a corner."""
    result, reader = _read(data, tolerance)
    frame = reader.page.frame
    if reader.ours.is_own or frame is None or (frame.left, frame.top) != (0.0, 0.0):
        return result
    return replace(result, document=shifted(result.document, (0.0, frame.height)))


def _read(data: bytes, tolerance: float | None) -> tuple[ImportResult, _Reader]:
    root = parse_xml(data)
    if tag_of(root) != "svg":
        raise ExchangeError(f"This is not an SVG file: it begins with <{tag_of(root)[:40]}>.")
    reader = _Reader(root, tolerance)
    result = import_paths(reader.all_paths(), reader.losses)
    guides = () if result.has_curves else reader.page.edges
    document = msgspec.structs.replace(result.document, unit=reader.page.unit, guides=guides)
    return replace(result, document=tidy_shapes(document)), reader


@dataclass(frozen=True, eq=False)
class ElementContext:
    """State that an element passes on to its children.

    Attributes
    ----------
    matrix
        (2, 3), to the document's plane.
    viewport
        Viewport that percentages refer to.
    around
        Its ancestors, including each `use` and its target.
    is_used
        Whether the element is shown by a `use`.
    groups
        Groups around the element, the outermost first.
    clips
        Boxes that clip the element, except that of the file.
    is_locked
        Whether the element is locked in Inkscape.
    copied
        Name of the element that a `use` copies; empty for other elements.
    """

    matrix: FloatArray
    viewport: Viewport
    properties: Properties = field(default_factory=Properties)
    around: tuple[ET.Element, ...] = ()
    is_used: bool = False
    groups: tuple[Group, ...] = ()
    clips: tuple[ClipBox, ...] = ()
    is_locked: bool = False
    copied: str = ""


class _Reader:
    """Reader of the tree of one file.

    Attributes
    ----------
    page
        Size of the file.
    losses
        Losses of the import.
    ours
        Marks of files that Curvebench wrote.
    """

    def __init__(self, root: ET.Element, tolerance: float | None = None) -> None:
        self._root, self._tolerance = root, tolerance
        self.ours = OwnFile(root)
        self.losses = _ElementLosses(root)
        self._cascade = Cascade(root, self.losses)
        font_size = self._cascade.of(root).get("font-size", "")
        self.page = page_of(root, font_size, is_nominal=self.ours.has_nominal_size)
        self._elements = elements = Elements.within(root, self._cascade.of)
        self._paints = Paints(elements)
        self._path_count = 0
        self._shapes: list[ET.Element] = []
        self._measuring = 0
        # Shared with readers that measure: counts of elements drawn and measured, and boxes.
        self._visits = [0, 0]
        self._extents: dict[tuple[object, ...], FloatArray] = {}

    def all_paths(self) -> list[ImportedPath]:
        """Return the painted paths of the file; without any, all paths as lines."""
        drawn = list(self._drawn(self._root, ElementContext(self.page.matrix, self.page.viewport), depth=0))
        painted = [path for path in drawn if is_painted(path)]
        outcome = "left out" if painted else "imported with a plain stroke"
        loss = Loss("shape", f"without stroke and fill {outcome}")
        unpainted = [path for path in drawn if not is_painted(path) and path.path.look.visible]
        for number in dict.fromkeys(path.element for path in unpainted):
            self.losses.note_of(self._shapes[number - 1], loss)
        return with_group_names(painted or [with_line(path) for path in drawn])

    def _drawn(self, element: ET.Element, context: ElementContext, depth: int) -> Iterator[DrawnPath]:
        """Yield the paths of an element and of its children."""
        self._visits[self._measuring > 0] += 1
        if max(self._visits) > MAX_ELEMENTS:
            raise ExchangeError(f"The file draws more than {MAX_ELEMENTS} elements.")
        if element.get("requiredExtensions") or self.ours.is_no_curve(element):
            return
        declared = self._cascade.of(element)
        context = self._entered(element, declared, self._transformed(element, declared, context, depth))
        if not np.isfinite(context.matrix).all():
            self.losses.note_at(element, _BEYOND)
            return
        yield from self._content(element, declared, context, depth)

    def _content(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext, depth: int
    ) -> Iterator[DrawnPath]:
        """Yield the paths of an element and of its children, in its own context."""
        tag, first, paths = tag_of(element), len(self._shapes), _NOTHING
        if self._measuring and not context.properties.is_displayed:
            return
        if self._measuring and tag in _WITH_SIZE:
            raise UnknownLengthError
        if tag in _NOT_READ and context.properties.is_visible:
            self.losses.note_of(element, _NOT_READ[tag])
        elif tag in SHAPES:
            paths = self._shape(element, tag, declared, context)
        elif tag == "use":
            paths = self._used(element, context, depth)
        elif tag in _CONTAINERS:
            paths = self._contained(element, tag, context, depth)
        yield from paths
        count = len(self._shapes) - first
        if count and context.properties.is_visible:
            self._note_effects(element, declared, context, is_many=count > 1)

    def _transformed(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext, depth: int
    ) -> ElementContext:
        """Return the context with the transform of an element."""
        text = element.get("transform", "").strip()
        if text.lower() in ("", "none"):
            return context
        box, corner = self._viewport(element, declared, context), (0.0, 0.0)
        kind = declared.get("transform-box", "").lower()
        try:
            if kind in _BOXES:
                (x, y), (right, bottom) = self._extent(element, declared, context, depth, kind)
                box, corner = box.sized(right - x, bottom - y), (x, y)
            matrix = transform_of(text, box, element.get("transform-origin", ""), corner)
        except ExchangeError as problem:
            if self._measuring:
                raise UnknownLengthError from None
            self.losses.note_at(element, _NO_TRANSFORM, str(problem))
            return context
        return replace(context, matrix=composed(context.matrix, matrix))

    def _extent(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext, depth: int, kind: str
    ) -> FloatArray:
        """Return the corners, (2, 2), of a box around an element, in its own units."""
        key = (element, *context.around, _BOXES[kind])
        if key not in self._extents:
            probe = copy(self)
            probe._measuring, probe._shapes, probe.losses = self._measuring + 1, [], self.losses.empty_copy()
            inner = probe._entered(element, declared, replace(context, matrix=np.eye(2, 3), clips=()))
            try:
                if self._measuring == _MAX_MEASURING:
                    raise UnknownLengthError
                paths = [drawn.path for drawn in probe._content(element, declared, inner, depth)]
            except UnknownLengthError:
                raise ExchangeError(f"in its {kind}") from None
            with np.errstate(all="ignore"):
                corners = [_BOXES[kind](path) for path in paths] or [np.zeros((2, 2))]
            self._extents[key] = np.array([np.min(corners, axis=(0, 1)), np.max(corners, axis=(0, 1))])
        return self._extents[key]

    def _viewport(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext
    ) -> Viewport:
        """Return the viewport with the font of an element."""
        size = declared.get("font-size", "")
        return context.viewport if element is self._root else context.viewport.with_font(size)

    def _entered(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext
    ) -> ElementContext:
        context = replace(context, viewport=self._viewport(element, declared, context))
        matrix, clips = context.matrix, context.clips
        if tag_of(element) in _WITH_LENGTHS and (invalid := invalid_lengths(element)):
            self.losses.note_at(element, _INVALID, enumerated(invalid))
        if tag_of(element) == "use":
            x, y = (self._length(element, name, context) or 0.0 for name in ("x", "y"))
            matrix = composed(matrix, translation(x, y))
        if (box := clip_box(self._elements, declared, context.viewport)) is not None:
            clips = (*clips, ClipBox(box, matrix, element, _CLIPPED))
        return replace(
            context,
            matrix=matrix,
            around=(*context.around, element),
            clips=clips,
            properties=context.properties.inherited_by(declared, context.viewport),
            # A `use` does not inherit the lock of its target.
            is_locked=context.is_locked or (not context.is_used and element.get(INSENSITIVE) == "true"),
        )

    def _contained(
        self, element: ET.Element, tag: str, context: ElementContext, depth: int
    ) -> Iterator[DrawnPath]:
        name, context = context.copied or name_of(element), replace(context, copied="")
        if tag == "g" or (depth > 0 and name):
            context = replace(context, groups=(*context.groups, Group(self._visits[0], name)))
        if tag == "svg" and depth > 0:
            x, y = (self._length(element, name, context) or 0.0 for name in ("x", "y"))
            context = self._in_view_box(element, element, context, (x, y))
        for child in element:
            if tag_of(child) not in _ONLY_WHEN_USED and is_for_english_readers(child):
                yield from self._drawn(child, context, depth + 1)
                if tag == "switch":
                    break

    def _in_view_box(
        self, element: ET.Element, sized: ET.Element, context: ElementContext, corner: tuple[float, float]
    ) -> ElementContext:
        """Return the context in a view box, whose size another element may give."""
        width, height = (
            self._length(sized, name, context) or self._length(element, name, context) or whole
            for name, whole in (("width", context.viewport.width), ("height", context.viewport.height))
        )
        box = box_of(element.get("viewBox", ""))
        if width is None or height is None or width <= 0 or height <= 0:
            return replace(context, matrix=composed(context.matrix, translation(*corner)))
        area: Box = (*corner, width, height)
        clips = context.clips
        if self._cascade.of(element).get("overflow") != "visible":
            clips = (*clips, ClipBox(area, context.matrix, sized, _CUT))
        if box is None:
            matrix = composed(context.matrix, translation(*corner))
            return replace(
                context, matrix=matrix, viewport=context.viewport.sized(width, height), clips=clips
            )
        fit = fitted_box(box, area, element.get("preserveAspectRatio", ""))
        matrix = composed(context.matrix, fit)
        return replace(context, matrix=matrix, viewport=context.viewport.sized(*box[2:]), clips=clips)

    def _used(self, element: ET.Element, context: ElementContext, depth: int) -> Iterator[DrawnPath]:
        target = self._elements.target_of(element)
        if target is None:
            self.losses.note_of(element, _UNUSABLE)
            return
        if depth > MAX_DEPTH or target in context.around:
            self.losses.note_at(element, _CIRCULAR)
            return
        # Of nested uses the outermost is the copy that a person sees.
        name = context.copied or name_of(element) or f"{name_of(target)} copy"
        context = replace(context, is_used=True, copied=name)
        if tag_of(target) in ("symbol", "svg"):
            context = self._in_view_box(target, element, context, (0.0, 0.0))
            declared = self._cascade.of(target)
            context = self._transformed(target, declared, context, depth + 1)
            yield from self._contained(target, "symbol", self._entered(target, declared, context), depth + 1)
        else:
            yield from self._drawn(target, context, depth + 1)

    def _shape(
        self, element: ET.Element, tag: str, declared: Mapping[str, str], context: ElementContext
    ) -> Iterator[DrawnPath]:
        stretch = largest_scale(context.matrix)
        tolerance = self._tolerance / stretch if self._tolerance is not None and stretch > 0 else None
        try:
            with np.errstate(all="ignore"):
                subpaths, error = outline_of(element, context.viewport, tolerance)
        except UnknownLengthError:
            self.losses.note_at(element, _NO_LENGTHS)
            return
        except ExchangeError:
            self.losses.note_at(element, _BEYOND)
            return
        if error:
            self.losses.note_at(element, Loss(tag, "imported only up to an error in the data"), error)
        has_caps = context.properties.has_caps
        drawn = [part for part in subpaths if part.has_length or (has_caps and part.is_line)]
        if not drawn:
            return
        self._shapes.append(element)
        name = context.copied or self.losses.name_of(element)
        keeps_width = declared.get("vector-effect") == "non-scaling-stroke"
        scale = self.page.pixel if keeps_width else mean_scale(context.matrix)
        look = self._look(element, context, scale, keeps_width=keeps_width)
        look = replace(look, shape=name) if len(drawn) > 1 else look
        if look.visible:
            self._note_clips(context, drawn, look.style)
        sizes = [(len(subpath.controls), subpath.closed) for subpath in drawn]
        letters = split_letters(element.get(NODE_TYPES, ""), sizes)
        for index, subpath in enumerate(drawn):
            self._path_count += 1
            if self._path_count > MAX_PATHS:
                raise ExchangeError(f"The file has more than {MAX_PATHS} paths.")
            path = ImportedPath(
                name if len(drawn) == 1 else f"{name} ({index + 1})",
                look,
                transform_points(subpath.pieces_with_length, context.matrix),
                subpath.closed,
                subpath.deviation * stretch,
                letters[index],
                look.style.has_caps,
            )
            yield DrawnPath(path, len(self._shapes), context.groups)

    def _note_clips(self, context: ElementContext, drawn: Iterable[Subpath], style: Style) -> None:
        """Note the boxes that cut off a part of a shape."""
        if context.clips:
            extent = extent_of(
                np.concatenate([transform_points(path.pieces_with_length, context.matrix) for path in drawn])
            )
            reach = half_width(style)
            for clip in context.clips:
                if not clip.holds(extent, reach):
                    self.losses.note_of(clip.element, clip.loss)

    def _look(self, element: ET.Element, context: ElementContext, scale: float, *, keeps_width: bool) -> Look:
        style, losses = style_of(context.properties, self._paints, context.viewport, scale)
        if style.has_stroke and not keeps_width and is_uneven(context.matrix):
            losses = (*losses, _UNEVEN)
        if context.properties.is_visible:
            self.losses.note_of(element, *losses)
        visible = context.properties.is_visible
        return Look(self.ours.restored(style), visible=visible, locked=context.is_locked)

    def _length(self, element: ET.Element, name: str, context: ElementContext) -> float | None:
        try:
            return length_of(element, name, context.viewport)
        except UnknownLengthError:
            self.losses.note_at(element, _UNKNOWN, name)
            return None

    def _note_effects(
        self, element: ET.Element, declared: Mapping[str, str], context: ElementContext, *, is_many: bool
    ) -> None:
        """Note the effects that an element has on its shapes beside their styles."""
        losses = [loss for name, loss in _EFFECTS.items() if declared.get(name, "none") not in _NO_EFFECT]
        is_clipped = declared.get("clip-path", "none") != "none"
        if is_clipped and clip_box(self._elements, declared, context.viewport) is None:
            losses.append(_CLIPPED)
        if is_many and share_of(declared.get("opacity", "1")) < 1:
            losses.append(_TRANSPARENT)
        self.losses.note_of(element, *losses)
        for child in element:
            if _NOT_READ.get(tag_of(child)) is _MOTION:
                self.losses.note_of(child, _MOTION)


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


class _ElementLosses(Losses):
    """Losses of the elements of one file."""

    def __init__(self, root: ET.Element) -> None:
        super().__init__()
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}

    def empty_copy(self) -> _ElementLosses:
        """Return an empty record of the same file."""
        other = copy(self)
        other._names = {}
        return other

    def name_of(self, element: ET.Element) -> str:
        """Return the name of an element, or else its tag and its number in the file, from 1."""
        return name_of(element) or f"{tag_of(element).capitalize()} {self._number[element]}"

    def note_of(self, element: ET.Element, *losses: Loss) -> None:
        """Note losses of an element, once, however often the element is used."""
        for loss in losses:
            self.note(loss, element, label_of(element))

    def note_at(self, element: ET.Element, loss: Loss, where: str = "") -> None:
        """Note an error in an element with its position, once for each loss."""
        self.note(loss, element, f"{self.name_of(element)} {where}".strip())
