"""Tools, zoom, panels, presentation and theme: nothing here changes the document."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDockWidget

from app.commands.dock_room import put_idle_docks_away
from app.commands.parts import Handlers, Parts
from app.panels.late_dock import LateDock
from app.plotting.scrolling import ZOOM_STEP
from app.theme import ThemeMode
from app.tools.tools import ToolKind
from app.view_model.curve_view import CurveView

_TOOL_HINTS = {
    ToolKind.SELECT: "Drag points and handles; P adds points.",
    ToolKind.ADD: "Click to add points; Enter finishes the curve; V or Escape goes back to selecting.",
    ToolKind.MEASURE: "Drag to measure; V or Escape goes back to selecting.",
}
_SCALES = (0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0)


class ViewCommands:
    """What changes how things are shown."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        self._scale = 1.0
        self._before_presentation = b""
        self._before_folding = b""
        for name in ("selectTool", "toggleGrid", "toggleBasis", "toggleSidePanel"):
            self._actions[name].setChecked(True)
        self._actions["toggleEstimates"].setChecked(parts.preferences.with_estimates)
        parts.basis_pane.offer_estimates(self._actions["toggleEstimates"])
        parts.basis_pane.set_with_estimates(parts.preferences.with_estimates)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        set_mode = self._parts.set_theme_mode
        return {
            "selectTool": lambda: self._use_tool(ToolKind.SELECT),
            "addTool": lambda: self._use_tool(ToolKind.ADD),
            "measureTool": lambda: self._use_tool(ToolKind.MEASURE),
            "fitView": self._fit,
            "zoomIn": lambda: self._zoom(ZOOM_STEP),
            "zoomOut": lambda: self._zoom(1 / ZOOM_STEP),
            "toggleGrid": self._toggle_grid,
            "toggleScrub": self._toggle_scrub,
            "toggleBasis": self._toggle_basis,
            "toggleEstimates": self._toggle_estimates,
            "toggleSidePanel": self._toggle_side_panel,
            "enlarge": lambda: self._change_scale(1),
            "shrink": lambda: self._change_scale(-1),
            "usualSize": lambda: self._set_scale(1.0),
            "presentation": self._toggle_presentation,
            "themeSystem": lambda: set_mode(ThemeMode.SYSTEM),
            "themeLight": lambda: set_mode(ThemeMode.LIGHT),
            "themeDark": lambda: set_mode(ThemeMode.DARK),
        }

    def render(self, view: CurveView) -> None:
        """Enable what needs a curve."""
        self._actions["toggleScrub"].setEnabled(view.curve is not None)
        self._actions["toggleEstimates"].setEnabled(view.source.family.derivatives > 0)

    def escape(self) -> None:
        """Step back: gesture in flight, tool, motion, presentation, scrub line, selection, chosen curves."""
        session = self._session
        if self._parts.cancel_gesture() or self._parts.canvas.put_away():
            return
        if any(self._actions[name].isChecked() for name in ("addTool", "measureTool", "explainWiggle")):
            self._actions["selectTool"].trigger()
        elif self._actions["moveImage"].isChecked():
            self._actions["moveImage"].trigger()
        elif self._actions["stopMotion"].isEnabled():
            self._actions["stopMotion"].trigger()
        elif self._actions["presentation"].isChecked():
            self._actions["presentation"].trigger()
        elif session.scrub is not None:
            session.set_scrub(None)
        elif session.selection:
            session.select([])
        else:
            session.choose_curves((session.active_index,))

    def _use_tool(self, kind: ToolKind) -> None:
        self._parts.canvas.set_tool(kind)
        self._parts.status_line.show_hint(_TOOL_HINTS[kind])

    def _fit(self) -> None:
        self._parts.canvas.fit()
        self._parts.basis_pane.fit()

    def _zoom(self, factor: float) -> None:
        canvas = self._parts.canvas
        canvas.zoom(factor, canvas.centre())

    def _toggle_grid(self) -> None:
        self._parts.canvas.grid.set_visible(self._actions["toggleGrid"].isChecked())

    def _toggle_scrub(self) -> None:
        session = self._session
        if session.scrub is not None or session.active_view.curve is None:
            session.set_scrub(None)
            self._actions["toggleScrub"].setChecked(False)
            return
        start, end = session.active_view.curve.domain
        session.set_scrub(start + 0.4 * (end - start))
        session.say("Drag the scrub line in the basis panel; every point shows its weight there.")

    def _toggle_basis(self) -> None:
        self._parts.basis_pane.setVisible(self._actions["toggleBasis"].isChecked())

    def _toggle_estimates(self) -> None:
        shown = self._actions["toggleEstimates"].isChecked()
        self._parts.preferences.with_estimates = shown
        self._parts.basis_pane.set_with_estimates(shown)
        self._parts.basis_pane.render_view(self._session.active_view)

    def _toggle_side_panel(self) -> None:
        window, shown = self._parts.window, self._actions["toggleSidePanel"].isChecked()
        # The layout of a presentation is none to come back to.
        keeps_layout = not self._actions["presentation"].isChecked()
        if not shown and keeps_layout:
            self._before_folding = bytes(window.saveState().data())
        for dock in self._parts.docks:
            # A dock that has nothing to show is disabled, and stays away.
            dock.setVisible(shown and dock.isEnabled())
        if shown and keeps_layout and self._before_folding:
            # Shown one by one, docks share the height anew and change which tab is in front.
            window.restoreState(self._before_folding)
            put_idle_docks_away(window)

    def _change_scale(self, step: int) -> None:
        self._set_scale(_SCALES[max(0, min(_SCALES.index(self._scale) + step, len(_SCALES) - 1))])

    def _set_scale(self, scale: float) -> None:
        factor, self._scale = scale / self._scale, scale
        self._parts.canvas.set_scale(self._scale)
        self._parts.basis_panel.set_scale(self._scale)
        self._parts.plot_panel.set_scale(self._scale)
        docks = (*self._parts.docks, self._parts.lessons_dock)
        late = [dock for dock in docks if isinstance(dock, LateDock)]
        for dock in late:
            dock.set_scale(scale)
        seen = [dock for dock in late if dock.isVisible() and not dock.visibleRegion().isEmpty()]
        widths = [round(dock.width() * factor) for dock in seen]
        self._parts.window.resizeDocks(seen, widths, Qt.Orientation.Horizontal)
        self._session.say(f"Drawing at {self._scale:.0%}.")

    def _toggle_presentation(self) -> None:
        parts, window = self._parts, self._parts.window
        if self._actions["presentation"].isChecked():
            self._before_presentation = bytes(window.saveState().data())
            docks = [dock for dock in parts.docks if dock not in self._kept_for_a_lesson()]
            for part in (parts.toolbar, window.menuBar(), parts.status_line, *docks):
                part.hide()
            # Not showFullScreen, which forgets that a window was maximised.
            window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
            return
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        window.menuBar().show()
        parts.status_line.show()
        window.restoreState(self._before_presentation)
        put_idle_docks_away(window)

    def _kept_for_a_lesson(self) -> list[QDockWidget]:
        """Return what a lesson needs at hand while it is presented: the laboratory, if it is in front."""
        if not self._parts.lessons_dock.isVisible():
            return []
        is_wanted = self._actions["toggleLaboratory"].isChecked()
        return [dock for dock in self._parts.docks if is_wanted and dock.objectName() == "laboratoryDock"]

    def leave_presentation(self) -> None:
        """Bring the panels back before the layout is remembered."""
        if self._actions["presentation"].isChecked():
            self._actions["presentation"].trigger()
