"""The joint certificate, with real events."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget, QLabel, QTableView, QToolButton

from app.appearance.theme import DARK, LIGHT
from app.document.derivatives import VelocityRule
from app.document.model import Curve, Document, Parametrization, Point, make_curve
from app.document.point_edits import set_position
from app.families import HERMITE
from app.features.joints.panel import COLUMNS, JointsModel, JointsPanel
from app.view_model.analysis import joints
from app.view_model.analysis.joints import JointKind
from app.view_model.curve.curve_view import view_of
from tests.effort import calls_of, noted_calls
from tests.waiting import until


@pytest.fixture
def bessel(editor):
    """The sketch as cubics that jump in the acceleration; the certificate in sight."""
    curve = replace(editor.curve, family=HERMITE, velocity_rule=VelocityRule.BESSEL)
    editor.session.commit(Document((curve,)), "Begin")
    editor.trigger("showJoints")
    return editor


def panel(editor):
    return editor.window.findChild(JointsPanel, "jointsPanel")


def summary(editor):
    return panel(editor).findChild(QLabel, "jointsSummary").text()


def rows(editor):
    return list(table(editor).model().rows)


def table(editor):
    return editor.window.findChild(QTableView, "jointsTable")


def text(editor, row, column):
    return table(editor).model().index(row, column).data()


def click_row(editor, row):
    view = table(editor)
    place = view.visualRect(view.model().index(row, 1)).center()
    QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=place)
    editor.settle()


def test_the_certificate_is_built_on_first_opening(new_editor):
    assert panel(new_editor) is None
    new_editor.trigger("showJoints")
    assert panel(new_editor).isVisible()
    assert new_editor.window.findChild(QDockWidget, "jointsDock").isVisible()
    assert "One polynomial: no joints" in summary(new_editor)
    assert not table(new_editor).isVisible()


def test_every_joint_has_a_row_with_sign_class_and_jumps(bessel):
    assert summary(bessel) == "△ C¹ everywhere."
    assert table(bessel).model().rowCount() == 6
    assert text(bessel, 2, 0) == "△ 3"
    assert text(bessel, 2, 1) == "C¹"
    assert [text(bessel, 2, column) for column in (2, 3)] == ["0", "0"]
    curve, t = bessel.session.active_view.curve, bessel.parameters[3]
    jump = np.linalg.norm(curve.evaluate(t, 2) - curve.evaluate(np.nextafter(t, 0), 2))
    assert text(bessel, 2, 4) == f"{jump:.3g}"


def test_a_click_on_a_row_zooms_to_the_joint_and_selects_the_point(bessel):
    canvas = bessel.window.canvas
    width = canvas.pixel_map.box[2] - canvas.pixel_map.box[0]
    click_row(bessel, 2)
    assert bessel.session.selection == {3}
    x_min, y_min, x_max, y_max = canvas.pixel_map.box
    assert ((x_min + x_max) / 2, (y_min + y_max) / 2) == pytest.approx(bessel.point(3))
    assert x_max - x_min < 0.6 * width
    assert "Joint 3" in bessel.window.findChild(QLabel, "jointsDetail").text()
    assert "acceleration and curvature jump" in bessel.window.findChild(QLabel, "jointsDetail").text()
    assert bessel.session.undo_stack.count() == 1


def test_enter_zooms_to_the_joint_and_arrow_keys_only_select(bessel):
    view = table(bessel)
    view.setFocus()
    view.setCurrentIndex(view.model().index(0, 0))
    box = bessel.window.canvas.pixel_map.box
    QTest.keyClick(view, Qt.Key.Key_Down)
    assert bessel.window.canvas.pixel_map.box == box
    assert "Joint 2" in bessel.window.findChild(QLabel, "jointsDetail").text()
    QTest.keyClick(view, Qt.Key.Key_Return)
    assert bessel.session.selection == {2}
    assert bessel.window.canvas.pixel_map.box != box


def test_selecting_a_point_selects_its_row(bessel):
    bessel.select_point(5)
    assert table(bessel).currentIndex().row() == 4


def test_the_certificate_follows_a_drag_at_the_pace_of_the_panels_and_escape_reverts(bessel):
    before = rows(bessel)
    x, y = bessel.point(3)
    bessel.press((x, y))
    bessel.move((x + 0.4, y + 0.4))
    until(lambda: rows(bessel) != before)
    bessel.escape()
    assert rows(bessel) == before


def test_a_corner_has_a_sign_and_a_label(bessel):
    bessel.select([3])
    bessel.trigger("tangentCorner")
    x, y = bessel.handle(1, ahead=True).position
    bessel.drag_handle((x + 0.4, y + 0.3), ahead=True)
    row = rows(bessel)[2]
    assert row.kind is JointKind.CORNER
    assert text(bessel, 2, 0) == "▲ 3"
    assert text(bessel, 2, COLUMNS.index("∠")).endswith("°")
    assert "joint 3: C⁰ (corner)" in summary(bessel)
    assert summary(bessel).startswith("▲")


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_an_undecided_value_is_a_question_mark_with_its_reason(bessel, theme):
    points = tuple(Point(*place) for place in ((0.0, 0.0), (1.0, 1.0), (1.0 + 1e-12, 1.0), (2.0, 0.0)))
    bessel.session.commit(Document((Curve("Near", HERMITE, Parametrization(), points),)), "Near")
    bessel.settle()
    panel(bessel).set_theme(theme)
    assert summary(bessel) == "? ≥C¹ everywhere."
    assert [text(bessel, 0, column) for column in range(5)] == ["? 1", "≥C¹", "0", "0", "?"]
    assert text(bessel, 0, COLUMNS.index("κ")) == "?"
    cell = table(bessel).model().index(0, 4)
    assert "Double precision does not decide" in cell.data(Qt.ItemDataRole.ToolTipRole)
    # Neither a fault nor a zero: the colour of all text.
    assert cell.data(Qt.ItemDataRole.ForegroundRole) is None
    assert table(bessel).model().index(0, 2).data(Qt.ItemDataRole.ForegroundRole) == theme.muted
    view = table(bessel)
    assert view.fontMetrics().horizontalAdvance("≥C¹") <= view.columnWidth(1) - 2 * 5


def test_the_closing_joint_is_the_last(bessel):
    bessel.trigger("closeCurve")
    assert table(bessel).model().rowCount() == 8
    assert text(bessel, 7, 0).endswith(" 0")
    table(bessel).scrollToBottom()
    click_row(bessel, 7)
    assert bessel.session.selection == {0}
    assert "where the curve closes" in bessel.window.findChild(QLabel, "jointsDetail").text()


def test_the_certificate_is_copied_by_button_and_by_keys(bessel, qtbot):
    QGuiApplication.clipboard().clear()
    qtbot.mouseClick(bessel.window.findChild(QToolButton, "copyJointsButton"), Qt.MouseButton.LeftButton)
    copied = QGuiApplication.clipboard().text()
    assert copied.startswith("C¹ everywhere.\njoint\tt\tclass")
    assert len(copied.splitlines()) == 8
    QGuiApplication.clipboard().clear()
    click_row(bessel, 1)
    table(bessel).setFocus()
    QTest.keyClick(table(bessel), Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == copied
    assert bessel.status.startswith("Copied")


def test_without_a_curve_the_panel_gives_the_reason(bessel):
    bessel.session.commit(set_position(bessel.session.document, 0, 2, bessel.point(1)), "Meet")
    bessel.settle()
    assert summary(bessel) == bessel.session.active_view.problem
    bessel.trigger("undo")
    assert table(bessel).isVisible()


def test_a_move_among_a_thousand_joints_judges_each_once_and_writes_the_visible_ones(editor, monkeypatch):
    points = tuple(Point(i / 100, float(np.sin(i / 30))) for i in range(1000))
    curve = Curve("Long", HERMITE, Parametrization(), points, VelocityRule.BESSEL)
    editor.session.commit(Document((curve,)), "Begin")
    editor.trigger("showJoints")
    assert table(editor).model().rowCount() == 998
    certificates = noted_calls(monkeypatch, joints, "certificate_of")
    judged = noted_calls(monkeypatch, joints, "_row")
    written = noted_calls(monkeypatch, JointsModel, "texts")
    editor.session.commit(set_position(editor.session.document, 0, 500, (5.0, 0.3)), "Move")
    editor.settle()
    assert rows(editor)[499].joint == 500
    assert (len(certificates), len(judged)) == (1, 998)
    # A cell is asked for its text and for its colour, and a row for its widths, in the rows in sight alone.
    view = table(editor)
    in_sight = view.viewport().height() // view.rowHeight(0) + 2
    assert 0 < len(written) <= 2 * in_sight * (len(COLUMNS) + 1)


def test_the_work_for_a_joint_does_not_grow_with_the_number_of_joints():
    def effort(count):
        points = tuple(Point(i / 100, float(np.sin(i / 30))) for i in range(count))
        view = view_of(Curve("Long", HERMITE, Parametrization(), points, VelocityRule.BESSEL))
        return calls_of(lambda: joints.certificate_of(view))

    assert effort(1000) < 2.2 * effort(500)


@pytest.mark.parametrize("factor", [1.0, 100.0])
def test_the_table_has_room_for_every_number_at_the_usual_size(editor, factor):
    """All columns but three had one width: the jumps of the jerk were cut to “1.0…”, and κ was cut off."""
    editor.window.resize(1440, 900)
    points = [(0, 0), (1, 1), (2, 0.2), (4, 1), (5.3, -1.2), (6, 2.5), (8, 1)]
    curve = make_curve([(factor * x, factor * y) for x, y in points], family=HERMITE)
    corner = replace(curve.points[4], corner=True, velocity=(factor, 0.0), velocity_after=(0.0, -factor))
    for rule, changed in ((VelocityRule.NATURAL_SPLINE, curve.points), (VelocityRule.BESSEL, curve.points)):
        for joint in (curve.points[4], corner):
            points = (*changed[:4], joint, *changed[5:])
            curve = replace(curve, velocity_rule=rule, points=points)
            editor.session.commit(Document((curve,)), "Begin")
            editor.trigger("showJoints")
            view = table(editor)
            assert view.horizontalScrollBar().maximum() == 0
            assert panel(editor).height() <= panel(editor).parentWidget().height()
            for column in range(len(COLUMNS)):
                widths = [view.fontMetrics().horizontalAdvance(text(editor, row, column)) for row in range(5)]
                widths.append(view.fontMetrics().horizontalAdvance(COLUMNS[column]))
                assert max(widths) + 2 <= view.columnWidth(column), (rule, COLUMNS[column])


OUTLINE = (
    (0, 0),
    (3, 0),
    (4.4, 0.5),
    (5, 1.8),
    (4, 3.1),
    (4.9, 4.4),
    (4.3, 5.6),
    (3, 6),
    (0, 6),
    (0, 4),
    (0, 2),
)


@pytest.mark.parametrize("factor", [1.0, 100.0, 1e-3])
def test_the_jumps_of_the_curvature_of_a_letter_are_in_sight_as_a_whole(editor, factor):
    """At 1440 × 900 they were cut to “−0.”, and their exponents lay beyond the edge."""
    editor.window.resize(1440, 900)
    points = list(make_curve([(factor * x, factor * y) for x, y in OUTLINE]).points)
    for k in (0, 7, 8):
        sides = {
            "velocity": (10.0 * factor, -20.0 * factor),
            "velocity_after": (-7.0 * factor, 40.0 * factor),
        }
        points[k] = replace(points[k], corner=True, **sides)
    curve = Curve("B", HERMITE, Parametrization(), tuple(points), VelocityRule.BESSEL, closed=True)
    editor.session.commit(Document((curve,)), "Begin")
    editor.trigger("showJoints")
    view, column = table(editor), COLUMNS.index("κ")
    assert view.horizontalScrollBar().maximum() == 0
    assert view.columnViewportPosition(column) + view.columnWidth(column) <= view.viewport().width()
    texts = [text(editor, row, column) for row in range(len(OUTLINE))]
    assert max(map(view.fontMetrics().horizontalAdvance, texts)) + 2 <= view.columnWidth(column)
    assert text(editor, 6, COLUMNS.index("∠")) == "163°"


def test_straight_sides_of_a_corner_have_no_rounding_in_their_jumps(editor):
    """“8e−14”, “1.8e−12” and a κ of the same kind took the room, and 110° was “1.1e2°”."""
    editor.choose_family(HERMITE)
    editor.new()
    editor.window.canvas.camera.show_box((-1, 2), (-2, 1))
    editor.settle()
    editor.trigger("addTool")
    editor.click((0.1, 0.37))
    for at in ((0.53, 0.36), (1.31, -1.7), (0.53, -1.69), (0.1, -0.41)):
        editor.click(at, keys=Qt.KeyboardModifier.AltModifier)
    editor.trigger("selectTool")
    editor.trigger("showJoints")
    for row in range(3):
        for title in ("c″", "c‴", "κ"):
            assert text(editor, row, COLUMNS.index(title)) == "0", title
        assert "e" not in text(editor, row, COLUMNS.index("∠"))
    assert text(editor, 1, COLUMNS.index("∠")) == "111°"


def test_columns_of_the_certificate_stay_during_a_drag(bessel):
    bessel.window.resize(1440, 900)
    bessel.settle()
    view = table(bessel)
    x, y = bessel.point(2)
    bessel.press((x, y))
    bessel.move((x + 0.4, y + 0.6))
    before = [view.columnWidth(column) for column in range(len(COLUMNS))]
    for share in (0.3, 0.2, 0.1):
        bessel.move((x + share, y + share))
        after = [view.columnWidth(column) for column in range(len(COLUMNS))]
        assert all(now >= then - 12 for now, then in zip(after, before, strict=True))
    bessel.release((x, y))


def test_a_row_is_highlighted_only_as_long_as_its_point_is_selected(bessel):
    bessel.select_point(3)
    until(lambda: table(bessel).currentIndex().row() == 2)
    QTest.keyClick(table(bessel), Qt.Key.Key_Down)
    bessel.settle()
    assert table(bessel).currentIndex().row() == 3, "the keys still go from row to row"
    bessel.fit()
    bessel.select([])
    until(lambda: not table(bessel).selectionModel().hasSelection())
    assert not table(bessel).currentIndex().isValid()
