"""The curves that are not edited, from the back to the front, and those of them that are selected."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import compress, pairwise
from operator import is_not
from time import thread_time
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QPointF, QRect, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from curvecore.arrays import FloatArray

from ..appearance.colours import curve_colour
from ..appearance.theme import mix
from ..document.groups import shapes
from ..document.model import Vector
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pens import draw_line, pen_of
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import RingStamps, Sheets, transparent
from ..plotting.wide_line import RoundLine
from ..tools.pointer import Hit
from ..view_model.curve.curve_view import CurveView
from ..view_model.line_styles import FILE_STYLE
from .curve_layer import CASING, FAINT_WIDTH, CurveLayer, EditedShapeLayer, is_faint
from .hit_test import FilledAreas, LineFinder, pixels_of
from .point_layer import opacity_of
from .shape_painting import Shape, is_plain, line_of, line_width, paint_shape

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

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the picture; it is made anew when another part of the plane is visible.

        Where that takes long, the old one is moved along while the view moves, and made anew when it rests.
        """
        if not self._shapes:
            return
        self._rejoin()
        ratio = painter.device().devicePixelRatioF()
        key = (self.theme, self.scale, ratio)
        picture = self._picture
        if (
            picture is None
            or picture.key != key
            or not (picture.shown == pixel_map or self._may_wait(pixel_map))
        ):
            picture = self._picture = self._made(pixel_map, ratio, key)
        is_moved = picture.shown != pixel_map
        if is_moved:
            self._rest.start()
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, is_moved)
        self._compose(painter, pixel_map, picture)

    def _made(self, pixel_map: PixelMap, ratio: float, key: tuple[object, ...]) -> Sheets:
        """Paint the picture of a part of the plane."""
        began, sheets = thread_time(), list[QPixmap]()
        for section in self._sections:
            if section.is_still:
                sheets.append(transparent(pixel_map.width, pixel_map.height, ratio))
                with QPainter(sheets[-1]) as painter:
                    painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
                    self.paint_shapes(painter, pixel_map, self._shapes[section.span])
        self._seconds, self._is_resting = thread_time() - began, False
        return Sheets(tuple(sheets), pixel_map, key)

    def _rejoin(self) -> None:
        """Have all in one picture again, when many were painted in frame after frame for nothing."""
        self._calm_paints += 1
        if self._calm_paints > _CALM and len(loose_places(self._sections)) > _FEW:
            self._sections, self._picture = sections_of((), len(self._shapes)), None

    def _compose(self, painter: QPainter, pixel_map: PixelMap, picture: Sheets) -> None:
        """Draw the picture, and within it what moves."""
        sheets = iter(picture.sheets)
        for section in self._sections:
            if section.is_still:
                picture.draw(painter, pixel_map, next(sheets))
            else:
                painter.save()
                self.paint_shapes(painter, pixel_map, self._shapes[section.span])
                painter.restore()

    def _may_wait(self, pixel_map: PixelMap) -> bool:
        """Whether the picture is slow to make, and good enough for a view that is moving."""
        assert self._picture is not None
        magnified = pixel_map.sx / self._picture.shown.sx
        return self._seconds > _SLOW and not self._is_resting and _NEAR[0] < magnified < _NEAR[1]

    def _make_anew(self) -> None:
        self._is_resting = True
        self.update()

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint the shapes into the picture."""
        stroke, line = Stroke(), RoundLine()
        for shape in shapes:
            if is_plain(shape[0]):
                for view in shape:
                    self._paint_line(painter, stroke, view, pixel_map)
            else:
                usual = FAINT_WIDTH * self.scale
                paint_shape(painter, shape, pixel_map, self.theme, usual, line)

    def _paint_line(self, painter: QPainter, stroke: Stroke, view: CurveView, pixel_map: PixelMap) -> None:
        stroke.show(line_of(view, pixel_map).points, pixel_map)
        if self._is_cased:
            painter.setPen(self._line(self.theme.paper, FAINT_WIDTH + 2 * CASING))
            stroke.draw(painter)
        painter.setPen(self._line(self._colour(view), FAINT_WIDTH))
        stroke.draw(painter)

    def _colour(self, view: CurveView) -> QColor:
        return curve_colour(view.source.style.colour, self.theme)

    def _line(self, colour: QColor, width: float) -> QPen:
        return QPen(colour, width * self.scale, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap, self.join)

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the curve at `pixel` that is not locked, the last one where several lie."""
        return self._finder.hit(pixel, pixel_map)


