"""Columns of the point table that only this file has: a record each, and nothing else."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QItemSelectionModel, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest

from app.document import point_edits
from app.document.limits import EditError
from app.document.model import Document, make_curve
from app.families import HERMITE, LAGRANGE
from app.features.point_table.edits import computed_note_of
from app.features.point_table.view import CellEditor
from app.view_model import point_columns as columns
from app.view_model.point_columns import Column

Key, Role = Qt.Key, Qt.ItemDataRole
CTRL = Qt.KeyboardModifier.ControlModifier


def curvatures(view):
    """Signed curvature at each point; none where there is no curve."""
    if view.curve is None:
        return np.full(len(view.source.points), np.nan)
    t = view.parameters[: len(view.source.points)]
    (vx, vy), (ax, ay) = view.curve.evaluate(t, 1).T, view.curve.evaluate(t, 2).T
    return (vx * ay - vy * ax) / np.hypot(vx, vy) ** 3


def distances(view):
    return np.hypot(*view.points.T)


def at_distance(document, curve, _view, index, distance):
    """Move a point along the ray from the origin."""
    x, y = document.curves[curve].points[index].position
    if distance < 0:
        raise EditError("A distance is not negative.")
    factor = distance / math.hypot(x, y)
    return point_edits.set_position(document, curve, index, (x * factor, y * factor))


BUILT_IN = columns.COLUMNS
CURVATURE = Column(name="kappa", tip="Signed curvature at the point", get=curvatures)
DISTANCE = Column(
    name="r",
    tip="Distance from the origin",
    get=distances,
    set=at_distance,
    is_estimated=lambda view: np.arange(len(view.source.points)) == 1,
    estimate=lambda curve: f"guessed for {curve.name}",
)


@pytest.fixture
def table(monkeypatch, editor):
    """A table of four points with the two columns behind those that every Lagrange curve has."""
    monkeypatch.setattr(columns, "COLUMNS", (*columns.COLUMNS, CURVATURE, DISTANCE))
    curve = make_curve([(3.0, 4.0), (6.0, 8.0), (0.0, 5.0), (-3.0, 4.0)], family=LAGRANGE)
    editor.session.change("Begin", lambda _document: Document((curve,)))
    editor.settle()
    view = editor.window.point_table
    editor.window.resize(1600, 900)
    view.setFocus()
    yield view
    # Before the window is reset, which is before `monkeypatch` ends.
    columns.COLUMNS = BUILT_IN


KAPPA = len(columns.columns_of(derivatives=0))
R = KAPPA + 1


def names_of(derivatives):
    """Names of the columns that the program has, and of those here."""
    shown = (column for column in BUILT_IN if not column.is_of_handle)
    return [*(column.name for column in shown if column.derivatives <= derivatives), "kappa", "r"]


def cell(table, row, column, *, adds=False):
    flags = QItemSelectionModel.SelectionFlag
    flag = flags.Select if adds else flags.ClearAndSelect
    table.selectionModel().setCurrentIndex(table.model().index(row, column), flag)


def data(table, row, column, role=Role.EditRole):
    return table.model().data(table.model().index(row, column), role)


def paste(table, text):
    QGuiApplication.clipboard().setText(text)
    QTest.keyClick(table, Key.Key_V, CTRL)


def test_added_columns_are_displayed(editor, table):
    names = [table.model().headerData(column, Qt.Orientation.Horizontal) for column in range(R + 1)]
    assert names == names_of(0)
    tip = table.model().headerData(R, Qt.Orientation.Horizontal, Role.ToolTipRole)
    assert tip == "Distance from the origin"
    assert [data(table, row, R) for row in range(4)] == [5.0, 10.0, 5.0, 5.0]
    expected = curvatures(editor.session.active_view)
    assert [data(table, row, KAPPA) for row in range(4)] == expected.tolist()
    assert data(table, 1, R, Role.ToolTipRole) == "r of point 1 = 10.0\nguessed for Curve 1"
    assert data(table, 1, R, Role.FontRole).italic()
    assert table.cell_delegate.text(1, R) == "10"


def test_widths_of_columns_follow_the_numbers(editor, table):
    """A small number takes more digits: 7.14e−10."""
    before = table.cell_delegate.needed_widths(6, 6, table.fontMetrics())
    editor.session.change(
        "Near", lambda document: point_edits.set_position(document, 0, 0, (-3e-9 / 7, 4e-9 / 7))
    )
    editor.settle()
    after = table.cell_delegate.needed_widths(6, 6, table.fontMetrics())
    assert after[R] > before[R]
    least = table.cell_delegate.needed_widths(3, 3, table.fontMetrics())
    assert table.horizontalHeader().sectionSize(R) >= least[R]


def test_added_columns_are_copied(table):
    cell(table, 0, R)
    cell(table, 0, KAPPA, adds=True)
    cell(table, 1, R, adds=True)
    QTest.keyClick(table, Key.Key_C, CTRL)
    rows = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert rows == [[repr(data(table, 0, KAPPA)), "5.0"], ["", "10.0"]]


def test_a_settable_column_can_be_typed(editor, table):
    cell(table, 0, R)
    QTest.keyClick(table, Key.Key_F2)
    line = table.findChild(CellEditor)
    line.selectAll()
    QTest.keyClicks(line, "20/2")
    QTest.keyClick(line, Key.Key_Return)
    assert editor.session.active_curve.points[0].position == (6.0, 8.0)
    assert editor.session.undo_stack.undoText() == "Set r of point 0"


def test_a_refused_number_is_explained_and_stays_for_correction(editor, table):
    before = editor.session.document
    cell(table, 0, R)
    QTest.keyClick(table, Key.Key_F2)
    line = table.findChild(CellEditor)
    line.selectAll()
    QTest.keyClicks(line, "-1")
    QTest.keyClick(line, Key.Key_Return)
    assert line.isVisible()
    assert editor.status == "r of point 0: A distance is not negative."
    assert editor.session.document is before


def test_a_column_can_be_filled(editor, table):
    cell(table, 0, R)
    cell(table, 2, R, adds=True)
    paste(table, "1")
    assert [data(table, row, R) for row in range(4)] == pytest.approx([1.0, 10.0, 1.0, 5.0])
    assert editor.session.undo_stack.undoText() == "Fill 2 cells"


def test_a_column_can_be_pasted(editor, table):
    cell(table, 1, R)
    paste(table, "1\n2\n3")
    assert [data(table, row, R) for row in range(4)] == pytest.approx([5.0, 1.0, 2.0, 3.0])
    assert editor.session.undo_stack.undoText() == "Paste 3 values"


def test_a_column_can_be_pasted_by_title_into_new_points(editor, table):
    cell(table, 3, R)
    paste(table, "x\ty\tr\n0\t1\t7\n3\t4\t25")
    assert editor.session.active_curve.points[3].position == pytest.approx((0.0, 7.0))
    assert editor.session.active_curve.points[4].position == pytest.approx((15.0, 20.0))
    assert editor.session.undo_stack.undoText() == "Paste 2 points"


def test_a_computed_column_can_be_neither_typed_nor_pasted(editor, table):
    before = editor.session.document
    cell(table, 0, KAPPA)
    for key in (Key.Key_F2, Key.Key_Return, Key.Key_1):
        QTest.keyClick(table, key)
    assert table.state() != table.State.EditingState
    paste(table, "1")
    assert editor.status == "kappa is computed and cannot be set."
    cell(table, 1, KAPPA, adds=True)
    paste(table, "1")
    assert editor.session.document is before


def test_a_family_shows_columns_for_its_derivatives(monkeypatch, editor, table):
    more = Column(name="s", tip="", get=distances, derivatives=1)
    monkeypatch.setattr(columns, "COLUMNS", (*columns.COLUMNS, more))
    editor.choose_family(HERMITE)
    assert [column.name for column in table.model().columns] == [*names_of(1), "s"]
    editor.choose_family(LAGRANGE)
    assert [column.name for column in table.model().columns] == names_of(0)


def curvatures_inside(view):
    """The same as of a curve that has none at its ends."""
    found = curvatures(view)
    found[[0, -1]] = np.nan
    return found


@pytest.mark.parametrize("get", [curvatures, curvatures_inside])
def test_a_paste_skips_computed_columns_and_reports_the_skipped_columns(monkeypatch, editor, table, get):
    """A whole table copied and pasted onto itself was refused: kappa is computed, or row 1 of it is empty."""
    monkeypatch.setattr(columns, "COLUMNS", (*BUILT_IN, replace(CURVATURE, get=get), DISTANCE))
    editor.session.change("Again", lambda document: point_edits.set_position(document, 0, 0, (6.0, 2.5)))
    editor.settle()
    before = editor.session.document
    table.selectAll()
    stay = QItemSelectionModel.SelectionFlag.NoUpdate
    table.selectionModel().setCurrentIndex(table.model().index(0, 0), stay)
    QTest.keyClick(table, Key.Key_C, CTRL)
    QTest.keyClick(table, Key.Key_V, CTRL)
    assert editor.status == f"Pasted 4 points{computed_note_of(columns.columns_of(0))}."
    place = [point.position for point in before.curves[0].points]
    assert np.array([point.position for point in editor.curve.points]) == pytest.approx(np.array(place))
    cell(table, 0, R)
    cell(table, 1, KAPPA, adds=True)
    paste(table, "1")
    assert editor.status == "Filled 1 cell; kappa is computed."
    assert (
        computed_note_of((CURVATURE, DISTANCE, replace(CURVATURE, name="k"))) == "; kappa and k are computed"
    )
    assert data(table, 0, R) == pytest.approx(1.0)
    # A gap elsewhere is one.
    cell(table, 0, 1)
    paste(table, "1\t2\n\t3")
    assert editor.status == "Row 2, column 1 is empty."


@pytest.mark.parametrize("column", [KAPPA, R])
def test_delete_on_an_added_column_deletes_no_point(editor, table, column):
    """It deleted the point: nothing but the orders of derivatives counted."""
    before = editor.session.document
    cell(table, 0, column)
    QTest.keyClick(table, Key.Key_Delete)
    assert editor.session.document is before
    name = table.model().columns[column].name
    assert editor.status == f"No rule estimates {name}; Delete on t, x or y deletes the point."


def test_delete_resets_a_column_to_its_rule(monkeypatch, editor, table):
    """The speed at a point: set by hand in the direction of the velocity, else that of the rule."""

    def speeds(view):
        return np.hypot(*view.curve.evaluate(view.parameters, 1).T)

    def at_speed(document, curve, view, index, speed):
        vx, vy = view.curve.evaluate(view.parameters[index], 1)
        factor = speed / math.hypot(vx, vy)
        return point_edits.set_velocity(document, curve, index, (vx * factor, vy * factor))

    speed = Column(
        name="|v|",
        tip="Speed",
        get=speeds,
        set=at_speed,
        is_estimated=lambda view: np.array([point.velocity is None for point in view.source.points]),
        reset=lambda document, curve, indices: point_edits.clear_derivatives(document, curve, indices, (1,)),
        derivatives=1,
    )
    monkeypatch.setattr(columns, "COLUMNS", (*BUILT_IN, speed))
    editor.choose_family(HERMITE)
    place = len(columns.columns_of(1)) - 1
    estimated = data(table, 2, place)
    cell(table, 2, place)
    paste(table, "7")
    assert data(table, 2, place) == pytest.approx(7.0)
    assert not table.model().estimated[2, place]
    QTest.keyClick(table, Key.Key_Delete)
    assert len(editor.curve.points) == 4
    assert editor.curve.points[2].velocity is None
    assert data(table, 2, place) == pytest.approx(estimated)
    assert editor.session.undo_stack.undoText() == "Reset |v| of point 2"
