"""Buttons and boxes with names for tests and screen readers, tool buttons, and rows of choices."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction, QWheelEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QCheckBox,
    QComboBox,
    QMenu,
    QProgressBar,
    QPushButton,
    QToolButton,
    QWidget,
)

from ..appearance.theme import FollowsTheme, Theme, mix
from ..document.words import NamedEnum
from ..qt.overrides import SafeOverrides, guard
from .boxes import row_of

_Named = TypeVar("_Named", bound=QWidget)

_STEPS = 1000


def named(widget: _Named, name: str, label: str = "", tip: str = "") -> _Named:
    """Set object name, accessible name and tip of a widget, and return it."""
    widget.setObjectName(name)
    if label:
        widget.setAccessibleName(label)
    if tip:
        widget.setToolTip(tip)
    return widget


def push_button(name: str, text: str, tip: str, label: str = "") -> QPushButton:
    """Return a button that is not the default of its dialog."""
    button = named(QPushButton(text), name, label, tip)
    button.setAutoDefault(False)
    return button


def check_box(name: str, text: str, tip: str, label: str = "") -> QCheckBox:
    """Return a check box."""
    return named(QCheckBox(text), name, label, tip)


class WheelNeedsFocus(SafeOverrides):
    """Mixin for widgets, named before Qt's class: without the focus the wheel scrolls the area around."""

    @guard
    def wheelEvent(self, event: QWheelEvent) -> None:
        """Step with the focus; called by Qt."""
        if self.hasFocus():  # type: ignore[attr-defined]  # of the widget's class
            super().wheelEvent(event)  # type: ignore[misc]
        else:
            event.ignore()


class ChoiceBox(WheelNeedsFocus, QComboBox):
    """A box of choices that reacts to the wheel only while it has the focus."""

    def __init__(self) -> None:
        super().__init__()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)


def choice_box(
    name: str, label: str, tip: str, items: Iterable[str] = (), tips: Iterable[str] = ()
) -> QComboBox:
    """Return a box with these items, and tips for the first ones."""
    box = named(ChoiceBox(), name, label, tip)
    box.addItems(list(items))
    for row, tip_of_item in enumerate(tips):
        box.setItemData(row, tip_of_item, Qt.ItemDataRole.ToolTipRole)
    return box


class ThinProgress(QProgressBar):
    """A thin progress bar without text."""

    def __init__(self, name: str, tip: str) -> None:
        super().__init__()
        named(self, name, "Progress", tip)
        self.setRange(0, _STEPS)
        self.setTextVisible(False)
        self.setFixedSize(120, 8)

    def show_share(self, share: float) -> None:
        """Show the share that is done, from 0 to 1; the bar never runs backwards."""
        self.setValue(max(self.value(), round(share * _STEPS)))


class ToolbarWidget(QWidget):
    """A widget of the toolbar other than a button."""

    yields_late = False
    """Whether it becomes compact only after the buttons beside it have."""

    def set_compact(self, compact: bool) -> None:
        """Use less room in a narrow window, or the usual one."""


def menu_with_tips(name: str, parent: QWidget) -> QMenu:
    """Return an empty menu that shows the tips of its entries."""
    menu = named(QMenu(parent), name)
    menu.setToolTipsVisible(True)
    return menu


ICON = 16
"""Side of an icon in a panel, in pixels."""


def tool_button(
    name: str, label: str, tip: str, *, text: str = "", icon_size: int = 0, flat: bool = False
) -> QToolButton:
    """Return a button with this object name, accessible name and tip.

    Parameters
    ----------
    text
        Text on the button; beside its icon if there is an `icon_size`.
    icon_size
        Side of the icon in pixels; 0 for the size of the style.
    flat
        Whether the button has no frame until the pointer is over it.
    """
    button = named(QToolButton(), name, label, tip)
    button.setText(text)
    _style_button(button, icon_size=icon_size, beside=bool(text and icon_size), flat=flat)
    return button


def action_button(
    action: QAction,
    parent: QWidget | None = None,
    *,
    name: str = "",
    icon_size: int = ICON,
    beside: bool = False,
    flat: bool = False,
) -> QToolButton:
    """Return a button for `action`, with its name or `name`; its text may stand `beside` the icon."""
    button = QToolButton(parent)
    button.setDefaultAction(action)
    named(button, f"{name or action.objectName()}Button", action.text())
    _style_button(button, icon_size=icon_size, beside=beside, flat=flat)
    return button


def _style_button(button: QToolButton, *, icon_size: int, beside: bool, flat: bool) -> None:
    button.setAutoRaise(flat)
    if icon_size:
        button.setIconSize(QSize(icon_size, icon_size))
    if beside:
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)


def choice_style(theme: Theme) -> str:
    """Return the style sheet for the QToolButtons of a header."""
    shape = "border-radius: 4px; padding: 2px 5px"
    accent, checked = theme.accent.name(), mix(theme.accent, theme.surface, 0.14).name()
    return (
        f"QToolButton {{ border: 1px solid {theme.grid_coarse.name()}; {shape} }}"
        f"QToolButton:hover {{ background: {mix(theme.ink, theme.surface, 0.07).name()} }}"
        f"QToolButton:checked {{ background: {checked}; color: {accent}; border-color: {accent} }}"
        f"QToolButton:focus {{ border-color: {accent} }}"
    )


def mirror(button: QAbstractButton, action: QAction) -> None:
    """Let a button show the checked state of an action, and trigger it."""
    button.setCheckable(action.isCheckable())
    button.setChecked(action.isChecked())
    button.setToolTip(action.toolTip())
    button.clicked.connect(action.trigger)
    if action.isCheckable():
        action.toggled.connect(button.setChecked)


class ChoiceRow(FollowsTheme, QWidget):
    """A row of buttons for the members of an enumeration; none is checked while values differ.

    Signals
    -------
    chosen
        The member of the clicked button.
    """

    chosen = Signal(object)

    def __init__(self, name: str, label: str, tip: str, kind: type[NamedEnum]) -> None:
        super().__init__()
        self.setObjectName(name)
        self._buttons = {}
        for member in kind:
            text = member.label
            button = tool_button(
                f"{name}_{member.value}",
                f"{label}: {text}",
                f"{tip}: {text.lower()}",
                text=text,
            )
            button.setCheckable(True)
            button.clicked.connect(lambda _checked, member=member: self._choose(member))
            self._buttons[member] = button
        self._value: object = None
        row_of(*self._buttons.values(), 1, margins=0, spacing=4, parent=self)
        self.follow_theme()

    def render_value(self, value: object) -> None:
        """Check the button of a member; of none for anything else."""
        self._value = value
        for member, button in self._buttons.items():
            button.setChecked(member is value)

    def _choose(self, member: NamedEnum) -> None:
        # The owner decides which button is checked.
        self.render_value(self._value)
        self.chosen.emit(member)

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self.setStyleSheet(choice_style(theme))
