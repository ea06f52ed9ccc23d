"""Curves and their segments: new, insert, split, reverse, close, delete segments."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from msgspec.structs import replace

from ...actions.declaration import Action, PositionAction, action, action_for_each, also
from ...actions.keymap import key_or_name
from ...actions.menus import (
    ARRANGE_SPLIT,
    CANVAS_MENU,
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_NEW,
    CURVE_SHAPE,
    POINT_MENU,
    POINTS_INSERT,
    POINTS_NUMBER,
    POINTS_SPECIAL,
    WHOLES_MENU,
)
from ...actions.needs import HERMITE_CURVE, TWO_POINTS, UNLOCKED_CURVE, Need
from ...document import curve_edits
from ...document.curve_edits import replace_by_parts
from ...document.limits import AlreadySoError
from ...document.model import Curve, Document, Parametrization
from ...document.point_group import NO_POINTS, group_points
from ...document.several_curves import name_or_count, unlocked_curves, whole_curves
from ...document.straight_edits import straight_refusal
from ...document.words import count_of
from ...tools.bend import insert_at
from ...view_model.append import (
    SPECIAL_POINTS,
    SpecialPoints,
    WithPoints,
    special_points,
    with_closed,
    with_midpoints,
    with_points_at,
)
from ...view_model.geometry import segment_at
from ...view_model.point_kinds import segments_between
from ...view_model.reshape import Reshaped, reversed_curve
from ...view_model.split import Split, crossings_of, parameters_between_ends, split, without_segments
from ...workbench.context import CommandSet
from .arrange_commands import OrderCommands, ShapeCommands
from .join_commands import JoinCommands


def _with_curves(document: Document, curves: Mapping[int, Curve]) -> Document:
    """Return the document with some curves replaced."""
    new = (curves.get(index, curve) for index, curve in enumerate(document.curves))
    return replace(document, curves=tuple(new))


class CurveCommands(CommandSet):
    """Actions on a whole curve."""

    # Number

    @action("newCurve", "New Curve", CURVE_NEW, "Ctrl+Shift+N", "plus")
    @also(CANVAS_MENU(22), CURVE_LIST_BUTTONS(10))
    def _new(self) -> None:
        """Add a curve and draw it with the Add Points tool."""
        session, index = self._session, len(self._session.document.curves)
        fresh = curve_edits.new_curve_like(session.document, session.template_curve, Parametrization())
        if session.change(
            f"New {fresh.name}",
            lambda document: curve_edits.add_curve(document, index, fresh),
            active=index,
        ):
            self._context.actions["addTool"].trigger()

    # Shape

    @action(
        "insertPoint",
        "Insert Point at the Scrub Line",
        POINTS_INSERT,
        "I",
        "add",
        needs=UNLOCKED_CURVE,
        keywords="knot insertion, elevate degree elevation, refine, add control point",
    )
    def _insert(self) -> None:
        """Insert a point on the curve, keeping its shape; the parameters become manual where needed."""
        self._at_scrub(self.insert_at)

    @PositionAction("insertPointHere", "Insert Point Here", like="insertPoint")
    def insert_at(self, t: float) -> None:
        """Insert a point on the active curve at parameter `t`."""
        insert_at(self._session, t)

    @action(
        "insertMidpoints",
        "Insert Points Between",
        POINTS_INSERT,
        "Ins",
        "insert-points",
        needs=UNLOCKED_CURVE,
        keywords="add nodes midpoints halve segments subdivide",
    )
    @also(POINT_MENU(17))
    def _insert_between(self) -> None:
        """Insert a point in the middle of each segment between selected points, keeping the shape."""
        session, views, grown = self._session, self._session.views, dict[int, WithPoints]()
        before = session.document.curves
        segments = {
            curve: segments_between(views[curve].source, indices)
            for curve, indices in session.selected.group.parts
        }
        group = group_points((curve, frozenset(between)) for curve, between in segments.items())
        if not group.parts:
            session.refuse("Select two neighbouring points, or double-click the curve to insert a point.")
            return

        def one(document: Document, curve: int, between: Collection[int]) -> Document:
            grown[curve] = with_midpoints(views[curve], between, session.selected.group.of(curve))
            return curve_edits.replace_curve(document, curve, grown[curve].reshaped.curve)

        new = count_of(group.count, "point")
        if session.change(f"Insert {new} between", lambda document: group.apply(document, one)):
            point_sets = {curve: result.old | result.new for curve, result in grown.items()}
            session.selected.set_group(group_points(point_sets.items()))
            remarks = (result.reshaped.sentence for result in grown.values())
            session.report(" ".join(("Inserted", f"{new}.", *remarks)), before)

    @action_for_each(
        SPECIAL_POINTS,
        lambda kind: Action(
            kind.action,
            f"At {kind.title}",
            POINTS_SPECIAL,
            tip=f"Insert points at the {kind.name} of the curve, or of selected segments; its shape is kept",
            full_name=f"Insert Points at {kind.title}",
            needs=UNLOCKED_CURVE,
            keywords="add extremes nodes vertical horizontal turning vertices",
        ),
    )
    def _insert_special(self, kind: SpecialPoints) -> None:
        """Insert points at special points of the curves, or of the segments between selected points."""
        session, views, grown = self._session, self._session.views, dict[int, WithPoints]()
        before = session.document.curves
        free, some_taken = dict[int, list[float]](), False
        for curve in sorted(session.selected.target_curves):
            segments = segments_between(views[curve].source, session.selected.group.of(curve))
            free[curve], are_taken = special_points(views[curve], kind, segments)
            some_taken |= are_taken

        def edit(document: Document) -> Document:
            for curve, parameters in free.items():
                if parameters:
                    grown[curve] = with_points_at(views[curve], parameters)
                    document = curve_edits.replace_curve(document, curve, grown[curve].reshaped.curve)
            if not grown:
                have_points = f"All {kind.name} have points already."
                raise AlreadySoError(have_points if some_taken else f"There are no {kind.name}.")
            return document

        new = count_of(sum(map(len, free.values())), "point")
        if session.change(f"Insert {new} at {kind.name}", edit):
            if session.selected.is_editing:
                session.selected.set_group(group_points((curve, row.new) for curve, row in grown.items()))
            remarks = dict.fromkeys(row.reshaped.sentence for row in grown.values())
            session.report(" ".join((f"Inserted {new} at {kind.name}.", *remarks)), before)

    @PositionAction("splitHere", "Split Here", like="splitCurve")
    def split_at(self, t: float) -> None:
        """Split the active curve at `t`."""
        session, done, before = self._session, list[Split](), self._session.document.curves
        t_text = session.active_view.t_text(t)

        def edit(document: Document) -> Document:
            done.append(split(session.active_view, t))
            return curve_edits.replace_by_parts(document, session.active_index, *done[0].curves)

        if session.change(f"Split {session.active_curve.name}", edit):
            verb = "Split" if len(done[0].curves) > 1 else "Opened"
            session.report(f"{verb} at t = {t_text}: {done[0].sentence}", before, done[0].cuts)

    def _at_scrub(self, act: Callable[[float], None]) -> None:
        t = self._session.scrub.t
        if t is None:
            self._session.refuse("Select inner points, or move the scrub line (T) along the curve.")
        else:
            act(t)

    @action(
        "splitCurve",
        "Split",
        CURVE_SHAPE,
        "Shift+B",
        "split",
        full_name="Split Curve",
        needs=UNLOCKED_CURVE,
    )
    @also(POINT_MENU(20), CURVE_LIST_BUTTONS(14))
    def _split(self) -> None:
        """Split the curves at the selected points, or the curve at the scrub line."""
        cuts = {
            curve: parameters
            for curve, indices in self._session.selected.group.parts
            if (parameters := parameters_between_ends(self._session.views[curve], indices))
        }
        if not cuts:
            self._at_scrub(self.split_at)
        elif sum(map(len, cuts.values())) == 1 and self._session.active_index in cuts:
            self.split_at(*cuts[self._session.active_index])
        else:
            self._split_all(cuts)

    @action(
        "splitAtIntersections",
        "Split at Intersections",
        ARRANGE_SPLIT,
        icon="split",
        needs=UNLOCKED_CURVE,
        keywords="crossings cut divide trim scissors slice knife",
    )
    @also(CURVE_MENU(15), WHOLES_MENU(36), CURVE_LIST_MENU(35))
    def _split_at_intersections(self) -> None:
        """Split the selected curves where they cross or touch each other, and themselves."""
        session, views = self._session, self._session.views
        curves = sorted(unlocked_curves(session.document, session.selected.target_curves))
        crossings = crossings_of({curve: views[curve] for curve in curves if views[curve].is_current})
        along = "" if crossings.is_complete else "They run along each other, where they are not split."
        if crossings.cuts:
            self._split_all(crossings.cuts, "the intersections", along)
        else:
            session.refuse(f"The selected curves do not cross. {along}".rstrip())

    def _split_all(self, cuts: Mapping[int, Sequence[float]], where: str = "", remark: str = "") -> None:
        """Split each curve at its parameters; curves that are edited together stay so."""
        session, parts_of, before = self._session, dict[int, Split](), self._session.document.curves

        def edit(document: Document) -> Document:
            # The last index first: earlier indices do not change.
            for curve in sorted(cuts, reverse=True):
                parts_of[curve] = split(session.views[curve], *cuts[curve])
                document = curve_edits.replace_by_parts(document, curve, *parts_of[curve].curves)
            return document

        curves, active = session.selected.curves, session.active_index
        if not session.change(f"Split {name_or_count(session.document, cuts)}", edit):
            return
        more = {curve: len(result.curves) - 1 for curve, result in parts_of.items()}
        first = {curve: curve + sum(more[other] for other in more if other < curve) for curve in curves}
        parts = [first[curve] + k for curve in curves for k in range(more.get(curve, 0) + 1)]
        session.selected.set_curves(parts if len(curves) > 1 else (first[active],), first[active])
        residual = max(result.residual for result in parts_of.values())
        whole = Split(tuple(curve for result in parts_of.values() for curve in result.curves), residual)
        where = where or count_of(sum(map(len, cuts.values())), "point")
        count = count_of(len(whole.curves), "curve")
        session.report(
            f"Split at {where} into {count}: {whole.sentence} {remark}".rstrip(), before, whole.cuts
        )

    @action(
        "reverseCurve",
        "Reverse",
        CURVE_SHAPE,
        "Ctrl+R",
        "reverse",
        full_name="Reverse Curve",
        needs=TWO_POINTS,
    )
    @also(CURVE_MENU(11), CURVE_LIST_MENU(33), CURVE_LIST_BUTTONS(15))
    def _reverse(self) -> None:
        """Reverse the direction of the curve, of all curves of its shape, or of the selected curves."""
        session, view = self._session, self._session.active_view
        several = self._several_whole
        views = [session.views[index] for index in several] or [view]
        if not all(other.is_current for other in views):
            problem = next(other.problem for other in views if not other.is_current)
            session.refuse(f"The curve cannot be reversed. {problem}")
        elif several:
            turned = {index: reversed_curve(session.views[index]).curve for index in several}
            what = whole_curves(session.document, several)
            if session.change(f"Reverse {what.label}", lambda document: _with_curves(document, turned)):
                session.selected.set_group(NO_POINTS)
                session.say(f"Reversed {what.quoted_label}.")
        elif self._reshape(f"Reverse {view.source.name}", lambda: reversed_curve(view)) is not None:
            session.selected.set_points([])

    @property
    def _several_whole(self) -> list[int]:
        """The selected curves with at least two points, where several curves are selected."""
        session, selected = self._session, self._session.selected.target_curves
        several = [index for index in sorted(selected) if len(session.document.curves[index].points) > 1]
        return several if len(selected) > 1 else []

    @action(
        "closeCurve",
        "Closed",
        CURVE_SHAPE,
        "C",
        "closed",
        full_name="Closed Curve",
        checked=lambda state: state.is_closed,
    )
    @also(CURVE_MENU(10), CURVE_LIST_MENU(34), CURVE_LIST_BUTTONS(16))
    def _toggle_closed(self) -> None:
        """Close the curve smoothly, or open it, together with its shape or the selection."""
        session, views = self._session, self._session.views
        closed, indices = not session.active_curve.is_closed, self._several_whole or [session.active_index]
        what = whole_curves(session.document, indices)

        def edit(document: Document) -> Document:
            for index in indices:
                if document.curves[index].is_closed != closed:
                    document = with_closed(document, index, views[index], closed)
            return document

        if session.change(f"{'Close' if closed else 'Open'} {what.label}", edit):
            undo = key_or_name(self._context.actions["undo"])
            session.say(f"{'Closed' if closed else 'Opened'} {what.quoted_label} · {undo}: undo")

    def _reshape(
        self,
        text: str,
        make: Callable[[], Reshaped],
        then: Callable[[Document], Document] = lambda document: document,
    ) -> Reshaped | None:
        """Replace the active curve by the result of `make`, and show its message."""
        session, results, before = self._session, list[Reshaped](), self._session.document.curves

        def edit(document: Document) -> Document:
            results.append(make())
            return then(curve_edits.replace_curve(document, session.active_index, results[0].curve))

        if not session.change(text, edit):
            return None
        session.report(results[0].sentence, before)
        return results[0]


class SegmentCommands(CommandSet):
    """Actions that delete segments and keep the points at their ends."""

    @action(
        "deleteSegment",
        "Delete Segment",
        POINTS_NUMBER,
        "Alt+K",
        "delete-segment",
        needs=Need(
            HERMITE_CURVE.words,
            lambda state: UNLOCKED_CURVE.is_met(state) and not straight_refusal(state.family),
            why=lambda state: straight_refusal(state.family),
        ),
        keywords="open break cut out remove between nodes path",
    )
    @also(POINT_MENU(22))
    def _delete_between(self) -> None:
        """Delete the segments between selected points: a closed curve opens, an open curve splits."""
        session = self._session
        segments = segments_between(session.active_curve, session.selection)
        if segments:
            self._delete(segments)
        else:
            session.refuse("Select two neighbouring points, or right-click the segment.")

    @PositionAction("deleteSegmentHere", "Delete Segment", like="deleteSegment")
    def delete_at(self, t: float) -> None:
        """Delete the segment of the active curve at parameter `t`."""
        self._delete([segment_at(self._session.active_view.parameters, t)])

    def _delete(self, segments: Collection[int]) -> None:
        session, results, before = self._session, list[Split](), self._session.document.curves

        def edit(document: Document) -> Document:
            results.append(without_segments(session.active_view, segments))
            return replace_by_parts(document, session.active_index, *results[-1].curves)

        what = "segment" if len(segments) == 1 else count_of(len(segments), "segment")
        if session.change(f"Delete {what} of {session.active_curve.name}", edit):
            session.selected.set_points([])
            count = len(results[-1].curves)
            left = f"{count} curves remain" if count > 1 else "the curve is open"
            session.report(f"Deleted {what}: {left}, {results[-1].sentence}", before, results[-1].cuts)


COMMAND_SETS = (CurveCommands, OrderCommands, JoinCommands, SegmentCommands, ShapeCommands)
