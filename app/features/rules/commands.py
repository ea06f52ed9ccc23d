"""The rules of a curve: widgets of the toolbar for its family and its parameters, then the actions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from string import capwords

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QSizePolicy, QToolButton

from ... import view_model
from ...actions.declaration import (
    Action,
    OpenedEntry,
    action,
    action_for_each,
    also,
    also_for_each,
    widget_at,
)
from ...actions.keymap import key_or_name, plain
from ...actions.menus import (
    CURVE_CONVERT,
    CURVE_FAMILIES,
    CURVE_FAMILY,
    CURVE_MENU,
    CURVE_PARAMETERS,
    CURVE_RULES,
    FAMILIES_MENU,
    RAIL_MENU,
    TOOLBAR,
)
from ...actions.needs import UNLOCKED_CURVE, Need
from ...actions.state import ActionState
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document import rule_edits
from ...document.curve_edits import replace_curve
from ...document.limits import EditError
from ...document.model import Document, Parametrization, ParametrizationKind
from ...document.selection import NONE_SELECTED
from ...document.several_curves import common_name, count_label, name_or_count
from ...document.words import number
from ...families import FAMILIES, Family
from ...qt.labels import Label, set_tip
from ...session import Session
from ...storage.resources import has_resource
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import row_of
from ...widgets.controls import ToolbarWidget, choice_box, menu_with_tips, named
from ...widgets.sliders import LiveSlider
from ...workbench.context import WindowContext
from ...workbench.form_edits import SliderGesture

STEPS = 100
"""Positions of the slider from α 0 to 1."""

_RULE_TIP = "Rule for the parameters t"
_SLIDER_TIP = "Δt = |Δp|^α: 0 uniform, ½ centripetal, 1 chord length"
_POWER = ParametrizationKind.POWER
_POWER_INDEX = list(ParametrizationKind).index(_POWER)
_SLIDER_WIDTH, _COMPACT_SLIDER_WIDTH = 84, 44


class ParametrizationBar(ToolbarWidget):
    """Toolbar widget for the rule of the parameters t_i and its exponent α.

    Signals
    -------
    kind_picked
        A rule was chosen in the box.
    drag_changed
        The slider is being dragged, or no longer.

    Attributes
    ----------
    box, slider
        The rules; the exponent α, in `STEPS`.
    """

    kind_picked = Signal(object)
    drag_changed = Signal(bool)

    def __init__(self) -> None:
        super().__init__()
        self._view: CurveView | None = None
        kinds = (kind.label for kind in ParametrizationKind)
        self.box = choice_box("parametrizationBox", "Parametrization", _RULE_TIP, kinds)
        for index, kind in enumerate(ParametrizationKind):
            if kind.spaced:
                self.box.setItemData(index, f"{kind.label}: {kind.spaced}", Qt.ItemDataRole.ToolTipRole)
        self.box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self._label = Label("Parameters")
        self.slider = self._make_slider()
        row_of(self._label, self.box, self.slider, margins=(4, 0, 4, 0), spacing=6, parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.box.activated.connect(self._choose_kind)
        self.slider.sliderPressed.connect(lambda: self.drag_changed.emit(True))
        self.slider.drag_ended.connect(self._end_drag)

    @staticmethod
    def _make_slider() -> LiveSlider:
        slider = LiveSlider()
        named(slider, "alphaSlider", "Exponent α of the power rule", _SLIDER_TIP)
        slider.setRange(0, STEPS)
        slider.setFixedWidth(_SLIDER_WIDTH)
        return slider

    def set_compact(self, compact: bool) -> None:
        self._label.setVisible(not compact)
        self.slider.setFixedWidth(_COMPACT_SLIDER_WIDTH if compact else _SLIDER_WIDTH)

    def render_view(self, view: CurveView | None) -> None:
        """Show the rule of `view`; None without a curve."""
        self._view = view
        self.box.setEnabled(view is not None)
        if view is None:
            self._render_none()
        else:
            self._render_rule(view.source.parametrization)

    def _render_none(self) -> None:
        self.box.setCurrentIndex(-1)
        for part in (self.box, self.slider):
            set_tip(part, NONE_SELECTED)
        self.slider.setEnabled(False)

    def _render_rule(self, rule: Parametrization) -> None:
        is_power = rule.kind is _POWER
        # The box has room for it: another number beside the box would push the buttons after it.
        power = f"{_POWER.label} = {rule.alpha:.2f}" if is_power else _POWER.label
        if self.box.itemText(_POWER_INDEX) != power:
            self.box.setItemText(_POWER_INDEX, power)
        self.box.setCurrentIndex(list(ParametrizationKind).index(rule.kind))
        spaced = f", {rule.kind.spaced}" if rule.kind.spaced else ""
        set_tip(self.box, f"{_RULE_TIP}: {rule.kind.phrase}{spaced}")
        # Three of the rules are powers with a fixed α; the slider shows it.
        alpha = rule.alpha if rule.kind.alpha is None else rule.kind.alpha
        if not self.slider.isSliderDown():
            self.slider.setValue(round(alpha * STEPS))
        has_alpha = is_power or rule.kind.alpha is not None
        self.slider.setEnabled(has_alpha)
        set_tip(self.slider, f"{_SLIDER_TIP}; now {number(alpha, 3)}" if has_alpha else _SLIDER_TIP)

    def _render_again(self) -> None:
        """Show the current rule again, after a choice that was refused."""
        self.render_view(self._view)

    def _choose_kind(self, index: int) -> None:
        self.kind_picked.emit(list(ParametrizationKind)[index])
        self._render_again()

    def _end_drag(self) -> None:
        self._render_again()
        self.drag_changed.emit(False)


_WORD, _FAMILIES_TIP = "Families", "More families of curves"
_ICON, _ARROW, _BESIDES = 20, 22, 36
"""Pixels along the sides of the icon, and of what stands beside it alone, and beside icon and word."""


class FamilyButton(FollowsTheme, ToolbarWidget):
    """Toolbar button with a menu of further families; it shows the one in use.

    Parameters
    ----------
    is_on
        Function that tells by name whether a switch is on.
    """

    yields_late = True

    def __init__(self, is_on: Callable[[str], bool]) -> None:
        super().__init__()
        self._is_on = is_on
        self._words: dict[QAction, str] = {}
        self._is_compact = False
        self._rendered: tuple[object, ...] = ()
        self.button = named(QToolButton(), "familiesButton", _FAMILIES_TIP)
        self.button.setCheckable(True)
        self.button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.button.setIconSize(QSize(_ICON, _ICON))
        self._menu = menu_with_tips("familiesMenu", self.button)
        self.button.setMenu(self._menu)
        row_of(self.button, margins=(0, 0, 0, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.follow_theme()

    def offer(self, further: Sequence[tuple[QAction, str]]) -> None:
        """Set the actions of the menu, each with a short text for the button.

        One that is gone has left the menu by itself.
        """
        for qaction, _word in further:
            if qaction not in self._words:
                self._menu.addAction(qaction)
                qaction.changed.connect(self.show_in_use)
        self._words = dict(further)
        self.button.setVisible(bool(further))
        self.show_in_use()

    def set_theme(self, theme: Theme) -> None:
        self.show_in_use()

    def set_compact(self, compact: bool) -> None:
        self._is_compact = compact
        self.show_in_use()

    def show_in_use(self) -> None:
        """Show the family in use, if it is in the menu; the width does not change."""
        action = next((entry for entry in self._words if self._is_on(entry.objectName())), None)
        button, word = self.button, _WORD if action is None else self._words[action]
        button.setChecked(action is not None)
        displayed = action or next(iter(self._words), None)
        picture = icon("spline", self.theme) if displayed is None else displayed.icon()
        text = "" if action is None else plain(action.text())
        # Called for each change of each action.
        state = picture.cacheKey(), text, self._words, self._is_compact, button.font()
        if state == self._rendered:
            return
        self._rendered = state
        button.setIcon(picture)
        button.setText(word)
        button.setToolTip(_FAMILIES_TIP if action is None else f"{_FAMILIES_TIP}; in use: {text}")
        style = Qt.ToolButtonStyle
        button.setToolButtonStyle(
            style.ToolButtonIconOnly if self._is_compact else style.ToolButtonTextBesideIcon
        )
        metrics = button.fontMetrics()
        widest = max(metrics.horizontalAdvance(entry) for entry in (_WORD, *self._words.values()))
        button.setFixedWidth(_ICON + (_ARROW if self._is_compact else _BESIDES + widest))


_MOST_KEYS = 10
"""Rank of the first family without a digit key."""


_BUTTONS = 3
"""Families with a button of their own in the toolbar."""


def _key_of(family: Family) -> str:
    """Return the digit key of a family; empty for families after the ninth."""
    digit = list(FAMILIES).index(family) + 1
    return str(digit) if digit < _MOST_KEYS else ""


def _icon_of(family: Family) -> str:
    """Return the name of the icon of a family, or else that of splines."""
    name = family.name.replace("_", "-")
    return name if has_resource("icons", f"{name}.svg") else "spline"


def _active_curve(family: Family) -> Need:
    """Return the condition of the digit key of a family, which several curves could get by accident."""

    def why(state: ActionState) -> str:
        then = f"then the same key makes it {family.title}"
        return f"Press Enter to edit “{state.curve_name}”; {then}. The toolbar changes all selected curves."

    def is_one(state: ActionState) -> bool:
        return state.has_selected_curve and state.selected_curve_count == 1

    return Need("one curve", lambda state: state.is_editing or state.is_blank or is_one(state), why=why)


class RuleCommands:
    """Actions for the family and the parameters, in menus and in the toolbar."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._actions = context.session, context.actions
        self._bar, self._families = ParametrizationBar(), FamilyButton(self._actions.is_on)
        self._actions.redeclared.connect(self._offer_further)
        self._actions.switched.connect(self._families.show_in_use)
        self._bar.kind_picked.connect(self._use_parametrization)
        self._bar.drag_changed.connect(context.central.canvas.drawing.hold_ghost)
        self._alpha = SliderGesture(
            context.session,
            self._bar.slider,
            self._with_alpha,
            lambda position: f"Set α to {position / STEPS:.2f}",
        )

    @widget_at(TOOLBAR(50))
    def build_bar(self) -> ToolbarWidget:
        """Return the bar of the toolbar."""
        return self._bar

    @widget_at(TOOLBAR(45))
    def build_families(self) -> ToolbarWidget:
        """Return the button of the toolbar for further families."""
        self._families.offer(self._further())
        return self._families

    def _offer_further(self) -> None:
        self._families.offer(self._further())

    def _further(self) -> list[tuple[QAction, str]]:
        """Return the actions of families without a toolbar button, with a short text for each."""
        further = [entry for group in self._actions.in_bar(FAMILIES_MENU).values() for entry in group]
        return [(entry, self._actions.button_text(entry, short=True)) for entry in further]

    def render_panel(self, view: CurveView) -> None:
        """Show the rule of the edited or selected curve in the toolbar."""
        self._bar.render_view(self._session.target_view)

    @action_for_each(
        FAMILIES,
        lambda family: Action(
            family.action_name,
            family.label,
            CURVE_FAMILY if family in FAMILIES[:_BUTTONS] else CURVE_FAMILIES,
            _key_of(family),
            _icon_of(family),
            family.tip,
            short=family.short,
            keywords=f"{family.full_title} {' '.join(family.name.split('_'))} {family.name.replace('_', '')}",
            checked=lambda state: state.family == family,
            group="family",
            key_needs=_active_curve(family),
        ),
    )
    @also_for_each(lambda family: (TOOLBAR(40) if family in FAMILIES[:_BUTTONS] else FAMILIES_MENU(10),))
    def _use_family(self, family: Family) -> None:
        session = self._session
        selected = sorted(session.selected.target_curves)
        several = f"{name_or_count(session.document, selected)} to " if len(selected) > 1 else ""
        before = list[CurveView]()

        def edit(document: Document) -> Document:
            before.extend(session.views[index] for index in selected)
            for index in selected:
                document = rule_edits.set_family(document, index, family)
            return document

        if session.change(f"Switch {several or 'to '}{family.title}", edit):
            self._say_switched(family, selected, before)

    def _say_switched(self, family: Family, curves: Sequence[int], before: Sequence[CurveView]) -> None:
        """Report side effects: several curves changed, curves that are open now, or a changed shape."""
        after = [self._session.views[curve] for curve in curves]
        document = self._session.document
        name = common_name(document, curves)
        what = f"{count_label(document, curves)} are" if name is None else f"“{name}” is"
        sentences = [f"{what} now {family.title}."] if len(after) > 1 else []
        away = max(map(view_model.convert.needless_change, before, after))
        if away:
            sentences.append(
                f"The shape changed by up to {number(away, 2)}; “Convert to {family.label}” keeps it."
            )
        if sentences:
            sentences[-1] = f"{sentences[-1].rstrip('.')} · {key_or_name(self._actions['undo'])}: undo"
        if any(
            old.source.is_closed and not new.source.is_closed for old, new in zip(before, after, strict=True)
        ):
            closes = next(member.title for member in FAMILIES if member.curve_class.can_close)
            sentences.insert(
                0, f"{family.subject} cannot close smoothly. It is drawn open, and closes again as {closes}."
            )
        if sentences:
            self._session.say(" ".join(sentences))

    @action_for_each(
        tuple(family for family in FAMILIES if family.takes_shapes),
        lambda family: Action(
            family.action_name.replace("family", "convertTo"),
            f"Convert to {family.label}, Keeping the Shape",
            CURVE_CONVERT,
            tip=f"Convert to {family.a_curve} of the same shape, where possible",
            when_opened=lambda session: RuleCommands._outlook(session, family),
            needs=Need(
                "an unlocked curve of another family",
                lambda state: UNLOCKED_CURVE.is_met(state) and state.family != family,
            ),
        ),
    )
    def _convert(self, family: Family) -> None:
        session = self._session
        converted = view_model.convert.converted(session.active_view, family)
        accuracy = "keeping the shape" if converted.keeps_shape else f"within {number(converted.residual, 2)}"
        if session.change(
            f"Convert to {family.title}, {accuracy}",
            lambda document: replace_curve(document, session.active_index, converted.curve),
        ):
            session.selected.set_points([])
            session.say(converted.sentence)

    @action_for_each(
        tuple(ParametrizationKind),
        lambda kind: Action(
            f"parameters_{kind}",
            kind.label,
            CURVE_RULES,
            tip=f"Use {kind.phrase} parameters" + (f": {kind.spaced}" if kind.spaced else ""),
            full_name=f"{capwords(kind.label)} Parameters",
            checked=lambda state: state.parametrization is kind,
            group="parametrization",
        ),
    )
    def _use_parametrization(self, kind: ParametrizationKind) -> None:
        session = self._session

        def edit(document: Document) -> Document:
            view = session.active_view
            if kind is ParametrizationKind.MANUAL and not view.is_current:
                raise EditError("There are no parameters to start from. Correct the points first.")
            return rule_edits.set_parametrization(
                document, session.active_index, kind, view.parameters.tolist()
            )

        session.change(f"Use {kind.phrase} parameters", edit)

    @action(
        "freezeParameters",
        "Freeze Parameters",
        CURVE_PARAMETERS,
        icon="lock",
        needs=Need(
            "parameters given by a rule",
            lambda state: state.is_current and state.parametrization is not ParametrizationKind.MANUAL,
        ),
    )
    @also(CURVE_MENU(14), RAIL_MENU(21))
    def _freeze_parameters(self) -> None:
        """Make the current parameters manual."""
        session = self._session
        parameters = session.active_view.parameters.tolist()
        session.change(
            "Freeze parameters",
            lambda document: rule_edits.freeze_parameters(document, session.active_index, parameters),
        )

    @action(
        "useUniform",
        "Use Uniform Parameters",
        CURVE_PARAMETERS,
        icon="spline",
        needs=Need(
            "parameters that are not uniform",
            lambda state: state.parametrization is not ParametrizationKind.UNIFORM,
        ),
    )
    def _use_uniform(self) -> None:
        """Space the parameters evenly, regardless of the positions of the points."""
        self._use_parametrization(ParametrizationKind.UNIFORM)

    def _with_alpha(self, document: Document, position: int) -> Document:
        index, alpha = self._session.active_index, position / STEPS
        if document.curves[index].parametrization.exponent == alpha:
            return document
        return rule_edits.set_alpha(document, index, alpha)

    @staticmethod
    def _outlook(session: Session, family: Family) -> OpenedEntry:
        """Return text and tip of the conversion of the active curve."""
        outlook = view_model.convert.outlook(session.active_view, family)
        text, tip = f"Convert to {family.label}, ", f"Convert to {family.a_curve} of the same shape"
        if not outlook.within:
            return OpenedEntry(f"{text}Keeping the Shape", tip, outlook.refusal)
        within = number(outlook.within, 1)
        follow = f"Approximate the curve, which is not a polynomial, with {family.a_curve}"
        return OpenedEntry(f"{text}Within {within}", f"{follow}; it changes by at most about {within}")


COMMAND_SETS = (RuleCommands,)
