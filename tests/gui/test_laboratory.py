"""The stability laboratory and its cost page, with real events."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from functools import reduce

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDockWidget,
    QLabel,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QSlider,
    QTabWidget,
    QToolButton,
)

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.laboratory.commands import LaboratoryCommands
from app.tasks.task import SETTLE_MS
from app.view_model.analysis.settings import Calculation
from tests.gui.editor_facts import retype
from tests.waiting import until

LEFT = Qt.MouseButton.LeftButton
NEVER_MS = 600_000
POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))


@pytest.fixture
def quick(editor):
    """Have the laboratory compute at once: that it waits for the hand to rest is one question of all."""
    tasks = commands(editor)._task, commands(editor)._cost_task
    for task in tasks:
        task._timer.setInterval(0)
    yield
    for task in tasks:
        task._timer.setInterval(SETTLE_MS)


@pytest.fixture
def lab(editor, quick):
    """The editor with six points and the laboratory open."""
    editor.session.commit(Document((make_curve(POINTS),)), "Begin")
    editor.fit()
    editor.trigger("toggleLaboratory")
    settled(editor)
    return editor


def commands(editor):
    return editor.window.commands[LaboratoryCommands]


def settled(editor):
    """Wait until the laboratory has answered."""
    editor.settle()
    lab = commands(editor)
    until(lambda: not (lab._task.is_busy or lab._digits_task.is_busy or lab._cost_task.is_busy))
    editor.settle()


def find(editor, kind, name):
    widget = editor.window.findChild(kind, name)
    assert widget is not None, name
    return widget


def text(editor, name):
    return find(editor, QLabel, name).text()


def traces_of(editor):
    groups = editor.window.canvas.drawing.annotations.trace_layer.groups
    return {trace.label: trace for trace in groups.get("laboratory", ((), False))[0]}


def press_key(editor, widget, key):
    QTest.keyClick(widget, key)
    settled(editor)


def click(editor, widget):
    # A check box hears clicks on its box and text only.
    place = QPoint(8, widget.height() // 2)
    QTest.mouseClick(widget, LEFT, pos=place)
    settled(editor)


# An independent k-digit computation: plain Decimal operators, results rounded by hand.


class Rounded:
    """A decimal number all of whose operations keep k digits."""

    def __init__(self, value, digits):
        self.value, self.digits = value, digits

    def _of(self, exact):
        context = Context(prec=self.digits, rounding=ROUND_HALF_EVEN)
        wide = Context(prec=400)
        quotient = wide.divide(Decimal(exact.numerator), Decimal(exact.denominator))
        return Rounded(context.plus(quotient), self.digits)

    def __sub__(self, other):
        return self._of(Fraction(self.value) - Fraction(other.value))

    def __add__(self, other):
        return self._of(Fraction(self.value) + Fraction(other.value))

    def __mul__(self, other):
        return self._of(Fraction(self.value) * Fraction(other.value))

    def __truediv__(self, other):
        return self._of(Fraction(self.value) / Fraction(other.value))


def lagrange_by_hand(points, values, t, digits):
    points, values = ([Rounded(Decimal(float(x)), digits) for x in row] for row in (points, values))
    at = Rounded(Decimal(float(t)), digits)
    terms = []
    for i, value in enumerate(values):
        others = [point for j, point in enumerate(points) if j != i]
        above = reduce(lambda a, b: a * b, (at - other for other in others))
        below = reduce(lambda a, b: a * b, (points[i] - other for other in others))
        terms.append(above / below * value)
    return reduce(lambda a, b: a + b, terms).value


def rows(editor):
    table = commands(editor)._panel.digits
    return {name: (float(x.replace("−", "-")), float(y.replace("−", "-"))) for name, x, y in table.texts}


@pytest.mark.parametrize("digits", [3, 7])
def test_the_displayed_digits_are_those_of_an_independent_computation(lab, digits):
    slider = find(lab, QSlider, "digitsSlider")
    while slider.value() != digits:
        press_key(lab, slider, Qt.Key.Key_Right if slider.value() < digits else Qt.Key.Key_Left)
    lab.session.scrub.set(0.3)
    settled(lab)
    xs, ys = zip(*POINTS, strict=True)
    by_hand = [lagrange_by_hand(lab.parameters, each, 0.3, digits) for each in (xs, ys)]
    assert rows(lab)["Lagrange"] == tuple(float(each) for each in by_hand)
    table = commands(lab)._panel.digits
    lagrange = next(row for row in table.texts if row[0] == "Lagrange")
    assert [each.strip().replace("−", "-") for each in lagrange[1:]] == [str(each) for each in by_hand]


def test_the_errors_in_the_table_and_the_plot_are_those_of_the_drawn_curve(lab):
    trace = traces_of(lab)["Lagrange"]
    trial = commands(lab).trial
    truth = lab.session.active_view.curve.evaluate(trial.t)
    away = np.hypot(*(np.vstack(trace.pieces) - truth).T)
    find(lab, QToolButton, "plotErrorsButton").click()
    settled(lab)
    (plot,) = lab.window.analysis.added_plots.values()
    line = next(each for each in plot.lines if each.name == "Lagrange")
    assert line.values == pytest.approx(away, abs=1e-14)
    assert float(text(lab, "error_lagrange")) == pytest.approx(away.max(), rel=0.06)
    assert float(text(lab, "place_lagrange")) == pytest.approx(trial.t[np.argmax(away)], abs=0.006)


def test_fewer_digits_spoil_the_monomials_first(lab):
    slider = find(lab, QSlider, "digitsSlider")
    assert slider.value() == 4
    errors = {}
    for digits in (4, 3, 2):
        assert text(lab, "digitsValue") == f"<b>{digits}</b> digits"
        errors[digits] = float(text(lab, "error_monomial"))
        assert errors[digits] > float(text(lab, "error_lagrange"))
        press_key(lab, slider, Qt.Key.Key_Left)
    assert errors[2] > errors[3] > errors[4]
    press_key(lab, slider, Qt.Key.Key_End)
    assert slider.value() == 16
    assert text(lab, "digitsValue") == "<b>16</b> digits"


def test_shifting_t_spoils_the_monomials_and_not_lagrange(lab):
    before, document = text(lab, "error_lagrange"), lab.session.document
    button = find(lab, QPushButton, "shiftButton")
    click(lab, button)
    assert float(text(lab, "lost_monomial")) == 4.0
    assert text(lab, "error_lagrange") == before
    assert lab.session.document is document
    assert not lab.session.files.is_modified or lab.session.undo_stack.count() == 1
    assert button.text() == "Undo Shift"
    click(lab, button)
    assert float(text(lab, "lost_monomial")) < 4.0


def test_a_shift_can_be_typed(lab):
    field = find(lab, QLineEdit, "shiftField")
    retype(field, "1000")
    settled(lab)
    assert commands(lab)._settings.shift == 1000
    assert "κ" in text(lab, "condition_monomial")
    field.selectAll()
    QTest.keyClicks(field, "1e300")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert "between" in text(lab, "laboratoryNote")
    assert commands(lab)._settings.shift == 1000


def test_check_boxes_select_the_methods(lab):
    assert set(traces_of(lab)) == {"Monomials", "Lagrange"}
    click(lab, find(lab, QCheckBox, "method_barycentric"))
    click(lab, find(lab, QCheckBox, "method_monomial"))
    assert set(traces_of(lab)) == {"Lagrange", "Barycentric"}
    styles = [(trace.style.colour, trace.style.dashes) for trace in traces_of(lab).values()]
    assert len(set(styles)) == 2
    assert text(lab, "lost_monomial") == "–"


def test_hermite_curves_have_methods_of_their_own(lab):
    lab.choose_family(HERMITE)
    settled(lab)
    assert set(traces_of(lab)) == {"Monomials", "Hermite basis"}
    assert not find(lab, QCheckBox, "method_newton").isVisible()
    click(lab, find(lab, QCheckBox, "method_monomial"))
    assert set(traces_of(lab)) == {"Hermite basis"}
    # What was chosen for the other family is still chosen.
    lab.choose_family(LAGRANGE)
    settled(lab)
    assert set(traces_of(lab)) == {"Lagrange"}


def test_the_data_can_be_rounded(lab):
    lab.session.commit(Document((make_curve([(x + 0.123456, y) for x, y in POINTS]),)), "Move")
    box = find(lab, QComboBox, "roundData")
    box.setFocus()
    press_key(lab, box, Qt.Key.Key_Down)
    press_key(lab, box, Qt.Key.Key_Down)
    assert commands(lab)._settings.decimals == 1
    first = traces_of(lab)["Lagrange"].pieces[0][0]
    assert first == pytest.approx((0.1, 0.0))
    press_key(lab, box, Qt.Key.Key_Up)
    assert "neighbouring t are the same number" in text(lab, "laboratoryWords")
    assert not traces_of(lab)
    press_key(lab, box, Qt.Key.Key_Home)
    assert traces_of(lab)


def test_rounding_can_be_limited_to_coefficients_or_data(lab):
    """Only every step could be: the error of the monomials along t was flat, whatever lesson 6 said of it."""
    clock = Parametrization(ParametrizationKind.UNIFORM, end=8.0)
    nine = [(i, y) for i, y in enumerate((0.0, 1.1, 1.6, 1.3, 0.5, 0.2, 0.8, 1.7, 1.9))]
    lab.session.commit(Document((replace(make_curve(nine), parametrization=clock),)), "Nine")
    settled(lab)
    box = find(lab, QComboBox, "roundWhat")
    assert [box.itemText(row) for row in range(3)] == ["every step", "the coefficients", "the data"]
    box.setFocus()
    press_key(lab, box, Qt.Key.Key_Down)
    trial = commands(lab).trial
    errors = trial.outcome(Calculation.MONOMIAL).errors
    assert errors[trial.t < 0.5].max() < 1e-3 * errors[trial.t > 7.5].max()
    assert "tᵏ times as much" in text(lab, "laboratoryWords")
    assert text(lab, "condition_monomial") == "–"
    assert lab.window.canvas.drawing.annotations.trace_layer.groups["laboratory"][0]
    # Rounded to four digits the points are what they were.
    assert text(lab, "lost_lagrange") == "0.0"
    press_key(lab, box, Qt.Key.Key_Down)
    assert text(lab, "error_monomial") == text(lab, "error_lagrange")
    assert "every method gives the same curve" in text(lab, "laboratoryWords")
    assert text(lab, "condition_monomial") == text(lab, "condition_lagrange") == "Λ 11"
    lab.window.analysis.change(
        laboratory=replace(lab.window.analysis.settings.laboratory, digits=2, shift=1000.0)
    )
    settled(lab)
    assert "Rounded to 2 digits, neighbouring t are the same number" in text(lab, "laboratoryWords")
    assert not traces_of(lab)
    press_key(lab, box, Qt.Key.Key_Home)
    assert traces_of(lab)


def test_the_old_curves_are_faded_during_a_drag_until_the_pointer_rests(lab):
    # However slow the machine is, the hand does not rest before it is let go.
    settling = commands(lab)._task._timer
    settling.setInterval(NEVER_MS)
    trace = traces_of(lab)["Lagrange"]
    x, y = lab.point(2)
    lab.press((x, y))
    lab.move((x + 0.5, y + 0.5))
    traces, faded = lab.window.canvas.drawing.annotations.trace_layer.groups["laboratory"]
    assert faded
    assert traces[1].pieces is trace.pieces
    assert text(lab, "laboratoryState") == "computing…"
    lab.release((x + 0.5, y + 0.5))
    settling.setInterval(SETTLE_MS)
    settled(lab)
    traces, faded = lab.window.canvas.drawing.annotations.trace_layer.groups["laboratory"]
    assert not faded
    assert traces[1].pieces is not trace.pieces
    assert text(lab, "laboratoryState") == ""


def test_a_disabled_laboratory_computes_nothing_and_closing_the_dock_disables_the_laboratory(new_editor):
    editor = new_editor
    assert not commands(editor)._settings.on
    assert commands(editor)._panel is None
    editor.drag_point(1, to=(2, 3))
    # The side folded away and back must not wake it.
    editor.trigger("toggleSidePanel")
    editor.trigger("toggleSidePanel")
    assert commands(editor)._asked is None
    assert commands(editor)._panel is None
    editor.trigger("toggleLaboratory")
    settled(editor)
    assert editor.action("toggleLaboratory").isChecked()
    assert traces_of(editor)
    # Another tab in front leaves the curves where they are.
    editor.show_dock("curveDock")
    editor.drag_point(1, to=(2, 3.5))
    settled(editor)
    assert traces_of(editor)
    dock = find(editor, QDockWidget, "laboratoryDock")
    dock.close()
    assert not editor.action("toggleLaboratory").isChecked()
    assert not traces_of(editor)


def test_too_many_points_are_refused_with_a_sentence(lab):
    wave = [(0.1 * i, np.sin(i)) for i in range(61)]
    lab.session.commit(Document((make_curve(wave),)), "More")
    settled(lab)
    assert set(traces_of(lab)) == {"Monomials"}
    assert "Lagrange is left out" in text(lab, "laboratoryNote")
    lab.session.commit(Document((make_curve([(i, i % 2) for i in range(201)]),)), "Most")
    settled(lab)
    assert not traces_of(lab)
    assert "up to 200 points; this one has 201" in text(lab, "laboratoryWords")


def test_without_a_curve_the_panel_gives_the_reason(lab):
    lab.session.commit(Document((make_curve(POINTS[:1]),)), "One")
    settled(lab)
    assert not traces_of(lab)
    assert text(lab, "laboratoryWords") == "A curve needs at least two points."


def test_the_cost_page_counts_measures_and_marks_n(lab):
    tabs = find(lab, QTabWidget, "laboratoryPanel")
    QTest.mouseClick(tabs.tabBar(), LEFT, pos=tabs.tabBar().tabRect(1).center())
    settled(lab)
    # Elimination, by hand for n = 6 and two coordinates: the powers, 15 factors, 2·55 updates of the matrix,
    # 2·2·15 of the right-hand sides, back substitution, then Horner.
    solving = 6 * 4 + 15 + 2 * 55 + 4 * 15 + 2 * (2 * 15 + 6) + 2 * 2 * 5
    assert text(lab, "cost_first_solving") == str(solving)
    ratio = solving / int(text(lab, "cost_first_basis"))
    assert f"{ratio:.1f} times the operations" in text(lab, "costWords")
    assert text(lab, "cost_time_solving").endswith("s")
    chart = commands(lab)._panel.cost.chart
    assert chart._marker == 6
    assert [line.values[-1] > 1e6 for line in chart.lines] == [True, True]
    lab.fit()
    lab.add_point(5.5, 3)
    settled(lab)
    assert chart._marker == 7
    assert "With 7 points" in text(lab, "costWords")


def test_the_computed_curves_are_drawn_in_both_themes(lab):
    canvas = lab.window.canvas
    for theme in ("themeDark", "themeLight"):
        lab.trigger(theme)
        with_curves = canvas.grab().toImage()
        traces, _ = canvas.drawing.annotations.trace_layer.groups["laboratory"]
        canvas.drawing.annotations.render_traces("laboratory", ())
        assert with_curves != canvas.grab().toImage()
        canvas.drawing.annotations.render_traces("laboratory", traces, "Computed with 4 digits")
        assert with_curves == canvas.grab().toImage()


def test_the_errors_are_plotted_below_the_functions(lab):
    lab.trigger("plotErrors")
    settled(lab)
    (plot,) = lab.window.analysis.added_plots.values()
    assert plot.title == "Errors of the methods"
    drawn = {line.name: line.values for line in plot.lines}
    trial = commands(lab).trial
    for outcome in trial.outcomes:
        (values,) = [values for values in drawn.values() if values is outcome.errors]
        assert values.max() == outcome.errors.max()
    lab.trigger("toggleLaboratory")
    assert lab.window.analysis.added_plots == {}
    lab.trigger("plotErrors")
    lab.trigger("plotErrors")
    settled(lab)
    assert lab.action("toggleLaboratory").isChecked()
    assert len(lab.window.analysis.added_plots) == 1
    lab.trigger("plotErrors")
    assert lab.window.analysis.added_plots == {}


def test_sixteen_digits_fit_the_dock(lab):
    """The y values, the condition and the shift field used to be cut off at the right."""
    lab.window.analysis.change(laboratory=replace(lab.window.analysis.settings.laboratory, digits=16))
    settled(lab)
    page = find(lab, QScrollArea, "accuracyPage")
    assert page.widget().width() <= page.viewport().width()


@pytest.mark.parametrize("family", [LAGRANGE, QUINTIC_HERMITE])
@pytest.mark.usefixtures("quick")
def test_the_dock_is_as_wide_as_the_laboratory(editor, family):
    """In a window 1280 pixels wide it was 4 pixels wider than its dock, and scrolled sideways by them."""
    editor.window.resize(1280, 860)
    editor.choose_family(family)
    editor.trigger("toggleLaboratory")
    settled(editor)
    dock = editor.window.findChild(QDockWidget, "laboratoryDock")
    until(lambda: dock.widget().horizontalScrollBar().maximum() == 0)
    page = find(editor, QScrollArea, "accuracyPage")
    assert page.horizontalScrollBar().maximum() == 0
    words = find(editor, QLabel, "laboratoryWords").text()
    assert ("This Λ applies to the data" in words) == bool(family.derivatives)
