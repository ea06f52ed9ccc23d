"""Gradients and patterns as elements of SVG, in the units of the drawing; what shapes share is there once."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from msgspec.structs import replace

from ...document.gradient import Gradient, GradientKind, Spread, Stop, Tile
from ...document.model import Vector
from ..drawing.styles import PictureStyle
from ..naming import Names
from .defined_elements import DefinedElements
from .numbers import number

_ROUNDING = 1e-9
"""Share of its size by which a gradient may differ from one that attributes can say without a transform."""


_NAMED = re.compile(r"""(\bid="|href="#|url\(#)([^")]+)""")


class GradientElements(DefinedElements):
    """The gradients of one file."""

    def __init__(self, picture: PictureStyle, ids: Names) -> None:
        super().__init__(ids)
        self._picture = picture
        self._known: dict[Gradient, str] = {}

    def reference(self, gradient: Gradient) -> str:
        """Return the paint that refers to a gradient."""
        if gradient not in self._known:
            name = self._known[gradient] = self._ids.different("gradient")
            self.lines += self._element(gradient, name)
        return f"url(#{self._known[gradient]})"

    def _element(self, gradient: Gradient, name: str) -> Iterator[str]:
        seen = gradient.mapped(lambda place: (place[0], -place[1]))
        if seen.tile is not None:
            yield from self._pattern(seen, seen.tile, name)
            return
        tag = f"{gradient.kind.value}Gradient"
        spread = "" if gradient.spread is Spread.PAD else f' spreadMethod="{gradient.spread.value}"'
        yield f'    <{tag} id="{name}" gradientUnits="userSpaceOnUse"{_places(seen)}{spread}>'
        for stop in gradient.stops:
            yield f"      <stop{self._stop(stop)}/>"
        yield f"    </{tag}>"

    def _pattern(self, pattern: Gradient, tile: Tile, name: str) -> Iterator[str]:
        (x, y), ((a, b), (c, d)) = pattern.start, pattern.axes
        width, height = math.hypot(a, b), math.hypot(c, d)
        pairs = {"width": number(width), "height": number(height)}
        if b == c == 0 and a > 0 and d > 0:
            pairs = {"x": number(x), "y": number(y)} | pairs
        elif width and height:
            matrix = (a / width, b / width, c / height, d / height, x, y)
            pairs["patternTransform"] = f"matrix({' '.join(map(number, matrix))})"
        pairs["viewBox"] = " ".join(map(number, tile.view))
        yield f'    <pattern id="{name}" patternUnits="userSpaceOnUse"{_attributes(pairs)}'
        colour = pattern.stops[0].colour or self._picture.ink
        body = own_names(tile.body, name).replace("currentColor", colour)
        yield f'        preserveAspectRatio="none">{body}'
        yield "    </pattern>"

    def _stop(self, stop: Stop) -> str:
        pairs = {"offset": number(stop.offset), "stop-color": stop.colour or self._picture.ink}
        if stop.opacity < 1:
            pairs["stop-opacity"] = number(stop.opacity)
        return _attributes(pairs)


def own_names(body: str, name: str) -> str:
    """Return the body of a tile with ids that nothing else in the file has."""
    return _NAMED.sub(lambda found: f"{found[1]}{name}-{found[2]}", body)


def _places(gradient: Gradient) -> str:
    """Return where a gradient lies as attributes, with a transform where it is not of its plainest form."""
    if gradient.is_flat:
        # What has no length is the colour of its last stop.
        gradient = replace(gradient, end=gradient.start, side=gradient.start, focus=None)
    is_plain = gradient.is_flat or _is_square(gradient)
    if gradient.kind is GradientKind.LINEAR:
        (x, y), (end_x, end_y) = (gradient.start, gradient.end) if is_plain else ((0.0, 0.0), (1.0, 0.0))
        lengths = {"x1": x, "y1": y, "x2": end_x, "y2": end_y}
    else:
        x, y = gradient.start if is_plain else (0.0, 0.0)
        lengths = {"cx": x, "cy": y, "r": math.dist(gradient.start, gradient.end) if is_plain else 1.0}
        if gradient.focus is not None:
            focus = gradient.focus if is_plain else gradient.coordinates(gradient.focus)
            lengths |= dict(zip(("fx", "fy"), focus, strict=True))
    written = _attributes({name: number(value) for name, value in lengths.items()})
    if is_plain:
        return written
    (a, b), (c, d) = gradient.axes
    matrix = " ".join(map(number, (a, b, c, d, *gradient.start)))
    return f'{written} gradientTransform="matrix({matrix})"'


def _is_square(gradient: Gradient) -> bool:
    """Whether the axes are at right angles and, in a radial gradient, of one length."""
    along, aside = gradient.axes
    room = _ROUNDING * (math.hypot(*along) * math.hypot(*aside))
    is_upright = abs(_dot(along, aside)) <= room
    is_round = gradient.kind is GradientKind.LINEAR or abs(_dot(along, along) - _dot(aside, aside)) <= room
    return is_upright and is_round


def _dot(one: Vector, other: Vector) -> float:
    return one[0] * other[0] + one[1] * other[1]


def _attributes(pairs: dict[str, str]) -> str:
    return "".join(f' {name}="{value}"' for name, value in pairs.items())
