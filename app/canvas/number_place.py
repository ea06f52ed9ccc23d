"""Placing of the numbers of points: on the outer side of the bend, and not on each other."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QPointF, QRectF, QSizeF

from curvecore.arrays import FloatArray


def number_place(pixels: FloatArray, index: int, distance: float, beyond: float) -> QPointF:
    """Return the middle of a number: on the outer side of the bend, where the curve is not."""
    last = len(pixels) - 1
    around = pixels[[max(index - 1, 0), index, min(index + 1, last)]].tolist()
    before, here, after = (complex(*place) for place in around)
    outward = here - (before + after) / 2
    if 0 < index < last and abs(outward) > 2:
        outward /= abs(outward)
    else:
        outward = _beside(after - before)
    place = here + distance * outward
    return QPointF(place.real + beyond * outward.real, place.imag)


def _beside(direction: complex) -> complex:
    """Return the unit vector across `direction` (pixels) that points up; straight up without direction."""
    if direction == 0:
        return -1j
    across = direction * -1j / abs(direction)
    return -across if across.imag > 0 else across


class Taken:
    """Room that numbers take already."""

    def __init__(self) -> None:
        self._boxes: list[QRectF] = []

    def take(self, centres: Iterable[QPointF], size: QSizeF) -> QPointF | None:
        """Take the first of some places that is free, and return its middle; None where none is."""
        for centre in centres:
            box = QRectF(QPointF(), size)
            box.moveCenter(centre)
            if not any(map(box.intersects, self._boxes)):
                self._boxes.append(box)
                return centre
        return None
