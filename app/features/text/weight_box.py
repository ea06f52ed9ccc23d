"""The weights that a font has, to choose one of; hidden where it has regular and bold letters alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox

from ...qt.glyphs import weights_of
from ...widgets.controls import named

_NAMES: Final = {
    100: "Thin",
    200: "Extra Light",
    300: "Light",
    400: "Regular",
    500: "Medium",
    600: "Semibold",
    700: "Bold",
    800: "Extra Bold",
    900: "Black",
}


class WeightBox(QComboBox):
    """A list of weights by their names.

    Signals
    -------
    picked
        One is chosen: 400 for regular letters.
    """

    picked = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        named(self, "textWeight", "Weight", "Weight of the letters: those that are chosen, else all")
        self._weights: Sequence[int] = ()
        self.activated.connect(lambda at: self.picked.emit(float(self._weights[at])))
        self.hide()

    def show_weight(self, family: str, weight: float) -> None:
        """Show a weight of a family, the nearest that it has."""
        weights = weights_of(family)
        if weights != self._weights:
            self._weights = weights
            self.clear()
            self.addItems([_NAMES[each] for each in weights])
        nearest = min(weights, key=lambda each: abs(each - weight), default=None)
        self.setCurrentIndex(-1 if nearest is None else weights.index(nearest))
        self.setVisible(not {*weights} <= {400, 700})
