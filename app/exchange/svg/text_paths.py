"""Texts of an SVG file that lie along a path: which one, and from where on.

Reference: Scalable Vector Graphics 2, section 11.8.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from msgspec import structs

from ...document.along_path import Along
from ...document.content import Lettering
from ...document.model import MAX_MAGNITUDE
from ..cubics_in import ImportedPath
from ..errors import ExchangeError
from .elements import Elements
from .groups import Drawn
from .matrices import moved, transform_of
from .properties import Properties
from .shapes import SHAPES, subpaths_of
from .state import State
from .xml_tree import reference_of, tag_of

_LONGEST_REFERENCE = 64
_TOLD = ("title", "desc", "metadata")


class OnPath(NamedTuple):
    """What of a text lies along a path, and that."""

    element: ET.Element
    along: Along


class TextPaths:
    """The paths that texts of one file lie along."""

    def __init__(self, elements: Elements) -> None:
        self._elements = elements

    def found(self, text: ET.Element, state: State, length: Callable[[str, float], float]) -> OnPath | None:
        """Return what of a text lies along a path; None where not all of it does.

        Until `linked` its course is called by what the file refers to.
        """
        inside = [each for each in text if tag_of(each) not in _TOLD]
        words = (text.text, *(each.tail for each in text))
        if len(inside) != 1 or tag_of(inside[0]) != "textPath" or any((each or "").strip() for each in words):
            return None
        element = inside[0]
        target = self._elements.used(element)
        if target is None or tag_of(target) not in SHAPES:
            return None
        try:
            course = self._course(target, state)
        except ExchangeError:
            return None
        if course is None or not len(course) or not (np.abs(course) <= MAX_MAGNITUDE).all():
            return None
        said = element.get("startOffset", "").strip()
        along = Along(
            tuple(tuple((x, y) for x, y in piece) for piece in course.tolist()),  # type: ignore[misc]
            reference_of(element)[:_LONGEST_REFERENCE],
            start=_share(said) if said.endswith("%") else length(said, _size(state.properties)),
            is_share=said.endswith("%"),
            is_flipped=element.get("side", "").strip().lower() == "right",
        )
        return OnPath(element, along)

    def _course(self, target: ET.Element, state: State) -> np.ndarray | None:
        """Return the pieces of a path in the units of a text, (k, 4, 2)."""
        subpaths = [each.controls for each in subpaths_of(target, state.viewport, None) if len(each.controls)]
        said = self._elements.declared(target).get("transform", "none")
        transform = target.get("transform", "") if said == "none" else said
        return moved(np.concatenate(subpaths), transform_of(transform)) if subpaths else None


def _size(properties: Properties) -> float:
    return float(properties.values["font-size"])


def _share(word: str) -> float:
    try:
        share = float(word[:-1]) / 100
    except ValueError:
        return 0.0
    return share if abs(share) <= MAX_MAGNITUDE else 0.0


def linked(drawn: Sequence[Drawn], paths: Sequence[ImportedPath], key: str) -> list[ImportedPath]:
    """Return paths, whose texts know the curves that they lie along by identities, which begin with `key`.

    A path that is drawn nowhere, or by a `use` alone, is a course of the text's own.
    """
    found = list(paths)
    if not any(_along(each) for each in paths):
        return found
    places = {
        f"#{each.source[0].get('id', '')}"[:_LONGEST_REFERENCE]: place
        for place, each in reversed(list(enumerate(drawn)))
        if each.source is not None and not each.state.inside
    }
    for place, path in enumerate(paths):
        along = _along(path)
        if along is None:
            continue
        original = places.get(along.of)
        if original is None:
            along = structs.replace(along, of="")
        else:
            identity = found[original].identity or f"{key}{original}"
            found[original] = replace(found[original], identity=identity)
            (a, c, x), (b, d, y) = drawn[original].anchor.around.matrix.tolist()
            along = structs.replace(along, of=identity, ground=(x, y, a, b, c, d))
        assert isinstance(path.form, Lettering)
        found[place] = replace(found[place], form=structs.replace(path.form, along=along))
    return found


def _along(path: ImportedPath) -> Along | None:
    return path.form.along if isinstance(path.form, Lettering) else None
