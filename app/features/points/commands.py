"""Commands for points: selection, kinds, straight segments, and derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING

from ... import view_model
from ...actions.declaration import Action, PositionAction, action, action_for_each, also, also_for_each
from ...actions.menus import (
    CANVAS_MENU,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_RESETS,
    EDIT_SELECT,
    POINT_BUTTONS,
    POINT_MENU,
    POINTS_EDITING,
    POINTS_KINDS,
    POINTS_VELOCITIES,
    WHOLES_MENU,
)
from ...actions.needs import HERMITE_CURVE, HERMITE_POINTS, SOME_CURVE, Need
from ...document.constraints import ends_of
from ...document.curve_edits import replace_curve
from ...document.limits import AlreadySoError, EditError
from ...document.model import Curve, Document
from ...document.point_edits import clear_derivatives, explicit_points
from ...document.point_group import PointGroup, group_points, points_of, reset_message
from ...document.selection import NONE_SELECTABLE, all_points, selectable_curves
from ...document.straight_edits import corners_of, straight_refusal
from ...document.words import enumerated, number
from ...view_model.curve.curve_view import CurveView
from ...view_model.curve.handles import with_velocities_pulled
from ...view_model.geometry import segment_at
from ...view_model.point_kinds import (
    POINT_KINDS,
    PointKind,
    inner_points,
    segments_between,
    why_no_kinds,
    with_straight_segments,
)
from ...workbench.context import CommandSet

if TYPE_CHECKING:
    from ...view_model.match_curvature import Joint

_Reshape = Callable[[CurveView, Sequence[int]], Curve]
"""Returns the curve of a view with some of its points or segments changed."""

_CLEAR_OF_DISC = 16.0
"""Pixels from a point at which a handle is clear of the point's disc."""

_MOST_NAMED = 3
"""Largest number of segments that a sentence names one by one."""

_HAS_KINDS = Need(HERMITE_POINTS.words, HERMITE_POINTS.is_met, why=lambda state: why_no_kinds(state.family))


