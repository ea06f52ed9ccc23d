"""Import dialog for tables: the roles of columns, problems, the curves that come of the rows."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import isfinite

from PySide6.QtCore import QRect, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QPainter
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHeaderView,
    QTableView,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from ...appearance.theme import mix, theme_of
from ...document.expression import ExpressionError, parse_number
from ...document.words import count_of, distance_text, number
from ...exchange.table.columns import AFTER, ROLES, WORDS, ColumnMapping, mapping_summary
from ...exchange.table.curves import MissingRows
from ...exchange.table.source import (
    MANY_ROWS,
    MOST_POINTS,
    PreparedTable,
    TableChoice,
    TableSource,
    prepare_table,
)
from ...exchange.table.table import Preview, TextLayout
from ...exchange.table.thinning import Thinning
from ...families import FAMILIES, HERMITE
from ...qt.labels import INK, WARNING, Label, tip_of
from ...qt.overrides import SafeOverrides
from ...tasks.task import DelayedCall
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import ThinProgress, check_box, choice_box, named
from ...widgets.fields import FieldEdit
from ...widgets.number_text import decimal_mark
from .work_dialog import A_NEW_DOCUMENT, ImportFoot, Verb, WorkDialog, into_box

IGNORE = "ignore"
_SEPARATORS = {"\t": "Tab", ";": "Semicolon ;", ",": "Comma ,", " ": "Spaces"}
_THINNINGS = (None, *Thinning)
_THINNING_TIP = (
    "Fit a curve: as few points as a smooth curve within the distance of every row needs. "
    "Keep corners: the vertices of a polyline within the distance (Douglas–Peucker)"
)
_SOON_MS = 250


class ImportTableDialog(WorkDialog):
    """Dialog that shows the first rows of a table and asks for the roles of its columns.

    Parameters
    ----------
    verb, name, stem
        Verb of the dialog, and name of the file with and without its ending.

    Signals
    -------
    import_requested
        Import was pressed: the `PreparedTable`, and whether it becomes a new document.
    """

    import_requested = Signal(object, bool)

    def __init__(
        self,
        verb: Verb,
        name: str,
        stem: str,
        source: TableSource,
        preview: Preview,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__("importTableDialog", f"{verb.value} {name}", "tableProblem", parent)
        self._verb = verb
        self._source, self._stem, self._layout_now = source, stem, preview.layout
        self._preview = preview
        self._prepared: PreparedTable | None = None
        self._tolerance: float | None = None
        # The distance that is being typed is used when typing stops; it may still be changed.
        self._soon = DelayedCall(self, _SOON_MS, lambda: self._take_distance(self.tolerance_edit.text()))
        self._build_reading()
        self._build_curves()
        self._build_foot()
        self._lay_out()
        self._connect()
        if source.lines > MANY_ROWS:
            self.thinning_box.setCurrentIndex(_THINNINGS.index(Thinning.CURVE))
        self._show_preview(preview)
        self._prepare()

    # Building

    def _build_reading(self) -> None:
        """Build the widgets for the layout of the cells."""
        self.separator_box = choice_box(
            "tableSeparator", "Separator", "Character between two cells", _SEPARATORS.values()
        )
        self.comma_check = check_box("tableComma", "Decimal comma", "Read numbers such as 0,5")
        self.header_check = check_box("tableHeader", "First row has titles", "Read the first row as titles")
        self.preview = TablePreview((IGNORE, *ROLES, *AFTER, *WORDS))
        self.remark = Label(name="tableSaid", wordWrap=True)

    def _build_curves(self) -> None:
        """Build the widgets for the curves through the rows."""
        self.family_box = choice_box(
            "tableFamily",
            "Family",
            "Family of the curve through the rows",
            (family.label for family in FAMILIES),
        )
        self.family_box.setCurrentIndex(FAMILIES.index(HERMITE))
        titles = ["Keep every row", *(thinning.label for thinning in Thinning)]
        self.thinning_box = choice_box("tableThinning", "Rows", _THINNING_TIP, titles)
        self.tolerance_edit = FieldEdit(
            "tableTolerance", "Distance", "Largest distance from every row, in the unit of the table (Enter)"
        )
        self.tolerance_edit.setMaximumWidth(110)
        self.into = into_box(self._verb)

    def _build_foot(self) -> None:
        """Build the widgets for problems and the summary."""
        # Its room stays, so that nothing jumps when a problem appears or goes.
        self.problem.setMinimumHeight(2 * self.problem.fontMetrics().lineSpacing())
        self.problem.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        self.problem.show()
        self.missing_box = choice_box(
            "tableMissing",
            "Rows without numbers",
            "How to treat rows without numbers",
            (rule.label for rule in MissingRows),
        )
        label = Label("Rows without numbers", name="tableMissingLabel")
        label.setBuddy(self.missing_box)
        self._missing = QWidget()
        row_of(label, self.missing_box, 1, margins=0, spacing=8, parent=self._missing)
        self._missing.hide()
        self.summary = Label(name="tableSummary")
        self.bar = ThinProgress("tableProgress", "Progress of reading")
        self.foot = ImportFoot(self, "importTable", "Create curves from the rows", self._verb, self.into)
        self.ok = self.foot.ok

    def _lay_out(self) -> None:
        reading = ("Separator", self.separator_box, self.comma_check, self.header_check, 1)
        curves = ("Rows", self.thinning_box, self.tolerance_edit, "Family", self.family_box)
        column_of(
            row_of(*reading, spacing=8),
            (self.preview, 1),
            self.remark,
            row_of(*curves, "Into", self.into, 1, spacing=8),
            self.problem,
            self._missing,
            margins=(16, 14, 16, 0),
            spacing=10,
            parent=self.body,
        )
        foot = QWidget()
        row_of(self.summary, self.bar, 1, self.foot, margins=0, spacing=8, parent=foot)
        self.hold(foot, preferred=QSize(760, 560))

    def _connect(self) -> None:
        self.separator_box.activated.connect(
            lambda row: self._choose_layout(replace(self._layout_now, separator=list(_SEPARATORS)[row]))
        )
        self.comma_check.clicked.connect(
            lambda is_on: self._choose_layout(replace(self._layout_now, decimal_comma=is_on))
        )
        self.header_check.clicked.connect(
            lambda is_on: self._choose_layout(replace(self._layout_now, header=is_on))
        )
        self.preview.head.role_changed.connect(self._prepare)
        self.family_box.activated.connect(self._prepare)
        self.missing_box.activated.connect(self._prepare)
        self.thinning_box.activated.connect(self._choose_thinning)
        self.tolerance_edit.committed.connect(self._type_tolerance)
        self.tolerance_edit.textEdited.connect(self._type_soon)
        self.foot.box.accepted.connect(self._import)
        self.jobs.progressed.connect(self._show_share)
        self.jobs.shown.connect(lambda _title: self.bar.show())
        self.jobs.ended.connect(self.bar.hide)
        self.bar.hide()

    # User input

    def _choose_layout(self, layout: TextLayout) -> None:
        comma = layout.decimal_comma and layout.separator != ","
        self._layout_now = replace(layout, decimal_comma=comma, units=layout.units and layout.header)
        self._show_preview(self._source.preview(self._layout_now))
        self._prepare()

    def _choose_thinning(self) -> None:
        self._tolerance = None
        self._prepare()

    def _type_soon(self) -> None:
        # Half a number is not used; the result is computed soon after typing stops.
        self.jobs.cancel()
        self._prepared = None
        self.ok.setEnabled(False)
        self._soon.start()

    def _type_tolerance(self, text: str) -> None:
        if not self._take_distance(text):
            self.tolerance_edit.keep()

    def _take_distance(self, text: str) -> bool:
        """Compute with a typed distance, or show its problem; return whether it is valid."""
        try:
            self._tolerance = _distance(text)
        except ExpressionError as reason:
            self._show(PreparedTable(problem=str(reason)))
            return False
        self._prepare()
        return True

    def _mapping(self) -> ColumnMapping | None:
        roles = {role: column for column, role in enumerate(self.preview.head.roles) if role != IGNORE}
        return ColumnMapping(**roles) if {"x", "y"} <= set(roles) else None

    def _import(self) -> None:
        if self._prepared is not None and self._prepared.document is not None and not self.jobs.is_busy:
            prepared = self._prepared
            # First, as a new document closes the dialogs of the previous one.
            self.accept()
            self.import_requested.emit(prepared, self.into.currentText() == A_NEW_DOCUMENT)

    # Result

    def _prepare(self) -> None:
        """Compute the curves of the table under the present choices."""
        self._soon.stop()
        self.jobs.cancel()
        self._prepared = None
        self.ok.setEnabled(False)
        thinning = _THINNINGS[self.thinning_box.currentIndex()]
        self.tolerance_edit.setEnabled(thinning is not None)
        self.family_box.setEnabled(thinning is None)
        self.family_box.setToolTip(
            "Family of the curve through the rows"
            if thinning is None
            else "Thinned rows become a Hermite curve"
        )
        mapping = self._mapping()
        self._say_columns(mapping)
        if mapping is None:
            self._show(PreparedTable(problem="Choose the columns of x and y above the table."))
            return
        family = FAMILIES[self.family_box.currentIndex()]
        missing = list(MissingRows)[self.missing_box.currentIndex()]
        choice = TableChoice(
            self._layout_now, mapping, family, thinning, self._tolerance, self._stem, missing
        )
        self.summary.setText("Reading…")
        self.bar.setValue(0)
        source = self._source
        self.jobs.start("Reading", partial(prepare_table, source, choice), self._show, self._show_failure)

    def _say_columns(self, mapping: ColumnMapping | None) -> None:
        """Show the roles of the columns, and whether they are a guess."""
        preview = self._preview
        is_guess = mapping is not None and mapping == preview.mapping and not preview.guess.is_certain
        words = mapping_summary(mapping, preview.titles) if mapping is not None else ""
        doubt = "This is a guess; check the roles above the columns." if is_guess else ""
        self.remark.setText(" ".join(filter(None, (preview.remark, words, doubt))))

    def _show_preview(self, preview: Preview) -> None:
        self.separator_box.setCurrentIndex(list(_SEPARATORS).index(preview.layout.separator))
        self.comma_check.setChecked(preview.layout.decimal_comma)
        self.header_check.setChecked(preview.layout.header)
        is_comma = preview.layout.separator == ","
        for choice in (self.separator_box, self.comma_check, self.header_check):
            choice.setEnabled(preview.is_text and (choice is not self.comma_check or not is_comma))
        self._preview = preview
        columns = preview.mapping.columns((*ROLES, *AFTER, *WORDS)) if preview.mapping else {}
        roles = [IGNORE] * len(preview.titles)
        for role, column in columns.items():
            roles[column] = role
        self.preview.show_table(preview.titles, preview.cells, preview.numbers, roles)
        # The boxes are created late; by default the Tab key would reach them last.
        chain = [self.header_check, *self.preview.head.boxes, self.preview, self.thinning_box]
        for before, after in pairwise(chain):
            self.setTabOrder(before, after)

    def _show(self, prepared: PreparedTable) -> None:
        self._prepared = prepared
        if prepared.tolerance:
            self._tolerance = prepared.tolerance
            self.tolerance_edit.show_text(_number_text(prepared.tolerance).replace("−", "-"))
        self.show_problem(prepared.problem)
        self._explain(prepared)
        self._missing.setVisible(prepared.lacks_numbers or self.missing_box.currentIndex() > 0)
        self.preview.mark(prepared.bad_row, prepared.bad_column, prepared.bad_cells)
        self.summary.setText(_summary(prepared))
        self.ok.setEnabled(prepared.document is not None)
        self.ok.setToolTip(tip_of(prepared.problem) or "Create curves from the rows")

    def _show_failure(self, problem: Exception) -> None:
        self.show_problem(str(problem))
        raise problem

    def show_problem(self, text: str) -> None:
        """Show a problem; its room stays without one."""
        self.problem.setForegroundRole(WARNING)
        self.problem.setText(f"⚠ {text}" if text else "")

    def _explain(self, prepared: PreparedTable) -> None:
        """Show the remarks on the curves."""
        lines = list(prepared.remarks)
        if prepared.wider_than:
            lines.append(
                f"The distance was increased to {_number_text(prepared.tolerance)}: "
                f"{_number_text(prepared.wider_than)} would leave more than {MOST_POINTS:,} points."
            )
        if lines:
            self.problem.setForegroundRole(INK)
            self.problem.setText("\n".join(lines))

    def _show_share(self, share: float, word: str) -> None:
        self.summary.setText(f"{word}…")
        self.bar.show_share(share)


def _distance(text: str) -> float | None:
    """Return a typed distance; None for no text, which means automatic."""
    if not text.strip():
        return None
    value = parse_number(text, decimal_mark())
    if not value > 0:
        raise ExpressionError("The distance must be greater than 0.")
    return value


def _number_text(distance: float) -> str:
    return number(distance, 6, decimal_mark())


def _summary(prepared: PreparedTable) -> str:
    if prepared.document is None:
        return f"{prepared.rows:,} rows" if prepared.rows else ""
    count = len(prepared.document.curves)
    result = f"{prepared.rows:,} rows → {count_of(prepared.points, 'point')}"
    result += f" in {count} curves" if count > 1 else ""
    if prepared.tolerance:
        result += f", {distance_text(prepared.deviation, 'the rows')}"
    return result


# The first rows


_FITTING = 12
"""Characters that a cell has room for, as many as a number with six digits and a power of ten."""

_NUMBER = re.compile(r"[+-]?\d+((?P<mark>[.,])\d+)?(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)

_GAP = 4


class TablePreview(QTableWidget):
    """Read-only cells of a table, with a box above every column for its role."""

    def __init__(self, roles: Sequence[str]) -> None:
        super().__init__()
        tip = "First rows of the file; long numbers are rounded to six digits"
        named(self, "tablePreview", "First rows of the table", tip)
        # The end of a long text matters as much as its beginning.
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        # Tab moves to the next widget, the arrow keys between the cells.
        self.setTabKeyNavigation(False)
        self.head = RoleHeader(roles, self)
        self.setHorizontalHeader(self.head)
        self.setCornerButtonEnabled(False)
        self.verticalHeader().setDefaultSectionSize(24)
        self._numbers: Sequence[int] = ()

    def show_table(
        self,
        titles: Sequence[str],
        cells: Sequence[Sequence[str]],
        numbers: Sequence[int],
        roles: Sequence[str],
    ) -> None:
        """Show rows with their numbers in the file under their titles, with a role for each column."""
        self._numbers = numbers
        self.setColumnCount(len(titles))
        self.setRowCount(len(cells))
        self.setHorizontalHeaderLabels(list(titles))
        self.setVerticalHeaderLabels([str(number) for number in numbers])
        for row, line in enumerate(cells):
            self._fill(row, line)
        self.head.show_roles(roles)

    def _fill(self, row: int, cells: Sequence[str]) -> None:
        for column in range(self.columnCount()):
            self.setItem(row, column, _item(cells[column] if column < len(cells) else ""))

    def mark(self, number: int, column: int, cells: Sequence[str]) -> None:
        """Mark the cell of a problem: its column, from 1, or 0 for the whole row; number 0 for no row.

        A row beyond the first ones is shown below them.
        """
        self.setRowCount(len(self._numbers))
        for row in range(self.rowCount()):
            self._colour(row, 0, QBrush())
        if not number:
            return
        if number in self._numbers:
            row = self._numbers.index(number)
        else:
            row = len(self._numbers)
            self.setRowCount(row + 1)
            self.setVerticalHeaderItem(row, QTableWidgetItem(str(number)))
            self._fill(row, cells)
        theme = theme_of(self.palette())
        self._colour(row, column, QBrush(mix(theme.warning, QColor(theme.paper), 0.25)))
        self.scrollTo(self.model().index(row, max(column - 1, 0)))

    def _colour(self, row: int, column: int, brush: QBrush) -> None:
        """Fill a cell, its column counted from 1, or the whole row for column 0."""
        columns = [column - 1] if 0 < column <= self.columnCount() else range(self.columnCount())
        for index in columns:
            item = self.item(row, index)
            if item is not None:
                item.setBackground(brush)


def _item(text: str) -> QTableWidgetItem:
    short = _shortened(text)
    item = QTableWidgetItem(short)
    if short != text or len(text) > _FITTING:
        item.setToolTip(tip_of(text))
    item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    return item


def _shortened(text: str) -> str:
    """Return a long number with six digits, so that its power of ten is not cut off; all else as it is."""
    match = _NUMBER.fullmatch(text.strip()) if len(text) > _FITTING else None
    if match is None:
        return text
    mark = match["mark"] or "."
    value = float(text.replace(mark, "."))
    return f"{value:.6g}".replace(".", mark) if isfinite(value) else text


class RoleHeader(SafeOverrides, QHeaderView):
    """A horizontal header with titles, and a box above each.

    Signals
    -------
    role_changed
        The user gave a column another role.
    """

    role_changed = Signal()

    def __init__(self, roles: Sequence[str], parent: QTableView) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._roles = tuple(roles)
        self.boxes: list[QComboBox] = []
        self.setMinimumSectionSize(112)
        self.setDefaultSectionSize(118)
        self.sectionResized.connect(self._place_boxes)
        self.sectionCountChanged.connect(self._place_boxes)
        parent.horizontalScrollBar().valueChanged.connect(self._place_boxes)

    def show_roles(self, roles: Sequence[str]) -> None:
        """Show these roles, one for each column."""
        while len(self.boxes) > len(roles):
            self.boxes.pop().deleteLater()
        while len(self.boxes) < len(roles):
            self.boxes.append(self._box(len(self.boxes)))
        for box, role in zip(self.boxes, roles, strict=True):
            box.setCurrentIndex(self._roles.index(role))
        self._place_boxes()

    @property
    def roles(self) -> tuple[str, ...]:
        """The role of each column."""
        return tuple(self._roles[box.currentIndex()] for box in self.boxes)

    def _box(self, column: int) -> QComboBox:
        tip = "Role of this column; each role except “ignore” can be used once"
        box = choice_box(f"columnRole{column}", f"Role of column {column + 1}", tip, self._roles)
        box.setParent(self)
        box.activated.connect(lambda _index, box=box: self._choose(box))
        box.show()
        return box

    def _choose(self, box: QComboBox) -> None:
        """Remove the role from the column that had it: two cannot have the same."""
        for other in self.boxes:
            if other is not box and other.currentIndex() == box.currentIndex() != 0:
                other.setCurrentIndex(0)
        self.role_changed.emit()

    def _place_boxes(self) -> None:
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
        # The title is painted below the box.
        super().paintSection(painter, rect.adjusted(0, self._box_height() + _GAP, 0, 0), logicalIndex)
