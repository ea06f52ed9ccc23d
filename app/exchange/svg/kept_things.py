"""What of an SVG file is shown and not edited: texts and pictures, in front of the curves or behind them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from ...document.kept import KeptPicture, KeptText
from ..drawing.extents import extent_of
from .groups import Drawn
from .kept_pictures import KeptPictures
from .kept_texts import KeptTexts
from .paint import Paints
from .state import State

_SHOWN = "shown in a new document, but not edited"
_FRAMED = "its file lies elsewhere: a frame shows where it is"


class KeptThings:
    """The texts and pictures of one file, as they are met."""

    def __init__(self, paints: Paints, declared: Callable[[ET.Element], Mapping[str, str]]) -> None:
        self._reads_texts, self._reads_pictures = KeptTexts(paints, declared), KeptPictures()
        # Each with the number of paths behind it.
        self._texts: list[tuple[KeptText, int]] = []
        self._pictures: list[tuple[KeptPicture, int]] = []

    def keep(self, tag: str, element: ET.Element, state: State, behind: int) -> str:
        """Keep what an element shows over so many paths; return what is done with it, empty for nothing."""
        if tag == "text":
            lines = self._reads_texts.lines(element, state)
            self._texts += [(line, behind) for line in lines]
            return _SHOWN if lines else ""
        picture = self._reads_pictures.picture(element, state) if tag == "image" else None
        if picture is None:
            return ""
        self._pictures.append((picture, behind))
        return _SHOWN if picture.data else _FRAMED

    def placed(self, drawn: Sequence[Drawn]) -> tuple[tuple[KeptText, ...], tuple[KeptPicture, ...]]:
        """Return what was kept, each in front of all paths of the file or behind them.

        A text is in front if there is any path behind it, a picture if it covers an area.
        """
        first = next((place for place, each in enumerate(drawn) if each.path.look.visible), len(drawn))
        texts = tuple(replace(each, behind=place <= first) for each, place in self._texts)
        pictures = tuple(replace(each, behind=not _covers(each, drawn[:k])) for each, k in self._pictures)
        return texts, pictures


def _covers(picture: KeptPicture, drawn: Sequence[Drawn]) -> bool:
    """Whether a picture lies over one of some paths that is filled."""
    corner, across, down = map(np.array, ((picture.x, picture.y), picture.across, picture.down))
    corners = corner + np.array([0 * across, across, down, across + down])
    low, high = corners.min(axis=0), corners.max(axis=0)
    for each in drawn:
        if each.path.look.visible and each.path.look.style.has_fill:
            least, most = extent_of(each.path.pieces)
            if (least < high).all() and (most > low).all():
                return True
    return False
