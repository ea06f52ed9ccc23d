"""Curves and their segments: new, insert, split, reverse, close, delete segments."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from msgspec.structs import replace

from ...actions.declaration import PositionAction, action, also
from ...actions.keymap import key_or_name
from ...actions.menus import (
    CANVAS_MENU,
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_NEW,
    CURVE_SHAPE,
    POINT_MENU,
    POINTS_NUMBER,
)
from ...actions.needs import HERMITE_CURVE, TWO_POINTS, UNLOCKED_CURVE, Need
from ...document import curve_edits
from ...document.curve_edits import replace_by_parts
from ...document.model import Curve, Document, Parametrization
from ...document.point_group import NO_POINTS, group_points
from ...document.several_curves import name_or_count, whole_curves
from ...document.straight_edits import straight_refusal
from ...document.words import count_of, number
from ...tools.bend import insert_at
from ...view_model.append import Halved, with_closed, with_midpoints
from ...view_model.geometry import segment_at
from ...view_model.point_kinds import segments_between
from ...view_model.reshape import Reshaped, reversed_curve
from ...view_model.split import Split, parameters_between_ends, split, without_segments
from ...workbench.context import WindowContext
from .arrange_commands import OrderCommands, ShapeCommands
from .join_commands import JoinCommands


def _with_curves(document: Document, curves: Mapping[int, Curve]) -> Document:
    """Return the document with other curves in some places."""
    new = (curves.get(place, curve) for place, curve in enumerate(document.curves))
    return replace(document, curves=tuple(new))


class CurveCommands:
    """Actions on a whole curve."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session

    # Number

    @action("newCurve", "New Curve", CURVE_NEW, "Ctrl+Shift+N", "plus")
    @also(CANVAS_MENU(22), CURVE_LIST_BUTTONS(10))
    def _new(self) -> None:
        """Add a curve and draw it with the pen."""
        session, place = self._session, len(self._session.document.curves)
        fresh = curve_edits.new_curve_like(session.document, session.model, Parametrization())
        if session.change(
            f"New {fresh.name}",
            lambda document: curve_edits.add_curve(document, place, fresh),
            active=place,
        ):
            self._context.actions["addTool"].trigger()

    # Shape

    @action(
        "insertPoint",
        "Insert Point at the Scrub Line",
        POINTS_NUMBER,
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
        """Insert a point on the active curve at `t`."""
        insert_at(self._session, t)

    @action(
        "insertMidpoints",
        "Insert Points Between",
        POINTS_NUMBER,
        "Ins",
        "insert-points",
        needs=UNLOCKED_CURVE,
        keywords="add nodes midpoints halve segments subdivide",
    )
    @also(POINT_MENU(17))
    def _insert_between(self) -> None:
        """Insert a point in the middle of each segment between selected points, keeping the shape."""
        session, views, made = self._session, self._session.views, dict[int, Halved]()
        segments = {
            curve: segments_between(views[curve].source, indices)
            for curve, indices in session.selected.group.parts
        }
        group = group_points((curve, frozenset(each)) for curve, each in segments.items())
        if not group.parts:
            session.refuse(
                "Select two neighbouring points, or double-click the curve to insert a point there."
            )
            return

        def one(document: Document, curve: int, between: Collection[int]) -> Document:
            made[curve] = with_midpoints(views[curve], between, session.selected.group.of(curve))
            return curve_edits.replace_curve(document, curve, made[curve].reshaped.curve)

        new = count_of(group.count, "point")
        if session.change(f"Insert {new} between", lambda document: group.apply(document, one)):
            kept = {curve: each.old | each.new for curve, each in made.items()}
            session.selected.set_group(group_points(kept.items()))
            told = (each.reshaped.sentence for each in made.values())
            session.say(" ".join(("Inserted", f"{new}.", *told)))

    @PositionAction("splitHere", "Split Here", like="splitCurve")
    def split_at(self, t: float) -> None:
        """Split the active curve at `t`."""
        session, done = self._session, list[Split]()

        def edit(document: Document) -> Document:
            done.append(split(session.active_view, t))
            return curve_edits.replace_by_parts(document, session.active_index, *done[0].curves)

        if session.change(f"Split {session.active_curve.name}", edit):
            verb = "Split" if len(done[0].curves) > 1 else "Opened"
            session.say(f"{verb} at t = {number(t)}: {done[0].sentence}")

    def _at_scrub(self, act: Callable[[float], None]) -> None:
        t = self._session.scrub.t
        if t is None:
            self._session.refuse(
                "Select inner points, or move the scrub line (T) to the position on the curve."
            )
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
            curve: found
            for curve, indices in self._session.selected.group.parts
            if (found := parameters_between_ends(self._session.views[curve], indices))
        }
        if not cuts:
            self._at_scrub(self.split_at)
        elif sum(map(len, cuts.values())) == 1 and self._session.active_index in cuts:
            self.split_at(*cuts[self._session.active_index])
        else:
            self._split_all(cuts)

    def _split_all(self, cuts: Mapping[int, Sequence[float]]) -> None:
        """Split curves at several places, each of its own; what was edited together stays so."""
        session, made = self._session, dict[int, Split]()

        def edit(document: Document) -> Document:
            # The foremost first: those behind it stay where they are.
            for curve in sorted(cuts, reverse=True):
                made[curve] = split(session.views[curve], *cuts[curve])
                document = curve_edits.replace_by_parts(document, curve, *made[curve].curves)
            return document

        edited, active = session.selected.curves, session.active_index
        if not session.change(f"Split {name_or_count(session.document, cuts)}", edit):
            return
        more = {curve: len(each.curves) - 1 for curve, each in made.items()}
        first = {curve: curve + sum(more[each] for each in more if each < curve) for curve in edited}
        parts = [first[curve] + k for curve in edited for k in range(more.get(curve, 0) + 1)]
        session.selected.set_curves(parts if len(edited) > 1 else (first[active],), first[active])
        residual = max(each.residual for each in made.values())
        whole = Split(tuple(curve for each in made.values() for curve in each.curves), residual)
        session.say(f"Split at {count_of(sum(map(len, cuts.values())), 'point')}: {whole.sentence}")

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
        views = [session.views[place] for place in several] or [view]
        if not all(each.is_current for each in views):
            problem = next(each.problem for each in views if not each.is_current)
            session.refuse(f"The curve cannot be reversed. {problem}")
        elif several:
            turned = {place: reversed_curve(session.views[place]).curve for place in several}
            what = whole_curves(session.document, several)
            if session.change(f"Reverse {what.label}", lambda document: _with_curves(document, turned)):
                session.selected.set_group(NO_POINTS)
                session.say(f"Reversed {what.quoted_label}.")
        elif self._reshape(f"Reverse {view.source.name}", lambda: reversed_curve(view)) is not None:
            session.selected.set_points([])

    @property
    def _several_whole(self) -> list[int]:
        """The curves that are meant, where these are several, those that have a course."""
        session, chosen = self._session, self._session.selected.meant
        several = [place for place in sorted(chosen) if len(session.document.curves[place].points) > 1]
        return several if len(chosen) > 1 else []

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
        """Close the curve smoothly, or open it, with all curves of its shape or selection."""
        session, views = self._session, self._session.views
        closed, places = not session.active_curve.is_closed, self._several_whole or [session.active_index]
        what = whole_curves(session.document, places)

        def edit(document: Document) -> Document:
            for place in places:
                if document.curves[place].is_closed != closed:
                    document = with_closed(document, place, views[place], closed)
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
        """Put what `make` returns in the place of the active curve, and say what that changed."""
        session, made = self._session, list[Reshaped]()

        def edit(document: Document) -> Document:
            made.append(make())
            return then(curve_edits.replace_curve(document, session.active_index, made[0].curve))

        if not session.change(text, edit):
            return None
        session.say(made[0].sentence)
        return made[0]


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
        """Delete the segment of the active curve that runs through `t`."""
        self._delete([segment_at(self._session.active_view.parameters, t)])

    def _delete(self, segments: Collection[int]) -> None:
        session, made = self._session, list[Split]()

        def edit(document: Document) -> Document:
            made.append(without_segments(session.active_view, segments))
            return replace_by_parts(document, session.active_index, *made[-1].curves)

        what = "segment" if len(segments) == 1 else count_of(len(segments), "segment")
        if session.change(f"Delete {what} of {session.active_curve.name}", edit):
            session.selected.set_points([])
            count = len(made[-1].curves)
            left = f"{count} curves remain" if count > 1 else "the curve is open"
            session.say(f"Deleted {what}: {left}, {made[-1].sentence}")


COMMAND_SETS = (CurveCommands, OrderCommands, JoinCommands, SegmentCommands, ShapeCommands)
