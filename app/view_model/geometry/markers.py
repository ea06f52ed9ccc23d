"""Markers where they stand: the outlines of arrowheads at the ends of lines."""

from __future__ import annotations

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.marker import RINGS, MarkerKind
from ...document.style import Style

_LEAST = 1e-12
"""Share of the size of a line below which the way to a control point is no direction."""

_TOUCHED = np.linspace(0.0, 1.0, 33)[:, None, None]


class Ends(msgspec.Struct, frozen=True, eq=False):
    """Ends of an open line, with the directions, unit vectors, in which it would run on from there."""

    start: FloatArray
    before: FloatArray
    end: FloatArray
    after: FloatArray


def ends_of_pieces(controls: FloatArray) -> Ends | None:
    """Return the ends of Bézier pieces (k, m, 2); None where they are all in one place."""
    places = controls.reshape(-1, 2)
    directions = []
    for way in (places - places[0], places[::-1] - places[-1]):
        lengths = np.hypot(way[:, 0], way[:, 1])
        if not lengths.any():
            return None
        first = int((lengths > _LEAST * lengths.max()).argmax())
        directions.append(-way[first] / lengths[first])
    return Ends(places[0], directions[0], places[-1], directions[1])


def markers_of(style: Style, first: Ends | None, last: Ends | None, width: float) -> list[FloatArray]:
    """Return the outlines, (k, 4, 2), of the markers of a shape whose line is so wide.

    They stand where its `first` line begins and its `last` one ends, as in SVG; None stands for a closed one.
    """
    if not style.has_markers:
        return []
    found = []
    if first is not None and style.start_marker is not MarkerKind.NONE:
        found.append(_marker(style.start_marker, first.start, first.before, width))
    if last is not None and style.end_marker is not MarkerKind.NONE:
        found.append(_marker(style.end_marker, last.end, last.after, width))
    return found


def _marker(kind: MarkerKind, place: FloatArray, ahead: FloatArray, width: float) -> FloatArray:
    along, aside = width * ahead, width * np.array([-ahead[1], ahead[0]])
    places = np.array(RINGS[kind])
    ring = place + places[:, :1] * along + places[:, 1:] * aside
    return np.array([ring[at : at + 4] for at in range(0, len(ring) - 1, 3)])


def sampled(pieces: FloatArray) -> FloatArray:
    """Return places along pieces (k, 4, 2), so near to each other that their box is that of the pieces."""
    t, s = _TOUCHED, 1.0 - _TOUCHED
    a, b, c, d = (pieces[:, at] for at in range(4))
    found: FloatArray = s**3 * a + 3 * s**2 * t * b + 3 * s * t**2 * c + t**3 * d
    return found.reshape(-1, 2)
