"""Target of the transforms: the selected points, or else the curves that are chosen as wholes."""

from __future__ import annotations

from msgspec.structs import replace

from ..document.differences import reshaped_curves
from ..document.groups import shape_of
from ..document.limits import EditError
from ..document.model import Document, Vector
from ..document.point_group import PointGroup
from ..document.selection import NONE_SELECTED
from ..document.several_curves import whole_unlocked_curves
from ..view_model.boxes import Bounds, bounds_of
from ..view_model.pivot import Anchor, Pivot, anchored
from .editing_session import EditingSession
from .transform_box import TransformBox, box_of


class SelectionBox:
    """The selected points of the curves that are edited; with none, the curves that are chosen as wholes."""

    def __init__(self, session: EditingSession) -> None:
        self._session = session
        # The last group with its box, and what they were found for, the views first.
        self._known: tuple[object, ...] = ()
        self._found: tuple[PointGroup | None, TransformBox | None] = (None, None)
        # All points of the curves that were chosen last as wholes, and which document and choice they are of.
        self._whole: tuple[Document, frozenset[int], PointGroup] | None = None

    @property
    def group(self) -> PointGroup | None:
        """The points that are transformed together, None for none."""
        return self._now()[0]

    @property
    def rectangle(self) -> TransformBox | None:
        """The box around them, where there are two or more."""
        return self._now()[1]

    def _now(self) -> tuple[PointGroup | None, TransformBox | None]:
        session = self._session
        selection = session.selected.group
        if len(selection.parts) == 1 and len(selection.parts[0][1]) == 1:
            # As under most drags; a single point has no box.
            return selection, None
        views, chosen = session.views, session.selected.chosen
        live, turns = session.is_previewing, session.box.turns
        now = (selection, chosen, live, turns)
        if not self._known or self._known[0] is not views or self._known[1:] != now:
            self._known = (views, *now)
            group = selection if selection.parts else self.curves
            box = box_of(views, group, live=live) if group is not None else None
            self._found = (group, replace(box, turns=turns) if box is not None else None)
        return self._found

    @property
    def curves(self) -> PointGroup | None:
        """The curves that are chosen as wholes, whatever points are selected; None for none.

        Of several, those that are not locked.
        """
        document, chosen = self._session.document, self._session.selected.chosen
        if not chosen:
            return None
        known, group = self._whole, None
        if known is not None and known[1] == chosen and reshaped_curves(known[0], document) is not None:
            # Under a drag of thousands they are the same.
            group = known[2]
        self._whole = (document, chosen, group or whole_unlocked_curves(document, chosen))
        return self._whole[2]

    @property
    def for_keys(self) -> PointGroup:
        """The target of the keys: the same, or else all points of the shape that is edited."""
        return self.group or self._edited

    @property
    def _edited(self) -> PointGroup:
        """All points of the active curve, and of the others of its shape: what has a hole is one thing."""
        document, active = self._session.document, self._session.active_index
        places = shape_of(document, active)
        return PointGroup(
            tuple((place, frozenset(range(len(document.curves[place].points)))) for place in places)
        )

    @property
    def words(self) -> str:
        """The words for that: "3 curves", "2 points", "all 5 points"."""
        group = self.for_keys
        return f"{'all ' if self.group is None and group.only_point is None else ''}{group.label}"

    @property
    def is_nothing(self) -> bool:
        """Whether nothing is selected, and no curve is edited or has no points."""
        is_there = self.group is not None or self._session.selected.is_editing
        return not is_there or not any(indices for _, indices in self.for_keys.parts)

    @property
    def refusal_of_keys(self) -> str:
        """Why keys cannot transform anything: it is locked, or there is nothing."""
        if self.group is None and not self._session.selected.is_editing:
            return NONE_SELECTED
        group, source = self.for_keys, self._session.active_view.source
        if not any(indices for _, indices in group.parts):
            return f"“{source.name}” has no points yet; press P to add some."
        return self.refusal_of(group)

    def refusal_of(self, group: PointGroup | None) -> str:
        """Return why a group cannot be changed: what of it is locked; empty where nothing is."""
        try:
            if group is not None:
                group.refuse_locked(self._session.document)
        except EditError as reason:
            return str(reason)
        return ""

    @property
    def bounds(self) -> Bounds:
        """The bounds of what keys transform; there must be points."""
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
        """Place that keys turn, scale and mirror about: the pivot, or else the middle."""
        return self.pivot or self.bounds.centre

    # Pivot

    @property
    def pivot(self) -> Vector | None:
        """The pivot that was chosen for it, where it is by now; None for the middle."""
        pivot = self._session.box.pivot
        if pivot is None or self.is_nothing:
            return None
        found = pivot.at(self.anchored())
        return found.position if found is not None else None

    @pivot.setter
    def pivot(self, place: Vector | None) -> None:
        self._session.box.set_pivot(Pivot(place, self.anchored()) if place is not None else None)

    def anchored(self) -> Anchor:
        """Return what keys transform as it is now."""
        return self._anchored(self.for_keys)

    def _anchored(self, group: PointGroup) -> Anchor:
        session = self._session
        return anchored(session.views, group, live=session.is_previewing)

    def keep_pivot(self) -> None:
        """Take the pivot along with what it was chosen for, or with a copy of that which lies there.

        Where that is gone the pivot goes, too: what is drawn in its place has none.
        """
        session, pivot = self._session, self._session.box.pivot
        if pivot is None or session.is_previewing:
            return
        own = pivot.anchor.group_in(session.document.curves)
        now = None if self.is_nothing else self.anchored()
        is_meant = now is not None and (own is not None or pivot.anchor.has_same_points(now))
        if now is not None and is_meant and (found := pivot.at(now)) is not None:
            session.box.set_pivot(found)
        else:
            session.box.set_pivot(None if own is None else pivot.at(self._anchored(own)) or pivot)