class FileLayer(OtherCurvesLayer):
    """Layer of the curves of the file, behind those of the document, out of the reach of the mouse."""

    z = -2.0

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint dashed lines into the picture that is kept: dashes are slow to make."""
        painter.setPen(pen_of(FILE_STYLE, self.theme, self.scale))
        for (view,) in shapes:
            draw_line(painter, pixels_of(view, pixel_map), FILE_STYLE.dashes, pixel_map)


def _changed(before: dict[int, Shape], after: dict[int, Shape]) -> frozenset[int]:
    """Return which of the same shapes have changed; none where they are others: these have not moved."""
    if before.keys() != after.keys():
        return frozenset()
    pairs = enumerate(zip(before.values(), after.values(), strict=True))
    return frozenset(place for place, (old, new) in pairs if old != new)


_WIDTH, _HALO, _ON_STYLE = 2.0, 7.0, 1.0

_CASED, _WIDE = 2.5, 5.0
"""Pixels of the mark with paper on either side, and of the least line that shows its colour beside that."""

_HALO_SHARE = 0.28
_HALOS_UP_TO = 12
"""Curves above which boxes mark them: wide lines would take half of the time of a drag of thirty."""

BESIDE, _BEYOND = 2.0, 8.0
"""Pixels from a painted shape to its box, and from the picture to the sides of a box that leaves it."""

_RADIUS, _RIM = 3.5, 1.5
_MOST_RINGS = 400
"""Points in sight of one curve above which only as many are ringed: more would be a band."""


class SelectedCurvesLayer(OtherCurvesLayer):
    """Layer that marks selected curves, painted like the others from a picture that is kept while they stay.

    Hidden ones are faint, as the active curve is: they are moved with the others. While no curve is edited
    no points are shown, and these have no rings.
    """

    z = -0.7

    shows_hidden = True
    radius, rim = _RADIUS, _RIM
    join = Qt.PenJoinStyle.RoundJoin

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._rings, self._has_rings = RingStamps(_ring), True

    def set_rings(self, has_rings: bool) -> None:
        """Draw rings around the points, or no points at all."""
        if has_rings != self._has_rings:
            self._has_rings, self._picture = has_rings, None
            self.update()

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint the marks of choice and rings into the picture: lines on curves, or boxes around shapes."""
        views = [view for shape in shapes for view in shape]
        is_many = len(self._views) > _HALOS_UP_TO
        stroke = Stroke()
        for view in views:
            if self._is_line(view):
                stroke.show(line_of(view, pixel_map).points, pixel_map)
                self._paint_line_of(painter, stroke, view, has_halo=not is_many)
            elif not is_many and not self._is_boxed(view, pixel_map):
                self._paint_on_style(painter, stroke, view, pixel_map)
        # Over a fine line, and on the colours beside it, any other one would hide them.
        boxed = views if is_many else [view for view in views if self._is_boxed(view, pixel_map)]
        if boxed:
            self._paint_boxes(painter, pixel_map, boxed)
        if self._has_rings:
            self._paint_rings(painter, pixel_map, views)

    def _is_line(self, view: CurveView) -> bool:
        """Whether a curve is drawn here as a line, and not marked on what is painted."""
        return is_plain(view) or not view.source.visible

    def _paint_line_of(self, painter: QPainter, stroke: Stroke, view: CurveView, *, has_halo: bool) -> None:
        """Paint the line of a curve that has no looks of its own, or is hidden."""
        is_seen = view.source.visible
        if has_halo:
            self._paint_halo(painter, stroke, view)
        painter.setPen(
            self._line(self._colour(view), _WIDTH) if is_seen else self._line(self.theme.handle, FAINT_WIDTH)
        )
        stroke.draw(painter)

    def _is_boxed(self, view: CurveView, pixel_map: PixelMap) -> bool:
        """Whether a box marks a curve: its line is too fine to be drawn on."""
        return not self._is_line(view) and 0 < self._line_width(view, pixel_map) < _WIDE

    def _line_width(self, view: CurveView, pixel_map: PixelMap) -> float:
        return line_width(view.source.style, pixel_map, _WIDTH * self.scale) / self.scale

    def _paint_on_style(
        self, painter: QPainter, stroke: Stroke, view: CurveView, pixel_map: PixelMap
    ) -> None:
        """Mark a wide line or an inside by a thin line on it."""
        stroke.show(line_of(view, pixel_map, view.source.style).points, pixel_map)
        casing = [(self.theme.paper, _CASED)] if self._line_width(view, pixel_map) else []
        for pen in [*casing, (self.theme.accent, _ON_STYLE)]:
            painter.setPen(self._line(*pen))
            stroke.draw(painter)

    def _paint_halo(self, painter: QPainter, stroke: Stroke, view: CurveView) -> None:
        # No opacity: where the pieces of a line meet, their caps would be seen.
        halo = mix(self.theme.accent, self.theme.paper, _HALO_SHARE)
        painter.setOpacity(opacity_of(view))
        painter.setPen(self._line(halo, _HALO))
        stroke.draw(painter)
        painter.setOpacity(1.0)

    def _paint_boxes(self, painter: QPainter, pixel_map: PixelMap, views: Sequence[CurveView]) -> None:
        """Frame each painted shape, all in one call: it costs next to nothing, and hides no colour."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, max(round(self.scale), 1)))
        painter.drawRects(_frames_of(views, pixel_map, self.scale))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)

    def _paint_rings(self, painter: QPainter, pixel_map: PixelMap, views: Sequence[CurveView]) -> None:
        """Ring the points of all curves over all lines: in one call for those of one opacity."""
        for opacity in {opacity_of(view) for view in views}:
            near = [self._near(view, pixel_map) for view in views if opacity_of(view) == opacity]
            painter.setOpacity(opacity)
            self._rings.draw_rings(
                painter, np.concatenate(near), self.theme, self.radius * self.scale, self.rim * self.scale
            )

    def _near(self, view: CurveView, pixel_map: PixelMap) -> FloatArray:
        """Return the pixels of the points in sight, (k, 2); of very many some."""
        pixels, margin = pixel_map.points(view.points), 2 * _RADIUS * self.scale
        is_near = ((pixels > -margin) & (pixels < (pixel_map.width + margin, pixel_map.height + margin))).all(
            axis=1
        )
        near: FloatArray = pixels[is_near]
        return near[:: max(len(near) // _MOST_RINGS, 1)]


class SiblingCurvesLayer(SelectedCurvesLayer):
    """Layer of the points of the other curves of the shape that is edited: a press takes them, too."""

    radius, rim = 3.0, 1.2

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint small rings into the picture."""
        self._paint_rings(painter, pixel_map, [view for shape in shapes for view in shape])


