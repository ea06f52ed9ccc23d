"""Elements of a file that do not come in as they are, and those that are broken."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping

from ..errors import ExchangeError
from ..missed import Flaw, Missed
from .names import shown_name
from .xml_tree import tag_of

_MOTION = Flaw("animation", "not played")
_TEXT = Flaw("text")
NOT_READ = {
    "text": _TEXT,
    "flowRoot": _TEXT,
    "image": Flaw("picture"),
    "foreignObject": Flaw("foreign object"),
    "script": Flaw("script", "not run"),
    **dict.fromkeys(("animate", "set", "animateMotion", "animateTransform"), _MOTION),
}
"""Elements that show something else than curves, and what becomes of them."""

NOT_APPLIED = "not applied"
_EFFECTS = {
    "filter": Flaw("filter", NOT_APPLIED),
    "mask": Flaw("mask", NOT_APPLIED),
    "mix-blend-mode": Flaw("blend mode", NOT_APPLIED),
}
_NO_EFFECT = ("none", "normal")


def effects_on(declared: Mapping[str, str]) -> list[Flaw]:
    """Return what properties of an element do to it that no style here does."""
    return [flaw for name, flaw in _EFFECTS.items() if declared.get(name, "none") not in _NO_EFFECT]


class Missing(Missed):
    """What is missed of the elements of one file."""

    def __init__(self, root: ET.Element) -> None:
        super().__init__()
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}

    def number_of(self, element: ET.Element) -> int:
        """Return the number of an element in its file, from 1."""
        return self._number[element]

    def note_of(self, element: ET.Element, *flaws: Flaw) -> None:
        """Take note of what is missed of an element, once, however often that is used."""
        for flaw in flaws:
            self.note(flaw, element, shown_name(element))

    def broken(self, element: ET.Element, why: str) -> ExchangeError:
        """Return the error that an element cannot be read."""
        if why.startswith("Element "):
            return ExchangeError(why)
        return ExchangeError(f"Element {self._number[element]} (<{tag_of(element)}>): {why}")
