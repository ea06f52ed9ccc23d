"""The curves that are not edited: drawn behind the active one, from a picture that is kept."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from time import thread_time
from typing import NamedTuple

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from ..appearance.colours import curve_colour
from ..document.model import Vector
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pens import draw_line, pen_of
from ..plotting.pictures import Sheets, transparent
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.wide_line import RoundLine
from ..tools.pointer import Hit
from ..view_model.curve.curve_view import CurveView
from ..view_model.line_styles import FILE_STYLE
from .curve_layer import CASING, FAINT_WIDTH
from .line_finder import LineFinder, pixels_of
from .looks import Shape, is_plain, line_of
from .shape_painting import paint_shape

_WORTH_A_SHEET, _MOST_SHEETS = 2, 8
"""Shapes that take as long to paint as to copy a sheet; sheets, at most: each is as large as the area."""


class Section(NamedTuple):
    """Shapes that lie one over the other: in a sheet of the picture, or painted in every frame."""

    places: range
    is_still: bool

    @property
    def span(self) -> slice:
        """The part of all shapes that it is."""
        return slice(self.places.start, self.places.stop)


def sections_of(changed: Sequence[int], count: int) -> tuple[Section, ...]:
    """Return the sections of `count` shapes, of which those at the places `changed`, ascending, change.

    What lies between two of these is a sheet where that is worth it.
    """
    gaps = [range(before + 1, after) for before, after in pairwise([-1, *changed, count])]
    worth = sorted((gap for gap in gaps if len(gap) >= _WORTH_A_SHEET or not changed), key=len)
    sections, begin = list[Section](), 0
    for gap in sorted(worth[-_MOST_SHEETS:], key=lambda gap: gap.start):
        sections += [Section(range(begin, gap.start), False), Section(gap, True)]
        begin = gap.stop
    sections.append(Section(range(begin, count), False))
    return tuple(section for section in sections if section.places)


def loose_places(sections: Sequence[Section]) -> frozenset[int]:
    """Return the places of the shapes that are in no sheet."""
    return frozenset(place for section in sections if not section.is_still for place in section.places)


_SLOW = 0.008
"""Seconds above which the picture is not made anew for every step of a pan or a zoom."""

_REST_MS = 80

_NEAR = (0.25, 4.0)
"""How much a picture is reduced or enlarged at most to stand for another one."""

_FOLLOWED = 100
"""Shapes that move which are painted in every frame, and the others but once."""

_FEW = 8
"""Shapes that may be painted in every frame, whether they move or not, beside the picture of the others."""

_CALM = 8
"""Frames in which nothing has changed, after which what is more than a few is in the picture again."""


class OtherCurvesLayer(Layer):
    """Layer of the visible curves that are not edited, in their styles; it finds which of them a pixel is on.

    While the active curve is dragged the others are the same objects in front of the same part of the plane;
    painting them is then copying one picture, however many they are. While some of them are dragged the
    picture is in several sheets: what lies below these, between them, and over them.
    """

    z = -1.0

    shows_hidden = False
    join = Qt.PenJoinStyle.BevelJoin

    def __init__(self, plot: PlotWidget, *, z: float | None = None) -> None:
        super().__init__(plot, z=z)
        self._is_cased = False
        self._views: list[tuple[int, CurveView]] = []
        self._drawn: dict[int, Shape] = {}
        self._shapes: list[Shape] = []
        # Which shapes are in the picture, and which are painted in every frame.
        self._sections = sections_of((), 0)
        self._calm_paints = 0
        self._picture: Sheets | None = None
        self._seconds = 0.0
        self._is_resting = False
        self._rest = QTimer(plot, singleShot=True, interval=_REST_MS)
        self._rest.timeout.connect(self._make_anew)
        self._finder = LineFinder()
        self.set_visible(False)

    def render(self, views: Sequence[CurveView], places: Sequence[int]) -> None:
        """Draw those of `views` at these places from the next paint on, and find them."""
        shown = [
            (place, views[place])
            for place in places
            if (views[place].source.visible or self.shows_hidden) and views[place].has_curve
        ]
        self.render_shapes({place: (view,) for place, view in shown}, shown)

    def render_shapes(self, shapes: dict[int, Shape], found: list[tuple[int, CurveView]]) -> None:
        """Draw shapes from the next paint on, by the place of their first curve; find these curves."""
        if found != self._views:
            self._views = found
            self._finder.render([each for each in found if not each[1].source.locked])
        if shapes != self._drawn:
            self._follow(_changed(self._drawn, shapes), len(shapes))
            self._drawn, self._shapes = shapes, list(shapes.values())
            self.set_visible(bool(shapes))
            self.update()

    def _follow(self, changed: frozenset[int], count: int) -> None:
        """Paint what has changed in every frame from now on, unless it is too much."""
        self._calm_paints = 0
        if changed and changed <= loose_places(self._sections):
            return
        is_followed = len(changed) <= _FOLLOWED
        self._sections, self._picture = sections_of(sorted(changed) if is_followed else (), count), None

    def set_cased(self, cased: bool) -> None:
        """Keep the lines apart from what lies below them, a picture to trace, or not."""
        if cased != self._is_cased:
            self._is_cased, self._picture = cased, None
            self.update()

    def paint(self, painter: QPainter, shown: PixelMap) -> None:
        """Draw the picture; it is made anew when another part of the plane is visible.

        Where that takes long, the old one is moved along while the view moves, and made anew when it rests.
        """
        if not self._shapes:
            return
        self._rejoin()
        ratio = painter.device().devicePixelRatioF()
        key = (self.theme, self.scale, ratio)
        picture = self._picture
        if picture is None or picture.key != key or not (picture.shown == shown or self._may_wait(shown)):
            picture = self._picture = self._made(shown, ratio, key)
        is_moved = picture.shown != shown
        if is_moved:
            self._rest.start()
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, is_moved)
        self._compose(painter, shown, picture)

    def _made(self, shown: PixelMap, ratio: float, key: tuple[object, ...]) -> Sheets:
        """Paint the picture of a part of the plane."""
        began, sheets = thread_time(), list[QPixmap]()
        for section in self._sections:
            if section.is_still:
                sheets.append(transparent(shown.width, shown.height, ratio))
                with QPainter(sheets[-1]) as painter:
                    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
                    self.paint_shapes(painter, shown, self._shapes[section.span])
        self._seconds, self._is_resting = thread_time() - began, False
        return Sheets(tuple(sheets), shown, key)

    def _rejoin(self) -> None:
        """Have all in one picture again, when many were painted in frame after frame for nothing."""
        self._calm_paints += 1
        if self._calm_paints > _CALM and len(loose_places(self._sections)) > _FEW:
            self._sections, self._picture = sections_of((), len(self._shapes)), None

    def _compose(self, painter: QPainter, shown: PixelMap, picture: Sheets) -> None:
        """Draw the picture, and within it what moves."""
        sheets = iter(picture.sheets)
        for section in self._sections:
            if section.is_still:
                picture.draw(painter, shown, next(sheets))
            else:
                painter.save()
                self.paint_shapes(painter, shown, self._shapes[section.span])
                painter.restore()

    def _may_wait(self, shown: PixelMap) -> bool:
        """Whether the picture is slow to make, and good enough for a view that is moving."""
        assert self._picture is not None
        magnified = shown.sx / self._picture.shown.sx
        return self._seconds > _SLOW and not self._is_resting and _NEAR[0] < magnified < _NEAR[1]

    def _make_anew(self) -> None:
        self._is_resting = True
        self.update()

    def paint_shapes(self, painter: QPainter, shown: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint the shapes into the picture."""
        stroke, line = Stroke(), RoundLine()
        for shape in shapes:
            if is_plain(shape[0]):
                for view in shape:
                    self._paint_line(painter, stroke, view, shown)
            else:
                usual = FAINT_WIDTH * self.scale
                paint_shape(painter, shape, shown, self.theme, usual, line)

    def _paint_line(self, painter: QPainter, stroke: Stroke, view: CurveView, shown: PixelMap) -> None:
        stroke.show(line_of(view, shown).points, shown)
        if self._is_cased:
            painter.setPen(self._line(self.theme.paper, FAINT_WIDTH + 2 * CASING))
            stroke.draw(painter)
        painter.setPen(self._line(self._colour(view), FAINT_WIDTH))
        stroke.draw(painter)

    def _colour(self, view: CurveView) -> QColor:
        return curve_colour(view.source.style.colour, self.theme)

    def _line(self, colour: QColor, width: float) -> QPen:
        return QPen(colour, width * self.scale, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, self.join)

    def hit(self, pixel: Vector, shown: PixelMap) -> Hit | None:
        """Return the curve at `pixel` that is not locked, the last one where several lie."""
        return self._finder.hit(pixel, shown)


class FileLayer(OtherCurvesLayer):
    """Layer of the curves of the file, behind those of the document, out of the reach of the mouse."""

    z = -2.0

    def paint_shapes(self, painter: QPainter, shown: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint dashed lines into the picture that is kept: dashes are slow to make."""
        painter.setPen(pen_of(FILE_STYLE, self.theme, self.scale))
        for (view,) in shapes:
            draw_line(painter, pixels_of(view, shown), FILE_STYLE.dashes, shown)


def _changed(before: dict[int, Shape], after: dict[int, Shape]) -> frozenset[int]:
    """Return which of the same shapes have changed; none where they are others: these have not moved."""
    if before.keys() != after.keys():
        return frozenset()
    pairs = enumerate(zip(before.values(), after.values(), strict=True))
    return frozenset(place for place, (old, new) in pairs if old != new)
