"""Tool buttons, named for tests and screen readers, and the style of those that switch something."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QToolButton, QWidget

from ..appearance.theme import Theme, mix
from .controls import named

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
