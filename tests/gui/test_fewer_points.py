"""Fit to Fewer Points: a curve of few points near the active one, shown before it takes its place."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox

from app.document.model import Document, make_curve
from app.families import FAMILIES
from app.features.fitting.commands import FitCommands
from app.tasks.task import SETTLE_MS
from tests.gui.editor_facts import retype
from tests.waiting import until

X = np.linspace(0.0, 6.0, 400)
ROWS = np.stack([X, np.sin(X)], axis=1)


@pytest.fixture
def editor(editor):
    many = make_curve([tuple(row) for row in ROWS.tolist()], family=FAMILIES.named("hermite"))
    editor.session.change("Import", lambda _: Document((many,)))
    # That it waits for the hand to rest is asked of DebouncedTask.
    timer = editor.window.commands[FitCommands]._task._timer
    timer.setInterval(0)
    yield editor
    timer.setInterval(SETTLE_MS)
    # The form goes on with what was given last.
    if (form := panel(editor)) is not None:
        form.goal.setCurrentIndex(0)


def panel(editor):
    return editor.window.findChild(object, "fitPanel")


def opened(editor):
    editor.trigger("fitFewerPoints")
    editor.wait_for_rest()
    return panel(editor)


def wait(editor):
    until(panel(editor).apply_button.isEnabled)


def test_a_fit_is_previewed_and_then_replaces_the_curve(editor):
    before = editor.session.document
    form = opened(editor)
    wait(editor)
    assert editor.session.document is before
    assert form.result.text().startswith("400 points become ")
    groups = editor.window.canvas.drawing.annotations.trace_layer.groups
    assert len(groups["fewer_points"][0]) == 2
    QTest.mouseClick(form.apply_button, Qt.MouseButton.LeftButton)
    curve = editor.session.active_curve
    assert len(curve.points) < 10
    assert curve.name == before.curves[0].name
    core = editor.session.active_view.curve
    gaps = np.linalg.norm(ROWS[:, None] - core.evaluate(np.linspace(*core.domain, 4000))[None], axis=2).min(
        axis=1
    )
    assert gaps.max() <= form.tolerance.value() + 1e-3
    assert editor.session.undo_stack.undoText() == "Fit to fewer points"
    assert "fewer_points" not in groups
    editor.trigger("undo")
    assert editor.session.document == before


def test_cancel_leaves_no_trace(editor):
    before, count = editor.session.document, editor.session.undo_stack.count()
    form = opened(editor)
    wait(editor)
    QTest.mouseClick(form.cancel_button, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.session.document is before
    assert editor.session.undo_stack.count() == count
    assert "fewer_points" not in editor.window.canvas.drawing.annotations.trace_layer.groups
    assert not form.isVisible()


def test_number_and_family_are_selected(editor):
    form = opened(editor)
    wait(editor)
    for box, index in ((form.goal, 1), (form.family, form.family.findText("Lagrange"))):
        choose(box, index)
    retype(form.count, "9")
    until(lambda: "become 9 points" in form.result.text())
    QTest.mouseClick(form.apply_button, Qt.MouseButton.LeftButton)
    curve = editor.session.active_curve
    assert (curve.family.name, len(curve.points)) == ("lagrange", 9)


def choose(box: QComboBox, index: int) -> None:
    """Choose an entry with the keys."""
    box.setFocus()
    while box.currentIndex() != index:
        QTest.keyClick(box, Qt.Key.Key_Down if box.currentIndex() < index else Qt.Key.Key_Up)


def test_impossible_fits_are_explained(editor):
    form = opened(editor)
    wait(editor)
    choose(form.goal, 1)
    retype(form.count, "900")
    assert form.result.text() == "Points: from 2 to 500."
    assert not form.apply_button.isEnabled()


def test_another_curve_is_fitted_when_the_curve_changes(editor):
    form = opened(editor)
    wait(editor)
    few = make_curve([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)], family=FAMILIES.named("hermite"))
    editor.session.change("Other", lambda _: Document((few,)))
    assert not form.apply_button.isEnabled()
    until(lambda: form.result.text().startswith("3 points become "))


@pytest.fixture
def long_fit(editor):
    """An editor that is fitting a curve of 4000 points that follow errors."""
    x = np.linspace(0.0, 6.0, 4000)
    rows = np.stack([x, np.sin(x)], axis=1) + 0.01 * np.random.default_rng(2).normal(size=(4000, 2))
    many = make_curve([tuple(row) for row in rows.tolist()], family=FAMILIES.named("hermite"))
    editor.session.change("Import", lambda _: Document((many,)))
    form = opened(editor)
    retype(form.tolerance, "0.02")
    return editor


def test_escape_ends_a_fit_as_cancel_does(long_fit):
    editor, form = long_fit, panel(long_fit)
    for place in ("tolerance", "family", "cancel_button", "canvas"):
        if not form.isVisible():
            form = opened(editor)
            retype(form.tolerance, "0.02")
        choose(form.family, form.family.findText("B-spline"))
        before = editor.session.document
        widget = editor.window.canvas if place == "canvas" else getattr(form, place)
        widget.setFocus()
        assert form.progress.isVisible(), place
        QTest.keyClick(widget, Qt.Key.Key_Escape)
        editor.settle()
        assert not form.isVisible(), place
        assert editor.session.document is before, place
        assert "fewer_points" not in editor.window.canvas.drawing.annotations.trace_layer.groups, place


@pytest.mark.parametrize("place", ["tolerance", "canvas"])
def test_escape_discards_a_result(editor, place):
    form = opened(editor)
    wait(editor)
    before = editor.session.document
    widget = editor.window.canvas if place == "canvas" else form.tolerance
    widget.setFocus()
    QTest.keyClick(widget, Qt.Key.Key_Escape)
    editor.settle()
    assert not form.isVisible()
    assert editor.session.document is before
    assert "fewer_points" not in editor.window.canvas.drawing.annotations.trace_layer.groups


def test_the_number_of_points_suits_the_curve(editor):
    form = opened(editor)
    wait(editor)
    choose(form.goal, 1)
    assert form.count.value() == max(len(editor.curve.points) // 2, 2)
    wait(editor)
    assert form.apply_button.isEnabled()


@pytest.mark.parametrize("name", ["lagrange", "hermite"])
def test_a_deviation_measured_only_at_the_points_is_stated_as_such(editor, name):
    wave = [(k, np.sin(k).item()) for k in range(12)]
    curve = make_curve(wave, family=FAMILIES.named(name))
    editor.session.change("Wave", lambda _: Document((curve,)))
    form = opened(editor)
    wait(editor)
    is_said = form.result.text().endswith("Measured at the points, not between them.")
    assert is_said is (name == "lagrange")


def test_data_with_large_scatter_give_a_remark(long_fit):
    form = panel(long_fit)
    until(form.apply_button.isEnabled)
    text = form.result.text()
    assert " largest deviation stays at 0.0" in text
    assert text.endswith("The data scatter this much; more points would only follow the noise.")
    QTest.mouseClick(form.apply_button, Qt.MouseButton.LeftButton)
    assert len(long_fit.session.active_curve.points) <= 12
