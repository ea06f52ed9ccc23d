"""Matrices (2, 3) of SVG: transforms, and what a view box does.

Reference: CSS Transforms 1, sections 5, 8 and 13.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from math import cos, isfinite, pi, radians, sin, tan

import numpy as np
from numpy.typing import ArrayLike

from curvecore.arrays import FloatArray

from ..errors import ExchangeError
from .lengths import NUMBER, Viewport

_REST = re.compile(r"[ \t\r\n,]*\Z")
_CALL = re.compile(r"[\s,]*([A-Za-z]+(?:3[dD])?)\s*\(([^()]*)\)")
_ARGUMENT = re.compile(rf"({NUMBER})(%|[a-z]*)", re.IGNORECASE)
_DEGREES = {"": 1.0, "deg": 1.0, "grad": 0.9, "rad": 180 / pi, "turn": 360.0}
_KEYWORDS = {"left": "0", "top": "0", "center": "50%", "right": "100%", "bottom": "100%"}
_NO_BOX = Viewport()
_ALIGN = re.compile(r"\s*(?:defer\s+)?x(Min|Mid|Max)Y(Min|Mid|Max)(?:\s+(meet|slice))?\s*")
_SHARES = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}

Box = tuple[float, float, float, float]
"""x, y, width and height, y down."""


def transform_of(
    text: str, box: Viewport = _NO_BOX, origin: str = "", corner: tuple[float, float] = (0.0, 0.0)
) -> FloatArray:
    """Return the matrix of a list of transforms, as attributes and as CSS have them.

    Parameters
    ----------
    text
        The list.
    box
        The box that lengths in percent are parts of.
    origin
        The place in it that the transforms are about, as `transform-origin` has it; by default its corner.
    corner
        The corner of the box.

    Raises
    ------
    ExchangeError
        With the place in it, or the part of it, that is broken, that is no transform of a plane, or that has
        a length which nobody knows.
    """
    result, place = np.eye(2, 3), 0
    # Every call takes some of the text, and none of it is copied to see whether there is more.
    while not _REST.match(text, place):
        match = _CALL.match(text, place)
        if match is None:
            raise ExchangeError(f"at character {place + 1}")
        result = combined(result, _one_transform(match[1], match[2], box))
        place = match.end()
    x, y = _place_in(box, origin) if origin else (0.0, 0.0)
    return _about(corner[0] + x, corner[1] + y, result)


def _one_transform(name: str, arguments: str, box: Viewport) -> FloatArray:
    try:
        kinds, matrix = _MATRICES[name.lower()]
        words = _ARGUMENT.findall(arguments)
        if _ARGUMENT.sub("", arguments).strip(" \t\r\n,") or len(words) > len(kinds):
            raise ValueError
        values = [_argument(kind, word, box) for kind, word in zip(kinds, words, strict=False)]
        return np.array(matrix(*values), dtype=float)
    except (KeyError, TypeError, ValueError):
        raise ExchangeError(f"“{name}({arguments})"[:40] + "”") from None


def _argument(kind: str, word: tuple[str, str], box: Viewport) -> float:
    """Return a number ("n"), an angle in degrees ("a"), or a length along x or y ("x", "y")."""
    number, unit = word
    if kind in "xy":
        value = box.length(number + unit, kind)
    elif kind == "a":
        value = float(number) * _DEGREES[unit.lower()]
    else:
        value = float(number) / {"": 1.0, "%": 100.0}[unit]
    if value is None or not isfinite(value):
        raise ValueError
    return value


def _place_in(box: Viewport, origin: str) -> tuple[float, float]:
    """Return the place in a box that a `transform-origin` has."""
    words = [*origin.lower().split()[:2], "center"]
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words[:2] = words[1::-1]
    try:
        x, y = (box.length(_KEYWORDS.get(word, word), axis) for word, axis in zip(words, "xy", strict=False))
    except ExchangeError:
        x = y = None
    if x is None or y is None:
        raise ExchangeError(f"about “{origin[:40]}”")
    return x, y


def _about(x: float, y: float, matrix: FloatArray) -> FloatArray:
    """Return a transform about the origin as one about another place."""
    result = matrix.copy()
    with np.errstate(all="ignore"):
        result[:, 2] += (x, y) - result[:, :2] @ (x, y)
    return result


def _rotation(degrees: float, *centre: float) -> FloatArray:
    angle = radians(degrees)
    x, y = centre or (0.0, 0.0)
    return _about(x, y, np.array([[cos(angle), -sin(angle), 0.0], [sin(angle), cos(angle), 0.0]]))


_MATRICES: dict[str, tuple[str, Callable[..., ArrayLike]]] = {
    "matrix": ("nnnnxy", lambda a, b, c, d, e, f: ((a, c, e), (b, d, f))),
    "translate": ("xy", lambda x, y=0.0: ((1, 0, x), (0, 1, y))),
    "translatex": ("x", lambda x: ((1, 0, x), (0, 1, 0))),
    "translatey": ("y", lambda y: ((1, 0, 0), (0, 1, y))),
    "translate3d": ("xyx", lambda x, y, _z: ((1, 0, x), (0, 1, y))),
    "translatez": ("x", lambda _z: np.eye(2, 3)),
    "scale": ("nn", lambda x, y=None: ((x, 0, 0), (0, x if y is None else y, 0))),
    "scalex": ("n", lambda x: ((x, 0, 0), (0, 1, 0))),
    "scaley": ("n", lambda y: ((1, 0, 0), (0, y, 0))),
    "scale3d": ("nnn", lambda x, y, _z: ((x, 0, 0), (0, y, 0))),
    "rotate": ("axy", _rotation),
    "rotatez": ("a", _rotation),
    "skew": ("aa", lambda x, y=0.0: ((1, tan(radians(x)), 0), (tan(radians(y)), 1, 0))),
    "skewx": ("a", lambda x: ((1, tan(radians(x)), 0), (0, 1, 0))),
    "skewy": ("a", lambda y: ((1, 0, 0), (tan(radians(y)), 1, 0))),
}
"""The kinds of arguments of each transform, see `_argument`, and its matrix (2, 3)."""


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
