"""Families that only the tests have, in the window: drawn, dragged, typed, undone, saved, shown in every way.

They are two files as a person writes them, with nothing but a basis: one smooth that reaches everywhere, one
with breaks. The built-in families go the same way.
"""

from __future__ import annotations

import json
import re

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QMenu, QToolBar

from app.appearance.theme import theme_of
from app.document import rule_edits
from app.document.model import Document, ParametrizationKind, make_curve
from app.families import FAMILIES
from app.families.family_file import families_in
from app.features.motion.commands import MotionCommands
from app.tools.tool import TOOLS
from app.view_model.curve.distances import NearestPoint
from tests.own_families import EVERY, OWN, TRUE_BASIS
from tests.waiting import until

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5), (6.0, 2.0))
NO_FILM = ("playMotion", "motionLoop", "motionOnce", "motionPingPong")


pytestmark = pytest.mark.usefixtures("own_families_in_windows")


@pytest.fixture(params=OWN)
def own(request):
    return request.param


@pytest.fixture
def drawn(editor):
    """The editor with six points and a family; it is fitted to the first: the others lie there as well."""
    is_fitted = False

    def draw(name, kind=ParametrizationKind.CHORD_LENGTH):
        nonlocal is_fitted
        document = Document((make_curve(POINTS, family=FAMILIES.named(name)),))
        if kind is not ParametrizationKind.CHORD_LENGTH:
            document = rule_edits.set_parametrization(document, 0, kind, np.linspace(0.0, 1.0, 6).tolist())
        editor.session.commit(document, "Begin")
        if not is_fitted:
            editor.fit()
            is_fitted = True
        return editor

    return draw


def place_of(name):
    """The place in menus, from 1 on."""
    return EVERY.index(name) + 1


def is_true(editor):
    """Whether the curve that the window has is the sum of the functions that the tests know."""
    view = editor.session.active_view
    assert view.is_current
    t = np.linspace(*view.curve.domain, 61)
    if view.source.family.name in TRUE_BASIS:
        truth = TRUE_BASIS[view.source.family.name](t, view.parameters) @ view.points
        return np.abs(view.curve.evaluate(t) - truth).max() < 1e-12 * max(1.0, np.abs(view.points).max())
    return np.array_equal(view.curve.evaluate(view.parameters), view.points)


