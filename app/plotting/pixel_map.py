"""Plane to pixels of a plot area and back."""

from __future__ import annotations

from functools import cached_property

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, FloatArray

_LEAST_ROWS = 256
_NO_ROWS = np.empty((2, 0, 2))


class PixelMap(msgspec.Struct, frozen=True, dict=True):
    """An axis-aligned map from the plane to the pixels of a plot area; y points up in the plane.

    Each zoom, pan or resize makes another map: caches that depend on the visible part compare maps.

    >>> view = PixelMap.of_ranges((0.0, 4.0), (0.0, 2.0), width=400.0, height=200.0)
    >>> view.point(1.0, 2.0), view.plane(100.0, 0.0)
    ((100.0, 0.0), (1.0, 2.0))

    Attributes
    ----------
    x0, y0
        The plane's coordinates at the left and the upper edge.
    sx, sy
        Pixels per unit, both positive.
    width, height
        Size of the area in pixels.
    """

    x0: float
    y0: float
    sx: float
    sy: float
    width: float
    height: float

    @classmethod
    def of_ranges(
        cls, x_range: tuple[float, float], y_range: tuple[float, float], width: float, height: float
    ) -> PixelMap:
        """Return the map that shows the two ranges in an area of width × height pixels.

        Raises
        ------
        ValueError
            If a range is empty.
        """
        for start, end in (x_range, y_range):
            if not start < end:
                raise ValueError(f"a range from {start!r} to {end!r} shows nothing")
        # Ranges may be NumPy numbers; pointer positions are computed from them and must be plain floats.
        left, right, lower, upper = map(float, (*x_range, *y_range))
        width, height = max(float(width), 1.0), max(float(height), 1.0)
        return cls(left, upper, width / (right - left), height / (upper - lower), width, height)

    def x(self, values: FloatArray) -> FloatArray:
        """Return horizontal pixels of plane coordinates x."""
        return (values - self.x0) * self.sx

    def y(self, values: FloatArray) -> FloatArray:
        """Return vertical pixels of plane coordinates y."""
        return (self.y0 - values) * self.sy

    def points(self, points: FloatArray) -> FloatArray:
        """Return the pixels (…, 2) of points (…, 2) of the plane."""
        corners, scales = self._rows(points.size // 2)
        pixels: FloatArray = points - corners.reshape(points.shape)
        pixels *= scales.reshape(points.shape)
        return pixels

    def _rows(self, count: int) -> tuple[FloatArray, FloatArray]:
        """Return the upper left corner and the scales `count` times, (count, 2) each.

        One row would do, but NumPy then broadcasts two numbers at a time, which takes four times as long in
        every frame of a drag.
        """
        corners, scales = self.__dict__.get("_known_rows", _NO_ROWS)
        if len(corners) < count:
            corners, scales = np.empty((2, max(count, _LEAST_ROWS), 2))
            corners[:, 0], corners[:, 1] = self.x0, self.y0
            # (y0 − y) · sy is (y − y0) · (−sy), to the last bit.
            scales[:, 0], scales[:, 1] = self.sx, -self.sy
            self.__dict__["_known_rows"] = (corners, scales)
        return corners[:count], scales[:count]

    def point(self, x: float, y: float) -> tuple[float, float]:
        """Return the pixel of one point."""
        return ((x - self.x0) * self.sx, (self.y0 - y) * self.sy)

    def plane(self, pixel_x: float, pixel_y: float) -> tuple[float, float]:
        """Return the point of the plane at a pixel."""
        return (self.x0 + pixel_x / self.sx, self.y0 - pixel_y / self.sy)

    def near(self, pixels: FloatArray, margin: float = 0.0) -> BoolArray:
        """Return which of pixels (n, 2) lie in the area, or in a margin around it."""
        x, y = pixels[:, 0], pixels[:, 1]
        return (x > -margin) & (x < self.width + margin) & (y > -margin) & (y < self.height + margin)

    @cached_property
    def box(self) -> tuple[float, float, float, float]:
        """The visible part of the plane, (x_min, y_min, x_max, y_max)."""
        return (
            self.x0,
            self.y0 - self.height / self.sy,
            self.x0 + self.width / self.sx,
            self.y0,
        )
