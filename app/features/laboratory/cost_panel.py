"""Cost of solving a system against that of the basis form: in words, and over the number of points."""

from __future__ import annotations

from PySide6.QtWidgets import QGridLayout, QWidget

from ...document.words import number
from ...qt.labels import Label
from ...view_model.analysis.laboratory import SolvingCost, cost_chart
from ...view_model.analysis.settings import Calculation
from ...view_model.analysis.wording import short
from ...widgets.boxes import column_of
from .log_plot import LogLine, LogPlot

_SMALL = 30
_ROWS = {"first": "Operations, first point", "further": "Each further point", "time": "Time, measured"}


class CostPanel(QWidget):
    """The operations of both ways for the present n, their time, and a chart."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("costPanel")
        self._words = Label(name="costWords", wordWrap=True)
        self._numbers = QGridLayout()
        self._cells: dict[str, Label] = {}
        self._lay_out_numbers()
        self._note = Label(name="costNote", wordWrap=True)
        self.chart = LogPlot(
            "costChart", "Operations to the first point of the curve over the number of points n"
        )
        title = "Operations to the first point, over n"
        parts = (self._words, self._numbers, title, (self.chart, 1), self._note)
        column_of(*parts, margins=12, spacing=10, parent=self)

    def _lay_out_numbers(self) -> None:
        self._numbers.setColumnStretch(0, 1)
        self._numbers.setHorizontalSpacing(12)
        for place, text in enumerate(("", "Solving, n³", "Basis form, n²")):
            self._numbers.addWidget(Label(text), 0, place)
        for line, (key, text) in enumerate(_ROWS.items(), start=1):
            self._numbers.addWidget(Label(text), line, 0)
            for place, way in enumerate(("solving", "basis"), start=1):
                cell = self._cells[f"{key}_{way}"] = Label("–", name=f"cost_{key}_{way}")
                self._numbers.addWidget(cell, line, place)

    def render_cost(self, cost: SolvingCost | None, *, busy: bool) -> None:
        """Show what was counted and measured; muted while it is being measured anew."""
        for cell in self._cells.values():
            cell.setEnabled(not busy)
        if cost is None:
            self._words.setText("Measuring…" if busy else "There is no curve to measure.")
            return
        texts = {
            "first_solving": short(cost.solving),
            "first_basis": short(cost.basis),
            "further_solving": short(cost.further[0]),
            "further_basis": short(cost.further[1]),
            "time_solving": _duration(cost.seconds[0]),
            "time_basis": _duration(cost.seconds[1]),
        }
        for key, text in texts.items():
            self._cells[key].setText(text)
        self._words.setText(_words(cost))
        self._note.setText(_note(cost))
        chart = cost_chart()
        self.chart.render_lines(
            [
                LogLine(chart.n, chart.solving, Calculation.MONOMIAL.style, "solving, n³"),
                LogLine(chart.n, chart.basis, Calculation.LAGRANGE.style, "basis form, n²"),
            ],
            marker=float(min(cost.count, chart.n[-1])),
        )


def _words(cost: SolvingCost) -> str:
    times = cost.seconds[0] / cost.seconds[1]
    return (
        f"With {cost.count} points, solving for the monomials' coefficients costs {cost.ratio:.1f} times "
        f"the operations of the basis form; measured here, {times:.1f} times its time."
    )


def _note(cost: SolvingCost) -> str:
    text = (
        f"Twice as many points: {cost.doubled[0]:.1f} times the operations to solve, "
        f"{cost.doubled[1]:.1f} times for the basis form; 8 and 4 for large n. "
        f"In its barycentric variant each further point takes {short(cost.further[2])}."
    )
    if cost.count < _SMALL:
        text += " With so few points the time is mostly that of calling NumPy."
    if cost.piecewise is not None:
        text += (
            f" All this is about one polynomial through the points. The Hermite curve itself needs only "
            f"{cost.count - 1} small systems, {short(cost.piecewise)} operations: its cost grows as n does."
        )
    if cost.other:
        text += f" All this is about one polynomial through the points; {cost.other} is none."
    return text


def _duration(seconds: float) -> str:
    for factor, unit in ((1e6, "µs"), (1e3, "ms")):
        if seconds * factor < 999.5:
            return f"{number(seconds * factor, 3)} {unit}"
    return f"{number(seconds, 3)} s"
