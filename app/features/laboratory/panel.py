"""Panel of the laboratory: digits, rounded data, a shift of t, and the results of each method."""

from __future__ import annotations

from msgspec.structs import replace
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QGridLayout, QSizePolicy, QSlider, QTabWidget, QWidget

from ...document.expression import ExpressionError
from ...document.words import count_of
from ...qt.labels import Label
from ...state.window_state import Analysis
from ...view_model.analysis.laboratory import Digits, Trial, calculations, growth_words, trial_words
from ...view_model.analysis.settings import (
    LEAST_DIGITS,
    MOST_DECIMALS,
    MOST_DIGITS,
    USUAL_SHIFT,
    Calculation,
    LaboratorySettings,
    RoundedPart,
)
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import column_of, grid_of, row_of
from ...widgets.controls import action_button, choice_box, named, push_button
from ...widgets.fields import NumberEdit, read_number
from ...widgets.frames import Scrolled
from .cost import CostPanel
from .tables import DigitsTable, MethodTable

_LARGEST_SHIFT = 1e9

_WHAT_TIP = (
    "Round every step, as a pocket calculator does; or only the coefficients of each method, "
    "or only the data, with exact arithmetic before and after"
)
_DATA_TIP = "Round points, parameters and derivatives before the computation"
_SHIFT_TIP = (
    "Add 100 to every t: the same curve, but methods with powers of t lose their digits. "
    "The document does not change"
)

_PAGE = QSize(2000, 72)
"""Largest minimum size of a page: its whole width, and little height."""


