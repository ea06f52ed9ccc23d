"""Groups that are seen through on the canvas: each is painted beside the screen, and then as one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby
from operator import attrgetter

import msgspec
import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, QTimer
from PySide6.QtGui import QPainter, QPixmap

from curvecore.arrays import FloatArray

from ..appearance.theme import Theme
from ..document.group_look import together
from ..document.shapes import shapes
from ..document.style import Style
from ..plotting.pictures import transparent
from ..plotting.pixel_map import PixelMap
from ..plotting.wide_line import RoundLine
from ..view_model.curve.carried_views import common_way
from ..view_model.curve.curve_view import CurveView
from .looks import Shape, paint_shape

_FEW = 8
"""Parts of a group that are painted in every frame, whether they move or not."""

_MOST_KEPT = 16
_REST_MS = 120

_group_looks = attrgetter("group_looks")

PaintShape = Callable[[QPainter, Shape], None]
"""Paints a shape with its style into pixels of the plot."""


class _Sheet(msgspec.Struct, frozen=True, eq=False):
    """A picture of a part of the plot, and where that begins."""

    picture: QPixmap
    corner: QPointF

    @property
    def place(self) -> QRectF:
        """The part of the plot, in its pixels."""
        return QRectF(self.corner, self.picture.deviceIndependentSize())

    def draw(self, painter: QPainter) -> None:
        """Draw it where it lies."""
        painter.drawPixmap(self.corner, self.picture)


class _Kept(msgspec.Struct, eq=False):
    """Sheets of a group with many parts.

    Attributes
    ----------
    key
        What they were made for, beside what is in it.
    parts
        Those of the last frame.
    whole
        All of these.
    span
        Which of the parts move: what is behind them is on the first of the sheets, the rest on the second.
    """

    key: tuple[object, ...]
    parts: list[Shape]
    whole: _Sheet | None = None
    span: range = range(0)
    sheets: tuple[_Sheet | None, _Sheet | None] = (None, None)


class GroupSheets:
    """Sheets of the groups of one layer; while a part of many moves the others are painted but once.

    Parameters
    ----------
    owner
        What it lives as long as.
    redraw
        Has the groups painted again.

    Attributes
    ----------
    painted
        How many parts of groups were painted so far.
    """

    def __init__(self, owner: QObject, redraw: Callable[[], None]) -> None:
        self._kept: dict[str, _Kept] = {}
        self.painted = 0
        self._rest = QTimer(owner, singleShot=True, interval=_REST_MS)
        self._rest.timeout.connect(lambda: self._refine(redraw))

    def _refine(self, redraw: Callable[[], None]) -> None:
        self._kept.clear()
        redraw()

    def paint(
        self,
        painter: QPainter,
        group: Shape,
        shown: PixelMap,
        theme: Theme,
        usual: float,
        line: RoundLine,
    ) -> None:
        """Paint the curves of a group, as `paint_shape` does those of a shape."""
        ratio = painter.device().devicePixelRatioF()

        def paint_part(inner: QPainter, part: Shape) -> None:
            paint_shape(inner, part, shown, theme, usual, line)

        way = _Way(shown, usual, ratio, paint_part, self)
        views = [view for view in group if view.source.visible and view.has_curve]
        if not views:
            return
        look, parts = views[0].source.group_looks[0], _parts(views, 1)
        if len(parts) <= _FEW:
            sheet = way.sheet(parts, 1)
        else:
            sheet = self._sheet_of_many(look.name, parts, (theme, shown, usual, ratio), way)
        if sheet is not None:
            painter.save()
            painter.setOpacity(painter.opacity() * look.opacity)
            sheet.draw(painter)
            painter.restore()

    def _sheet_of_many(
        self, name: str, parts: list[Shape], key: tuple[object, ...], way: _Way
    ) -> _Sheet | None:
        kept = self._kept.get(name)
        if kept is None or kept.key != key or len(kept.parts) != len(parts):
            self._kept.pop(name, None)
            kept = self._kept[name] = _Kept(key, parts, way.sheet(parts, 1))
            while len(self._kept) > _MOST_KEPT:
                del self._kept[next(iter(self._kept))]
            return kept.whole
        changed = [at for at, pair in enumerate(zip(kept.parts, parts, strict=True)) if not _is_same(*pair)]
        before, kept.parts = kept.parts, parts
        if not changed:
            return kept.whole
        if len(changed) == len(parts) and kept.whole is not None:
            old, new = ([view for part in each for view in part] for each in (before, parts))
            gone = common_way(old, new) if len(old) == len(new) else None
            if gone is not None:
                x, y = way.shown.sx * gone[0], -way.shown.sy * gone[1]
                kept.whole = _Sheet(kept.whole.picture, kept.whole.corner + QPointF(x, y))
                self._rest.start()
                return kept.whole
        span = range(changed[0], changed[-1] + 1)
        if span != kept.span or kept.sheets == (None, None):
            kept.span = span
            kept.sheets = (way.sheet(parts[: span.start], 1), way.sheet(parts[span.stop :], 1))
        kept.whole = way.composed(parts[span.start : span.stop], *kept.sheets)
        return kept.whole


class _Way(msgspec.Struct, frozen=True, eq=False):
    """How sheets are made in one frame."""

    shown: PixelMap
    usual: float
    ratio: float
    paint: PaintShape
    owner: GroupSheets

    def sheet(self, parts: Sequence[Shape], depth: int) -> _Sheet | None:
        """Return the sheet of the parts of a group with so many around them; None where none is seen."""
        return self._made(self._place_of(parts), lambda painter: self._paint_parts(painter, parts, depth))

    def composed(self, parts: Sequence[Shape], below: _Sheet | None, above: _Sheet | None) -> _Sheet | None:
        """Return the sheet of parts between two others."""
        place = self._place_of(parts)
        for each in (below, above):
            if each is not None:
                place = place.united(each.place)

        def fill(painter: QPainter) -> None:
            if below is not None:
                below.draw(painter)
            self._paint_parts(painter, parts, 1)
            if above is not None:
                above.draw(painter)

        return self._made(place, fill)

    def _made(self, place: QRectF, fill: Callable[[QPainter], None]) -> _Sheet | None:
        if place.isEmpty():
            return None
        # On whole pixels of the screen it is as sharp as what is painted there.
        left, top = (np.floor(each * self.ratio) / self.ratio for each in (place.left(), place.top()))
        sheet = _Sheet(
            transparent(place.right() - left, place.bottom() - top, self.ratio), QPointF(left, top)
        )
        with QPainter(sheet.picture) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
            painter.translate(-left, -top)
            fill(painter)
        return sheet

    def _paint_parts(self, painter: QPainter, parts: Sequence[Shape], depth: int) -> None:
        for part in parts:
            inner = part[0].source.group_looks[depth : depth + 1]
            if not inner:
                self.owner.painted += 1
                self.paint(painter, part)
            elif (sheet := self.sheet(_parts(part, depth + 1), depth + 1)) is not None:
                painter.save()
                painter.setOpacity(painter.opacity() * inner[0].opacity)
                sheet.draw(painter)
                painter.restore()

    def _place_of(self, parts: Sequence[Shape]) -> QRectF:
        """Return the pixels that parts may reach, of those that are seen."""
        area, place = QRectF(0, 0, self.shown.width, self.shown.height), QRectF()
        for shape in (shape for part in parts for shape in _shapes(part)):
            style = shape[0].source.style
            width = self.usual / self.shown.sx if style.width is None else style.width
            (left, low), (right, high) = _box(shape, style, width).tolist()
            corner, other = self.shown.point(left, high), self.shown.point(right, low)
            box = QRectF(QPointF(*corner), QPointF(*other)).adjusted(-1, -1, 1, 1)
            place = place.united(box.intersected(area))
        return place


def drawn_together(views: Sequence[CurveView]) -> list[range]:
    """Return the places of what is painted as one: shapes, and clear outermost groups."""
    curves = [view.source for view in views]
    found = list(shapes(curves))
    if not any(map(_group_looks, curves)):
        return found
    units = list[range]()
    for look, run in together(found, lambda places: curves[places.start].group_looks):
        units += run if look is None else [range(run[0].start, run[-1].stop)]
    return units


def _parts(views: Sequence[CurveView], depth: int) -> list[Shape]:
    """Return what is in so many groups: shapes, and groups that are seen through."""
    parts = list[Shape]()
    for look, run in together(_shapes(views), lambda shape: shape[0].source.group_looks, depth):
        parts += run if look is None else [tuple(view for shape in run for view in shape)]
    return parts


def _shapes(views: Sequence[CurveView]) -> list[Shape]:
    runs = ((name, tuple(run)) for name, run in groupby(views, lambda view: view.source.shape))
    return [each for name, run in runs for each in ([run] if name else [(view,) for view in run])]


def _box(shape: Shape, style: Style, width: float) -> FloatArray:
    """Return a box in the plane, [[left, low], [right, high]], that a shape does not leave."""
    corners = np.vstack([view.drawn_box for view in shape if view.has_curve])
    reach = width * max(1.0, style.miter_limit) if style.has_stroke else 0.0
    return np.array([corners.min(axis=0) - reach, corners.max(axis=0) + reach])


def _is_same(one: Shape, other: Shape) -> bool:
    return len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True))
