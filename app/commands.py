"""What the actions do: each a few lines that turn a trigger into an edit or a change of view."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QObject, QPointF
from PySide6.QtWidgets import QDockWidget, QMainWindow, QMenu, QMessageBox, QToolBar

from app import __version__
from app.actions import Actions
from app.canvas.canvas import Canvas
from app.document import edits
from app.document.edits import EditError
from app.document.model import Document, Family, ParametrizationKind
from app.file_commands import FileCommands
from app.gestures.tools import ToolKind
from app.panels.basis_pane import BasisPane
from app.panels.basis_panel import BasisPanel
from app.panels.message_bar import MessageBar
from app.panels.parametrization_bar import KIND_NAMES
from app.panels.shortcut_sheet import ShortcutSheet
from app.panels.status_line import StatusLine
from app.plot.plot_widget import ZOOM_STEP
from app.session import Session
from app.theme import ThemeMode
from app.view_model.curve_view import CurveView

_FAMILY_ACTIONS = {
    Family.LAGRANGE: "familyLagrange",
    Family.HERMITE: "familyHermite",
    Family.QUINTIC_HERMITE: "familyQuinticHermite",
}
_GREETING = (
    "Drag a point and watch the basis functions below. "
    "P adds points, 1 2 3 switch the family, F1 shows all keys."
)
_EMPTY = "Click on the canvas to add points; two of them make a curve."
_SCALES = (0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0)


@dataclass(frozen=True)
class Parts:
    """The parts of a window that commands act on."""

    window: QMainWindow
    session: Session
    actions: Actions
    canvas: Canvas
    basis_panel: BasisPanel
    basis_pane: BasisPane
    message_bar: MessageBar
    status_line: StatusLine
    toolbar: QToolBar
    docks: Sequence[QDockWidget]
    parameters_menu: QMenu


class Commands(QObject):
    """Connects the actions of a window to what they do, and keeps their state in step."""

    def __init__(
        self, parts: Parts, files: FileCommands, set_theme_mode: Callable[[ThemeMode], None]
    ) -> None:
        super().__init__(parts.window)
        self._parts = parts
        self._session = parts.session
        self._files = files
        self._set_theme_mode = set_theme_mode
        self._actions = parts.actions
        self._scale = 1.0
        self._greeting = ""
        self._before_presentation = b""
        self._sheet: ShortcutSheet | None = None

    def connect_actions(self) -> None:
        """Connect every action."""
        for name, handler in self._handlers().items():
            self._actions[name].triggered.connect(lambda _checked=False, handler=handler: handler())
        self._session.history_changed.connect(self._render_history)
        for tool in ("selectTool", "addTool"):
            self._actions[tool].setChecked(tool == "selectTool")
        for name in ("toggleGrid", "toggleBasis", "toggleSidePanel"):
            self._actions[name].setChecked(True)
        self._fill_parameters_menu()
        self._render_history()

    def _handlers(self) -> dict[str, Callable[[], object]]:
        files = self._files
        return {
            "newDocument": self._new,
            "openDocument": files.ask_and_open,
            "saveDocument": files.save,
            "saveDocumentAs": files.ask_and_save,
            "exportPicture": files.ask_and_export,
            "quit": self._parts.window.close,
            "undo": self._undo,
            "redo": self._session.undo_stack.redo,
            "selectTool": lambda: self._use_tool(ToolKind.SELECT),
            "addTool": lambda: self._use_tool(ToolKind.ADD),
            "selectAll": self._select_all,
            "deleteSelection": self._delete_selection,
            "familyLagrange": lambda: self._use_family(Family.LAGRANGE),
            "familyHermite": lambda: self._use_family(Family.HERMITE),
            "familyQuinticHermite": lambda: self._use_family(Family.QUINTIC_HERMITE),
            "freezeParameters": lambda: self._use_parametrization(ParametrizationKind.MANUAL, fresh=True),
            "resetVelocities": self._reset_derivatives,
            "fitView": self._fit,
            "zoomIn": lambda: self._zoom(ZOOM_STEP),
            "zoomOut": lambda: self._zoom(1 / ZOOM_STEP),
            "toggleGrid": self._toggle_grid,
            "toggleScrub": self._toggle_scrub,
            "toggleBasis": self._toggle_basis,
            "toggleSidePanel": self._toggle_side_panel,
            "enlarge": lambda: self._change_scale(1),
            "shrink": lambda: self._change_scale(-1),
            "presentation": self._toggle_presentation,
            "themeSystem": lambda: self._set_theme_mode(ThemeMode.SYSTEM),
            "themeLight": lambda: self._set_theme_mode(ThemeMode.LIGHT),
            "themeDark": lambda: self._set_theme_mode(ThemeMode.DARK),
            "showShortcuts": self._show_shortcuts,
            "about": self._about,
        }

    def _fill_parameters_menu(self) -> None:
        for kind, name in KIND_NAMES.items():
            action = self._parts.parameters_menu.addAction(name)
            action.setObjectName(f"parameters_{kind}")
            action.triggered.connect(lambda _checked=False, kind=kind: self._use_parametrization(kind))

    # State of the actions

    def render(self, view: CurveView) -> None:
        """Check and enable actions, and show the line above the canvas, as `view` has it."""
        self._actions[_FAMILY_ACTIONS[view.source.family]].setChecked(True)
        selected = bool(self._session.selection)
        self._actions["deleteSelection"].setEnabled(selected)
        has_explicit = any(
            view.source.nodes[i].velocity or view.source.nodes[i].acceleration
            for i in self._session.selection
        )
        self._actions["resetVelocities"].setEnabled(has_explicit)
        self._actions["freezeParameters"].setEnabled(view.is_current and not view.source.is_manual)
        self._render_message(view)

    def _render_message(self, view: CurveView) -> None:
        bar = self._parts.message_bar
        if len(view.points) < 2:
            bar.tell(_EMPTY)
        elif view.problem:
            bar.warn(view.problem)
        elif self._greeting:
            bar.tell(self._greeting)
        else:
            bar.hide()

    def greet(self) -> None:
        """Show the hint of the first start, until it is put away or something has been done."""
        self._greeting = _GREETING
        self._parts.message_bar.closed.connect(self._forget_greeting)
        self._session.opened.connect(self._forget_greeting)
        self._render_message(self._session.active_view)

    def _forget_greeting(self) -> None:
        self._greeting = ""
        self._render_message(self._session.active_view)

    def _render_history(self) -> None:
        stack = self._session.undo_stack
        for name, can, text in (
            ("undo", stack.canUndo(), stack.undoText()),
            ("redo", stack.canRedo(), stack.redoText()),
        ):
            verb = name.capitalize()
            self._actions[name].setEnabled(can)
            self._actions[name].setText(f"{verb} {text}" if text else verb)
        if stack.canUndo():
            self._forget_greeting()

    # Edits

    def _change(self, text: str, edit: Callable[[], Document]) -> None:
        try:
            self._session.commit(edit(), text)
        except EditError as reason:
            self._session.say(str(reason))
            self.render(self._session.active_view)

    def _new(self) -> None:
        self._files.new()
        if not self._session.active_curve.nodes:
            self._actions["addTool"].trigger()

    def _undo(self) -> None:
        # Undo in the middle of a drag takes the drag back, not the step before it.
        if not (self._parts.canvas.cancel_gesture() or self._parts.basis_panel.cancel_gesture()):
            self._session.undo_stack.undo()

    def _use_family(self, family: Family) -> None:
        name = {
            Family.LAGRANGE: "Lagrange",
            Family.HERMITE: "Hermite",
            Family.QUINTIC_HERMITE: "quintic Hermite",
        }
        session = self._session
        self._change(
            f"Use {name[family]}", lambda: edits.set_family(session.document, session.active_index, family)
        )

    def _use_parametrization(self, kind: ParametrizationKind, *, fresh: bool = False) -> None:
        session, view = self._session, self._session.active_view
        if kind is ParametrizationKind.MANUAL and not view.is_current:
            session.say("There are no parameters to start from; mend the points first.")
            return
        parameters = view.parameters.tolist()
        if fresh:
            self._change(
                "Freeze parameters",
                lambda: edits.freeze_parameters(session.document, session.active_index, parameters),
            )
            return
        self._change(
            f"Use {KIND_NAMES[kind].lower()} parameters",
            lambda: edits.set_parametrization(session.document, session.active_index, kind, parameters),
        )

    def _select_all(self) -> None:
        self._session.select(range(len(self._session.active_curve.nodes)))

    def _delete_selection(self) -> None:
        session, chosen = self._session, self._session.selection
        if not chosen:
            return
        what = f"point {next(iter(chosen))}" if len(chosen) == 1 else f"{len(chosen)} points"
        document = edits.delete_nodes(session.document, session.active_index, chosen)
        session.select([])
        self._change(f"Delete {what}", lambda: document)

    def _reset_derivatives(self) -> None:
        session, chosen = self._session, self._session.selection
        self._change(
            "Reset derivatives",
            lambda: edits.reset_derivatives(session.document, session.active_index, chosen),
        )

    # View

    def _use_tool(self, kind: ToolKind) -> None:
        self._parts.canvas.set_tool(kind)
        if kind is ToolKind.ADD:
            self._session.say("Click to add points. V or Escape goes back to selecting.")

    def escape(self) -> None:
        """Step back: the gesture in flight, the adding, the scrub line, the presentation, the selection."""
        parts, session = self._parts, self._session
        if parts.canvas.cancel_gesture() or parts.basis_panel.cancel_gesture():
            return
        if self._actions["addTool"].isChecked():
            self._actions["selectTool"].trigger()
        elif self._actions["presentation"].isChecked():
            self._actions["presentation"].trigger()
        elif session.scrub is not None:
            session.set_scrub(None)
        else:
            session.select([])

    def _fit(self) -> None:
        self._parts.canvas.fit()
        self._parts.basis_pane.fit()

    def _zoom(self, factor: float) -> None:
        canvas = self._parts.canvas
        canvas.zoom(factor, QPointF(canvas.centre()))

    def _toggle_grid(self) -> None:
        self._parts.canvas.set_grid_visible(self._actions["toggleGrid"].isChecked())

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

    def _toggle_side_panel(self) -> None:
        for dock in self._parts.docks:
            dock.setVisible(self._actions["toggleSidePanel"].isChecked())

    def _change_scale(self, step: int) -> None:
        index = max(0, min(_SCALES.index(self._scale) + step, len(_SCALES) - 1))
        self._scale = _SCALES[index]
        self._parts.canvas.set_scale(self._scale)
        self._parts.basis_panel.set_scale(self._scale)
        self._session.say(f"Drawing at {self._scale:.0%}.")

    def _toggle_presentation(self) -> None:
        parts, window = self._parts, self._parts.window
        if self._actions["presentation"].isChecked():
            self._before_presentation = bytes(window.saveState().data())
            for part in (parts.toolbar, window.menuBar(), parts.status_line, *parts.docks):
                part.hide()
            window.showFullScreen()
            return
        window.showNormal()
        window.menuBar().show()
        parts.status_line.show()
        window.restoreState(self._before_presentation)

    def leave_presentation(self) -> None:
        """Bring the panels back before the layout is remembered."""
        if self._actions["presentation"].isChecked():
            self._actions["presentation"].trigger()

    # Help

    def _show_shortcuts(self) -> None:
        if self._sheet is None:
            self._sheet = ShortcutSheet(self._actions.shortcuts(), self._parts.window)
        self._sheet.setVisible(not self._sheet.isVisible())

    def _about(self) -> None:
        box = QMessageBox(self._parts.window)
        box.setObjectName("aboutBox")
        box.setWindowTitle("About Curvebench")
        box.setText(f"Curvebench {__version__}")
        box.setInformativeText(
            "Sketch parametric polynomial curves and see why they go where they go.\n"
            "MIT licence. Icons: Lucide, ISC licence."
        )
        box.open()
