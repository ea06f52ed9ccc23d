"""The curve's form: name, interval, rules and facts, with real keys and clicks."""

import numpy as np
import pytest
from PySide6.QtCore import QLocale, Qt
from PySide6.QtGui import QFocusEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QLabel, QLineEdit, QToolButton, QWidget

from app.appearance.theme import ThemeMode, apply_theme
from app.document import curve_edits, point_edits, rule_edits
from app.document.derivatives import AccelerationRule, VelocityRule
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.curve_settings.panel import CurveSettings
from app.session import MessageKind, Session
from app.workbench.form_edits import FormEdits

POINTS = ((3.1, 3.35), (2.2, 4), (1.1, 3.5), (1.25, 2.5), (2.35, 1.95), (2.9, 1), (2, 0.1), (0.75, 0.6))


class Form:
    """The form, connected as the window connects it, and hands for it."""

    def __init__(self, qtbot, family=LAGRANGE, points=POINTS):
        self.qtbot = qtbot
        self.session = Session()
        curve = make_curve(points, name="Letter", family=family)
        self.session.commit(self.session.document.with_curve(0, curve), "Curve")
        self.panel = CurveSettings(self.session.active_view)
        self.edits = FormEdits(self.session, self.panel)
        self.session.document_changed.connect(
            lambda _document: self.panel.render_view(self.session.active_view)
        )
        qtbot.addWidget(self.panel)
        self.panel.resize(320, 300)
        with qtbot.waitActive(self.panel):
            self.panel.show()
            self.panel.activateWindow()

    @property
    def curve(self):
        return self.session.active_curve

    def __getitem__(self, name):
        return self.panel.findChild(QWidget, name)

    @property
    def message(self):
        label = self.panel.findChild(QLabel, "curveProblem")
        return label.text() if label.isVisible() else ""

    def type(self, name, text, key=Qt.Key.Key_Return):
        field = self[name]
        field.setFocus()
        field.selectAll()
        self.qtbot.keyClicks(field, text)
        if key is not None:
            self.qtbot.keyClick(field, key)

    def choose(self, name, row):
        box = self[name]
        box.setFocus()
        self.qtbot.keyClick(box, Qt.Key.Key_Home)
        for _ in range(row):
            self.qtbot.keyClick(box, Qt.Key.Key_Down)


@pytest.fixture
def form(qtbot):
    return Form(qtbot)


@pytest.fixture
def quintic(qtbot):
    return Form(qtbot, QUINTIC_HERMITE)


def test_the_form_shows_the_curve(form):
    assert form["curveName"].text() == "Letter"
    assert (form["intervalStart"].text(), form["intervalEnd"].text()) == ("0", "1")
    facts = form["curveFacts"].text().replace("\N{NO-BREAK SPACE}", " ")
    assert facts == "8 points · degree 7 · one polynomial · 0 ≤ t ≤ 1"
    assert form.message == ""


@pytest.mark.parametrize(
    ("family", "shown"),
    [
        (LAGRANGE, []),
        (HERMITE, ["velocityRule"]),
        (QUINTIC_HERMITE, ["velocityRule", "accelerationRule"]),
    ],
)
def test_the_form_shows_the_rules_of_the_family(qtbot, family, shown):
    form = Form(qtbot, family)
    rules = ("velocityRule", "accelerationRule")
    assert [name for name in rules if form[name].isVisible()] == shown


# The name


def test_renaming(form):
    form.type("curveName", "  Swan ")
    assert form.curve.name == "Swan"
    assert form["curveName"].text() == "Swan"
    assert form.session.undo_stack.undoText() == "Rename curve"
    form.session.undo_stack.undo()
    assert form["curveName"].text() == "Letter"


def test_a_curve_keeps_its_name_when_nothing_is_typed(form):
    steps = form.session.undo_stack.count()
    form.type("curveName", "Letter")
    form.qtbot.keyClick(form["curveName"], Qt.Key.Key_Tab)
    assert form.session.undo_stack.count() == steps
    form.type("curveName", " ")
    assert form.curve.name == "Letter"
    assert "needs a name" in form.message


# The interval


