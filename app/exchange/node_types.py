"""Kinds of the points of cubics in letters, as Inkscape notes them: c corner, s smooth, z symmetric."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from curvecore.arrays import FloatArray

from ..document.limits import EditError
from ..document.model import Curve, Point
from ..families import HERMITE
from ..view_model.cubics import CORNER, EVEN, TIED, WRITTEN_BY_PROGRAMS, are_alike, points_of_cubics


def letters_of(curve: Curve, pieces: FloatArray) -> str:
    """Return the letter of each point of a curve that is these pieces, (k, 4, 2); none if it is not."""
    segments = len(curve.points) - (not curve.is_closed)
    if curve.family is not HERMITE or len(pieces) != segments:
        return ""
    return _letters(curve.points, pieces, closed=curve.is_closed)


def guessed(pieces: FloatArray, *, closed: bool) -> str:
    """Return the letters of points that pieces come in with where a file has no letters."""
    if not np.ptp(pieces, axis=1).any(axis=1).all():
        return ""  # a reader leaves out those of no length
    try:
        found = points_of_cubics(pieces, closed=closed, most_turned=WRITTEN_BY_PROGRAMS)
    except EditError:
        return ""
    return _letters(found.points, pieces, closed=closed)


def _letters(points: Sequence[Point], pieces: FloatArray, *, closed: bool) -> str:
    before, after = pieces[:, 3] - pieces[:, 2], np.roll(pieces[:, 1] - pieces[:, 0], -1, axis=0)
    even = np.roll(are_alike(np.hypot(*before.T), np.hypot(*after.T)), 1).tolist()
    if len(points) > len(even) + (not closed):
        # One piece alone came in as two.
        return ""
    inner = [_letter(point, is_even) for point, is_even in zip(points, even, strict=False)]
    return "".join(inner if closed else [CORNER, *inner[1:], CORNER])


def _letter(point: Point, is_even: bool) -> str:
    if point.corner and not point.tied:
        return CORNER
    return EVEN if (point.even if point.tied else is_even) else TIED


def joined(outlines: Sequence[tuple[str, bool]]) -> str:
    """Return the letters of all outlines of a path, each with whether it is closed; none if some have none.

    The first of a closed one stands at its end, too.
    """
    parts = [letters + (letters[:1] if closed else "") for letters, closed in outlines]
    return "".join(parts) if all(parts) else ""


def parted(letters: str, outlines: Sequence[tuple[int, bool]]) -> list[str]:
    """Return the letters of each outline of so many pieces; none where they are not so many."""
    ends = np.cumsum([count + 1 for count, _ in outlines]).tolist()
    if len(letters) != ends[-1]:
        return [""] * len(outlines)
    places = zip(outlines, ends, strict=True)
    return [letters[end - count - 1 : end - closed] for (count, closed), end in places]
