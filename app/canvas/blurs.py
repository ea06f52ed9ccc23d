"""Blurred shapes on the canvas: a picture of each, kept as long as it looks the same."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec
import numpy as np
from PySide6.QtCore import QObject, QRectF, QTimer
from PySide6.QtGui import QImage, QPainter

from curvecore.arrays import FloatArray

from ..document.contents import is_content
from ..document.style import BLUR_REACH, Style
from ..plotting.pixel_map import PixelMap
from ..plotting.printed import to_pixels
from ..qt.blurs import blurred
from ..qt.clips import clipped
from ..view_model.curve.curve_view import CurveView

_REST_MS = 120
"""After which what moves has come to rest."""

_COARSE = 120_000
"""Pixels of a picture of what moves: some hundredths of a second for a few of them."""

_MOST_KEPT = 64
_MOST_PIXELS = 16_000_000

PaintSharp = Callable[[QPainter, PixelMap, float], None]
"""Paints a shape sharply into a part of the plane, with its lengths in pixels times a factor."""


class _Kept(msgspec.Struct, eq=False):
    """A picture of a part of the plane, and what it is of."""

    shape: tuple[CurveView, ...]
    key: tuple[object, ...]
    picture: QImage
    place: QRectF
    sound: QRectF
    is_coarse: bool


class Blurs:
    """Pictures of the blurred shapes of one layer; coarse ones of what moves, until it rests.

    Parameters
    ----------
    owner
        What it lives as long as.
    redraw
        Has the shapes painted again.

    Attributes
    ----------
    made
        How many pictures were computed so far.
    """

    def __init__(self, owner: QObject, redraw: Callable[[], None]) -> None:
        self._kept: dict[int, _Kept] = {}
        self._redraw, self.made = redraw, 0
        self._rest = QTimer(owner, singleShot=True, interval=_REST_MS)
        self._rest.timeout.connect(self._refine)

    def _refine(self) -> None:
        coarse = [name for name, each in self._kept.items() if each.is_coarse]
        for name in coarse:
            del self._kept[name]
        if coarse:
            self._redraw()

    def found(self, shape: Sequence[CurveView], key: tuple[object, ...], seen: QRectF) -> _Kept | None:
        """Return the picture of a shape that looks so, if what is seen of it is sound in it."""
        kept = self._kept.get(id(shape[0]))
        # But for rounding.
        x, y = 1e-6 * seen.width(), 1e-6 * seen.height()
        if kept is None or kept.key != key or not kept.sound.contains(seen.adjusted(x, y, -x, -y)):
            return None
        return kept if all(one is other for one, other in zip(kept.shape, shape, strict=False)) else None

    @property
    def most(self) -> float:
        """How many pixels a picture may have now; to be asked once for each."""
        is_moving = self._rest.isActive()
        self._rest.start()
        return _COARSE if is_moving else _MOST_PIXELS / 4

    def keep(self, kept: _Kept) -> None:
        """Keep a picture that was made, and forget those that were made first if they are too many."""
        self.made += 1
        self._kept.pop(id(kept.shape[0]), None)
        self._kept[id(kept.shape[0])] = kept
        pixels = sum(each.picture.width() * each.picture.height() for each in self._kept.values())
        while len(self._kept) > _MOST_KEPT or (pixels > _MOST_PIXELS and len(self._kept) > 1):
            oldest = self._kept.pop(next(iter(self._kept)))
            pixels -= oldest.picture.width() * oldest.picture.height()


def paint_blurred(
    painter: QPainter,
    shape: Sequence[CurveView],
    style: Style,
    shown: PixelMap,
    width: float,
    key: tuple[object, ...],
    paint: PaintSharp,
    blurs: Blurs | None = None,
) -> None:
    """Paint a shape whose style is blurred; `width` is that of its line in pixels.

    Its picture hangs on these and on a `key`.

    Its clips cut what is blurred.
    """
    ratio = painter.device().devicePixelRatioF()
    whole = _in_plane(blurred_box(shape, style, width / shown.sx))
    seen = _in_plane(_box_of(shown)).intersected(whole)
    if seen.isEmpty():
        return
    key = (style, width, shown.sx, shown.sy, ratio, *key)
    kept = blurs.found(shape, key, seen) if blurs is not None else None
    if kept is None:
        kept = _made(shape, style, shown, ratio, key, (whole, seen), paint, blurs)
    left, top = shown.point(kept.place.left(), kept.place.bottom())
    target = QRectF(left, top, kept.place.width() * shown.sx, kept.place.height() * shown.sy)
    with clipped(painter, style.clips, to_pixels(shown), QRectF(0, 0, shown.width, shown.height)):
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, True)
        painter.drawImage(target, kept.picture, QRectF(kept.picture.rect()))


def _made(
    shape: Sequence[CurveView],
    style: Style,
    shown: PixelMap,
    ratio: float,
    key: tuple[object, ...],
    boxes: tuple[QRectF, QRectF],
    paint: PaintSharp,
    blurs: Blurs | None,
) -> _Kept:
    """Make the picture of a shape: of what is seen of it, and of half as much around that for a pan."""
    whole, seen = boxes
    across, down = shown.width / shown.sx / 2, shown.height / shown.sy / 2
    sound = seen.adjusted(-across, -down, across, down).intersected(whole)
    reach = BLUR_REACH * style.blur
    place = sound.adjusted(-reach, -reach, reach, reach).intersected(whole)
    in_pixels = QRectF(0, 0, place.width() * shown.sx, place.height() * shown.sy)

    def paint_part(inner: QPainter, part: QRectF, fine: float) -> None:
        scale = (shown.sx * fine, shown.sy * fine)
        size = (part.width() * fine, part.height() * fine)
        paint(inner, PixelMap(place.left(), place.bottom(), *scale, *size), fine)

    most = _MOST_PIXELS / 4 if blurs is None else blurs.most
    picture = blurred(paint_part, in_pixels, style.blur * shown.sx, scale=ratio, most=most)
    is_coarse = most == _COARSE and picture.width() * picture.height() > 0.9 * _COARSE
    kept = _Kept(tuple(shape), key, picture, place, sound, is_coarse)
    if blurs is not None:
        blurs.keep(kept)
    return kept


def blurred_box(shape: Sequence[CurveView], style: Style, width: float) -> FloatArray:
    """Return a box in the plane, [[left, low], [right, high]], that a blurred shape does not leave."""
    corners = np.vstack([view.drawn_box for view in shape if view.has_curve])
    overhang = width * max(1.0, style.miter_limit)
    reach = BLUR_REACH * style.blur + (overhang if style.has_stroke else 0.0)
    if is_content(shape[0].source):
        # Letters reach beyond their frame.
        reach += float(np.ptp(corners, axis=0).min()) / 2
    return np.array([corners.min(axis=0) - reach, corners.max(axis=0) + reach])


def _box_of(shown: PixelMap) -> FloatArray:
    left, low, right, high = shown.box
    return np.array([[left, low], [right, high]])


def _in_plane(box: FloatArray) -> QRectF:
    """Return a box as Qt has it; its bottom is the largest y."""
    (left, low), (right, high) = box.tolist()
    return QRectF(left, low, right - left, high - low)