def test_an_interval_is_typed_as_an_expression_and_keeps_the_shape(quintic):
    document = point_edits.set_velocity(quintic.session.document, 0, 2, (3.0, 4.0))
    quintic.session.commit(point_edits.set_derivative(document, 0, 2, 2, (5.0, 6.0)), "Set")
    s = np.linspace(0, 1, 50)
    before = quintic.session.active_view.curve.evaluate(s)
    quintic.type("intervalEnd", "5/2")
    view = quintic.session.active_view
    assert view.curve.domain == (0.0, 2.5)
    np.testing.assert_allclose(view.curve.evaluate(2.5 * s), before, rtol=1e-12, atol=1e-12)
    assert quintic.session.undo_stack.undoText() == "Set interval"
    assert quintic["intervalEnd"].text() == "2.5"
    quintic.session.undo_stack.undo()
    assert quintic["intervalEnd"].text() == "1"


@pytest.mark.parametrize("typed", ["1000001.5", "1000001", "12.3456789"])
def test_a_typed_end_of_the_interval_is_shown_as_it_was_typed(quintic, typed):
    """1000001 and 1000001.5 were both 1e6, in the field and in the facts."""
    quintic.type("intervalEnd", typed)
    assert quintic["intervalEnd"].text() == typed
    assert f"0 ≤ t ≤ {typed}" in quintic["curveFacts"].text().replace("\N{NO-BREAK SPACE}", " ")


def test_a_t_of_a_long_interval_is_written_to_one(quintic):
    """It was 4e5, of four digits."""
    quintic.type("intervalEnd", "1000001.5")
    assert quintic.session.active_view.t_text(400000.6) == "400001"


def test_the_scrub_line_keeps_its_relative_place_in_another_interval(quintic):
    """It stood at the same t, at another point of the curve."""
    quintic.session.scrub.set(0.25)
    place = quintic.session.active_view.curve.evaluate(0.25)
    quintic.type("intervalEnd", "2.5")
    assert quintic.session.scrub.t == 0.625
    assert quintic.session.active_view.curve.evaluate(0.625) == pytest.approx(place)
    quintic.type("intervalStart", "-2.5")
    assert quintic.session.scrub.t == -1.25
    stack = quintic.session.undo_stack
    for step, t in ((stack.undo, 0.625), (stack.undo, 0.25), (stack.redo, 0.625)):
        step()
        assert quintic.session.scrub.t == pytest.approx(t)
    # A point that moves changes the parameters, but not the interval: the line stays at its t.
    document = point_edits.move_points(quintic.session.document, 0, [1], (0.5, 0.5))
    quintic.session.commit(document, "Move")
    assert quintic.session.scrub.t == pytest.approx(0.625)


def test_the_interval_of_manual_parameters(form):
    document = rule_edits.freeze_parameters(form.session.document, 0, [*range(1, 8), 8.5])
    form.session.commit(document, "Freeze")
    assert (form["intervalStart"].text(), form["intervalEnd"].text()) == ("1", "8.5")
    form.type("intervalStart", "-2")
    assert form.curve.points[0].t == -2.0
    assert form.curve.points[-1].t == 8.5
    assert form.curve.parametrization.kind is ParametrizationKind.MANUAL


def test_an_interval_that_was_not_touched_is_not_rounded(form):
    form.session.commit(rule_edits.set_interval(form.session.document, 0, 1 / 3, 0.1 + 0.9), "Set")
    before, steps = form.session.document, form.session.undo_stack.count()
    assert form["intervalStart"].text() == "0.333333"
    form["intervalStart"].setFocus()
    assert form["intervalStart"].text() == repr(1 / 3)
    form["curveName"].setFocus()
    assert form["intervalStart"].text() == "0.333333"
    assert form.session.document is before
    form.type("intervalStart", repr(1 / 3))
    assert form.session.document is before
    assert form.session.undo_stack.count() == steps
    # Typed out, the short text is a number of its own.
    form.type("intervalStart", "0.333333")
    assert form.session.document.curves[0].interval[0] == 0.333333


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("intervalEnd", "abc", "“abc” is not a number"),
        ("intervalEnd", "0", "must be greater than its start"),
        ("intervalStart", "2", "must be greater than its start"),
        ("intervalEnd", "1e13", "1e12"),
        ("intervalEnd", "", "missing"),
    ],
)
def test_a_bad_interval_is_explained_and_can_be_mended(form, name, text, words):
    before = form.session.document
    said = []
    form.session.message.connect(said.append)
    form.type(name, "1")
    form[name].selectAll()
    form.qtbot.keyClick(form[name], Qt.Key.Key_Backspace)
    form.type(name, text)
    assert form.session.document.curves[0].points == before.curves[0].points
    assert words in form.message
    assert form.message.startswith("⚠ ")
    assert form[name].text() == text
    assert MessageKind.REFUSAL in {message.kind for message in said}
    form.qtbot.keyClick(form[name], Qt.Key.Key_Escape)
    assert form.message == ""
    assert form[name].text() == {"intervalStart": "0", "intervalEnd": "1"}[name]
    assert form.session.document == before


