"""Styles as an element declares them: what of two differs, and the properties that say it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from msgspec.structs import astuple, replace

from curvecore.arrays import FloatArray

from ....document.gradient import Gradient, GradientKind
from ....document.model import Vector
from ....document.style import GRADIENTS, NO_PAINT, FillRule, LineJoin, Style
from ....document.value import Value
from ....view_model.geometry.extents import extent_of
from ....view_model.geometry.stroked import farthest_reach
from ...drawing.styles import INK, PictureStyle
from ...naming import Names
from ..clip_elements import ClipElements
from ..filter_elements import FilterElements
from ..gradient_elements import GradientElements
from ..mask_elements import MaskElements
from ..matrices import mean_scale, moved
from ..numbers import number
from ..state import State
from .source import Node

_ROUNDING = 1e-6
_OF_FILL = ("fill", "fill_rule", "fill_opacity", "opacity", "fill_gradient", "clips", "masks", "blur")


class Part(NamedTuple):
    """Fields of a style that are declared together, the properties that do, and the paint that shows them."""

    fields: tuple[str, ...]
    properties: tuple[str, ...]
    paint: str = "stroke"


_CLIP = Part(("clips",), ("clip-path",), "")
_MASK = Part(("masks",), ("mask",), "")
_BLUR = Part(("blur",), ("filter",), "")

_PARTS = (
    Part(("fill", "fill_opacity", "fill_gradient"), ("fill", "fill-opacity"), "fill"),
    Part(("fill_rule",), ("fill-rule",), "fill"),
    Part(("stroke", "stroke_opacity", "stroke_gradient"), ("stroke", "stroke-opacity")),
    Part(("width", "dash", "dash_offset"), ("stroke-width", "stroke-dasharray", "stroke-dashoffset")),
    Part(("cap",), ("stroke-linecap",)),
    Part(("join", "miter_limit"), ("stroke-linejoin", "stroke-miterlimit")),
    Part(("opacity",), ("opacity",), ""),
    _CLIP,
    _MASK,
    _BLUR,
)


class Definitions:
    """What styles of one file refer to.

    Attributes
    ----------
    gradients, clips, filters, masks
        Those that were asked for so far.
    """

    def __init__(self, ids: Names) -> None:
        self.gradients, self.clips = GradientElements(INK, ids), ClipElements(ids)
        self.filters = FilterElements(ids)
        self.masks = MaskElements(ids)

    def taken(self) -> str:
        """Return as elements those that were asked for since it was asked last."""
        kinds = (self.gradients, self.clips, self.filters, self.masks)
        return "\n".join(line for each in kinds for line in each.taken())


class Looks:
    """Comparison of styles in a picture.

    Parameters
    ----------
    picture, usual_width
        What stands for the ink, and for a width that is not said.
    reach
        How large the coordinates are.
    """

    def __init__(self, picture: PictureStyle, usual_width: float, reach: float) -> None:
        self._picture, self._usual_width, self._reach = picture, usual_width, reach

    def shown(self, style: Style) -> Style:
        """Return a style as it is drawn; what is not drawn is as usual."""
        if style.has_stroke:
            width = self._usual_width if style.width is None else style.width
            style = replace(style, stroke=self._picture.stroke_of(style), width=width)
            if style.join is not LineJoin.MITER:
                style = replace(style, miter_limit=4.0)
        else:
            style = Style(stroke=NO_PAINT, **{name: getattr(style, name) for name in _OF_FILL})
        if style.has_fill:
            style = replace(style, fill=self._picture.fill_of(style))
        else:
            style = replace(style, fill_rule=FillRule.NONZERO, fill_opacity=1.0, fill_gradient=None)
        for name, gradient in style.gradients.items():
            stops = tuple(replace(stop, colour=stop.colour or self._picture.ink) for stop in gradient.stops)
            style = replace(style, **{name: _in_its_colour(_plainest(replace(gradient, stops=stops)))})
        # The colour that stands for a gradient is not drawn.
        flat = {name: "" for name, field in GRADIENTS.items() if getattr(style, field) is not None}
        return replace(style, **flat)

    def differing_of(
        self, node: Node, one: Style, other: Style, *, with_gradients: bool = False
    ) -> tuple[Part, ...]:
        """Return the same for what an element shows.

        What is whole in the document, and moved or drawn under a clip of the file, is cut there as is all
        else in that group.
        """
        found = self.differing(one, other, with_gradients=with_gradients)
        of_group = {
            part
            for part, has_own in ((_CLIP, other.clips), (_MASK, other.masks))
            if not has_own and value_of(node, part.properties[0]) in ("", "none")
        }
        return tuple(each for each in found if each not in of_group)

    def differing(self, one: Style, other: Style, *, with_gradients: bool = False) -> tuple[Part, ...]:
        """Return the parts in which two styles are drawn differently, or all of the other that are placed."""
        one, other = self.shown(one), self.shown(other)
        painted = {"fill": one.has_fill, "stroke": one.has_stroke}
        # What an element says of a stroke that it does not have is not read.
        new = {paint for paint, was in painted.items() if not was and getattr(other, paint) != NO_PAINT}
        return tuple(
            part
            for part in _PARTS
            if part.paint in new
            or (with_gradients and not other.gradients.keys().isdisjoint(part.fields))
            or (with_gradients and part is _CLIP and bool(other.clips))
            or (with_gradients and part is _MASK and bool(other.masks))
            or (with_gradients and part is _BLUR and bool(other.blur))
            or not all(self._is_same(getattr(one, name), getattr(other, name)) for name in part.fields)
        )

    def _is_same(self, one: object, other: object) -> bool:
        if isinstance(one, Value) and isinstance(other, Value):
            one, other = astuple(one), astuple(other)
        if isinstance(one, tuple) and isinstance(other, tuple):
            return len(one) == len(other) and all(map(self._is_same, one, other))
        if isinstance(one, float) and isinstance(other, float):
            return math.isclose(one, other, rel_tol=_ROUNDING, abs_tol=_ROUNDING * min(1.0, self._reach))
        return one == other

    def properties(
        self,
        style: Style,
        parts: tuple[Part, ...],
        inverse: FloatArray,
        scale: float,
        around: State,
        made: Definitions,
        pieces: Sequence[FloatArray],
    ) -> Mapping[str, str]:
        """Return the properties of a style.

        Parameters
        ----------
        style
            The style.
        parts
            What is asked for: what the rest refers to is not put anywhere.
        inverse
            (2, 3), from the plane of the file to that of the element.
        scale
            By how much the stroke of the element is enlarged.
        around
            What is around it: the opacity of that and its blur are its own already.
        made
            Where its gradients, clips and blurs are put.
        pieces
            Those of its shape in the plane of the file, each (k, 4, 2).
        """
        style, there = self.shown(style), _upside_down(inverse)
        opacity = around.properties.opacity
        corners = extent_of(np.concatenate([moved(each, inverse) for each in pieces]))
        blur = math.sqrt(max(style.blur**2 - around.blur**2, 0.0)) * mean_scale(inverse)
        paints = {"fill": style.fill, "stroke": style.stroke}
        for name, field in GRADIENTS.items():
            is_asked = any(field in part.fields for part in parts)
            if is_asked and (gradient := getattr(style, field)) is not None:
                paints[name] = made.gradients.reference(gradient.mapped(there))
        return {
            "fill": paints["fill"],
            "fill-opacity": number(style.fill_opacity),
            "fill-rule": str(style.fill_rule.value),
            "stroke": paints["stroke"],
            **_stroke_properties(style, scale),
            "opacity": number(style.opacity / opacity if opacity else style.opacity),
            "filter": made.filters.reference(blur, corners, farthest_reach(style) / scale)
            if _BLUR in parts
            else "none",
            "clip-path": made.clips.reference(tuple(each.mapped(there) for each in style.clips))
            if _CLIP in parts
            else "none",
            "mask": made.masks.reference(tuple(each.mapped(there) for each in style.masks))
            if _MASK in parts
            else "none",
        }


def _stroke_properties(style: Style, scale: float) -> Mapping[str, str]:
    """Return the properties of a stroke that are no references; the element enlarges it by `scale`."""
    width = (style.width or 0.0) / scale
    return {
        "stroke-opacity": number(style.stroke_opacity),
        "stroke-width": number(width),
        "stroke-dasharray": ",".join(number(each * width) for each in style.dash) or "none",
        "stroke-dashoffset": number(style.dash_offset * width),
        "stroke-linecap": str(style.cap.value),
        "stroke-linejoin": str(style.join.value),
        "stroke-miterlimit": number(style.miter_limit),
    }


def _in_its_colour(gradient: Gradient) -> Gradient:
    """Return a pattern with its colour on its tile, as it is written; the stops of it are not drawn."""
    if gradient.tile is None:
        return gradient
    body = gradient.tile.body.replace("currentColor", gradient.stops[0].colour)
    stops = tuple(replace(stop, colour="#000000", opacity=1.0) for stop in gradient.stops)
    return replace(gradient, stops=stops, tile=replace(gradient.tile, body=body))


def _plainest(gradient: Gradient) -> Gradient:
    """Return the one of the gradients that look the same whose axes are at right angles, if there is one."""
    if gradient.is_flat or gradient.tile is not None:
        return gradient
    (x, y), ((a, b), (c, d)) = gradient.start, gradient.axes
    if gradient.kind is GradientKind.LINEAR:
        # Only what its end has across the lines of one colour counts.
        share = (a * d - b * c) / (c * c + d * d)
        a, b = share * d, -share * c
    elif abs(a * c + b * d) > _ROUNDING * (a * a + b * b) or not math.isclose(
        math.hypot(a, b), math.hypot(c, d), rel_tol=_ROUNDING
    ):
        return gradient
    else:
        a, b = math.hypot(a, b), 0.0
    return replace(gradient, end=(x + a, y + b), side=(x - b, y + a))


def _upside_down(inverse: FloatArray) -> Callable[[Vector], Vector]:
    """Return the map to the plane of an element with y turned up, as `Definitions` want it."""

    def there(place: Vector) -> Vector:
        x, y = moved(np.array(place), inverse).tolist()
        return x, -y

    return there


def declare_style(
    node: Node,
    parts: tuple[Part, ...],
    values: Mapping[str, str],
    around: Mapping[str, str],
    *,
    has_rules: bool,
) -> None:
    """Declare parts of a style; what the element has from those around it only where it says so itself."""
    for part in parts:
        for name in part.properties:
            if values[name] != around.get(name) or has_rules or declares(node, name):
                declare(node, name, values[name], has_rules=has_rules)


def declares(node: Node, name: str) -> bool:
    """Whether an element declares a property."""
    return node.get(name) is not None or any(each == name for each, _ in _declarations(node))


def value_of(node: Node, name: str) -> str:
    """Return what an element itself declares of a property; empty for nothing."""
    found = [text.partition(":")[2].strip() for each, text in _declarations(node) if each == name]
    return found[-1] if found else node.get(name) or ""


def declare(node: Node, name: str, value: str, *, has_rules: bool = False) -> None:
    """Declare a property where the element does, or else where it declares others; rules are outweighed."""
    css = node.get("style") or ""
    if any(each == name for each, _ in _declarations(node)):
        parts = [f"{name}:{value}" if each == name else text for each, text in _declarations(node)]
        node.set("style", ";".join(parts))
    elif has_rules or (css.strip() and node.get(name) is None):
        node.set("style", f"{css.rstrip().rstrip(';')};{name}:{value}".lstrip(";"))
    else:
        node.set(name, value)


def _declarations(node: Node) -> list[tuple[str, str]]:
    """Return the name and the text of each declaration of a `style` attribute."""
    parts = (node.get("style") or "").split(";")
    return [(each.partition(":")[0].strip(), each) for each in parts]
