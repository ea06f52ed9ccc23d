"""The curves that are not edited, from the back to the front, and those of them that are selected."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import compress, pairwise
from operator import is_not
from time import thread_time
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QPointF, QRect, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from curvecore.arrays import FloatArray

from ..appearance.colours import curve_colour
from ..appearance.theme import mix
from ..document.groups import shape_ranges
from ..document.model import Vector
from ..plotting.drawing import Stroke
from ..plotting.layers import Layer
from ..plotting.pens import draw_line, pen_of
from ..plotting.pixel_map import PixelMap
from ..plotting.plot_widget import PlotWidget
from ..plotting.stamps import RingStamps, Sheets, transparent
from ..plotting.wide_line import RoundLine
from ..tasks.task import DelayedCall
from ..tools.pointer import Hit, Part
from ..view_model.curve.curve_view import CurveView
from ..view_model.line_styles import FILE_STYLE
from .curve_layer import CASING, FAINT_WIDTH, CurveLayer, EditedShapeLayer, is_faint
from .hit_test import EndFinder, FilledAreas, LineFinder, NearestPart, pixels_of
from .point_layer import opacity_of
from .shape_painting import Shape, is_plain, line_of, line_width, paint_shape

_WORTH_A_SHEET, _MOST_SHEETS = 2, 8
"""Shapes from which a sheet pays, and the largest number of sheets: each is as large as the area."""


class Section(NamedTuple):
    """Consecutive shapes: painted once into a sheet of the picture, or painted in every frame."""

    indices: range
    is_still: bool

    @property
    def span(self) -> slice:
        """The slice of these shapes among all."""
        return slice(self.indices.start, self.indices.stop)


def sections_of(changed: Sequence[int], count: int) -> tuple[Section, ...]:
    """Return the sections of `count` shapes, of which those at the indices `changed`, ascending, change.

    The shapes between two of these are a sheet where they are enough.
    """
    gaps = [range(before + 1, after) for before, after in pairwise([-1, *changed, count])]
    worth = sorted((gap for gap in gaps if len(gap) >= _WORTH_A_SHEET or not changed), key=len)
    sections, begin = list[Section](), 0
    for gap in sorted(worth[-_MOST_SHEETS:], key=lambda gap: gap.start):
        sections += [Section(range(begin, gap.start), False), Section(gap, True)]
        begin = gap.stop
    sections.append(Section(range(begin, count), False))
    return tuple(section for section in sections if section.indices)


def loose_indices(sections: Sequence[Section]) -> frozenset[int]:
    """Return the indices of the shapes that are in no sheet."""
    return frozenset(index for section in sections if not section.is_still for index in section.indices)


_SLOW = 0.008
"""Seconds of painting above which the picture is not repainted at every step of a pan or a zoom."""

_REST_MS = 80

_NEAR = (0.25, 4.0)
"""Factors between which a picture is scaled in place of a new one."""

_MOST_FOLLOWED = 100
"""Moving shapes, at most, that are painted in every frame while the others are painted once."""

_MOST_LOOSE = 8
"""Shapes at rest, at most, that stay outside the picture and are painted in every frame."""

_CALM_FRAMES = 8
"""Frames without a change after which more shapes than that return to the picture."""


class OtherCurvesLayer(Layer):
    """Layer of the visible curves that are not edited, in their styles, with their hit test.

    While the active curve is dragged, the others are the same objects in front of the same part of the plane:
    painting them copies one picture, however many they are. While some of them are dragged, the picture
    consists of several sheets: the shapes below these, between them, and over them.
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
        # Shapes in the sheets of the picture, and shapes painted in every frame.
        self._sections = sections_of((), 0)
        self._calm_paints = 0
        self._picture: Sheets | None = None
        self._seconds = 0.0
        self._is_resting = False
        self._rest = DelayedCall(plot, _REST_MS, self._repaint)
        self._finder = LineFinder()
        self.set_visible(False)

    def render(self, views: Sequence[CurveView], indices: Sequence[int]) -> None:
        """Draw the views at these indices from the next paint on, and find them."""
        drawn = [
            (index, views[index])
            for index in indices
            if (views[index].source.visible or self.shows_hidden) and views[index].has_curve
        ]
        self.render_shapes({index: (view,) for index, view in drawn}, drawn)

    def render_shapes(self, shapes: dict[int, Shape], views: list[tuple[int, CurveView]]) -> None:
        """Draw shapes, by the index of their first curve, from the next paint on; find these curves."""
        if views != self._views:
            self._views = views
            self._finder.render([pair for pair in views if not pair[1].source.locked])
        if shapes != self._drawn:
            self._follow(_changed(self._drawn, shapes), len(shapes))
            self._drawn, self._shapes = shapes, list(shapes.values())
            self.set_visible(bool(shapes))
            self.update()

    def _follow(self, changed: frozenset[int], count: int) -> None:
        """Paint the changed shapes in every frame from now on, unless they are too many."""
        self._calm_paints = 0
        if changed and changed <= loose_indices(self._sections):
            return
        is_followed = len(changed) <= _MOST_FOLLOWED
        self._sections, self._picture = sections_of(sorted(changed) if is_followed else (), count), None

    def set_cased(self, cased: bool) -> None:
        """Draw the lines with a casing of paper over a picture to trace, or without."""
        if cased != self._is_cased:
            self._is_cased, self._picture = cased, None
            self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the picture; it is repainted when another part of the plane is visible.

        A slow picture is moved and scaled while the view moves, and repainted when the view rests.
        """
        if not self._shapes:
            return
        self._rejoin()
        ratio = painter.device().devicePixelRatioF()
        key = (self.theme, self.scale, ratio)
        picture = self._picture
        is_at = picture is not None and (picture.pixel_map == pixel_map or self._may_wait(pixel_map))
        if picture is None or picture.key != key or not is_at:
            picture = self._picture = self._painted_sheets(pixel_map, ratio, key)
        is_moved = picture.pixel_map != pixel_map
        if is_moved:
            self._rest.start()
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, is_moved)
        self._compose(painter, pixel_map, picture)

    def _painted_sheets(self, pixel_map: PixelMap, ratio: float, key: tuple[object, ...]) -> Sheets:
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
        """Return all shapes to one picture after many frames without a change."""
        self._calm_paints += 1
        if self._calm_paints > _CALM_FRAMES and len(loose_indices(self._sections)) > _MOST_LOOSE:
            self._sections, self._picture = sections_of((), len(self._shapes)), None

    def _compose(self, painter: QPainter, pixel_map: PixelMap, picture: Sheets) -> None:
        """Draw the sheets of the picture, and the moving shapes between them."""
        sheets = iter(picture.sheets)
        for section in self._sections:
            if section.is_still:
                picture.draw(painter, pixel_map, next(sheets))
            else:
                painter.save()
                self.paint_shapes(painter, pixel_map, self._shapes[section.span])
                painter.restore()

    def _may_wait(self, pixel_map: PixelMap) -> bool:
        """Whether the picture is slow to paint, and good enough for a moving view."""
        assert self._picture is not None
        magnified = pixel_map.sx / self._picture.pixel_map.sx
        return self._seconds > _SLOW and not self._is_resting and _NEAR[0] < magnified < _NEAR[1]

    def _repaint(self) -> None:
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
        """Return the unlocked curve at `pixel`, the last of several."""
        return self._finder.hit(pixel, pixel_map)


class FileLayer(OtherCurvesLayer):
    """Layer of the curves in the file, behind the curves of the document; no hit test finds them."""

    z = -2.0

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint dashed lines into the picture."""
        painter.setPen(pen_of(FILE_STYLE, self.theme, self.scale))
        for (view,) in shapes:
            draw_line(painter, pixels_of(view, pixel_map), FILE_STYLE.dashes, pixel_map)


