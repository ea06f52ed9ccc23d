"""Markers as elements of SVG, in widths of the line: each kind is there once, and known again by its id."""

from __future__ import annotations

import re

from ...document.marker import RINGS, MarkerKind
from ..naming import Names
from .defined_elements import DefinedElements
from .numbers import number

_OWN = "curvebench-"


class MarkerElements(DefinedElements):
    """The markers of one file."""

    def __init__(self, ids: Names) -> None:
        super().__init__(ids)
        self._known: dict[MarkerKind, str] = {}

    def reference(self, kind: MarkerKind) -> str:
        """Return what refers to a marker; "none" of none."""
        if kind is MarkerKind.NONE:
            return "none"
        if kind not in self._known:
            self._known[kind] = name = self._ids.different(f"{_OWN}{kind.value}")
            # Of the colour of whatever line it ends, also when another program changes that.
            self.lines += [
                f'    <marker id="{name}" orient="auto-start-reverse" markerWidth="1" markerHeight="1" '
                'style="overflow:visible">',
                f'      <path d="{_data(kind)}" fill="context-stroke" stroke="none"/>',
                "    </marker>",
            ]
        return f"url(#{self._known[kind]})"


def own_kind(name: str) -> MarkerKind:
    """Return what marker an id stands for in a file of ours; none for others."""
    word = re.sub(r"_[0-9]+$", "", name.removeprefix(_OWN)) if name.startswith(_OWN) else ""
    return next((kind for kind in RINGS if kind.value == word), MarkerKind.NONE)


def _data(kind: MarkerKind) -> str:
    start, *others = (f"{number(x)} {number(-y)}" for x, y in RINGS[kind])
    pieces = (" ".join(others[at : at + 3]) for at in range(0, len(others), 3))
    return f"M {start} {' '.join(f'C {each}' for each in pieces)} Z"
