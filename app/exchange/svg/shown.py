"""What an SVG file shows beside paths: texts and pictures, each in a frame."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from msgspec import structs

from curvecore.arrays import FloatArray

from ...document.clip import Clip
from ...document.content import MOST_LETTERS, MOST_PIXELS, Content, Lettering
from ...document.contents import is_framed, shortened
from ...document.form_edits import framed
from ...document.model import MAX_MAGNITUDE
from ...document.style import NO_LINE, FillRule
from ..cubics_in import ImportedPath, Look
from ..missed import LEFT_OUT
from .clips import clip_of_box
from .elements import Elements
from .flaw import Flaw
from .matrices import moved
from .paint import Paints
from .pictures import Pictures
from .properties import Properties
from .state import State
from .texts import Texts
from .xml_tree import reference_of

CONTENTS = ("text", "flowRoot", "image")
"""Elements that come in as frames of what they show."""

_NO_TEXT = Flaw("it has no letters that can be read here", "left out, but as paths it would come in")
NO_CURVES = {
    "text": _NO_TEXT,
    "flowRoot": _NO_TEXT,
    "image": Flaw("it has no place", LEFT_OUT),
    "foreignObject": Flaw("it is of another kind than SVG", LEFT_OUT),
    "script": Flaw("programs are not run", LEFT_OUT),
    "animate": Flaw("motion is not taken over", "it comes in as it begins"),
}
NO_CURVES |= dict.fromkeys(("set", "animateMotion", "animateTransform"), NO_CURVES["animate"])
"""Elements that show something else than curves, and what is said of them where they do not come in."""

_UNEVEN = Flaw("some of its letters are turned or stretched", "they come in as all others")
_TOO_LONG = Flaw(f"of all texts {MOST_LETTERS} letters are read", LEFT_OUT)
_NO_PICTURE = Flaw(
    f"it is no PNG or JPEG picture of up to {MOST_PIXELS // 1_000_000} megapixels, or too much beside others",
    "a frame shows where it is",
)
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

    @property
    def frame(self) -> FloatArray:
        """The sides of its frame in its own units, (4, 4, 2)."""
        return np.array(self.form.sides) * (1.0, -1.0)

    @property
    def is_painted(self) -> bool:
        """Whether its style paints it: a picture has its own colours."""
        return isinstance(self.form, Lettering)

    @property
    def is_flat(self) -> bool:
        """Whether it lies in a line, or where no document may have it."""
        corners = moved(self.frame[:, 0], self.matrix)
        # Written so that NaN fails.
        if not (np.abs(corners) <= MAX_MAGNITUDE).all():
            return True
        return not is_framed(framed(self.form, [(x, y) for x, y in corners.tolist()], "frame"))

    def path(self, name: str, look: Look) -> ImportedPath:
        """Return its frame as a path that looks so, called by what it shows where it has no name."""
        style = structs.replace(look.style, clips=self.clips, fill_rule=FillRule.NONZERO)
        if not self.is_painted:
            style = structs.replace(NO_LINE, opacity=style.opacity, clips=self.clips)
        pieces = moved(self.frame, self.matrix)
        name = name or shortened(self.form.title)
        return ImportedPath(name, replace(look, style=style), pieces, closed=True, form=self.form)


class Shown:
    """The texts and pictures of one file, as they are met."""

    def __init__(self, paints: Paints, elements: Elements) -> None:
        self._texts = Texts(paints, elements)
        self._pictures = Pictures()

    def found(self, tag: str, element: ET.Element, state: State) -> Found | None:
        """Return what an element shows; None where it cannot be shown."""
        found = self._read(tag, element, state)
        return None if found is None or found.is_flat else found

    def _read(self, tag: str, element: ET.Element, state: State) -> Found | None:
        if tag in ("text", "flowRoot") and (text := self._texts.text(element, state)) is not None:
            clips = (*state.clips, *(clip_of_box(each.box, each.matrix) for each in state.windows))
            flaw = _UNEVEN if _is_uneven(element) else None
            return Found(text.form, state.matrix, clips, text.properties, flaw)
        if tag == "image" and (picture := self._pictures.picture(element, state)) is not None:
            clips = (*state.clips, *(clip_of_box(each.box, each.matrix) for each in picture.askew))
            missing = _NO_PICTURE if reference_of(element).startswith("data:") else _ELSEWHERE
            flaw = None if picture.form.data or picture.form.link else missing
            return Found(picture.form, picture.matrix, clips, state.properties, flaw)
        return None

    def why_not(self, tag: str) -> Flaw:
        """Return what is said of the last element of this kind, which cannot be shown."""
        return _TOO_LONG if tag == "text" and self._texts.is_full else NO_CURVES[tag]


def _is_uneven(text: ET.Element) -> bool:
    """Whether letters of a text are turned, or stretched to a length."""
    return any(
        each.get("textLength") or (each.get("rotate") or "0").strip() not in ("0", "") for each in text.iter()
    )
