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
    QProgressBar,
    QPushButton,
    QToolButton,
    QWidget,
)

from ..appearance.theme import FollowsTheme, Theme, mix
from ..document.words import NamedEnum
from ..qt.overrides import SafeOverrides
from .boxes import row_of

_Named = TypeVar("_Named", bound=QWidget)

_STEPS = 1000


def named(widget: _Named, name: str, label: str = "", tip: str = "") -> _Named:
    """Give a widget its object name, the name that screen readers say, and its tip; return it."""
    widget.setObjectName(name)
    if label:
        widget.setAccessibleName(label)
    if tip:
        widget.setToolTip(tip)
    return widget


def push_button(name: str, text: str, tip: str, label: str = "") -> QPushButton:
    """Return a button that Enter elsewhere does not press."""
    button = named(QPushButton(text), name, label, tip)
    button.setAutoDefault(False)
    return button


def check_box(name: str, text: str, tip: str, label: str = "") -> QCheckBox:
    """Return a check box."""
    return named(QCheckBox(text), name, label, tip)


class ChoiceBox(SafeOverrides, QComboBox):
    """A box of choices that the wheel turns while it has the focus; else what lies around it scrolls."""

    def __init__(self) -> None:
        super().__init__()
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self.hasFocus():
            super().wheelEvent(event)
        else:
            event.ignore()


def choice_box(
    name: str, label: str, tip: str, items: Iterable[str] = (), tips: Iterable[str] = ()
) -> QComboBox:
    """Return a box with these items, and a tip for each of the first of them."""
    box = named(ChoiceBox(), name, label, tip)
    box.addItems(list(items))
    for place, each in enumerate(tips):
        box.setItemData(place, each, Qt.ItemDataRole.ToolTipRole)
    return box


class ThinProgress(QProgressBar):
    """A low progress bar without words."""

    def __init__(self, name: str, tip: str) -> None:
        super().__init__()
        named(self, name, "Progress", tip)
        self.setRange(0, _STEPS)
        self.setTextVisible(False)
        self.setFixedSize(120, 8)

    def show_share(self, share: float) -> None:
        """Show how much is done, from 0 to 1; it never runs backwards."""
        self.setValue(max(self.value(), round(share * _STEPS)))


class ToolbarWidget(QWidget):
    """Part of the toolbar that is no button."""

    yields_late = False
    """Whether it keeps its words as long as the buttons beside it keep their icons and words."""

    def set_compact(self, compact: bool) -> None:
        """Take less room in a narrow window."""


ICON = 16
"""Pixels along the sides of an icon in a panel."""


def tool_button(
    name: str, label: str, tip: str, *, text: str = "", icon_size: int = 0, flat: bool = False
) -> QToolButton:
    """Return a button with this object name, accessible name and tip.

    Parameters
    ----------
    text
        Stands on the button; beside its icon, where `icon_size` tells that it has one.
    icon_size
        Pixels along the sides of the icon; 0 for the size that the style has.
    flat
        Whether it has no frame until the pointer is over it.
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
    """Return a button for `action`, called as it is or by `name`; its text may stand `beside` the icon."""
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
    accent, chosen = theme.accent.name(), mix(theme.accent, theme.surface, 0.14).name()
    return (
        f"QToolButton {{ border: 1px solid {theme.grid_coarse.name()}; {shape} }}"
        f"QToolButton:hover {{ background: {mix(theme.ink, theme.surface, 0.07).name()} }}"
        f"QToolButton:checked {{ background: {chosen}; color: {accent}; border-color: {accent} }}"
        f"QToolButton:focus {{ border-color: {accent} }}"
    )


def mirror(button: QAbstractButton, action: QAction) -> None:
    """Let a button show whether an action is checked, and trigger it."""
    button.setCheckable(action.isCheckable())
    button.setChecked(action.isChecked())
    button.setToolTip(action.toolTip())
    button.clicked.connect(action.trigger)
    if action.isCheckable():
        action.toggled.connect(button.setChecked)


class ChoiceRow(FollowsTheme, QWidget):
    """One of a few, taken with one click; none is on while they differ.

    Signals
    -------
    chosen
        A button was clicked: the member.
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
        self._shown: object = None
        row_of(*self._buttons.values(), 1, margins=0, spacing=4, parent=self)
        self.follow_theme()

    def render_value(self, value: object) -> None:
        """Show a member as the one that is on; anything else for none."""
        self._shown = value
        for member, button in self._buttons.items():
            button.setChecked(member is value)

    def _choose(self, member: NamedEnum) -> None:
        # What is on is what the owner shows.
        self.render_value(self._shown)
        self.chosen.emit(member)

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.setStyleSheet(choice_style(theme))
