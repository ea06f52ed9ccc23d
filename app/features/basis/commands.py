"""What the t-rail offers: parameters to start from, and a number typed at a tick."""

from __future__ import annotations

from typing import NamedTuple

from msgspec.structs import replace
from PySide6.QtCore import QPoint

from app.actions.declaration import Action, action, action_for_each, also
from app.actions.keymap import action_name
from app.actions.needs import TWO_POINTS, Need
from app.actions.sections import CURVE_PARAMETERS, CURVE_STARTS
from app.actions.strips import RAIL_MENU
from app.controllers.rail import RailController
from app.document import edits
from app.document.model import ParametrizationKind
from app.view_model.curve_view import view_of
from app.workbench.context import WindowContext
from app.workbench.strip_menu import strip_menu


class _Start(NamedTuple):
    """A rule to start from, and what its action says."""

    kind: ParametrizationKind
    words: str
    tip: str


_STARTS = (
    _Start(ParametrizationKind.UNIFORM, "uniform", "Make the parameters manual, evenly spaced"),
    _Start(
        ParametrizationKind.CHORD_LENGTH, "chord length",
        "Make the parameters manual, spaced as the points are"
    ),
    _Start(
        ParametrizationKind.CENTRIPETAL, "centripetal",
        "Make the parameters manual, spaced by the square roots of the distances",
    ),
    _Start(ParametrizationKind.CHEBYSHEV, "Chebyshev", "Make the parameters manual, at Chebyshev points"),
)  # fmt: skip


class RailCommands:
    """The menu of the t-rail."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session
        self._controller = RailController(context.session, context.central.basis_panel)
        context.central.basis_panel.menu_requested.connect(self._show_menu)

    def _show_menu(self, place: QPoint) -> None:
        strip_menu(self._context, RAIL_MENU, "railMenu").popup(place)

    @action_for_each(
        _STARTS,
        lambda each: Action(
            action_name("start", each.kind),
            f"Manual, from {each.words.title()}",
            CURVE_STARTS,
            tip=each.tip,
            full_name=f"Manual Parameters, from {each.words.title()}",
            needs=TWO_POINTS,
        ),
    )
    @also(RAIL_MENU(20))
    def _start_from(self, each: _Start) -> None:
        """Make the parameters manual, starting from those that a rule gives on the present interval."""
        session = self._session
        curve = session.active_curve
        start, end = edits.interval(curve)
        rule = replace(curve.parametrization, kind=each.kind, start=start, end=end)
        ruled = session.document.with_curve(session.active_index, replace(curve, parametrization=rule))
        view = view_of(ruled.curves[session.active_index])
        if not view.is_current:
            session.refuse(view.problem)
            return
        session.change(
            f"Start from {each.words} parameters",
            lambda _: edits.freeze_parameters(ruled, session.active_index, view.parameters.tolist()),
        )

    @action(
        "typeParameter",
        "Type t…",
        CURVE_PARAMETERS,
        full_name="Type a Parameter t…",
        needs=Need("one selected point", lambda now: now.view.is_current and len(now.selection) == 1),
    )
    @also(RAIL_MENU(10))
    def _type_parameter(self) -> None:
        """Type the parameter of the selected point at its tick."""
        selected = self._session.selected
        if selected is not None:
            self._context.central.basis_panel.edit_tick(selected)


COMMAND_SETS = (RailCommands,)
