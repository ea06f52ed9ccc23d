"""Spin boxes that take any number and say when it is not possible.

Qt's own refuse the key that would lead out of the range: of a typed 60 where 50 is the most, 6 is left.
"""

from __future__ import annotations

from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QSpinBox

from ..document.words import number
from ..qt.overrides import SafeOverrides
from .controls import named

_FAR = 999_999_999


def _step_between(box: RangedSpinBox | RangedDoubleSpinBox, steps: int) -> None:
    """Step, and stay between the limits; called by Qt."""
    QAbstractSpinBox.stepBy(box, steps)
    box.setValue(min(max(box.value(), box.least), box.most))  # type: ignore[arg-type]  # each has its own kind


def _turn(box: RangedSpinBox | RangedDoubleSpinBox, event: QWheelEvent) -> None:
    """Step while it has the focus; else what lies around it scrolls. Called by Qt."""
    if box.hasFocus():
        QAbstractSpinBox.wheelEvent(box, event)
    else:
        event.ignore()


def _problem_of(box: RangedSpinBox | RangedDoubleSpinBox) -> str:
    """Why the number that stands here is not possible; empty where it is."""
    if box.least <= box.value() <= box.most:
        return ""
    return f"{box.accessibleName()}: from {number(box.least, 6)} to {number(box.most, 6)}."


def _describe(box: RangedSpinBox | RangedDoubleSpinBox, name: str, label: str, tip: str) -> None:
    box.setRange(-_FAR, _FAR)
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    named(box, name, label, tip)


class RangedSpinBox(SafeOverrides, QSpinBox):
    """A whole number between two limits, typed or stepped; the arrows stay between them.

    Attributes
    ----------
    least, most
        The limits.
    """

    def __init__(self, name: str, label: str, tip: str, limits: tuple[int, int]) -> None:
        super().__init__()
        self.least, self.most = limits
        self.setLocale(QLocale.c())
        _describe(self, name, label, tip)

    # In the body of each class, where `SafeOverrides` finds what overrides Qt's.
    stepBy = _step_between  # noqa: N815 - as Qt calls it
    wheelEvent = _turn
    problem = property(_problem_of)


class RangedDoubleSpinBox(SafeOverrides, QDoubleSpinBox):
    """As `RangedSpinBox`, with decimals."""

    def __init__(self, name: str, label: str, tip: str, limits: tuple[float, float]) -> None:
        super().__init__()
        self.least, self.most = limits
        _describe(self, name, label, tip)

    stepBy = _step_between  # noqa: N815 - as Qt calls it
    wheelEvent = _turn
    problem = property(_problem_of)
