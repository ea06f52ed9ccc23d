"""Widgets of the toolbar: the rule for the parameters with its α, and the menu of further families."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QMenu, QSizePolicy, QToolButton

from ...actions.keymap import plain
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document.model import Parametrization, ParametrizationKind
from ...document.selection import NONE_SELECTED
from ...qt.labels import Label, set_tip
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import row_of
from ...widgets.controls import ToolbarWidget, choice_box, named
from ...widgets.sliders import LiveSlider

STEPS = 100
"""Positions of the slider from α 0 to 1."""

_RULE_TIP = "Rule for the parameters t"
_SLIDER_TIP = "Δt = |Δp|^α: 0 uniform, ½ centripetal, 1 chord length"
_SLIDER_WIDTH, _COMPACT_SLIDER_WIDTH = 96, 56


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
        self._is_compact, self._has_alpha = False, True
        # The font and the measured excess in it, cached because it is needed at every change.
        self._measured = ("", 0)
        kinds = (kind.label for kind in ParametrizationKind)
        self.box = choice_box("parametrizationBox", "Parametrization", _RULE_TIP, kinds)
        for index, kind in enumerate(ParametrizationKind):
            if kind.spaced:
                self.box.setItemData(index, f"{kind.label}: {kind.spaced}", Qt.ItemDataRole.ToolTipRole)
        self.box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self._label = Label("Parameters")
        self.slider = self._make_slider()
        policy = self.slider.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        self.slider.setSizePolicy(policy)
        self._alpha = Label("α 0.00", name="alphaValue")
        # The size hint with text: without text the label, and the toolbar, would be a pixel narrower.
        self._alpha.setMinimumWidth(self._alpha.sizeHint().width())
        parts = (self._label, self.box, self.slider, self._alpha)
        row_of(*parts, margins=(4, 0, 4, 0), spacing=6, parent=self)
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
        self._is_compact = compact
        self._label.setVisible(not compact)
        self._share_room()

    def _share_room(self) -> None:
        """Give long names of rules, which have no α, a part of the room of the slider."""
        has_alpha, width = self._has_alpha, self.box.sizeHint().width()
        self.box.setFixedWidth(width - self._excess if has_alpha else width)
        slider = _COMPACT_SLIDER_WIDTH if self._is_compact else _SLIDER_WIDTH
        self.slider.setFixedWidth(slider if has_alpha else max(slider - self._excess, 1))
        self.slider.setVisible(has_alpha or not self._is_compact)

    @property
    def _excess(self) -> int:
        """Excess in pixels of the longest name over the names of rules with an α."""
        if (font := self.box.font().key()) != self._measured[0]:
            width = self.box.fontMetrics().horizontalAdvance
            longest = max(width(kind.label) for kind in ParametrizationKind)
            short = max(width(kind.label) for kind in ParametrizationKind if _has_alpha(kind))
            self._measured = font, longest - short
        return self._measured[1]

    def render_view(self, view: CurveView | None) -> None:
        """Show the rule of `view`; None without a curve."""
        self._view = view
        self.box.setEnabled(view is not None)
        if view is None:
            self._render_none()
        else:
            self._render_rule(view.source.parametrization)
        self._share_room()

    def _render_none(self) -> None:
        self._has_alpha = True
        self.box.setCurrentIndex(-1)
        for part in (self.box, self.slider):
            set_tip(part, NONE_SELECTED)
        self.slider.setEnabled(False)
        self._alpha.setText("")

    def _render_rule(self, rule: Parametrization) -> None:
        self.box.setCurrentIndex(list(ParametrizationKind).index(rule.kind))
        spaced = f", {rule.kind.spaced}" if rule.kind.spaced else ""
        set_tip(self.box, f"{_RULE_TIP}: {rule.kind.phrase}{spaced}")
        # Three of the rules are powers with a fixed α; the slider shows it.
        alpha = rule.alpha if rule.kind.alpha is None else rule.kind.alpha
        if not self.slider.isSliderDown():
            self.slider.setValue(round(alpha * STEPS))
        self._has_alpha = _has_alpha(rule.kind)
        self.slider.setEnabled(self._has_alpha)
        set_tip(self.slider, _SLIDER_TIP)
        self._alpha.setEnabled(self._has_alpha)
        self._alpha.setText(f"α {alpha:.2f}")

    def _render_again(self) -> None:
        """Show the current rule again, after a choice that was refused."""
        self.render_view(self._view)

    def _choose_kind(self, index: int) -> None:
        self.kind_picked.emit(list(ParametrizationKind)[index])
        self._render_again()

    def _end_drag(self) -> None:
        self._render_again()
        self.drag_changed.emit(False)


def _has_alpha(kind: ParametrizationKind) -> bool:
    return kind.alpha is not None or "alpha" in kind.takes


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
        self._menu = self._make_menu()
        self.button.setMenu(self._menu)
        row_of(self.button, margins=(0, 0, 0, 0), parent=self)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)
        self.follow_theme()

    def offer(self, further: Sequence[tuple[QAction, str]]) -> None:
        """Set the actions of the menu, each with a short text for the button.

        One that is gone has left the menu by itself.
        """
        for action, _word in further:
            if action not in self._words:
                self._menu.addAction(action)
                action.changed.connect(self.show_in_use)
        self._words = dict(further)
        self.button.setVisible(bool(further))
        self.show_in_use()

    def _make_menu(self) -> QMenu:
        menu = QMenu(self.button)
        menu.setObjectName("familiesMenu")
        menu.setToolTipsVisible(True)
        return menu

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
