"""The options of an export; of each format those that concern it."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFormLayout, QGridLayout, QWidget

from app.document.expression import ExpressionError, parse_number
from app.exchange.choice import (
    DESCRIPTIONS,
    FORMATS,
    PICTURES,
    SAMPLED,
    TO_SCALE,
    WITH_TOLERANCE,
    ExportChoice,
)
from app.exchange.formats import Spacing
from app.exchange.sampled import MOST_SAMPLES, TITLES
from app.exchange.units import known_unit
from app.labels import Label
from app.panels.field_edit import FieldEdit
from app.panels.form_parts import choice_box
from app.panels.number_text import decimal_mark, exact_text
from app.panels.told_spin import ToldSpinBox

_SCALES = {1.0: "× 1 (96 dpi)", 2.0: "× 2 (192 dpi)", 3.0: "× 3 (288 dpi)", 4.0: "× 4 (384 dpi)"}
_COLOURS = ("Light", "Dark")
_SPACINGS = {
    Spacing.T: "equal steps of t",
    Spacing.LENGTH: "equal arc lengths",
    Spacing.TOLERANCE: "as the tolerance takes",
}
_SHOWN = {
    "points": ("Points", "Draw the points"),
    "handles": ("Handles", "Draw the Bézier control points beside the points"),
    "grid": ("Grid", "Draw a grid behind the curves"),
    "basis": ("Basis functions", "Draw the basis functions of the curve that is edited below the picture"),
}
_AUTOMATIC = "automatic"


class ExportForm(QWidget):
    """Boxes and fields for an `ExportChoice`.

    Signals
    -------
    changed
        The person chose something else.
    """

    changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("exportForm")
        self._shown = ExportChoice()
        self.format_box = choice_box(
            "exportFormat", "Format", "What kind of file to write", list(FORMATS.values())
        )
        self._description = Label()
        self._description.setObjectName("exportDescription")
        self._description.setWordWrap(True)
        self.width_box = _spin(
            "exportWidth", "Width", "Width in pixels before the scale; the height follows", (1, 16384)
        )
        self.width_box.setSuffix(" px")
        self.scale_box = choice_box(
            "exportScale", "Scale", "How sharp: pixels for each", list(_SCALES.values())
        )
        self.true_size = _check("exportTrueSize", "True size", "")
        self.colour_box = choice_box("exportColours", "Colours", "Light or dark paper", _COLOURS)
        self.transparent = _check("exportTransparent", "Transparent", "Leave the paper out")
        self.shown = {name: _check(f"export_{name}", *words) for name, words in _SHOWN.items()}
        self.tolerance_edit = FieldEdit(
            "exportTolerance", "Tolerance", "Largest distance from the true curves, or “automatic”"
        )
        self.cubic = _check(
            "exportCubic",
            "No spline above degree 3",
            "Cubic pieces within the tolerance: LibreCAD, for one, draws no spline of higher degree",
        )
        self.spacing_box = choice_box(
            "exportSpacing", "Samples", "How the rows are spread along each curve", list(_SPACINGS.values())
        )
        self.samples_box = _spin(
            "exportSamples", "Number of samples", "Rows for each curve", (2, MOST_SAMPLES)
        )
        self.columns = {
            title: _check(f"exportColumn_{title}", title, f"Write the column {title}") for title in TITLES
        }
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        self._form = form = QFormLayout(self)
        form.setContentsMargins(0, 0, 0, 0)
        form.setHorizontalSpacing(14)
        form.setVerticalSpacing(8)
        form.addRow("Format", self.format_box)
        form.addRow("", self._description)
        form.addRow("Width", self.width_box)
        form.addRow("Scale", self.scale_box)
        form.addRow("Size", self.true_size)
        form.addRow("Colours", self.colour_box)
        form.addRow("", self.transparent)
        self._show_grid = _in_columns(list(self.shown.values()), 2)
        form.addRow("Show", self._show_grid)
        form.addRow("Tolerance", self.tolerance_edit)
        form.addRow("", self.cubic)
        form.addRow("Samples", self.spacing_box)
        form.addRow("Rows", self.samples_box)
        self._column_grid = _in_columns(list(self.columns.values()), 3)
        form.addRow("Columns", self._column_grid)

    def _connect(self) -> None:
        for box in (self.format_box, self.scale_box, self.colour_box, self.spacing_box):
            box.activated.connect(self._change)
        for spin in (self.width_box, self.samples_box):
            # Numbers have no signal of the person's alone; what the program sets is the same as before.
            spin.valueChanged.connect(self._change)
        for check in (
            self.transparent,
            self.true_size,
            self.cubic,
            *self.shown.values(),
            *self.columns.values(),
        ):
            check.clicked.connect(self._change)
        self.tolerance_edit.committed.connect(self._type_tolerance)

    def show_choice(self, choice: ExportChoice) -> None:
        """Show these options, those that concern the format."""
        self._shown = choice
        self.format_box.setCurrentIndex(list(FORMATS).index(choice.ending))
        self.width_box.setValue(choice.width)
        self.scale_box.setCurrentIndex(_nearest(choice.scale))
        self.colour_box.setCurrentIndex(int(choice.dark))
        self.transparent.setChecked(choice.transparent)
        self.true_size.setChecked(choice.true_size)
        for name, check in self.shown.items():
            check.setChecked(getattr(choice, name))
        self.tolerance_edit.show_text(_tolerance_text(choice.tolerance))
        self.cubic.setChecked(choice.cubic)
        self.spacing_box.setCurrentIndex(list(_SPACINGS).index(choice.spacing))
        self.samples_box.setValue(choice.samples)
        for title, check in self.columns.items():
            check.setChecked(title in choice.columns)
        self._show_rows(choice)

    def show_unit(self, name: str) -> None:
        """Offer true size in this unit, if it is one of length."""
        unit = known_unit(name)
        self.true_size.setEnabled(bool(unit))
        self.true_size.setText(f"True size, 1 is 1 {unit}" if unit else "True size")
        why = f"“{name}” is no unit of length" if name else "No unit is set"
        tip = (
            f"A length of one in the document is 1 {unit} in the file" if unit else f"{why}; see Preferences"
        )
        self.true_size.setToolTip(tip)

    def _show_rows(self, choice: ExportChoice) -> None:
        is_picture, is_table = choice.ending in PICTURES, choice.ending in SAMPLED
        by_tolerance = is_table and choice.spacing is Spacing.TOLERANCE
        rows: dict[QWidget, bool] = {
            self.width_box: choice.ending == ".png",
            self.scale_box: choice.ending == ".png",
            self.true_size: choice.ending in TO_SCALE,
            self.colour_box: is_picture,
            self.transparent: is_picture,
            self._show_grid: is_picture or choice.ending == ".dxf",
            self.tolerance_edit: choice.ending in WITH_TOLERANCE or by_tolerance,
            self.cubic: choice.ending == ".dxf",
            self.spacing_box: is_table,
            self.samples_box: is_table and not by_tolerance,
            self._column_grid: is_table,
        }
        self._description.setText(DESCRIPTIONS[choice.ending])
        for widget, is_shown in rows.items():
            self._form.setRowVisible(widget, is_shown)
        for name, check in self.shown.items():
            check.setVisible(is_picture or name == "points")

    def choice(self) -> ExportChoice:
        """Return what is chosen.

        Raises
        ------
        ExpressionError
            If no column is, or a number that concerns the format is out of its range.
        """
        titles = tuple(title for title, check in self.columns.items() if check.isChecked())
        ending = list(FORMATS)[self.format_box.currentIndex()]
        if not titles and ending in SAMPLED:
            raise ExpressionError("A table needs at least one column.")
        spacing = list(_SPACINGS)[self.spacing_box.currentIndex()]
        concerns = {
            self.width_box: ending == ".png",
            self.samples_box: ending in SAMPLED and spacing is not Spacing.TOLERANCE,
        }
        if problem := next(
            (box.problem for box, is_asked in concerns.items() if is_asked and box.problem), ""
        ):
            raise ExpressionError(problem)
        return ExportChoice(
            ending=ending,
            width=self.width_box.value(),
            scale=list(_SCALES)[self.scale_box.currentIndex()],
            dark=self.colour_box.currentIndex() == 1,
            transparent=self.transparent.isChecked(),
            true_size=self.true_size.isChecked(),
            tolerance=self._shown.tolerance,
            cubic=self.cubic.isChecked(),
            spacing=spacing,
            samples=self.samples_box.value(),
            columns=titles or TITLES,
            **{name: check.isChecked() for name, check in self.shown.items()},
        )

    def _change(self) -> None:
        try:
            choice = self.choice()
        except ExpressionError:
            self.changed.emit()  # whoever hears it asks for the choice, and says so
            return
        if choice != self._shown:
            self._shown = choice
            self._show_rows(choice)
            self.changed.emit()

    def _type_tolerance(self, text: str) -> None:
        try:
            tolerance = _tolerance_of(text)
        except ExpressionError:
            self.tolerance_edit.keep()
            return
        self._shown = replace(self._shown, tolerance=tolerance)
        self.tolerance_edit.show_text(_tolerance_text(tolerance))
        self.changed.emit()


def _tolerance_of(text: str) -> float | None:
    if text.strip().casefold() in ("", _AUTOMATIC):
        return None
    value = parse_number(text, decimal_mark())
    if not value > 0:
        raise ExpressionError("The tolerance must be greater than 0.")
    return value


def _tolerance_text(tolerance: float | None) -> str:
    return _AUTOMATIC if tolerance is None else exact_text(tolerance, decimal_mark())


def _nearest(scale: float) -> int:
    return min(range(len(_SCALES)), key=lambda place: abs(list(_SCALES)[place] - scale))


def _spin(name: str, label: str, tip: str, limits: tuple[int, int]) -> ToldSpinBox:
    box = ToldSpinBox(name, label, tip, limits)
    box.setKeyboardTracking(False)
    return box


def _check(name: str, text: str, tip: str) -> QCheckBox:
    check = QCheckBox(text)
    check.setObjectName(name)
    check.setToolTip(tip)
    return check


def _in_columns(widgets: Sequence[QWidget], count: int) -> QWidget:
    holder = QWidget()
    grid = QGridLayout(holder)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(14)
    for place, widget in enumerate(widgets):
        grid.addWidget(widget, place // count, place % count)
    return holder
