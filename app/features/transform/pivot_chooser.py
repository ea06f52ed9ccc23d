"""Nine places of a box to choose from, as a little picture of it."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QButtonGroup, QGridLayout, QToolButton, QWidget

from ...qt.overrides import SafeOverrides
from ...view_model.boxes import NINE, name_of_place
from ...widgets.controls import named

_SIDE = 17


class PivotChooser(SafeOverrides, QWidget):
    """Nine buttons, of which the one where the pivot lies is down; none where it lies elsewhere.

    Tab leads to that one, and the arrows from there to the others.

    Signals
    -------
    chosen
        A place was chosen: −1, 0 or 1 for left, middle, right, and for bottom, middle, top.
    """

    chosen = Signal(int, int)

    def __init__(self) -> None:
        super().__init__()
        named(self, "pivotChooser", "Pivot")
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(3)
        self._group = QButtonGroup(self)
        self._buttons: dict[tuple[int, int], QToolButton] = {}
        for place, at in enumerate(NINE):
            words = name_of_place(*at)
            name = "pivot" + "".join(word.capitalize() for word in words.split())
            tip = f"Pivot: {words} of the box; X and Y are of it, and transforms are about it"
            button = named(QToolButton(), name, f"Pivot: {words}", tip)
            button.setCheckable(True)
            button.setFixedSize(_SIDE, _SIDE)
            button.clicked.connect(partial(self.chosen.emit, *at))
            grid.addWidget(button, *divmod(place, 3))
            self._group.addButton(button)
            self._buttons[at] = button

    def render_place(self, place: tuple[int, int] | None) -> None:
        """Show which place it is, None for none of them."""
        # A group of which one is to be down lets none be up.
        self._group.setExclusive(False)
        for at, button in self._buttons.items():
            button.setChecked(at == place)
            stops = at == (place or (0, 0))
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus if stops else Qt.FocusPolicy.NoFocus)
        self._group.setExclusive(True)
