"""List of the elements of a drawing that come in otherwise than they are drawn."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QSizePolicy, QTreeWidget, QTreeWidgetItem

from ...exchange.missed import Missed
from ...qt.labels import tip_of
from ...qt.overrides import Guarded
from ...widgets.controls import named

_MOST_IN_SIGHT = 6
_WIDEST = (220, 240)
"""Of the first two columns, in pixels."""


class MissedList(Guarded, QTreeWidget):
    """One row for each element: what it is, what stands in the way, what is done instead."""

    def __init__(self, missed: Sequence[Missed]) -> None:
        super().__init__()
        named(self, "importMissed", "What comes in otherwise", "Elements that come in otherwise than drawn")
        self.setHeaderLabels(["Element", "Why", "Instead"])
        self.setRootIsDecorated(False)
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        for each in missed:
            item = QTreeWidgetItem([f"{each.element} {each.called}", each.why, each.instead])
            for column in range(3):
                item.setToolTip(column, tip_of(each.sentence))
            self.addTopLevelItem(item)
        header = self.header()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        header.setStretchLastSection(True)
        for column, widest in enumerate(_WIDEST):
            self.resizeColumnToContents(column)
            self.setColumnWidth(column, min(self.columnWidth(column), widest))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)

    def sizeHint(self) -> QSize:
        rows = min(max(self.topLevelItemCount(), 1), _MOST_IN_SIGHT)
        height = self.header().sizeHint().height() + rows * self.sizeHintForRow(0) + 2 * self.frameWidth() + 2
        return QSize(super().sizeHint().width(), height)

    def minimumSizeHint(self) -> QSize:
        return QSize(super().minimumSizeHint().width(), self.sizeHint().height())