class TangentCommands(CommandSet):
    """Actions for the kinds of points, straight segments and velocities."""

    @action_for_each(
        POINT_KINDS,
        lambda kind: Action(
            kind.action,
            kind.title,
            POINTS_KINDS,
            kind.key,
            kind.name,
            kind.tip,
            f"{kind.title} Tangents",
            needs=_HAS_KINDS,
            checked=lambda state: state.point_kinds == {POINT_KINDS.index(kind)},
            keywords=kind.keywords,
        ),
    )
    @also_for_each(
        lambda kind: [*(strip(10 + POINT_KINDS.index(kind)) for strip in (POINT_MENU, POINT_BUTTONS))]
    )
    def _apply_kind(self, kind: PointKind) -> None:
        """Give the selected points a kind."""
        group, curves = self._session.selected.group, self._session.document.curves
        inner = group_points(
            (curve, frozenset(inner_points(curves[curve], indices)) if kind.ends else indices)
            for curve, indices in group.parts
        )
        left_out = f"; {kind.ends}" if inner.count < group.count else ""
        if self._reshape(kind.step, kind.apply, inner if inner.parts else group):
            self._report(f"{kind.title} at {inner.names}{left_out}.", curves, inner)

    @action(
        "straightSegment",
        "Straight Segment",
        POINTS_KINDS,
        "Alt+4, Shift+L",
        "straight",
        needs=Need(
            HERMITE_CURVE.words,
            lambda state: state.is_current and not straight_refusal(state.family),
            why=lambda state: straight_refusal(state.family),
        ),
    )
    @also(POINT_MENU(15), POINT_BUTTONS(15))
    def _straighten_selected(self) -> None:
        """Make the segments between neighbouring selected points straight; tangents in line stay."""
        session, curves = self._session, self._session.document.curves
        segments = group_points(
            (curve, frozenset(segments_between(curves[curve], indices)))
            for curve, indices in session.selected.group.parts
        )
        if segments.parts:
            self._straighten(segments)
        else:
            session.refuse("Select two neighbouring points, or right-click the segment.")

    @action(
        "pullVelocity",
        "Pull Out Velocity",
        POINTS_VELOCITIES,
        "",
        "spline-pointer",
        "Give the selected points their own handles to drag (also Alt+drag on a point)",
        needs=HERMITE_POINTS,
        keywords="handle velocity tangent",
    )
    @also(POINT_MENU(16))
    def _pull_velocities(self) -> None:
        group, pixel = self._session.selected.group, self._context.central.canvas.camera.pixel_size
        subject = "The velocity is" if group.only_point else "All velocities are"
        self._reshape(
            "Pull out velocity of",
            lambda view, points: with_velocities_pulled(view, points, _CLEAR_OF_DISC * pixel),
            group,
            f"{subject} already pulled out. Drag a square handle.",
        )

    @action(
        "matchCurvature",
        "Match Curvature",
        POINTS_VELOCITIES,
        icon="match-curvature",
        needs=Need(
            "selected smooth points, or two curves whose ends meet",
            lambda state: state.is_current and (state.selected_count > 0 or state.selected_curve_count > 1),
        ),
        keywords="harmonise harmonize continuous G2 balance handles",
    )
    @also(POINT_MENU(17), WHOLES_MENU(36))
    def _match_curvature(self) -> None:
        """Make the curvature continuous at selected smooth points, or where the ends of curves meet."""
        session, views = self._session, self._session.views
        joints = view_model.match_curvature.joints_of(
            views, session.selected.group, session.selected.whole_curves
        )
        if not joints:
            raise EditError("Select smooth points, ends that meet, or curves whose ends meet.")
        if len(joints) > (most := view_model.match_curvature.MOST_JOINTS):
            raise EditError(f"Select at most {most} points: their curvatures are matched together.")
        result = view_model.match_curvature.matched(views, joints)
        refused = result.refusals
        by_reason = {why: [joint for joint in refused if refused[joint] == why] for why in refused.values()}
        left = "".join(f" Not at {_joints_text(views, some)}: {why}." for why, some in by_reason.items())
        if left and not result.joints:
            raise EditError(f"Nothing was changed.{left}")

        def edit(document: Document) -> Document:
            if not result.joints:
                raise AlreadySoError(f"The curvature is continuous already at {text}.")
            for curve, new in result.changed_curves.items():
                document = replace_curve(document, curve, new)
            return document

        text = _joints_text(views, result.joints or joints)
        if session.change(f"Match curvature at {text}", edit):
            change = f"{number(result.largest_change(views), 2)} {session.document.unit}".rstrip()
            if result.turn:
                apart = number(math.degrees(result.turn), 2)
                change += f"; tangents {apart}° apart were turned into line"
            session.say(f"Curvature matched at {text}: largest change {change}.{left}")

    def _report(self, done: str, before: Sequence[Curve], group: PointGroup) -> None:
        """Report the change of these points, and others that were set to keep the shape."""
        own = [before[curve].points[index].position for curve, indices in group.parts for index in indices]
        self._session.report(done, before, own)

    # Straight segments

    @PositionAction("straightHere", "Straight Segment", like="straightSegment")
    def straighten_at(self, t: float) -> None:
        """Make the segment of the active curve at `t` straight."""
        session = self._session
        segment = segment_at(session.active_view.parameters, t)
        self._straighten(points_of(session.active_index, [segment]))

    def _straighten(self, segments: PointGroup) -> None:
        """Make segments straight; the index of a segment is that of its first point."""
        before = self._session.document.curves
        text = _segments_text(before, segments)
        if not self._change(text, with_straight_segments, segments, "The segment is already straight."):
            return
        after, corners, tangents, ends = self._session.document.curves, [], [], []
        for curve, indices in segments.parts:
            new_corners = frozenset(corners_of(before[curve], sorted(indices)))
            tied = frozenset(index for index in new_corners if after[curve].points[index].tied)
            corners.append((curve, new_corners - tied))
            tangents.append((curve, tied))
            both_ends = (ends_of(before[curve], segment) for segment in indices)
            ends.append((curve, frozenset(chain.from_iterable(both_ends))))
        kinds = [
            f", {kind} at {group.names}"
            for kind, points in (("corner", corners), ("tangent", tangents))
            if (group := group_points(points)).parts
        ]
        self._report(f"{text}{''.join(kinds)}.", before, group_points(ends))

    def _reshape(self, verb: str, reshape: _Reshape, group: PointGroup, idle: str = "") -> bool:
        """Replace curves by those that `reshape` returns for some of their points.

        `idle` is the message for no change. Return whether the document has changed.
        """
        return bool(group.parts) and self._change(f"{verb} {group.label}", reshape, group, idle)

    def _change(self, text: str, reshape: _Reshape, group: PointGroup, idle: str = "") -> bool:
        views = self._session.views

        def reshape_curve(document: Document, curve: int, indices: Collection[int]) -> Document:
            view = views[curve]
            if reason := why_no_kinds(view.source.family) or view.problem:
                raise EditError(reason)
            return replace_curve(document, curve, reshape(view, sorted(indices)))

        def edit(document: Document) -> Document:
            changed = group.apply(document, reshape_curve)
            if idle and changed == document:
                raise AlreadySoError(idle)
            return changed

        return self._session.change(text, edit).is_done


def _segments_text(curves: Sequence[Curve], segments: PointGroup) -> str:
    """Return a text such as "Straight segment 3–4", or the number of segments."""
    if segments.count > _MOST_NAMED or len(segments.parts) > 1:
        return f"{segments.count} straight segments"
    names = [
        f"{start}–{end}"
        for curve, indices in segments.parts
        for start, end in (ends_of(curves[curve], segment) for segment in sorted(indices))
    ]
    return f"Straight segment{'s' if len(names) > 1 else ''} {', '.join(names)}"


_RESET_WORDS = "estimated automatic auto default clear velocity acceleration handle tangent"


