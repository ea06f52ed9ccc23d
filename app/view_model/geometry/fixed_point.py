"""Solving x = g(x) for a few numbers, where each value of g takes a while."""

from __future__ import annotations

import numpy as np

from curvecore.arrays import FloatArray

_NEGLIGIBLE = 1e-10
"""Share of the largest change of a residual below which others say nothing of where to go."""


class Secants:
    """Steps from one x to the next by what g made of the last ones (Anderson's mixing).

    Where g is smooth they come as close in some ten steps as x = g(x) itself does in forty, and they also
    arrive where that goes to and fro.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._tried: list[tuple[FloatArray, FloatArray]] = []

    def after(self, x: FloatArray, image: FloatArray) -> FloatArray:
        """Return the x to be tried next, `image` being what g makes of `x`."""
        self._tried = [*self._tried[-self._most :], (x, image)]
        if len(self._tried) == 1:
            return image
        xs, images = (np.array(each) for each in zip(*self._tried, strict=True))
        residuals = images - xs
        weights, *_ = np.linalg.lstsq(np.diff(residuals, axis=0).T, residuals[-1], rcond=_NEGLIGIBLE)
        nearer: FloatArray = image - weights @ np.diff(images, axis=0)
        return nearer

    def forget(self) -> None:
        """Begin anew, as where the last steps led away."""
        self._tried = []