def colours_along(editor):
    """The share of places along the curve at which its ink is seen on the canvas."""
    canvas, view = editor.window.canvas, editor.session.active_view
    image = canvas.grab().toImage()
    ink = theme_of(canvas.palette()).ink
    seen = 0
    places = view.curve.evaluate(np.linspace(*view.curve.domain, 101))[1:-1]
    for x, y in places:
        pixel = canvas.to_pixel(float(x), float(y))
        pixel = canvas.viewport().mapTo(canvas, pixel)
        near = [QColor(image.pixel(pixel.x() + dx, pixel.y() + dy)) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        seen += any(abs(each.lightness() - ink.lightness()) < 90 for each in near)
    return seen / len(places)


# Where it is offered


def test_a_family_is_offered_in_every_list_of_families(editor):
    toolbar = editor.window.findChild(QToolBar, "mainToolbar")
    further = toolbar.findChild(QMenu, "familiesMenu")
    for place, name in enumerate(EVERY, start=1):
        family = FAMILIES.named(name)
        action = editor.action(family.action_name)
        assert (toolbar.widgetForAction(action) is not None) is (place <= 3)
        assert (action in further.actions()) is (place > 3)
        assert action.text() == family.label
        assert not action.icon().isNull()
        assert action.shortcut().toString() == (str(place) if place <= 9 else "")
        assert editor.action(family.action_name.replace("family", "ghost")).isCheckable()
        assert family.label in editor.find_command(family.label)
    editor.key(Qt.Key.Key_Escape)


def test_the_key_of_a_family_switches_and_undo_switches_back(editor):
    for name in EVERY:
        editor.choose_family("hermite" if name == "lagrange" else "lagrange")
        assert editor.curve.family.name != name
        before = editor.session.document
        key = editor.action(FAMILIES.named(name).action_name).shortcut().toString()
        if place_of(name) <= 9:
            assert key == str(place_of(name)), name
            QTest.keyClicks(editor.window.canvas, key)
        else:
            # There are no more digits.
            assert key == "", name
            editor.choose_family(name)
        editor.settle()
        assert editor.curve.family.name == name, name
        assert editor.action(editor.curve.family.action_name).isChecked(), name
        assert editor.session.undo_stack.undoText() == f"Switch to {FAMILIES.named(name).title}", name
        assert is_true(editor), name
        editor.trigger("undo")
        assert editor.session.document == before, name


# Drawing and dragging


def test_points_of_every_family_are_drawn_one_by_one(editor):
    for name in EVERY:
        editor.new()
        editor.choose_family(name)
        editor.trigger("addTool")
        for index, place in enumerate(((0.2, 0.3), (1.0, 2.0), (2.5, 1.0), (3.5, 2.4)), start=1):
            editor.click(place)
            assert len(editor.curve.points) == index, name
            if index > 1:
                assert is_true(editor), name
        editor.trigger("selectTool")
        editor.fit()
        # Points lie over it here and there.
        assert colours_along(editor) > 0.9, name


def test_a_point_is_dragged_under_every_rule(drawn):
    """Families of files under every one, each of the others under a third; tests/view_model has all."""
    for name in EVERY:
        kinds = list(ParametrizationKind)
        for kind in kinds if name in OWN else kinds[place_of(name) % 3 :: 3]:
            editor = drawn(name, kind)
            editor.drag_point(2, (3.0, 2.0))
            assert editor.point(2) == pytest.approx((3.0, 2.0), abs=2 * editor.pixel), (name, kind)
            assert is_true(editor), (name, kind)
            editor.trigger("undo")
            assert editor.point(2) == POINTS[2], (name, kind)
            assert is_true(editor), (name, kind)


def test_the_drawing_during_a_drag_is_the_curve(drawn):
    for name in EVERY:
        editor = drawn(name)
        editor.press(editor.point(2))
        for step in (2, 5):
            editor.move((2.5 + 0.1 * step, 1.0 + 0.15 * step))
            assert is_true(editor), name
            assert colours_along(editor) > 0.85, name
        editor.escape()
        assert editor.point(2) == POINTS[2], name


def test_several_points_are_turned_scaled_and_nudged(drawn):
    for name in EVERY:
        editor = drawn(name)
        before = editor.session.undo_stack.index()
        editor.select([1, 2, 3])
        editor.drag(editor.grip(1, 1), (5.0, 4.0))
        assert is_true(editor), name
        editor.trigger("rotateSelection")
        editor.type_amount("30")
        editor.key(Qt.Key.Key_Return)
        assert is_true(editor), name
        editor.key(Qt.Key.Key_Right)
        assert is_true(editor), name
        assert editor.session.undo_stack.index() >= before + 3, name


def test_the_curve_is_bent_and_follows_the_pointer(drawn):
    """Under every rule, and once with the key that has derivatives bend alone; test_bend has the others."""
    bends = [(kind, Qt.KeyboardModifier.NoModifier) for kind in ParametrizationKind]
    for name in (*OWN, EVERY[-1]):
        for kind, keys in (*bends, (ParametrizationKind.CHORD_LENGTH, Qt.KeyboardModifier.ControlModifier)):
            editor = drawn(name, kind)
            parameters = editor.parameters
            t = 0.4 * parameters[2] + 0.6 * parameters[3]
            x, y = editor.session.active_view.curve.evaluate(t)
            target = (float(x) + 0.6, float(y) - 0.5)
            editor.bend(t, target, keys=keys)
            assert is_true(editor), (name, kind)
            found = NearestPoint(editor.session.active_view).within(target, 1.0)
            assert found.distance < 1.5 * editor.pixel, (name, kind)
            now = editor.parameters
            assert now[2] < found.parameter < now[3], (name, kind)


def test_parameters_are_dragged_and_typed_on_the_rail(drawn):
    for name in EVERY:
        editor = drawn(name)
        document, is_idle = editor.session.document, editor.session.active_view.curve.idle_parameters[2]
        editor.drag_parameter(2, 0.45)
        if is_idle:
            # It would be a step of the history that changes nothing; one that does something takes it along.
            assert editor.session.document is document, name
            before = editor.parameters
            editor.drag_parameter(len(before) - 1, 0.9)
            assert editor.parameters[-1] == pytest.approx(0.9, abs=0.01), name
            share = (before[2] - before[0]) / (before[-1] - before[0])
            assert editor.parameters[2] == pytest.approx(share * editor.parameters[-1]), name
        else:
            assert editor.parameters[2] == pytest.approx(0.45, abs=0.01), name
        assert editor.curve.is_manual, name
        assert is_true(editor), name
        editor.rail.type(3, "0.7")
        assert editor.parameters[3] == 0.7, name
        assert is_true(editor), name
        editor.scrub(0.6)
        assert editor.session.scrub.t == pytest.approx(0.6, abs=0.01), name


# Reshaping


def test_a_point_is_inserted_on_the_curve_and_the_change_is_reported(drawn, own):
    editor = drawn(own, ParametrizationKind.MANUAL)
    place = editor.session.active_view.curve.evaluate(0.5)
    editor.scrub(0.5)
    scrub = editor.session.scrub.t
    place = editor.session.active_view.curve.evaluate(scrub)
    editor.trigger("insertPoint")
    assert len(editor.curve.points) == 7
    assert editor.point(3) == pytest.approx(place, abs=1e-9)
    assert "shape changed by up to" in editor.status.lower() + editor.message.lower()
    assert is_true(editor)


def test_an_edit_that_cannot_keep_the_shape_is_refused_with_a_sentence(drawn, own):
    editor = drawn(own)
    before = editor.session.document
    editor.scrub(0.5)
    editor.trigger("splitCurve")
    assert f"{FAMILIES.named(own).subject} cannot be split" in editor.status
    if not FAMILIES.named(own).curve_class.can_close:
        editor.trigger("closeCurve")
        assert f"{FAMILIES.named(own).a_curve} does not return smoothly" in editor.status
    assert not editor.action("straightSegment").isEnabled()
    # It used to say that the curve had no segments of its own, of those too that are made of pieces.
    assert "has no velocities at its points" in editor.action("straightSegment").toolTip()
    assert not editor.action("tangentCorner").isEnabled()
    assert editor.session.document == before


def test_a_curve_converted_to_cubics_keeps_the_shape_and_splits(drawn):
    for own in OWN:
        editor = drawn(own)
        before = editor.session.active_view.curve
        editor.trigger("convertToHermite")
        assert editor.curve.family.name == "hermite", own
        assert "Shape changed by up to" in editor.status, own
        t = np.linspace(0.0, 1.0, 301)
        assert np.abs(editor.session.active_view.curve.evaluate(t) - before.evaluate(t)).max() < 1e-3, own
        editor.scrub(0.5)
        editor.trigger("splitCurve")
        assert len(editor.session.document.curves) == 2, own
        editor.trigger("undo")
        editor.trigger("undo")
        assert editor.curve.family.name == own, own


def test_functions_with_rounding_errors_are_drawn_and_measured(drawn):
    """The curve was refused: “must be 1 at parameter 2, not 1.000000008”."""
    editor = drawn("tests_gaussian")
    times = [0.0, 0.2, 0.6 - 1e-7, 0.6, 0.8, 1.0]
    crowded = rule_edits.set_parametrization(editor.session.document, 0, ParametrizationKind.MANUAL, times)
    editor.session.commit(crowded, "Crowd")
    editor.settle()
    assert editor.session.active_view.is_current
    said = editor.window.findChild(QLabel, "basisFindings")
    assert said.isVisible()
    assert re.search(r"B[₀-₉]+\(t[₀-₉]+\) = \S{1,13} instead of [01]\.", said.text())


REFUSING = """import numpy as np

name = "tests_refusing"


def basis(t, parameters):
    if np.diff(parameters).min() < 1e-6:
        raise ValueError("parameters that are nearly equal")
    return np.stack([np.interp(t, parameters, each) for each in np.eye(len(parameters))], axis=1)
"""


def test_a_tick_leads_back_from_parameters_that_the_family_refuses(drawn, tmp_path):
    """The rail used to be empty there, and to say that the rule gave no parameters."""
    path = tmp_path / "refusing.py"
    path.write_text(REFUSING)
    (family,) = families_in(path)
    editor = drawn("hermite")
    refusing = rule_edits.set_family(editor.session.document, 0, family)
    panel = editor.window.basis_panel
    times = [0.0, 0.2, 0.6 - 1e-7, 0.6, 0.8, 1.0]
    crowded = rule_edits.set_parametrization(refusing, 0, ParametrizationKind.MANUAL, times)
    editor.session.commit(crowded, "Crowd")
    editor.settle()
    view = editor.session.active_view
    # The line of the file, and its words.
    assert view.problem == "“refusing.py”, line 8: ValueError: parameters that are nearly equal."
    assert not view.is_current
    assert panel.drawing.basis is None
    assert editor.window.findChild(QLabel, "basisDrawing").text() == (
        "No functions: there is no curve with these parameters"
    )
    editor.drag_pixels(panel, panel.rail_pixel(0.6), panel.rail_pixel(0.7))
    assert editor.session.undo_stack.undoText() == "Change t of point 3"
    assert is_true(editor)
    assert editor.parameters[:3] == times[:3]
    assert editor.parameters[3] == pytest.approx(0.7, abs=2.0 / panel.pixel_map.sx)
    editor.trigger("undo")
    editor.session.selected.set_points([3])
    panel.setFocus()
    QTest.keyClick(panel, Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert editor.session.active_view.ticks[3] > 0.6


def test_two_curves_of_a_family_are_joined_or_the_refusal_has_a_reason(drawn):
    for own in OWN:
        editor = drawn(own)
        beside = [(x + 6.0, y + 2.0) for x, y in POINTS]
        second = make_curve(beside, name="Second", family=FAMILIES.named(own))
        editor.session.commit(Document((editor.curve, second)), "Second")
        before = editor.session.document
        editor.trigger("joinCurve")
        if own != "tests_cosine_steps":
            assert f"Two {FAMILIES.named(own).title} curves cannot be joined" in editor.status, own
            assert editor.session.document == before, own
        else:
            assert len(editor.session.document.curves) == 1, own
            assert len(editor.curve.points) == 11, own
            assert is_true(editor), own


def test_switching_the_family_back_gives_the_same_curve(drawn):
    for name in EVERY:
        editor = drawn(name)
        before = editor.session.active_view.curve.evaluate(0.25)
        editor.trigger("reverseCurve")
        assert editor.session.active_view.curve.evaluate(0.75) == pytest.approx(before, abs=1e-12), name


# Table, files


def test_the_table_displays_and_accepts_numbers_of_every_family(drawn):
    for own in OWN:
        editor = drawn(own)
        table = editor.window.point_table.model()
        assert not any(column.is_derivative for column in table.columns), own
        assert table.setData(table.index(2, 1), 3.25), own
        assert editor.point(2) == (3.25, 1.0), own
        assert table.setData(table.index(2, 0), 0.5), own
        assert editor.parameters[2] == 0.5, own
        assert is_true(editor), own
        editor.trigger("undo")
        editor.trigger("undo")
        assert editor.point(2) == POINTS[2], own


def test_a_saved_curve_of_every_family_opens_unchanged(drawn, tmp_path):
    for name in EVERY:
        editor = drawn(name)
        path = tmp_path / "name.curve.json"
        editor.session.save(path)
        assert json.loads(path.read_text())["curves"][0]["family"] == name, name
        before = editor.session.document
        editor.new()
        editor.session.open(path)
        assert editor.session.document == before, name
        assert is_true(editor), name
        assert editor.message == "", name


# Everything that shows something


def switches(editor):
    """Every action that switches something on and off, but for those that change the curve or the window."""
    others = {family.action_name for family in FAMILIES} | {
        *(tool.action for tool in TOOLS),
        *NO_FILM,
        "closeCurve",
        "presentation",
        "toggleLessons",
    }
    # Lessons open another document; an explanation takes the next click for itself.
    kinds = ("curve", "parameters", "tangent", "theme", "lessons", "explain")
    found = [each for each in editor.window.findChildren(QAction) if each.isCheckable() and each.isEnabled()]
    names = {action.objectName() for action in found} - others - {""}
    return sorted(name for name in names if not name.startswith(kinds))


def test_all_switchable_displays_survive_a_drag(drawn):
    editor = drawn(OWN[0])
    editor.select([2])
    # It plays from the first comparison on, and every frame draws as much as a move.
    player = editor.window.commands[MotionCommands].stage.player
    now = 0.0
    player.clock = lambda: now
    names = switches(editor)
    assert {"overlayComb", "overlayMarks", "ghostLagrange", "plotCurvature", "toggleLaboratory"} <= {*names}
    # Curves of all other families come last and go first: every switch has all that is on drawn anew.
    heavy = [each for each in names if each.startswith(("ghost", "motion"))]
    light = [each for each in names if each not in heavy]
    for name in [*light, *heavy]:
        if not editor.action(name).isChecked():
            editor.action(name).trigger()
    # The canvas has got smaller.
    editor.fit()
    for own in OWN:
        drawn(own)
        before = editor.session.document
        # One move: every event draws all that is switched on.
        editor.press(editor.point(2))
        now += 0.1
        editor.move((3.5, 2.2))
        assert is_true(editor), own
        editor.release((3.5, 2.2))
        assert editor.session.document != before, own
        assert is_true(editor), own
        if own == OWN[0]:
            editor.trigger("undo")
            assert editor.session.document == before
            # tests/view_model has ghosts of each of these families.
            switch_off(editor, heavy)
    switch_off(editor, light)
    editor.settle()
    assert is_true(editor)


def switch_off(editor, names):
    """Trigger those of these switches that are on and can be triggered."""
    for action in map(editor.action, names):
        if action.isChecked() and action.isEnabled():
            action.trigger()


def test_the_laboratory_announces_that_its_methods_compute_other_curves(drawn, own):
    editor = drawn(own)
    editor.trigger("toggleLaboratory")
    said = f"{FAMILIES.named(own).a_curve} is made of other functions"
    panel = editor.window.findChild(object, "laboratoryPanel")
    until(lambda: any(said in text for text in texts_of(panel)))
    for box in panel.findChildren(QComboBox):
        for index in range(box.count()):
            box.setCurrentIndex(index)
            box.activated.emit(index)
            editor.settle()
    for box in panel.findChildren(QCheckBox):
        if box.isEnabled() and box.isVisible():
            QTest.mouseClick(box, Qt.MouseButton.LeftButton)
            editor.settle()
    editor.drag_point(2, (3.0, 2.0))
    assert is_true(editor)
    editor.trigger("toggleLaboratory")


def texts_of(panel):
    found = []
    for kind in panel.findChildren(object):
        text = getattr(kind, "text", None)
        if callable(text):
            try:
                found.append(text())
            except TypeError:
                continue
    return found


def test_a_motion_runs_along_every_family(drawn):
    for name in EVERY:
        editor = drawn(name)
        editor.trigger("playMotion")
        editor.trigger("stopMotion")
        assert is_true(editor), name


def test_a_family_without_polynomials_is_not_called_a_polynomial(drawn, own):
    """The curve's form said "degree None · 5 pieces", then "no polynomial": who knows?"""
    editor = drawn(own)
    facts = editor.window.findChild(QLabel, "curveFacts").text().replace("\N{NO-BREAK SPACE}", " ")
    points = "points" if FAMILIES.named(own).interpolates else "control points"
    assert facts == f"6 {points} · 0 ≤ t ≤ 1"
