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
    """Return an empty picture of a size in pixels of a plot, for a screen with `ratio` of its own to each."""
    picture = QPixmap(math.ceil(width * ratio), math.ceil(height * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture


class Sheets(msgspec.Struct, frozen=True, eq=False):
    """What was painted for one part of the plane.

    Attributes
    ----------
    sheets
        One over the other; there are several where something else is painted between them.
    shown
        The part of the plane.
    key
        What else it was made for: the theme, the size of lines.
    """

    sheets: tuple[QPixmap, ...]
    pixel_map: PixelMap
    key: tuple[object, ...]

    def draw(self, painter: QPainter, pixel_map: PixelMap, sheet: QPixmap) -> None:
        """Draw a sheet, where it lies when this part of the plane is visible."""
        if pixel_map is self.pixel_map or pixel_map == self.pixel_map:
            painter.drawPixmap(0, 0, sheet)
            return
        place = self.place_in(pixel_map)
        if (pixel_map.sx, pixel_map.sy) == (self.pixel_map.sx, self.pixel_map.sy):
            # On whole pixels of the screen, where it is as sharp as it was, and quickly copied.
            ratio = sheet.devicePixelRatio()
            corner = QPointF(round(place.x() * ratio) / ratio, round(place.y() * ratio) / ratio)
            painter.drawPixmap(corner, sheet)
        else:
            painter.drawPixmap(place, sheet, QRectF(sheet.rect()))

    def place_in(self, pixel_map: PixelMap) -> QRectF:
        """Return where the sheets lie when another part of the plane is visible."""
        old = self.pixel_map
        x, y = pixel_map.point(old.x0, old.y0)
        return QRectF(x, y, old.width * pixel_map.sx / old.sx, old.height * pixel_map.sy / old.sy)


_SHIFTS = 4
"""A mark is kept at so many places within a pixel, along x and y: an eye cannot tell it from one drawn where
it belongs."""

_CELLS_OF_LOOK = _SHIFTS * _SHIFTS

_LOOKS = 32
"""Looks that are kept; when there are more, all are drawn anew as they are asked for."""

Look = TypeVar("Look", bound=Hashable)

Mark: TypeAlias = tuple[Look, float, float]
"""A look, and the pixels x and y of its middle."""


class Sprites(Generic[Look]):
    """Marks that are stamped.

    Parameters
    ----------
    paint
        Draws the mark of a look around (0, 0).
    reach
        How far marks reach, in pixels.
    """

    def __init__(self, paint: Callable[[QPainter, Look], None], reach: float) -> None:
        self._paint, self._reach = paint, reach
        self._fragments = Fragments()
        self._sheet = QPixmap()
        self._ratio, self._side = 0.0, 0
        # The row of the sheet that each look has.
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
        """Draw a look on the sheet, at each place within a pixel; return its row."""
        if not self._rows or len(self._rows) == _LOOKS:
            self._rows = {}
            self._sheet = QPixmap(_CELLS_OF_LOOK * self._side, _LOOKS * self._side)
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
"""Colours that are told apart; with more points, neighbours on the ramp share one."""

_COLUMNS = 16

_FEW, _PLACES = 64, 4
"""Looks up to which each mark is kept at so many places within a pixel, along x and y: an eye cannot tell
it from one drawn where it belongs. Of more, on whole pixels. A sheet grows up to as many."""


class Stamps:
    """Marks in the colours of the points.

    Parameters
    ----------
    shape
        Draws one mark of a given radius and form around (0, 0), with the painter's pen and brush.
    reach
        How far a mark of radius 1 reaches.
    """

    def __init__(self, shape: Callable[[QPainter, float, int], None], reach: float = 1.0) -> None:
        self._shape, self._reach = shape, reach
        self._forms = np.empty(0, dtype=np.intp)
        # The colours and forms on the sheet, in their order there, and which of them each point has.
        self._looks: dict[tuple[int, int], int] = {}
        self._look_of = np.empty(0, dtype=np.intp)
        self._made_of: tuple[object, ...] = ()
        # The sheet: what it is painted for, the size of a cell, the places within a pixel.
        self._sheet = QPixmap()
        self._painted_for: tuple[object, ...] = ()
        self._cell, self._finer = 0, 1
        self._fragments = Fragments()
        # What the fragments were made for: under a drag most points stay where they are.
        self._places, self._indices = np.empty((0, 2)), np.empty(0, dtype=np.intp)

    def draw(
        self,
        painter: QPainter,
        places: FloatArray,
        indices: IntArray,
        count: int,
        theme: Theme,
        radius: float,
        rim: float,
        forms: IntArray | None = None,
    ) -> None:
        """Draw the marks of points `indices` of `count` at `places` (k, 2), in pixels, rimmed like paper.

        `forms` (count,) says which form each point has; they stay the same array where they do not change.
        """
        ratio = painter.device().devicePixelRatioF()
        is_new = self._prepare(count, theme, radius, rim, ratio, forms)
        if is_new or not (
            (indices is self._indices or np.array_equal(indices, self._indices))
            and places.tobytes() == self._places.tobytes()
        ):
            self._places, self._indices = places, indices
            self._fill(places, indices, ratio)
        self._fragments.draw(painter, self._sheet)

    def _fill(self, places: FloatArray, indices: IntArray, ratio: float) -> None:
        finer = self._finer
        steps = np.floor(places * (ratio * finer) + 0.5).astype(np.intp)
        whole, within = np.divmod(steps, finer)
        cells = (self._look_of[indices] * finer + within[:, 1]) * finer + within[:, 0]
        data = self._fragments.room_for(len(indices))
        data[:, :2] = whole / ratio
        data[:, 2] = cells % _COLUMNS * self._cell
        data[:, 3] = cells // _COLUMNS * self._cell
        data[:, 4:6] = self._cell
        data[:, 6:8] = 1.0 / ratio
        data[:, 8] = 0.0
        data[:, 9] = 1.0

    def _prepare(
        self, count: int, theme: Theme, radius: float, rim: float, ratio: float, forms: IntArray | None
    ) -> bool:
        """Have a sheet of the marks; return whether it is another one than before."""
        if forms is None:
            forms = self._forms if len(self._forms) == count else np.zeros(count, dtype=np.intp)
        wanted = (count, theme, radius, rim, ratio)
        if wanted == self._made_of and (forms is self._forms or np.array_equal(forms, self._forms)):
            return False
        self._made_of, self._forms = wanted, forms
        # Form by form of each colour that is there: most points look alike but for their colours.
        most = int(forms.max(initial=0)) + 1
        cells, points = np.unique(cells_of(np.arange(count), count) * most + forms, return_inverse=True)
        colours = self._colours(min(count, _COLOURS), theme)
        looks = [(colours[colour], form) for colour, form in (divmod(cell, most) for cell in cells.tolist())]
        self._look_of = np.array(self._numbers_of(looks, theme, radius, rim, ratio), dtype=np.intp)[points]
        return True

    def _numbers_of(
        self, looks: Sequence[tuple[QColor, int]], theme: Theme, radius: float, rim: float, ratio: float
    ) -> list[int]:
        """Return the places of looks on the sheet; those that it lacks are drawn."""
        painted_for = (theme, radius, rim, ratio, len(looks) > _FEW)
        wanted = {(colour.rgba(), form): colour for colour, form in looks}
        most = len(self._looks.keys() | wanted.keys())
        if painted_for != self._painted_for or most > max(_FEW, len(self._looks)):
            self._painted_for, self._looks = painted_for, {}
            self._finer = 1 if len(looks) > _FEW else _PLACES
            # Even, so that whole pixels lie on whole pixels.
            self._cell = 2 * math.ceil((radius * self._reach + rim) * ratio) + 4
        new = {look: colour for look, colour in wanted.items() if look not in self._looks}
        if new:
            pen = QPen(self._rim(theme), rim * ratio) if rim else QPen(Qt.PenStyle.NoPen)
            self._draw_on_sheet(new, pen, radius * ratio)
        return [self._looks[colour.rgba(), form] for colour, form in looks]

    def _draw_on_sheet(self, new: Mapping[tuple[int, int], QColor], pen: QPen, radius: float) -> None:
        """Make the sheet larger by `new` colours and forms."""
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
        self, painter: QPainter, places: FloatArray, theme: Theme, radius: float, rim: float
    ) -> None:
        """Draw rings at `places` (k, 2), in pixels."""
        self.draw(painter, places, np.zeros(len(places), dtype=np.intp), 1, theme, radius, rim)

    def _colours(self, count: int, theme: Theme) -> Sequence[QColor]:
        return [theme.paper] * count

    def _rim(self, theme: Theme) -> QColor:
        return theme.accent


def cells_of(indices: IntArray, count: int) -> IntArray:
    """Return which of at most 256 colours each point has; the lightness still alternates."""
    if count <= _COLOURS:
        return indices
    return indices * (_COLOURS // 2) // count * 2 + indices % 2