def _ring(painter: QPainter, radius: float, _form: int) -> None:
    painter.drawEllipse(QPointF(0.0, 0.0), radius, radius)


def _frames_of(views: Sequence[CurveView], pixel_map: PixelMap, scale: float) -> list[QRect]:
    """Return a box around each painted shape, in pixels, as far as it is in or near the picture."""
    corners = pixel_map.points(np.concatenate([view.drawn_box for view in views])).reshape(-1, 2, 2)
    widths = [line_width(view.source.style, pixel_map, _WIDTH * scale) for view in views]
    pads = BESIDE * scale + np.array(widths)[:, None] / 2
    names = [view.source.shape for view in views]
    starts = [at for at, name in enumerate(names) if not name or at == 0 or names[at - 1] != name]
    lows = np.minimum.reduceat(corners.min(axis=1) - pads, starts)
    highs = np.maximum.reduceat(corners.max(axis=1) + pads, starts)
    lows = np.maximum(lows, -_BEYOND).round()
    highs = np.minimum(highs, (pixel_map.width + _BEYOND, pixel_map.height + _BEYOND)).round()
    boxes = np.hstack([lows, highs - lows])[(highs > lows).all(axis=1)]
    return [QRect(*box) for box in boxes.astype(int).tolist()]


_ABOVE = -0.8
"""Height of what lies over the shape that is edited."""


