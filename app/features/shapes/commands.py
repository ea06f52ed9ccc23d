"""Curves combined to shapes and gathered in groups, and both taken apart."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from ...actions.declaration import action, also
from ...actions.menus import ARRANGE_GROUPS, ARRANGE_SHAPES, CHOSEN_MENU, CURVE_LIST_MENU, CURVE_MENU
from ...actions.needs import SOME_CURVE, Need
from ...document.curve_edits import remove_curve
from ...document.group_edits import Gathered, broken_apart, combined, grouped, groups_meant, ungrouped
from ...document.groups import counted_nodes, whole_shapes
from ...document.several_curves import active_after_removal, named
from ...document.words import count_of
from ...view_model.geometry import fills_holes
from ...workbench.context import WindowContext

if TYPE_CHECKING:
    from ...session import Session


def _meant(session: Session) -> frozenset[int]:
    """Return the chosen curves, or the one that is edited, with all others of their shapes."""
    return whole_shapes(session.document, session.selected.marked)


class ShapeCommands:
    """Actions on shapes and groups."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    # Shapes

    @action(
        "combineCurves",
        "Combine",
        ARRANGE_SHAPES,
        "Ctrl+K, Ctrl+Alt+K",
        "combine",
        full_name="Combine Curves",
        needs=Need("two chosen curves or more", lambda state: state.can_combine),
        keywords="compound path, hole, make shape, counter",
    )
    @also(CURVE_MENU(40))
    def _combine(self) -> None:
        """Make one shape of the chosen curves: one fill, with holes where one lies within another."""
        session, curves = self._session, _meant(self._session)
        views = [session.views[place] for place in sorted(curves)]
        has_holes = fills_holes([view.polyline for view in views if view.has_curve])
        made = combined(session.document, curves, alternate=has_holes)
        if self._put(f"Combine {named(session.document, curves)}", made):
            name = session.active_curve.shape
            rule = "; the even-odd rule keeps its holes open" if has_holes else ""
            session.say(f"“{name}” is one shape of {count_of(len(made.places), 'curve')}{rule}.")

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
        """Make a curve of its own of each curve of the shape."""
        session, curves = self._session, _meant(self._session)
        what = named(session.document, curves)
        if session.change(f"Break {what} apart", lambda document: broken_apart(document, curves)):
            self._choose(curves)
            session.say(f"{count_of(len(curves), 'curve')} now, each with a fill of its own.")

    @action(
        "deleteContour",
        "Delete This Curve Alone",
        ARRANGE_SHAPES,
        icon="delete",
        full_name="Delete This Curve of the Shape",
        needs=Need("a shape of several curves", lambda state: state.is_in_shape),
        keywords="remove hole, contour, subpath",
    )
    def _delete_contour(self) -> None:
        """Delete the curve that is edited, and leave the others of its shape."""
        session, place = self._session, self._session.active_index
        session.change(
            f"Delete {session.active_curve.name}",
            lambda document: remove_curve(document, place),
            active=active_after_removal(session.document, {place}, place),
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
    @also(CURVE_MENU(42), CHOSEN_MENU(30), CURVE_LIST_MENU(53))
    def _group(self) -> None:
        """Gather the chosen curves in a group, which is chosen and moved as one."""
        session, curves = self._session, _meant(self._session)
        made = grouped(session.document, curves)
        if self._put(f"Group {named(session.document, curves)}", made):
            # Of one curve alone the group around it is what was made, and not what is chosen.
            (group, *_) = groups_meant(session.document, made.places)
            session.say(f"“{group.name}” has {counted_nodes(group.parts)}.")

    @action(
        "ungroupCurves",
        "Ungroup",
        ARRANGE_GROUPS,
        "Ctrl+Shift+G",
        "ungroup",
        full_name="Ungroup Curves",
        needs=Need("a curve in a group", lambda state: state.is_any_in_group),
    )
    @also(CURVE_MENU(43), CHOSEN_MENU(31), CURVE_LIST_MENU(54))
    def _ungroup(self) -> None:
        """Take the chosen group apart, or the one around the curve; shapes stay whole."""
        session, curves = self._session, _meant(self._session)
        nodes = groups_meant(session.document, curves)
        what = nodes[0].name if len(nodes) == 1 else f"{len(nodes)} groups"
        with session.batch:
            is_done = bool(session.change(f"Ungroup {what}", lambda document: ungrouped(document, curves)))
            if is_done:
                self._choose([place for node in nodes for place in node.places])
        if is_done:
            session.say(f"{what} is taken apart." if len(nodes) == 1 else f"{what} are taken apart.")

    # Both

    def _put(self, text: str, made: Gathered) -> bool:
        """Make what was brought together the document, and choose it; return whether it is."""
        session = self._session
        active = made.order.index(session.active_index)
        with session.batch:
            is_done = bool(session.change(text, lambda _: made.document, active=active))
            if is_done:
                self._choose(made.places)
        return is_done

    def _choose(self, curves: Collection[int]) -> None:
        self._session.selected.choose(curves)


COMMAND_SETS = (ShapeCommands,)
