"""The layers of the basis panel: functions, t-rail and scrub line."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from functools import lru_cache

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF

from curvecore.arrays import BoolArray, FloatArray, IntArray

from ...appearance.colours import point_colours
from ...appearance.theme import Theme, mix
from ...plotting.camera import GREATEST_SPAN, CameraOverT
from ...plotting.layers import Layer
from ...plotting.pens import with_dashes
from ...plotting.pixel_map import PixelMap
from ...plotting.plot_widget import PlotWidget
from ...plotting.stamps import Stamps
from ...plotting.tool_plot import ToolPlot
from ...view_model.basis import BasisView, CardinalView, basis_view, cardinal_view
from ...view_model.curve.curve_view import CurveView
from ...view_model.line_styles import KIND_DASHES
from ...view_model.palette import colour_on
from .function_lines import CrestNames, FunctionDrawing, FunctionLines, drawing_of, room_above

_RAIL_HEIGHT = 34.0


def rail_height(scale: float) -> float:
    """Return the height in pixels of the t-rail at the bottom of the plot area."""
    return _RAIL_HEIGHT * scale


_FADED, _CALM = 0.8, 0.9
_NUMBERED_UP_TO = 40
_MOST_EMPHASISED = 32
_NEIGHBOURS = 2
_OUTLINE, _FILL = 0.5, 0.07
_MARKED_ONE_BY_ONE = 16
"""Number of ticks up to which each is drawn; more are stamped as far as there is room."""

_LEAST_TICK_GAP = 4.0
"""Smallest distance in pixels of ticks at rest: closer ones would merge into a ribbon."""

_NODE_RADIUS = 3.0
_IDLE = 0.6
"""Share of the colour in the rim of an idle tick, mixed with paper."""

_MOST_PEN_SETS = 24
"""Largest number of cached sets of pens: one for each kind, opacity, width and theme."""


class FunctionLayer(Layer):
    """Layer of all basis functions."""

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.kinds: frozenset[int] = frozenset(range(len(KIND_DASHES)))
        self.emphasised: frozenset[int] = frozenset()
        self._basis: BasisView | None = None
        self._lines: FunctionLines | None = None
        self._names = CrestNames(plot, self.update)

    def render(self, basis: BasisView | None) -> None:
        """Draw these functions from the next paint on."""
        self._basis = basis
        self.update()

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw the lines 0 and 1, the functions, and the emphasised ones on top."""
        above_rail = QRectF(0, 0, pixel_map.width, pixel_map.height - rail_height(self.scale))
        painter.setClipRect(above_rail, Qt.ClipOperation.IntersectClip)
        self._paint_levels(painter, pixel_map)
        if self._basis is None:
            return
        if self._lines is None or not self._lines.are_of(self._basis, pixel_map):
            self._lines = FunctionLines(self._basis, pixel_map, self._lines)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        if drawing_of(self._basis) is FunctionDrawing.EACH:
            self._paint_all(painter, self._basis)
            kinds = self._basis.drawn_kinds(self.kinds)
            painter.setFont(self._number_font())
            self._names.paint(painter, pixel_map, self._basis, kinds, self.theme, self.scale)
        else:
            self._paint_together(painter, self._basis)

    def _number_font(self) -> QFont:
        return self.fonts.less(1.5, self.scale)

    def room_above(self) -> float:
        """Return the height in pixels of a number above its crest."""
        return room_above(self._number_font(), self.scale)

    def _paint_levels(self, painter: QPainter, pixel_map: PixelMap) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        for level in (0.0, 1.0):
            y = round(pixel_map.point(0.0, level)[1])
            painter.drawLine(0, y, int(pixel_map.width), y)

    def _paint_all(self, painter: QPainter, basis: BasisView) -> None:
        opacity = _FADED if self.emphasised else _CALM
        self._paint_functions(painter, basis, basis.drawn, 1.0, opacity, without=self.emphasised)
        self._paint_emphasised(painter, basis)

    def _paint_together(self, painter: QPainter, basis: BasisView) -> None:
        """Draw many functions in one call; the emphasised ones and their neighbours in their colours."""
        assert self._lines is not None
        for kind in basis.drawn_kinds(self.kinds):
            outline = QColor(self.theme.ink)
            outline.setAlphaF(_OUTLINE)
            pen = QPen(outline, self.scale)
            if drawing_of(basis) is FunctionDrawing.SPANS:
                painter.setPen(pen)
                self._lines.spans(kind).draw(painter)
                continue
            fill = QColor(self.theme.ink)
            fill.setAlphaF(_FILL)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setPen(QPen(fill, 1))
            self._lines.band(kind).draw(painter)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
            painter.setPen(with_dashes(pen, KIND_DASHES[kind]))
            painter.drawPolyline(self._lines.edge(kind, upper=False))
            painter.drawPolyline(self._lines.edge(kind, upper=True))
        if len(self.emphasised) <= _MOST_EMPHASISED:
            self._paint_functions(painter, basis, self._neighbours(basis), 1.0, 1.0, without=self.emphasised)
            self._paint_emphasised(painter, basis)

    def _neighbours(self, basis: BasisView) -> Sequence[int]:
        """Return the knots near the emphasised ones."""
        knots = {k + step for k in self.emphasised for step in range(-_NEIGHBOURS, _NEIGHBOURS + 1)}
        return [knot for knot in sorted(knots) if 0 <= knot < basis.count]

    def _paint_emphasised(self, painter: QPainter, basis: BasisView) -> None:
        knots = sorted(owner for owner in self.emphasised if owner < basis.count)
        if knots and knots[0] == 0 and basis.owners[basis.drawn[-1]] == 0:
            knots.append(basis.count - 1)
        self._paint_functions(painter, basis, knots, 2.0, 1.0)

    def _paint_functions(
        self,
        painter: QPainter,
        basis: BasisView,
        knots: Sequence[int],
        width: float,
        opacity: float,
        without: frozenset[int] = frozenset(),
    ) -> None:
        assert self._lines is not None
        wide = width * self.scale
        kinds = [
            (kind, _pens(basis.point_count, self.theme, opacity, wide, kind))
            for kind in basis.drawn_kinds(self.kinds)
        ]
        for knot in knots:
            owner = basis.owners[knot]
            if owner in without:
                continue
            for kind, pens in kinds:
                painter.setPen(pens[owner])
                if kind == 0 and wide > 1:
                    # Qt takes many times as long for a single wide line.
                    self._lines.wide(knot, kind, wide).draw(painter)
                else:
                    painter.drawPolyline(self._lines.function(knot, kind))


