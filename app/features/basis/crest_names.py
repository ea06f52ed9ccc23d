"""The number of each basis function at its crest: colours alone are alike to some eyes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QSizeF, QTimer
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPixmap

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...appearance.colours import point_colours
from ...appearance.theme import Theme
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...plotting.text import with_halo
from ...view_model.basis import BasisView

MOST = 24
"""Functions that are named, of all kinds together; among more, a number would stand on other lines."""

_GAP = 1.0
"""Pixels between a crest and its number."""

_RIM = 2.0
"""Pixels of paper around a number."""

_HELD_MS = 200
"""Time that a number keeps its side of a crest that moves."""


class Crest(NamedTuple):
    """Greatest value of a function; that of a point on the curve is named at its t_i, where others are 0."""

    owner: int
    kind: int
    t: float
    value: float


def crests_of(basis: BasisView, kinds: list[int]) -> list[Crest]:
    """Return the crests of the functions of these kinds; that of a derivative lies ahead of its knot."""
    knots, last = basis.curve.parameters.tolist(), basis.count - 1
    found = _crests_of_points(basis) if 0 in kinds else []
    for kind in kinds:
        if kind == 0:
            continue
        for knot, t_knot in enumerate(knots):
            t, values = basis.function(knot, kind)
            sizes = np.abs(values) if knot == last else np.where(t >= t_knot, np.abs(values), 0.0)
            top = int(np.argmax(sizes))
            found.append(Crest(basis.owners[knot], kind, float(t[top]), float(values[top])))
    return found


def _crests_of_points(basis: BasisView) -> list[Crest]:
    """Return the crests of the position functions: 1 at their parameters; of control points as found."""
    if basis.curve.interpolates:
        tops = [(t, 1.0) for t in basis.curve.parameters.tolist()]
    elif basis.first is None:
        places = basis.values[:, :, 0].argmax(axis=0)
        highest = basis.values[places, np.arange(basis.count), 0]
        tops = list(zip(basis.t[places].tolist(), highest.tolist(), strict=True))
    else:
        functions = [basis.function(knot, 0) for knot in range(basis.count)]
        tops = [(float(t[values.argmax()]), float(values.max())) for t, values in functions]
    return [Crest(owner, 0, *top) for owner, top in zip(basis.owners, tops, strict=True)]


class Room(NamedTuple):
    """Room for numbers at crests; below `floor`, in pixels, there is none."""

    shown: PixelMap
    basis: BasisView
    kinds: list[int]
    floor: float
    scale: float


def room_above(font: QFont, scale: float) -> float:
    """Return how much height in pixels a number above its crest takes."""
    return _size_of_number(font, scale).height() + _GAP


def _size_of_number(font: QFont, scale: float) -> QSizeF:
    """Return the size of a number of two digits with its halo of paper."""
    metrics, rim = QFontMetricsF(font), _RIM * scale
    # Even numbers of pixels: their middles are whole, and letters are sharp.
    width, height = metrics.horizontalAdvance("00") + 2 * rim, metrics.ascent() + 2 * rim
    return QSizeF(2 * math.ceil(width / 2), 2 * math.ceil(height / 2))


class CrestNames:
    """Writes the numbers.

    Parameters
    ----------
    plot
        Where they are written.
    again
        Has them written once more, when functions that changed have come to rest.
    """

    def __init__(self, plot: PlotWidget, again: Callable[[], None]) -> None:
        # By point and colour: with more points or fewer, one may have another colour.
        self._pictures: dict[tuple[int, int], QPixmap] = {}
        self._made_of: tuple[object, ...] = ()
        self._measured: tuple[object, ...] = ()
        self._cell = QSizeF()
        self._written = np.empty((0, 2))
        self._crests_of: tuple[BasisView, list[int]] | None = None
        self._owners, self._places = np.empty(0, dtype=np.intp), np.empty((0, 2))
        # On which side of their crests the numbers stand, in pixels, and which of them there are.
        self._asides, self._is_clear = np.empty((0, 2)), np.empty(0, dtype=np.bool_)
        self._asked: tuple[object, ...] = ()
        self._made_for: BasisView | None = None
        self._soon = QTimer(plot, singleShot=True, interval=_HELD_MS)
        self._soon.timeout.connect(self._choose_again)
        self._again = again

    def paint(
        self,
        painter: QPainter,
        shown: PixelMap,
        basis: BasisView,
        kinds: list[int],
        theme: Theme,
        scale: float,
    ) -> None:
        """Write a number at each crest, as far as they do not meet and no function crosses them."""
        if basis.count * len(kinds) > MOST:
            return
        self._find_crests(basis, kinds)
        self._measure(painter, scale)
        crests = np.column_stack([shown.x(self._places[:, 0]), shown.y(self._places[:, 1])])
        self._choose_sides(crests, Room(shown, basis, kinds, painter.clipBoundingRect().bottom(), scale))
        places, clear = crests + self._asides, np.flatnonzero(self._is_clear)
        kept = clear[apart(places[clear], self._cell)]
        self._written = np.round(places[kept])
        self._write(painter, self._owners[kept].tolist(), basis.point_count, theme, scale)

    def _write(self, painter: QPainter, owners: list[int], count: int, theme: Theme, scale: float) -> None:
        """Write the numbers of points of `count` where they were found to have room."""
        made_of = (self._measured, theme, painter.device().devicePixelRatioF())
        if made_of != self._made_of:
            self._made_of = made_of
            self._pictures.clear()
        left, top = self._cell.width() / 2, self._cell.height() / 2
        inks, rim = point_colours(count, theme), _RIM * scale
        for owner, (x, y) in zip(owners, self._written.tolist(), strict=True):
            ink = inks[owner]
            if (name := (owner, ink.rgba())) not in self._pictures:
                self._pictures[name] = with_halo(painter, self._cell, str(owner), theme.paper, ink, rim)
            # On whole pixels, where letters are sharp.
            painter.drawPixmap(int(x - left), int(y - top), self._pictures[name])

    def _find_crests(self, basis: BasisView, kinds: list[int]) -> None:
        known = self._crests_of
        if known is None or known[0] is not basis or known[1] != kinds:
            crests, self._crests_of = crests_of(basis, kinds), (basis, kinds)
            self._owners = np.array([each.owner for each in crests], dtype=np.intp)
            self._places = np.array([(each.t, each.value) for each in crests])

    def _choose_sides(self, crests: FloatArray, room: Room) -> None:
        """Choose on which side of its crest each number stands; while functions move it keeps it."""
        asked = (room.basis.count, tuple(room.kinds), room.shown, room.floor, room.scale)
        if asked == self._asked and self._soon.isActive():
            return
        if room.basis is not self._made_for:
            self._soon.start()
        self._asked, self._made_for = asked, room.basis
        places, self._is_clear = self._boxes(crests, room)
        self._asides = places - crests

    def _choose_again(self) -> None:
        """Write once more, unless the sides were chosen for the functions that were drawn last."""
        if self._crests_of is not None and self._crests_of[0] is not self._made_for:
            self._again()

    def _boxes(self, crests: FloatArray, room: Room) -> tuple[FloatArray, BoolArray]:
        """Return the middles of the numbers in pixels, and for which of them there is one.

        Beyond the crest, where no function crosses the number; else on its other side, or a little aside.
        """
        shown, basis, kinds, floor, scale = room
        x, y = crests.T
        width, height = self._cell.width(), self._cell.height()
        half = height / 2
        above, below = y - half - _GAP, y + half + _GAP
        is_below = np.where(self._places[:, 1] < 0, below + half <= floor, above < half)
        beyond, inside = np.where(is_below, below, above), np.where(is_below, above, below)
        aside, rim = width / 2 + _GAP, 2 * _RIM * scale
        lines = Lines(shown, basis, kinds, (width - rim, height - rim))
        places = np.column_stack([x, beyond])
        is_clear = lines.leave_free(places)
        for by, other in (
            (0.0, inside),
            (-aside, beyond),
            (aside, beyond),
            (-aside, inside),
            (aside, inside),
        ):
            tried = np.column_stack([x + by, other])
            fits = (other >= half) & (other + half <= floor) & (x + by >= 0) & (x + by <= shown.width)
            better = np.flatnonzero(~is_clear & fits)
            better = better[lines.leave_free(tried[better])]
            places[better], is_clear[better] = tried[better], True
        return places, is_clear

    def _measure(self, painter: QPainter, scale: float) -> None:
        """Find out how much room a number takes, with its halo of paper."""
        measured = (painter.font().key(), scale)
        if measured != self._measured:
            self._measured = measured
            self._cell = _size_of_number(painter.font(), scale)


class Lines:
    """The functions and the line of zero in pixels, as far as it takes to see whether they cross a number.

    Parameters
    ----------
    size
        Width and height of a number.
    """

    def __init__(
        self, shown: PixelMap, basis: BasisView, kinds: list[int], size: tuple[float, float]
    ) -> None:
        self._half = np.array(size) / 2
        self._x = shown.x(basis.t)
        values = basis.values[:, :, kinds].reshape(len(basis.t), -1)
        y = shown.y(np.column_stack([values, np.zeros(len(values))]))
        self._top, self._bottom = np.minimum(y[:-1], y[1:]), np.maximum(y[:-1], y[1:])
        if basis.first is not None:
            # Where one segment ends and the next begins a column changes from one knot to another.
            self._top[basis.first[1:-1] - 1] = np.inf

    def leave_free(self, places: FloatArray) -> BoolArray:
        """Return around which places (k, 2) nothing crosses a number."""
        across, up = self._half
        starts = (np.searchsorted(self._x, places[:, 0] - across) - 1).clip(0)
        ends = np.searchsorted(self._x, places[:, 0] + across)
        result = np.ones(len(places), dtype=np.bool_)
        for k, (start, end) in enumerate(zip(starts.tolist(), ends.tolist(), strict=True)):
            low, high = places[k, 1] - up, places[k, 1] + up
            result[k] = not ((self._top[start:end] < high) & (self._bottom[start:end] > low)).any()
        return result


def apart(places: FloatArray, cell: QSizeF) -> IntArray:
    """Return which numbers can be written without meeting one that is written already."""
    order = np.argsort(places[:, 0], kind="stable")
    if (np.diff(places[order, 0]) >= cell.width()).all():
        return order
    kept: list[int] = []
    for index in order.tolist():
        near = [k for k in kept if abs(places[k, 0] - places[index, 0]) < cell.width()]
        if all(abs(places[k, 1] - places[index, 1]) >= cell.height() for k in near):
            kept.append(index)
    return np.array(kept, dtype=np.intp)
