"""What clips leave of curves: which places of the plane lie within them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

import numpy as np

from curvecore.arrays import FloatArray

from ...document.clip import Clip, ClipRing
from ...document.model import Vector
from ...document.style import FillRule
from .extents import extent_of
from .fills import is_inside, windings

_PIECES = 16
"""Lines that stand for a piece when it is asked what lies within."""


def leave(clips: Sequence[Clip], place: Vector) -> bool:
    """Whether all clips leave what is at a place."""
    return all(_leaves(clip, place) for clip in clips)


def seen_box(box: FloatArray, clips: Iterable[Clip]) -> FloatArray | None:
    """Return what clips leave of a box, lowest and highest corner, (2, 2); None where that is nothing."""
    for clip in clips:
        if not clip.rings:
            return None
        low, high = _box_of(clip)
        box = np.array([np.maximum(box[0], low), np.minimum(box[1], high)])
    return None if (box[0] > box[1]).any() else box


@lru_cache(256)
def _box_of(clip: Clip) -> FloatArray:
    return extent_of(np.concatenate([_pieces_of(ring) for ring in clip.rings]))


def _leaves(clip: Clip, place: Vector) -> bool:
    rule = FillRule.EVENODD if clip.evenodd else FillRule.NONZERO
    turns = windings(_outlines_of(clip), np.array([place]))
    return bool(is_inside(turns, rule)[0])


@lru_cache(256)
def _outlines_of(clip: Clip) -> list[FloatArray]:
    s = np.linspace(0.0, 1.0, _PIECES, endpoint=False)[:, None]
    weights = np.hstack([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3])
    found = []
    for ring in clip.rings:
        pieces = _pieces_of(ring)
        found.append(np.vstack([(weights @ pieces).reshape(-1, 2), pieces[-1, -1:]]))
    return found


def _pieces_of(ring: ClipRing) -> FloatArray:
    places = np.array(ring.numbers).reshape(-1, 2)
    return np.stack([places[at : len(places) - 3 + at : 3] for at in range(4)], axis=1)