class LaboratoryPanel(QTabWidget):
    """Controls of the experiment, its results, and the page on costs.

    Signals
    -------
    cost_opened
        The person brings the page on costs to the front.
    """

    cost_opened = Signal()

    def __init__(self, analysis: Analysis, plot_errors: QAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("laboratoryPanel")
        self.setDocumentMode(True)
        self._analysis = analysis
        self._plot_errors = plot_errors
        self.cost = CostPanel()
        self.table, self.digits = MethodTable(), DigitsTable()
        self.what = choice_box("roundWhat", "Rounded part", _WHAT_TIP, (part.label for part in RoundedPart))
        self.slider = self._make_slider()
        self.digits_text = Label(name="digitsValue", is_html=True)
        self.rounding = choice_box("roundData", "Round the data", _DATA_TIP, _data_choices())
        self.shift_button = push_button(
            "shiftButton", "", _SHIFT_TIP, "Shift the parameters by 100, or undo the shift"
        )
        self.shift_button.setCheckable(True)
        tip = "Number to add to every t, in the experiment only"
        self.shift_field = NumberEdit("shiftField", "Shift t by", tip, _shift_of)
        self.words = Label(name="laboratoryWords", wordWrap=True)
        self.note = Label(name="laboratoryNote", wordWrap=True)
        self.state = Label(name="laboratoryState")
        self.addTab(_Page(self._accuracy_page(), "accuracyPage"), "Accuracy")
        self.addTab(_Page(self.cost, "costPage"), "Cost")
        self.setTabToolTip(0, "Number of digits that each method loses")
        self.setTabToolTip(1, "Operations and time that each method takes")
        self._connect()
        self._render_settings()

    # Building

    def _make_slider(self) -> QSlider:
        slider = named(
            QSlider(Qt.Orientation.Horizontal),
            "digitsSlider",
            "Significant digits",
            "Number of significant decimal digits to compute with",
        )
        slider.setRange(LEAST_DIGITS, MOST_DIGITS)
        slider.setPageStep(1)
        slider.setTickPosition(QSlider.TickPosition.TicksBelow)
        slider.setTickInterval(1)
        return slider

    def _accuracy_page(self) -> QWidget:
        page = QWidget()
        plot = action_button(self._plot_errors, name="plotErrors", icon_size=0, beside=True)
        parts = (
            self._controls(),
            self.table,
            self.words,
            self.note,
            self.digits,
            row_of(plot, 1, self.state),
        )
        column_of(*parts, 1, margins=(6, 12, 4, 12), spacing=10, parent=page)
        return page

    def _controls(self) -> QGridLayout:
        grid = grid_of(10, 8, stretched=[1])
        grid.addWidget(Label("Round"), 0, 0)
        grid.addWidget(self.what, 0, 1, 1, 2)
        grid.addWidget(Label("to"), 1, 0)
        grid.addWidget(self.slider, 1, 1)
        width_of = self.fontMetrics().horizontalAdvance
        self.digits_text.setMinimumWidth(width_of("16 digits ") + 8)
        self.rounding.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.shift_field.setFixedWidth(width_of("100000") + 14)
        grid.addWidget(self.digits_text, 1, 2)
        data = row_of((self.rounding, 1), self.shift_button, self.shift_field, spacing=8)
        grid.addLayout(data, 2, 0, 1, 3)
        return grid

    def _connect(self) -> None:
        self.slider.actionTriggered.connect(lambda _action: self._change(digits=self.slider.sliderPosition()))
        self.what.activated.connect(lambda row: self._change(rounding=list(RoundedPart)[row]))
        self.rounding.activated.connect(lambda row: self._change(decimals=row - 1 if row else None))
        self.shift_button.clicked.connect(self._toggle_shift)
        self.shift_field.entered.connect(self._set_shift)
        self.shift_field.refused.connect(self.note.show_text)
        self.table.methods_changed.connect(self._set_methods)
        self.currentChanged.connect(lambda page: self.cost_opened.emit() if page == 1 else None)
        self._analysis.changed.connect(self._render_settings)

    # Changes by the person

    @property
    def _settings(self) -> LaboratorySettings:
        return self._analysis.settings.laboratory

    def _change(self, **fields: object) -> None:
        self._analysis.change(laboratory=replace(self._settings, **fields))

    def _toggle_shift(self) -> None:
        self._change(shift=0.0 if self._settings.shift else USUAL_SHIFT)
        self._render_settings()

    def _set_shift(self, shift: float) -> None:
        self.shift_field.revert()
        self._change(shift=shift)

    def _set_methods(self, methods: frozenset[Calculation]) -> None:
        # The methods of other families stay selected.
        others = frozenset(method for method in self._settings.methods if not self.table.offers(method))
        self._change(methods=methods | others)

    # Rendering

    @property
    def shows_cost(self) -> bool:
        """Whether the page on costs is in front."""
        return self.currentIndex() == 1

    def _render_settings(self) -> None:
        settings = self._settings
        if not self.slider.isSliderDown():
            self.slider.setValue(settings.digits)
        self.what.setCurrentIndex(list(RoundedPart).index(settings.rounding))
        self.digits_text.setText(f"<b>{settings.digits}</b> digits")
        self.rounding.setCurrentIndex(0 if settings.decimals is None else settings.decimals + 1)
        self.shift_button.setChecked(settings.shift != 0)
        self.shift_button.setText("Undo Shift" if settings.shift else f"Shift t by {USUAL_SHIFT:g}")
        self.shift_field.show_number(settings.shift)

    def render_view(self, view: CurveView) -> None:
        """Show the methods of the family."""
        self.table.render_methods(calculations(view), self._settings.methods)

    def render_trial(
        self, trial: Trial | None, lebesgue: float | None, *, busy: bool, problem: str = ""
    ) -> None:
        """Show the results of a trial; muted while another one is computed."""
        self.state.setText("computing…" if busy else "")
        self.table.render_trial(trial, lebesgue, faded=busy)
        sentences = (trial_words(trial), growth_words(trial)) if trial is not None else (problem,)
        self.words.setText(" ".join(filter(None, sentences)))
        self.words.setEnabled(not busy)
        self.note.show_text(trial.note if trial is not None else "")

    def render_digits(self, digits: Digits | None, t: str = "") -> None:
        """Show the computed digits at one t, given as text."""
        self.digits.render_digits(digits, self._settings.digits, t)


def _data_choices() -> list[str]:
    return [
        "Data not rounded",
        *(f"Data to {count_of(decimals, 'decimal')}" for decimals in range(MOST_DECIMALS + 1)),
    ]


class _Page(Scrolled[QWidget]):
    """Page that scrolls vertically.

    It asks for the width of its content and of the scroll bar, so that nothing is cut off at the side. (Where
    text is enlarged for a projector, the content may be wider than the dock, and scrolls.)
    """

    def __init__(self, content: QWidget, name: str) -> None:
        super().__init__(lambda _parent: content, _PAGE)
        self.setObjectName(name)

    def minimumSizeHint(self) -> QSize:
        return super().minimumSizeHint() + QSize(self.verticalScrollBar().sizeHint().width(), 0)


def _shift_of(text: str) -> float:
    """Return the shift in a typed text."""
    shift = read_number(text)
    if abs(shift) > _LARGEST_SHIFT:
        raise ExpressionError("A shift must lie between −1e9 and 1e9.")
    return shift
