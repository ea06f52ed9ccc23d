"""Buttons, boxes and bars, named for tests and screen readers; tool buttons are in `tool_buttons`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from PySide6.QtCore import Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QProgressBar, QPushButton, QWidget

from ..qt.overrides import SafeOverrides

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
