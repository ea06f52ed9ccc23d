"""The point table in the window: its dock, and what it shows."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from ...actions.declaration import action, also
from ...actions.menus import POINT_BUTTONS, POINT_MENU, POINTS_TYPED
from ...actions.needs import Need
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import UPPER, Panel
from .controller import PointTableController
from .panel import PointTable


class PointTableCommands:
    """Keeps the point table in step with the active curve and its selection.

    Attributes
    ----------
    panel
        The table with its footer, as soon as the docks are filled.
    """

    panel: PointTable

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @Panel("pointsDock", "Points", UPPER, built_at_start=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the table."""
        self.panel = PointTable(parent)
        self.panel.add_buttons(self._context.actions.in_bar(POINT_BUTTONS)[1])
        self._controller = PointTableController(self._session, self.panel, self._show_points)
        self._session.selection_changed.connect(self.panel.set_selection)
        return self.panel

    def follow(self, view: CurveView) -> bool:
        """Show the points of `view`, as soon as the table's pace allows."""
        self.panel.render_view(view, streaming=self._session.is_previewing)
        return True

    @action(
        "typePoint",
        "Type x and y…",
        POINTS_TYPED,
        full_name="Type x and y of the Point…",
        needs=Need("a selected point", lambda state: state.selected_count > 0),
        keywords="exact coordinates position place numbers node",
    )
    @also(POINT_MENU(18))
    def _type_place(self) -> None:
        """Type where the selected point lies, in the table of points; Tab goes from x to y."""
        self._context.docks["pointsDock"].bring_up()
        self.panel.type_place(min(self._session.selection))

    def _show_points(self) -> None:
        """Fit the view where points of the active curve lie outside it."""
        central = self._context.central
        if not central.canvas.framing.shows_all_points:
            central.fit()


COMMAND_SETS = (PointTableCommands,)
