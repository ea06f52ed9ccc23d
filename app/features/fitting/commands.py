"""Simplify, and fewer points for a curve."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget

from curvecore.arrays import FloatArray

from ...actions.declaration import action
from ...actions.menus import ARRANGE_SHAPES, CURVE_FEWER
from ...actions.needs import SOME_CURVE, UNLOCKED_CURVE
from ...canvas.figure_layer import Trace
from ...document.curve_edits import replace_curve
from ...document.groups import expand_to_shapes, tidy_shapes
from ...document.limits import EditError
from ...document.model import Document, Vector
from ...document.plain_numbers import with_plain_numbers
from ...document.several_curves import name_or_count, unlocked_curves
from ...document.words import count_of, number
from ...tasks.progress import Report, part
from ...tasks.task import DebouncedTask
from ...view_model.curve.curve_view import CurveView, view_of
from ...view_model.curve.transformed import views_ahead
from ...view_model.fit import Fitted, Simplified, fitted_to_curve, is_of_points_alone, simplified
from ...view_model.geometry import size_of
from ...view_model.line_styles import CURE_STYLE, LineStyle
from ...workbench.context import WindowContext
from ...workbench.docks import Panel, make_room
from .. import fitting

if TYPE_CHECKING:
    from .panel import FitOptions, FitPanel

_PATIENCE_S = 0.08
"""Seconds that the window may be blocked; longer work has a thread of its own."""

_COMPUTED = 0.8
"""Share of the work that goes before the views of the new curves."""


class _TakesTooLongError(Exception):
    """The computation is better done beside the window."""


class SimplifyCommands:
    """Simplify: at once, or beside the window where it takes longer than a moment."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work

    @action(
        "simplify",
        "Simplify",
        ARRANGE_SHAPES,
        "",
        "fewer-points",
        full_name="Simplify Paths",
        needs=SOME_CURVE,
        keywords="less nodes path clean",
    )
    def _simplify(self) -> None:
        """Remove points that do not affect the shape of the selected curves; corners and lines stay."""
        session, until = self._session, 0.0
        document = session.committed
        curves = unlocked_curves(document, expand_to_shapes(document, session.selected.marked))
        what = f"Simplify {name_or_count(document, curves)}"
        make = partial(simplified, document, session.views, curves)

        def stop_when_late(_share: float, _word: str) -> None:
            nonlocal until
            # Counted from the first report on, as modules may have to be imported before.
            until = until or time.monotonic() + _PATIENCE_S
            if time.monotonic() > until:
                raise _TakesTooLongError

        def done(result: tuple[Simplified, list[CurveView]]) -> None:
            if session.committed is not document:
                session.refuse(f"{what} was cancelled because the document changed in the meantime.")
                return
            session.expect(result[1])
            self._put(what, result[0])

        try:
            self._put(what, make(report=stop_when_late))
        except EditError as reason:
            session.refuse(str(reason))
        except _TakesTooLongError:
            self._work.compute(what, partial(_with_views, make, document), done)

    def _put(self, what: str, result: Simplified) -> None:
        if self._session.change(what, lambda _: result.document):
            points = f"{count_of(result.before, 'point')} became {result.after}"
            within = f"{number(result.deviation, 2)} {self._session.document.unit}".rstrip()
            self._session.say(f"{points}; nothing moved by more than about {within}.")


def _with_views(
    make: partial[Simplified], before: Document, report: Report
) -> tuple[Simplified, list[CurveView]]:
    """Return the simplified document, and the views of its new curves."""
    result = make(report=part(report, 0.0, _COMPUTED))
    known, rest = set(map(id, before.curves)), part(report, _COMPUTED, 1.0)
    # As the session will store it, so that the views are of the same curves.
    after = tidy_shapes(with_plain_numbers(result.document, before), before)
    new = [curve for curve in after.curves if id(curve) not in known]
    return replace(result, document=after), views_ahead(new, lambda share: rest(share, "Computing curves"))


_GROUP = "fewer_points"
_SHARE = 0.002
"""The tolerance that is offered first, as a share of the size of a curve."""

_HEIGHT = 300
_BUSY = "Fitting… Escape cancels."

FAR_STYLE = LineStyle("warning", width=2.0)


