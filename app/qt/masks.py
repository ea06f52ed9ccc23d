"""Masks of a document's styles: what is painted beside screen or page, and seen as far as they say."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QImage, QPainter, QTransform

from ..document.gradient import Tile
from ..document.mask import Mask
from .patterns import renderer_of

_BLACK = "#000000"
_FORMAT = QImage.Format.Format_ARGB32_Premultiplied
_SMOOTHLY = QPainter.RenderHint.SmoothPixmapTransform | QPainter.RenderHint.LosslessImageRendering
_MOST_PIXELS = 16_000_000
_LIGHT = np.array([0.0721, 0.7154, 0.2125, 0.0], np.float32)
"""Of blue, green and red, in the order of their bytes."""

_COVER = np.array([0.0, 0.0, 0.0, 1.0], np.float32)

_Pixels = NDArray[np.uint8]
_Cover = NDArray[np.float32]


def paint_masked(
    painter: QPainter,
    masks: Sequence[Mask],
    way: QTransform,
    place: QRectF,
    fine: float,
    paint: Callable[[QPainter], None],
) -> None:
    """Paint something as far as masks let it be seen.

    Parameters
    ----------
    painter, paint
        Where it is shown, and what paints all of it in the units of that painter.
    masks, way
        What lies over it, and the way from their plane to these units.
    place
        What is seen of it at most, in these units.
    fine
        How many pixels there are to a unit.
    """
    for mask in masks:
        place = place.intersected((_to_plane(mask) * way).mapRect(QRectF(*mask.tile.view)))
    if place.isEmpty():
        return
    # On whole pixels it is as sharp as what is painted right there.
    left, top = (math.floor(each * fine) / fine for each in (place.left(), place.top()))
    right, bottom = (math.ceil(each * fine) / fine for each in (place.right(), place.bottom()))
    place = QRectF(left, top, right - left, bottom - top)
    picture = beside(painter, place, fine, paint)
    pixels = _pixels(picture)
    wide, high = picture.width() / place.width(), picture.height() / place.height()
    to_picture = QTransform.fromTranslate(-left, -top) * QTransform.fromScale(wide, high)
    cover = np.ones(pixels.shape[:2], np.float32)
    for mask in masks:
        cover *= _cover(mask, _to_plane(mask) * way * to_picture, picture.size())
    shown = np.ascontiguousarray((pixels * cover[..., None] + 0.5).astype(np.uint8))
    painter.save()
    painter.setRenderHints(_SMOOTHLY)
    size = picture.width(), picture.height(), 4 * picture.width()
    painter.drawImage(place, QImage(shown.data, *size, _FORMAT))
    painter.restore()


def beside(painter: QPainter, place: QRectF, fine: float, paint: Callable[[QPainter], None]) -> QImage:
    """Return a picture of a place in the units of a painter, with so many pixels to each or fewer."""
    fine *= min(1.0, math.sqrt(_MOST_PIXELS / (place.width() * place.height() * fine * fine)))
    picture = QImage((place.size() * fine).toSize().expandedTo(QSize(1, 1)), _FORMAT)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as inner:
        inner.setRenderHints(painter.renderHints() | QPainter.RenderHint.Antialiasing)
        inner.scale(picture.width() / place.width(), picture.height() / place.height())
        inner.translate(-place.topLeft())
        paint(inner)
    return picture


def _to_plane(mask: Mask) -> QTransform:
    return QTransform(*mask.matrix)


def _cover(mask: Mask, way: QTransform, size: QSize) -> _Cover:
    """Return how much a mask lets be seen in each pixel, where a way leads from its picture to these."""
    numbers = (way.m11(), way.m12(), way.m21(), way.m22(), way.dx(), way.dy())
    weights = _COVER if mask.is_alpha else _LIGHT
    found: _Cover = _drawn(mask.tile, numbers, size.width(), size.height()) @ weights / 255.0
    return found


@lru_cache(maxsize=8)
def _drawn(tile: Tile, way: tuple[float, ...], width: int, height: int) -> _Pixels:
    picture, place = QImage(width, height, _FORMAT), QRectF(*tile.view)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        painter.setRenderHints(QPainter.RenderHint.Antialiasing | QPainter.RenderHint.SmoothPixmapTransform)
        painter.setTransform(QTransform(*way))
        painter.setClipRect(place)
        renderer_of(tile, _BLACK).render(painter, place)
    return _pixels(picture).copy()


def _pixels(picture: QImage) -> _Pixels:
    shape = picture.height(), picture.width(), 4
    return np.frombuffer(picture.constBits(), np.uint8).reshape(shape)
