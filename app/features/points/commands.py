"""The points of a curve: all of them, none, and with estimated derivatives."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import (
    CURVE_VELOCITIES,
    EDIT_SELECT,
)
from ...actions.situation import Situation
from ...actions.strips import CANVAS_MENU
from ...document import edits
from ...view_model.jets import is_explicit
from ...workbench.context import WindowContext


def _has_explicit(now: Situation) -> bool:
    """Whether a selected point has a derivative that was set by hand."""
    return any(
        is_explicit(now.view.source.points[index], order, ahead=ahead)
        for index in now.selection
        for order in (1, 2)
        for ahead in (False, True)
    )


class PointCommands:
    """Selection of all points, and a return to estimated derivatives."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session

    @action("selectAll", "Select All", EDIT_SELECT, "Ctrl+A", "select-all", full_name="Select All Points")
    @also(CANVAS_MENU(11))
    def _select_all(self) -> None:
        """Select all points."""
        self._session.selected.set_points(range(len(self._session.active_curve.points)))

    @action(
        "resetVelocities",
        "Reset Derivatives to Estimated",
        CURVE_VELOCITIES,
        icon="reset",
        needs=Need("selected points with a derivative that was set", _has_explicit),
    )
    def _reset_derivatives(self) -> None:
        """Let the rules estimate the derivatives of the selected points again."""
        session, selected = self._session, self._session.selection
        session.change(
            "Reset derivatives",
            lambda document: edits.estimate_derivatives(document, session.active_index, selected),
        )


COMMAND_SETS = (PointCommands,)