def test_tab_stays_in_a_field_with_an_invalid_text(form):
    form.type("intervalStart", "1/0", Qt.Key.Key_Tab)
    assert form["intervalStart"].hasFocus()
    assert form["intervalStart"].text() == "1/0"
    assert "Division by zero" in form.message
    form.type("intervalStart", "1/2", Qt.Key.Key_Tab)
    assert form["intervalEnd"].hasFocus()
    assert form.session.active_view.curve.domain == (0.5, 1.0)
    assert form.message == ""


@pytest.mark.parametrize(
    ("name", "text"), [("intervalEnd", "5"), ("intervalEnd", "1/0"), ("curveName", "Swan")]
)
def test_a_text_that_was_not_entered_is_discarded_when_the_field_loses_focus(form, name, text):
    before, shown = form.session.document, form[name].text()
    form.type(name, text, None)
    form["intervalStart"].setFocus(Qt.FocusReason.MouseFocusReason)
    assert form[name].text() == shown
    assert form.session.document is before
    assert form.message == ""


@pytest.mark.parametrize("way", ["a valid entry", "the same number", "another edit", "a click elsewhere"])
def test_a_refusal_is_removed_with_its_cause(form, way):
    form.type("intervalEnd", "-1")
    assert form.message
    if way == "a valid entry":
        form.type("intervalEnd", "2")
    elif way == "the same number":
        form.type("intervalEnd", "1")
    elif way == "another edit":
        document = point_edits.move_points(form.session.document, 0, [0], (1.0, 0.0))
        form.session.commit(document, "Move point 0")
    else:
        form["velocityRule"].setFocus()
        form["curveName"].setFocus()
    assert form.message == ""


def test_a_typed_text_survives_a_change_to_another_window(form):
    form.type("intervalEnd", "4", None)
    field = form["intervalEnd"]
    QApplication.sendEvent(
        field, QFocusEvent(QFocusEvent.Type.FocusOut, Qt.FocusReason.ActiveWindowFocusReason)
    )
    assert field.text() == "4"
    form.qtbot.keyClick(field, Qt.Key.Key_Return)
    assert form.session.active_view.curve.domain == (0.0, 4.0)


# Closed curves and corners


def test_a_closed_curve_with_a_corner(quintic):
    document = curve_edits.set_closed(quintic.session.document, 0, True)
    document = point_edits.make_corner(document, 0, 3, None, (3.0, 4.0))
    quintic.session.commit(document, "Close")
    facts = quintic["curveFacts"].text().replace("\N{NO-BREAK SPACE}", " ")
    assert facts == "8 points · degree 5 · 8 pieces · closed · 1 corner · 0 ≤ t ≤ 1"
    # Only the acceleration jumps there: no corner.
    velocity = quintic.session.active_view.velocity_of(5)
    corner = point_edits.make_corner(quintic.session.document, 0, 5, velocity, velocity)
    jumping = point_edits.set_derivative(corner, 0, 5, 2, (80.0, 9.0), ahead=True)
    quintic.session.commit(jumping, "Jolt")
    facts = quintic["curveFacts"].text().replace("\N{NO-BREAK SPACE}", " ")
    assert "closed · 1 corner · 1 point with two sides ·" in facts
    quintic.session.commit(document, "Back")
    quintic.type("intervalEnd", "2")
    assert quintic.session.active_view.curve.domain == (0.0, 2.0)
    assert quintic.curve.points[3].velocity_after == (1.5, 2.0)
    parameters = quintic.session.active_view.parameters.tolist()
    frozen = rule_edits.freeze_parameters(quintic.session.document, 0, parameters)
    quintic.session.commit(frozen, "Freeze")
    quintic.type("intervalEnd", "4")
    assert quintic.session.active_view.parameters[-1] == 4.0


def test_escape_discards_a_typed_text(form):
    steps = form.session.undo_stack.count()
    form.type("intervalEnd", "7", Qt.Key.Key_Escape)
    assert form["intervalEnd"].text() == "1"
    form.qtbot.keyClick(form["intervalEnd"], Qt.Key.Key_Return)
    assert form.session.undo_stack.count() == steps


