"""Lessons in the window: chosen, stepped through, their goals reached with real events."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QDockWidget,
    QLabel,
    QLineEdit,
    QPushButton,
    QSlider,
    QTextBrowser,
    QToolButton,
    QWidget,
)

from app.features.basis.scene import rail_height
from app.features.lessons.commands import LessonCommands
from app.features.lessons.lesson import LessonError, lesson_names, load_lesson, parse_lesson
from app.session import Session
from app.storage.files import load
from app.view_model.analysis.errors import POINT_ERROR
from app.view_model.analysis.goals import result_of
from app.view_model.analysis.laboratory_settings import LaboratorySettings
from app.view_model.analysis.overlays.ensemble import COUNT
from app.view_model.analysis.settings import AnalysisSettings
from app.view_model.curve.curve_view import view_of
from app.window import MainWindow
from app.window.connect import all_actions
from tests.waiting import until

NAMES = lesson_names()
NAMED = {each.name for each in all_actions()}
STEPS = [(name, number) for name in NAMES for number in range(len(load_lesson(name).steps))]


@pytest.mark.parametrize(("name", "number"), STEPS)
def test_what_a_step_names_exists_and_its_goal_is_still_to_be_reached(name, number):
    lesson = load_lesson(name)
    step, document = lesson.steps[number], load(lesson.document)
    assert step.text
    assert {*step.show} <= NAMED
    (curve,) = [curve for curve in document.curves if curve.name == step.curve] or document.curves[:1]
    assert curve.name == step.curve or not step.curve
    if step.goal is not None:
        assert not result_of(step.goal, view_of(curve)).is_met


def find(editor, kind, name):
    return editor.window.findChild(kind, name)


def click(qtbot, widget):
    qtbot.mouseClick(widget, Qt.MouseButton.LeftButton)


def open_step(editor, qtbot, name, number):
    """Open a lesson and press Next so often."""
    editor.window.commands[LessonCommands].open(name)
    for _ in range(number):
        click(qtbot, find(editor, QPushButton, "lessonNext"))


def test_a_lesson_is_chosen_stepped_through_and_left(editor, qtbot):
    editor.trigger("toggleLessons")
    click(qtbot, find(editor, QPushButton, "lesson2"))
    assert [curve.name for curve in editor.session.document.curves] == [
        "In step",
        "Out of step",
        "Careless",
    ]
    assert find(editor, QLabel, "lessonPlace").text() == "1 of 6"
    assert not find(editor, QPushButton, "lessonBack").isEnabled()
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.curve.name == "Out of step"
    assert "uneasy" in find(editor, QTextBrowser, "lessonText").toPlainText()
    click(qtbot, find(editor, QPushButton, "lessonGallery"))
    assert find(editor, QPushButton, "lesson1").isVisible()
    editor.trigger("toggleLessons")
    assert not editor.window.context.docks["lessonsDock"].isVisible()


def test_a_goal_ticks_when_the_curve_meets_it_and_stays_ticked(editor, qtbot):
    open_step(editor, qtbot, "02_three_parameter_sets", 5)
    goal = find(editor, QLabel, "lessonGoal")
    assert "Goal" in goal.text()
    editor.choose_parametrization("chord_length")
    assert "Reached" in goal.text()
    editor.trigger("undo")
    assert "Reached" in goal.text()


def test_a_goal_that_is_measured_follows_the_curve(editor, qtbot):
    open_step(editor, qtbot, "01_basis_functions", 4)
    goal = find(editor, QLabel, "lessonGoal")
    assert "now 29.9" in goal.text()
    editor.choose_parametrization("chebyshev")
    assert "now 2.4" in goal.text()
    assert "✓" in goal.text()


def test_a_goal_names_a_family_as_people_do(editor, qtbot):
    """It was asked for “floater hormann”."""
    open_step(editor, qtbot, "11_runge", 2)
    assert "The family is barycentric rational" in find(editor, QLabel, "lessonGoal").text()


def test_a_step_switches_on_what_it_shows_and_the_next_puts_it_away(editor, qtbot):
    editor.window.commands[LessonCommands].open("01_basis_functions")
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.session.scrub.t is not None
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.session.scrub.t is None


def test_the_functions_that_a_step_speaks_of_are_all_in_sight(editor, qtbot):
    """Of functions that reach from −6.5 to 6.1 those between −0.5 and 1.2 were shown."""
    for number, lowest, highest in ((3, -6.5, 6.1), (2, -0.2, 1.0)):
        open_step(editor, qtbot, "01_basis_functions", number)
        editor.settle()
        shown = editor.window.basis_panel.pixel_map
        assert shown.y(lowest) < shown.height - rail_height(1.0)
        assert shown.y(highest) > 0
        assert editor.window.central["basisPane"].findChild(QWidget, "basisExtent").toolTip() == ""
    open_step(editor, qtbot, "01_basis_functions", 0)
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert shown == editor.window.basis_panel.pixel_map


def test_the_gallery_works_by_keyboard(editor, qtbot):
    editor.trigger("toggleLessons")
    card = find(editor, QPushButton, "lesson3")
    card.setFocus()
    qtbot.keyClick(card, Qt.Key.Key_Space)
    assert editor.curve.name == "Uneven"


# Every goal can be reached, by what its step says


def drag_to_chebyshev(editor):
    editor.choose_parametrization("chebyshev")


def type_chord_lengths(editor):
    points = np.array([(point.x, point.y) for point in editor.curve.points])
    lengths = np.hypot(*np.diff(points, axis=0).T)
    # From the last to the first, and again: each has to lie between its neighbours as they are then.
    rows = list(enumerate(np.cumsum(lengths)[:-1] / lengths.sum(), start=1))[::-1]
    type_missing(editor, [(index, round(t, 3)) for index, t in rows + rows])


def type_missing(editor, rows):
    """Type the parameters that are not there yet."""
    for index, t in rows:
        if editor.parameters[index] != t:
            editor.rail.type(index, f"{t}")


def calm_by_hand(editor):
    type_missing(editor, [*enumerate((0.2, 0.34, 0.48, 0.66, 0.81), start=1)] * 2)


def press_in_legend(editor, name):
    QTest.mouseClick(find(editor, QToolButton, f"legendChoose_{name}"), Qt.MouseButton.LeftButton)
    editor.settle()


def blend_less(editor):
    editor.show_dock("curveDock")
    field = find(editor, QLineEdit, "settingDegree")
    field.setFocus()
    field.selectAll()
    editor.type_text(field, "1")
    QTest.keyClick(field, Qt.Key.Key_Return)


WAYS = {
    ("01_basis_functions", 3): lambda editor: [
        (editor.wheel((2.0, 0.0), -1), editor.add_point(5.5 + k / 2, -1.2)) for k in range(3)
    ],
    ("01_basis_functions", 4): drag_to_chebyshev,
    ("02_three_parameter_sets", 4): calm_by_hand,
    ("02_three_parameter_sets", 5): lambda editor: editor.choose_parametrization("chord_length"),
    ("03_chord_length", 1): lambda editor: editor.choose_parametrization("chord_length"),
    ("03_chord_length", 3): lambda editor: editor.choose_parametrization("centripetal"),
    ("03_chord_length", 4): lambda editor: editor.key(Qt.Key.Key_2),
    ("04_decimal_accuracy", 4): lambda editor: editor.key(Qt.Key.Key_2),
    ("05_sensitivity", 3): drag_to_chebyshev,
    ("05_sensitivity", 4): lambda editor: editor.key(Qt.Key.Key_2),
    ("06_errors_along_t", 3): lambda editor: editor.key(Qt.Key.Key_2),
    ("07_cubic_or_quintic", 4): lambda editor: editor.key(Qt.Key.Key_3),
    ("09_exercise_rounded_parameters", 1): type_chord_lengths,
    ("10_exercise_far_point", 1): type_chord_lengths,
    ("10_exercise_far_point", 3): lambda editor: editor.choose_parametrization("centripetal"),
    ("10_exercise_far_point", 4): lambda editor: editor.key(Qt.Key.Key_2),
    ("11_runge", 2): lambda editor: press_in_legend(editor, "floater_hormann"),
    ("11_runge", 3): blend_less,
}


def test_there_is_a_way_to_every_goal():
    assert set(WAYS) == {(name, k) for name, k in STEPS if load_lesson(name).steps[k].goal is not None}


def move_a_little(index, by):
    def move(editor):
        x, y = editor.point(index)
        editor.drag_point(index, to=(x + by, y + by))

    return move


MOVES = {
    ("01_basis_functions", 2): ("Drag a point", lambda editor: editor.drag_point(2, to=(2.5, 1.0))),
    ("03_chord_length", 2): ("Move point 2 a little", move_a_little(2, 0.2)),
    ("10_exercise_far_point", 2): ("Move one of the near points by very little", move_a_little(1, 0.1)),
}
"""What a step without a goal asks for, in its words."""

WAYS_BACK = {
    ("01_basis_functions", 4): (
        "Take back the points",
        lambda editor: [editor.trigger("undo") for _ in range(3)],
    ),
}
"""What a step asks for first, because of what the one before has left."""


def test_every_goal_is_reached_by_who_does_what_each_step_says(editor, qtbot):
    """In one go: the points that lesson 1 has one append were in the way of its next goal."""
    for name in NAMES:
        open_step(editor, qtbot, name, 0)
        reach_every_goal(editor, qtbot, name)
        editor.session.files.give_up_changes()


def reach_every_goal(editor, qtbot, name):
    for number, step in enumerate(load_lesson(name).steps):
        if number:
            click(qtbot, find(editor, QPushButton, "lessonNext"))
        if any((name, number) in asked for asked in (MOVES, WAYS_BACK, WAYS)):
            editor.fit()
        for asked in (MOVES, WAYS_BACK):
            words, act = asked.get((name, number), ("", lambda _editor: None))
            assert words in step.text
            act(editor)
        if step.goal is None:
            continue
        goal = find(editor, QLabel, "lessonGoal")
        assert "Goal" in goal.text(), (name, number)
        assert "Reached" not in goal.text(), (name, number)
        assert "any more" not in goal.text(), (name, number)
        WAYS[name, number](editor)
        editor.settle()
        assert "Reached" in goal.text(), (name, number, goal.text())


def test_a_goal_waits_for_the_curve_that_it_names(editor, qtbot):
    """With “In step” in hand, which was calm from the start, the goal used to tick."""
    open_step(editor, qtbot, "02_three_parameter_sets", 4)
    goal = find(editor, QLabel, "lessonGoal")
    editor.fit()
    editor.session.selected.activate(0)
    assert "Reached" not in goal.text()
    assert "click on the curve “Careless”" in goal.text()
    editor.choose_parametrization("chord_length")
    editor.session.selected.activate(2)
    editor.choose_parametrization("chord_length")
    assert "another rule makes the parameters now" in goal.text()
    editor.trigger("undo")
    calm_by_hand(editor)
    assert "Reached" in goal.text()


# Work is kept


def place(editor):
    return find(editor, QLabel, "lessonPlace").text()


def test_the_next_lesson_is_a_step_that_undo_takes_back(editor, qtbot):
    """Next Lesson used to drop what the student had done, and Undo with it."""
    open_step(editor, qtbot, "03_chord_length", 3)
    editor.fit()
    editor.drag_point(1, to=(0.6, 0.4))
    editor.choose_parametrization("centripetal")
    assert "Reached" in find(editor, QLabel, "lessonGoal").text()
    work = editor.session.document
    for _ in range(2):
        click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.curve.name == "Eight points"
    assert not editor.session.files.is_modified
    assert editor.message == "What you had before is kept."
    editor.fit()
    editor.drag_point(1, to=(1.3, 1.5))
    assert editor.message == ""
    for _ in range(2):
        editor.trigger("undo")
    editor.trigger("redo")
    editor.trigger("goBack")
    assert editor.session.document is work
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    click(qtbot, find(editor, QToolButton, "offeredAction"))
    editor.settle()
    assert editor.session.document is work
    assert editor.session.files.is_modified
    assert place(editor) == "5 of 5"
    assert not editor.action("toggleLaboratory").isChecked()
    assert editor.window.canvas.framing.shows_all_points
    click(qtbot, find(editor, QPushButton, "lessonBack"))
    assert "Reached" in find(editor, QLabel, "lessonGoal").text()
    assert editor.session.document is work
    editor.trigger("redo")
    assert editor.curve.name == "Eight points"
    assert place(editor) == "1 of 5"
    assert editor.action("toggleLaboratory").isChecked()


def test_work_is_kept_whatever_is_opened_next(editor, qtbot):
    """From the list of lessons, which asked with a dialog; an example; and the same lesson begun again."""
    session = editor.session
    editor.window.commands[LessonCommands].open("08_cost")

    def from_the_list():
        click(qtbot, find(editor, QPushButton, "lessonGallery"))
        click(qtbot, find(editor, QPushButton, "lesson2"))

    def again():
        click(qtbot, find(editor, QPushButton, "lessonAgain"))

    def example():
        editor.window.menus.examples.actions()[0].trigger()

    for open_next in (from_the_list, again, example):
        editor.fit()
        x, y = editor.point(0)
        editor.drag_point(0, to=(x + 0.3, y + 0.2))
        work, lesson = session.document, place(editor)
        open_next()
        editor.settle()
        assert session.document.curves != work.curves
        assert not session.files.is_modified
        editor.trigger("undo")
        assert session.document is work
        assert place(editor) == lesson


def test_a_lesson_that_nothing_was_done_in_leaves_no_trace(editor, qtbot):
    editor.window.commands[LessonCommands].open("08_cost")
    editor.window.commands[LessonCommands].open("07_cubic_or_quintic")
    assert editor.session.undo_stack.count() == 0
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    click(qtbot, find(editor, QPushButton, "lessonAgain"))
    assert place(editor) == "1 of 5"
    assert editor.message == ""


def test_a_lesson_begins_with_a_clear_desk(editor, qtbot):
    """What lesson 5 and 6 had switched on used to stay on in lesson 8."""
    editor.window.commands[LessonCommands].open("06_errors_along_t")
    editor.window.analysis.set_value(COUNT, 7)
    editor.window.analysis.change(laboratory=LaboratorySettings(on=True, shift=100.0))
    editor.trigger("overlayEnsemble")
    editor.drag_point(1, to=(1.2, 1.5))
    editor.window.commands[LessonCommands].open("01_basis_functions")
    assert editor.window.analysis.settings == AnalysisSettings()
    assert not editor.action("toggleLaboratory").isChecked()
    assert not editor.action("plotErrors").isChecked()
    assert editor.curve.name == "Five points"


def test_a_step_sets_the_numbers_it_speaks_of(editor, qtbot):
    editor.window.commands[LessonCommands].open("04_decimal_accuracy")
    laboratory = editor.window.analysis.settings.laboratory
    assert (laboratory.on, laboratory.digits, len(laboratory.methods)) == (True, 16, 5)
    editor.window.commands[LessonCommands].open("05_sensitivity")
    assert editor.window.analysis.settings.value(POINT_ERROR) == 0.03


def test_the_end_of_a_lesson_leads_to_the_next(editor, qtbot):
    open_step(editor, qtbot, "08_cost", 3)
    assert editor.curve.name == "Equal steps"
    assert find(editor, QLabel, "lessonPlace").text() == "1 of 4"
    open_step(editor, qtbot, NAMES[-1], 4)
    assert not find(editor, QPushButton, "lessonNext").isEnabled()


def test_another_document_ends_the_lesson(editor, qtbot):
    editor.window.commands[LessonCommands].open("08_cost")
    assert find(editor, QLabel, "lessonPlace").isVisible()
    editor.session.new()
    assert find(editor, QPushButton, "lesson1").isVisible()


@pytest.mark.parametrize("settings", ["digits", "digits many", "colour 3"])
def test_a_setting_that_is_none_is_refused(settings):
    with pytest.raises(LessonError, match="step 1"):
        parse_lesson(f"# T\n## A\n<!-- set: {settings} -->\nb", "some", Path("some.curve.json"))


def test_a_lesson_can_be_presented_with_its_laboratory_and_larger_type(editor, qtbot):
    editor.window.commands[LessonCommands].open("04_decimal_accuracy")
    editor.settle()
    text, slider = find(editor, QTextBrowser, "lessonText"), find(editor, QSlider, "digitsSlider")
    before = text.font().pointSizeF()
    editor.trigger("presentation")
    assert text.isVisible()
    assert slider.isVisible()
    assert not editor.window.point_table.isVisible()
    editor.trigger("enlarge")
    assert text.font().pointSizeF() == pytest.approx(1.25 * before)
    editor.trigger("usualSize")
    assert text.font().pointSizeF() == before
    editor.trigger("presentation")
    assert editor.window.point_table.isVisible()


def test_the_laboratory_comes_when_it_is_called_in_a_presentation(editor, qtbot):
    editor.trigger("toggleLaboratory")
    editor.trigger("presentation")
    dock = find(editor, QDockWidget, "laboratoryDock")
    assert not dock.isVisible()
    editor.trigger("toggleLaboratory")
    assert dock.isVisible()
    editor.trigger("toggleLaboratory")
    assert not dock.isVisible()
    editor.trigger("presentation")


@pytest.mark.parametrize("is_shown_first", [True, False], ids=["as the command line", "before the window"])
def test_a_start_with_a_lesson_shows_all_of_its_functions(qtbot, is_shown_first):
    """What fits the window when it is first shown took the range back: −0.5 to 1.2 of −1.3 to 1.3."""
    window = MainWindow(Session())
    qtbot.addWidget(window)
    if is_shown_first:
        window.show()
    window.commands[LessonCommands].open("03_chord_length")
    window.show()
    qtbot.waitExposed(window)
    until(lambda: not [each for each in window.children() if type(each).__name__ == "_FirstShow"])
    assert window.context.docks["lessonsDock"].isVisible()
    low, high = window.basis_panel.drawing.basis.extent(frozenset((0, 1, 2)))
    _, bottom, _, top = window.basis_panel.pixel_map.box
    assert low < -0.5
    assert bottom < low < high < top
    assert window.findChild(QLabel, "lessonPlace").text() == "1 of 5"
