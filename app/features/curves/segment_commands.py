"""Segments of a curve, deleted."""

from __future__ import annotations

from collections.abc import Collection

from ...actions.declaration import PlaceAction, action, also
from ...actions.menus import POINT_MENU, POINTS_NUMBER
from ...actions.needs import HERMITE_CURVE, UNLOCKED_CURVE, Need
from ...document.curve_edits import with_parts
from ...document.model import Document
from ...document.straight_edits import why_not_straight
from ...document.words import count_of
from ...view_model.geometry import segment_at
from ...view_model.point_kinds import segments_between
from ...view_model.split import Split, without_segments
from ...workbench.context import WindowContext


class SegmentCommands:
    """Deletes segments, and leaves the points at their ends."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action(
        "deleteSegment",
        "Delete Segment",
        POINTS_NUMBER,
        "Alt+K",
        "delete-segment",
        needs=Need(
            HERMITE_CURVE.words,
            lambda state: UNLOCKED_CURVE.is_met(state) and not why_not_straight(state.family),
            why=lambda state: why_not_straight(state.family),
        ),
        keywords="open break cut out remove between nodes path",
    )
    @also(POINT_MENU(22))
    def _delete_between(self) -> None:
        """Delete the segments between selected neighbours: a closed curve opens, an open one splits."""
        session = self._session
        segments = segments_between(session.active_curve, session.selection)
        if segments:
            self._delete(segments)
        else:
            session.refuse("Select two neighbouring points, or click with the right button on the segment.")

    @PlaceAction("deleteSegmentHere", "Delete Segment", like="deleteSegment")
    def delete_at(self, t: float) -> None:
        """Delete the segment of the active curve that runs through `t`."""
        self._delete([segment_at(self._session.active_view.parameters, t)])

    def _delete(self, segments: Collection[int]) -> None:
        session, made = self._session, list[Split]()

        def edit(document: Document) -> Document:
            made.append(without_segments(session.active_view, segments))
            return with_parts(document, session.active_index, *made[-1].curves)

        what = "segment" if len(segments) == 1 else count_of(len(segments), "segment")
        if session.change(f"Delete {what} of {session.active_curve.name}", edit):
            session.selected.set_points([])
            count = len(made[-1].curves)
            left = f"{count} curves are left" if count > 1 else "the curve is open"
            session.say(f"Deleted {what}: {left}, {made[-1].sentence}")
