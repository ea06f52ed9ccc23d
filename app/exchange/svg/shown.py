"""What an SVG file shows beside paths: texts and pictures, each in a frame."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from typing import NamedTuple

from curvecore.arrays import FloatArray

from ...document.clip import Clip
from ...document.content import Content
from .clips import clip_of_box
from .flaw import Flaw
from .paint import Paints
from .pictures import Pictures
from .properties import Properties
from .state import State
from .texts import Texts

CONTENTS = ("text", "image")
"""Elements that come in as frames of what they show."""

_NO_TEXT = Flaw("it has no letters that can be read here", "left out, but as paths it would come in")
NO_CURVES = {
    "text": _NO_TEXT,
    "flowRoot": _NO_TEXT,
    "image": Flaw("it has no place", "left out"),
    "foreignObject": Flaw("it is of another kind than SVG", "left out"),
    "script": Flaw("programs are not run", "left out"),
    "animate": Flaw("motion is not taken over", "it comes in as it begins"),
}
NO_CURVES |= dict.fromkeys(("set", "animateMotion", "animateTransform"), NO_CURVES["animate"])
"""Elements that show something else than curves, and what is said of them where they do not come in."""

_UNEVEN = Flaw("some of its letters are turned or stretched", "they come in as all others")
_ELSEWHERE = Flaw("its file lies elsewhere", "a frame shows where it is")


class Found(NamedTuple):
    """What an element shows in a frame.

    Attributes
    ----------
    form
        The text or the picture, in its own units.
    matrix
        (2, 3), from those, y downwards, to the document's plane.
    clips
        What it is cut by.
    properties
        Those that say how it is painted.
    flaw
        What is said of it; None for nothing.
    """

    form: Content
    matrix: FloatArray
    clips: tuple[Clip, ...]
    properties: Properties
    flaw: Flaw | None = None


class Shown:
    """The texts and pictures of one file, as they are met."""

    def __init__(self, paints: Paints, declared: Callable[[ET.Element], Mapping[str, str]]) -> None:
        self._texts, self._pictures = Texts(paints, declared), Pictures()

    def found(self, tag: str, element: ET.Element, state: State) -> Found | None:
        """Return what an element shows; None where it cannot be shown."""
        if tag == "text" and (text := self._texts.text(element, state)) is not None:
            clips = (*state.clips, *(clip_of_box(each.box, each.matrix) for each in state.windows))
            flaw = _UNEVEN if _is_uneven(element) else None
            return Found(text.form, state.matrix, clips, text.properties, flaw)
        if tag == "image" and (picture := self._pictures.picture(element, state)) is not None:
            clips = (*state.clips, *(clip_of_box(each.box, each.matrix) for each in picture.askew))
            flaw = None if picture.form.data or picture.form.link else _ELSEWHERE
            return Found(picture.form, picture.matrix, clips, state.properties, flaw)
        return None


def _is_uneven(text: ET.Element) -> bool:
    """Whether letters of a text are turned, or stretched to a length."""
    return any(
        each.get("textLength") or (each.get("rotate") or "0").strip() not in ("0", "") for each in text.iter()
    )
