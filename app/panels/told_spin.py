"""Spin boxes that take any number and say when it is not possible.

Qt's own refuse the key that would lead out of the range: of a typed 60 where 50 is the most, 6 is left.
"""

from __future__ import annotations

from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QSpinBox

from app.overrides import Guarded

_FAR = 999_999_999


class ToldSpinBox(Guarded, QSpinBox):
    """A whole number between two limits, typed or stepped; the arrows stay between them.

    Attributes
    ----------
    least, most
        The limits.
    """

    def __init__(self, name: str, label: str, tip: str, limits: tuple[int, int]) -> None:
        super().__init__()
        self.least, self.most = limits
        self.setRange(-_FAR, _FAR)
        self.setLocale(QLocale.c())
        _dress(self, name, label, tip)

    @property
    def problem(self) -> str:
        """Why the number that stands here is not possible; empty where it is."""
        return _problem(self, self.least, self.value(), self.most)

    def stepBy(self, steps: int) -> None:  # noqa: N802
        super().stepBy(steps)
        self.setValue(min(max(self.value(), self.least), self.most))


class ToldDoubleSpinBox(Guarded, QDoubleSpinBox):
    """A number between two limits, typed or stepped; the arrows stay between them.

    Attributes
    ----------
    least, most
        The limits.
    """

    def __init__(self, name: str, label: str, tip: str, limits: tuple[float, float]) -> None:
        super().__init__()
        self.least, self.most = limits
        self.setRange(-_FAR, _FAR)
        _dress(self, name, label, tip)

    @property
    def problem(self) -> str:
        """Why the number that stands here is not possible; empty where it is."""
        return _problem(self, self.least, self.value(), self.most)

    def stepBy(self, steps: int) -> None:  # noqa: N802
        super().stepBy(steps)
        self.setValue(min(max(self.value(), self.least), self.most))


def _dress(box: QAbstractSpinBox, name: str, label: str, tip: str) -> None:
    box.setObjectName(name)
    box.setAccessibleName(label)
    box.setToolTip(tip)


def _problem(box: QAbstractSpinBox, least: float, value: float, most: float) -> str:
    if least <= value <= most:
        return ""
    return f"{box.accessibleName()}: from {least:g} to {most:g}."
