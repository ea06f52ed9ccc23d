"""Order, shapes and groups of curves: raised, lowered and walked through, combined and grouped."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING

from ...actions.declaration import action, also
from ...actions.menus import (
    ARRANGE_GROUPS,
    ARRANGE_ORDER,
    ARRANGE_SHAPES,
    ARRANGE_WALK,
    CURVE_LIST_MENU,
    CURVE_MENU,
    WHOLES_MENU,
)
from ...actions.needs import SECOND_CURVE, SOME_CURVE, Need
from ...document.curve_edits import remove_curve
from ...document.group_edits import (
    Gathered,
    break_apart,
    combine,
    group_curves,
    groups_to_ungroup,
    order_after_step,
    order_at_end,
    ungroup,
)
from ...document.groups import expand_to_shapes, node_count_label
from ...document.model import Document
from ...document.several_curves import active_after_removal, index_of, name_or_count, reorder_curves
from ...document.words import count_of
from ...view_model.geometry import fills_holes
from ...workbench.context import CommandSet

if TYPE_CHECKING:
    from ...session import Session


Arrange = Callable[[Document, Collection[int], int], Sequence[int]]
"""Function that returns the order of curves after some have moved to the front (1) or the back (−1)."""

_CURVE_IN_FRONT = Need(
    "a curve in front of this one",
    lambda state: state.has_curve_in_front,
    why="The curve is already at the top.",
    is_redundant=True,
)
_CURVE_BEHIND = Need(
    "a curve behind this one",
    lambda state: state.has_curve_behind,
    why="The curve is already at the bottom.",
    is_redundant=True,
)


class OrderCommands(CommandSet):
    """Actions that change the order of the selected curves, and go through it."""

    @action(
        "raiseCurve",
        "Raise",
        ARRANGE_ORDER,
        "Ctrl+Shift+PgUp",
        "move-up",
        full_name="Raise Curve",
        needs=_CURVE_IN_FRONT,
    )
    def _raise(self) -> None:
        """Move the selected curves one step to the front."""
        self._commit_gathered("Raise {}", order_after_step, 1, "one step to the front")

    @action(
        "lowerCurve",
        "Lower",
        ARRANGE_ORDER,
        "Ctrl+Shift+PgDown",
        "move-down",
        full_name="Lower Curve",
        needs=_CURVE_BEHIND,
    )
    def _lower(self) -> None:
        """Move the selected curves one step to the back."""
        self._commit_gathered("Lower {}", order_after_step, -1, "one step to the back")

    @action(
        "raiseToTop",
        "Raise to Top",
        ARRANGE_ORDER,
        "Ctrl+Shift+Home",
        "move-to-top",
        full_name="Raise Curve to Top",
        needs=_CURVE_IN_FRONT,
        keywords="bring to front order",
    )
    def _raise_to_top(self) -> None:
        """Move the selected curves to the front of the document, or of their group."""
        self._commit_gathered("Raise {} to top", order_at_end, 1, "to the top")

    @action(
        "lowerToBottom",
        "Lower to Bottom",
        ARRANGE_ORDER,
        "Ctrl+Shift+End",
        "move-to-bottom",
        full_name="Lower Curve to Bottom",
        needs=_CURVE_BEHIND,
        keywords="send to back order",
    )
    def _lower_to_bottom(self) -> None:
        """Move the selected curves to the back of the document, or of their group."""
        self._commit_gathered("Lower {} to bottom", order_at_end, -1, "to the bottom")

    def _commit_gathered(self, name: str, arrange: Arrange, step: int, where: str) -> None:
        """Move the selected curves in the order, as one step."""
        session = self._session
        what = name_or_count(session.document, session.selected.with_shapes)
        document = reorder_curves(session.document, arrange(session.document, session.selected.curves, step))
        active = index_of(document, session.active_curve)
        if session.change(name.format(what), lambda _: document, active=active):
            session.say(f"Moved {what} {where}.")

    @action(
        "nextCurve",
        "Next Curve",
        ARRANGE_WALK,
        "Ctrl+PgDown",
        needs=SECOND_CURVE,
    )
    def _go_on(self) -> None:
        """Edit the next curve in the list."""
        self._walk(-1)

    @action(
        "previousCurve",
        "Previous Curve",
        ARRANGE_WALK,
        "Ctrl+PgUp",
        needs=SECOND_CURVE,
    )
    def _go_back(self) -> None:
        """Edit the previous curve in the list."""
        self._walk(1)

    def _walk(self, step: int) -> None:
        # The next curve in the list is the one behind.
        session = self._session
        session.selected.activate((session.active_index + step) % len(session.document.curves))
        session.say(f"Editing “{session.active_curve.display_name}”.")


def _selected_with_shapes(session: Session) -> frozenset[int]:
    """Return the selected or edited curves, with all others of their shapes."""
    return expand_to_shapes(session.document, session.selected.marked)


class ShapeCommands(CommandSet):
    """Actions on shapes and groups."""

    # Shapes

    @action(
        "combineCurves",
        "Combine",
        ARRANGE_SHAPES,
        "Ctrl+K, Ctrl+Alt+K",
        "combine",
        full_name="Combine Curves",
        needs=Need("at least two selected curves", lambda state: state.can_combine),
        keywords="compound path, hole, make shape, counter",
    )
    @also(CURVE_MENU(40))
    def _combine(self) -> None:
        """Combine the selected curves into one shape with one fill; curves inside others become holes."""
        session, curves = self._session, _selected_with_shapes(self._session)
        views = [session.views[index] for index in sorted(curves)]
        has_holes = fills_holes([view.polyline for view in views if view.has_curve])
        combined = combine(session.document, curves, alternate=has_holes)
        if self._commit_gathered(f"Combine {name_or_count(session.document, curves)}", combined):
            name = session.active_curve.shape
            rule = "; the even-odd rule keeps its holes open" if has_holes else ""
            session.say(f"“{name}” is a shape of {count_of(len(combined.indices), 'curve')}{rule}.")

    @action(
        "breakApart",
        "Break Apart",
        ARRANGE_SHAPES,
        "Ctrl+Shift+K",
        "break-apart",
        full_name="Break Shape Apart",
        needs=Need("a shape of several curves", lambda state: state.is_any_in_shape),
        keywords="release compound path, uncombine",
    )
    @also(CURVE_MENU(41))
    def _break_apart(self) -> None:
        """Break the selected shapes apart into separate curves."""
        session, curves = self._session, _selected_with_shapes(self._session)
        what = name_or_count(session.document, curves)
        if session.change(f"Break {what} apart", lambda document: break_apart(document, curves)):
            self._choose(curves)
            session.say(f"{count_of(len(curves), 'curve')}; each now has its own fill.")

    @action(
        "deleteContour",
        "Delete Only This Curve",
        ARRANGE_SHAPES,
        icon="delete",
        full_name="Delete Only This Curve of the Shape",
        needs=Need("a shape of several curves", lambda state: state.is_in_shape),
        keywords="remove hole, contour, subpath",
    )
    def _delete_contour(self) -> None:
        """Delete the edited curve and keep the other curves of its shape."""
        session, index = self._session, self._session.active_index
        session.change(
            f"Delete {session.active_curve.name}",
            lambda document: remove_curve(document, index),
            active=active_after_removal(session.document, {index}, index),
        )

    # Groups

    @action(
        "groupCurves",
        "Group",
        ARRANGE_GROUPS,
        "Ctrl+G",
        "group",
        full_name="Group Curves",
        needs=SOME_CURVE,
    )
    @also(CURVE_MENU(42), WHOLES_MENU(30), CURVE_LIST_MENU(53))
    def _group(self) -> None:
        """Group the selected curves, to select and move them as one."""
        session, curves = self._session, _selected_with_shapes(self._session)
        grouped = group_curves(session.document, curves)
        if self._commit_gathered(f"Group {name_or_count(session.document, curves)}", grouped):
            # For a single curve, the new group is the one around it, not the selection.
            (group, *_) = groups_to_ungroup(session.document, grouped.indices)
            session.say(f"“{group.name}” has {node_count_label(group.children)}.")

    @action(
        "ungroupCurves",
        "Ungroup",
        ARRANGE_GROUPS,
        "Ctrl+Shift+G",
        "ungroup",
        full_name="Ungroup Curves",
        needs=Need("a curve in a group", lambda state: state.is_any_in_group),
    )
    @also(CURVE_MENU(43), WHOLES_MENU(31), CURVE_LIST_MENU(54))
    def _ungroup(self) -> None:
        """Ungroup the selected group, or the group of the curve; shapes are kept."""
        session, curves = self._session, _selected_with_shapes(self._session)
        nodes = groups_to_ungroup(session.document, curves)
        what = nodes[0].name if len(nodes) == 1 else f"{len(nodes)} groups"
        with session.batch:
            is_done = bool(session.change(f"Ungroup {what}", lambda document: ungroup(document, curves)))
            if is_done:
                self._choose([index for node in nodes for index in node.indices])
        if is_done:
            session.say(f"Ungrouped {what}.")

    # Both

    def _commit_gathered(self, text: str, gathered: Gathered) -> bool:
        """Commit a combined or grouped document, and select its curves; return whether it is done."""
        session = self._session
        active = gathered.order.index(session.active_index)
        with session.batch:
            is_done = bool(session.change(text, lambda _: gathered.document, active=active))
            if is_done:
                self._choose(gathered.indices)
        return is_done

    def _choose(self, curves: Collection[int]) -> None:
        self._session.selected.select_whole(curves)
