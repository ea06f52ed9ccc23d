"""The pane of the basis functions in a window, and the actions of the t-rail."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtWidgets import QWidget

from ...actions.declaration import Action, action, action_for_each, also
from ...actions.keymap import action_name
from ...actions.menus import CURVE_STARTS, POINTS_TYPED, RAIL_MENU
from ...actions.needs import TWO_POINTS, Need
from ...document import rule_edits
from ...document.model import ParametrizationKind
from ...state.window_state import WindowState
from ...tools.parameters import RAIL
from ...tools.toolbox import Toolbox
from ...view_model.basis import growth_of_points
from ...view_model.basis_findings import findings_of, remark_on
from ...view_model.curve.curve_view import CurveView, view_of
from ...workbench.central_area import Pane
from ...workbench.context import CommandSet, bar_menu
from .pane import BasisPane
from .panel import BasisPanel

_STARTS = tuple(kind for kind in ParametrizationKind if kind.takes and "alpha" not in kind.takes)
"""Rules that need no settings."""


def _from(kind: ParametrizationKind) -> str:
    return "from " + " ".join(word[:1].upper() + word[1:] for word in kind.label.split())


_MOST_LIVE = 200
"""Points up to which the Lebesgue constant follows a drag."""

_MOST_MEASURED_LIVE = 40
"""Points up to which the functions are measured during a drag."""


class BasisCommands(CommandSet):
    """The basis functions of the active curve, and its parameters at the t-rail."""

    @Pane("basisPane", stretch=4, height=267)
    def build_pane(self, parent: QWidget) -> BasisPane:
        """Return the functions with their header."""
        context, session = self._context, self._session
        panel = self._panel = BasisPanel(Toolbox(session, RAIL))
        pane = self._pane = BasisPane(panel, context.actions["toggleEstimates"], parent)
        panel.drawing.set_with_estimates(context.store.state.with_estimates)
        if not context.store.state.basis:
            pane.hide()
        context.store.changed.connect(self._show_state)
        context.connect_plot(panel)
        context.central.t_camera = panel.camera
        session.hovered_changed.connect(panel.drawing.set_hovered)
        session.selection_changed.connect(panel.drawing.set_selection)
        session.scrub_changed.connect(panel.drawing.set_scrub)
        panel.pointed_at.connect(context.status_line.readouts.show_t)
        panel.drag_changed.connect(context.central.canvas.drawing.hold_ghost)
        panel.tick_edit.typed.connect(self._set_parameter)
        panel.tick_pointed.connect(self._select)
        panel.menu_requested.connect(lambda at: bar_menu(context, RAIL_MENU, "railMenu").popup(at))
        return pane

    # Display

    def follow_drag(self, view: CurveView) -> bool:
        """Show the functions of `view`."""
        self._pane.render_view(view)
        self._context.central.basis = self._panel.drawing.basis
        return True

    def render_panel(self, view: CurveView) -> None:
        """Show Λ and the findings about the functions; for many points after a drag."""
        is_slow = view.source.family.derivatives and len(view.points) > _MOST_LIVE
        waits = self._session.is_previewing and is_slow
        growth = None if waits else growth_of_points(view, self._panel.drawing.basis)
        self._context.status_line.readouts.show_lebesgue(growth, view.growth_holds)
        self._pane.show_unselected("" if self._session.target_view else view.source.name)
        if not self._session.is_previewing or len(view.points) <= _MOST_MEASURED_LIVE:
            self._pane.show_findings(findings_of(view), remark_on(view))

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        if after.basis != before.basis:
            self._pane.setVisible(after.basis)
        if after.with_estimates != before.with_estimates:
            self._panel.drawing.set_with_estimates(after.with_estimates)
            self.follow_drag(self._session.active_view)

    # At the t-rail

    def _set_parameter(self, knot: int, t: float) -> None:
        """Set the t that was typed at a tick, or show the refusal there."""
        session, view = self._session, self._session.active_view
        if knot < len(view.ticks):
            change = session.change(
                f"Change t of point {view.owner(knot)}",
                lambda document: rule_edits.set_parameter(
                    document, session.active_index, knot, t, view.ticks.tolist()
                ),
            )
            if change.refusal:
                self._panel.tick_edit.refuse(change.refusal)
                return
        self._panel.tick_edit.close_and_return()

    def _select(self, point: int) -> None:
        """Select the point whose tick the menu is about, unless it is selected already."""
        if point not in self._session.selection:
            self._session.selected.set_points([point])

    @action_for_each(
        _STARTS,
        lambda kind: Action(
            action_name("start", kind),
            f"Manual, {_from(kind)}",
            CURVE_STARTS,
            tip=f"Make the parameters manual, {kind.spaced}",
            full_name=f"Manual Parameters, {_from(kind)}",
            needs=TWO_POINTS,
        ),
    )
    @also(RAIL_MENU(20))
    def _start_from(self, kind: ParametrizationKind) -> None:
        """Make the parameters manual, starting from those of a rule on the present interval."""
        session = self._session
        curve = session.active_curve
        start, end = curve.interval
        rule = replace(curve.parametrization, kind=kind, start=start, end=end)
        ruled = session.document.with_curve(session.active_index, replace(curve, parametrization=rule))
        view = view_of(ruled.curves[session.active_index])
        if not view.is_current:
            session.refuse(view.problem)
            return
        session.change(
            f"Start from {kind.phrase} parameters",
            lambda _: rule_edits.freeze_parameters(ruled, session.active_index, view.parameters.tolist()),
        )

    @action(
        "typeParameter",
        "Type t…",
        POINTS_TYPED,
        full_name="Type a Parameter t…",
        needs=Need("one selected point", lambda state: state.is_current and state.selected_count == 1),
    )
    @also(RAIL_MENU(10))
    def _type_parameter(self) -> None:
        """Enter the parameter of the selected point at its tick."""
        selected = self._session.selected.group.only_point
        if selected is not None:
            self._panel.edit_tick(selected[1])


COMMAND_SETS = (BasisCommands,)
