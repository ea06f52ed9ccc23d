"""Edits by the form of the active curve."""

from __future__ import annotations

from collections.abc import Callable

from app.document import edits
from app.document.model import AccelerationRule, Document, VelocityRule
from app.features.curve_settings.panel import CurveSettings, orders_set
from app.session import Session


class CurveSettingsController:
    """Turns what is typed and chosen in the form into changes of the active curve."""

    def __init__(self, session: Session, panel: CurveSettings) -> None:
        self._session, self._panel = session, panel
        panel.name_edited.connect(self._rename)
        panel.interval_edited.connect(self._set_interval)
        panel.velocity_rule_chosen.connect(self._set_velocity_rule)
        panel.acceleration_rule_chosen.connect(self._set_acceleration_rule)
        panel.reset_requested.connect(self._reset_all)
        panel.refused.connect(session.refuse)

    def _rename(self, name: str) -> None:
        self._change("Rename curve", lambda document, index: edits.rename_curve(document, index, name))

    def _set_interval(self, start: float, end: float) -> None:
        self._change("Set interval", lambda document, index: edits.set_interval(document, index, start, end))

    def _set_velocity_rule(self, rule: VelocityRule) -> None:
        self._change(
            "Choose velocity rule", lambda document, index: edits.set_velocity_rule(document, index, rule)
        )

    def _set_acceleration_rule(self, rule: AccelerationRule) -> None:
        self._change(
            "Choose acceleration rule",
            lambda document, index: edits.set_acceleration_rule(document, index, rule),
        )

    def _reset_all(self) -> None:
        def reset(document: Document, index: int) -> Document:
            everyone = range(len(document.curves[index].points))
            orders = orders_set(self._session.active_view)
            return edits.estimate_derivatives(document, index, everyone, orders)

        self._change("Reset all to estimated", reset)

    def _change(self, text: str, edit: Callable[[Document, int], Document]) -> None:
        change = self._session.change(text, lambda document: edit(document, self._session.active_index))
        if change.refusal:
            self._panel.refuse(change.refusal)
