"""SVG in: paths and basic shapes become cubic Hermite curves.

Coordinates are those of the drawing's own system (the view box), with y turned up. Nothing outside the
file is ever read, and no DTD or entity inside it.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import cos, radians, sin, tan, tau

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray

from ..arcs import arc
from ..cubics_in import Imported, ImportedPath, imported, lines
from ..errors import ExchangeError
from .path_data import Subpath, read_path_data
from .properties import AREAS, RULES, colour_of, lost_from, property_of, remark_on
from .xml_tree import MAX_DEPTH, MAX_ELEMENTS, parsed, tag_of

MAX_PATHS = 2_000

_CONTAINERS = {"svg", "g", "a", "switch", "symbol"}
_SHAPES = {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"}
_ONLY_WHEN_USED = {"defs", "symbol", "clipPath", "mask", "marker", "pattern"}
_LOST = {"text", "image", "foreignObject"}
_UNITS = {"": 1.0, "px": 1.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "pt": 4 / 3, "pc": 16.0}
_LENGTH = re.compile(
    r"\s*([-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(px|in|cm|mm|pt|pc)?\s*"
)
_REST = re.compile(r"[ \t\r\n,]*\Z")
_CALL = re.compile(r"[\s,]*([A-Za-z]+)\s*\(([^()]*)\)")
_NO_CURVES = ("paper", "points", "grid", "handles", "basis")
_OUR_MARK = "Largest deviation from the true curves"


@dataclass(frozen=True, eq=False)
class _State:
    """Inherited state of an element: the matrix (2, 3) to the document's plane, and the style."""

    matrix: FloatArray
    stroke: str = "none"
    fill: str = "black"
    visible: bool = True
    inside: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()


