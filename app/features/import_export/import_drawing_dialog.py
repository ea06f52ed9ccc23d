"""Import dialog for drawings and documents: their content as a picture and as groups to choose from."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QImage, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTreeWidget, QTreeWidgetItem, QWidget

from ...document.groups import shape_count_label, shape_ranges
from ...document.model import Curve, Document
from ...document.words import count_of, distance_text
from ...exchange.cubics_in import ImportResult
from ...exchange.drawing.image import png_preview
from ...exchange.drawing.styles import DARK, LIGHT
from ...exchange.errors import ExchangeError
from ...exchange.options import Options
from ...qt.labels import Label
from ...tasks.progress import Report
from ...tasks.task import SingleTask
from ...view_model.palette import contrast
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import named
from .work_dialog import A_NEW_DOCUMENT, ImportFoot, Verb, WorkDialog, into_box

_MOST_REMARKS = 12

_DEEPEST = 6
"""Levels that are shown; deeper groups are checked with the group around them."""

_OPEN = 2
"""Levels that are unfolded at first."""

_MOST_NAMED = 500
"""Shapes beyond which only groups are shown."""

_TREE_HEIGHT = 220

_Chain = tuple[str | int, ...]
"""Names of groups, the outermost first; at the end, perhaps, the number of a shape."""

_PICTURE_WIDTH, _PICTURE_HEIGHT = 280, 260


_TOO_PALE = 1.5
"""Contrast with light paper that somebody drew for dark."""


class ImportDrawingDialog(WorkDialog):
    """Dialog that shows an import result with its remarks, and asks where the curves go.

    Parameters
    ----------
    verb, name
        Verb of the dialog, and name of the file.
    rest
        Returns the sentence on content that is not added, for a new document or for this one.

    Signals
    -------
    import_requested
        Import was pressed: the `ImportResult`, and whether it becomes a new document.
    """

    import_requested = Signal(object, bool)

    def __init__(
        self,
        verb: Verb,
        name: str,
        result: ImportResult,
        rest: Callable[[bool], str],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__("importDrawingDialog", f"{verb.value} {name}", "importProblem", parent)
        self._result, self._rest = result, rest
        count = sum(1 for _ in shape_ranges(result.document.curves))
        self.groups = GroupTree(result.document) if count > 1 else None
        self.picture = ImportPicture(self.jobs)
        self.summary = Label(_summary(result, result), name="importSummary", wordWrap=True)
        self.remarks = Label(_remarks(result), name="importRemarks", wordWrap=True)
        self.remarks.setVisible(bool(result.remarks))
        self.rest = Label(name="importRest", wordWrap=True)
        # Without a curve there is nothing to add to another document.
        self.into = into_box(verb if result.has_curves else Verb.OPEN)
        self.into.setEnabled(result.has_curves)
        self.into.currentTextChanged.connect(self._show_rest)
        self._show_rest()
        self.foot = ImportFoot(self, "importDrawing", "Import the curves", verb, self.into)
        self.ok = self.foot.ok
        self.foot.box.accepted.connect(self._import)
        self._lay_out()
        if result.has_curves:
            self.picture.show_document(result.document)

    def _lay_out(self) -> None:
        side = column_of(self.summary, margins=0, spacing=8)
        if self.groups is None:
            side.addStretch(1)
        else:
            side.addWidget(self.groups, 1)
            self.groups.selection_changed.connect(self._show_included)
        above = row_of((self.picture, Qt.AlignmentFlag.AlignTop), (side, 1), margins=0, spacing=18)
        layout = column_of((above, 1), margins=(16, 14, 16, 0), spacing=10, parent=self.body)
        layout.addWidget(self.remarks)
        layout.addLayout(row_of("Into", self.into, 1))
        layout.addWidget(self.rest)
        self.hold(self.foot, preferred=QSize(660, 0))

    @property
    def _is_anew(self) -> bool:
        return self.into.currentText() == A_NEW_DOCUMENT

    def _show_rest(self) -> None:
        self.rest.show_text(self._rest(self._is_anew))

    def _included(self) -> list[bool]:
        return self.groups.included if self.groups is not None else [True] * len(self._result.document.curves)

    def _show_included(self) -> None:
        """Show the part of the drawing that is checked; without a curve there is nothing to import."""
        included = self._included()
        self.ok.setEnabled(any(included))
        some = self._result if all(included) or not any(included) else self._result.only(included)
        none = f"Select at least one of {shape_count_label(self._result.document.curves)}."
        self.summary.setText(_summary(self._result, some) if any(included) else none)
        if any(included):
            self.picture.show_document(some.document)
        else:
            self.picture.clear()

    def _import(self) -> None:
        # First, as a new document closes the dialogs of the previous one.
        self.accept()
        self.import_requested.emit(self._result.only(self._included()), self._is_anew)


def _summary(whole: ImportResult, part: ImportResult) -> str:
    """Return a sentence on the part of a drawing to import."""
    if not part.has_curves:
        return "No curves."
    points = sum(len(curve.points) for curve in part.document.curves)
    exact = distance_text(part.deviation, "the file")
    some = shape_count_label(part.document.curves)
    if part is not whole:
        some = f"{some.split()[0]} of {shape_count_label(whole.document.curves)}"
    return f"{some} with {count_of(points, 'point')}, {exact}."


def _remarks(result: ImportResult) -> str:
    lines = list(result.remarks[:_MOST_REMARKS])
    more = len(result.remarks) - len(lines)
    return "\n".join([*lines, *([f"… and {more} more."] if more else [])])


class GroupTree(QTreeWidget):
    """The groups of a drawing, and the shapes in them; checking a group checks all in it.

    Signals
    -------
    selection_changed
        Other curves are checked.
    """

    selection_changed = Signal()

    def __init__(self, document: Document) -> None:
        super().__init__()
        tip = "Select the shapes and groups to import (Space)"
        named(self, "importGroups", "Groups and shapes of the drawing", tip)
        self.setColumnCount(2)
        self.setHeaderLabels(["Group or shape", "Contains"])
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setMinimumHeight(_TREE_HEIGHT)
        self._document = document
        self._items: dict[_Chain, QTreeWidgetItem] = {}
        self._leaves = self._fill()
        self.expandToDepth(_OPEN - 1)
        header = self.header()
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        # Emitted for a checked box, and for every item above and below that follows it.
        self.itemChanged.connect(lambda _item, _column: self.selection_changed.emit())

    def _fill(self) -> list[QTreeWidgetItem]:
        """Create the items; return the item of each curve."""
        curves, leaves = self._document.curves, list[QTreeWidgetItem]()
        groups = [curve.groups[:_DEEPEST] for curve in curves]
        ranges = list(shape_ranges(self._document.curves))
        held = defaultdict[_Chain, list[Curve]](list)
        for curve, chain in zip(curves, groups, strict=True):
            for depth in range(1, len(chain) + 1):
                held[chain[:depth]].append(curve)
        # Shapes beside groups in a group can be imported without these.
        inner = {chain[:depth] for chain in groups for depth in range(len(chain))}
        for index, indices in enumerate(ranges):
            first = curves[indices.start]
            chain = groups[indices.start]
            for depth in range(1, len(chain) + 1):
                group = chain[:depth]
                if group not in self._items:
                    self._item(group, group[-1], shape_count_label(held[group]))
            if len(ranges) <= _MOST_NAMED:
                points = count_of(sum(len(curves[curve_index].points) for curve_index in indices), "point")
                leaf = self._item((*chain, index), first.shape or first.name, points)
            elif not chain or chain in inner:
                leaf = self._item((*chain, -1), "other shapes", "")
            else:
                leaf = self._items[chain]
            leaves += [leaf] * len(indices)
        return leaves

    def _item(self, chain: _Chain, name: str, holds: str) -> QTreeWidgetItem:
        """Return the item of a group or shape, created and inserted if needed."""
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
    def included(self) -> list[bool]:
        """Whether each curve is checked."""
        return [leaf.checkState(0) == Qt.CheckState.Checked for leaf in self._leaves]


class ImportPicture(QWidget):
    """Preview of the checked curves, in their styles.

    Attributes
    ----------
    picture
        Label with the picture.
    """

    def __init__(self, jobs: SingleTask) -> None:
        super().__init__()
        self._jobs = jobs
        self.picture = Label(name="importPicture", label="Preview")
        self.picture.setToolTip("Preview of the curves to import")
        self.picture.setFixedSize(_PICTURE_WIDTH, _PICTURE_HEIGHT)
        self.picture.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.picture.setWordWrap(True)
        column_of(self.picture, 1, margins=0, parent=self)

    def show_document(self, document: Document) -> None:
        """Draw a document in a thread of its own."""
        ratio = self.devicePixelRatioF()
        room = (round(_PICTURE_WIDTH * ratio), round(_PICTURE_HEIGHT * ratio))

        def draw(report: Report) -> QImage:
            style = DARK if _is_for_dark_paper(document) else LIGHT
            return png_preview(document, Options(style=style, report=report), room).image

        def show(image: QImage) -> None:
            image.setDevicePixelRatio(ratio)
            self.picture.setPixmap(QPixmap.fromImage(image))

        self._jobs.cancel()
        self._jobs.start("Drawing", draw, show, self._refuse)

    def clear(self) -> None:
        """Show nothing."""
        self._jobs.cancel()
        self.picture.clear()

    def _refuse(self, problem: Exception) -> None:
        if not isinstance(problem, ExchangeError):
            raise problem
        self.picture.setText(str(problem))


def _is_for_dark_paper(document: Document) -> bool:
    """Whether nothing of a document would be visible on light paper."""
    paints = {
        paint
        for curve in document.curves
        if curve.visible
        for paint in (curve.style.stroke, curve.style.fill)
        if paint != "none"
    }
    return bool(paints) and all(
        paint.startswith("#") and contrast(paint, LIGHT.paper or "#ffffff") < _TOO_PALE for paint in paints
    )
