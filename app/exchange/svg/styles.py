"""Styles of shapes, from the properties that are in force for them, and paints: colours and gradients.

Reference: Scalable Vector Graphics 2, sections 13 and 14.2.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache
from typing import TypeVar

import numpy as np
from msgspec.structs import replace
from numpy.typing import ArrayLike
from tinycss2.color4 import parse_color

from ...document.limits import MAX_MAGNITUDE
from ...document.style import LARGEST_DASHES, FillRule, LineCap, LineJoin, Style
from ..errors import LEFT_OUT, ExchangeError, Loss
from .cascade import INHERITED
from .coordinates import Viewport
from .xml_tree import Elements, tag_of

_GLOBAL = ("inherit", "unset", "revert", "revert-layer")
_PAINTS = ("fill", "stroke")
_LENGTHS = ("stroke-width", "stroke-dasharray", "stroke-dashoffset")
_MARKERS = ("marker-start", "marker-mid", "marker-end")
_COVERED = Loss("paint order", "not applied")
_TRANSPARENT = Loss("shape", "imported with the opacity on fill and stroke separately")
_UNKNOWN_WIDTH = Loss("stroke", "of unknown width imported with a width of 1")
_MARKED = Loss("shape", "imported without markers")
_Kind = TypeVar("_Kind", bound=Enum)


@dataclass(frozen=True, eq=False)
class Properties:
    """Properties that an element has inherited, as the file writes them.

    Attributes
    ----------
    values
        The properties of `INHERITED`.
    opacity
        Opacity of the element times that of all groups around it.
    is_displayed
        Whether neither the element nor a group around it has `display: none`.
    """

    values: Mapping[str, str] = field(default_factory=lambda: INHERITED)
    opacity: float = 1.0
    is_displayed: bool = True

    def inherited_by(self, declared: Mapping[str, str], viewport: Viewport) -> Properties:
        """Return the properties within an element that declares these, with lengths of its font."""
        if not declared:
            return self
        known = {name: value for name, value in declared.items() if name in INHERITED}
        known |= {name: viewport.in_pixels(known[name]) for name in _LENGTHS if name in known}
        new = {name: self._computed(name, value) for name, value in known.items()}
        return Properties(
            {**self.values, **new},
            self.opacity * share_of(declared.get("opacity", "1")),
            self.is_displayed and declared.get("display") != "none",
        )

    def _computed(self, name: str, value: str) -> str:
        word = value.lower()
        if word in _GLOBAL:
            return self.values[name]
        if word == "initial":
            return INHERITED[name]
        if name == "color":
            return value if colour_of(value) else self.values[name]
        # As in CSS, an invalid paint is ignored.
        return value if name not in _PAINTS or is_paint(value) else self.values[name]

    @property
    def is_visible(self) -> bool:
        """Whether the element is drawn."""
        return self.is_displayed and self.values["visibility"].lower() not in ("hidden", "collapse")

    @property
    def has_caps(self) -> bool:
        """Whether a line without length is visible by its caps."""
        has_caps = self.values["stroke-linecap"].lower() in ("round", "square")
        return has_caps and self.values["stroke"].lower() != "none"


def style_of(
    properties: Properties, paints: Paints, viewport: Viewport, scale: float
) -> tuple[Style, tuple[Loss, ...]]:
    """Return the style of a shape with scaled lengths, and the losses.

    Raises
    ------
    ExchangeError
        For an invalid width.
    """
    values = properties.values
    current = values["color"]
    stroke, fill = (paints.paint(values[name], current) for name in ("stroke", "fill"))
    user_width = _length(values, "stroke-width", viewport)
    width = (1.0 if user_width is None else user_width) * scale
    if not 0 < width <= MAX_MAGNITUDE:
        stroke = Paint("none")
    losses = [paint.loss for paint in (fill, stroke) if paint.loss is not None]
    if user_width is None and stroke.colour != "none":
        losses.append(_UNKNOWN_WIDTH)
    if any(values[name].lower() != "none" for name in _MARKERS):
        losses.append(_MARKED)
    is_both = "none" not in (fill.colour, stroke.colour)
    order = (word for word in values["paint-order"].lower().split() if word in _PAINTS)
    if is_both and next(order, "fill") == "stroke":
        losses.append(_COVERED)
    if is_both and properties.opacity < 1:
        losses.append(_TRANSPARENT)
    style = Style(
        stroke=stroke.colour,
        fill=fill.colour,
        fill_rule=_one_of(FillRule, values["fill-rule"], FillRule.NONZERO),
        fill_opacity=_opacity(fill, properties, "fill-opacity"),
    )
    if stroke.colour == "none":
        return style, tuple(losses)
    return _with_stroke(style, properties, stroke, width, scale, viewport), tuple(losses)


def _with_stroke(
    style: Style, properties: Properties, stroke: Paint, width: float, scale: float, viewport: Viewport
) -> Style:
    values = properties.values
    dash = tuple(length * scale / width for length in _dashes(values["stroke-dasharray"], viewport))
    offset = (_length(values, "stroke-dashoffset", viewport) or 0.0) * scale / width if dash else 0.0
    if max((abs(length) for length in (*dash, offset)), default=0.0) > MAX_MAGNITUDE:
        dash, offset = (), 0.0
    return replace(
        style,
        width=width,
        cap=_one_of(LineCap, values["stroke-linecap"], LineCap.BUTT),
        join=_one_of(LineJoin, values["stroke-linejoin"], LineJoin.MITER),
        miter_limit=_miter_limit(values["stroke-miterlimit"]),
        dash=dash,
        dash_offset=offset,
        stroke_opacity=_opacity(stroke, properties, "stroke-opacity"),
    )


def _length(values: Mapping[str, str], name: str, viewport: Viewport) -> float | None:
    try:
        return viewport.length(values[name])
    except ExchangeError:
        # As in CSS, an invalid length is ignored.
        return float(INHERITED[name])


def _dashes(text: str, viewport: Viewport) -> tuple[float, ...]:
    """Return dashes and gaps in turn; none where the stroke is solid."""
    if text.strip().lower() == "none":
        return ()
    words = [word for word in re.split(r"[\s,]+", text.strip()) if word]
    try:
        lengths = [viewport.length(word) or 0.0 for word in words]
    except ExchangeError:
        return ()
    is_sound = bool(lengths) and min(lengths) >= 0 and 0 < sum(lengths) <= MAX_MAGNITUDE
    if not is_sound or len(lengths) > LARGEST_DASHES:
        return ()
    return tuple(lengths)


def _miter_limit(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 4.0
    if not 0 <= value <= MAX_MAGNITUDE:
        return 4.0
    # Values below 1 are invalid, but programs write 0 for bevels at every corner.
    return max(value, 1.0)


def _one_of(kind: type[_Kind], text: str, default: _Kind) -> _Kind:
    return next((member for member in kind if member.value == text.strip().lower()), default)


def _opacity(paint: Paint, properties: Properties, name: str) -> float:
    """Return the product of all opacities of a paint, without the noise of its last digits."""
    if paint.colour == "none":
        return 1.0
    return round(properties.opacity * paint.opacity * share_of(properties.values[name]), 6)


# Paints


_SERVER = re.compile(r"url\(\s*['\"]?#?([^'\")]*)['\"]?\s*\)\s*(.*)", re.DOTALL)

GRADIENTS = ("linearGradient", "radialGradient")
"""The elements of gradients."""

_LONGEST_CHAIN = 20
"""Longest chain of gradients that refer to each other."""


@dataclass(frozen=True)
class Paint:
    """Paint of an area or a stroke.

    Attributes
    ----------
    colour
        "#rrggbb", or "none".
    opacity
        Opacity from 0 to 1.
    loss
        Loss of the import; None for none.
    """

    colour: str
    opacity: float = 1.0
    loss: Loss | None = None


NONE = Paint("none")
_CONTEXT = Paint("none", loss=Loss("context paint"))


@lru_cache(maxsize=4096)
def colour_of(text: str) -> Paint | None:
    """Return the paint of a CSS colour; None for other text."""
    try:
        parsed = parse_color(text)
        if parsed is None or isinstance(parsed, str):
            return None
        *channels, alpha = parsed.to("srgb")
    except (ValueError, TypeError, NotImplementedError):
        return None
    levels = (round(min(max(channel or 0.0, 0.0), 1.0) * 255) for channel in channels)
    opacity = 1.0 if alpha is None else min(max(float(alpha), 0.0), 1.0)
    return Paint("#" + "".join(f"{level:02x}" for level in levels), opacity)


def is_paint(text: str) -> bool:
    """Whether a value is a valid paint; CSS ignores others."""
    word = text.lower()
    return (
        word in ("none", "currentcolor", "inherit", "context-fill", "context-stroke")
        or word.startswith("url(")
        or colour_of(text) is not None
    )


class Paints:
    """The paints of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def paint(self, text: str, current: str) -> Paint:
        """Return the paint of a value, with this `currentColor`."""
        word = text.strip()
        if word.lower() == "currentcolor":
            word = current
        if match := _SERVER.fullmatch(word):
            return self._replacement_paint(match[1], match[2].strip(), current)
        if word.lower().startswith("context-"):
            return _CONTEXT
        return NONE if word.lower() == "none" else colour_of(word) or NONE

    def _replacement_paint(self, name: str, fallback: str, current: str) -> Paint:
        """Return the paint that replaces a gradient or a pattern."""
        server = self._elements.by_id.get(name)
        if server is not None and tag_of(server) in GRADIENTS:
            return self._gradient(server, current)
        plain = self.paint(fallback, current) if fallback and "url(" not in fallback else NONE
        noun = "pattern" if server is not None else "missing paint"
        if server is not None and (colours := self._colours_of(server)):
            plain = Paint(mean_colour(colours))
        return _as_replacement(plain, noun)

    def _colours_of(self, pattern: ET.Element) -> list[str]:
        """Return the colours of the elements of a pattern."""
        declared = (self._elements.declared(child) for child in pattern.iter())
        values = (style[name] for style in declared for name in _PAINTS if name in style)
        colours = map(colour_of, values)
        return [paint.colour for paint in colours if paint is not None]

    def _gradient(self, element: ET.Element, current: str) -> Paint:
        stops = stops_of(element, self._elements, lambda stop: self._stop(stop, current))
        if not stops:
            return NONE
        mean = mean_of(stops)
        if all((stop.colour, stop.opacity) == (stops[0].colour, stops[0].opacity) for stop in stops):
            return Paint(stops[0].colour, stops[0].opacity)
        return _as_replacement(Paint(mean.colour, mean.opacity), "gradient")

    def _stop(self, stop: ET.Element, current: str) -> Stop:
        declared = self._elements.declared(stop)
        text = declared.get("stop-color", "#000000")
        plain = colour_of(current if text.lower() == "currentcolor" else text) or Paint("#000000")
        opacity = plain.opacity * share_of(declared.get("stop-opacity", "1"))
        return Stop(share_of(stop.get("offset", "0"), 0.0), plain.colour, opacity)


