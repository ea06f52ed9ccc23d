"""Markers of SVG: ours as they are, the usual ones of Inkscape as the nearest of ours."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ...document.marker import MarkerKind
from .elements import Elements
from .flaw import Flaw
from .marker_elements import own_kind
from .names import INKSCAPE_SPACE
from .xml_tree import tag_of

_STOCK = {
    r"Arrow[134]": MarkerKind.OPEN,
    r"Arrow[12345][LMS]?": MarkerKind.ARROW,
    r"Triangle(Out)?[LMS]?": MarkerKind.ARROW,
    r"RoundedArrow": MarkerKind.ARROW,
    r"Dot[LMS]?": MarkerKind.DOT,
    r"Square[LMS]?": MarkerKind.SQUARE,
    r"Diamond[LMS]?": MarkerKind.DIAMOND,
    r"Stop[LMS]?": MarkerKind.BAR,
}
"""Inkscape's names, without the end that they are for."""

_POINTED = (MarkerKind.ARROW, MarkerKind.OPEN)
_LOST = Flaw("it has markers", "it comes in without them")
_NEAR = Flaw("it has markers of another program", "it comes in with the nearest of Curvebench's own")


class Markers:
    """The markers of one file."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def of(self, values: Mapping[str, str]) -> tuple[MarkerKind, MarkerKind, list[Flaw]]:
        """Return the markers at start and end of what has these properties, and what of them is lost."""
        start, end, middle = (values[f"marker-{place}"] for place in ("start", "end", "mid"))
        if start == end == middle == "none":
            return MarkerKind.NONE, MarkerKind.NONE, []
        kinds = {"start": MarkerKind.NONE, "end": MarkerKind.NONE}
        is_lost, is_near = middle.lower() != "none", False
        for place, text in (("start", start), ("end", end)):
            if text.lower() == "none":
                continue
            own, near = self._kinds(text, place)
            kinds[place] = own if own is not MarkerKind.NONE else near
            is_lost |= kinds[place] is MarkerKind.NONE
            is_near |= own is MarkerKind.NONE
        flaws = [_LOST] if is_lost else [_NEAR] if is_near else []
        return kinds["start"], kinds["end"], flaws

    def _kinds(self, text: str, place: str) -> tuple[MarkerKind, MarkerKind]:
        """Return of what kind of our own a marker is, and the nearest to it of another program."""
        element = self._elements.referred(text)
        if element is None or tag_of(element) != "marker":
            return MarkerKind.NONE, MarkerKind.NONE
        name = element.get("id", "")
        stock = element.get(f"{{{INKSCAPE_SPACE}}}stockid") or name
        turns = element.get("orient") == "auto-start-reverse"
        return own_kind(name), _near_kind(stock, place, turns=turns)


def _near_kind(stock: str, place: str, *, turns: bool) -> MarkerKind:
    """Return the kind nearest to a marker of Inkscape's: none for one that points into its line."""
    word = re.sub("([sS]tart|[eE]nd)$", "", stock)
    kind = next((kind for known, kind in _STOCK.items() if re.fullmatch(known, word)), MarkerKind.NONE)
    meant = stock.removeprefix(word).lower() or "end"
    return kind if turns or meant == place or kind not in _POINTED else MarkerKind.NONE
