"""What of a file does not come in as it is: told of each element by its number and its name."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping

from ..errors import ExchangeError
from ..missed import LEFT_OUT, Flaw, Missed
from .names import shown_name
from .xml_tree import tag_of

_MOTION = Flaw("motion is not taken over", "it comes in as it begins")
_TEXT = Flaw("texts are not read", LEFT_OUT)
NOT_READ = {
    "text": _TEXT,
    "flowRoot": _TEXT,
    "image": Flaw("pictures are not read", LEFT_OUT),
    "foreignObject": Flaw("it is of another kind than SVG", LEFT_OUT),
    "script": Flaw("programs are not run", LEFT_OUT),
    **dict.fromkeys(("animate", "set", "animateMotion", "animateTransform"), _MOTION),
}
"""Elements that show something else than curves, and why they do not come in."""

_EFFECTS = {
    "filter": Flaw("a filter changes it", "it comes in without"),
    "mask": Flaw("a mask covers some of it", "it comes in whole"),
    "mix-blend-mode": Flaw("it is blended with what lies below", "it covers that"),
}
_NO_EFFECT = ("none", "normal")


def effects_on(declared: Mapping[str, str]) -> list[Flaw]:
    """Return what properties of an element do to it that no style here does."""
    return [flaw for name, flaw in _EFFECTS.items() if declared.get(name, "none") not in _NO_EFFECT]


class Missing:
    """What is missed of the elements of one file.

    Attributes
    ----------
    found
        That, each once, in the order in which it was met.
    """

    def __init__(self, root: ET.Element, begun: Iterable[Missed]) -> None:
        self._number = {element: index for index, element in enumerate(root.iter(), start=1)}
        self.found: dict[Missed, None] = dict.fromkeys(begun)

    def number_of(self, element: ET.Element) -> int:
        """Return the number of an element in its file, from 1."""
        return self._number[element]

    def note(self, element: ET.Element, *flaws: Flaw) -> None:
        """Take note of what is missed of an element, once, however often that is used."""
        for each in flaws:
            number = self._number[element]
            missed = Missed(f"<{tag_of(element)}>", shown_name(element), number, each.why, each.instead)
            self.found[missed] = None

    def broken(self, element: ET.Element, why: str) -> ExchangeError:
        """Return the error that an element cannot be read."""
        if why.startswith("Element "):
            return ExchangeError(why)
        return ExchangeError(f"Element {self._number[element]} (<{tag_of(element)}>): {why}")
