"""Tree of the groups and shapes of a drawing, with a check box for each."""

from __future__ import annotations

from collections import defaultdict

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTreeWidget, QTreeWidgetItem

from ...document.model import Curve, Document
from ...document.shapes import counted_shapes, shapes
from ...document.words import count_of
from ...widgets.controls import named

_DEEPEST = 6
"""Levels that are shown; what lies deeper is taken or left with the group around it."""

_OPEN = 2
"""Levels that are unfolded at first."""

_MOST_NAMED = 500
"""Shapes beyond which only groups are shown."""

_HEIGHT = 220

_Chain = tuple[str | int, ...]
"""Names of groups, the outermost first; at the end, perhaps, the number of a shape."""


class GroupTree(QTreeWidget):
    """The groups of a drawing, and the shapes in them; to check a group is to check all in it.

    Signals
    -------
    chosen
        Other curves are taken now.
    """

    chosen = Signal()

    def __init__(self, document: Document) -> None:
        super().__init__()
        tip = "Take a shape or all of a group, or leave it out (Space)"
        named(self, "importGroups", "Groups and shapes of the drawing", tip)
        self.setColumnCount(2)
        self.setHeaderLabels(["Group or shape", "Holds"])
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setMinimumHeight(_HEIGHT)
        self._document = document
        self._items: dict[_Chain, QTreeWidgetItem] = {}
        self._leaves = self._fill()
        self.expandToDepth(_OPEN - 1)
        header = self.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        # Told of a box that is checked, and of what follows it up and down the tree.
        self.itemChanged.connect(lambda _item, _column: self.chosen.emit())

    def _fill(self) -> list[QTreeWidgetItem]:
        """Make the items; return for each curve the one that it hangs on."""
        curves, leaves = self._document.curves, list[QTreeWidgetItem]()
        groups = [curve.groups[:_DEEPEST] for curve in curves]
        found = list(shapes(self._document.curves))
        held = defaultdict[_Chain, list[Curve]](list)
        for curve, chain in zip(curves, groups, strict=True):
            for depth in range(1, len(chain) + 1):
                held[chain[:depth]].append(curve)
        # What stands in a group beside groups can be taken without them.
        inner = {chain[:depth] for chain in groups for depth in range(len(chain))}
        for number, places in enumerate(found):
            first = curves[places.start]
            chain = groups[places.start]
            for depth in range(1, len(chain) + 1):
                group = chain[:depth]
                if group not in self._items:
                    self._item(group, group[-1], counted_shapes(held[group]))
            if len(found) <= _MOST_NAMED:
                points = count_of(sum(len(curves[place].points) for place in places), "point")
                leaf = self._item((*chain, number), first.shape or first.name, points)
            elif not chain or chain in inner:
                leaf = self._item((*chain, -1), "in no group of its own", "")
            else:
                leaf = self._items[chain]
            leaves += [leaf] * len(places)
        return leaves

    def _item(self, chain: _Chain, name: str, holds: str) -> QTreeWidgetItem:
        """Return the item of a group or shape, made and hung up where it is new."""
        if chain not in self._items:
            item = QTreeWidgetItem([name, holds])
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsAutoTristate)
            item.setCheckState(0, Qt.CheckState.Checked)
            self._items[chain] = item
            if len(chain) == 1:
                self.addTopLevelItem(item)
            else:
                self._items[chain[:-1]].addChild(item)
        return self._items[chain]

    @property
    def taken(self) -> list[bool]:
        """Whether each curve is taken."""
        return [leaf.checkState(0) == Qt.CheckState.Checked for leaf in self._leaves]
