"""The last transform, read off what a step did to points, and done once more to others.

Whatever moved them, by the mouse, by keys, by numbers: what counts is one move, one rotation, one scale along
the axes (a mirror image is one) or one skew. All else, such as points that were edited one by one, is none.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Protocol

import msgspec
import numpy as np

from curvecore.arrays import FloatArray

from ...document.model import Curve, Document, Vector
from ...document.point_group import PointGroup
from ...document.readings import Readings
from ...document.several_curves import mapped, moved, scaled_strokes
from ...document.transforms import IDENTITY, Affine, rotation, scaling, skewing
from ...document.words import number
from .pivot import map_between

_DIGITS = 11
"""Of a number that is read off points: what is beyond is their rounding."""

_NONE = 1e-9
"""Part of a matrix that counts as none."""


class Transform(Protocol):
    """A transform by its numbers."""

    def words(self, readings: Readings) -> str:
        """Return what it does, with a place for what it is done to: "Rotate {} by 72°"."""

    def done(self, document: Document, group: PointGroup, about: Vector, times: int = 1) -> Document:
        """Return the document with a group transformed so many times about a place."""


class Move(msgspec.Struct, frozen=True):
    """A move."""

    by: Vector

    def words(self, readings: Readings) -> str:
        """Return what it does."""
        return f"Move {{}} by {readings.way_words(self.by)}"

    def done(self, document: Document, group: PointGroup, about: Vector, times: int = 1) -> Document:
        """Return the document with a group moved."""
        return moved(document, group, (times * self.by[0], times * self.by[1]))


class Turn(msgspec.Struct, frozen=True):
    """A rotation."""

    degrees: float

    def words(self, readings: Readings) -> str:
        """Return what it does."""
        return f"Rotate {{}} by {number(readings.turn(self.degrees), 6)}°"

    def done(self, document: Document, group: PointGroup, about: Vector, times: int = 1) -> Document:
        """Return the document with a group rotated."""
        return mapped(document, group, rotation(times * self.degrees, about))


class Scale(msgspec.Struct, frozen=True):
    """A scale along the axes, or a mirror image; `with_strokes` where widths of strokes go along."""

    x: float
    y: float
    with_strokes: bool

    def words(self, readings: Readings) -> str:
        """Return what it does."""
        flip = {(-1.0, 1.0): "horizontally", (1.0, -1.0): "vertically"}.get((self.x, self.y))
        if flip is not None:
            return f"Flip {{}} {flip}"
        factors = (self.x,) if self.x == self.y else (self.x, self.y)
        return f"Scale {{}} by {' × '.join(number(each, 6) for each in factors)}"

    def done(self, document: Document, group: PointGroup, about: Vector, times: int = 1) -> Document:
        """Return the document with a group scaled, with its strokes where they are."""
        x, y = self.x**times, self.y**times
        document = mapped(document, group, scaling(x, y, about))
        return scaled_strokes(document, group, x, y) if self.with_strokes else document


class Skew(msgspec.Struct, frozen=True):
    """A skew along x (axis 0) or y."""

    axis: int
    degrees: float

    def words(self, readings: Readings) -> str:
        """Return what it does."""
        return f"Skew {{}} by {number(readings.turn(self.degrees), 6)}° along {'xy'[self.axis]}"

    def done(self, document: Document, group: PointGroup, about: Vector, times: int = 1) -> Document:
        """Return the document with a group skewed."""
        for _ in range(times):
            document = mapped(document, group, skewing(self.axis, self.degrees, about))
        return document


class Done(msgspec.Struct, frozen=True):
    """A transform that was done.

    Attributes
    ----------
    transform
        Which.
    about
        What stayed in its place; None under a move.
    curves
        What it was done to, as it is since.
    """

    transform: Transform
    about: Vector | None
    curves: tuple[Curve, ...]

    def about_for(self, places: Collection[int], curves: Sequence[Curve]) -> Vector | None:
        """Return the place that it is about once more if it is done to the same curves; None for others."""
        same = {id(curve) for curve in self.curves} == {id(curves[place]) for place in places}
        return self.about if same else None


def transform_between(before: Document, after: Document) -> Done | None:
    """Return the transform that made one document of another; None where something else did."""
    if len(before.curves) != len(after.curves) or before.curves is after.curves:
        return None
    here, there, changed = list[Vector](), list[Vector](), list[Curve]()
    widened = False
    for old, new in zip(before.curves, after.curves, strict=True):
        if old is new or old.points is new.points:
            continue
        if len(old.points) != len(new.points):
            return None
        changed.append(new)
        widened |= old.style.width != new.style.width
        for one, other in zip(old.points, new.points, strict=True):
            if one.position != other.position:
                here.append(one.position)
                there.append(other.position)
    if not here:
        return None
    return _read(map_between(np.array(here), np.array(there)), tuple(changed), with_strokes=widened)


def _read(by: Affine, curves: tuple[Curve, ...], *, with_strokes: bool) -> Done | None:
    if by is IDENTITY:
        return None
    matrix = np.array([[1.0 + by.xx, by.xy], [by.yx, 1.0 + by.yy]])
    if np.abs(matrix - np.eye(2)).max() <= _NONE:
        return Done(Move((_clean(by.shift[0]), _clean(by.shift[1]))), None, curves)
    found = _of_matrix(matrix, with_strokes=with_strokes)
    return None if found is None else Done(found, _fixed_point(by, matrix), curves)


def _of_matrix(matrix: FloatArray, *, with_strokes: bool) -> Transform | None:
    """Return the rotation, scale or skew of a matrix; None where it is no single one."""
    (a, b), (c, d) = matrix.tolist()
    if abs(b) <= _NONE and abs(c) <= _NONE:
        return Scale(_clean(a), _clean(d), with_strokes)
    if abs(a - d) <= _NONE and abs(b + c) <= _NONE and abs(math.hypot(a, c) - 1.0) <= _NONE:
        return Turn(round(math.degrees(math.atan2(c, a)), 9))
    if abs(a - 1.0) <= _NONE and abs(d - 1.0) <= _NONE and min(abs(b), abs(c)) <= _NONE:
        axis = 0 if abs(b) > abs(c) else 1
        return Skew(axis, round(math.degrees(math.atan((b, c)[axis])), 9))
    return None


def _fixed_point(by: Affine, matrix: FloatArray) -> Vector:
    """Return what a map leaves in its place; of a line of such points that nearest to its centre."""
    way = np.linalg.lstsq(np.eye(2) - matrix, np.array(by.shift), rcond=1e-9)[0]
    return (by.centre[0] + float(way[0]), by.centre[1] + float(way[1]))


def _clean(value: float) -> float:
    """Return a number without the digits that are roundings."""
    return float(f"{value:.{_DIGITS}g}") + 0.0 if abs(value) > _NONE**2 else 0.0
