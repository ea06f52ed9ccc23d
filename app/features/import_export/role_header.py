"""The head of a table with a box above every column that says what the column is."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QPainter
from PySide6.QtWidgets import QComboBox, QHeaderView, QTableView

from ...qt.overrides import Guarded
from ...widgets.controls import choice_box

_GAP = 4


class RoleHeader(Guarded, QHeaderView):
    """A horizontal head with titles, and a box above each.

    Signals
    -------
    chosen
        The person gave a column another role.
    """

    chosen = Signal()

    def __init__(self, roles: Sequence[str], parent: QTableView) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._roles = tuple(roles)
        self.boxes: list[QComboBox] = []
        self.setMinimumSectionSize(112)
        self.setDefaultSectionSize(118)
        self.sectionResized.connect(self._place)
        self.sectionCountChanged.connect(self._place)
        parent.horizontalScrollBar().valueChanged.connect(self._place)

    def show_roles(self, roles: Sequence[str]) -> None:
        """Show these roles, one for each column."""
        while len(self.boxes) > len(roles):
            self.boxes.pop().deleteLater()
        while len(self.boxes) < len(roles):
            self.boxes.append(self._box(len(self.boxes)))
        for box, role in zip(self.boxes, roles, strict=True):
            box.setCurrentIndex(self._roles.index(role))
        self._place()

    @property
    def roles(self) -> tuple[str, ...]:
        """The role of each column."""
        return tuple(self._roles[box.currentIndex()] for box in self.boxes)

    def _box(self, column: int) -> QComboBox:
        tip = "What this column is; each but “ignore” at most once"
        box = choice_box(f"columnRole{column}", f"What column {column + 1} is", tip, self._roles)
        box.setParent(self)
        box.activated.connect(lambda _index, box=box: self._choose(box))
        box.show()
        return box

    def _choose(self, box: QComboBox) -> None:
        """Take the role away from the column that had it: two cannot have the same."""
        for other in self.boxes:
            if other is not box and other.currentIndex() == box.currentIndex() != 0:
                other.setCurrentIndex(0)
        self.chosen.emit()

    def _place(self) -> None:
        height = self._box_height()
        for column, box in enumerate(self.boxes):
            left = self.sectionViewportPosition(column)
            box.setGeometry(left + 2, 2, max(self.sectionSize(column) - _GAP, 20), height)

    def _box_height(self) -> int:
        return self.boxes[0].sizeHint().height() if self.boxes else 0

    def sizeHint(self) -> QSize:
        hint = super().sizeHint()
        return QSize(hint.width(), hint.height() + self._box_height() + _GAP)

    def paintSection(  # noqa: N802
        self,
        painter: QPainter,
        rect: QRect,
        logicalIndex: int,  # noqa: N803
    ) -> None:
        """Paint the title of a column."""
        # The title has what the box leaves.
        super().paintSection(painter, rect.adjusted(0, self._box_height() + _GAP, 0, 0), logicalIndex)
