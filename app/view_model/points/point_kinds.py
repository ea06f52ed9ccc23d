"""The kinds of points: a record for each, that keys, menus, buttons, table and marks read. No Qt.

To add one: its record in `POINT_KINDS`, and an icon of its name in ``resources/icons``. A point is of the
kind of the first record whose `are_of` holds of it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

import msgspec
import numpy as np

from curvecore.arrays import BoolArray, IntArray

from ...document.model import Curve, Vector
from ...families import Family, titles_with_derivatives
from ..curve.curve_view import CurveView
from ..curve.point_arrays import PointArrays
from .smoothness import (
    NO_CORNERS,
    ONE_SIDED,
    inner_points,
    made_estimated,
    made_smooth,
    made_symmetric,
    with_corners,
)

Outline = tuple[Vector, ...]


class PointKind(msgspec.Struct, frozen=True, kw_only=True):
    """A kind of point: what its handles do to each other.

    Attributes
    ----------
    name
        Its name in the program, and that of its icon.
    title
        What people call it.
    action
        The name of the action that makes points of it.
    key
        The keys of that, comma separated.
    tip
        What it is, and what becomes of points that are made so.
    keywords
        Other words by which the palette finds it.
    step
        What the step of the history says before "point 3".
    one
        How a point of the kind is named after "point 3, "; empty where nothing needs to be said.
    made
        Returns the curve of a view with points of this kind, its shape kept as far as can be; raises
        `EditError` where it cannot be.
    are_of
        Tells which of some points are of this kind, unless of one before it.
    outline
        Corners of its mark, for one as large as a disc of radius 1; none for a disc.
    is_open
        Whether its mark has a dot of paper in the middle.
    ends
        Why ends of an open curve are left out; empty where they are not.
    """

    name: str
    title: str
    action: str
    key: str
    tip: str
    keywords: str
    step: str
    one: str
    made: Callable[[CurveView, Collection[int]], Curve]
    are_of: Callable[[PointArrays], BoolArray]
    outline: Outline = ()
    is_open: bool = False
    ends: str = ""


_SIDE = 0.96
"""Half the side of a square that looks as large as a disc of radius 1."""

_SQUARE = ((-_SIDE, -_SIDE), (_SIDE, -_SIDE), (_SIDE, _SIDE), (-_SIDE, _SIDE))
_REACH = 1.4
_DIAMOND = ((0.0, -_REACH), (_REACH, 0.0), (0.0, _REACH), (-_REACH, 0.0))

CORNER = PointKind(
    name="point-corner",
    title="Corner",
    action="tangentCorner",
    key="Shift+C, Alt+2",
    tip="A velocity of its own on either side of the selected points: each handle moves alone",
    keywords="cusp sharp break handles",
    step="Corner at",
    one="a corner",
    made=with_corners,
    are_of=lambda points: points.corners & ~points.ties,
    outline=_DIAMOND,
    ends=NO_CORNERS,
)
SMOOTH = PointKind(
    name="point-smooth",
    title="Smooth",
    action="tangentSmooth",
    key="Shift+S",
    tip="One direction at the selected points, and a length of its own for each handle; tangent to a line",
    keywords="tangent collinear G1 tie handles",
    step="Smooth",
    one="smooth",
    made=made_smooth,
    are_of=lambda points: points.ties & ~points.evens,
    outline=_SQUARE,
    ends=ONE_SIDED,
)
SYMMETRIC = PointKind(
    name="point-symmetric",
    title="Symmetric",
    action="tangentSymmetric",
    key="Shift+Y, Alt+1",
    tip="One velocity on both sides of the selected points, the mean of two; one handle mirrors the other",
    keywords="smooth C1 mirror equal handles length",
    step="Symmetric",
    one="symmetric",
    made=made_symmetric,
    are_of=lambda points: np.isfinite(points.given).any(axis=(1, 2, 3)).astype(bool),
    outline=_SQUARE,
    is_open=True,
)
ESTIMATED = PointKind(
    name="point-estimated",
    title="Estimated",
    action="tangentEstimated",
    key="Shift+A, Alt+3",
    tip="Let the rules estimate the tangents of the selected points",
    keywords="auto smooth automatic reset",
    step="Estimate",
    one="",
    made=made_estimated,
    are_of=lambda points: np.ones(len(points.points), dtype=bool),
)

POINT_KINDS = (CORNER, SMOOTH, SYMMETRIC, ESTIMATED)
"""All kinds, in the order of menus and keys; a point is of the first that it is of."""


def kinds_of(view: CurveView) -> IntArray:
    """Return for each point the place of its kind in `POINT_KINDS`, (n,).

    Ends of an open curve have one side, and are corners only for the curve that goes on there. All points of
    families without velocities are of the last kind: where the curve goes, a rule decides.
    """
    kinds, last = np.full(len(view.points), len(POINT_KINDS) - 1, dtype=np.intp), len(view.points) - 1
    if view.source.family.derivatives and view.source.has_derivatives:
        holds = [kind.are_of(view.arrays) for kind in POINT_KINDS]
        kinds = np.argmax(holds, axis=0)
        for end in () if view.source.is_closed else (0, last):
            if POINT_KINDS[kinds[end]].ends:
                kinds[end] = POINT_KINDS.index(SYMMETRIC)
    return kinds


def kind_at(view: CurveView, index: int) -> PointKind:
    """Return the kind that a point of a curve is of."""
    return POINT_KINDS[kinds_of(view)[index]]


def is_breakable(view: CurveView, index: int) -> bool:
    """Whether a handle of a point moves another one along: it has curve on both sides, and is no corner."""
    return kind_at(view, index) is not CORNER and bool(inner_points(view.source, [index]))


def toggled(view: CurveView, index: int) -> PointKind:
    """Return the kind that a double click gives a point: a corner becomes smooth, all else a corner."""
    return SMOOTH if kind_at(view, index) is CORNER else CORNER


def why_no_kinds(family: Family) -> str:
    """Return why points of a family are of no kind, as a sentence; empty if they are."""
    if family.derivatives:
        return ""
    return f"{family.subject} has no velocities at its points; choose {titles_with_derivatives()}."