class FitCommands(QObject):
    """Fit of a curve of fewer points to the active one, shown until it is applied or cancelled."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._panel: FitPanel | None = None
        self._asked: tuple[CurveView, FitOptions] | None = None
        self._result: Fitted | None = None
        self._problem = ""
        self._task = DebouncedTask(self)
        self._task.ready.connect(self._receive)
        self._task.progressed.connect(self._show_share)
        self._dock = context.docks["fitDock"]
        self._is_visible = False
        self._dock.visibilityChanged.connect(self._follow_visibility)

    @Panel("fitDock", "Fewer Points", on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the content of the dock; called when it is first looked at."""
        self._panel = fitting.panel.FitPanel(parent)
        self._panel.options_changed.connect(self._ask)
        self._panel.applied.connect(self._apply)
        self._panel.cancelled.connect(self._cancel)
        return self._panel

    @action(
        "fitFewerPoints",
        "Fit to Fewer Points…",
        CURVE_FEWER,
        icon="fewer-points",
        needs=UNLOCKED_CURVE,
        keywords="simplify reduce thin decimate approximate least squares",
    )
    def _open(self) -> None:
        """Fit a curve of fewer points and any family to the active curve, with a preview."""
        view = self._session.active_view
        self._dock.bring_up()
        assert self._panel is not None
        tolerance = float(f"{_SHARE * size_of(view.points):.1g}")
        self._panel.begin(view.source.family, tolerance, len(view.points) // 2)
        self._is_visible = True
        self._ask()
        make_room(self._context.window, self._dock, _HEIGHT)

    def follow_drag(self, _view: CurveView) -> bool:
        """Fit again where the curve has changed."""
        is_visible = self._panel is not None and self._is_visible
        if is_visible:
            self._ask()
        return is_visible

    def escape(self) -> bool:
        """Discard the fit; return whether there was one."""
        was_visible = self._is_visible
        if was_visible:
            self._cancel()
        return was_visible

    def close(self) -> None:
        """End the computation."""
        self._task.close()

    def _follow_visibility(self, visible: bool) -> None:
        self._is_visible = visible
        if not visible:
            self._forget()
        elif self._panel is not None:
            self._ask()

    def _forget(self) -> None:
        self._task.give_up()
        self._asked = self._result = None
        self._show()

    def _ask(self) -> None:
        assert self._panel is not None
        view, options = self._session.active_view, self._panel.options
        if isinstance(options, str) or not view.is_current:
            self._forget()
            self._panel.render_result(
                options if isinstance(options, str) else view.problem, can_apply=False, busy=False
            )
            return
        if self._asked is not None and self._asked[0].source == view.source and self._asked[1] == options:
            return
        self._asked, self._result, self._problem = (view, options), None, ""
        self._task.ask(partial(_fitted, view, options))
        self._show()

    def _receive(self, result: Fitted | str) -> None:
        self._result, self._problem = (None, result) if isinstance(result, str) else (result, "")
        self._show()

    def _show_share(self, share: float, _word: str) -> None:
        if self._panel is not None:
            self._panel.progress.show_share(share)

    def _show(self) -> None:
        """Show the fitted curve, its farthest point, and the message about it."""
        result, traces = self._result, []
        if result is not None:
            line = view_of(result.curve).polyline
            traces.append(Trace((line,), CURE_STYLE, result.words.partition(";")[0]))
            far = _cross(result.farthest, 0.01 * size_of(line))
            traces.append(Trace(far, FAR_STYLE, f"farthest: {number(result.deviation, 3)}"))
        self._context.central.canvas.drawing.annotations.render_traces(_GROUP, traces, "Fewer points")
        if self._panel is not None:
            busy = self._asked is not None and result is None and not self._problem
            words = self._words(result) if result is not None else self._problem or (_BUSY if busy else "")
            self._panel.render_result(words, can_apply=result is not None, busy=busy)

    def _words(self, result: Fitted) -> str:
        assert self._asked is not None
        view, options = self._asked
        text = f"{count_of(len(view.source.points), 'point')} become {result.words}"
        if view.source.shape:
            text += f" Only “{view.source.display_name}” is fitted; Simplify changes its whole shape."
        is_short = options.tolerance is not None and result.deviation > options.tolerance
        if is_short and not result.is_scattered:
            text += f" No closer {options.family.title} curve was found."
        if is_of_points_alone(view) and not result.is_scattered:
            text += " Measured at the points, not between them."
        return text

    def _apply(self) -> None:
        result, index = self._result, self._session.active_index
        if result is None:
            return
        curve = result.curve
        if self._session.change("Fit to fewer points", lambda before: replace_curve(before, index, curve)):
            self._session.say(result.words)
            self._dock.close()

    def _cancel(self) -> None:
        self._dock.close()


def _fitted(view: CurveView, options: FitOptions, report: Report) -> Fitted | str:
    try:
        return fitted_to_curve(
            view,
            view.source.with_family(options.family),
            count=options.count,
            tolerance=options.tolerance,
            keeps_times=options.keeps_times,
            report=report,
        )
    except EditError as problem:
        return str(problem)


def _cross(position: Vector, size: float) -> list[FloatArray]:
    """Return two strokes of a cross at a position."""
    at = np.array(position)
    return [np.array([at - arm, at + arm]) for arm in size * np.array([[1.0, 1.0], [1.0, -1.0]])]


COMMAND_SETS = (FitCommands, SimplifyCommands)
