"""Explain this wiggle: a click on the curve tells who pulls it there, and cures can be tried out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from ...actions.declaration import PositionAction, action
from ...actions.menus import ANALYSIS_EXPLAIN
from ...actions.needs import CURVE_THROUGH_TWO
from ...canvas.figure_layer import Trace
from ...document.model import Document
from ...tasks.task import DebouncedTask
from ...tools.canvas.select import SELECT
from ...view_model import analysis
from ...view_model.curve.curve_view import CurveView
from ...view_model.line_styles import CURE_STYLE
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from .. import wiggle

if TYPE_CHECKING:
    from ...view_model.analysis.wiggle import Cure, Cures
    from .panel import WigglePanel
from ...tools.pointer import Hint, Part
from ...tools.tool import GestureRow, Tool, ToolEvent, ToolRecord

_GROUP = "cure"


class ExplainTool(Tool):
    """Tool that moves the scrub line to the clicked point of the curve, which is explained there."""

    def press(self, event: ToolEvent) -> None:
        """Move the scrub line here."""
        hit = event.hit
        if hit is not None and hit.part is Part.CURVE:
            event.session.scrub.set(hit.t)
        else:
            event.session.refuse("Click the curve where it oscillates.")

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint for a click on the curve."""
        text = "Click the curve where it oscillates · V returns to Select"
        return Hint(text, grab=event.hit is not None)


EXPLAIN = ToolRecord(
    name="explain",
    make=ExplainTool,
    hint="Click the curve where it oscillates; V returns to Select.",
    doing="explaining",
    gestures=(GestureRow("Click the curve", "explain why it oscillates there"),),
)


class WiggleCommands(QObject):
    """Explains the curve at the scrub line while its dock is visible."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._panel: WigglePanel | None = None
        self._cures: Cures | None = None
        self._asked: tuple[Document, int, int] | None = None
        self._task = DebouncedTask(self)
        self._task.ready.connect(self._show_result)
        self._task.busy_changed.connect(lambda _busy: self._show_cures())
        self._dock = context.docks["wiggleDock"]
        # Behind another tab a dock is visible to Qt, but not by this signal.
        self._is_visible = False
        self._dock.visibilityChanged.connect(self._follow_visibility)
        # Whether an explanation has moved the scrub line, and its position before.
        self._has_scrub = False
        self._scrub_before: float | None = None
        self._dock.closed.connect(self._put_scrub_back)
        self._session.scrub_changed.connect(self._follow_scrub)

    def _follow_scrub(self) -> None:
        self.follow_drag(self._session.active_view)

    @Panel("wiggleDock", "Wiggle", on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel; called when its dock is first shown."""
        self._panel = wiggle.panel.WigglePanel(parent)
        self._panel.looked_at.connect(self._preview)
        self._panel.applied.connect(self._apply)
        return self._panel

    # The position

    @action(
        "explainWiggle",
        "Explain a Wiggle",
        ANALYSIS_EXPLAIN,
        "W",
        "explain",
        needs=CURVE_THROUGH_TWO,
        checked=lambda state: state.window.uses(EXPLAIN),
        group="tool",
    )
    def _use_tool(self) -> None:
        """Click the curve where it oscillates to see which points cause it, and possible cures."""
        self._context.central.canvas.choose_tool(EXPLAIN)
        self._context.store.change(tool=EXPLAIN, moves_image=False)
        self._context.status_line.show_hint(EXPLAIN.hint)
        self._keep_scrub()
        if self._session.scrub.t is None:
            self._explain_widest()
        self._open()

    @action(
        "explainWidest",
        "Explain the Widest Wiggle",
        ANALYSIS_EXPLAIN,
        icon="explain",
        needs=CURVE_THROUGH_TWO,
    )
    def _explain_widest_wiggle(self) -> None:
        """Explain the largest oscillation of the curve."""
        self._keep_scrub()
        self._explain_widest()
        self._open()

    def _explain_widest(self) -> None:
        view = self._session.active_view
        if view.is_current:
            self._session.scrub.set(analysis.wiggle.widest(view))

    @PositionAction("explainHere", "Explain This Wiggle", like="explainWiggle")
    def explain_at(self, t: float) -> None:
        """Explain the curve at `t`."""
        self._keep_scrub()
        self._session.scrub.set(t)
        self._open()

    def _open(self) -> None:
        self._dock.bring_up()
        self.follow_drag(self._session.active_view)

    def _keep_scrub(self) -> None:
        if not self._is_visible:
            self._has_scrub, self._scrub_before = True, self._session.scrub.t

    def _put_scrub_back(self) -> None:
        if self._has_scrub:
            self._has_scrub = False
            self._session.scrub.set(self._scrub_before)

    def escape(self) -> bool:
        """Close the explanation with its tool; return whether there was one."""
        if not self._is_visible:
            return False
        self._dock.close()
        if self._context.store.state.uses(EXPLAIN):
            self._context.actions[SELECT.action].trigger()
        return True

    def _follow_visibility(self, visible: bool) -> None:
        self._is_visible = visible
        if visible:
            self.follow_drag(self._session.active_view)
        else:
            self._preview("")

    # Content

    def follow_drag(self, view: CurveView) -> bool:
        """Explain the curve at the scrub line; cures are tried when nothing changes any more."""
        panel = self._panel
        if panel is None or not self._is_visible:
            return False
        self._explain(panel, view)
        return True

    def _explain(self, panel: WigglePanel, view: CurveView) -> None:
        t = self._session.scrub.t
        explanation = analysis.wiggle.explain(view, t) if t is not None else None
        panel.render_explanation(explanation, view)
        if explanation is None or explanation.is_calm:
            self._preview("")
            self._asked = self._cures = None
            self._task.give_up()
            self._show_cures()
            return
        document, curve, knot = self._session.document, self._session.active_index, explanation.segment[0]
        if self._asked != (document, curve, knot):
            self._asked = (document, curve, knot)
            self._preview("")
            self._task.ask(lambda report: analysis.wiggle.cures_of(document, curve, view, knot, report))
            self._show_cures()

    def _show_result(self, cures: Cures | None) -> None:
        self._cures = cures
        self._show_cures()

    def _show_cures(self) -> None:
        if self._panel is not None:
            self._panel.render_cures(self._cures, busy=self._task.is_busy)

    # Cures

    def _cure(self, key: str) -> Cure | None:
        """Return a cure that belongs to the present document."""
        if self._cures is None or self._task.is_busy:
            return None
        return next((cure for cure in self._cures.cures if cure.remedy.name == key and cure.document), None)

    def _preview(self, key: str) -> None:
        cure = self._cure(key)
        traces = (Trace((cure.points,), CURE_STYLE, cure.remedy.label),) if cure is not None else ()
        self._context.central.canvas.drawing.annotations.render_traces(_GROUP, traces, "Preview")

    def _apply(self, key: str) -> None:
        cure = self._cure(key)
        if cure is not None and cure.document is not None:
            document = cure.document
            knot = self._cures.knot if self._cures is not None else 0
            self._preview("")
            if self._session.change(cure.remedy.step, lambda _: document):
                self._explain_segment(knot)

    def _explain_segment(self, knot: int) -> None:
        """Explain the same segment again, whose parameters have changed."""
        view = self._session.active_view
        if view.is_current and knot < len(view.parameters) - 1:
            self._session.scrub.set(analysis.wiggle.overshoot(view, knot)[1])


COMMAND_SETS = (WiggleCommands,)
