"""Settings of a family in the form of the curve: typed, dragged, stepped, chosen, undone."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QSlider, QWidget

from app.document.model import Document, make_curve
from app.families import FAMILIES, LAGRANGE, FamilySetting
from app.features.curve_settings.panel import NumberField
from tests.own_families import EVERY

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0))

pytestmark = pytest.mark.usefixtures("own_families_in_windows")


@pytest.fixture
def swaying(editor):
    curve = make_curve(POINTS, family=FAMILIES.named("tests_swaying"))
    editor.session.commit(Document((curve,)), "Begin")
    editor.show_dock("curveDock")
    return editor


def widget(editor, kind, name):
    found = editor.window.findChild(kind, name)
    assert found is not None
    assert found.isVisible()
    return found


def amount(editor):
    return widget(editor, QLineEdit, "settingAmount")


def slider(editor):
    return widget(editor, QSlider, "settingAmountSlider")


def enter(editor, field, text, key=Qt.Key.Key_Return):
    field.setFocus()
    field.selectAll()
    editor.type_text(field, text)
    QTest.keyClick(field, key)


def curve_settings(editor):
    return dict(editor.curve.settings)


@pytest.mark.parametrize(
    ("count", "said"),
    [
        (2, "2 points · degree 1 · one polynomial · 0 ≤ t ≤ 1"),
        (5, "5 points · degree 4 · one polynomial · 0 ≤ t ≤ 1"),
        (6, "6 points · rational, blended degree 3 · 0 ≤ t ≤ 1"),
    ],
)
def test_the_form_describes_a_rational_curve(editor, count, said):
    """It said "no polynomial", of few points too, where the curve is one."""
    points = [(float(k), float(k % 2)) for k in range(count)]
    curve = make_curve(points, family=FAMILIES.named("floater_hormann"))
    editor.session.commit(Document((curve,)), "Begin")
    editor.show_dock("curveDock")
    facts = widget(editor, QLabel, "curveFacts")
    assert facts.text().replace("\N{NO-BREAK SPACE}", " ") == said
    enter(editor, widget(editor, QLineEdit, "settingDegree"), "0")
    is_one = "one polynomial" in facts.text().replace("\N{NO-BREAK SPACE}", " ")
    assert is_one == (count == 2)


def test_a_number_is_typed_and_undone(swaying):
    steps = swaying.session.undo_stack.count()
    assert amount(swaying).text() == "2"
    enter(swaying, amount(swaying), "7")
    assert curve_settings(swaying) == {"amount": 7}
    assert swaying.session.active_view.curve.chosen["amount"] == 7
    assert swaying.session.undo_stack.count() == steps + 1
    assert swaying.session.undo_stack.undoText() == "Set amount of sway to 7"
    assert slider(swaying).value() == 7
    swaying.trigger("undo")
    assert curve_settings(swaying) == {}
    assert amount(swaying).text() == "2"
    assert slider(swaying).value() == 2
    swaying.trigger("redo")
    assert amount(swaying).text() == "7"


@pytest.mark.parametrize("text", ["10", "-1", "2.5"])
def test_a_number_that_cannot_be_is_refused_and_stays_to_be_mended(swaying, text):
    steps = swaying.session.undo_stack.count()
    enter(swaying, amount(swaying), text)
    problem = widget(swaying, QLabel, "curveProblem").text()
    assert problem == "⚠ Amount of sway must be a whole number from 0 to 9."
    assert amount(swaying).text() == text
    assert swaying.session.undo_stack.count() == steps
    QTest.keyClick(amount(swaying), Qt.Key.Key_Escape)
    assert amount(swaying).text() == "2"


def test_a_text_that_is_no_number_is_refused(swaying):
    enter(swaying, amount(swaying), "few")
    assert widget(swaying, QLabel, "curveProblem").text().startswith("⚠ ")
    assert curve_settings(swaying) == {}


def test_the_slider_is_live_one_step_and_cancellable(swaying):
    handle, document = slider(swaying), swaying.session.document
    steps = swaying.session.undo_stack.count()
    handle.setSliderDown(True)
    handle.setSliderPosition(8)
    assert swaying.session.active_view.curve.chosen["amount"] == 8
    swaying.wait_for_rest()
    assert amount(swaying).text() == "8"
    assert swaying.window.canvas.drawing.curve.ghost_opacity == 1
    QTest.keyClick(handle, Qt.Key.Key_Escape)
    assert swaying.session.document is document
    swaying.settle()
    assert handle.value() == 2
    handle.setSliderDown(False)
    handle.setSliderDown(True)
    handle.setSliderPosition(6)
    handle.setSliderPosition(4)
    handle.setSliderDown(False)
    assert curve_settings(swaying) == {"amount": 4}
    assert swaying.session.undo_stack.count() == steps + 1


def test_the_slider_is_stepped(swaying):
    handle = slider(swaying)
    handle.setFocus()
    QTest.keyClick(handle, Qt.Key.Key_Right)
    assert curve_settings(swaying) == {"amount": 3}
    QTest.keyClick(handle, Qt.Key.Key_Left)
    assert curve_settings(swaying) == {}


@pytest.fixture
def spline(editor):
    curve = make_curve(POINTS, family=FAMILIES.named("cardinal_spline"))
    editor.session.commit(Document((curve,)), "Begin")
    editor.show_dock("curveDock")
    return editor


def test_a_real_setting_is_typed_and_undone(spline):
    tension = widget(spline, QLineEdit, "settingTension")
    handle = widget(spline, QSlider, "settingTensionSlider")
    assert (tension.text(), handle.value(), handle.maximum()) == ("0", 20, 40)
    assert tension.toolTip() == "0: Catmull-Rom; 1: rests in every point (−1 to 1, Enter to set)"
    enter(spline, tension, "-1/3")
    assert curve_settings(spline) == {"tension": -1 / 3}
    assert spline.session.active_view.curve.chosen == {"tension": -1 / 3}
    assert spline.session.undo_stack.undoText() == "Set tension to −0.333333"
    assert handle.value() == 13
    spline.window.canvas.setFocus()
    assert tension.text() == "−0.3333"
    spline.trigger("undo")
    assert curve_settings(spline) == {}
    assert tension.text() == "0"


def test_a_real_setting_outside_of_its_limits_is_refused(spline):
    enter(spline, widget(spline, QLineEdit, "settingTension"), "1.5")
    problem = widget(spline, QLabel, "curveProblem").text()
    assert problem == "⚠ Tension must be a number from −1 to 1."
    assert curve_settings(spline) == {}


def test_the_slider_of_a_real_setting_moves_by_its_step_and_a_drag_is_one_step(spline):
    handle = widget(spline, QSlider, "settingTensionSlider")
    handle.setFocus()
    for tension in (0.05, 0.1, 0.15):
        QTest.keyClick(handle, Qt.Key.Key_Right)
        assert curve_settings(spline) == {"tension": tension}
    steps = spline.session.undo_stack.count()
    handle.setSliderDown(True)
    handle.setSliderPosition(40)
    assert spline.session.active_view.curve.chosen == {"tension": 1.0}
    assert np.abs(spline.session.active_view.curve.evaluate(0.0, 1)).max() < 1e-9
    handle.setSliderPosition(0)
    handle.setSliderDown(False)
    assert curve_settings(spline) == {"tension": -1.0}
    assert spline.session.undo_stack.count() == steps + 1
    assert spline.session.undo_stack.undoText() == "Set tension to −1"


@pytest.mark.parametrize(
    ("default", "limits", "step", "values"),
    [
        (0.0, (0.0, 1.0), 0.3, [0.0, 0.3, 0.6, 0.9, 1.0]),
        (0.5, (-1.0, 1.0), 0.5, [-1.0, -0.5, 0.0, 0.5, 1.0]),
        (2, (1, 4), None, [1, 2, 3, 4]),
        (4, (0, 9), 4, [0, 4, 8, 9]),
    ],
)
def test_a_slider_reaches_both_limits_by_steps_of_the_setting(editor, default, limits, step, values):
    setting = FamilySetting("amount", "amount", default, "How much", limits=limits, step=step)
    field = NumberField(setting, limits)
    field.row.setParent(None)
    assert [field.value_at(position) for position in range(field.slider.maximum() + 1)] == values
    for position, value in enumerate(values):
        field.render_value(value)
        assert field.slider.value() == position
        assert type(field.value_at(position)) is type(default)
    field.edit.deleteLater()
    field.slider.deleteLater()


def test_a_choice_setting_is_selected_and_undone(swaying):
    box = widget(swaying, QComboBox, "settingFirstSide")
    assert [box.itemText(row) for row in range(box.count())] == ["Left", "Right"]
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Down)
    assert curve_settings(swaying) == {"first_side": "right"}
    assert swaying.session.undo_stack.undoText() == "Set first side to Right"
    swaying.trigger("undo")
    assert curve_settings(swaying) == {}
    assert box.currentText() == "Left"


def test_the_form_has_the_fields_of_the_family(swaying):
    swaying.choose_family(LAGRANGE)
    assert swaying.window.findChild(QLineEdit, "settingAmount") is None
    swaying.trigger("undo")
    enter(swaying, amount(swaying), "5")
    assert curve_settings(swaying) == {"amount": 5}
    assert slider(swaying).value() == 5


def test_going_back_to_the_family_gives_the_same_curve_back(swaying):
    enter(swaying, amount(swaying), "7")
    before = swaying.session.active_view.curve.evaluate(0.3)
    swaying.choose_family(LAGRANGE)
    swaying.choose_family("tests_swaying")
    assert curve_settings(swaying) == {"amount": 7}
    assert (swaying.session.active_view.curve.evaluate(0.3) == before).all()
    swaying.settle()
    assert amount(swaying).text() == "7"


def test_a_refusal_after_a_change_of_family_accesses_no_deleted_field(swaying):
    enter(swaying, amount(swaying), "5")
    swaying.choose_family(LAGRANGE)
    start = widget(swaying, QLineEdit, "intervalStart")
    enter(swaying, start, "2")
    assert widget(swaying, QLabel, "curveProblem").text()


def test_a_new_curve_has_the_settings(swaying):
    enter(swaying, amount(swaying), "5")
    swaying.trigger("newCurve")
    assert curve_settings(swaying) == {"amount": 5}


def test_settings_are_saved_and_opened(swaying, tmp_path):
    enter(swaying, amount(swaying), "5")
    path = tmp_path / "sway.curve.json"
    swaying.session.save(path)
    swaying.session.new()
    swaying.session.open(path)
    swaying.settle()
    assert curve_settings(swaying) == {"amount": 5}
    assert amount(swaying).text() == "5"


def test_every_setting_of_every_family_has_a_field_with_a_tip(editor):
    for name in EVERY:
        family = FAMILIES.named(name)
        editor.session.commit(Document((make_curve(POINTS, family=family),)), "Begin")
        editor.show_dock("curveDock")
        for setting in family.settings.all:
            words = "".join(word.capitalize() for word in setting.name.split("_"))
            field = widget(editor, QWidget, f"setting{words}")
            assert field.accessibleName() == setting.label, (name, setting.name)
            assert field.toolTip().startswith(setting.tip), (name, setting.name)
