"""The kinds of the selected points, straight segments between them, and velocities pulled out."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from ...actions.declaration import Action, PlaceAction, action, action_for_each, also, also_for_each
from ...actions.needs import HERMITE_CURVE, HERMITE_POINTS, Need
from ...actions.sections import CURVE_TANGENTS, CURVE_VELOCITIES
from ...actions.situation import Situation
from ...actions.strips import POINT_BUTTONS, POINT_MENU
from ...document import words
from ...document.curve_edits import replace_curve
from ...document.edits import EditError
from ...document.lines import ends_of
from ...document.model import Curve, Document
from ...document.straight_edits import corners_of, why_not_straight
from ...view_model.curve_view import CurveView
from ...view_model.handles import with_velocities_pulled
from ...view_model.point_kinds import POINT_KINDS, PointKind, kinds_of, why_no_kinds
from ...view_model.sampling import segment_at
from ...view_model.smoothness import inner_points
from ...view_model.straight import segments_between, with_straight_segments
from ...workbench.context import WindowContext

_VISIBLE = 16.0
"""Pixels from a point at which a handle is clear of the point's disc."""

_MOST_NAMED = 3
"""Points or segments that a sentence names one by one."""

_OF_A_KIND = Need(
    HERMITE_POINTS.words, HERMITE_POINTS.is_met, why=lambda now: why_no_kinds(now.view.source.family)
)


class TangentCommands:
    """The menu Curve › Tangents."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session

    @action_for_each(
        POINT_KINDS,
        lambda kind: Action(
            kind.action,
            kind.title,
            CURVE_TANGENTS,
            kind.key,
            kind.name,
            kind.tip,
            f"{kind.title} Tangents",
            needs=_OF_A_KIND,
            checked=lambda now: _kinds(now) == {POINT_KINDS.index(kind)},
            keywords=kind.keywords,
        ),
    )
    @also_for_each(
        lambda kind: [strip(10 + POINT_KINDS.index(kind)) for strip in (POINT_MENU, POINT_BUTTONS)]
    )
    def _make(self, kind: PointKind) -> None:
        """Make the selected points of a kind."""
        view, selected = self._session.active_view, sorted(self._session.selection)
        inner = inner_points(view.source, selected) if kind.ends else selected
        left_out = f"; {kind.ends}" if len(inner) < len(selected) else ""
        if self._reshape(kind.step, kind.made, inner or selected):
            self._tell(f"{kind.title} at {_points(inner)}{left_out}.", view, inner)

    @action(
        "straightSegment",
        "Straight Segment",
        CURVE_TANGENTS,
        "Alt+4",
        "straight",
        needs=Need(
            HERMITE_CURVE.words,
            lambda now: now.view.is_current and not why_not_straight(now.view.source.family),
            why=lambda now: why_not_straight(now.view.source.family),
        ),
    )
    @also(POINT_MENU(15), POINT_BUTTONS(15))
    def _straighten_chosen(self) -> None:
        """Make the segments between neighbouring selected points straight, with corners at their ends."""
        session = self._session
        segments = segments_between(session.active_curve, session.selection)
        if segments:
            self._straighten(segments)
        else:
            session.refuse("Select two neighbouring points, or click with the right button on the segment.")

    @action(
        "pullVelocity",
        "Pull Out Velocity",
        CURVE_VELOCITIES,
        "",
        "spline-pointer",
        "Give the selected points velocities of their own, with handles to drag; Alt+drag a point does too",
        needs=HERMITE_POINTS,
    )
    @also(POINT_MENU(16))
    def _pull_velocities(self) -> None:
        self._reshape("Pull out velocity of", self._pulled)

    def _pulled(self, view: CurveView, selected: Collection[int]) -> Curve:
        pixel = self._context.central.canvas.camera.pixel_size
        pulled = with_velocities_pulled(view, selected, _VISIBLE * pixel)
        if pulled == view.source:
            what = "velocity stands" if len(selected) == 1 else "velocities stand"
            raise EditError(f"The {what} out already; drag the square handle.")
        return pulled

    def _tell(self, done: str, before: CurveView, selected: Collection[int]) -> None:
        """Say what was done, and which tangents beside it were written down to keep the shape."""
        points = zip(before.source.points, self._session.active_curve.points, strict=True)
        kept = [place for place, (old, new) in enumerate(points) if place not in selected and old != new]
        if kept:
            which = _points(kept) if len(kept) <= _MOST_NAMED else f"{len(kept)} other points"
            done = f"{done} To keep the shape, the estimates of {which} are set now."
        self._session.say(done)

    # Straight segments

    @PlaceAction("straightHere", "Straight Segment", like="straightSegment")
    def straighten_at(self, t: float) -> None:
        """Make the segment of the active curve straight that runs through `t`."""
        self._straighten([segment_at(self._session.active_view.parameters, t)])

    def _straighten(self, segments: Sequence[int]) -> None:
        session, view = self._session, self._session.active_view

        def edit(document: Document) -> Document:
            made = with_straight_segments(view, segments)
            if made == view.source:
                raise EditError("That is straight already.")
            return replace_curve(document, session.active_index, made)

        text = _straight_text(view.source, segments)
        if not session.change(text, edit):
            return
        points = self._session.active_curve.points
        corners = [index for index in corners_of(view.source, segments) if not points[index].tied]
        ends = {index for each in segments for index in ends_of(view.source, each)}
        self._tell(f"{text}{f', corner at {_points(corners)}' if corners else ''}.", view, ends)

    def _reshape(
        self,
        verb: str,
        made: Callable[[CurveView, Collection[int]], Curve],
        selected: Sequence[int] | None = None,
    ) -> bool:
        """Put the curve that `made` returns for points, the selected ones, in the place of the active one."""
        session, view = self._session, self._session.active_view
        return self._apply(
            verb,
            lambda document, points: replace_curve(document, session.active_index, made(view, points)),
            selected,
        )

    def _apply(
        self,
        verb: str,
        edit: Callable[[Document, Collection[int]], Document],
        selected: Sequence[int] | None = None,
    ) -> bool:
        """Commit an edit of points; return whether the document is another one now."""
        points = sorted(self._session.selection) if selected is None else selected
        if not points:
            return False
        change = self._session.change(
            f"{verb} {words.points(points)}", lambda document: edit(document, points)
        )
        return change.is_done


def _straight_text(curve: Curve, segments: Sequence[int]) -> str:
    """Return "Straight segment 3–4", or how many they are."""
    if len(segments) > _MOST_NAMED:
        return f"{len(segments)} straight segments"
    names = [f"{start}–{end}" for start, end in (ends_of(curve, each) for each in segments)]
    return f"Straight segment{'s' if len(names) > 1 else ''} {', '.join(names)}"


def _points(indices: Collection[int]) -> str:
    """Return "point 3", "points 1, 2 and 3" or "7 points"."""
    if not 1 < len(indices) <= _MOST_NAMED:
        return words.points(indices)
    *first, last = map(str, sorted(indices))
    return f"points {', '.join(first)} and {last}"


def _kinds(now: Situation) -> set[int]:
    """Return the kinds that the selected points are of, by their places."""
    return set(kinds_of(now.view)[sorted(now.selection)].tolist()) if HERMITE_POINTS.is_met(now) else set()


COMMAND_SETS = (TangentCommands,)
