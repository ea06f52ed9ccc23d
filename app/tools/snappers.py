"""The snappers of the canvas: what the thing that is dragged, placed or measured now is drawn to."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from ..document.model import Document, Guide
from ..document.point_group import PointGroup
from ..view_model.boxes import Bounds, nine_positions
from .editing_session import EditingSession
from .pointer import Pointer
from .snap_targets import targets_of, targets_of_handle, targets_of_side
from .snapping import (
    Snap,
    SnapKind,
    Snapper,
    Snapping,
    Targets,
)
from .transform_box import Grip


class SnapTargets:
    """SnapTargets of the gestures, each made when one begins.

    Attributes
    ----------
    now
        The snapper in use, None for none.
    """

    def __init__(
        self,
        session: EditingSession,
        settings: Callable[[], Snapping],
        grid: Callable[[], float],
    ) -> None:
        self._session, self._settings, self._grid = session, settings, grid
        self.now: Snapper | None = None
        # The snapper of the last hover, and what it was made for.
        self._hovered: tuple[tuple[Document, int, int, Snapping], Snapper] | None = None

    def for_new_point(self, place: int) -> Snapper:
        """Return the snapper of a point that is put at `place`, −1 for the first of another curve."""
        # What there is before the press: later the new point would be drawn to itself.
        views, active = self._session.views, self._session.active_index
        return self._make(lambda: targets_of(views, active, {}, place, self._kinds))

    def for_handle(self, point: int) -> Snapper:
        """Return the snapper of the end of a handle."""
        session = self._session
        return self._make(lambda: targets_of_handle(session.views, session.active_index, point, self._kinds))

    def for_points(self, group: PointGroup, grip: tuple[int, int] | None = None) -> Snapper:
        """Return the snapper of what moves together: of one of its points, the curve and the index given."""
        session, moving = self._session, dict(group.parts)
        # Level with its neighbours is a point; of whole curves none has any that stay.
        curve, place = (session.active_index, -1) if grip is None or group.is_whole else grip
        views = session.views
        return self._make(lambda: targets_of(views, curve, moving, place, self._kinds))

    def for_pivot(self, bounds: Bounds) -> Snapper:
        """Return the snapper of the pivot of what has these bounds, whose nine places it snaps to."""
        views, active = self._session.views, self._session.active_index
        return self._make(
            lambda: targets_of(views, active, {}, -1, self._kinds).with_places(nine_positions(bounds))
        )

    def for_grip(self, grip: Grip, group: PointGroup) -> Snapper:
        """Return the snapper of a corner or a side of the box around a group."""
        if grip.x and grip.y:
            return self.for_points(group)
        session, moving = self._session, dict(group.parts)
        views = session.views
        return self._make(lambda: targets_of_side(views, session.active_index, moving, self._kinds))

    def for_guide(self) -> Snapper:
        """Return the snapper of a guide: points that it meets, and the grid."""
        session = self._session
        return self._make(
            lambda: targets_of_side(session.views, session.active_index, {}, self._kinds), guides=()
        )

    def _make(self, collect: Callable[[], Targets], guides: Sequence[Guide] | None = None) -> Snapper:
        """Return a snapper to what `collect` returns and to guides, by default those of the document."""
        # Guides as they are at the press.
        guides = self._session.document.guides if guides is None else guides
        self.now = Snapper(self._settings, self._grid, collect, guides)
        return self.now

    @property
    def _kinds(self) -> Collection[SnapKind]:
        return self._settings().kinds

    def show_before_press(self, pointer: Pointer, place: int) -> None:
        """Show where a press at `pointer` would put the point of index `place`."""
        session, settings = self._session, self._settings()
        made_for = (session.document, session.active_index, place, settings)
        if self._hovered is None or self._hovered[0] != made_for:
            self._hovered = (made_for, self.for_new_point(place))
        self.now = self._hovered[1]
        self.now.at(pointer)

    @property
    def caught(self) -> Snap | None:
        """The catch of the snapper in use."""
        return self.now.caught if self.now is not None else None

    def reset(self) -> None:
        """Use none."""
        self.now = None