def share_of(text: str, default: float = 1.0) -> float:
    """Return an opacity, written as a number or in percent, from 0 to 1."""
    word = text.strip()
    try:
        value = float(word[:-1]) / 100 if word.endswith("%") else float(word)
    except ValueError:
        return default
    return min(max(value, 0.0), 1.0) if value == value else default  # noqa: PLR0124 - not a number


def _as_replacement(paint: Paint, noun: str) -> Paint:
    """Return a paint that replaces one of another kind."""
    outcome = "imported as one colour" if paint.colour != "none" else LEFT_OUT
    return Paint(paint.colour, paint.opacity, Loss(noun, outcome))


@dataclass(frozen=True)
class Stop:
    """A colour of a gradient, "#rrggbb", with its offset, from 0 at the start to 1, and its opacity."""

    offset: float
    colour: str
    opacity: float


def stops_of(element: ET.Element, elements: Elements, read: Callable[[ET.Element], Stop]) -> tuple[Stop, ...]:
    """Return the stops of a gradient: its own, or those of the gradient that it refers to."""
    chain = [element]
    while True:
        if stops := [child for child in chain[-1] if tag_of(child) == "stop"]:
            return _ascending([read(child) for child in stops])
        target = elements.target_of(chain[-1])
        is_gradient = target is not None and tag_of(target) in GRADIENTS and target not in chain
        if target is None or not is_gradient or len(chain) == _LONGEST_CHAIN:
            return ()
        chain.append(target)