class RailLayer(Layer):
    """The t-rail: a tick for each t_i in the colour of its point; and the scrub line above it."""

    z = 10.0

    def __init__(self, plot: PlotWidget) -> None:
        super().__init__(plot)
        self.selection: frozenset[int] = frozenset()
        self.hovered = -1
        self.scrub: float | None = None
        self.parameters: FloatArray = np.empty(0)
        self._t_text: Callable[[float], str] = str
        # Nodes (Greville abscissae) of control points, None for points on the curve; ticks without effect.
        self.nodes: FloatArray | None = None
        self._idle: BoolArray = np.empty(0, dtype=np.bool_)
        self._stamps = Stamps(lambda painter, size, _form: _tick(painter, size))
        self._count = 0

    def render(self, view: CurveView) -> None:
        """Draw a tick at every knot from the next paint on."""
        self.parameters, self._t_text = view.ticks, view.t_text
        self._count = len(view.source.points)
        curve = view.curve if view.is_current else None
        self.nodes = None if curve is None or curve.interpolates else curve.nodes
        self._idle = np.zeros(len(self.parameters), bool) if curve is None else curve.idle_parameters
        self.update()

    def owner(self, knot: int) -> int:
        """Return the point of a knot; the last knot of a closed curve belongs to the first point."""
        return knot % self._count

    @property
    def visible_nodes(self) -> FloatArray | None:
        """The parameters near which control points act most; None where they are not drawn."""
        return self.nodes if self._count <= _NUMBERED_UP_TO else None

    def paint(self, painter: QPainter, pixel_map: PixelMap) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        top = pixel_map.height - rail_height(self.scale)
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        painter.drawLine(QPointF(0, round(top) + 0.5), QPointF(pixel_map.width, round(top) + 0.5))
        self._paint_ticks(painter, pixel_map, top)
        if (nodes := self.visible_nodes) is not None:
            self._paint_nodes(painter, pixel_map.x(nodes), top)
        if self.scrub is not None:
            self._paint_scrub(painter, pixel_map, self.scrub)

    def _paint_ticks(self, painter: QPainter, pixel_map: PixelMap, top: float) -> None:
        count = self._count
        x = pixel_map.x(self.parameters)
        visible = np.flatnonzero((x > -20) & (x < pixel_map.width + 20))
        if len(visible) > _MARKED_ONE_BY_ONE:
            visible = self._stamp_ticks(painter, x, visible, count, top)
        colours = point_colours(count, self.theme)
        last = self.selection | {self.hovered}
        order = sorted(visible.tolist(), key=lambda knot: self.owner(knot) in last)
        numbers_right_of = -np.inf
        painter.setFont(self.fonts.less(1.5, self.scale))
        for index in order:
            pixel, owner = float(x[index]), self.owner(index)
            self._paint_tick(painter, pixel, top, owner, colours[owner])
            is_strong = owner in last
            if is_strong or (len(x) <= _NUMBERED_UP_TO and pixel > numbers_right_of):
                self._paint_number(painter, pixel, top, owner, is_strong=is_strong)
                numbers_right_of = pixel + 16 * self.scale if not is_strong else numbers_right_of

    def _paint_nodes(self, painter: QPainter, x: FloatArray, top: float) -> None:
        """Draw a disc on the rail's edge where each control point acts most: its Greville abscissa."""
        radius = _NODE_RADIUS * self.scale
        painter.setPen(QPen(self.theme.paper, self.scale))
        for pixel, colour in zip(x.tolist(), point_colours(self._count, self.theme), strict=True):
            painter.setBrush(colour)
            painter.drawEllipse(QPointF(pixel, top), radius, radius)

    def _stamp_ticks(
        self, painter: QPainter, x: FloatArray, visible: IntArray, count: int, top: float
    ) -> IntArray:
        """Draw as many ticks as there is room for; return the emphasised ones, to be drawn in any case."""
        minimum = _LEAST_TICK_GAP * self.scale
        is_idle = self._idle[visible]
        ticks, gap = spread_out(x, visible[~is_idle], minimum)
        # In steps: every size is stamped anew, which a drag must not do.
        room = gap // 2 - 1 if math.isfinite(gap) else gap  # a single tick has room enough
        size = min(max(room, 0.5 * minimum), 5.0 * self.scale)
        centres = np.column_stack([x[ticks], np.full(len(ticks), top + 1 + size)])
        owners = ticks % max(count, 1)
        if is_idle.any():
            self._paint_idle(painter, x[spread_out(x, visible[is_idle], minimum)[0]], top + 1 + size, size)
        self._stamps.draw(painter, centres, owners, count, self.theme, size, 0.0)
        emphasised = {self.hovered}
        if len(self.selection) <= _MOST_EMPHASISED:
            emphasised |= self.selection
        return np.array([knot for knot in emphasised if 0 <= knot < count], dtype=np.intp)

    def _paint_idle(self, painter: QPainter, x: FloatArray, y: float, size: float) -> None:
        """Draw ticks without an effect hollow."""
        painter.setBrush(self.theme.paper)
        painter.setPen(QPen(self.theme.muted, self.scale))
        for pixel in x.tolist():
            painter.translate(pixel, y)
            _tick(painter, size)
            painter.translate(-pixel, -y)

    def _paint_tick(self, painter: QPainter, x: float, top: float, index: int, colour: QColor) -> None:
        size = (6.5 if index == self.hovered or index in self.selection else 5.0) * self.scale
        tip = QPointF(x, top + 1)
        base = top + 1 + 2 * size
        selected = index in self.selection
        rim = self.theme.accent if selected else self.theme.paper
        if self._idle[index % len(self._idle)]:
            # Hollow: dragging the tick has no effect.
            colour, rim = self.theme.paper, rim if selected else mix(colour, self.theme.paper, _IDLE)
        painter.setBrush(colour)
        painter.setPen(QPen(rim, 1.5 * self.scale))
        painter.drawPolygon(QPolygonF([tip, QPointF(x + size, base), QPointF(x - size, base)]))

    def _paint_number(self, painter: QPainter, x: float, top: float, index: int, *, is_strong: bool) -> None:
        box = QRectF(x - 20, top + 13 * self.scale, 40, rail_height(self.scale) - 13 * self.scale)
        if is_strong:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self.theme.paper)
            painter.drawRect(QRectF(x - 9 * self.scale, box.top() + 3, 18 * self.scale, box.height() - 4))
        painter.setPen(self.theme.ink if is_strong else self.theme.muted)
        painter.drawText(box, int(Qt.AlignmentFlag.AlignCenter), str(index))

    def _paint_scrub(self, painter: QPainter, pixel_map: PixelMap, t: float) -> None:
        x = pixel_map.point(t, 0.0)[0]
        painter.setPen(QPen(self.theme.accent, 1.5 * self.scale))
        painter.drawLine(QPointF(x, 0), QPointF(x, pixel_map.height - rail_height(self.scale)))
        size = 6 * self.scale
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self.theme.accent)
        painter.drawPolygon(QPolygonF([QPointF(x - size, 0), QPointF(x + size, 0), QPointF(x, 1.5 * size)]))
        painter.setPen(self.theme.accent)
        text = f"t = {self._t_text(t)}"
        width = painter.fontMetrics().horizontalAdvance(text) + 2.0
        left = x > pixel_map.width - width - 8
        box = QRectF(x - 8 - width if left else x + 8, 2, width, painter.fontMetrics().height())
        painter.fillRect(box.adjusted(-2, -2, 2, 2), self.theme.paper)
        side = Qt.AlignmentFlag.AlignRight if left else Qt.AlignmentFlag.AlignLeft
        painter.drawText(box, int(side | Qt.AlignmentFlag.AlignTop), text)


