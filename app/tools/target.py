"""Target of the transforms: the selected points, or else the curves that are chosen as wholes."""

from __future__ import annotations

import math
from collections.abc import Callable

from msgspec.structs import replace

from ..document.edits import EditError
from ..document.model import Vector
from ..document.point_group import PointGroup, points_of
from ..document.selection import NONE_CHOSEN
from ..document.several_curves import whole_curves
from ..view_model.bounds import BARE, Bounds, Strokes, bounds_of
from ..view_model.pivot import Anchor, Pivot, anchored
from .drag_machine import EditingHost
from .drags import MovePoints
from .pointer import Pointer
from .snappers import Snappers
from .transform import Transform, TransformKind
from .transform_box import Grip, ScaleBox, TransformBox, box_of


class TransformTarget:
    """The selected points of the curves that are edited; with none, the curves that are chosen as wholes.

    It says what is meant, and makes the drags that transform it; `strokes` tells what these make of strokes,
    and `is_even` whether corners keep proportions.
    """

    def __init__(
        self,
        host: EditingHost,
        snappers: Snappers,
        strokes: Callable[[], Strokes] = Strokes,
        is_even: Callable[[], bool] = lambda: False,
    ) -> None:
        self._host, self._snappers, self._strokes, self._is_even = host, snappers, strokes, is_even
        # The last group with its box, and what they were found for, the views first.
        self._known: tuple[object, ...] = ()
        self._found: tuple[PointGroup | None, TransformBox | None] = (None, None)

    @property
    def group(self) -> PointGroup | None:
        """The points that are transformed together, None for none."""
        return self._now()[0]

    @property
    def box(self) -> TransformBox | None:
        """The box around them, where there are two or more."""
        return self._now()[1]

    def _now(self) -> tuple[PointGroup | None, TransformBox | None]:
        host = self._host
        selection = host.selected.group
        if len(selection.parts) == 1 and len(selection.parts[0][1]) == 1:
            # As under most drags; a single point has no box.
            return selection, None
        views, chosen = host.views, host.selected.chosen
        live, strokes, turns = host.is_previewing, self._strokes(), host.box.turns
        now = (selection, chosen, live, strokes, turns)
        if not self._known or self._known[0] is not views or self._known[1:] != now:
            self._known = (views, *now)
            group = selection if selection.parts else self.curves
            box = box_of(views, group, strokes, live=live) if group is not None else None
            self._found = (group, replace(box, turns=turns) if box is not None else None)
        return self._found

    @property
    def curves(self) -> PointGroup | None:
        """The curves that are chosen as wholes, whatever points are selected; None for none."""
        host = self._host
        return whole_curves(host.document, host.selected.chosen) if host.selected.chosen else None

    @property
    def for_keys(self) -> PointGroup:
        """The target of the keys: the same, or else all points of the curve that is edited."""
        return self.group or points_of(
            self._host.active_index, range(len(self._host.active_view.source.points))
        )

    @property
    def words(self) -> str:
        """The words for that: "3 curves", "2 points", "all 5 points"."""
        group = self.for_keys
        return f"{'all ' if self.group is None and group.only_point is None else ''}{group.words}"

    @property
    def is_nothing(self) -> bool:
        """Whether nothing is selected, and no curve is edited or has no points."""
        is_there = self.group is not None or self._host.selected.is_editing
        return not is_there or not any(indices for _, indices in self.for_keys.parts)

    @property
    def refusal_of_keys(self) -> str:
        """Why keys cannot transform anything: it is locked, or there is nothing."""
        if self.group is None and not self._host.selected.is_editing:
            return NONE_CHOSEN
        group, source = self.for_keys, self._host.active_view.source
        if not any(indices for _, indices in group.parts):
            return f"“{source.name}” has no points yet; press P to add some."
        return self.refusal_of(group)

    def refusal_of(self, group: PointGroup | None) -> str:
        """Return why a group cannot be changed: what of it is locked; empty where nothing is."""
        try:
            if group is not None:
                group.refuse_locked(self._host.document)
        except EditError as reason:
            return str(reason)
        return ""

    @property
    def bounds(self) -> Bounds:
        """The bounds of what keys transform; there must be points."""
        group, box = self._now()
        if box is not None:
            return box
        return self._bounds_of(group or self.for_keys, self._strokes())

    @property
    def bare_bounds(self) -> Bounds:
        """The same without strokes."""
        return self._bounds_of(self.for_keys, BARE)

    def _bounds_of(self, group: PointGroup, strokes: Strokes) -> Bounds:
        bounds = bounds_of(self._host.views, group, strokes, as_drawn=self._host.is_previewing)
        assert bounds is not None
        return bounds

    @property
    def centre(self) -> Vector:
        """Place that keys turn, scale and mirror about: the pivot, or else the middle."""
        return self.pivot or self.bounds.centre

    # Pivot

    @property
    def pivot(self) -> Vector | None:
        """The pivot that was chosen, where it is by now; None for the middle."""
        pivot = self._pivot() if self._host.box.pivot is not None else None
        return pivot.place if pivot is not None else None

    @pivot.setter
    def pivot(self, place: Vector | None) -> None:
        pivot = Pivot(place, self.anchored()) if place is not None else None
        self._host.box.set_pivot(pivot)

    def _pivot(self) -> Pivot | None:
        chosen = self._host.box.pivot
        if chosen is None or self.is_nothing:
            return None
        return chosen.at(self.anchored())

    def anchored(self) -> Anchor:
        """Return what keys transform as it is now."""
        host = self._host
        return anchored(host.views, self.for_keys, self._strokes(), live=host.is_previewing)

    def keep_pivot(self) -> None:
        """Take the pivot along: the document has changed, and it belongs to what is there now."""
        if (pivot := self._pivot()) is not None and not self._host.is_previewing:
            self._host.box.set_pivot(pivot)

    # Drags

    def transform(self, kind: TransformKind, pointer: Pointer) -> Transform:
        """Return the transform that begins at `pointer`; with nothing selected, of all points."""
        group = self.for_keys
        grip = self._nearest(group, pointer)
        snapper = self._snappers.for_group(group, grip)
        return Transform(
            self._host.document,
            kind,
            group,
            self.centre,
            self.bounds.place(1, 1),
            pointer.position,
            snapper,
            grip,
            everything=self.group is None,
            scales_strokes=self._strokes().scaled,
        )

    def _nearest(self, group: PointGroup, pointer: Pointer) -> tuple[int, int]:
        """Return the curve and the index of the point that is nearest to the pointer: it snaps."""
        curves = self._host.document.curves
        places = [(curve, index) for curve, indices in group.parts for index in indices]
        return min(places, key=lambda at: math.dist(curves[at[0]].points[at[1]].position, pointer.position))

    def turning(self, grip: Grip, pointer: Pointer) -> Transform:
        """Return the drag of a grip of the box that rotates or skews."""
        drag = replace(self.transform(grip.does, pointer), by_grip=True)
        if self.box is None or not self.box.turns:
            return drag
        hold, opposite = self.box.place(grip.x, grip.y), self.box.place(-grip.x, -grip.y)
        return replace(drag, hold=hold, opposite=opposite, axis=int(grip.y == 0))

    def scaling(self, grip: Grip, pointer: Pointer) -> ScaleBox:
        """Return the drag of a grip of the box that scales."""
        group, box = self._now()
        assert group is not None
        assert box is not None
        snapper = self._snappers.for_grip(grip, group)
        host = self._host
        return ScaleBox(
            host.document,
            host.views,
            group,
            box,
            self.centre,
            grip,
            pointer.position,
            snapper,
            self._strokes(),
            even=self._is_even() and bool(grip.x and grip.y),
        )

    def moving(self, group: PointGroup, pointer: Pointer) -> MovePoints:
        """Return the drag of a group from the pointer on; what snaps is its point that is nearest."""
        grip = self._nearest(group, pointer)
        snapper = self._snappers.for_group(group, grip)
        return MovePoints(self._host.document, group, pointer.position, snapper, grip)
