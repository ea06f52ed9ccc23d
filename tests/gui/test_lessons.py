"""Lessons in the window: chosen, stepped through, their goals reached with real events."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QDockWidget,
    QLabel,
    QLineEdit,
    QPushButton,
    QSlider,
    QTabWidget,
    QTextBrowser,
    QToolButton,
    QWidget,
)

from app.families import FAMILIES
from app.features.basis.scene import rail_height
from app.features.lessons.commands import LessonCommands
from app.features.lessons.lesson import LessonError, lesson_code, lesson_names, load_lesson, parse_lesson
from app.session import Session
from app.storage.files import load
from app.storage.resources import resource
from app.testing import Editor
from app.view_model.analysis.goals import result_of
from app.view_model.analysis.overlay import POINT_ERROR
from app.view_model.analysis.overlays.ensemble import COUNT
from app.view_model.analysis.settings import AnalysisSettings, LaboratorySettings
from app.view_model.curve.curve_view import view_of
from app.view_model.point_columns import COLUMNS
from app.window import MainWindow
from app.window.connect import all_actions
from tests.waiting import until

NAMES = lesson_names()
NAMED = {each.name for each in all_actions()}
STEPS = [(name, number) for name in NAMES for number in range(len(load_lesson(name).steps))]


def test_quotes_of_the_window_in_lessons_are_true(editor, qtbot):
    """In *italics* or **bold**: actions, menus, panels, boxes and what they offer, families and rules."""
    for dock in editor.window.context.docks.side:
        editor.show_dock(dock.objectName())
    open_step(editor, qtbot, "04_decimal_accuracy", 0)
    window = editor.window
    known = {each.text for each in all_actions()} | {each.text() for each in window.findChildren(QAction)}
    known |= {f"{each.section.menu.title} › {each.section.submenu}" for each in all_actions()}
    known |= {dock.windowTitle() for dock in window.findChildren(QDockWidget)}
    known |= {each.text() for kind in (QLabel, QAbstractButton) for each in window.findChildren(kind)}
    known |= {tabs.tabText(row) for tabs in window.findChildren(QTabWidget) for row in range(tabs.count())}
    known |= {box.itemText(row) for box in window.findChildren(QComboBox) for row in range(box.count())}
    known |= {title for each in FAMILIES for title in (each.title, each.full_title, f"cubic {each.title}")}
    known |= {column.name for column in COLUMNS}
    known |= {setting.title for each in FAMILIES for setting in each.curve_class.settings}
    words = {text.replace("&", "").replace("\n", " ").casefold() for text in known} | {"explain this wiggle"}
    for name in NAMES:
        for step in load_lesson(name).steps:
            quotes = {quote.casefold() for quote in re.findall(r"\*{1,2}([^*]+)\*{1,2}", step.text)}
            assert quotes - words == set(), f"{name}: {step.title}"


@pytest.mark.parametrize(("name", "number"), STEPS)
def test_actions_and_curves_of_a_step_exist_and_its_goal_is_not_reached_yet(name, number):
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


def test_a_lesson_is_started_stepped_through_and_left(editor, qtbot):
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


def test_a_goal_is_ticked_when_the_curve_meets_it_and_stays_ticked(editor, qtbot):
    open_step(editor, qtbot, "02_three_parameter_sets", 5)
    goal = find(editor, QLabel, "lessonGoal")
    assert "Goal" in goal.text()
    editor.choose_parametrization("chord_length")
    assert "Reached" in goal.text()
    editor.trigger("undo")
    assert "Reached" in goal.text()


def test_a_measured_goal_follows_the_curve(editor, qtbot):
    open_step(editor, qtbot, "01_basis_functions", 4)
    goal = find(editor, QLabel, "lessonGoal")
    assert "now 29.9" in goal.text()
    editor.choose_parametrization("chebyshev")
    assert "now 2.4" in goal.text()
    assert "✓" in goal.text()


def test_a_goal_names_a_family_by_its_title(editor, qtbot):
    """It was asked for “floater hormann”."""
    open_step(editor, qtbot, "11_runge", 2)
    assert "The family is barycentric rational" in find(editor, QLabel, "lessonGoal").text()


def test_a_step_switches_actions_on_and_the_next_step_off(editor, qtbot):
    editor.window.commands[LessonCommands].open("01_basis_functions")
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.session.scrub.t is not None
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    assert editor.session.scrub.t is None


def test_all_functions_of_a_step_are_visible(editor, qtbot):
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


# Every step does what it says


class Student(Editor):
    """Editor with what the steps of lessons ask for, by real events: see ``do_step_N`` in a ``lesson.py``."""

    def press_key(self, text):
        self.key(QKeySequence(text)[0].key())

    def type_parameters(self, values):
        """Type all inner parameters, twice: each has to lie between its neighbours as they are then."""
        for index, t in [*enumerate(values, start=1)] * 2:
            if self.parameters[index] != t:
                self.rail.type(index, f"{t}")

    def type_chord_lengths(self):
        """Type chord lengths with three decimals, from the last to the first, twice."""
        points = np.array([(point.x, point.y) for point in self.curve.points])
        lengths = np.hypot(*np.diff(points, axis=0).T)
        rows = list(enumerate(np.cumsum(lengths)[:-1] / lengths.sum(), start=1))[::-1]
        for index, t in rows + rows:
            if self.parameters[index] != round(t, 3):
                self.rail.type(index, f"{round(t, 3)}")

    def choose_in_legend(self, family):
        button = find(self, QToolButton, f"legendChoose_{family}")
        QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        self.settle()

    def type_setting(self, name, text):
        self.show_dock("curveDock")
        field = find(self, QLineEdit, f"setting{name.capitalize()}")
        field.setFocus()
        field.selectAll()
        self.type_text(field, text)
        QTest.keyClick(field, Qt.Key.Key_Return)


@pytest.fixture
def student(editor):
    return Student.on(editor.window)


def functions_of(name):
    """Return the functions ``do_step_N`` and ``reach_goal_N`` of a lesson by name."""
    code = vars(lesson_code(resource("lessons", name)) or SimpleNamespace())
    return {key: code[key] for key in code if key.startswith(("do_step_", "reach_goal_"))}


@pytest.mark.parametrize("name", NAMES)
def test_every_goal_has_a_function_that_reaches_the_goal_and_quotes_the_step(name):
    steps, functions = load_lesson(name).steps, functions_of(name)
    with_goals = {f"reach_goal_{number}" for number, step in enumerate(steps, start=1) if step.goal}
    reaching = {key for key in functions if key.startswith("reach_goal_")}
    assert reaching == with_goals, f"resources/lessons/{name}/lesson.py needs one function for each goal"
    for key, function in functions.items():
        step = steps[int(key.rpartition("_")[2]) - 1]
        assert function.__doc__.rstrip(".").casefold() in step.text.casefold(), key


def test_following_the_steps_of_a_lesson_reaches_every_goal(student, qtbot):
    """In one go: the points that lesson 1 has one append were in the way of its next goal."""
    for name in NAMES:
        open_step(student, qtbot, name, 0)
        reach_every_goal(student, qtbot, name)
        student.session.files.give_up_changes()


def reach_every_goal(student, qtbot, name):
    functions = functions_of(name)
    for number, step in enumerate(load_lesson(name).steps, start=1):
        if number > 1:
            click(qtbot, find(student, QPushButton, "lessonNext"))
        do_step, reach_goal = (functions.get(f"{key}_{number}") for key in ("do_step", "reach_goal"))
        if do_step or reach_goal:
            student.fit()
        if do_step:
            do_step(student)
        if step.goal is None:
            continue
        goal = find(student, QLabel, "lessonGoal")
        assert "Goal" in goal.text(), (name, number)
        assert "Reached" not in goal.text(), (name, number)
        assert "have changed" not in goal.text(), (name, number)
        assert reach_goal is not None, f"resources/lessons/{name}/lesson.py has no reach_goal_{number}"
        reach_goal(student)
        student.settle()
        assert "Reached" in goal.text(), (name, number, goal.text())


def test_a_goal_waits_for_its_named_curve(student, qtbot):
    """With “In step” in hand, which was calm from the start, the goal used to tick."""
    open_step(student, qtbot, "02_three_parameter_sets", 4)
    goal = find(student, QLabel, "lessonGoal")
    student.fit()
    student.session.selected.activate(0)
    assert "Reached" not in goal.text()
    assert "Click the curve “Careless”" in goal.text()
    student.choose_parametrization("chord_length")
    student.session.selected.activate(2)
    student.choose_parametrization("chord_length")
    assert "the rule for the parameters has changed" in goal.text()
    student.trigger("undo")
    student.type_parameters([0.2, 0.34, 0.48, 0.66, 0.81])
    assert "Reached" in goal.text()


# Work is kept


def position_text(editor):
    return find(editor, QLabel, "lessonPlace").text()


def test_undo_returns_from_the_next_lesson(editor, qtbot):
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
    assert editor.message == "Your previous work is kept."
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
    assert position_text(editor) == "5 of 5"
    assert not editor.action("toggleLaboratory").isChecked()
    assert editor.window.canvas.framing.shows_all_points
    click(qtbot, find(editor, QPushButton, "lessonBack"))
    assert "Reached" in find(editor, QLabel, "lessonGoal").text()
    assert editor.session.document is work
    editor.trigger("redo")
    assert editor.curve.name == "Eight points"
    assert position_text(editor) == "1 of 5"
    assert editor.action("toggleLaboratory").isChecked()


def test_opening_another_document_saves_the_work_of_a_lesson(editor, qtbot):
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
        work, lesson = session.document, position_text(editor)
        open_next()
        editor.settle()
        assert session.document.curves != work.curves
        assert not session.files.is_modified
        editor.trigger("undo")
        assert session.document is work
        assert position_text(editor) == lesson


def test_an_unchanged_lesson_leaves_no_undo_step(editor, qtbot):
    editor.window.commands[LessonCommands].open("08_cost")
    editor.window.commands[LessonCommands].open("07_cubic_or_quintic")
    assert editor.session.undo_stack.count() == 0
    click(qtbot, find(editor, QPushButton, "lessonNext"))
    click(qtbot, find(editor, QPushButton, "lessonAgain"))
    assert position_text(editor) == "1 of 5"
    assert editor.message == ""


def test_a_lesson_begins_with_all_analysis_off(editor, qtbot):
    """What lesson 5 and 6 had switched on used to stay on in lesson 8."""
    editor.window.commands[LessonCommands].open("06_errors_along_t")
    editor.window.analysis.set_value(COUNT, 7)
    editor.window.analysis.change(laboratory=LaboratorySettings(on=True, shift=100.0))
    editor.trigger("overlayEnsemble")
    editor.fit()
    editor.drag_point(1, to=(1.2, 1.5))
    editor.window.commands[LessonCommands].open("01_basis_functions")
    assert editor.window.analysis.settings == AnalysisSettings()
    assert not editor.action("toggleLaboratory").isChecked()
    assert not editor.action("plotErrors").isChecked()
    assert editor.curve.name == "Five points"


def test_a_step_sets_the_numbers_of_its_text(editor, qtbot):
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
def test_an_unknown_or_bad_setting_is_refused(settings):
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


def test_the_laboratory_can_be_opened_in_a_presentation(editor, qtbot):
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