@lru_cache(maxsize=_MOST_PEN_SETS)
def _pens(count: int, theme: Theme, opacity: float, width: float, kind: int) -> tuple[QPen, ...]:
    """Return the pens of the functions of one kind, by point; a drag needs sixty of them in every frame.

    Colours are mixed with the paper as far as their contrast allows: Qt draws opaque lines a third faster
    than translucent ones.
    """
    paper = theme.paper.name()
    mixed = (mix(colour, theme.paper, opacity).name() for colour in point_colours(count, theme))
    colours = (QColor(colour_on(paper, colour)) for colour in mixed)
    # Square caps of one pixel take no time; of wider lines, short dashes should be round dots.
    cap = Qt.PenCapStyle.RoundCap if width > 1 and kind == 0 else Qt.PenCapStyle.SquareCap
    pens = (QPen(colour, width, Qt.PenStyle.SolidLine, cap) for colour in colours)
    return tuple(with_dashes(pen, KIND_DASHES[kind]) for pen in pens)


def spread_out(x: FloatArray, ticks: IntArray, least: float) -> tuple[IntArray, float]:
    """Return ticks that lie at least `least` pixels apart, and the median gap between them.

    Parameters
    ----------
    x
        The pixels of all ticks, ascending.
    ticks
        The indices of the ticks to draw, ascending.
    """
    gaps = np.diff(x[ticks])
    if len(gaps) and gaps.min() < least:
        pixels, result, index = x[ticks].tolist(), list[int](), 0
        while index < len(pixels):
            result.append(index)
            index = bisect_left(pixels, pixels[index] + least, index + 1)
        ticks = ticks[result]
        gaps = np.diff(x[ticks])
    return ticks, float(np.sort(gaps)[len(gaps) // 2]) if len(gaps) else math.inf


def _tick(painter: QPainter, size: float) -> None:
    painter.drawPolygon(QPolygonF([QPointF(0, -size), QPointF(size, size), QPointF(-size, size)]))


_CALM_RANGE = (-0.5, 1.2)
_MOST_ROOM = 0.2  # for numbers above the functions, of the height that these have
_PADDING = 0.035
_SUBJECT = "The basis functions"


class BasisScene(QObject):
    """The layers of the basis panel, and the ranges that show them.

    Attributes
    ----------
    functions, rail
        All basis functions of the active curve; the t-rail with the scrub line.
    basis
        The functions on the screen, None without a curve.
    with_estimates
        Whether the functions include the estimates that depend on each point.

    Signals
    -------
    extent_changed
        (least, greatest) value of the functions if they leave the visible range, else None.
    """

    extent_changed = Signal(object)

    def __init__(self, plot: ToolPlot, camera: CameraOverT) -> None:
        super().__init__(plot)
        self._plot, self._camera = plot, camera
        self._box = plot.getViewBox()
        self._view: CurveView | None = None
        self.basis: BasisView | None = None
        self._values: tuple[float, float] = _CALM_RANGE
        self._held_domain: tuple[float, float] | None = None
        self.functions = FunctionLayer(plot)
        self.rail = RailLayer(plot)
        self._box.sigResized.connect(self.show_values)
        self.set_with_estimates(False)

    def render_view(self, view: CurveView) -> None:
        """Show the functions of `view`, sampled again only if they have changed."""
        self._view = view
        shows_cardinals = self.with_estimates and view.source.family.derivatives > 0
        if _is_of(self.basis, view, shows_cardinals):
            return
        before = self._domain_of_ticks()
        self.basis = cardinal_view(view) if shows_cardinals else basis_view(view, self.basis)
        self.functions.render(self.basis)
        self.rail.render(view)
        domain = self._domain_of_ticks()
        moved = domain is not None and domain != before
        was_held = self._held_domain is not None and self._domain() == self._held_domain
        if (moved or not view.source.points) and not self._plot.is_dragging and not was_held:
            self.fit_domain()
        self._report_extent()

    def set_with_estimates(self, with_estimates: bool) -> None:
        """Show cardinal functions, which include estimates, or the family's own, from the next view on."""
        self.with_estimates = with_estimates
        name, subject = (
            ("Cardinal functions", "The effect of each point")
            if with_estimates
            else ("Basis functions", _SUBJECT)
        )
        self._plot.setAccessibleName(name)
        self._plot.setAccessibleDescription(f"{subject} over t; drag a tick at the bottom to change t.")

    def set_selection(self, selection: frozenset[int]) -> None:
        """Draw the functions of these points thick."""
        if selection != self.rail.selection:
            self.rail.selection = selection
            self._emphasise()

    def set_hovered(self, index: int) -> None:
        """Draw the functions of the hovered point thick as well (−1 for none)."""
        if index != self.rail.hovered:
            self.rail.hovered = index
            self._emphasise()

    def _emphasise(self) -> None:
        hovered = self.rail.hovered
        self.functions.emphasised = self.rail.selection | ({hovered} if hovered >= 0 else frozenset())
        self.functions.update()
        self.rail.update()

    def set_scrub(self, t: float | None) -> None:
        """Move the scrub line, or hide it (None)."""
        self.rail.scrub = t
        self.rail.update()

    def switch_kind(self, kind: int) -> None:
        """Show or hide a kind of functions: 0 for positions, else the order of the derivatives."""
        self.functions.kinds ^= {kind}
        self.functions.update()
        self._report_extent()

    # Ranges

    def fit_domain(self) -> None:
        """Show the whole interval of t."""
        domain = self._domain()
        if domain is not None:
            start, end = domain
            padding = _PADDING * (end - start)
            self._camera.show_t(start - padding, end + padding)

    def hold_domain(self) -> None:
        """Keep the visible interval while a drag changes parameters: ticks must stay under the pointer."""
        self._held_domain = self._domain()

    def release_domain(self) -> None:
        """Show the whole interval if the drag that ends has changed it."""
        held, self._held_domain = self._held_domain, None
        if held is not None and self._domain() != held:
            self.fit_domain()

    def _domain(self) -> tuple[float, float] | None:
        """Return the interval of t; without points, the one that the rule will span; else None."""
        domain = self._domain_of_ticks()
        if domain is not None or self._view is None or self._view.source.points:
            return domain
        rule = self._view.source.parametrization
        return rule.start, rule.end

    def _domain_of_ticks(self) -> tuple[float, float] | None:
        ticks = self.rail.parameters
        return (float(ticks[0]), float(ticks[-1])) if len(ticks) else None

    def fit_values(self) -> None:
        """Show the full range of the functions, up to the longest range of an axis."""
        if self.basis is not None:
            low, high = self.basis.extent(self.functions.kinds)
            maximum = 0.5 * GREATEST_SPAN / (1.0 + self._rail_share())
            low, high = max(low, -maximum), min(high, maximum)
            margin = 0.05 * (high - low)
            low, high = min(low - margin, _CALM_RANGE[0]), max(high + margin, _CALM_RANGE[1])
            self._values = (max(low, -maximum), min(high, maximum))
            self.show_values()

    def calm_values(self) -> None:
        """Show the usual range again, −0.5 to 1.2."""
        self._values = _CALM_RANGE
        self.show_values()

    def show_values(self) -> None:
        """Map the range of values to the part of the plot area above the rail."""
        low, high = self._values
        if self._values == _CALM_RANGE:
            # Room above 1, the crests of the functions, for their numbers in any font.
            room = min(self.functions.room_above() / self._height_above_rail(), _MOST_ROOM)
            high = max(high, (1.0 - room * low) / (1.0 - room))
        self._plot.getAxis("left").set_least(low)
        self._box.setYRange(low - self._rail_share() * (high - low), high, padding=0)
        self._report_extent()

    def _rail_share(self) -> float:
        """Return the height of the rail, relative to the area of the functions."""
        return rail_height(self.rail.scale) / self._height_above_rail()

    def _height_above_rail(self) -> float:
        return max(float(self._box.rect().height()) - rail_height(self.rail.scale), 1.0)

    def _report_extent(self) -> None:
        extent = self.basis.extent(self.functions.kinds) if self.basis is not None else None
        low, high = self._values
        inside = extent is None or (extent[0] >= low and extent[1] <= high)
        self.extent_changed.emit(None if inside else extent)


def _is_of(basis: BasisView | None, view: CurveView, cardinals: bool) -> bool:
    """Return whether these are the functions of `view`.

    Functions of a family depend on its settings and the parameters; cardinal functions on the rules as well.
    """
    if basis is None:
        return False
    if view.displacement is not None and not cardinals and basis.curve is view.displacement.moving.curve:
        # As in most drags: points move, and the functions do not.
        return not isinstance(basis, CardinalView)
    if not view.is_current or len(view.source.points) <= basis.owners[-1]:
        return False
    if cardinals or isinstance(basis, CardinalView):
        return cardinals and isinstance(basis, CardinalView) and basis.cardinal is view.cardinal
    functions = view.basis_curve
    if basis.curve is functions:
        return True
    same_family = functions is not None and basis.curve.functions_key == functions.functions_key
    closes = (basis.owners[-1] == 0) is view.source.is_closed
    return same_family and closes and np.array_equal(view.parameters, basis.curve.parameters)