def test_a_text_being_typed_survives_a_change_of_the_curve(form):
    form.type("intervalEnd", "4", None)
    form.session.commit(point_edits.move_points(form.session.document, 0, [0], (1.0, 0.0)), "Move point 0")
    assert form["intervalEnd"].text() == "4"
    form.qtbot.keyClick(form["intervalEnd"], Qt.Key.Key_Return)
    assert form.session.active_view.curve.domain == (0.0, 4.0)


def test_an_interval_with_a_decimal_comma(form):
    QLocale.setDefault(QLocale("de_DE"))
    form.type("intervalEnd", "2,5")
    assert form.session.active_view.curve.domain == (0.0, 2.5)
    assert form["intervalEnd"].text() == "2,5"


# Rules


def test_choosing_rules(quintic):
    names = [quintic["velocityRule"].itemText(row) for row in range(4)]
    assert names == ["Natural C² spline", "Bessel (parabola)", "Finite difference", "Catmull–Rom"]
    for row, rule in enumerate(VelocityRule):
        quintic.choose("velocityRule", row)
        assert quintic.curve.velocity_rule is rule
    quintic.choose("accelerationRule", 1)
    assert quintic.curve.acceleration_rule is AccelerationRule.ZERO
    assert quintic.session.undo_stack.undoText() == "Choose acceleration rule “Zero”"
    quintic.session.undo_stack.undo()
    assert quintic["accelerationRule"].currentText() == "From the C² spline"


def test_reset_all_to_estimate_by_the_button_of_the_form(editor):
    editor.session.commit(Document((make_curve(POINTS, family=QUINTIC_HERMITE),)), "Begin")
    editor.show_dock("curveDock")
    button = editor.window.findChild(QToolButton, "resetAllToEstimated")
    assert not button.isVisible()
    document = point_edits.set_velocity(editor.session.document, 0, 2, (3.0, 4.0))
    editor.session.commit(point_edits.set_derivative(document, 0, 5, 2, (5.0, 6.0)), "Set")
    assert (button.isVisible(), button.text()) == (True, "Reset All to Estimate")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert all(point.velocity is None and point.acceleration is None for point in editor.curve.points)
    assert editor.session.undo_stack.undoText() == "Reset 2 points to estimate"
    assert editor.status == "Reset points 2 and 5 to estimate."
    assert not button.isVisible()


def test_a_reset_keeps_derivatives_beyond_those_of_the_family(editor):
    editor.session.commit(Document((make_curve(POINTS, family=HERMITE),)), "Begin")
    document = point_edits.set_velocity(editor.session.document, 0, 2, (3.0, 4.0))
    editor.session.commit(point_edits.set_derivative(document, 0, 2, 2, (5.0, 6.0)), "Set")
    editor.trigger("resetAllPoints")
    assert editor.curve.points[2].velocity is None
    assert editor.curve.points[2].acceleration == (5.0, 6.0)


# What is wrong


def test_a_problem_is_displayed_with_a_warning_sign(form):
    form.session.commit(point_edits.set_position(form.session.document, 0, 1, POINTS[0]), "Move")
    assert form.message == f"⚠ {form.session.active_view.problem}"
    assert form["curveFacts"].text() == "8\N{NO-BREAK SPACE}points"
    form.session.undo_stack.undo()
    assert form.message == ""


def test_rendering_commits_nothing_and_a_hidden_form_is_not_updated(quintic):
    steps = quintic.session.undo_stack.count()
    quintic.panel.hide()
    quintic.session.preview(rule_edits.set_interval(quintic.session.document, 0, 0.0, 3.0))
    assert quintic["intervalEnd"].text() == "1"
    quintic.panel.show()
    assert quintic["intervalEnd"].text() == "3"
    quintic.session.cancel()
    assert quintic["intervalEnd"].text() == "1"
    assert quintic.session.undo_stack.count() == steps


@pytest.mark.parametrize("mode", [ThemeMode.DARK, ThemeMode.LIGHT])
def test_notes_follow_the_theme(form, qapp, mode):
    theme = apply_theme(qapp, mode)
    for name, colour in (("curveFacts", theme.muted), ("curveProblem", theme.warning)):
        assert form[name].palette().color(form[name].foregroundRole()) == colour


def test_everything_has_a_name_and_a_tooltip(quintic):
    for kind in (QLineEdit, QComboBox, QToolButton):
        for widget in quintic.panel.findChildren(kind):
            assert widget.objectName()
            assert widget.toolTip()
            assert widget.accessibleName()
