"""The points of a curve: all of them, none, and with estimated derivatives."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.menus import (
    CANVAS_MENU,
    CHOSEN_MENU,
    CURVE_LIST_MENU,
    EDIT_SELECT,
    POINTS_EDITING,
    POINTS_VELOCITIES,
)
from ...actions.needs import SOME_CURVE, Need
from ...document import edits
from ...document.point_group import some_points
from ...document.selection import NONE_FREE, all_points, free_curves
from ...workbench.context import WindowContext


class PointCommands:
    """Selection of all points or of the others, and a return to estimated derivatives."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

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
        """Select all points of the curves that are edited; with none, choose all that is seen and free."""
        session, selected = self._session, self._session.selected
        if selected.is_editing:
            selected.set_group(all_points(session.document, selected.edited))
            if len(selected.group.parts) > 1:
                session.say(f"{selected.group.counted} selected.")
        else:
            selected.choose(free := free_curves(session.document))
            if not free:
                session.refuse(NONE_FREE)

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
        """Choose what is seen and free and not chosen now; of curves that are edited, the other points."""
        session, selected = self._session, self._session.selected
        curves = session.document.curves
        if selected.is_editing:
            selected.set_group(
                some_points(
                    (at, frozenset(range(len(curves[at].points))) - selected.group.of(at))
                    for at in selected.edited
                )
            )
        elif free := free_curves(session.document):
            selected.choose(free - selected.chosen)
        else:
            session.refuse(NONE_FREE)

    @action(
        "editCurve",
        "Edit Curve",
        POINTS_EDITING,
        icon="spline-pointer",
        checked=lambda state: state.is_editing,
        keywords="points nodes whole curves leave",
    )
    @also(CANVAS_MENU(13), CHOSEN_MENU(1), CURVE_LIST_MENU(1))
    def _edit_or_leave(self) -> None:
        """Show the points of the chosen curves and change them (Enter), or choose whole curves (Escape)."""
        selected = self._session.selected
        if selected.is_editing:
            selected.choose(selected.curves)
        else:
            selected.edit_chosen()

    @action(
        "resetVelocities",
        "Reset Derivatives to Estimated",
        POINTS_VELOCITIES,
        icon="reset",
        needs=Need("selected points with a derivative that was set", lambda state: state.has_explicit),
    )
    def _reset_derivatives(self) -> None:
        """Let the rules estimate the derivatives of the selected points again."""
        group = self._session.selected.group
        self._session.change(
            "Reset derivatives", lambda document: group.changed(document, edits.estimate_derivatives)
        )


COMMAND_SETS = (PointCommands,)
