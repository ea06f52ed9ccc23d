"""Pictures of an SVG file: those that are in it, and the places of others."""

from __future__ import annotations

import binascii
import xml.etree.ElementTree as ET
from base64 import b64decode, b64encode
from typing import NamedTuple
from urllib.parse import unquote

import numpy as np

from curvecore.arrays import FloatArray

from ...document.content import LONGEST_LINK, MOST_DATA, Picture
from ...document.model import MAX_MAGNITUDE
from ..errors import ExchangeError
from ..picture_sizes import size_of
from .matrices import Box, combined, fitted_box, moved
from .shapes import length_of
from .state import State, Window
from .xml_tree import reference_of

_ASKEW = 1e-9


class PictureFound(NamedTuple):
    """A picture, where it lies, and the boxes that cut it but for those that leave a part along its edges.

    Attributes
    ----------
    matrix
        (2, 3), from its width and height, y downwards, to the document's plane.
    """

    form: Picture
    matrix: FloatArray
    askew: tuple[Window, ...]


class Pictures:
    """The pictures of one file."""

    def __init__(self) -> None:
        self._left = MOST_DATA

    def picture(self, element: ET.Element, state: State) -> PictureFound | None:
        """Return a picture; None where it has no place."""
        reference = reference_of(element)
        data = _content_of(reference)
        size = size_of(data)
        text = b64encode(data).decode() if size is not None else ""
        if len(text) > self._left:
            text = ""
        place = _place_of(element, state, size)
        if place is None:
            return None
        matrix = state.matrix
        if size is not None:
            fit = fitted_box((0.0, 0.0, *size), place, element.get("preserveAspectRatio", ""))
            matrix = combined(matrix, fit @ np.diag([*size, 1.0]))
        else:
            matrix = combined(matrix, np.array([[place[2], 0.0, place[0]], [0.0, place[3], place[1]]]))
        # Written so that NaN fails.
        if not (np.abs(matrix) <= MAX_MAGNITUDE).all() or not np.linalg.det(matrix[:, :2]):
            return None
        self._left -= len(text)
        part = _seen(matrix, state)
        if part is None:
            return None
        inverse = _inverse(matrix)
        (left, top), (right, bottom) = part[:2], part[2:]
        frame = moved(np.array([(left, top), (right, top), (right, bottom), (left, bottom)]), matrix)
        askew = tuple(
            each for each in state.windows if not (_cuts_along(each, inverse) or _is_around(each, frame))
        )
        (x, y), (width, height) = part[:2], (part[2] - part[0], part[3] - part[1])
        link = "" if text or reference.startswith("data:") else reference[:LONGEST_LINK]
        is_stretched = bool(link) and element.get("preserveAspectRatio", "").strip().startswith("none")
        form = Picture(x, -(y + height), width, height, text, part, link, is_stretched)
        return PictureFound(form, matrix, askew)


def _seen(matrix: FloatArray, state: State) -> tuple[float, float, float, float] | None:
    """Return what of a picture is seen in the boxes around it that lie along its edges; None for nothing."""
    inverse = _inverse(matrix)
    low, high = np.zeros(2), np.ones(2)
    for window in state.windows:
        x, y, width, height = window.box
        if not _cuts_along(window, inverse):
            continue
        by = combined(inverse, window.matrix)
        ends = moved(np.array([(x, y), (x + width, y + height)]), by)
        low, high = np.maximum(low, ends.min(axis=0)), np.minimum(high, ends.max(axis=0))
    if not (low < high).all():
        return None
    (left, top), (right, bottom) = low.tolist(), high.tolist()
    return left, top, right, bottom


def _cuts_along(window: Window, inverse: FloatArray) -> bool:
    """Whether a window leaves a part of a picture that is one itself; clips stay what they are."""
    return not window.is_clip and _is_along(combined(inverse, window.matrix))


def _is_around(window: Window, frame: FloatArray) -> bool:
    """Whether an upright clip leaves all of a picture."""
    return window.is_clip and _is_along(window.matrix) and window.holds(frame)


def _inverse(matrix: FloatArray) -> FloatArray:
    found: FloatArray = np.linalg.inv(np.vstack([matrix, (0.0, 0.0, 1.0)]))[:2]
    return found


def _is_along(by: FloatArray) -> bool:
    """Whether a matrix leaves edges along edges."""
    return int(np.count_nonzero(np.abs(by[:, :2]) > _ASKEW * np.abs(by[:, :2]).max())) == 2


def _place_of(element: ET.Element, state: State, size: tuple[float, float] | None) -> Box | None:
    """Return the box that a picture is fitted into."""
    try:
        x, y, width, height = (
            length_of(element, name, state.viewport) for name in ("x", "y", "width", "height")
        )
    except ExchangeError:
        return None
    if size is not None:
        across, down = size
        given = width or (height * across / down if height else across)
        width, height = given, height or given * down / across
    if not width or not height or width < 0 or height < 0:
        return None
    return (x or 0.0, y or 0.0, width, height)


def _content_of(reference: str) -> bytes:
    """Return the file that a reference holds itself; nothing of one elsewhere."""
    head, _, content = reference.partition(",")
    words = head.lower().split(";")
    if not words[0].startswith("data:") or words[-1].strip() != "base64":
        return b""
    try:
        return b64decode(unquote(content) if "%" in content else content)
    except (binascii.Error, ValueError):
        return b""
