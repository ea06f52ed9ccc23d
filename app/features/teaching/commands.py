"""Warnings that teach: a badge in the status line when the numbers of a curve deserve a word."""

from __future__ import annotations

from PySide6.QtCore import QObject

from ...qt.labels import Label
from ...view_model.analysis.warnings import Topic, Warned, warnings_of
from ...view_model.basis import growth_of_points
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from .teaching_badge import TeachingBadge


class TeachingCommands(QObject):
    """Shows the badge; what was put away comes back when it has been mended and happens again."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._away: set[tuple[int, Topic]] = set()
        self._shown: Warned | None = None
        self._known: tuple[CurveView, list[Warned]] | None = None
        self._badge = TeachingBadge()
        context.status_line.addPermanentWidget(self._badge)
        self._badge.hide()
        self._plain = context.status_line.findChild(Label, "lebesgueConstant")
        self._badge.laboratory_wanted.connect(self._open_laboratory)
        self._badge.explanation_wanted.connect(context.actions["explainWidest"].trigger)
        self._badge.dismiss.connect(self._dismiss)
        self._session.opened.connect(self._begin_anew)

    def _open_laboratory(self) -> None:
        """Bring the laboratory to the front; the action that opens it would close one that is there."""
        dock = self._context.docks["laboratoryDock"]
        if self._context.store.state.analysis.laboratory.on and dock.isVisible():
            dock.raise_()
        else:
            self._context.actions["toggleLaboratory"].trigger()

    def render_panel(self, view: CurveView) -> None:
        """Show what is worth a warning; nothing comes or goes while something is dragged."""
        if self._session.is_previewing:
            return
        found = self._warnings(view)
        curve, topics = self._session.active_index, {each.topic for each in found}
        self._away -= {(curve, topic) for topic in Topic if topic not in topics}
        self._shown = next((each for each in found if (curve, each.topic) not in self._away), None)
        self._badge.render_warning(self._shown)
        # The badge says the same number louder.
        if self._plain is not None:
            self._plain.setVisible(self._shown is None or self._shown.topic is not Topic.LEBESGUE)

    def _warnings(self, view: CurveView) -> list[Warned]:
        if self._known is None or self._known[0] is not view:
            basis = self._context.central.basis
            self._known = (
                view,
                warnings_of(view, growth_of_points(view, basis)) if basis is not None else [],
            )
        return self._known[1]

    def _dismiss(self) -> None:
        if self._shown is not None:
            self._away.add((self._session.active_index, self._shown.topic))
            self.render_panel(self._session.active_view)

    def _begin_anew(self) -> None:
        self._away.clear()
        self.render_panel(self._session.active_view)


COMMAND_SETS = (TeachingCommands,)
