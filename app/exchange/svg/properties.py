"""The style that a shape takes from the properties that are in force for it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TypeVar

from msgspec.structs import replace

from ...document.model import MAX_MAGNITUDE
from ...document.style import LARGEST_DASHES, FillRule, LineCap, LineJoin, Style
from ..errors import ExchangeError, Flaw
from .cascade import INHERITED
from .lengths import Viewport
from .paint import Paint, Paints, colour_of, is_paint, share_of

_GLOBAL = ("inherit", "unset", "revert", "revert-layer")
_PAINTS = ("fill", "stroke")
_LENGTHS = ("stroke-width", "stroke-dasharray", "stroke-dashoffset")
_MARKERS = ("marker-start", "marker-mid", "marker-end")
_COVERED = Flaw("paint order", "not applied")
_TRANSPARENT = Flaw("shape", "came with the opacity on fill and stroke separately")
_UNKNOWN_WIDTH = Flaw("stroke", "of unknown width came with a width of 1")
_MARKED = Flaw("shape", "came without markers")
_Kind = TypeVar("_Kind", bound=Enum)


@dataclass(frozen=True, eq=False)
class Properties:
    """Properties that an element has inherited, as the file writes them.

    Attributes
    ----------
    values
        The properties of `INHERITED`.
    opacity
        Its own times that of all around it.
    is_displayed
        Whether neither it nor a group around it is `display: none`.
    """

    values: Mapping[str, str] = field(default_factory=lambda: INHERITED)
    opacity: float = 1.0
    is_displayed: bool = True

    def entered(self, declared: Mapping[str, str], viewport: Viewport) -> Properties:
        """Return the properties within an element that declares these, of whose font lengths are parts."""
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
        # What is no paint is passed over, as if it did not stand there.
        return value if name not in _PAINTS or is_paint(value) else self.values[name]

    @property
    def is_visible(self) -> bool:
        """Whether it is drawn."""
        return self.is_displayed and self.values["visibility"].lower() not in ("hidden", "collapse")

    @property
    def has_caps(self) -> bool:
        """Whether a line of no length is seen, by its caps."""
        has_caps = self.values["stroke-linecap"].lower() in ("round", "square")
        return has_caps and self.values["stroke"].lower() != "none"


def style_of(
    properties: Properties, paints: Paints, viewport: Viewport, scale: float
) -> tuple[Style, tuple[Flaw, ...]]:
    """Return the style of a shape whose lengths are scaled so, and what of it is lost.

    Raises
    ------
    ExchangeError
        For a width that is no length.
    """
    values = properties.values
    current = values["color"]
    stroke, fill = (paints.paint(values[name], current) for name in ("stroke", "fill"))
    user_width = _length(values, "stroke-width", viewport)
    width = (1.0 if user_width is None else user_width) * scale
    if not 0 < width <= MAX_MAGNITUDE:
        stroke = Paint("none")
    flaws = [each.flaw for each in (fill, stroke) if each.flaw is not None]
    if user_width is None and stroke.colour != "none":
        flaws.append(_UNKNOWN_WIDTH)
    if any(values[name].lower() != "none" for name in _MARKERS):
        flaws.append(_MARKED)
    is_both = "none" not in (fill.colour, stroke.colour)
    if is_both and _has_fill_above(values["paint-order"]):
        flaws.append(_COVERED)
    if is_both and properties.opacity < 1:
        flaws.append(_TRANSPARENT)
    style = Style(
        stroke=stroke.colour,
        fill=fill.colour,
        fill_rule=_one_of(FillRule, values["fill-rule"], FillRule.NONZERO),
        fill_opacity=_opacity(fill, properties, "fill-opacity"),
    )
    if stroke.colour == "none":
        return style, tuple(flaws)
    return _with_stroke(style, properties, stroke, width, scale, viewport), tuple(flaws)


def _with_stroke(
    style: Style, properties: Properties, stroke: Paint, width: float, scale: float, viewport: Viewport
) -> Style:
    values = properties.values
    dash = tuple(each * scale / width for each in _dashes(values["stroke-dasharray"], viewport))
    offset = (_length(values, "stroke-dashoffset", viewport) or 0.0) * scale / width if dash else 0.0
    if max((abs(each) for each in (*dash, offset)), default=0.0) > MAX_MAGNITUDE:
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


def _has_fill_above(text: str) -> bool:
    """Whether a `paint-order` lets the fill cover the stroke."""
    return next((word for word in text.lower().split() if word in _PAINTS), "fill") == "stroke"


def _length(values: Mapping[str, str], name: str, viewport: Viewport) -> float | None:
    try:
        return viewport.length(values[name])
    except ExchangeError:
        # As CSS has it: what is no length does not stand there.
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
    # Below 1 it is no limit, but programs write 0 for none at all: every corner is a bevel.
    return max(value, 1.0)


def _one_of(kind: type[_Kind], text: str, default: _Kind) -> _Kind:
    return next((each for each in kind if each.value == text.strip().lower()), default)


def _opacity(paint: Paint, properties: Properties, name: str) -> float:
    """Return the product of all opacities of a paint, without the noise of its last digits."""
    if paint.colour == "none":
        return 1.0
    return round(properties.opacity * paint.opacity * share_of(properties.values[name]), 6)
