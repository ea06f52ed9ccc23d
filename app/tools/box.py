"""The box around the selection: its grips, its pivot, and the points that transforms act on."""

from __future__ import annotations

import math
from collections.abc import Sequence
from enum import Enum
from operator import itemgetter

import msgspec
from msgspec.structs import replace

from ..document.differences import reshaped_curves
from ..document.groups import shape_of
from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.selection import NONE_SELECTED
from ..document.several_curves import whole_unlocked_curves
from ..view_model.boxes import Bounds, bounds_of
from ..view_model.curve.curve_view import CurveView
from ..view_model.pivot import Anchor, Pivot, anchored
from .editing_session import EditingSession
from .pointer import SNAP_KEY, STEP_KEYS, Cursor, Pointer

_BESIDE_POINTS, _BESIDE_CURVES = 16.0, 10.0
"""Pixels from the box to its grips: a press there must mean neither points and handles, nor a line."""

_ARM = 26.0
"""Pixels from the box to the grip that rotates."""

_REACH = 8.0

_LEAST_BOX, _LEAST_TURNING_BOX = 60.0, 20.0
"""Pixels along a box with room for a pivot that was not set; fewer where its grips turn."""


class TransformKind(Enum):
    """Kind of transform.

    Attributes
    ----------
    title
        The word for it.
    key
        What a tool calls the key that begins it, and goes on with it where another one is in flight: a
        capital letter with Shift.
    keys
        What keys change meanwhile.
    """

    MOVE = ("Move", "g", f"X, Y, Ctrl or Shift: one axis · {SNAP_KEY} · type a number, or x Tab y")
    SCALE = ("Scale", "s", "X or Y: one axis · type a number, or x Tab y")
    ROTATE = ("Rotate", "r", f"{STEP_KEYS} · type a number")

    SKEW = ("Skew", "R", f"X or Y: along which axis · {STEP_KEYS} · type a number")

    def __init__(self, title: str, key: str, keys: str) -> None:
        self.title, self.key, self.keys = title, key, keys

    @property
    def is_angle(self) -> bool:
        """Whether its amount is an angle."""
        return self in (TransformKind.ROTATE, TransformKind.SKEW)


class Grip(msgspec.Struct, frozen=True):
    """A grip: −1, 0 or 1 in each direction.

    Attributes
    ----------
    does
        What it does.
    """

    x: int
    y: int
    does: TransformKind = TransformKind.SCALE

    @property
    def cursor(self) -> Cursor:
        """The shape of the pointer over it."""
        if self.does is TransformKind.ROTATE:
            return Cursor.ROTATE
        if self.x == 0 or self.y == 0:
            goes_along_x = (self.y == 0) is (self.does is TransformKind.SCALE)
            return Cursor.WIDER if goes_along_x else Cursor.HIGHER
        return Cursor.RISING if self.x == self.y else Cursor.FALLING