def mean_of(stops: Sequence[Stop]) -> Stop:
    """Return the mean colour of a gradient, weighted by opacity, and its mean opacity."""
    offsets = np.array([0.0, *(stop.offset for stop in stops), 1.0])
    padded = [stops[0], *stops, stops[-1]]
    # Between two stops the mean is that of both.
    spans = np.diff(offsets) / 2
    shares = np.append(spans, 0.0) + np.append(0.0, spans)
    opacities = np.array([stop.opacity for stop in padded])
    opacity = float(shares @ opacities)
    weights = shares * opacities if opacity > 0 else shares
    return Stop(0.0, mean_colour([stop.colour for stop in padded], weights), opacity)


def mean_colour(colours: Sequence[str], weights: ArrayLike = 1.0) -> str:
    """Return the mean of colours, "#rrggbb", of these weights."""
    levels = np.array([list(bytes.fromhex(colour[1:])) for colour in colours], dtype=float)
    means = np.average(levels, axis=0, weights=np.broadcast_to(weights, len(colours)))
    return "#" + "".join(f"{level:02x}" for level in np.rint(means).astype(int).tolist())


def _ascending(stops: Sequence[Stop]) -> tuple[Stop, ...]:
    """Return stops with ascending offsets, as SVG corrects them."""
    result, least = list[Stop](), 0.0
    for stop in stops:
        least = max(least, stop.offset)
        result.append(Stop(least, stop.colour, stop.opacity))
    return tuple(result)
