"""Matrices (2, 3) of SVG: transforms, and what a view box does."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import cos, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray

from ..errors import ExchangeError

_REST = re.compile(r"[ \t\r\n,]*\Z")
_CALL = re.compile(r"[\s,]*([A-Za-z]+)\s*\(([^()]*)\)")
_CSS_UNIT = re.compile(r"(deg|px)$", re.IGNORECASE)
_ALIGN = re.compile(r"\s*(?:defer\s+)?x(Min|Mid|Max)Y(Min|Mid|Max)(?:\s+(meet|slice))?\s*")
_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}

Box = tuple[float, float, float, float]
"""x, y, width and height, y down."""


def transform_of(text: str) -> FloatArray:
    """Return the matrix of a list of transforms.

    Raises
    ------
    ExchangeError
        With the place where it is broken.
    """
    result, place = np.eye(2, 3), 0
    # Every call takes some of the text, and none of it is copied to see whether there is more.
    while not _REST.match(text, place):
        match = _CALL.match(text, place)
        if match is None:
            raise ExchangeError(f"at character {place + 1}")
        result = combined(result, _one_transform(match[1], match[2]))
        place = match.end()
    return result


def _one_transform(name: str, arguments: str) -> FloatArray:
    try:
        words = [each for each in re.split(r"[\s,]+", arguments.strip()) if each]
        values = [float(_CSS_UNIT.sub("", each)) for each in words]
        if not np.isfinite(values).all():
            raise ValueError
        return np.array(_MATRICES[name](*values), dtype=float)
    except (KeyError, TypeError, ValueError):
        raise ExchangeError(f"“{name}({arguments})"[:40] + "”") from None


def _rotation(degrees: float, *centre: float) -> FloatArray:
    """Return the rotation about the origin, or about another centre."""
    angle = radians(degrees)
    x, y = centre or (0.0, 0.0)
    turn = np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0]])
    turn[:, 2] = (x, y) - turn[:, :2] @ (x, y)
    return turn


_MATRICES: dict[str, Callable[..., ArrayLike]] = {
    "matrix": lambda a, b, c, d, e, f: ((a, c, e), (b, d, f)),
    "translate": lambda x, y=0.0: ((1, 0, x), (0, 1, y)),
    "translateX": lambda x: ((1, 0, x), (0, 1, 0)),
    "translateY": lambda y: ((1, 0, 0), (0, 1, y)),
    "scale": lambda x, y=None: ((x, 0, 0), (0, x if y is None else y, 0)),
    "rotate": _rotation,
    "skewX": lambda degrees: ((1, tan(radians(degrees)), 0), (0, 1, 0)),
    "skewY": lambda degrees: ((1, 0, 0), (tan(radians(degrees)), 1, 0)),
}
"""The matrix (2, 3) of each transform, by its name and arguments."""


def combined(outer: FloatArray, inner: FloatArray) -> FloatArray:
    """Return the matrix that does the inner one first."""
    with np.errstate(all="ignore"):
        result = outer[:, :2] @ inner
        result[:, 2] += outer[:, 2]
    return result


def moved(points: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return points (…, 2) where a matrix puts them."""
    with np.errstate(all="ignore"):
        return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def shifting(x: float, y: float) -> FloatArray:
    """Return the matrix that shifts."""
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y]])


def largest_scale(matrix: FloatArray) -> float:
    """Return by how much a matrix stretches at most."""
    return float(np.linalg.norm(matrix[:, :2], 2))


def mean_scale(matrix: FloatArray) -> float:
    """Return the square root of by how much a matrix enlarges areas."""
    with np.errstate(all="ignore"):
        return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def is_uneven(matrix: FloatArray) -> bool:
    """Whether a matrix stretches more in one direction than in another."""
    most, least = np.linalg.svd(matrix[:, :2], compute_uv=False)
    return bool(most > least * (1 + 1e-4))


def box_of(text: str) -> Box | None:
    """Return a view box; None where there is none that shows anything."""
    try:
        x, y, width, height = (float(each) for each in re.split(r"[\s,]+", text.strip()))
    except ValueError:
        return None
    is_usable = width > 0 and height > 0 and bool(np.isfinite((x, y, width, height)).all())
    return (x, y, width, height) if is_usable else None


def fitted_box(box: Box, place: Box, ratio: str) -> FloatArray:
    """Return the matrix from a view box to the place that it fills, as `preserveAspectRatio` says."""
    across, down = place[2] / box[2], place[3] / box[3]
    match = _ALIGN.fullmatch(ratio or "xMidYMid")
    x_share = y_share = 0.0
    if ratio.strip().split(" ")[0] != "none":
        x_share, y_share = (_SHARES[match[1]], _SHARES[match[2]]) if match else (0.5, 0.5)
        is_slice = match is not None and match[3] == "slice"
        across = down = max(across, down) if is_slice else min(across, down)
    x = place[0] + (place[2] - across * box[2]) * x_share - across * box[0]
    y = place[1] + (place[3] - down * box[3]) * y_share - down * box[1]
    return np.array([[across, 0.0, x], [0.0, down, y]])
