"""Form of stroke and fill of the selected curves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction, QShowEvent
from PySide6.QtWidgets import QFormLayout, QFrame, QSizePolicy, QWidget

from ...document.expression import ExpressionError
from ...document.several_curves import common_values
from ...document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from ...document.transforms import round_step_below
from ...document.words import decimal_product, decimal_sum
from ...qt.labels import MUTED, Label, tip_of
from ...widgets.boxes import column_of, form_of, row_of
from ...widgets.controls import ChoiceRow, action_button
from ...widgets.fields import FieldForm, NumberEdit, read_number
from ...widgets.number_text import read_length
from .fields import MIXED, DashField, PaintField, PercentField

AUTO = "auto"
"""Text for a line of the default width at every zoom."""

_NARROW = 44

_UNSEEN_DOTS = "Dashes of length 0 are invisible with butt ends."

_LEAST_WIDTH = 1e-9
"""Width of a line that counts as none: the first step from there is a tenth of the unit."""


class StylePanel(FieldForm):
    """Form of the style of one or several curves.

    Signals
    -------
    wanted
        Fields of the styles are to be changed: a dictionary.
    stepped
        The same by an arrow key or the wheel; quick changes are one step.
    previewed
        Values are previewed, until a change or a cancellation.
    preview_cancelled
        The preview is cancelled.
    became_visible
        The panel has become visible and needs its values.

    Attributes
    ----------
    opacities
        The fields of percentages, by the field of the style.
    """

    wanted = Signal(object)
    stepped = Signal(object)
    previewed = Signal(object)
    preview_cancelled = Signal()
    became_visible = Signal()

    def __init__(
        self,
        buttons: Sequence[QAction],
        swap: QAction,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__("stylePanel", "styleProblem", parent)
        self._unit = ""
        self._subject = Label(name="styleSubject")
        self._subject.setStyleSheet("font-weight: bold")
        self._note = Label(name="styleNote", wordWrap=True, role=MUTED)
        self._no_dots = Label(name="styleUnseenDots", wordWrap=True, role=MUTED)
        self.fill = PaintField("fillPaint", "Fill")
        self.stroke = PaintField("strokePaint", "Stroke")
        self._rule = ChoiceRow("fillRule", "Fill rule", "Regions to fill where curves cross", FillRule)
        self._cap = ChoiceRow("lineCap", "Line ends", "Shape of the ends of lines and dashes", LineCap)
        self._join = ChoiceRow("lineJoin", "Line corners", "Shape of the corners of lines", LineJoin)
        self._make_numbers()
        self._dash = DashField()
        self.opacities = {
            "fill_opacity": PercentField("fillOpacity", "Fill opacity", "Opacity of the fill"),
            "stroke_opacity": PercentField("strokeOpacity", "Stroke opacity", "Opacity of the line"),
        }
        self._rendered: tuple[object, ...] = ()
        self._lay_out(buttons, swap)
        self._connect()

    def _make_numbers(self) -> None:
        self._width = NumberEdit(
            "strokeWidth",
            "Width of the line",
            "Width of the line, such as 0.5 mm or 1/8; “auto” draws the default width at every zoom "
            "(Enter to set; ↑ ↓ by a tenth)",
            self._read_width,
            _next_width,
        )
        self._limit = NumberEdit(
            "miterLimit",
            "Miter limit",
            "Largest length of a miter, in multiples of the width (Enter to set)",
            _read_limit,
        )
        self._limit.setFixedWidth(_NARROW)
        self._offset = NumberEdit(
            "dashOffset", "Start of the dashes", "Start of the dash pattern, in multiples of the width"
        )
        self._offset.setFixedWidth(_NARROW)

    def show_recent(self, colours: Sequence[str], others: Sequence[str] = ()) -> None:
        """Show recent colours for fill and stroke, then others while there is room."""
        self.fill.show_recent(colours, others)
        self.stroke.show_recent(colours, others)

    def _lay_out(self, buttons: Sequence[QAction], swap: QAction) -> None:
        for label in (self._subject, self.problem, self._note, self._no_dots):
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        dashes = row_of((self._dash, 1), "from", self._offset, spacing=6)
        self._form = form_of(
            ("Fill", self.fill),
            ("Inside", self._rule),
            ("Opacity", self.opacities["fill_opacity"]),
            ("", row_of((_rule_line(), 1), action_button(swap, flat=True), spacing=6)),
            ("Stroke", self.stroke),
            ("Width", self._width),
            ("Ends", self._cap),
            ("Corners", row_of((self._join, 1), "≤", self._limit, spacing=6)),
            ("Dashes", dashes),
            ("Opacity", self.opacities["stroke_opacity"]),
            down=6,
        )
        self._form.setLabelAlignment(Qt.AlignmentFlag.AlignLeft)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        # Messages are at the bottom, so that rows do not move under the pointer.
        below = row_of(*(action_button(action, beside=True) for action in buttons), 1)
        messages = (self._note, self._no_dots, self.problem)
        column_of(self._subject, self._form, below, *messages, 1, margins=12, spacing=8, parent=self)

    def _connect(self) -> None:
        numbers = (self._width, self._limit, self._offset, self._dash.edit)
        shares = [field.edit for field in self.opacities.values()]
        self.watch(*numbers, *shares, self.fill.edit, self.stroke.edit)
        for name, paint in (("fill", self.fill), ("stroke", self.stroke)):
            self._connect_paint(paint, name)
        parts = ((self._rule, "fill_rule"), (self._cap, "cap"), (self._join, "join"), (self._dash, "dash"))
        for part, name in parts:
            part.chosen.connect(lambda value, name=name: self.wanted.emit({name: value}))
        # The preset is made visible by round ends; for a typed 0 there is a note.
        self._dash.dots_chosen.connect(lambda dash: self.wanted.emit({"dash": dash, "cap": LineCap.ROUND}))
        fields = {self._width: "width", self._limit: "miter_limit", self._offset: "dash_offset"}
        fields |= {field.edit: name for name, field in self.opacities.items()}
        for edit, name in fields.items():
            edit.entered.connect(lambda value, name=name: self.wanted.emit({name: value}))
            edit.stepped.connect(lambda value, name=name: self.stepped.emit({name: value}))

    def _connect_paint(self, paint: PaintField, name: str) -> None:
        paint.chosen.connect(lambda value: self.wanted.emit({name: value}))
        paint.previewed.connect(lambda value: self.previewed.emit({name: value}))
        paint.cancelled.connect(self.preview_cancelled)

    def _read_width(self, text: str) -> float | None:
        if text.strip().casefold() in ("", AUTO):
            return None
        width = read_length(text, self._unit)
        if width < 0:
            raise ExpressionError("Type a width of at least 0, or “auto”.")
        return width

    # Rendering: nothing here writes back

    def render_styles(
        self,
        subject: str,
        styles: Sequence[Style],
        unit: str,
        note: str,
    ) -> None:
        """Show the common values of styles, with the title `subject` and a note about colours."""
        wanted = (subject, tuple(styles), unit, note)
        if wanted == self._rendered:
            return
        if self._rendered and wanted[:2] != self._rendered[:2]:
            self.clear_refusal()
        self._rendered, self._unit = wanted, unit
        values = common_values(styles)
        self._subject.setText(subject)
        self._subject.setToolTip(tip_of(subject))
        self.fill.render_value(values.get("fill"))
        self.stroke.render_value(values.get("stroke"))
        self._rule.render_value(values.get("fill_rule"))
        self._cap.render_value(values.get("cap"))
        self._join.render_value(values.get("join"))
        self._dash.render_value(values.get("dash"))
        for name, field in self.opacities.items():
            field.render_value(values.get(name))
        self._render_numbers(values, unit)
        self._enable(styles)
        unseen = _UNSEEN_DOTS if any(map(_has_unseen_dots, styles)) else ""
        self._note.show_text(note)
        self._no_dots.show_text(unseen)
        self.show_problem("")

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        self.became_visible.emit()

    def _render_numbers(self, values: dict[str, object], unit: str) -> None:
        width = values.get("width", MIXED)
        if isinstance(width, float):
            self._width.show_length(width, unit)
        else:
            self._width.show_text(AUTO if width is None else MIXED)
        for edit, name in ((self._limit, "miter_limit"), (self._offset, "dash_offset")):
            value = values.get(name)
            edit.show_length(value) if isinstance(value, float) else edit.show_text(MIXED)

    def _enable(self, styles: Iterable[Style]) -> None:
        """Enable the fields that have an effect."""
        styles = list(styles)
        for always in (self.fill, self.stroke):
            always.setEnabled(bool(styles))
        has_fill = any(style.fill != NO_PAINT for style in styles)
        has_stroke = any(style.stroke != NO_PAINT for style in styles)
        of_line: tuple[QWidget, ...] = (self._width, self._cap, self._join, self._dash)
        for part in (self._rule, self.opacities["fill_opacity"]):
            part.setEnabled(has_fill)
        for field in (*of_line, self.opacities["stroke_opacity"]):
            field.setEnabled(has_stroke)
        self._limit.setEnabled(has_stroke and any(style.join is LineJoin.MITER for style in styles))
        self._offset.setEnabled(has_stroke and any(style.dash for style in styles))


def _has_unseen_dots(style: Style) -> bool:
    """Whether some dashes of a stroke have length 0, and ends that add nothing to that."""
    return style.stroke != NO_PAINT and style.cap is LineCap.BUTT and 0.0 in style.dashes_and_gaps[::2]


def _next_width(width: float, count: int) -> float:
    """Return a width that is wider or narrower by a tenth at most, in round numbers."""
    step = round_step_below(decimal_product(width, 0.1)) if width > _LEAST_WIDTH else 0.1
    return max(decimal_sum(width, count * step), 0.0)


def _read_limit(text: str) -> float:
    limit = read_number(text)
    if limit < 1:
        raise ExpressionError("Type a limit of at least 1.")
    return limit


def _rule_line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setFrameShadow(QFrame.Shadow.Plain)
    line.setEnabled(False)
    return line
