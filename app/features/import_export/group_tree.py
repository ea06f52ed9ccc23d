"""Tree of the groups of a drawing, with a check box for each."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTreeWidget, QTreeWidgetItem

from ...document.words import count_of
from ...widgets.controls import named

_DEEPEST = 6
"""Levels that are shown; what lies deeper is taken or left with the group around it."""

_OPEN = 2
"""Levels that are unfolded at first."""

_HEIGHT = 220


class GroupTree(QTreeWidget):
    """The groups of a drawing with how many curves they hold; to check one is to check all in it.

    Signals
    -------
    chosen
        Other curves are taken now.
    """

    chosen = Signal()

    def __init__(self, groups: Sequence[tuple[str, ...]]) -> None:
        super().__init__()
        tip = "Take the curves of a group, or leave them out (Space)"
        named(self, "importGroups", "Groups of the drawing", tip)
        self.setColumnCount(2)
        self.setHeaderLabels(["Group", "Holds"])
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setMinimumHeight(_HEIGHT)
        self._leaves = self._fill([chain[:_DEEPEST] for chain in groups])
        self.expandToDepth(_OPEN - 1)
        header = self.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        # Told of a box that is checked, and of what follows it up and down the tree.
        self.itemChanged.connect(lambda _item, _column: self.chosen.emit())

    def _fill(self, chains: list[tuple[str, ...]]) -> list[QTreeWidgetItem]:
        """Make the items; return for each curve the one that it hangs on."""
        items: dict[tuple[str, ...], QTreeWidgetItem] = {}
        counts: dict[tuple[str, ...], int] = {}
        # What stands in a group beside groups can be taken without them.
        inner = {chain[:depth] for chain in chains for depth in range(len(chain))}
        leaves = [(*chain, "") if chain in inner else chain for chain in chains]
        for leaf in leaves:
            for depth in range(1, len(leaf) + 1):
                counts[leaf[:depth]] = counts.get(leaf[:depth], 0) + 1
        for chain, count in counts.items():
            item = QTreeWidgetItem([chain[-1] or "in no group of its own", count_of(count, "curve")])
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsAutoTristate)
            item.setCheckState(0, Qt.CheckState.Checked)
            items[chain] = item
            if len(chain) == 1:
                self.addTopLevelItem(item)
            else:
                items[chain[:-1]].addChild(item)
        return [items[leaf] for leaf in leaves]

    @property
    def taken(self) -> list[bool]:
        """Whether each curve is taken."""
        return [leaf.checkState(0) == Qt.CheckState.Checked for leaf in self._leaves]
