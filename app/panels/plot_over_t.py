"""A plot whose x axis is the parameter t."""

from __future__ import annotations

from PySide6.QtCore import QPointF

from app.plotting.plot_widget import PlotWidget


class PlotOverT(PlotWidget):
    """A plot over t: the wheel and panning move along t alone."""

    @property
    def t_range(self) -> tuple[float, float]:
        """The part of t that is visible."""
        start, _, end, _ = self.pixel_map.box
        return start, end

    def set_t_range(self, start: float, end: float) -> None:
        """Show this part of t."""
        self.getViewBox().setXRange(start, end, padding=0)

    def choose_t_range(self, start: float, end: float) -> None:
        """Show the part of t that wheel or panning chose; a subclass that shares its axis asks first."""
        self.set_t_range(start, end)

    def zoom(self, factor: float, pixel: QPointF) -> None:
        """Zoom along t."""
        t, _ = self.to_plane(pixel)
        start, end = self.t_range
        self.choose_t_range(t + (start - t) / factor, t + (end - t) / factor)

    def pan(self, dx: float, dy: float) -> None:
        """Move along t."""
        start, end = self.t_range
        by = -dx / self.pixel_map.sx
        self.choose_t_range(start + by, end + by)
