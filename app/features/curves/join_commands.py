"""Joins of selected ends; else of the nearest ends of selected curves, or the end to the nearest start."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import numpy as np

from ...actions.declaration import action, also
from ...actions.menus import (
    CURVE_LIST_BUTTONS,
    CURVE_LIST_MENU,
    CURVE_MENU,
    CURVE_SHAPE,
    POINT_MENU,
    POINTS_NUMBER,
    WHOLES_MENU,
)
from ...actions.needs import SECOND_CURVE, Need
from ...document import curve_edits
from ...document.model import Document
from ...document.several_curves import remove_curves
from ...document.words import number
from ...view_model.append import with_closed
from ...view_model.curve.curve_view import CurveView
from ...view_model.join import (
    End,
    Joined,
    Link,
    brought_together,
    end_of,
    joined_by,
    link_of,
    nearest_links,
    position_of,
)
from ...workbench.context import CommandSet


class JoinCommands(CommandSet):
    """Actions that join several curves to one."""

    @action(
        "joinCurve",
        "Join Ends",
        CURVE_SHAPE,
        "Ctrl+J, Alt+J",
        "join",
        full_name="Join Ends of Curves",
        needs=Need(
            "two selected ends, or a second curve",
            lambda state: state.is_current and (SECOND_CURVE.is_met(state) or state.has_two_ends),
        ),
        keywords="connect nodes combine close path weld start",
    )
    @also(
        CURVE_MENU(12),
        WHOLES_MENU(34),
        POINT_MENU(21),
        CURVE_LIST_MENU(32),
        CURVE_LIST_BUTTONS(13),
    )
    def _join(self) -> None:
        """Join the selected ends, or one to the nearest; else the nearest ends, or the end to a start."""
        session = self._session
        link = link_of(session.views, session.selected.group)
        if link is not None:
            self._join_ends(link)
        elif len(session.selected.group.parts) > 1:
            session.refuse("Select only one end of each of two open curves to join them there.")
        elif len(session.selected.whole_curves) > 1:
            self._join_selected()
        else:
            self._join_to_nearest()

    @action(
        "mergeEnds",
        "Merge Ends",
        POINTS_NUMBER,
        "Shift+J",
        "merge",
        full_name="Merge Ends into One Point",
        needs=Need("two selected ends of open curves", lambda state: state.has_two_ends),
        keywords="join nodes weld close path middle",
    )
    @also(POINT_MENU(23))
    def _merge(self) -> None:
        """Merge two selected ends into one point halfway between them; their handles move with them."""
        session = self._session
        link = link_of(session.views, session.selected.group)
        if link is not None:
            moved, distance = brought_together(session.views, link)
            if self._join_ends(link, moved):
                length = f"{number(distance, 2)} {session.document.unit}".rstrip()
                session.say(f"Merged two ends into one point: each moved by {length}.")

    def _join_ends(self, link: Link, views: Sequence[CurveView] | None = None) -> bool:
        """Join two ends of the given views; return whether they are joined."""
        session, active = self._session, self._session.active_index
        views = session.views if views is None else views
        ends = {end.curve for end in link}
        if len(ends) > 1 or views[active].source.family.derivatives:
            return self._make(ends, active, lambda index: joined_by(views, [link], index))

        def closed(document: Document) -> Document:
            # A family without velocities cannot keep the shape: it closes by its rules.
            moved = document.with_curve(active, views[active].source)
            return with_closed(moved, active, views[active], closed=True)

        return session.change(_step_name(session.document, ends), closed).is_done

    @property
    def _selected_end(self) -> End | None:
        """The only selected point, if it is an end of an open curve."""
        return end_of(self._session.views, self._session.selected.group)

    def _join_selected(self) -> None:
        """Join the selected curves, first at the selected end if there is one."""
        session, views = self._session, self._session.views
        is_open = (index for index in session.selected.whole_curves if not views[index].source.is_closed)
        curves = sorted(index for index in is_open if len(views[index].points))
        if len(curves) < 2:
            session.refuse("Select at least two open curves to join them. Closed curves have no ends.")
            return
        target = session.active_index if session.active_index in curves else curves[-1]
        self._make(
            curves,
            target,
            lambda target: joined_by(
                views, nearest_links(views, curves, self._selected_end), target, is_ring=True
            ),
        )

    def _join_to_nearest(self) -> None:
        """Join the selected end of the active curve to the nearest end; without one its end to a start."""
        session, index, selected = self._session, self._session.active_index, self._selected_end
        sides, end = (False,) if selected is None else (False, True), selected or End(index, is_last=True)
        partner = self._nearest_end(end, sides)
        if partner is None:
            session.refuse("There is no other visible open curve to join.")
            return
        link = (end, partner)
        self._make({index, partner.curve}, index, lambda curve: joined_by(session.views, [link], curve))

    def _nearest_end(self, end: End, sides: Collection[bool]) -> End | None:
        """Return the nearest end of another visible open curve, of some sides; of a locked one if need be."""
        views, start = self._session.views, position_of(self._session.views, end)
        others = [
            End(index, is_last)
            for index, view in enumerate(views)
            if index != end.curve and view.source.visible and view.is_current and not view.source.is_closed
            for is_last in sides
        ]

        def rank(other: End) -> tuple[bool, float]:
            return views[other.curve].source.locked, float(np.hypot(*(position_of(views, other) - start)))

        return min(others, key=rank, default=None)

    def _make(self, curves: Collection[int], target: int, make: Callable[[int], Joined]) -> bool:
        """Replace the curve `target` by the result of `make`, and remove the others; return success."""
        session, results, before = self._session, list[Joined](), self._session.document.curves
        others = set(curves) - {target}
        names = [session.document.curves[index].name for index in (*sorted(others), target)]

        def edit(document: Document) -> Document:
            results.append(make(target))
            document = curve_edits.replace_curve(document, target, results[0].curve)
            return remove_curves(document, others)

        active = target - sum(index < target for index in others)
        if not session.change(_step_name(session.document, curves, target), edit, active=active):
            return False
        if session.selected.is_editing:
            session.selected.set_points(results[0].seams)
        else:
            session.selected.select_whole([session.active_index])
        what = f"{len(names)} curves" if others else "both ends"
        if len(names) == 2:
            what = f"with “{names[0]}”, {results[0].ends}"
        done = f"Joined {what}: {results[0].outcome}."
        session.report(done, before, [results[0].curve.points[index].position for index in results[0].seams])
        return True


def _step_name(document: Document, curves: Collection[int], target: int = 0) -> str:
    if len(curves) > 2:
        return f"Join {len(curves)} curves"
    names = [document.curves[index].name for index in sorted(curves, key=lambda index: index != target)]
    return f"Join {names[0]} and {names[1]}" if len(names) == 2 else f"Close {names[0]}"
