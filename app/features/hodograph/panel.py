"""The hodograph: direction and length of a derivative all along the curve."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QFont, QPainter, QPen, QShowEvent
from PySide6.QtWidgets import QButtonGroup, QSizePolicy, QToolButton, QWidget

from ...appearance.colours import point_colours
from ...appearance.icons import icon
from ...appearance.theme import LIGHT, FollowsTheme, Theme
from ...document.derivatives import DERIVATIVES
from ...document.words import number
from ...plotting.drawing import MARGIN, Stroke, draw_segments
from ...plotting.layers import Layer
from ...plotting.pixel_map import PixelMap
from ...plotting.tool_plot import ToolPlot
from ...qt.labels import MUTED
from ...tools.pointer import Hit, Part, Pointer
from ...tools.tool import CanvasQueries
from ...tools.toolbox import Toolbox
from ...view_model.analysis.hodograph import Hodograph
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import choice_style, named, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.number_text import decimal_mark

_MARGIN = 1.12
_NUMBERED_UP_TO = 16
_NAMES = {each.order: ("c" + "′″‴"[each.order - 1], each.name) for each in DERIVATIVES}


class HodographPlot(ToolPlot, CanvasQueries):
    """Draws the hodograph; equal aspect, the origin marked. Drag along the curve to scrub.

    The view box's coordinates are those of the derivative over a power of ten, `unit`: pyqtgraph loses
    ranges above 1e150.
    """

    def __init__(self, tools: Toolbox) -> None:
        super().__init__(tools)
        tools.canvas = self
        named(self, "hodograph", "Hodograph")
        self.setAccessibleDescription("The velocity as a curve in the plane; drag along it to scrub.")
        self.getViewBox().setAspectLocked(True)
        self.hodograph: Hodograph | None = None
        self.scrub: tuple[float, tuple[float, float]] | None = None
        self.owners = 0
        self.unit = 1.0
        self.theme = LIGHT
        self.waits = False
        self.note = ""
        self.is_fitted = True
        self._reach = 0.0
        self._layer = Layer(self, self.paint_layer)
        self.camera.steered.connect(self._leave)

    def render_hodograph(self, hodograph: Hodograph, owners: int, *, calm: bool) -> None:
        """Show a hodograph of a curve with `owners` points; while `calm`, the view only grows."""
        self.hodograph, self.owners, self.waits, self.note = hodograph, owners, False, ""
        if self.is_fitted and (not calm or hodograph.reach > self._reach):
            self.fit()
        self._layer.update()

    def say(self, note: str) -> None:
        """Show a sentence in place of the hodograph."""
        self.hodograph, self.note = None, note
        self._layer.update()

    def refresh(self) -> None:
        """Draw again after one of the attributes was set."""
        self._layer.update()

    def fit(self) -> None:
        """Show the whole hodograph, and the origin."""
        self.is_fitted = True
        if self.hodograph is None:
            return
        self._reach = reach = self.hodograph.reach or 1.0
        self.unit = 10.0 ** np.floor(np.log10(reach)) if not 1e-3 <= reach < 1e5 else 1.0
        for name in ("left", "bottom"):
            self.getAxis(name).set_factor(float(self.unit))
        with np.errstate(all="ignore"):
            points = self.hodograph.points / self.unit
        points = np.vstack([points[np.isfinite(points).all(axis=1)], np.zeros((1, 2))])
        low, high = points.min(axis=0), points.max(axis=0)
        size = max(float((high - low).max()), 1e-6) * (_MARGIN - 1)
        self.camera.show_box((low[0] - size, high[0] + size), (low[1] - size, high[1] + size))

    def _leave(self) -> None:
        self.is_fitted = False

    def set_theme(self, theme: Theme) -> None:
        self.theme = theme
        super().set_theme(theme)

    def hit(self, pointer: Pointer, parts: frozenset[Part]) -> Hit | None:
        """Return the nearest point of the hodograph, at any distance."""
        if self.hodograph is None or not len(self.hodograph.t):
            return None
        pixels = self.pixel_map.points(self.hodograph.points / self.unit)
        with np.errstate(all="ignore"):
            distances = np.nan_to_num(np.hypot(*(pixels - pointer.pixel).T), nan=np.inf)
        t = float(self.hodograph.t[int(np.argmin(distances))])
        return Hit(Part.CURVE, -1, pointer.position, t=t)

    # Painting

    def paint_layer(self, painter: QPainter, pixel_map: PixelMap) -> None:
        """Draw axes through the origin, the hodograph, the derivative at the knots and at the scrub line."""
        theme = self.theme
        if self.hodograph is None:
            painter.setPen(theme.muted)
            flags = int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap)
            area = QRectF(0, 0, pixel_map.width, pixel_map.height)
            painter.drawText(area.adjusted(15, 3, -15, -3), flags, self.note)
            return
        self._paint_origin(painter, pixel_map)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        pen = QPen(theme.ghost if self.waits else theme.curve, 1.8)
        painter.setPen(pen)
        stroke = Stroke()
        with np.errstate(all="ignore"):
            stroke.fill(
                pixel_map.points(self.hodograph.points / self.unit), pixel_map.width, pixel_map.height
            )
        stroke.draw(painter)
        self._paint_knots(painter, pixel_map, self.hodograph)
        if self.scrub is not None:
            self._paint_scrub(painter, pixel_map, self.scrub[1])

    def _paint_origin(self, painter: QPainter, pixel_map: PixelMap) -> None:
        x, y = (round(min(max(coordinate, -9.0), 1e5)) for coordinate in pixel_map.point(0.0, 0.0))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(QPen(self.theme.grid_coarse, 1))
        painter.drawLine(0, y, int(pixel_map.width), y)
        painter.drawLine(x, 0, x, int(pixel_map.height))
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, True)
        painter.setPen(QPen(self.theme.muted, 1.5))
        painter.drawEllipse(QPointF(x, y), 3.5, 3.5)
        painter.setPen(self.theme.muted)
        painter.drawText(QPointF(x + 6, y + 14), "0")

    def _paint_knots(self, painter: QPainter, pixel_map: PixelMap, hodograph: Hodograph) -> None:
        if len(hodograph.knots) > 64:
            return
        colours = point_colours(self.owners, self.theme)
        font = QFont(self.font())
        font.setPointSizeF(max(font.pointSizeF() - 1.5, 7.0))
        painter.setFont(font)
        with np.errstate(all="ignore"):
            pixels = pixel_map.points(hodograph.knots / self.unit)
        for knot, (x, y) in enumerate(pixels.tolist()):
            if not (-MARGIN < x < pixel_map.width + MARGIN and -MARGIN < y < pixel_map.height + MARGIN):
                continue
            painter.setPen(QPen(self.theme.paper, 1))
            painter.setBrush(colours[knot % self.owners])
            painter.drawEllipse(QPointF(x, y), 3.5, 3.5)
            if len(pixels) <= _NUMBERED_UP_TO and knot < self.owners:
                painter.setPen(self.theme.muted)
                painter.drawText(QPointF(x + 6, y - 4), str(knot))
        painter.setBrush(Qt.BrushStyle.NoBrush)

    def _paint_scrub(self, painter: QPainter, pixel_map: PixelMap, value: tuple[float, float]) -> None:
        """Draw an arrow from the origin, and a dot at its end."""
        start = np.array(pixel_map.point(0.0, 0.0))
        end = np.array(pixel_map.point(value[0] / self.unit, value[1] / self.unit))
        if not np.isfinite(end).all():
            return
        painter.setPen(QPen(self.theme.accent, 1.8))
        draw_segments(painter, np.concatenate([start, end])[None], pixel_map)
        if (end >= -MARGIN).all() and (end <= (pixel_map.width + MARGIN, pixel_map.height + MARGIN)).all():
            painter.setPen(QPen(self.theme.paper, 1.5))
            painter.setBrush(self.theme.accent)
            painter.drawEllipse(QPointF(*end.tolist()), 5.0, 5.0)
            painter.setBrush(Qt.BrushStyle.NoBrush)


class HodographPanel(FollowsTheme, QWidget):
    """The hodograph with its header.

    Signals
    -------
    changed
        Another derivative was selected, or the panel became visible.
    """

    changed = Signal()

    def __init__(self, tools: Toolbox, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("hodographPanel")
        self.order = 1
        self.plot = HodographPlot(tools)
        self._value = ElidedLabel("hodographValue", "Derivative at the scrub line", MUTED)
        self._value.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        tip = "Show the whole hodograph, and keep it in view"
        self._fit = tool_button("fitHodograph", "Fit the hodograph", tip, flat=True)
        self._fit.clicked.connect(self.plot.fit)
        self._group = QButtonGroup(self)
        self._choices = QWidget()
        row_of(*map(self._order_button, _NAMES), margins=0, spacing=4, parent=self._choices)
        header = row_of(self._choices, (self._value, 1), self._fit, margins=(10, 4, 8, 4))
        header.insertSpacing(1, 6)
        column_of(header, (self.plot, 1), margins=0, spacing=0, parent=self)
        self.follow_theme()

    def _order_button(self, order: int) -> QToolButton:
        symbol, name = _NAMES[order]
        tip = f"Draw the {name} {symbol}(t), from the origin, for all t"
        button = tool_button(f"hodograph{name.capitalize()}", f"Hodograph of the {name}", tip, text=symbol)
        button.setCheckable(True)
        button.setChecked(order == self.order)
        button.clicked.connect(lambda: self._choose(order))
        self._group.addButton(button)
        return button

    def _choose(self, order: int) -> None:
        self.order = order
        self.plot.is_fitted = True
        self.changed.emit()

    def show_value(self, t: float | None, value: tuple[float, float] | None, t_text: str = "") -> None:
        """Write and draw the derivative at the scrub line; None without one."""
        if t is None or value is None:
            self.plot.scrub = None
            self._value.setText("Press T to show the scrub line")
        else:
            self.plot.scrub = (t, value)
            mark, gap = decimal_mark(), "; " if decimal_mark() == "," else ", "
            x, y = (number(component, 4, mark) for component in value)
            angle = number(float(np.degrees(np.arctan2(value[1], value[0]))), 3, mark)
            name = f"{_NAMES[self.order][0]}({t_text})"
            self._value.setText(f"{name} = ({x}{gap}{y}), {angle}°")
        self.plot.refresh()

    def set_theme(self, theme: Theme) -> None:
        self.plot.set_theme(theme)
        self._choices.setStyleSheet(choice_style(theme))
        self._fit.setIcon(icon("fit", theme))

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.changed.emit()