def _changed(before: dict[int, Shape], after: dict[int, Shape]) -> frozenset[int]:
    """Return the indices of the shapes that have changed; none where shapes were added or removed."""
    if before.keys() != after.keys():
        return frozenset()
    pairs = enumerate(zip(before.values(), after.values(), strict=True))
    return frozenset(index for index, (old, new) in pairs if old != new)


_WIDTH, _HALO, _ON_STYLE = 2.0, 7.0, 1.0

_CASED, _WIDE = 2.5, 5.0
"""Pixels of the mark with its casing, and of the finest line that shows its colour beside the mark."""

_HALO_SHARE = 0.28
_HALOS_UP_TO = 12
"""Selected curves above which boxes mark them: the halos of thirty would take half the time of a drag."""

BESIDE, _BEYOND = 2.0, 8.0
"""Pixels from a painted shape to its box, and beyond the edge of the picture to a box that leaves it."""

_RADIUS, _RIM = 3.5, 1.5
_MOST_RINGS = 400
"""Largest number of rings on one curve: more would merge into a band."""


class SelectedCurvesLayer(OtherCurvesLayer):
    """Layer of the marks of selected curves, painted from a picture as the other curves are.

    Hidden curves are drawn faintly, because they move with the others. Points have rings only while a curve
    is edited.
    """

    z = -0.7

    shows_hidden = True
    radius, rim = _RADIUS, _RIM
    join = Qt.PenJoinStyle.RoundJoin

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self._rings, self._has_rings = RingStamps(_ring), True

    def set_rings(self, has_rings: bool) -> None:
        """Draw rings around the points, or no points."""
        if has_rings != self._has_rings:
            self._has_rings, self._picture = has_rings, None
            self.update()

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint the marks of selected curves: lines on curves or boxes around shapes, and rings."""
        views = [view for shape in shapes for view in shape]
        is_many = len(self._views) > _HALOS_UP_TO
        stroke = Stroke()
        for view in views:
            if self._is_line(view):
                stroke.show(line_of(view, pixel_map).points, pixel_map)
                self._paint_selected(painter, stroke, view, has_halo=not is_many)
            elif not is_many and not self._is_boxed(view, pixel_map):
                self._paint_mark_on(painter, stroke, view, pixel_map)
        # On a fine line any other mark would hide its colour.
        boxed = views if is_many else [view for view in views if self._is_boxed(view, pixel_map)]
        if boxed:
            self._paint_boxes(painter, pixel_map, boxed)
        if self._has_rings:
            self._paint_rings(painter, pixel_map, views)

    def _is_line(self, view: CurveView) -> bool:
        """Return whether this layer draws the curve as a line, and not as a mark on its style."""
        return is_plain(view) or not view.source.visible

    def _paint_selected(self, painter: QPainter, stroke: Stroke, view: CurveView, *, has_halo: bool) -> None:
        """Paint the line of a plain or hidden curve."""
        if has_halo:
            self._paint_halo(painter, stroke, view)
        visible_pen, hidden_pen = (self._colour(view), _WIDTH), (self.theme.handle, FAINT_WIDTH)
        painter.setPen(self._line(*(visible_pen if view.source.visible else hidden_pen)))
        stroke.draw(painter)

    def _is_boxed(self, view: CurveView, pixel_map: PixelMap) -> bool:
        """Whether a box marks the curve: its line is too fine to be drawn on."""
        return not self._is_line(view) and 0 < self._line_width(view, pixel_map) < _WIDE

    def _line_width(self, view: CurveView, pixel_map: PixelMap) -> float:
        return line_width(view.source.style, pixel_map, _WIDTH * self.scale) / self.scale

    def _paint_mark_on(self, painter: QPainter, stroke: Stroke, view: CurveView, pixel_map: PixelMap) -> None:
        """Mark a wide line or a filled shape by a thin line on it."""
        stroke.show(line_of(view, pixel_map, view.source.style).points, pixel_map)
        casing = [(self.theme.paper, _CASED)] if self._line_width(view, pixel_map) else []
        for pen in [*casing, (self.theme.accent, _ON_STYLE)]:
            painter.setPen(self._line(*pen))
            stroke.draw(painter)

    def _paint_halo(self, painter: QPainter, stroke: Stroke, view: CurveView) -> None:
        # An opaque colour: the caps of translucent pieces would show where they meet.
        halo = mix(self.theme.accent, self.theme.paper, _HALO_SHARE)
        painter.setOpacity(opacity_of(view))
        painter.setPen(self._line(halo, _HALO))
        stroke.draw(painter)
        painter.setOpacity(1.0)

    def _paint_boxes(self, painter: QPainter, pixel_map: PixelMap, views: Sequence[CurveView]) -> None:
        """Frame the painted shapes, all in one call: this costs next to nothing and hides no colour."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(self.theme.accent, max(round(self.scale), 1)))
        painter.drawRects(_frames_of(views, pixel_map, self.scale))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)

    def _paint_rings(self, painter: QPainter, pixel_map: PixelMap, views: Sequence[CurveView]) -> None:
        """Ring the points of all curves over all lines, in one call for each opacity."""
        for opacity in {opacity_of(view) for view in views}:
            near = [self._near(view, pixel_map) for view in views if opacity_of(view) == opacity]
            painter.setOpacity(opacity)
            self._rings.draw_rings(
                painter, np.concatenate(near), self.theme, self.radius * self.scale, self.rim * self.scale
            )

    def _near(self, view: CurveView, pixel_map: PixelMap) -> FloatArray:
        """Return the pixels of the visible points, (k, 2), thinned out where they are too many."""
        pixels, margin = pixel_map.points(view.points), 2 * _RADIUS * self.scale
        near: FloatArray = pixels[pixel_map.near(pixels, margin)]
        return near[:: max(len(near) // _MOST_RINGS, 1)]


class SiblingCurvesLayer(SelectedCurvesLayer):
    """Layer of the points of the other curves of the edited shape: a press selects them as well."""

    radius, rim = 3.0, 1.2

    def paint_shapes(self, painter: QPainter, pixel_map: PixelMap, shapes: Sequence[Shape]) -> None:
        """Paint small rings into the picture."""
        self._paint_rings(painter, pixel_map, [view for shape in shapes for view in shape])


def _ring(painter: QPainter, radius: float, _form: int) -> None:
    painter.drawEllipse(QPointF(0.0, 0.0), radius, radius)


def _frames_of(views: Sequence[CurveView], pixel_map: PixelMap, scale: float) -> list[QRect]:
    """Return a box around each painted shape, in pixels, cut to the picture and its margin."""
    corners = pixel_map.points(np.concatenate([view.drawn_box for view in views])).reshape(-1, 2, 2)
    widths = [line_width(view.source.style, pixel_map, _WIDTH * scale) for view in views]
    pads = BESIDE * scale + np.array(widths)[:, None] / 2
    names = [view.source.shape for view in views]
    starts = [k for k, name in enumerate(names) if not name or k == 0 or names[k - 1] != name]
    lows = np.minimum.reduceat(corners.min(axis=1) - pads, starts)
    highs = np.maximum.reduceat(corners.max(axis=1) + pads, starts)
    lows = np.maximum(lows, -_BEYOND).round()
    highs = np.minimum(highs, (pixel_map.width + _BEYOND, pixel_map.height + _BEYOND)).round()
    boxes = np.hstack([lows, highs - lows])[(highs > lows).all(axis=1)]
    return [QRect(*box) for box in boxes.astype(int).tolist()]


_ABOVE = -0.8
"""The z of the shapes over the edited one."""


class DrawnCurves:
    """Layers of all curves: shapes below the edited one, the edited one, shapes over it, and marks.

    An edited plain line is drawn over all others as long as these are plain lines.

    Attributes
    ----------
    others, above
        The shapes below the edited one and over it; only the first has a hit test.
    selected
        Marks of the curves that are selected together with the edited one.
    siblings
        Points of the other curves of the edited shape.
    edited, curve
        The edited shape in its style; the line of the active curve.
    areas
        Insides of filled shapes.
    """

    def __init__(self, plot: PlotWidget) -> None:
        self.others = OtherCurvesLayer(plot)
        self.edited = EditedShapeLayer(plot)
        self.above = OtherCurvesLayer(plot, z=_ABOVE)
        self.selected = SelectedCurvesLayer(plot)
        self.siblings = SiblingCurvesLayer(plot)
        self.curve = CurveLayer(plot)
        self.areas = FilledAreas()
        self._ends = EndFinder()
        self._locked = LineFinder()
        # The indices of the curves of the edited shape, unless it is a plain line.
        self._edited_indices = range(0)
        self._rendered: tuple[Sequence[CurveView], int | None, frozenset[int], frozenset[int]]
        self._rendered = ((), 0, frozenset(), frozenset())

    def render(
        self,
        views: Sequence[CurveView],
        active: int | None,
        selected: frozenset[int],
        edited: frozenset[int],
    ) -> None:
        """Show the curves of a document: the active one if it is edited, the selected and the edited ones."""
        before, self._rendered = self._rendered, (views, active, selected, edited)
        self.areas.render(views)
        self._ends.render(views)
        if not self._only_active_moved_since(*before):
            self._render_all()
        elif self._edited_indices:
            self.edited.render(tuple(views[index] for index in self._edited_indices))

    def follow_drag(self, views: Sequence[CurveView]) -> None:
        """Show the same curves after a move: called at every step of a drag."""
        self.render(views, *self._rendered[1:])

    def _only_active_moved_since(
        self, views: Sequence[CurveView], active: int | None, *index_sets: frozenset[int]
    ) -> bool:
        """Whether nothing has changed but the run of the active curve, as during a drag."""
        now, *others = self._rendered
        if active is None or others != [active, *index_sets] or not active < len(now) == len(views):
            return False
        if list(compress(range(len(now)), map(is_not, now, views))) not in ([], [active]):
            return False
        new, old = now[active], views[active]
        return (
            new.source.style is old.source.style
            and new.source.visible is old.source.visible
            and new.source.shape == old.source.shape
            # During a drag there is a curve in every frame.
            and (
                (new.displacement is not None and old.displacement is not None)
                or is_faint(new) is is_faint(old)
            )
        )

    def _render_all(self) -> None:
        views, active, selected, edited = self._rendered
        # The points of the selected curves are shown only while a curve is edited.
        self.selected.set_rings(active is not None)
        active = -1 if active is None else active
        other = [index for index in range(len(views)) if index != active]
        to_find = [
            (index, views[index])
            for index in other
            if index not in selected and views[index].source.visible and views[index].has_curve
        ]
        all_shapes = list(shape_ranges([view.source for view in views]))
        below, shape, above = self._layered(views, all_shapes, active, selected)
        self.others.render_shapes(below, to_find)
        visible = ((index, views[index]) for index in other if views[index].source.visible)
        self._locked.render([pair for pair in visible if pair[1].source.locked and pair[1].has_curve])
        edited_shapes = (indices for indices in all_shapes if shape and active in indices)
        self._edited_indices = next(edited_shapes, range(0))
        self.edited.render(shape)
        self.above.render_shapes(above, [])
        self.selected.render(views, [index for index in other if index in selected])
        siblings = [index for index in other if index in edited and index not in selected]
        self.siblings.render_shapes({index: (views[index],) for index in siblings}, [])
        self.curve.set_covered(bool(above))

    def _layered(
        self, views: Sequence[CurveView], all_shapes: Sequence[range], active: int, selected: Collection[int]
    ) -> tuple[dict[int, Shape], Shape, dict[int, Shape]]:
        """Return the shapes below the edited one, the edited one unless it is a plain line, and those above.

        The key of a shape is the index of its first curve. Without an edited one, −1, all are below.
        """
        below: dict[int, Shape] = {}
        above: dict[int, Shape] = {}
        edited: Shape = ()
        is_layered, marked = False, {active, *selected}
        for indices in all_shapes:
            is_line = is_plain(views[indices.start])
            if active in indices and not is_line and not is_faint(views[active]):
                edited, is_layered = tuple(views[index] for index in indices), True
                continue
            # The `CurveLayer` draws a plain or faint edited line; selected lines are drawn by their marks.
            hidden = marked if is_line else (active,)
            shape = tuple(
                [
                    view
                    for index in indices
                    if index not in hidden and (view := views[index]).source.visible and view.has_curve
                ]
            )
            if shape:
                is_over = indices.start > active >= 0
                is_layered |= is_over and not is_line
                (above if is_over else below)[indices.start] = shape
        return (below, edited, above) if is_layered else (below | above, edited, {})

    def hit(self, pixel: Vector, pixel_map: PixelMap) -> Hit | None:
        """Return the curve at `pixel` that is neither edited nor locked."""
        _, active, *_ = self._rendered
        line = self.selected.hit(pixel, pixel_map) or self.others.hit(pixel, pixel_map)
        return self.areas.hit(pixel, pixel_map, active, line)

    def nearest_end(self, pixel: Vector, pixel_map: PixelMap) -> NearestPart | None:
        """Return the end of another open curve at `pixel`, unless a fill covers it."""
        _, active, *_ = self._rendered
        nearest = self._ends.nearest(active, pixel, pixel_map)
        if nearest is None:
            return None
        end = Hit(Part.OTHER_CURVE, nearest.hit.curve, nearest.hit.position)
        return nearest if self.areas.hit(pixel, pixel_map, active, end) is end else None

    def locked_at(self, pixel: Vector, pixel_map: PixelMap) -> int:
        """Return the index of the locked curve at `pixel`, −1 for none; a press passes through it."""
        hit = self._locked.hit(pixel, pixel_map)
        return hit.index if hit is not None else -1

    def set_cased(self, cased: bool) -> None:
        """Draw plain lines with a casing of paper over a picture to trace, or without."""
        for layer in (self.others, self.above, self.curve):
            layer.set_cased(cased)