_GRIPS = tuple(Grip(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y)
_TURNING_GRIPS = tuple(
    Grip(grip.x, grip.y, TransformKind.ROTATE if grip.x and grip.y else TransformKind.SKEW) for grip in _GRIPS
)


class TransformBox(Bounds, frozen=True):
    """The bounds of selected points, or of selected curves; its grips stand around it.

    Attributes
    ----------
    turns
        Whether its grips rotate, at the corners, and skew, and do not scale.
    is_whole
        Whether it is that of whole curves.
    """

    turns: bool = False
    is_whole: bool = False

    @property
    def pad(self) -> float:
        """Pixels from it to its grips."""
        return _BESIDE_CURVES if self.is_whole else _BESIDE_POINTS

    def holds(self, pointer: Pointer) -> bool:
        """Whether a pointer lies inside; of a flat box, or a tiny one, as near to it as its grips."""
        least = self.pad / pointer.scale
        return all(
            abs(at - middle) <= max(size / 2, least)
            for at, middle, size in zip(pointer.position, self.centre, self.size, strict=True)
        )

    def is_roomy(self, scale: float) -> bool:
        """Return whether a press takes its middle as pivot: in a smaller one it moves the contents.

        So it does in the box of whole curves that scales: who presses there means the curve there.
        """
        if self.turns:
            return max(self.size) * scale >= _LEAST_TURNING_BOX
        return not self.is_whole and max(self.size) * scale >= _LEAST_BOX

    def grips(self, scale: float) -> list[tuple[Grip, Vector]]:
        """Return the grips and where they lie; none that would scale or skew a side without length."""
        pad, (left, low), (right, high) = self.pad / scale, self.low, self.high
        middle, useful = self.centre, [length > 0.0 for length in self.size]
        columns, rows = (left - pad, middle[0], right + pad), (low - pad, middle[1], high + pad)
        grips = [
            (grip, (columns[grip.x + 1], rows[grip.y + 1]))
            for grip in (_TURNING_GRIPS if self.turns else _GRIPS)
            if grip.does is TransformKind.ROTATE or ((useful[0] or not grip.x) and (useful[1] or not grip.y))
        ]
        if self.turns:
            return grips
        return [*grips, (Grip(0, 1, TransformKind.ROTATE), (middle[0], high + pad + _ARM / scale))]

    def grip_at(self, pointer: Pointer) -> Grip | None:
        """Return the grip under the pointer."""
        distances = [
            (math.dist(position, pointer.position) * pointer.scale, grip)
            for grip, position in self.grips(pointer.scale)
        ]
        distance, grip = min(distances, key=itemgetter(0))
        return grip if distance <= _REACH else None


def box_of(views: Sequence[CurveView], group: PointGroup, *, live: bool = False) -> TransformBox | None:
    """Return the box around two or more points, or curves, that are not all in one place.

    `live` while they are dragged: as they are drawn.
    """
    if sum(len(indices) for _, indices in group.parts) < 2:
        return None
    bounds = bounds_of(views, group, as_drawn=live)
    if bounds is None or not any(bounds.size):
        return None
    return TransformBox(bounds.low, bounds.high, is_whole=group.is_whole)


class SelectionBox:
    """The box around the selected points of the edited curves; with none, around the selected curves.

    Its grips scale, rotate and skew `group` about the pivot, as the keys S, R and Shift+R do.

    Attributes
    ----------
    is_visible
        Whether it is drawn around two or more selected points, or several selected curves.
    keeps_proportions
        Whether the grips at its corners keep its proportions.
    """

    def __init__(self, session: EditingSession) -> None:
        self._session = session
        self.is_visible = True
        self.keeps_proportions = False
        # The last group with its box, and what they were found for, the views first.
        self._known: tuple[object, ...] = ()
        self._result: tuple[PointGroup | None, TransformBox | None] = (None, None)
        # All points of the last whole curves, with the document and the curves they are of.
        self._whole: tuple[Document, frozenset[int], PointGroup] | None = None

    @property
    def group(self) -> PointGroup | None:
        """The points that are transformed together, None for none."""
        return self._now()[0]

    @property
    def rectangle(self) -> TransformBox | None:
        """The box around them, where there are two or more."""
        return self._now()[1]

    @property
    def visible_rectangle(self) -> TransformBox | None:
        """The box, where it is drawn and nothing in it is locked; None otherwise."""
        group, rectangle = self._now() if self.is_visible else (None, None)
        return rectangle if rectangle is not None and not self.refusal_of(group) else None

    def _now(self) -> tuple[PointGroup | None, TransformBox | None]:
        session = self._session
        selection = session.selected.group
        if len(selection.parts) == 1 and len(selection.parts[0][1]) == 1:
            # As under most drags; a single point has no box.
            return selection, None
        views, whole = session.views, session.selected.whole_curves
        live, turns = session.is_previewing, session.box.turns
        now = (selection, whole, live, turns)
        if not self._known or self._known[0] is not views or self._known[1:] != now:
            self._known = (views, *now)
            group = selection if selection.parts else self.curves
            box = box_of(views, group, live=live) if group is not None else None
            self._result = (group, replace(box, turns=turns) if box is not None else None)
        return self._result

    @property
    def curves(self) -> PointGroup | None:
        """The points of the selected whole curves, whatever points are selected; None for none.

        Of several, those that are not locked.
        """
        document, whole = self._session.document, self._session.selected.whole_curves
        if not whole:
            return None
        known, group = self._whole, None
        if known is not None and known[1] == whole and reshaped_curves(known[0], document) is not None:
            # Under a drag of thousands they are the same.
            group = known[2]
        self._whole = (document, whole, group or whole_unlocked_curves(document, whole))
        return self._whole[2]

    @property
    def for_keys(self) -> PointGroup:
        """The points that keys transform: the same, or else all points of the active shape."""
        return self.group or self._active_points

    @property
    def _active_points(self) -> PointGroup:
        """All points of the active curve, and of the others of its shape: outline and holes are one."""
        document, active = self._session.document, self._session.active_index
        curves = shape_of(document, active)
        return PointGroup(
            tuple((curve, frozenset(range(len(document.curves[curve].points)))) for curve in curves)
        )

    @property
    def words(self) -> str:
        """Their label: "3 curves", "2 points", "all 5 points"."""
        group = self.for_keys
        return f"{'all ' if self.group is None and group.only_point is None else ''}{group.label}"

    @property
    def is_nothing(self) -> bool:
        """Whether nothing is selected, and no curve is edited or it has no points."""
        is_there = self.group is not None or self._session.selected.is_editing
        return not is_there or not any(indices for _, indices in self.for_keys.parts)

    @property
    def refusal_of_keys(self) -> str:
        """Why keys cannot transform: the points are locked, or there are none."""
        if self.group is None and not self._session.selected.is_editing:
            return NONE_SELECTED
        group, source = self.for_keys, self._session.active_view.source
        if not any(indices for _, indices in group.parts):
            return f"“{source.name}” has no points yet; press P to add some."
        return self.refusal_of(group)

    def refusal_of(self, group: PointGroup | None) -> str:
        """Return why a group cannot be changed: a part of it is locked; empty where none is."""
        try:
            if group is not None:
                group.refuse_locked(self._session.document)
        except EditError as reason:
            return str(reason)
        return ""

    @property
    def bounds(self) -> Bounds:
        """The bounds of the points that keys transform; there must be some."""
        group, box = self._now()
        if box is not None:
            return box
        return self.bounds_of(group or self.for_keys)

    def bounds_of(self, group: PointGroup) -> Bounds:
        """Return the bounds of a group; there must be points."""
        bounds = bounds_of(self._session.views, group, as_drawn=self._session.is_previewing)
        assert bounds is not None
        return bounds

    @property
    def centre(self) -> Vector:
        """Position that keys rotate, scale and mirror about: the pivot, or else the middle."""
        return self.pivot or self.bounds.centre

    # Pivot

    @property
    def pivot(self) -> Vector | None:
        """The pivot that was set for the points, at its present position; None for the middle."""
        pivot = self._session.box.pivot
        if pivot is None or self.is_nothing:
            return None
        present = pivot.at(self.anchored())
        return present.position if present is not None else None

    @pivot.setter
    def pivot(self, position: Vector | None) -> None:
        self._session.box.set_pivot(Pivot(position, self.anchored()) if position is not None else None)

    def anchored(self) -> Anchor:
        """Return the points that keys transform, as anchor of a pivot."""
        return self._anchored(self.for_keys)

    def _anchored(self, group: PointGroup) -> Anchor:
        session = self._session
        return anchored(session.views, group, live=session.is_previewing)

    def keep_pivot(self) -> None:
        """Move the pivot along with the points it was set for, or with a copy of them in their place.

        Where they are gone, the pivot is removed: points drawn in their place have none.
        """
        session, pivot = self._session, self._session.box.pivot
        if pivot is None or session.is_previewing:
            return
        points = pivot.anchor.group_in(session.document.curves)
        now = None if self.is_nothing else self.anchored()
        is_for_it = now is not None and (points is not None or pivot.anchor.has_same_points(now))
        if now is not None and is_for_it and (moved := pivot.at(now)) is not None:
            session.box.set_pivot(moved)
        else:
            session.box.set_pivot(None if points is None else pivot.at(self._anchored(points)) or pivot)
