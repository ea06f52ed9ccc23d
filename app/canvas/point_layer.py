"""Points, their handles, their numbers, and their weights at the scrub line."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import is_
from typing import NamedTuple

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ..appearance.colours import point_colours
from ..document.words import short, with_decimals
from ..plotting.drawing import is_near
from ..plotting.layers import Layer
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import Mark
from ..plotting.text import OccupiedRoom, inside, number_position, write_in_corner
from ..tasks.task import DelayedCall
from ..view_model.curve.curve_view import CurveView
from ..view_model.curve.handles import Handles
from ..view_model.point_kinds import kinds_of
from .handle_marks import VisibleHandles
from .point_marks import (
    RADIUS,
    Discs,
    InkCache,
    PointLook,
    PointStamps,
    TextGlyphs,
    discs_for,
    with_neighbours,
)

_LABELLED_UP_TO = 12
_DISCS_MS = 200
"""Milliseconds for which discs keep their size during a drag."""

_HALF_DIGITS = 6.0
"""Half the width of the number of a point in pixels; a weight beside it makes the label longer."""

_MARGIN = 60.0
"""Pixels beyond the area within which points are drawn."""

_FEW_MOVED = 8
"""Number of moving points up to which each is converted to pixels by itself."""

_LARGE = 100.0
"""Size of a weight from which decimals are omitted."""

_WEIGHED_UP_TO = 24
"""Number of points up to which all weights are written; of more, only the largest."""
_LEAST_WEIGHT = 5e-3
_HIDDEN = 0.35
"""Opacity of the points of a hidden curve while it is edited."""


class _Roles(msgspec.Struct, frozen=True):
    """Indices of visible points by their look: at rest, hovered, selected; and those with numbers."""

    calm: IntArray
    hovered: list[int]
    selected: list[int]
    numbered: list[int]


class _NumberLabel(NamedTuple):
    text: str
    colour: QColor
    centre: QPointF
    glyphs: TextGlyphs
    is_weighed: bool


class PointLayer(Layer):
    """Layer of the points of the active curve, each with the mark of its kind."""

    z = 10.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._plot = plot
        self.selection: frozenset[int] = frozenset()
        self.visible_handles = VisibleHandles()
        self.hovered = -1
        # While points are added, the handle under the pointer is that of the new point, ahead of the end.
        self.shows_new_handle = False
        # Over a picture, thin grey lines need paper around them to be visible.
        self.over_picture = False
        # Without numbers and colours of their own.
        self.is_plain = False
        self.weights: FloatArray | None = None
        self.scrub: tuple[float, float, float] | None = None
        self._view: CurveView | None = None
        self._stamps = PointStamps()
        # The kinds of the points, and the arrays that they depend on.
        self._kinds: IntArray = np.empty(0, dtype=np.intp)
        self._kinds_key: tuple[object, ...] = ()
        self._discs = Discs(RADIUS, 0.0)
        self._discs_key: tuple[object, ...] = ()
        # Centres of the numbers written last, in pixels, and their lengths in characters.
        self.numbers: list[tuple[QPointF, int]] = []
        self._measured_pixels: FloatArray | None = None
        # Repaints after a drag, with discs as large as there is room for then.
        self._soon = DelayedCall(plot, _DISCS_MS, self._measure_again)
        self._inks = InkCache()
        self._roles_key: tuple[object, ...] = ()
        self._pixels_of: tuple[CurveView | None, PixelMap | None] = (None, None)
        self._pixels: FloatArray = np.empty((0, 2))
        self._visible: IntArray = np.empty(0, dtype=np.intp)

    def render(self, view: CurveView) -> None:
        """Draw `view` from the next paint on."""
        self._view = view
        self.set_opacity(opacity_of(view))
        self.refresh()

    @property
    def handles(self) -> Handles:
        """The visible handles of the selected points."""
        return self.visible_handles.of_selected(self._plot.pixel_map)

    def refresh(self) -> None:
        """Update handles and repaint after an attribute was set."""
        if self._view is not None:
            self.visible_handles.find(self._view, self.selection, free=self.shows_new_handle)
        self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw weights, handles, points and numbers."""
        view = self._view
        if view is None or not len(view.points):
            return
        colours = point_colours(len(view.points), self.theme)
        self._locate(view, pixel_map)
        self._ink = self._inks.of(self.theme, self.scale, self.fonts, over_picture=self.over_picture)
        self._update_kinds(view)
        pixels, visible = self._pixels, self._visible
        if self.weights is not None and len(self.weights) == len(pixels):
            self._paint_weights(painter, pixels, visible, colours)
        discs = self._current_discs(pixels, visible)
        # Beside small points, handles of the usual size would hide the neighbours.
        self.visible_handles.paint(painter, pixel_map, self._ink, discs.radius / (RADIUS * self.scale))
        self._paint_points(painter, discs, colours)
        self._paint_numbers(painter, pixels, pixel_map)
        if self.scrub is not None:
            self._paint_scrub_dot(painter, pixel_map)

    def _update_kinds(self, view: CurveView) -> None:
        """Update the kinds of the points where their arrays or parameters have changed."""
        source, arrays, t = view.source, view.arrays, view.parameters
        key = (source.family, source.is_closed, t, arrays.corners, arrays.ties, arrays.evens, arrays.given)
        if len(key) == len(self._kinds_key) and all(map(is_, key, self._kinds_key)):
            return
        self._kinds_key, kinds = key, kinds_of(view)
        if not np.array_equal(kinds, self._kinds):
            self._kinds = kinds

    def _locate(self, view: CurveView, pixel_map: PixelMap) -> None:
        """Compute the pixels of all points, and the indices of those on the screen."""
        before, map_before = self._pixels_of
        if before is view and map_before is pixel_map:
            return
        self._pixels_of = (view, pixel_map)
        if before is not None and map_before is pixel_map and self._shift(before, view, pixel_map):
            return
        self._pixels = pixel_map.points(view.points)
        visible = np.flatnonzero(pixel_map.near(self._pixels, _MARGIN))
        if not np.array_equal(visible, self._visible):
            self._visible = visible

    def _shift(self, before: CurveView, view: CurveView, pixel_map: PixelMap) -> bool:
        """Compute the pixels of moved points only; return whether nothing else has changed."""
        now, then = view.displacement, before.displacement
        if now is None or then is None or then.moving is not now.moving:
            return False
        rows = now.moving.rows
        if len(rows) > _FEW_MOVED:
            return False
        stays, self._pixels = True, self._pixels.copy()
        for row in rows:
            point, (x, y) = view.source.points[row], self._pixels[row].tolist()
            pixel = pixel_map.point(point.x, point.y)
            stays = stays and _is_near_pixel(x, y, pixel_map) == _is_near_pixel(*pixel, pixel_map)
            self._pixels[row] = pixel
        return stays

    # Points

    def _paint_points(self, painter: QPainter, discs: Discs, colours: Sequence[QColor]) -> None:
        pixels, visible = self._pixels, self._visible
        roles = self._current_roles(len(pixels), visible, crowded=discs.crowded)
        kinds, is_plain = self._kinds, self.is_plain
        self._stamps.draw(painter, pixels, roles.calm, kinds, self.theme, discs, is_plain=is_plain)
        marks: list[Mark[PointLook]] = []
        for is_selected, indices in ((False, roles.hovered), (True, roles.selected)):
            for index in indices:
                x, y = pixels[index].tolist()
                colour = None if is_plain else colours[index].rgba()
                marks.append((PointLook(colour, int(kinds[index]), is_selected), x, y))
        self._ink.points.draw(painter, marks)
        if self.note:
            painter.setFont(self.fonts.times(0.9 * self.scale))
            write_in_corner(painter, self.note, self.theme.paper, self.theme.muted)

    def _current_roles(self, count: int, visible: IntArray, *, crowded: bool) -> _Roles:
        """Return the roles of the visible points; they stay during a drag."""
        # By identity: changed weights and changed visible indices are new arrays.
        arrays = id(visible), id(self.weights)
        key = (self.selection, self.hovered, count, crowded, *arrays, self.is_plain)
        if key != self._roles_key:
            self._roles_key = key
            # Held, so that no new array gets the same id.
            self._roles_arrays = (visible, self.weights)
            self._roles = self._compute_roles(count, visible, crowded=crowded)
        return self._roles

    def _compute_roles(self, count: int, visible: IntArray, *, crowded: bool) -> _Roles:
        selected = [index for index in self.selection if index < count]
        is_calm = np.ones(count, dtype=bool)
        is_calm[selected] = False
        calm = visible[is_calm[visible]]
        hovered = calm[calm == self.hovered].tolist()
        if crowded:
            calm = with_neighbours([*selected, *hovered], calm)
        numbered = self._numbered(count, visible)
        return _Roles(calm, hovered, visible[~is_calm[visible]].tolist(), numbered)

    def _current_discs(self, pixels: FloatArray, visible: IntArray) -> Discs:
        """Return the size of the discs, computed once every `_DISCS_MS` during a drag."""
        key = (self._pixels_of[1], len(pixels), len(visible), self.scale)
        if key == self._discs_key and self._soon.isActive():
            return self._discs
        if pixels is not self._measured_pixels:
            self._soon.start()
        self._discs_key, self._measured_pixels = key, pixels
        self._discs = discs_for(pixels, visible, self.scale)
        return self._discs

    def _measure_again(self) -> None:
        """Repaint if the room for discs has changed since they were measured."""
        if self._pixels is self._measured_pixels:
            return
        if discs_for(self._pixels, self._visible, self.scale) != self._discs:
            self.refresh()

    @property
    def note(self) -> str:
        """The note about hidden points or handles; empty where all are drawn."""
        if self._view is None:
            return ""
        if self._discs.crowded:
            return f"{len(self._view.points)} points: selection only · zoom in to see all"
        return self.visible_handles.note(self._plot.pixel_map)

    # Numbers

    def _paint_numbers(self, painter: QPainter, pixels: FloatArray, pixel_map: PixelMap) -> None:
        self.numbers = []
        numbered = self._roles.numbered
        if not numbered:
            return
        on_plates = self.over_picture or (self._view is not None and self._view.source.style.has_fill)
        for label in self._labels(painter, pixels, numbered, pixel_map):
            self.numbers.append((label.centre, len(label.text)))
            if label.is_weighed:
                # Weights change in every frame: a halo for each would take too long.
                if on_plates:
                    self._paint_plate(painter, label.centre, label.text)
                painter.setPen(label.colour)
                label.glyphs.draw(painter, label.centre)
            else:
                self._paint_number(painter, label)

    def _paint_number(self, painter: QPainter, label: _NumberLabel) -> None:
        picture = self._ink.number(label.text, label.colour, painter)
        half = picture.deviceIndependentSize() / 2
        # On whole pixels, where digits are sharp.
        corner = QPointF(round(label.centre.x() - half.width()), round(label.centre.y() - half.height()))
        painter.drawPixmap(corner, picture)

    def _labels(
        self, painter: QPainter, pixels: FloatArray, indices: Sequence[int], pixel_map: PixelMap
    ) -> Iterator[_NumberLabel]:
        """Yield the labels of points, number and weight; labels that would cover others are omitted."""
        with_weight = None if self.weights is None else self._has_weight_text(len(pixels))
        half, occupied = _HALF_DIGITS * self.scale, OccupiedRoom()
        if self.weights is not None and len(self.weights) == len(pixels):
            # Selected and hovered points first, then by size: the smallest weights are omitted.
            sizes, preferred = np.abs(self.weights), {*self.selection, self.hovered}
            indices = sorted(indices, key=lambda index: (index not in preferred, -sizes[index]))
        for index in indices:
            text, colour, away = str(index), self.theme.muted, 17 * self.scale
            is_weighed = with_weight is not None and bool(with_weight[index])
            if is_weighed and self.weights is not None:
                weight = float(self.weights[index])
                text += f"  {short(weight) if abs(weight) >= _LARGE else with_decimals(weight, 2)}"
                colour = self.theme.warning if weight < 0 else self.theme.ink
                # Beyond the disc, so that neither covers the curve.
                away = max(away, self._weight_radius(weight) + 14 * self.scale)
            glyphs = self._ink.glyphs_of(text, painter)
            size = glyphs.size
            beyond = max(size.width() / 2 - half, 0.0)
            centre: QPointF | None = number_position(pixels, index, away, beyond)
            if self.weights is not None and centre is not None:
                further = number_position(pixels, index, away + size.height(), beyond)
                aside = QPointF(size.width(), 0.0)
                places = [centre, further, centre - aside, centre + aside]
                if pixel_map.near(pixels[[index]]).all():
                    # A label that is cut off at the edge would be another number.
                    corners = [place - QPointF(size.width(), size.height()) / 2 for place in places]
                    room = QSizeF(size)
                    places = [inside(at.x(), at.y(), room, pixel_map).center() for at in corners]
                centre = occupied.reserve(places, QSizeF(size))
            if centre is not None:
                yield _NumberLabel(text, colour, centre, glyphs, is_weighed)

    def _numbered(self, count: int, visible: IntArray) -> list[int]:
        """Return the indices of the points with numbers: too many would cover each other."""
        numbered = visible
        if count > _LABELLED_UP_TO or self.is_plain:
            named = () if self.is_plain else (*self.selection, self.hovered)
            named = named if len(self.selection) <= _LABELLED_UP_TO else named[-1:]
            is_wanted = self._has_weight_text(count)
            is_wanted[[index for index in named if 0 <= index < count]] = True
            numbered = visible[is_wanted[visible]]
        result: list[int] = numbered.tolist()
        return result

    def _paint_plate(self, painter: QPainter, centre: QPointF, text: str) -> None:
        """Draw a plate of paper below a number."""
        paper, size = QColor(self.theme.paper), self._ink.glyphs_of(text, painter).size
        paper.setAlphaF(0.75)
        plate = QRectF(0, 0, size.width() + 6, size.height() + 2)
        plate.moveCenter(centre)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(paper)
        painter.drawRoundedRect(plate, 3, 3)

    def _has_weight_text(self, count: int) -> BoolArray:
        """Return which points have their weight written beside them."""
        if self.weights is None or len(self.weights) != count:
            return np.zeros(count, dtype=bool)
        sizes, minimum = np.abs(self.weights), _LEAST_WEIGHT
        if count > _WEIGHED_UP_TO:
            minimum = max(minimum, float(np.partition(sizes, -_LABELLED_UP_TO)[-_LABELLED_UP_TO]))
        return sizes >= minimum

    # Weights

    def _paint_weights(
        self,
        painter: QPainter,
        pixels: FloatArray,
        visible: IntArray,
        colours: Sequence[QColor],
    ) -> None:
        assert self.weights is not None
        values = self.weights.tolist()
        for index in visible.tolist():
            radius = self._weight_radius(values[index])
            if radius >= 1:
                centre = QPointF(*pixels[index])
                self._paint_weight_disc(painter, centre, radius, colours[index], negative=values[index] < 0)

    def _weight_radius(self, weight: float) -> float:
        """Return the radius of the disc whose area shows a weight, scaled by the largest one beyond 1."""
        assert self.weights is not None
        largest = max(float(np.abs(self.weights).max()), 1.0)
        return 30 * self.scale * float(np.sqrt(abs(weight) / largest))

    def _paint_weight_disc(
        self, painter: QPainter, centre: QPointF, radius: float, colour: QColor, *, negative: bool
    ) -> None:
        ring = QPen(self.theme.warning if negative else colour, 1.5 * self.scale)
        ring.setStyle(Qt.PenStyle.DashLine if negative else Qt.PenStyle.SolidLine)
        fill = QColor(self.theme.warning if negative else colour)
        fill.setAlphaF(0.22)
        painter.setPen(ring)
        painter.setBrush(fill)
        painter.drawEllipse(centre, radius, radius)

    def _paint_scrub_dot(self, painter: QPainter, pixel_map: PixelMap) -> None:
        assert self.scrub is not None
        pixel = pixel_map.point(*self.scrub[1:])
        if not is_near(*pixel):
            return
        painter.setPen(QPen(self.theme.paper, 2 * self.scale))
        painter.setBrush(self.theme.accent)
        painter.drawEllipse(QPointF(*pixel), 6.5 * self.scale, 6.5 * self.scale)


def opacity_of(view: CurveView) -> float:
    """Return the opacity of the points of a curve: less than 1 where the curve is hidden."""
    return 1.0 if view.source.visible else _HIDDEN


def _is_near_pixel(x: float, y: float, pixel_map: PixelMap) -> bool:
    return -_MARGIN < x < pixel_map.width + _MARGIN and -_MARGIN < y < pixel_map.height + _MARGIN
