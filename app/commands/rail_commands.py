"""What the t-rail offers: parameters to start from, and a number typed at a tick."""

from __future__ import annotations

from functools import partial

from msgspec.structs import replace
from PySide6.QtCore import QPoint
from PySide6.QtWidgets import QMenu

from app.commands.parts import Handlers, Parts
from app.document import edits
from app.document.model import ParametrizationKind
from app.view_model.curve_view import CurveView, view_of

_STARTS = {
    "startUniform": (ParametrizationKind.UNIFORM, "uniform"),
    "startChordLength": (ParametrizationKind.CHORD_LENGTH, "chord length"),
    "startCentripetal": (ParametrizationKind.CENTRIPETAL, "centripetal"),
    "startChebyshev": (ParametrizationKind.CHEBYSHEV, "Chebyshev"),
}


class RailCommands:
    """The menu of the t-rail."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._actions = parts.actions
        parts.basis_panel.menu_requested.connect(self._show_menu)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        starts = {name: partial(self._start_from, *start) for name, start in _STARTS.items()}
        return {**starts, "typeParameter": self._type_parameter}

    def render(self, view: CurveView) -> None:
        """Enable what the curve and the selection allow."""
        for name in _STARTS:
            self._actions[name].setEnabled(len(view.points) > 1)
        self._actions["typeParameter"].setEnabled(view.is_current and len(self._session.selection) == 1)

    def _show_menu(self, place: QPoint) -> None:
        menu = QMenu(self._parts.window)
        menu.setObjectName("railMenu")
        menu.addAction(self._actions["typeParameter"])
        menu.addSeparator()
        for name in (*_STARTS, "freezeParameters"):
            menu.addAction(self._actions[name])
        menu.aboutToHide.connect(menu.deleteLater)
        menu.popup(place)

    def _start_from(self, kind: ParametrizationKind, words: str) -> None:
        """Make the parameters manual, starting from those that a rule gives on the present interval."""
        session = self._session
        curve = session.active_curve
        start, end = edits.interval(curve)
        rule = replace(curve.parametrization, kind=kind, start=start, end=end)
        ruled = session.document.with_curve(session.active_index, replace(curve, parametrization=rule))
        view = view_of(ruled.curves[session.active_index])
        if not view.is_current:
            session.refuse(view.problem)
            return
        session.change(
            f"Start from {words} parameters",
            lambda _: edits.freeze_parameters(ruled, session.active_index, view.parameters.tolist()),
        )

    def _type_parameter(self) -> None:
        selected = self._session.selected
        if selected is not None:
            self._parts.basis_panel.edit_tick(selected)
