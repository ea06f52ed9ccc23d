"""Outlines of what is dark in a picture.

Places are in pixels from the upper left corner of the picture, y downwards; (0.5, 0.5) is the middle of the
first pixel.
"""

from __future__ import annotations

from typing import cast

import contourpy
import numpy as np

from curvecore.arrays import FloatArray

LEVELS = 256
"""Of brightness, by which dark and light are told apart."""

_PAPER = 1.0


def parting_brightness(brightness: FloatArray) -> float:
    """Return the brightness that parts a picture best in dark and light (Otsu's method).

    References
    ----------
    .. [1] N. Otsu, "A threshold selection method from gray-level histograms", IEEE Trans. Systems, Man, and
       Cybernetics 9 (1979) 62-66: the one for which the two classes differ most from each other.
    """
    counts, edges = np.histogram(brightness, bins=LEVELS, range=(0.0, 1.0))
    middles, below = (edges[1:] + edges[:-1]) / 2.0, np.cumsum(counts)
    total, sums = below[-1], np.cumsum(counts * middles)
    with np.errstate(divide="ignore", invalid="ignore"):
        between = (sums[-1] * below - total * sums) ** 2 / (below * (total - below))
    between = np.nan_to_num(between)
    # Between two classes that leave a gap each of its levels is as good: the middle one.
    best = np.flatnonzero(between >= between.max() * (1.0 - 1e-9))
    return float(edges[1:][(best[0] + best[-1]) // 2])


def dark_outlines(brightness: FloatArray, limit: float, least: float) -> list[FloatArray]:
    """Return the closed outlines (m, 2) of what is darker than a limit, at even steps of about a pixel.

    Parameters
    ----------
    brightness
        From 0, black, to 1, (rows, columns).
    limit
        Between 0 and 1.
    least
        Square pixels that an outline encloses at least.
    """
    # Around the picture there is paper, so that all outlines close.
    paper = np.pad(_softened(np.pad(brightness, 1, mode="edge")), 1, constant_values=_PAPER)
    generator = contourpy.contour_generator(z=paper, line_type=contourpy.LineType.Separate)
    lines = cast("list[FloatArray]", generator.lines(limit))
    return [_evenly(line - 0.5) for line in lines if abs(_area(line)) >= least]


def _softened(brightness: FloatArray) -> FloatArray:
    """Return a picture without its outermost pixels, whose edges are no stairs."""
    for _ in range(2):
        soft = 0.5 * brightness[1:-1] + 0.25 * (brightness[:-2] + brightness[2:])
        brightness = soft.T
    return brightness


def _area(line: FloatArray) -> float:
    """Return what a closed line encloses."""
    x, y = (line - line[0]).T
    return float(0.5 * (x[:-1] @ y[1:] - x[1:] @ y[:-1]))


def _evenly(line: FloatArray) -> FloatArray:
    """Return places along a closed line at even steps, the first not again at the end."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    count = max(int(along[-1]), 8)
    at = np.arange(count) * (along[-1] / count)
    return np.stack([np.interp(at, along, column) for column in line.T], axis=1)