class DrawnCurves:
    """Layers of all curves: what lies below the edited shape, that, what lies over it, and marks.

    A plain line that is edited is drawn over all others, as long as none of these is painted otherwise.

    Attributes
    ----------
    others, above
        The shapes that are not edited, below the edited one and over it; only the first finds curves.
    selected
        What marks the curves that are selected together with the edited one.
    siblings
        The points of the other curves of the shape that is edited.
    edited, curve
        The shape that is edited, in its style; the line of the active curve.
    areas
        The insides of what is filled.
    """

    def __init__(self, plot: PlotWidget) -> None:
        self.others = OtherCurvesLayer(plot)
        self.edited = EditedShapeLayer(plot)
        self.above = OtherCurvesLayer(plot, z=_ABOVE)
        self.selected = SelectedCurvesLayer(plot)
        self.siblings = SiblingCurvesLayer(plot)
        self.curve = CurveLayer(plot)
        self.areas = FilledAreas()
        self._locked = LineFinder()
        # The places of the curves of the edited shape, where it is no plain line.
        self._edited_places = range(0)
        self._shown: tuple[Sequence[CurveView], int | None, frozenset[int], frozenset[int]]
        self._shown = ((), 0, frozenset(), frozenset())

    def render(
        self,
        views: Sequence[CurveView],
        active: int | None,
        selected: frozenset[int],
        edited: frozenset[int],
    ) -> None:
        """Show the curves of a document: the active one if it is edited, those selected and those edited."""
        before, self._shown = self._shown, (views, active, selected, edited)
        self.areas.render(views)
        if not self._rest_since(*before):
            self._render_all()
        elif self._edited_places:
            self.edited.render(tuple(views[place] for place in self._edited_places))

    def follow(self, views: Sequence[CurveView]) -> None:
        """Show the same curves where they run now."""
        self.render(views, *self._shown[1:])

    def _rest_since(self, views: Sequence[CurveView], active: int | None, *places: frozenset[int]) -> bool:
        """Whether all that has changed is where the active curve runs, as under a drag."""
        now, *others = self._shown
        if active is None or others != [active, *places] or not active < len(now) == len(views):
            return False
        if list(compress(range(len(now)), map(is_not, now, views))) not in ([], [active]):
            return False
        new, old = now[active], views[active]
        return (
            new.source.style is old.source.style
            and new.source.visible is old.source.visible
            and new.source.shape == old.source.shape
            # Under a drag there is a curve in every frame.
            and (
                (new.displacement is not None and old.displacement is not None)
                or is_faint(new) is is_faint(old)
            )
        )

    def _render_all(self) -> None:
        views, active, selected, edited = self._shown
        # Points are shown of what is edited, and of what is worked on together with it.
        self.selected.set_rings(active is not None)
        active = -1 if active is None else active
        other = [place for place in range(len(views)) if place != active]
        found = [
            (place, views[place])
            for place in other
            if place not in selected and views[place].source.visible and views[place].has_curve
        ]
        units = list(shapes([view.source for view in views]))
        below, shape, above = self._in_order(views, units, active, selected)
        self.others.render_shapes(below, found)
        seen = ((place, views[place]) for place in other if views[place].source.visible)
        self._locked.render([each for each in seen if each[1].source.locked and each[1].has_curve])
        self._edited_places = next(each for each in units if active in each) if shape else range(0)
        self.edited.render(shape)
        self.above.render_shapes(above, [])
        self.selected.render(views, [place for place in other if place in selected])
        siblings = [place for place in other if place in edited and place not in selected]
        self.siblings.render_shapes({place: (views[place],) for place in siblings}, [])
        self.curve.set_covered(bool(above))

    def _in_order(
        self, views: Sequence[CurveView], units: Sequence[range], active: int, selected: Collection[int]
    ) -> tuple[dict[int, Shape], Shape, dict[int, Shape]]:
        """Return the shapes below the edited one, that where it is no plain line, and those over it.

        Each stands at the place of its first curve. With no edited one, −1, all are below.
        """
        below: dict[int, Shape] = {}
        above: dict[int, Shape] = {}
        edited: Shape = ()
        is_layered, marked = False, {active, *selected}
        for places in units:
            is_line = is_plain(views[places.start])
            if active in places and not is_line and not is_faint(views[active]):
                edited, is_layered = tuple(views[place] for place in places), True
                continue
            # The edited one is a line of its own, plain or faint; what is selected is drawn by its marks.
            hidden = marked if is_line else (active,)
            shape = tuple(
                [
                    view
                    for place in places
                    if place not in hidden and (view := views[place]).source.visible and view.has_curve
                ]
            )
            if shape:
                is_over = places.start > active >= 0
                is_layered |= is_over and not is_line
                (above if is_over else below)[places.start] = shape
        return (below, edited, above) if is_layered else (below | above, edited, {})

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the curve at `pixel`, neither edited nor locked."""
        _, active, *_ = self._shown
        line = self.selected.hit(pixel, pixel_map) or self.others.hit(pixel, pixel_map)
        return self.areas.hit(pixel, pixel_map, active, line)

    def locked_at(self, pixel: Vector, pixel_map: PixelMap) -> int:
        """Return the place of the locked curve at `pixel`, which a press goes through; −1 for none."""
        hit = self._locked.hit(pixel, pixel_map)
        return hit.index if hit is not None else -1

    def set_cased(self, cased: bool) -> None:
        """Keep plain lines apart from what lies below them, a picture to trace, or not."""
        for layer in (self.others, self.above, self.curve):
            layer.set_cased(cased)
