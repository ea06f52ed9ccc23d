"""Edits during a gesture act on the committed document, without the preview of the gesture."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget, QLabel, QLineEdit, QSlider, QStyle, QStyleOptionSlider

from app.document import curve_edits, limits, point_edits, rule_edits
from app.document.model import (
    Curve,
    Document,
    Parametrization,
    ParametrizationKind,
    Point,
    ReferenceImage,
    make_curve,
)
from app.document.several_curves import set_appearance
from app.families import HERMITE, LAGRANGE
from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.rows import Spot
from app.features.point_table.view import CellEditor
from app.storage.format_error import FormatError
from app.storage.validation import validate
from app.view_model.curve.curve_view import view_of
from tests.gui.editor_facts import retype

LEFT = Qt.MouseButton.LeftButton

COMMANDS = [
    *("freezeParameters", "startUniform", "startChordLength", "resetVelocities", "familyLagrange"),
    *("insertPoint", "splitCurve", "joinCurve", "reverseCurve", "closeCurve", "duplicateCurve", "newCurve"),
    *("deleteCurve", "lowerCurve", "curveVisible", "curveLocked", "nextCurve"),
    *(
        "tangentCorner",
        "tangentSmooth",
        "tangentSymmetric",
        "tangentEstimated",
        "pullVelocity",
        "straightSegment",
    ),
    *("deleteSelection", "cutPoints", "pastePoints", "pasteAsCurve", "pasteDerivatives", "alignLeft"),
]


def hat(name="Hat", right=0.0):
    """A curve with something set at two of its points."""
    points = [(right, 0), (right + 1, 2), (right + 3, 2), (right + 4, 0)]
    curve = make_curve(points, family=HERMITE, name=name)
    document = point_edits.set_velocity(Document((curve,)), 0, 1, (3.0, 1.0))
    return point_edits.set_velocity(document, 0, 2, (2.0, -1.0)).curves[0]


@pytest.fixture
def two(editor):
    """Two curves, the second one edited, two of its points selected."""
    begin_with_two(editor)
    editor.fit()
    return editor


def begin_with_two(editor):
    editor.session.commit(Document((hat(), hat("Other", 5.0))), "Begin")
    editor.session.selected.activate(1)
    editor.session.selected.set_points([1, 2])
    editor.session.scrub.set(0.4)


def with_on_clipboard(editor, name):
    if name == "pasteDerivatives":
        editor.select([1])
        editor.trigger("copyDerivatives")
        editor.select([1, 2])
    elif name.startswith("paste"):
        editor.trigger("copyPoints")


def under_g(editor):
    editor.hover((7.0, 1.0))
    editor.trigger("moveSelection")
    editor.hover((7.5, 1.8))
    assert editor.session.is_previewing


def under_a_drag(editor):
    editor.press(editor.point(3))
    editor.move((9.5, 1.0))
    editor.move((9.6, 1.2))
    assert editor.session.is_previewing


def under_the_pen(editor):
    editor.trigger("addTool")
    editor.press((9.8, -1.0))
    editor.move((9.9, -1.2))
    assert editor.session.is_previewing


def result_of_command(editor, name, begin, *, cancelled):
    """What a command makes of the document in a gesture, or behind a cancelled one; None where disabled."""
    before = editor.session.committed
    editor.session.selected.set_points([1, 2])
    begin(editor)
    if cancelled:
        editor.escape()
        assert editor.session.document is before
    elif not editor.action(name).isEnabled():
        editor.escape()
        return None
    editor.trigger(name)
    assert not editor.session.is_previewing
    after = editor.session.document
    editor.action("selectTool").trigger()
    while editor.session.committed is not before:
        editor.session.undo_stack.undo()
    editor.session.selected.activate(1)
    return after


@pytest.mark.parametrize(
    ("names", "begin"),
    [(COMMANDS[::2], under_g), (COMMANDS[1::6], under_a_drag), (COMMANDS[1::6], under_the_pen)],
)
def test_a_command_during_a_gesture_has_the_same_result_as_without_the_gesture(two, names, begin):
    for name in names:
        begin_with_two(two)
        with_on_clipboard(two, name)
        within = result_of_command(two, name, begin, cancelled=False)
        if within is None:
            # One point is held, where the command is for several, or for what nobody set there.
            assert name in ("alignLeft", "resetVelocities")
        else:
            assert within == result_of_command(two, name, begin, cancelled=True), name


def test_a_panel_used_during_a_gesture_changes_the_committed_document(two):
    under_g(two)
    before = two.session.committed
    two.show_dock("curvesDock")
    two.click_in_list(0, Spot.EYE)
    assert two.session.document.curves[1] is before.curves[1]
    under_g(two)
    two.choose_parametrization(ParametrizationKind.UNIFORM)
    assert two.session.document.curves[1].points == before.curves[1].points
    assert two.session.undo_stack.undoText() == "Use uniform parameters"


def test_del_in_the_list_does_not_commit_the_preview(two):
    two.show_dock("curvesDock")
    two.session.selected.activate(0)
    before = two.session.committed
    two.select([1, 2])
    under_g(two)
    view = two.window.commands[CurveListCommands].panel.view
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_Delete)
    assert two.session.document.curves == (before.curves[1],)
    two.trigger("undo")
    assert two.session.document is before


def press_alpha(editor):
    """Take hold of the handle of the α slider and drag it to its middle."""
    slider = editor.window.findChild(QSlider, "alphaSlider")
    option = QStyleOptionSlider()
    slider.initStyleOption(option)
    handle = slider.style().subControlRect(
        QStyle.ComplexControl.CC_Slider, option, QStyle.SubControl.SC_SliderHandle, slider
    )
    QTest.mousePress(slider, LEFT, pos=handle.center())
    QTest.mouseMove(slider, slider.rect().center())
    assert editor.session.is_previewing
    return slider


def test_undo_during_a_drag_of_alpha_cancels_only_the_drag(two):
    two.drag_point(0, to=(5.5, 0.5))
    index = two.session.undo_stack.index()
    before = two.session.document
    slider = press_alpha(two)
    two.trigger("undo")
    assert two.session.undo_stack.index() == index
    assert two.session.document is before
    QTest.mouseMove(slider, slider.rect().center() / 2)
    QTest.mouseRelease(slider, LEFT, pos=slider.rect().center() / 2)
    assert two.session.document is before
    assert slider.value() == 100
    two.trigger("undo")
    assert two.session.undo_stack.index() == index - 1


def test_escape_and_another_curve_cancel_a_curve_begun_by_the_pen(editor):
    rings = [
        curve_edits.set_closed(
            Document((make_curve([(x, 0), (x + 2, 0), (x + 2, 2)], family=HERMITE),)), 0, True
        ).curves[0]
        for x in (0.0, 4.0)
    ]
    editor.session.commit(Document(tuple(rings)), "Begin")
    editor.fit()
    editor.trigger("selectAllCurves")
    assert editor.session.selected.curves == {0, 1}
    editor.trigger("addTool")
    editor.press((1.0, 1.5))
    assert len(editor.session.document.curves) == 3
    editor.escape()
    assert editor.session.selected.curves == {0, 1}
    editor.release((1.0, 1.5))
    editor.press((1.0, 1.5))
    editor.trigger("nextCurve")
    editor.release((1.0, 1.5))
    assert len(editor.session.document.curves) == 2
    assert editor.session.active_index == 1


# What is selected


def test_undo_of_an_insertion_leaves_no_other_point_selected(two):
    two.session.selected.activate(0)
    place = tuple(two.session.active_view.curve.evaluate(0.15))
    two.trigger("addTool")
    two.click(place)
    two.trigger("selectTool")
    assert two.session.selection == {1}
    two.trigger("undo")
    assert two.session.selection == frozenset()
    two.key(Qt.Key.Key_Delete)
    assert len(two.curve.points) == 4


def test_undo_of_a_deletion_selects_the_restored_points(two):
    two.trigger("deleteSelection")
    assert two.session.selection == frozenset()
    two.trigger("undo")
    assert two.session.selection == {1, 2}
    two.trigger("selectAllCurves")
    two.trigger("deleteCurve")
    two.trigger("undo")
    assert two.session.selected.curves == {0, 1}


def test_undo_of_a_move_leaves_the_selection_of_now(two):
    two.drag_point(0, to=(5.5, 0.5))
    two.select([3])
    two.trigger("undo")
    assert two.session.selection == {3}


def test_a_refused_command_leaves_the_selection(two):
    two.trigger("curveLocked")
    for name in ("deleteSelection", "cutPoints", "reverseCurve"):
        two.trigger(name)
        assert two.session.selection == {1, 2}
        assert "is locked" in two.status


def test_a_number_typed_at_a_tick_stays_with_its_curve(two):
    panel = two.window.basis_panel
    two.rail.click(1)
    panel.edit_tick(1)
    assert panel.tick_edit.isVisible()
    two.trigger("nextCurve")
    assert not panel.tick_edit.isVisible()
    panel.edit_tick(1)
    two.trigger("undo")
    assert not panel.tick_edit.isVisible()


# What no file can hold


def test_a_closed_curve_with_too_few_points_left_is_open(editor):
    editor.new()
    editor.choose_family(HERMITE)
    editor.trigger("addTool")
    for point in ((0, 0), (2, 0), (2, 2)):
        editor.click(point)
    editor.trigger("closeCurve")
    editor.trigger("selectAll")
    editor.trigger("deleteSelection")
    for point in ((0, 0), (2, 0), (2, 2), (0, 2)):
        editor.click(point)
    assert [(len(curve.points), curve.closed) for curve in editor.session.document.curves] == [(4, False)]


def test_the_interval_of_a_polynomial_that_would_be_closed_leaves_room_to_close():
    document = Document((make_curve([(0, 0), (1, 2), (3, 2)], family=HERMITE),))
    document = rule_edits.freeze_parameters(
        curve_edits.set_closed(document, 0, True), 0, [0.0, 0.3, 0.6, 1.0]
    )
    document = rule_edits.set_interval(rule_edits.set_family(document, 0, LAGRANGE), 0, 0.0, 2.0)
    validate(document)
    assert view_of(rule_edits.set_family(document, 0, HERMITE).curves[0]).is_current


def test_points_that_would_share_a_parameter_are_not_pasted(editor):
    source = Curve("S", HERMITE, Parametrization(end=1e-6), tuple(Point(i / 10, 2.0) for i in range(21)))
    manual = Parametrization(ParametrizationKind.MANUAL)
    target = Curve("T", HERMITE, manual, (Point(0.0, 0.0, t=1.7e9), Point(1.0, 0.0, t=1.7e9 + 1)))
    editor.session.commit(Document((source, target)), "Begin")
    editor.trigger("selectAll")
    editor.trigger("copyPoints")
    editor.session.selected.activate(1)
    before = editor.session.document
    editor.trigger("pastePoints")
    assert editor.session.document is before
    assert "must be greater than" in editor.status
    validate(editor.session.document)


def test_derivatives_beyond_the_limits_are_refused_with_a_sentence(editor):
    curve = make_curve([(0, 0), (1e6, 2e6), (3e6, 1e6)], family=HERMITE)
    rule = Parametrization(ParametrizationKind.UNIFORM, end=1e-7)
    editor.session.commit(Document((replace(curve, parametrization=rule),)), "Begin")
    editor.select([1])
    editor.trigger("copyDerivatives")
    editor.select([0])
    before = editor.session.document
    editor.trigger("pasteDerivatives")
    assert editor.session.document is before
    assert "must lie between" in editor.status


def test_a_picture_at_the_end_of_the_plane_is_not_nudged_farther(editor, tmp_path):
    image = ReferenceImage(str(tmp_path / "none.png"), 1e12, 0.0, 1.0, 1.0)
    editor.session.commit(Document(editor.session.document.curves, image), "Begin")
    editor.window.canvas.camera.show_box((1e12 - 1, 1e12), (0, 1))
    editor.trigger("moveImage")
    editor.key(Qt.Key.Key_Right, Qt.KeyboardModifier.ShiftModifier)
    assert editor.session.document.image is image
    assert "must lie between" in editor.status


def test_values_that_no_file_can_store_are_not_committed(editor):
    """The last gate, should an edit forget to check."""
    wild = replace(editor.curve, points=(*editor.curve.points, Point(float("nan"), 0.0)))
    with pytest.raises(FormatError):
        validate(Document((wild,)))
    before = editor.session.document
    assert not editor.session.commit(Document((wild,)), "Wild")
    assert editor.session.document is before
    place, name = len(editor.curve.points), editor.curve.name
    words = f"the x of point {place} of “{name}” must lie between -1e12 and 1e12, not nan"
    assert editor.status == f"This cannot be saved: {words}."
    style = replace(editor.curve.style, miter_limit=0.5)
    editor.session.change("Odd", lambda document: document.with_curve(0, replace(editor.curve, style=style)))
    assert editor.status.endswith(f"the miter limit of “{name}” must be 1 or greater, not 0.5.")


def test_an_edit_finds_the_document_without_a_gesture_in_flight(two):
    """What a gesture showed is gone before the edit is asked for the document."""
    session, found = two.session, []
    two.press(two.point(1))
    two.move((9.0, 9.0))
    assert session.is_previewing

    def edit(document):
        found.append(document)
        return curve_edits.rename_curve(document, 0, "Named")

    committed = session.committed
    change = session.change("Rename curve", edit)
    assert change.is_done
    assert change
    assert found == [committed]
    assert session.document.curves == (replace(committed.curves[0], name="Named"), committed.curves[1])
    assert session.undo_stack.undoText() == "Rename curve"
    two.release((9.0, 9.0))
    assert session.undo_stack.undoText() == "Rename curve"


def test_a_refused_edit_changes_nothing_and_is_reported(two):
    session = two.session
    before, steps = session.document, session.undo_stack.count()

    def edit(_document):
        raise limits.EditError("There is no other way.")

    change = session.change("Never", edit)
    assert not change
    assert change.refusal == two.status == "There is no other way."
    assert session.document is before
    assert session.undo_stack.count() == steps
    assert session.selection == {1, 2}


def test_an_empty_change_is_no_step_and_no_refusal(two):
    session, steps = two.session, two.session.undo_stack.count()
    change = session.change("Nothing", lambda document: document)
    assert not change
    assert not change.refusal
    assert session.undo_stack.count() == steps


def test_the_caller_gets_the_reason_why_a_locked_curve_did_not_change(two):
    session = two.session
    session.change("Lock", lambda document: set_appearance(document, [1], locked=True))
    change = session.change("Move", lambda document: point_edits.set_position(document, 1, 0, (9.0, 9.0)))
    assert not change
    assert change.refusal == two.status
    assert "locked" in change.refusal


@pytest.mark.parametrize("refuses", [False, True])
def test_a_cancelled_or_refused_gesture_restores_the_selection(two, refuses):
    """A press of the pen selects the point it makes; what was selected before was then lost."""
    session = two.session
    two.trigger("addTool")
    two.press((1.5, 3.5))
    assert session.is_previewing
    assert session.selection == {4}
    if refuses:

        def edit(_document):
            raise limits.EditError("There is no other way.")

        session.change("Never", edit)
    else:
        session.interrupt()
    assert not session.is_previewing
    assert session.selection == {1, 2}
    two.release((1.5, 3.5))


def test_a_number_for_a_locked_curve_stays_in_the_field_with_the_reason(two):
    """The cell's editor closed over a number that was not taken."""
    two.session.change("Lock", lambda document: set_appearance(document, [1], locked=True))
    two.settle()
    table, before = two.window.point_table, two.session.document
    table.setFocus()
    table.setCurrentIndex(table.model().index(0, 1))
    QTest.keyClick(table, Qt.Key.Key_F2)
    line = table.findChild(CellEditor)
    line.selectAll()
    QTest.keyClicks(line, "7")
    QTest.keyClick(line, Qt.Key.Key_Return)
    assert line.isVisible()
    assert "“Other” is locked" in two.status
    message = two.window.findChild(QLabel, "pointTableMessage")
    assert message.isVisible()
    assert "“Other” is locked" in message.text()
    assert two.session.document is before
    QTest.keyClick(line, Qt.Key.Key_Escape)
    assert not line.isVisible()


def test_an_interval_for_a_locked_curve_stays_in_the_field_with_the_reason_below(two):
    two.session.change("Lock", lambda document: set_appearance(document, [1], locked=True))
    dock = two.window.findChild(QDockWidget, "curveDock")
    dock.show()
    dock.raise_()
    two.settle()
    before, field = two.session.document, two.window.findChild(QLineEdit, "intervalEnd")
    retype(field, "5")
    assert field.text() == "5"
    assert "is locked" in two.window.findChild(QLabel, "curveProblem").text()
    assert two.session.document is before
    QTest.keyClick(field, Qt.Key.Key_Escape)
    assert field.text() == "1"
    assert two.window.findChild(QLabel, "curveProblem").text() == ""