def _joints_text(views: Sequence[CurveView], joints: Sequence[Joint]) -> str:
    """Return "points 1 and 3", or "the ends of “A” and “B”"."""
    points = [one for one, other in joints if one[:2] == other[:2]]
    group = group_points((side.curve, frozenset({side.point})) for side in points)
    pairs = [[views[side.curve].source.name for side in joint] for joint in joints if joint[0] not in points]
    ends = (enumerated([f"“{name}”" for name in dict.fromkeys(names)]) for names in pairs)
    return enumerated([*([group.names] if points else []), *(f"the ends of {names}" for names in ends)])


class PointCommands(CommandSet):
    """Actions to select all points or the others, to edit points, and to reset derivatives."""

    @action(
        "selectAll",
        "Select All",
        EDIT_SELECT,
        "Ctrl+A",
        "select-all",
        full_name="Select All Points",
        needs=SOME_CURVE,
    )
    @also(CANVAS_MENU(11))
    def _select_all(self) -> None:
        """Select all points of the edited curves, or all visible, unlocked curves if none is edited."""
        session, selected = self._session, self._session.selected
        if selected.is_editing:
            selected.set_group(all_points(session.document, selected.active_curves))
            if len(selected.group.parts) > 1:
                session.say(f"{selected.group.count_label} selected.")
        else:
            selected.select_whole(free := selectable_curves(session.document))
            if not free:
                session.refuse(NONE_SELECTABLE)

    @action(
        "invertSelection",
        "Invert Selection",
        EDIT_SELECT,
        "!",
        "select-inverse",
        needs=SOME_CURVE,
        keywords="opposite others rest unselected",
    )
    @also(CANVAS_MENU(14))
    def _invert(self) -> None:
        """Select the other points of the edited curves, or the other visible curves if none is edited."""
        session, selected = self._session, self._session.selected
        curves = session.document.curves
        if selected.is_editing:
            selected.set_group(
                group_points(
                    (curve, frozenset(range(len(curves[curve].points))) - selected.group.of(curve))
                    for curve in selected.active_curves
                )
            )
        elif free := selectable_curves(session.document):
            selected.select_whole(free - selected.whole_curves)
        else:
            session.refuse(NONE_SELECTABLE)

    @action(
        "editCurve",
        "Edit Curve",
        POINTS_EDITING,
        icon="spline-pointer",
        checked=lambda state: state.is_editing,
        keywords="points nodes whole curves leave",
    )
    @also(CANVAS_MENU(13), WHOLES_MENU(1), CURVE_LIST_MENU(1))
    def _edit_or_leave(self) -> None:
        """Show and edit the points of the selected curves (Enter), or return to whole curves (Escape)."""
        selected = self._session.selected
        if selected.is_editing:
            selected.select_whole(selected.curves)
        else:
            selected.edit_selected()

    @action(
        "resetVelocities",
        "Reset to Estimate",
        POINTS_VELOCITIES,
        icon="reset",
        full_name="Reset Selected Points to Estimate",
        needs=Need(
            "selected points with a derivative set by hand",
            lambda state: state.has_explicit,
            why=lambda state: why_no_kinds(state.family),
        ),
        keywords=_RESET_WORDS,
    )
    @also(POINT_MENU(16))
    def _reset_selected(self) -> None:
        """Let the rules estimate the derivatives of the selected points; corners stay corners."""
        self._reset(self._session.selected.group)

    @action(
        "resetAllPoints",
        "Reset All to Estimate",
        CURVE_RESETS,
        icon="reset",
        full_name="Reset All Points to Estimate",
        needs=HERMITE_CURVE,
        keywords=_RESET_WORDS,
    )
    @also(CURVE_MENU(15), WHOLES_MENU(41))
    def _reset_all(self) -> None:
        """Let the rules estimate the derivatives of all points of the selected curves; corners stay."""
        self._reset(all_points(self._session.document, self._session.selected.curves))

    @action(
        "resetKept",
        "Reset Others to Estimate",
        CURVE_RESETS,
        icon="reset",
        short="Reset to Estimate",
        full_name="Reset Points Set to Keep the Shape to Estimate",
        needs=Need("points that the last step has set to keep the shape", lambda state: state.has_newly_set),
        keywords=_RESET_WORDS,
    )
    def _reset_kept(self) -> None:
        """Let the rules estimate the points again that the last step has set to keep the shape."""
        self._reset(self._session.newly_set)

    def _reset(self, group: PointGroup) -> None:
        session, curves = self._session, self._session.document.curves
        reset = group_points(
            (curve, explicit_points(curves[curve], indices)) for curve, indices in group.parts
        )
        if not reset.parts:
            session.refuse("All derivatives are estimates already.")
        elif session.change(f"Reset {reset.label} to estimate", partial(reset.apply, edit=clear_derivatives)):
            session.say(reset_message(f"Reset {reset.names}", session.document.curves, reset))


COMMAND_SETS = (TangentCommands, PointCommands)
