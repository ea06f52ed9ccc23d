"""Gradients of SVG as the one colour that stands for each.

Reference: Scalable Vector Graphics 2, section 14.2.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from .elements import Elements
from .xml_tree import tag_of

GRADIENTS = ("linearGradient", "radialGradient")
"""The elements of gradients."""

_LONGEST_CHAIN = 20
"""Gradients that take what they do not say from each other."""


@dataclass(frozen=True)
class Stop:
    """A colour at a place of a gradient: from 0, its start, to 1; "#rrggbb", and an opacity."""

    offset: float
    colour: str
    opacity: float


def stops_of(element: ET.Element, elements: Elements, read: Callable[[ET.Element], Stop]) -> tuple[Stop, ...]:
    """Return the stops of a gradient: its own, or else those of the one that it refers to."""
    chain = [element]
    while True:
        if found := [child for child in chain[-1] if tag_of(child) == "stop"]:
            return _ascending([read(child) for child in found])
        target = elements.used(chain[-1])
        is_gradient = target is not None and tag_of(target) in GRADIENTS and target not in chain
        if target is None or not is_gradient or len(chain) == _LONGEST_CHAIN:
            return ()
        chain.append(target)


def mean_of(stops: Sequence[Stop]) -> Stop:
    """Return the mean colour from the start of a gradient to its end, as far as it is seen, and opacity."""
    offsets = np.array([0.0, *(stop.offset for stop in stops), 1.0])
    padded = [stops[0], *stops, stops[-1]]
    # Between two stops the mean is that of both.
    spans = np.diff(offsets) / 2
    shares = np.append(spans, 0.0) + np.append(0.0, spans)
    opacities = np.array([stop.opacity for stop in padded])
    opacity = float(shares @ opacities)
    weights = shares * opacities if opacity > 0 else shares
    return Stop(0.0, mixed([stop.colour for stop in padded], weights), opacity)


def mixed(colours: Sequence[str], weights: ArrayLike = 1.0) -> str:
    """Return the mean of colours, "#rrggbb", of these weights."""
    levels = np.array([list(bytes.fromhex(colour[1:])) for colour in colours], dtype=float)
    means = np.average(levels, axis=0, weights=np.broadcast_to(weights, len(colours)))
    return "#" + "".join(f"{level:02x}" for level in np.rint(means).astype(int).tolist())


def _ascending(stops: Sequence[Stop]) -> tuple[Stop, ...]:
    """Return stops none of which lies before another that comes earlier."""
    found, least = list[Stop](), 0.0
    for stop in stops:
        least = max(least, stop.offset)
        found.append(replace(stop, offset=least))
    return tuple(found)