def read_svg(data: bytes, tolerance: float | None = None) -> Imported:
    """Return the curves of an SVG file.

    Cubic and quadratic pieces and lines are taken exactly but for rounding; arcs, circles and ellipses
    become cubics.

    Parameters
    ----------
    data
        The whole file.
    tolerance
        Largest distance from arcs, in the file's user unit; by default 4.3e-6 of their radius.

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
    paths = list(reader.paths(root, _State(np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])), depth=0))
    return imported(paths, reader.remarks)


class _Reader:
    """Walks the tree of one file."""

    def __init__(self, root: ET.Element, tolerance: float | None) -> None:
        self._tolerance = tolerance
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}
        self._by_id = {element.get("id", ""): element for element in root.iter()}
        self._visited = self._found = 0
        self._lost: set[str] = set()
        self._lost_style: set[str] = set()
        description = next((child.text or "" for child in root if tag_of(child) == "desc"), "")
        # The paper and the points of our own pictures are no curves.
        self._ours = _OUR_MARK in description
        if any(tag_of(element) == "style" and (element.text or "").strip() for element in root.iter()):
            self._lost_style.add(RULES)

    @property
    def remarks(self) -> tuple[str, ...]:
        """Sentences on what was left out."""
        lost = [f"{what} is not read." for what in sorted(self._lost)]
        # What our own pictures look like is the program's choice, not the file's.
        style = "" if self._ours else remark_on(self._lost_style)
        return (*lost, *([style] if style else []))

    def paths(self, element: ET.Element, state: _State, depth: int) -> Iterator[ImportedPath]:
        """Yield the paths of an element and those in it."""
        self._visited += 1
        if self._visited > MAX_ELEMENTS:
            raise ExchangeError(f"The file draws more than {MAX_ELEMENTS} elements.")
        tag = tag_of(element)
        if tag in _LOST:
            self._lost.add(f"<{tag}>")
        self._lost_style |= lost_from(element)
        state = self._entered(element, state)
        hidden = property_of(element, "display") == "none"
        if hidden or (self._ours and element.get("id") in _NO_CURVES):
            return
        if tag in _SHAPES:
            if state.visible:
                yield from self._shape(element, tag, state)
        elif tag == "use":
            yield from self._used(element, state, depth)
        elif tag in _CONTAINERS:
            if name := _name(element):
                state = replace(state, groups=(*state.groups, name))
            if tag == "svg" and depth > 0:
                self._lost.add("The view box of an <svg> in another")
            for child in element:
                if isinstance(child.tag, str) and tag_of(child) not in _ONLY_WHEN_USED:
                    yield from self.paths(child, state, depth + 1)

    def _entered(self, element: ET.Element, state: _State) -> _State:
        transform = element.get("transform", "")
        if transform.strip():
            matrix = _combined(state.matrix, self._transform(element, transform))
            if not np.isfinite(matrix).all():
                raise self._broken(element, "its transform is beyond all numbers.")
            state = replace(state, matrix=matrix)
        stroke, fill = (property_of(element, name).replace("inherit", "") for name in ("stroke", "fill"))
        state = replace(state, stroke=stroke or state.stroke, fill=fill or state.fill)
        visibility = property_of(element, "visibility")
        return replace(state, visible=visibility == "visible") if visibility else state

    def _transform(self, element: ET.Element, text: str) -> FloatArray:
        result, place = np.eye(2, 3), 0
        # Every call takes some of the text, and none of it is copied to see whether there is more.
        while not _REST.match(text, place):
            match = _CALL.match(text, place)
            if match is None:
                raise self._broken(element, f"its transform is broken at character {place + 1}.")
            result = _combined(result, self._one_transform(element, match[1], match[2]))
            place = match.end()
        return result

    def _one_transform(self, element: ET.Element, name: str, arguments: str) -> FloatArray:
        try:
            values = [float(each) for each in re.split(r"[\s,]+", arguments.strip()) if each]
            if not np.isfinite(values).all():
                raise ValueError
            return np.array(_MATRICES[name](*values), dtype=float)
        except (KeyError, TypeError, ValueError):
            shown = f"{name}({arguments})"[:40]
            raise self._broken(element, f"its transform “{shown}” is broken.") from None

    def _used(self, element: ET.Element, state: _State, depth: int) -> Iterator[ImportedPath]:
        reference = element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or ""
        target = self._by_id.get(reference.removeprefix("#"))
        if not reference.startswith("#") or target is None:
            self._lost.add("A <use> of something that is not in the file")
            return
        if reference in state.inside or depth > MAX_DEPTH:
            raise self._broken(element, f"it uses itself by way of “{reference[:40]}”.")
        x, y = (self._length(element, name) or 0.0 for name in ("x", "y"))
        moved = _combined(state.matrix, np.array([[1.0, 0.0, x], [0.0, 1.0, y]]))
        state = replace(state, matrix=moved, inside=(*state.inside, reference))
        yield from self.paths(target, state, depth + 1)

    def _shape(self, element: ET.Element, tag: str, state: _State) -> Iterator[ImportedPath]:
        scale = float(np.linalg.norm(state.matrix[:, :2], 2))
        tolerance = self._tolerance / scale if self._tolerance is not None and scale > 0 else None
        try:
            with np.errstate(all="ignore"):
                subpaths = self._subpaths(element, tag, tolerance)
        except ExchangeError as problem:
            raise self._broken(element, str(problem)) from None
        name = _name(element) or f"{tag.capitalize()} {self._number[element]}"
        drawn = [each for each in subpaths if each.pieces]
        if state.fill != "none" and AREAS not in self._lost_style and any(map(_has_area, drawn)):
            self._lost_style.add(AREAS)
        for index, subpath in enumerate(drawn, start=1):
            self._found += 1
            if self._found > MAX_PATHS:
                raise ExchangeError(f"The file has more than {MAX_PATHS} paths.")
            yield ImportedPath(
                name if len(drawn) == 1 else f"{name} ({index})",
                colour_of(state.stroke) or colour_of(state.fill),
                _moved(subpath.controls, state.matrix),
                subpath.closed,
                subpath.deviation * scale,
                state.groups,
            )

    def _subpaths(self, element: ET.Element, tag: str, tolerance: float | None) -> list[Subpath]:
        if tag == "path":
            return read_path_data(element.get("d", ""), tolerance)
        if tag in ("polyline", "polygon"):
            return _polyline(element.get("points", ""), closed=tag == "polygon")
        names = {
            "rect": ("x", "y", "width", "height", "rx", "ry"),
            "circle": ("cx", "cy", "r"),
            "ellipse": ("cx", "cy", "rx", "ry"),
            "line": ("x1", "y1", "x2", "y2"),
        }[tag]
        lengths = [self._length(element, name) for name in names]
        if any(element.get(name, "").strip().endswith(("%", "em", "ex")) for name in names):
            self._lost.add(f"A <{tag}> with lengths in % or em")
            return []
        values = [0.0 if value is None else value for value in lengths]
        if tag == "line":
            points = np.array(values).reshape(2, 2)
            return [Subpath(points[0], [lines(points)])]
        if tag == "rect":
            x, y, width, height = values[:4]
            return _rectangle((x, y), (width, height), (lengths[4], lengths[5]), tolerance)
        return _ellipse(values[0], values[1], values[2], values[-1], tolerance)

    def _length(self, element: ET.Element, name: str) -> float | None:
        text = element.get(name)
        if text is None or text.strip().endswith(("%", "em", "ex", "auto")):
            return None
        match = _LENGTH.fullmatch(text)
        if match is None or not np.isfinite(float(match[1])):
            raise self._broken(element, f"its {name} “{text[:20]}” is not a length.")
        return float(match[1]) * _UNITS[match[2] or ""]

    def _broken(self, element: ET.Element, why: str) -> ExchangeError:
        if why.startswith("Element "):
            return ExchangeError(why)
        return ExchangeError(f"Element {self._number[element]} (<{tag_of(element)}>): {why}")


# Shapes


def _polyline(text: str, *, closed: bool) -> list[Subpath]:
    words = [word for word in re.split(r"[\s,]+", text.strip()) if word]
    if not words:
        return []
    if len(words) % 2:
        raise ExchangeError("its points have an odd number of coordinates.")
    letter = "Z" if closed else ""
    return read_path_data(f"M{' '.join(words)}{letter}")


def _rectangle(
    corner: tuple[float, float],
    size: tuple[float, float],
    radii: tuple[float | None, float | None],
    tolerance: float | None,
) -> list[Subpath]:
    (x, y), (width, height), (rx, ry) = corner, size, radii
    if width < 0 or height < 0 or (rx or 0) < 0 or (ry or 0) < 0:
        raise ExchangeError("it has a negative size.")
    if width == 0 or height == 0:
        return []
    across = min(rx if rx is not None else ry or 0.0, width / 2)
    up = min(ry if ry is not None else rx or 0.0, height / 2)
    right, bottom = x + width, y + height
    if across == 0 or up == 0:
        return read_path_data(f"M{x!r} {y!r}H{right!r}V{bottom!r}H{x!r}Z")
    bend = f"A{across!r} {up!r} 0 0 1"
    return read_path_data(
        f"M{x + across!r} {y!r}H{right - across!r}{bend} {right!r} {y + up!r}V{bottom - up!r}"
        f"{bend} {right - across!r} {bottom!r}H{x + across!r}{bend} {x!r} {bottom - up!r}V{y + up!r}"
        f"{bend} {x + across!r} {y!r}Z",
        tolerance,
    )


def _ellipse(x: float, y: float, rx: float, ry: float, tolerance: float | None) -> list[Subpath]:
    if rx < 0 or ry < 0:
        raise ExchangeError("it has a negative radius.")
    if rx == 0 or ry == 0:
        return []
    whole = arc(np.array([x, y]), np.diag([rx, ry]), 0.0, tau, tolerance)
    whole.pieces[-1, 3] = whole.pieces[0, 0]
    return [Subpath(whole.pieces[0, 0], [whole.pieces], closed=True, deviation=whole.deviation)]


def _has_area(subpath: Subpath) -> bool:
    """Whether filling shows anything: the points do not all lie on one line."""
    points = subpath.controls.reshape(-1, 2)
    with np.errstate(all="ignore"):
        x, y = (points - points[0]).T
        farthest = int(np.argmax(np.hypot(x, y)))
        return bool((x * y[farthest] != y * x[farthest]).any())


# Matrices and names


def _rotation(degrees: float, *centre: float) -> FloatArray:
    """Return the rotation about the origin, or about another centre."""
    angle = radians(degrees)
    x, y = centre or (0.0, 0.0)
    turn = np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0]])
    turn[:, 2] = (x, y) - turn[:, :2] @ (x, y)
    return turn


_MATRICES: dict[str, Callable[..., ArrayLike]] = {
    "matrix": lambda a, b, c, d, e, f: ((a, c, e), (b, d, f)),
    "translate": lambda x, y=0.0: ((1, 0, x), (0, 1, y)),
    "scale": lambda x, y=None: ((x, 0, 0), (0, x if y is None else y, 0)),
    "rotate": _rotation,
    "skewX": lambda degrees: ((1, tan(radians(degrees)), 0), (0, 1, 0)),
    "skewY": lambda degrees: ((1, 0, 0), (tan(radians(degrees)), 1, 0)),
}
"""The matrix (2, 3) of each transform, by its name and arguments."""


def _combined(outer: FloatArray, inner: FloatArray) -> FloatArray:
    with np.errstate(all="ignore"):
        result = outer[:, :2] @ inner
        result[:, 2] += outer[:, 2]
    return result


def _moved(points: FloatArray, matrix: FloatArray) -> FloatArray:
    with np.errstate(all="ignore"):
        return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def _name(element: ET.Element) -> str:
    title = next((child.text for child in element if tag_of(child) == "title" and child.text), None)
    label = element.get("{http://www.inkscape.org/namespaces/inkscape}label")
    return " ".join((title or label or element.get("id") or "").split())[:200]
