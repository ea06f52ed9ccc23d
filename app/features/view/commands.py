"""Tools, panels, presentation and theme: nothing here changes the document."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QSizePolicy, QToolButton

from ...actions.declaration import Action, action, action_for_each, also, also_for_each, switch, widget_at
from ...actions.keymap import action_name
from ...actions.menus import (
    CANVAS_MENU,
    EDIT_TOOL_SETTINGS,
    EDIT_TOOLS,
    MORE_TOOLS_MENU,
    TOOLBAR,
    VIEW_DRAWING,
    VIEW_ELEMENTS,
    VIEW_PRESENTATION,
    VIEW_SIZE,
    VIEW_THEME,
)
from ...actions.needs import CURVE_DRAWN, HERMITE_CURVE
from ...appearance.theme import ThemeMode
from ...canvas.fitting import FramedView
from ...document.several_curves import common_name, name_or_count
from ...document.words import NamedEnum
from ...state.window_state import WindowState
from ...tasks.task import DelayedCall
from ...tools.canvas.select import SELECT
from ...tools.tool import TOOLS, ToolRecord
from ...view_model.settings import ChoiceSetting
from ...widgets.boxes import row_of
from ...widgets.controls import ToolbarWidget, menu_with_tips, named
from ...workbench.context import WindowContext
from ...workbench.docks import hide_idle_docks
from .zoom import ZoomCommands

_SCALES = (0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0)

_THEMES = (
    (ThemeMode.SYSTEM, "Theme: System", "Use the light or dark theme of the system"),
    (ThemeMode.LIGHT, "Theme: Light", "Use the light theme"),
    (ThemeMode.DARK, "Theme: Dark", "Use the dark theme"),
)


_MOST_ENTRIES = 8
"""Members of a choice up to which each is an entry of the menu; the preferences have all."""


class _ToolChoice(NamedTuple):
    """A member of a choice among the settings of a tool."""

    tool: ToolRecord
    setting: ChoiceSetting[Any]
    member: NamedEnum


def _tool_choices() -> list[_ToolChoice]:
    return [
        _ToolChoice(tool, setting, member)
        for tool in TOOLS
        for setting in tool.settings
        if isinstance(setting, ChoiceSetting) and len(setting.members) <= _MOST_ENTRIES
        for member in setting.members
    ]


_ICON, _ARROW = 20, 20
"""Pixels along the sides of the icon, and of what stands beside it."""


_SETTLED_MS = 1000
"""Milliseconds after a presentation within which the window has its size again."""


class _Layout(NamedTuple):
    """Look of a window: state of docks and splitter, size, view of the canvas, drawing size."""

    window: bytes
    splitter: bytes
    size: QSize
    view: FramedView
    scale: float


class MoreToolsButton(ToolbarWidget):
    """Toolbar button for the last used tool of its menu.

    Parameters
    ----------
    is_on
        Function that tells by name whether a switch is on.
    """

    def __init__(self, is_on: Callable[[str], bool]) -> None:
        super().__init__()
        self._is_on = is_on
        self.button = named(QToolButton(), "moreToolsButton", "More Tools")
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.MenuButtonPopup)
        self.button.setIconSize(QSize(_ICON, _ICON))
        self.button.setFixedWidth(_ICON + _ARROW)
        self._menu = menu_with_tips("moreToolsMenu", self.button)
        row_of(self.button, margins=(0, 0, 0, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)

    def offer(self, tools: Sequence[QAction]) -> None:
        """Set the tools of the menu; the first one is on the button."""
        self._menu.addActions(list(tools))
        self.button.setDefaultAction(tools[0])
        # Set last: setDefaultAction replaces the menu by that of the action.
        self.button.setMenu(self._menu)

    def show_in_use(self) -> None:
        """Show the tool in use, if it is in the menu; otherwise the last one."""
        used = next((entry for entry in self._menu.actions() if self._is_on(entry.objectName())), None)
        if used is not None and used is not self.button.defaultAction():
            self.button.setDefaultAction(used)
            self.button.setMenu(self._menu)


class ViewCommands:
    """Actions that change the view, not the document."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session, self._store = context.session, context.store
        self._more_tools = MoreToolsButton(context.actions.is_on)
        context.actions.switched.connect(self._more_tools.show_in_use)
        self._before_presentation: _Layout | None = None
        self._restored_at = QSize()
        # The window gets its size some events after it was asked for.
        self._soon = DelayedCall(context.window, 0, self._follow_presentation)
        self._settled = DelayedCall(context.window, _SETTLED_MS, self._forget_layout)
        context.central.canvas.camera.changed.connect(self._follow_size)
        context.central.canvas.camera.steered.connect(self._forget_layout)
        self._before_folding = b""
        self._store.changed.connect(self._show_state)
        self._show_numbers(self._store.state)
        context.central.canvas.tools.settings = self._store.state.tool_settings

    def _show_numbers(self, state: WindowState) -> None:
        self._context.central.canvas.drawing.set_plain(not state.numbered)

    def _show_state(self, before: WindowState, after: WindowState) -> None:
        self._context.central.canvas.tools.settings = after.tool_settings
        if after.grid != before.grid:
            self._context.central.canvas.drawing.grid.set_visible(after.grid)
        if after.numbered != before.numbered:
            self._show_numbers(after)
        if after.side_panel != before.side_panel:
            self._show_side_panel(after)
        if after.presentation != before.presentation:
            self._present() if after.presentation else self._end_presentation()
        if after.scale != before.scale:
            self._show_scale(after.scale)

    def escape(self) -> None:
        """Step back from the gesture, tool, motion, presentation, scrub line, selected points or curves."""
        session, state = self._session, self._store.state
        if self._context.cancel_gesture() or self._context.central.canvas.dismiss():
            return
        if state.moves_image:
            self._context.actions["moveImage"].trigger()
        elif state.tool is not SELECT:
            self._context.actions[SELECT.action].trigger()
        elif state.motion_visible:
            self._context.actions["stopMotion"].trigger()
        elif state.presentation:
            self._store.change(presentation=False)
        elif session.scrub.t is not None:
            session.scrub.set(None)
        elif session.selection:
            session.selected.set_points([])
            name = common_name(session.document, session.selected.curves)
            what = "the curves" if name is None else f"“{name}”"
            session.say(f"No point is selected. Press Escape again to select {what} as a whole.")
        else:
            self._step_out()

    def _step_out(self) -> None:
        """Stop editing and select the edited curves as wholes, then select none."""
        session, selected = self._session, self._session.selected
        if not selected.is_editing:
            if selected.whole_curves:
                selected.select_whole(())
                session.say("No curve is selected.")
            return
        selected.select_whole(selected.curves)
        session.say(self._whole_hint(selected.whole_curves))

    def _whole_hint(self, curves: Collection[int]) -> str:
        """Return the hint that curves are selected as wholes, and how to edit their points."""
        document = self._session.document
        name = common_name(document, curves)
        if name is None:
            return f"{name_or_count(document, curves)} are selected as wholes; Enter edits their points."
        return f"“{name}” is selected as a whole; Enter edits its points."

    @widget_at(TOOLBAR(35))
    def build_more_tools(self) -> ToolbarWidget:
        """Return the button of the toolbar for the tools without one of their own."""
        tools = self._context.actions.in_bar(MORE_TOOLS_MENU).values()
        self._more_tools.offer([entry for ten in tools for entry in ten])
        return self._more_tools

    @action_for_each(
        TOOLS,
        lambda tool: Action(
            tool.action,
            tool.title,
            EDIT_TOOLS,
            tool.key,
            tool.icon,
            tool.tip,
            tool.full_name,
            checked=lambda state: state.window.uses(tool),
            group="tool",
            during_gesture=True,
            keywords=tool.keywords,
        ),
    )
    @also_for_each(
        lambda tool: (
            (TOOLBAR if tool.in_toolbar else MORE_TOOLS_MENU)(30),
            *(CANVAS_MENU(10),) * tool.in_menu,
        )
    )
    def _use_tool(self, tool: ToolRecord) -> None:
        self._context.status_line.leave_tool()
        # Selecting a tool again resets it.
        self._context.central.canvas.choose_tool(tool)
        self._store.change(tool=tool, moves_image=False)
        curves = self._session.selected.whole_curves if tool is SELECT else frozenset()
        self._context.status_line.show_hint(self._whole_hint(curves) if curves else tool.hint)

    @action_for_each(
        _tool_choices,
        lambda choice: Action(
            action_name(choice.tool.name, choice.member),
            choice.member.label,
            EDIT_TOOL_SETTINGS,
            tip=f"{choice.setting.tip}: {choice.member.label}",
            full_name=f"{choice.tool.title}: {choice.member.label}",
            checked=lambda state: state.window.tool_settings.value(choice.setting) is choice.member,
            group=choice.setting.name,
        ),
    )
    def _choose_tool_setting(self, choice: _ToolChoice) -> None:
        tool, setting, member = choice
        self._store.change(tool_settings=self._store.state.tool_settings.with_value(setting, member))
        self._session.say(f"{tool.title}: {member.label}.")

    # What is shown

    @switch(
        "grid",
        "toggleGrid",
        "Grid",
        VIEW_DRAWING,
        "Ctrl+', #",
        "grid",
        full_name="Show Grid",
    )
    @also(TOOLBAR(61), CANVAS_MENU(31))
    def _toggle_grid(self) -> None:
        """Show or hide the grid."""

    @action(
        "toggleScrub",
        "Scrub Line",
        VIEW_ELEMENTS,
        "T",
        "spline",
        needs=CURVE_DRAWN,
        checked=lambda state: state.has_scrub_line,
    )
    @also(TOOLBAR(63), CANVAS_MENU(33))
    def _toggle_scrub(self) -> None:
        """Show a point that moves along the curve, and the weight of every point there."""
        session = self._session
        if session.scrub.t is not None or session.active_view.curve is None:
            session.scrub.set(None)
            return
        start, end = session.active_view.curve.domain
        session.scrub.set(start + 0.4 * (end - start))
        if self._store.state.basis:
            session.say("Drag the scrub line in the basis panel. Every point shows its weight.")
        else:
            session.offer("Every point shows its weight. Drag the line in the basis panel.", "toggleBasis")

    @switch(
        "basis",
        "toggleBasis",
        "Basis Functions",
        VIEW_ELEMENTS,
        "F8",
        "panel-bottom",
    )
    def _toggle_basis(self) -> None:
        """Show or hide the basis functions."""

    @switch(
        "with_estimates",
        "toggleEstimates",
        "Basis Functions with Estimates",
        VIEW_ELEMENTS,
        "Shift+F8",
        "cardinal",
        needs=HERMITE_CURVE,
    )
    def _toggle_estimates(self) -> None:
        """Include the velocities estimated from each point in its basis function."""

    @switch(
        "numbered",
        "numberPoints",
        "Point Numbers",
        VIEW_ELEMENTS,
        icon="number-points",
        keywords="labels indices colours plain nodes index",
    )
    def _toggle_numbers(self) -> None:
        """Show points with numbers and colours, or without."""

    @switch(
        "side_panel",
        "toggleSidePanel",
        "Side Panel",
        VIEW_ELEMENTS,
        "F9",
        "panel-right",
    )
    def _toggle_side_panel(self) -> None:
        """Show or hide the side panels."""

    def _show_side_panel(self, state: WindowState) -> None:
        window, visible = self._context.window, state.side_panel
        # The layout of a presentation is not restored later.
        keeps_layout = not state.presentation
        if not visible and keeps_layout:
            self._before_folding = bytes(window.saveState().data())
        for dock in self._context.docks.side:
            # A dock without content is disabled and stays hidden.
            dock.setVisible(visible and dock.isEnabled())
        if visible and keeps_layout and self._before_folding:
            # Showing docks one by one changes their heights and the front tabs.
            window.restoreState(self._before_folding)
            hide_idle_docks(window)

    # Drawing size

    @action("enlarge", "Larger Drawing", VIEW_SIZE, "Ctrl+Alt+=, Ctrl+Alt++", "plus")
    def _enlarge(self) -> None:
        """Enlarge points, lines and type, for a projector."""
        self._change_scale(1)

    @action("shrink", "Smaller Drawing", VIEW_SIZE, "Ctrl+Alt+-")
    def _shrink(self) -> None:
        """Make points, lines and type smaller."""
        self._change_scale(-1)

    @action("usualSize", "Default Drawing Size", VIEW_SIZE, "Ctrl+Alt+0")
    def _use_usual_scale(self) -> None:
        """Restore the default size of points, lines and type."""
        self._set_scale(1.0)

    def _change_scale(self, step: int) -> None:
        index = _SCALES.index(self._store.state.scale) + step
        self._set_scale(_SCALES[max(0, min(index, len(_SCALES) - 1))])

    def _set_scale(self, scale: float) -> None:
        self._store.change(scale=scale)
        self._session.say(f"Drawing size: {scale:.0%}.")

    def _show_scale(self, scale: float) -> None:
        central = self._context.central
        was_fitted = central.canvas.framing.is_as_fitted
        central.set_scale(scale)
        self._context.docks.set_scale(scale)
        if self._store.state.presentation and was_fitted:
            self._soon.start()

    # Presentation

    @switch(
        "presentation",
        "presentation",
        "Presentation",
        VIEW_PRESENTATION,
        "F11",
        "presentation",
    )
    def _toggle_presentation(self) -> None:
        """Hide everything except the canvas and the basis functions."""

    def _present(self) -> None:
        context, window, central = self._context, self._context.window, self._context.central
        if self._before_presentation is None:
            self._before_presentation = _Layout(
                bytes(window.saveState().data()),
                bytes(central.splitter.saveState().data()),
                window.size(),
                central.canvas.framing.present,
                self._store.state.scale,
            )
        docks = [dock for dock in context.docks.side if dock not in self._docks_for_lesson()]
        for part in (context.toolbar, window.menuBar(), context.status_line, *docks):
            part.hide()
        # Not showFullScreen, which forgets that the window was maximised.
        window.setWindowState(window.windowState() | Qt.WindowState.WindowFullScreen)
        self._settled.stop()
        self._soon.start()

    def _end_presentation(self) -> None:
        window, before = self._context.window, self._before_presentation
        assert before is not None
        self._store.change(scale=before.scale)
        window.setWindowState(window.windowState() & ~Qt.WindowState.WindowFullScreen)
        if not window.isMaximized():
            window.resize(before.size)
        window.menuBar().show()
        self._context.status_line.show()
        self._settled.start()
        self._restore(before)
        self._soon.start()

    def _follow_presentation(self) -> None:
        """Fit the drawing to the presentation, or have everything again as it was before."""
        context, before = self._context, self._before_presentation
        if self._store.state.presentation:
            context.docks.set_scale(self._store.state.scale)
            context.central.canvas.framing.fit()
        elif before is not None:
            self._restore(before)
            if context.window.size() == before.size:
                self._forget_layout()

    def _restore(self, before: _Layout) -> None:
        window, central = self._context.window, self._context.central
        window.restoreState(before.window)
        hide_idle_docks(window)
        central.splitter.restoreState(before.splitter)
        central.canvas.framing.restore(before.view)
        self._restored_at = window.size()

    def _follow_size(self) -> None:
        is_over = self._before_presentation is not None and not self._store.state.presentation
        if is_over and self._context.window.size() != self._restored_at:
            self._soon.start()

    def _forget_layout(self) -> None:
        if not self._store.state.presentation:
            self._before_presentation = None

    def _docks_for_lesson(self) -> list[QDockWidget]:
        """Return the docks that stay in the presentation of a lesson: the laboratory, if it is in front."""
        docks = self._context.docks
        is_wanted = docks["lessonsDock"].isVisible() and self._store.state.analysis.laboratory.on
        return [docks["laboratoryDock"]] if is_wanted else []

    # Theme

    @action_for_each(
        _THEMES,
        lambda theme: Action(
            f"theme{theme[0].name.capitalize()}",
            theme[1],
            VIEW_THEME,
            tip=theme[2],
            checked=lambda state: state.window.theme_mode is theme[0],
            group="theme",
        ),
    )
    def _use_theme(self, theme: tuple[ThemeMode, str, str]) -> None:
        self._store.change(theme_mode=theme[0])


COMMAND_SETS = (ViewCommands, ZoomCommands)
