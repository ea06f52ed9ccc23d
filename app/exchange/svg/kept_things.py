"""Texts and pictures of an SVG file, in front of the curves or behind them: shown, and moved as they are."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from msgspec.structs import replace

from ...document.kept import KeptPicture, KeptText
from ..drawing.extents import extent_of
from .clips import clip_of_box
from .flaw import Flaw
from .groups import Anchor, Drawn, Group
from .kept_pictures import KeptPictures
from .kept_texts import KeptTexts
from .names import INSENSITIVE
from .paint import Paints
from .state import State

NO_CURVES = {
    "text": Flaw("text is no curve", "left out, but as paths it would come in"),
    "flowRoot": Flaw("text is no curve", "left out, but as paths it would come in"),
    "image": Flaw("a picture is no curve", "left out"),
    "foreignObject": Flaw("it is of another kind than SVG", "left out"),
    "script": Flaw("programs are not run", "left out"),
    "animate": Flaw("motion is not taken over", "it comes in as it begins"),
}
NO_CURVES |= dict.fromkeys(("set", "animateMotion", "animateTransform"), NO_CURVES["animate"])
"""Elements that show something else than curves, and what is said of them where they are not shown."""

_SHOWN = "shown in a new document, but not edited"
_EVEN = "shown in a new document without turned or stretched letters, but not edited"
_FRAMED = "its file lies elsewhere: a frame shows where it is"


class KeptThings:
    """The texts and pictures of one file, as they are met.

    Attributes
    ----------
    elements
        For each, what shows it, with the texts or the picture as they stand in the file.
    """

    def __init__(self, paints: Paints, declared: Callable[[ET.Element], Mapping[str, str]]) -> None:
        self._reads_texts, self._reads_pictures = KeptTexts(paints, declared), KeptPictures()
        self.elements: list[tuple[Anchor, tuple[KeptText | KeptPicture, ...]]] = []
        # Each with the number of paths behind it, and the groups around.
        self._texts: list[tuple[KeptText, int, tuple[Group, ...]]] = []
        self._pictures: list[tuple[KeptPicture, int, tuple[Group, ...]]] = []

    def keep(self, tag: str, element: ET.Element, state: State, behind: int, anchor: Anchor) -> Flaw:
        """Keep what an element shows over so many paths; return what is said of it."""
        flaw = NO_CURVES[tag]
        # In a clone it is where that is.
        locked = element.get(INSENSITIVE) == "true" or anchor.element is not element
        if tag == "text" and (lines := self._reads_texts.lines(element, state)):
            clips = (*state.clips, *(clip_of_box(each.box, each.matrix) for each in state.windows))
            texts = [
                replace(line, clips=clips, follows=at > 0, locked=locked) for at, line in enumerate(lines)
            ]
            self._texts += [(text, behind, state.groups) for text in texts]
            self.elements.append((anchor, tuple(texts)))
            return Flaw(flaw.why, _EVEN if _is_uneven(element) else _SHOWN)
        if tag == "image" and (picture := self._reads_pictures.picture(element, state)) is not None:
            picture = replace(picture, locked=locked)
            self._pictures.append((picture, behind, state.groups))
            self.elements.append((anchor, (picture,)))
            return Flaw(flaw.why, _SHOWN if picture.data else _FRAMED)
        return flaw

    def placed(
        self, drawn: Sequence[Drawn], names: Mapping[Group, str]
    ) -> tuple[tuple[KeptText, ...], tuple[KeptPicture, ...]]:
        """Return what was kept, each in front of all paths of the file or behind them, in groups with names.

        A text is in front if there is any path behind it, a picture if it covers an area.
        """
        first = next((place for place, each in enumerate(drawn) if each.path.look.visible), len(drawn))

        def named(groups: Sequence[Group]) -> tuple[str, ...]:
            return tuple(names[group] for group in groups if group in names)

        texts = tuple(
            replace(each, behind=place <= first, groups=named(groups)) for each, place, groups in self._texts
        )
        pictures = tuple(
            replace(each, behind=not _covers(each, drawn[:place]), groups=named(groups))
            for each, place, groups in self._pictures
        )
        return texts, pictures


def _is_uneven(text: ET.Element) -> bool:
    """Whether letters of a text are turned, or stretched to a length."""
    return any(
        each.get("textLength") or (each.get("rotate") or "0").strip() not in ("0", "") for each in text.iter()
    )


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
