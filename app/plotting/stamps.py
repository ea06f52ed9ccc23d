"""Pictures painted once and copied: sheets, marks of any looks, and many marks in colours of points."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from typing import Generic, TypeAlias, TypeVar

import msgspec
import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from curvecore.arrays import FloatArray, IntArray

from ..appearance.colours import point_colours
from ..appearance.theme import Theme
from .drawing import Fragments
from .pixel_map import PixelMap


def transparent(width: float, height: float, ratio: float) -> QPixmap:
    """Return an empty picture of a size in pixels of a plot, with `ratio` device pixels to each."""
    picture = QPixmap(math.ceil(width * ratio), math.ceil(height * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture


class Sheets(msgspec.Struct, frozen=True, eq=False):
    """Pictures painted for one part of the plane.

    Attributes
    ----------
    sheets
        From bottom to top; there are several where moving shapes are painted between them.
    pixel_map
        The map of the part of the plane.
    key
        All else that the pictures depend on: the theme, the size of lines.
    """

    sheets: tuple[QPixmap, ...]
    pixel_map: PixelMap
    key: tuple[object, ...]

    def draw(self, painter: QPainter, pixel_map: PixelMap, sheet: QPixmap) -> None:
        """Draw a sheet, moved and scaled to the part of the plane that is visible."""
        if pixel_map is self.pixel_map or pixel_map == self.pixel_map:
            painter.drawPixmap(0, 0, sheet)
            return
        rect = self.rect_in(pixel_map)
        if (pixel_map.sx, pixel_map.sy) == (self.pixel_map.sx, self.pixel_map.sy):
            # On whole device pixels, where the copy is sharp and fast.
            ratio = sheet.devicePixelRatio()
            corner = QPointF(round(rect.x() * ratio) / ratio, round(rect.y() * ratio) / ratio)
            painter.drawPixmap(corner, sheet)
        else:
            painter.drawPixmap(rect, sheet, QRectF(sheet.rect()))

    def rect_in(self, pixel_map: PixelMap) -> QRectF:
        """Return the rectangle of the sheets when another part of the plane is visible."""
        old = self.pixel_map
        x, y = pixel_map.point(old.x0, old.y0)
        return QRectF(x, y, old.width * pixel_map.sx / old.sx, old.height * pixel_map.sy / old.sy)


_SHIFTS = 4
"""Positions within a pixel, along x and y, for which a mark is cached: the eye cannot tell it from an exact
one."""

_CELLS_OF_LOOK = _SHIFTS * _SHIFTS

_MOST_LOOKS = 32
"""Largest number of cached looks; with one more, the sheet begins anew."""

Look = TypeVar("Look", bound=Hashable)

Mark: TypeAlias = tuple[Look, float, float]
"""A look, and the pixels x and y of its centre."""


class Sprites(Generic[Look]):
    """Marks of any looks, each painted once and then copied.

    Parameters
    ----------
    paint
        Draws the mark of a look around (0, 0).
    reach
        Largest reach of a mark in pixels.
    """

    def __init__(self, paint: Callable[[QPainter, Look], None], reach: float) -> None:
        self._paint, self._reach = paint, reach
        self._fragments = Fragments()
        self._sheet = QPixmap()
        self._ratio, self._side = 0.0, 0
        # The row of each look on the sheet.
        self._rows: dict[Look, int] = {}

    def draw(self, painter: QPainter, marks: Iterable[Mark[Look]]) -> None:
        """Draw marks."""
        ratio = painter.device().devicePixelRatioF()
        if ratio != self._ratio:
            self._ratio, self._side = ratio, 2 * math.ceil(self._reach * ratio) + 4
            self._rows = {}
        side, finer, fragments = self._side, ratio * _SHIFTS, []
        for look, x, y in marks:
            row = self._rows.get(look)
            if row is None:
                row = self._add(look)
            left, across = divmod(math.floor(x * finer + 0.5), _SHIFTS)
            top, down = divmod(math.floor(y * finer + 0.5), _SHIFTS)
            cell = (down * _SHIFTS + across) * side
            fragments.append(
                (left / ratio, top / ratio, cell, row * side, side, side, 1 / ratio, 1 / ratio, 0, 1)
            )
        if fragments:
            self._fragments.room_for(len(fragments))[:] = fragments
            self._fragments.draw(painter, self._sheet)

    def _add(self, look: Look) -> int:
        """Draw a look on the sheet, at each position within a pixel; return its row."""
        if not self._rows or len(self._rows) == _MOST_LOOKS:
            self._rows = {}
            self._sheet = QPixmap(_CELLS_OF_LOOK * self._side, _MOST_LOOKS * self._side)
            self._sheet.fill(Qt.GlobalColor.transparent)
        row = self._rows[look] = len(self._rows)
        with QPainter(self._sheet) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for cell in range(_CELLS_OF_LOOK):
                down, across = divmod(cell, _SHIFTS)
                corner = QPointF((cell + 0.5) * self._side, (row + 0.5) * self._side)
                painter.save()
                painter.translate(corner + QPointF(across, down) / _SHIFTS)
                painter.scale(self._ratio, self._ratio)
                self._paint(painter, look)
                painter.restore()
        return row


_COLOURS = 256
"""Largest number of colours; with more points, neighbours on the ramp share one."""

_COLUMNS = 16

_FEW_LOOKS, _FINE_SHIFTS = 64, 4
"""Number of looks up to which marks are cached at so many positions within a pixel, along x and y; more looks
are drawn on whole pixels. A sheet grows up to as many looks."""


class Stamps:
    """Marks in the colours of the points.

    Parameters
    ----------
    shape
        Draws one mark of a given radius and form around (0, 0), with the painter's pen and brush.
    reach
        Reach of a mark of radius 1.
    """

    def __init__(self, shape: Callable[[QPainter, float, int], None], reach: float = 1.0) -> None:
        self._shape, self._reach = shape, reach
        self._forms = np.empty(0, dtype=np.intp)
        # The cells of the sheet by colour and form, and the cell of each point.
        self._looks: dict[tuple[int, int], int] = {}
        self._look_of = np.empty(0, dtype=np.intp)
        self._looks_key: tuple[object, ...] = ()
        # The sheet: all that it depends on, the size of a cell, the positions within a pixel.
        self._sheet = QPixmap()
        self._sheet_key: tuple[object, ...] = ()
        self._cell, self._finer = 0, 1
        self._fragments = Fragments()
        # The pixels and indices of the fragments: during a drag most points stay where they are.
        self._pixels, self._indices = np.empty((0, 2)), np.empty(0, dtype=np.intp)

    def draw(
        self,
        painter: QPainter,
        pixels: FloatArray,
        indices: IntArray,
        count: int,
        theme: Theme,
        radius: float,
        rim: float,
        forms: IntArray | None = None,
    ) -> None:
        """Draw the marks of points `indices` of `count` at `pixels` (k, 2), with rims of paper.

        `forms` (count,) are the forms of the points; unchanged forms should be the same array.
        """
        ratio = painter.device().devicePixelRatioF()
        is_new = self._prepare(count, theme, radius, rim, ratio, forms)
        if is_new or not (
            (indices is self._indices or np.array_equal(indices, self._indices))
            and pixels.tobytes() == self._pixels.tobytes()
        ):
            self._pixels, self._indices = pixels, indices
            self._fill(pixels, indices, ratio)
        self._fragments.draw(painter, self._sheet)

    def _fill(self, pixels: FloatArray, indices: IntArray, ratio: float) -> None:
        finer = self._finer
        steps = np.floor(pixels * (ratio * finer) + 0.5).astype(np.intp)
        pixel, within = np.divmod(steps, finer)
        cells = (self._look_of[indices] * finer + within[:, 1]) * finer + within[:, 0]
        data = self._fragments.room_for(len(indices))
        data[:, :2] = pixel / ratio
        data[:, 2] = cells % _COLUMNS * self._cell
        data[:, 3] = cells // _COLUMNS * self._cell
        data[:, 4:6] = self._cell
        data[:, 6:8] = 1.0 / ratio
        data[:, 8] = 0.0
        data[:, 9] = 1.0

    def _prepare(
        self, count: int, theme: Theme, radius: float, rim: float, ratio: float, forms: IntArray | None
    ) -> bool:
        """Prepare the sheet of the marks; return whether a look has changed."""
        if forms is None:
            forms = self._forms if len(self._forms) == count else np.zeros(count, dtype=np.intp)
        key = (count, theme, radius, rim, ratio)
        if key == self._looks_key and (forms is self._forms or np.array_equal(forms, self._forms)):
            return False
        self._looks_key, self._forms = key, forms
        # Each pair of colour and form once: most points differ in colour only.
        form_count = int(forms.max(initial=0)) + 1
        cells, points = np.unique(cells_of(np.arange(count), count) * form_count + forms, return_inverse=True)
        colours = self._colours(min(count, _COLOURS), theme)
        looks = [
            (colours[colour], form) for colour, form in (divmod(cell, form_count) for cell in cells.tolist())
        ]
        self._look_of = np.array(self._cells_for(looks, theme, radius, rim, ratio), dtype=np.intp)[points]
        return True

    def _cells_for(
        self, looks: Sequence[tuple[QColor, int]], theme: Theme, radius: float, rim: float, ratio: float
    ) -> list[int]:
        """Return the cells of looks on the sheet; missing looks are drawn."""
        sheet_key = (theme, radius, rim, ratio, len(looks) > _FEW_LOOKS)
        colours = {(colour.rgba(), form): colour for colour, form in looks}
        count = len(self._looks.keys() | colours.keys())
        if sheet_key != self._sheet_key or count > max(_FEW_LOOKS, len(self._looks)):
            self._sheet_key, self._looks = sheet_key, {}
            self._finer = 1 if len(looks) > _FEW_LOOKS else _FINE_SHIFTS
            # Even, so that whole pixels lie on whole pixels.
            self._cell = 2 * math.ceil((radius * self._reach + rim) * ratio) + 4
        new = {look: colour for look, colour in colours.items() if look not in self._looks}
        if new:
            pen = QPen(self._rim(theme), rim * ratio) if rim else QPen(Qt.PenStyle.NoPen)
            self._draw_on_sheet(new, pen, radius * ratio)
        return [self._looks[colour.rgba(), form] for colour, form in looks]

    def _draw_on_sheet(self, new: Mapping[tuple[int, int], QColor], pen: QPen, radius: float) -> None:
        """Enlarge the sheet by `new` colours and forms."""
        finer, before = self._finer, self._sheet
        rows = -(-(len(self._looks) + len(new)) * finer * finer // _COLUMNS)
        self._sheet = QPixmap(_COLUMNS * self._cell, rows * self._cell)
        self._sheet.fill(Qt.GlobalColor.transparent)
        painter = QPainter(self._sheet)
        if self._looks:
            painter.drawPixmap(0, 0, before)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(pen)
        within = [(x / finer, y / finer) for y in range(finer) for x in range(finer)]
        for look, colour in new.items():
            number = self._looks[look] = len(self._looks)
            painter.setBrush(colour)
            for cell, (x, y) in enumerate(within, number * len(within)):
                left, top = cell % _COLUMNS * self._cell, cell // _COLUMNS * self._cell
                centre = QPointF(left + self._cell / 2 + x, top + self._cell / 2 + y)
                painter.translate(centre)
                self._shape(painter, radius, look[1])
                painter.translate(-centre)
        painter.end()

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return point_colours(count, theme)

    def _rim(self, theme: Theme) -> QColor:
        return theme.paper


class RingStamps(Stamps):
    """Marks of paper within a rim of the accent, all alike."""

    def draw_rings(
        self, painter: QPainter, pixels: FloatArray, theme: Theme, radius: float, rim: float
    ) -> None:
        """Draw rings at `pixels` (k, 2)."""
        self.draw(painter, pixels, np.zeros(len(pixels), dtype=np.intp), 1, theme, radius, rim)

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return [theme.paper] * count

    def _rim(self, theme: Theme) -> QColor:
        return theme.accent


def cells_of(indices: IntArray, count: int) -> IntArray:
    """Return the index of each point's colour among at most 256, with alternating lightness."""
    if count <= _COLOURS:
        return indices
    return indices * (_COLOURS // 2) // count * 2 + indices % 2
