"""Dashes: usual ones in a box, a list of one's own beside it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QWidget

from ...document.expression import ExpressionError
from ...document.style import LARGEST_DASHES
from ...document.words import number
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box
from ...widgets.fields import NumberEdit, read_number
from ...widgets.number_text import decimal_mark, typed_text
from .percent_field import MIXED

_PRESETS: dict[str, tuple[float, ...]] = {
    "Solid": (),
    "Dots": (0.0, 2.0),
    "Short": (2.0, 2.0),
    "Dashes": (4.0, 2.0),
    "Long": (8.0, 3.0),
    "Dash-dot": (5.0, 2.5, 0.0, 2.5),
}
"""Dashes and gaps in multiples of the width; one of length 0 is a dot where line ends are round."""

_OWN = "Own"
_LEAST = 48


class DashField(QWidget):
    """Shows dashes and asks for others.

    Signals
    -------
    chosen
        Others were chosen, or typed: a tuple of numbers.
    dots_chosen
        Others with dots were chosen by their name: dashes of length 0, which need ends that are round.

    Attributes
    ----------
    edit
        The field.
    """

    chosen = Signal(object)
    dots_chosen = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        tip = "Dashes and gaps, in multiples of the width"
        self._box = choice_box("dashBox", "Dashes", tip, (*_PRESETS, _OWN))
        self._box.setMinimumContentsLength(6)
        self._box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        tip = "Lengths of dashes and gaps in turn, in multiples of the width, such as 4 2 (Enter to set)"
        self.edit = NumberEdit("dashList", "List of dashes", tip, _read)
        self._value: object = ()
        self.edit.setMinimumWidth(_LEAST)
        row_of((self._box, 1), (self.edit, 1), margins=0, spacing=6, parent=self)
        self._box.activated.connect(self._choose)
        self.edit.entered.connect(self.chosen)

    def render_value(self, value: object) -> None:
        """Show dashes; anything but a tuple for several."""
        self._value = value
        if not isinstance(value, tuple):
            self._box.setCurrentIndex(-1)
            self.edit.show_text(MIXED)
            return
        names = [name for name, preset in _PRESETS.items() if preset == value]
        self._box.setCurrentText(names[0] if names else _OWN)
        short = " ".join(number(length, 6, decimal_mark()) for length in value)
        self.edit.show_text(" ".join(map(typed_text, value)), short)

    def _choose(self, row: int) -> None:
        presets = list(_PRESETS.values())
        if row < len(presets):
            dash = presets[row]
            (self.dots_chosen if 0.0 in dash else self.chosen).emit(dash)
        else:
            self.render_value(self._value)
            self.edit.setFocus()


def _read(text: str) -> Sequence[float]:
    lengths = tuple(read_number(word) for word in text.replace(";", " ").split())
    if len(lengths) > LARGEST_DASHES:
        raise ExpressionError(f"There may be {LARGEST_DASHES} dashes and gaps at most.")
    if any(length < 0 for length in lengths) or (lengths and not any(lengths)):
        raise ExpressionError("Dashes and gaps are 0 or longer, and not all of them 0.")
    return lengths
