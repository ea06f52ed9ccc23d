"""Blurred pictures: what is painted beside the screen or the page, and softened by a Gaussian."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from ..document.style import BLUR_REACH

_Pixels = NDArray[np.float32]

_SMOOTH = 3.0
"""Standard deviations in pixels above which fewer pixels do: what is between them is even."""

_LEAST = 0.15
"""Standard deviations in pixels below which nothing is softened."""

_ROWS = 32
_FORMAT = QImage.Format.Format_ARGB32_Premultiplied


def blurred(
    paint: Callable[[QPainter, QRectF, float], None],
    place: QRectF,
    deviation: float,
    *,
    scale: float = 1.0,
    most: float = math.inf,
    opacity: float = 1.0,
) -> QImage:
    """Return a picture of a place in the units of a painter, blurred.

    Parameters
    ----------
    paint
        Paints into a picture of the place; it is given that, and how many pixels there are to a unit.
    place, deviation
        What the picture shows, and the standard deviation of the Gaussian.
    scale
        How many pixels there are to a unit where the picture will be shown: it has these or fewer.
    most
        How many pixels it has at most.
    opacity
        Of all of it.
    """
    fine = scale * min(1.0, _SMOOTH / (deviation * scale))
    fine *= min(1.0, math.sqrt(most / max(place.width() * place.height() * fine * fine, 1.0)))
    wide, high = (max(math.ceil(side * fine), 1) for side in (place.width(), place.height()))
    picture = QImage(wide, high, _FORMAT)
    picture.fill(0)
    across, down = picture.width() / place.width(), picture.height() / place.height()
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        # A whole number of pixels is shown in the place: by less than one of them it is stretched.
        painter.scale(across / fine, down / fine)
        paint(painter, place, fine)
    pixels = np.frombuffer(picture.constBits(), np.uint8).reshape(high, wide, 4).astype(np.float32)
    soft = softened(pixels, (deviation * down, deviation * across)) * opacity
    whole = np.ascontiguousarray((soft + 0.5).astype(np.uint8))
    # The bytes are Qt's own from here on.
    return QImage(whole.data, picture.width(), picture.height(), 4 * picture.width(), _FORMAT).copy()


def softened(pixels: _Pixels, deviations: tuple[float, float]) -> _Pixels:
    """Return pixels (h, w, c) softened by a Gaussian with these deviations down and across; beyond is 0."""
    for deviation in deviations:
        # Each pass turns the picture over, so that the next goes along the other side.
        pixels = np.ascontiguousarray(_along_first(pixels, deviation).transpose(1, 0, 2))
    return pixels


def _along_first(pixels: _Pixels, deviation: float) -> _Pixels:
    """Return pixels softened along the first axis, as products of matrices: many rows at once."""
    if deviation < _LEAST:
        return pixels
    reach = math.ceil(BLUR_REACH * deviation)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    weights /= weights.sum()
    band = np.zeros((_ROWS, _ROWS + 2 * reach), np.float32)
    for row in range(_ROWS):
        band[row, row : row + 2 * reach + 1] = weights
    count, blocks = len(pixels), -(-len(pixels) // _ROWS)
    rows = pixels.reshape(count, -1)
    room = np.zeros((blocks * _ROWS + 2 * reach, rows.shape[1]), np.float32)
    room[reach : reach + count] = rows
    soft = np.empty((blocks * _ROWS, rows.shape[1]), np.float32)
    for start in range(0, len(soft), _ROWS):
        np.matmul(band, room[start : start + _ROWS + 2 * reach], out=soft[start : start + _ROWS])
    found: _Pixels = soft[:count].reshape(pixels.shape)
    return found
