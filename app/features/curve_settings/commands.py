"""The form of the active curve in the window: its dock, and actions for its rules and settings."""

from __future__ import annotations

from functools import partial
from string import capwords

from PySide6.QtWidgets import QWidget

from ...actions.declaration import Action, action_for_each
from ...actions.keymap import action_name
from ...actions.menus import CURVE_ESTIMATES, CURVE_SETTINGS
from ...actions.needs import Need
from ...document.derivatives import DERIVATIVES, Derivative, EstimateRule
from ...document.model import Document
from ...document.rule_edits import set_family_setting, set_rule
from ...families import FAMILIES, Family, FamilySetting
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits, SliderGesture
from .panel import CurveSettings, NumberField, choice_of, step_of

_RULES = tuple((of, rule) for of in DERIVATIVES for rule in of.rules)


def _rule_action(record: tuple[Derivative, EstimateRule]) -> Action:
    """Return the action that chooses a rule to estimate derivatives."""
    derivative, rule = record
    return Action(
        action_name(f"{derivative.name}Rule", rule),
        f"{derivative.plural.capitalize()}: {rule.label}",
        CURVE_ESTIMATES,
        tip=rule.tip,
        keywords=f"estimate {derivative.name} rule tangents",
        needs=Need(
            f"a curve with {derivative.plural}", lambda state: state.family.derivatives >= derivative.order
        ),
        checked=lambda state: (
            state.family.derivatives >= derivative.order and state.rules[derivative.order - 1] is rule
        ),
        group=f"{derivative.name}Rule",
    )


def _settings() -> list[tuple[Family, FamilySetting]]:
    return [(family, setting) for family in FAMILIES for setting in family.settings.all]


def _setting_action(record: tuple[Family, FamilySetting]) -> Action:
    """Return the action that focuses the field of a setting."""
    family, setting = record
    name = "".join(word.capitalize() for word in setting.name.split("_"))
    return Action(
        f"{family.action_name}{name}",
        f"{capwords(setting.title)}…",
        CURVE_SETTINGS,
        tip=setting.tip or setting.label,
        full_name=f"{capwords(family.title)}: {capwords(setting.title)}…",
        keywords=f"{setting.name.replace('_', ' ')} set setting",
        needs=Need(family.a_curve, lambda state: state.family == family),
    )


def _name_at_position(setting: FamilySetting, field: NumberField, position: int) -> str:
    return step_of(setting, field.value_at(position))


class CurveSettingsCommands:
    """The form of the active curve, and actions for its rules and settings.

    Attributes
    ----------
    panel
        The form, as soon as the docks are filled.
    """

    panel: CurveSettings

    def __init__(self, context: WindowContext) -> None:
        self._session, self._hold_ghost = context.session, context.central.canvas.drawing.hold_ghost
        self._dock, self._actions = context.docks["curveDock"], context.actions
        self._gestures: list[SliderGesture] = []
        self._rendered: CurveView | None = None

    @Panel("curveDock", "Curve", built_at_start=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form."""
        self._rendered = self._session.target_view
        self.panel = CurveSettings(self._rendered, parent)
        self._edits = FormEdits(self._session, self.panel)
        self.panel.reset_button.clicked.connect(self._actions["resetAllPoints"].trigger)
        self.panel.settings.rebuilt.connect(self._connect_sliders)
        self._connect_sliders()
        return self.panel

    def _connect_sliders(self) -> None:
        self._gestures = []
        for setting, field in self.panel.settings.numbers.items():
            edit = partial(self._edit_at_position, setting, field)
            name = partial(_name_at_position, setting, field)
            self._gestures.append(SliderGesture(self._session, field.slider, edit, name))
            field.slider.sliderPressed.connect(lambda: self._hold_ghost(True))
            field.slider.drag_ended.connect(lambda: self._hold_ghost(False))

    def _edit_at_position(
        self, setting: FamilySetting, field: NumberField, document: Document, position: int
    ) -> Document:
        value = field.value_at(position)
        return set_family_setting(document, self._session.active_index, setting.name, value)

    @action_for_each(_RULES, _rule_action)
    def _use_rule(self, record: tuple[Derivative, EstimateRule]) -> None:
        (derivative, rule), session = record, self._session
        session.change(
            choice_of(derivative, rule), lambda document: set_rule(document, session.active_index, rule)
        )

    @action_for_each(_settings, _setting_action)
    def _focus_setting(self, record: tuple[Family, FamilySetting]) -> None:
        self._dock.bring_up()
        self.panel.settings.focus(record[1])

    def render_panel(self, view: CurveView) -> None:
        """Show the curve to edit; a change of the selected points leaves the form as it is."""
        if (view_to_show := self._session.target_view) is not self._rendered:
            self._rendered = view_to_show
            self.panel.render_view(view_to_show)


COMMAND_SETS = (CurveSettingsCommands,)
