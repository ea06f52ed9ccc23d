"""The point table: typed into, copied from, pasted into, with real keys and clicks."""

import numpy as np
import pytest
from event_count import paints_of
from msgspec.structs import replace
from PySide6.QtCore import QLocale, QPoint, Qt
from PySide6.QtGui import QAction, QFocusEvent, QGuiApplication, QKeySequence, QShortcut
from PySide6.QtTest import QSignalSpy
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit, QMainWindow, QToolButton

from app.appearance.colours import point_colours
from app.appearance.theme import DARK, LIGHT, ThemeMode, apply_theme
from app.document import curve_edits, point_edits, rule_edits
from app.document.derivatives import VelocityRule
from app.document.model import Document, Parametrization, ParametrizationKind, Point, make_curve
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.features.point_table.commands import PointTableController
from app.features.point_table.panel import INTERVAL_MS, PointTable
from app.features.point_table.view import LEFT_PADDING, PADDING, CellEditor
from app.session import MessageKind, Session
from app.testing import wait_for_rest
from app.view_model.point_columns import columns_of
from tests.waiting import until

Role = Qt.ItemDataRole
T, X, Y, VX, VY, AX, AY, JX, JY = range(9)

SEPTIC_HERMITE = FAMILIES.named("septic_hermite")
WIDTH = len(columns_of(derivatives=0))
POINTS = ((3.1, 3.35), (2.2, 4), (1.1, 3.5), (1.25, 2.5), (2.35, 1.95), (2.9, 1), (2, 0.1), (0.75, 0.6))


def refusals_of(session):
    """What the session refuses from now on."""
    found = []
    session.message.connect(
        lambda message: found.append(message.text) if message.kind is MessageKind.REFUSAL else None
    )
    return found


class Table:
    """A point table connected as the window connects it, and hands for it."""

    def __init__(self, qtbot, family=LAGRANGE, points=POINTS):
        self.qtbot = qtbot
        self.session = Session()
        self.session.commit(self.session.document.with_curve(0, make_curve(points, family=family)), "Points")
        self.window = QMainWindow()
        self.panel = PointTable()
        self.shown_points = []
        self.controller = PointTableController(
            self.session, self.panel, lambda: self.shown_points.append(self.session.document)
        )
        self.window.setCentralWidget(self.panel)
        self.session.document_changed.connect(
            lambda _document: self.panel.render_view(
                self.session.active_view, streaming=self.session.is_previewing
            )
        )
        self.session.selection_changed.connect(self.panel.set_selection)
        self.view, self.model = self.panel.view, self.panel.view.model()
        qtbot.addWidget(self.window)
        self.window.resize(360, 400)
        with qtbot.waitActive(self.window):
            self.window.show()
            self.window.activateWindow()
            # Else it is asked ten milliseconds later for the first time.
            QApplication.processEvents()
        self.view.setFocus()

    @property
    def point(self):
        return self.session.active_curve.points.__getitem__

    @property
    def message(self):
        label = self.panel.findChild(QLabel, "pointTableMessage")
        return label.text() if label.isVisible() else ""

    @property
    def editor(self):
        # One that was closed lives on, unseen, until the event loop deletes it.
        open_editors = [each for each in self.view.findChildren(CellEditor) if each.isVisible()]
        return open_editors[0] if open_editors else None

    def value(self, row, column):
        return self.model.data(self.model.index(row, column), Role.EditRole)

    def displayed(self, row, column):
        return self.model.data(self.model.index(row, column), Role.DisplayRole)

    def click(self, row, column, modifier=Qt.KeyboardModifier.NoModifier, *, double=False):
        place = self.view.visualRect(self.model.index(row, column)).center()
        self.qtbot.mouseClick(self.view.viewport(), Qt.MouseButton.LeftButton, modifier, place)
        if double:
            self.qtbot.mouseDClick(self.view.viewport(), Qt.MouseButton.LeftButton, modifier, place)

    def rest(self):
        """Have the table follow what is shown at once, not at its pace."""
        self.panel._timer.setInterval(0)
        wait_for_rest(self.window)
        self.panel._timer.setInterval(INTERVAL_MS)

    def edit(self, row, column):
        self.click(row, column)
        self.qtbot.keyClick(self.view, Qt.Key.Key_F2)
        return self.editor

    def type(self, row, column, text, key=Qt.Key.Key_Return):
        editor = self.edit(row, column)
        editor.selectAll()
        self.qtbot.keyClicks(editor, text)
        self.qtbot.keyClick(editor, key)
        return editor

    def copy(self):
        self.qtbot.keyClick(self.view, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
        return QGuiApplication.clipboard().text()

    def paste(self, text):
        QGuiApplication.clipboard().setText(text)
        self.qtbot.keyClick(self.view, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)


@pytest.fixture
def table(qtbot):
    return Table(qtbot)


@pytest.fixture
def hermite(qtbot):
    return Table(qtbot, HERMITE)


@pytest.fixture
def quintic(qtbot):
    return Table(qtbot, QUINTIC_HERMITE)


@pytest.fixture
def septic(qtbot):
    return Table(qtbot, SEPTIC_HERMITE)


# What is shown


@pytest.mark.parametrize(
    ("family", "names"),
    [
        (LAGRANGE, "t x y"),
        (HERMITE, "t x y vx vy"),
        (QUINTIC_HERMITE, "t x y vx vy ax ay"),
        (SEPTIC_HERMITE, "t x y vx vy ax ay jx jy"),
    ],
)
def test_the_table_has_the_columns_of_the_family(qtbot, family, names):
    model = Table(qtbot, family).model
    shown = [model.headerData(column, Qt.Orientation.Horizontal) for column in range(model.columnCount())]
    assert shown[: len(names.split())] == names.split()
    assert shown == [column.name for column in columns_of(family.derivatives)]


def test_the_model_has_the_exact_numbers_of_the_view(septic):
    view = septic.session.active_view
    for row in range(len(view.points)):
        numbers = [septic.value(row, column) for column in range(9)]
        assert numbers == [view.parameters[row], *view.curve.jets[row].ravel()]


def test_a_hidden_panel_has_the_numbers(qtbot):
    session = Session()
    panel = PointTable()
    qtbot.addWidget(panel)
    _controller = PointTableController(session, panel, lambda: None)
    assert panel.view.model().rowCount() == 8
    session.commit(point_edits.delete_points(session.document, 0, {0}), "Delete point 0")
    assert panel.view.model().rowCount() == 7


def test_numbers_are_rounded_for_the_eye_only(table):
    table.session.commit(point_edits.set_position(table.session.document, 0, 0, (1 / 3, -2 / 3)), "Move")
    assert (table.displayed(0, X), table.displayed(0, Y)) == ("0.333333", "−0.666667")
    assert (table.value(0, X), table.value(0, Y)) == (1 / 3, -2 / 3)
    assert "0.3333333333333333" in table.model.data(table.model.index(0, X), Role.ToolTipRole)


@pytest.mark.parametrize("theme", [LIGHT, DARK])
def test_rows_have_the_colours_of_points(table, theme):
    table.panel.set_theme(theme)
    colours = point_colours(8, theme)
    for row, colour in enumerate(colours):
        image = table.model.headerData(row, Qt.Orientation.Vertical, Role.DecorationRole).toImage()
        assert image.pixelColor(image.rect().center()) == colour
        assert table.model.headerData(row, Qt.Orientation.Vertical) == str(row)


def test_without_a_curve_there_are_no_parameters_but_the_points_stay(table):
    table.session.commit(point_edits.set_position(table.session.document, 0, 1, (3.1, 3.35)), "Move")
    assert table.session.active_view.problem
    assert table.displayed(3, T) == "–"
    assert table.displayed(1, X) == "3.1"
    assert not table.model.setData(table.model.index(3, T), 0.5)
    assert "no parameters" in table.message


def test_estimated_numbers_are_muted_and_italic_and_the_tip_names_the_rule(hermite):
    index = hermite.model.index(2, VX)
    assert hermite.model.data(index, Role.FontRole).italic()
    assert hermite.model.data(index, Role.ForegroundRole) == LIGHT.muted
    assert "estimated by the natural spline rule" in hermite.model.data(index, Role.ToolTipRole)
    document = rule_edits.set_rule(hermite.session.document, 0, VelocityRule.BESSEL)
    hermite.session.commit(document, "Rule")
    assert "Bessel" in hermite.model.data(index, Role.ToolTipRole)
    document = point_edits.set_velocity(hermite.session.document, 0, 2, (1.0, 2.0))
    hermite.session.commit(document, "Set velocity")
    assert hermite.model.data(index, Role.FontRole) is None
    assert "estimated" not in hermite.model.data(index, Role.ToolTipRole)


def test_t_x_y_and_velocities_fit_in_a_narrow_dock(hermite):
    hermite.window.resize(320, 300)
    header, viewport = hermite.view.horizontalHeader(), hermite.view.viewport()
    until(lambda: header.length() <= viewport.width() < 320)


@pytest.mark.parametrize("mode", [ThemeMode.LIGHT, ThemeMode.DARK])
def test_the_table_is_drawn_in_both_themes(qtbot, qapp, mode):
    theme = apply_theme(qapp, mode)
    table = Table(qtbot, HERMITE)
    table.session.selected.set_points([2])
    image = table.view.viewport().grab().toImage()
    place = table.view.visualRect(table.model.index(5, X))
    assert image.pixelColor(place.topLeft() + QPoint(3, 3)) == theme.paper
    chosen = table.view.visualRect(table.model.index(2, X)).topLeft() + QPoint(3, 3)
    assert image.pixelColor(chosen) not in (theme.paper, theme.accent)
    apply_theme(qapp, ThemeMode.LIGHT)


# Typing


def test_an_expression_is_typed_and_committed_with_enter(table):
    table.type(3, X, "sqrt(2)/2")
    assert table.point(3).x == 2**0.5 / 2
    assert table.point(3).y == 2.5
    assert table.session.undo_stack.undoText() == "Set x of point 3"
    assert table.view.currentIndex().row() == 4
    table.session.undo_stack.undo()
    assert table.value(3, X) == 1.25


def test_typing_a_digit_begins_to_edit_even_if_the_digit_is_a_shortcut(table):
    QShortcut(QKeySequence("1"), table.window, lambda: pytest.fail("the shortcut took the key"))
    table.click(2, Y)
    table.qtbot.keyClick(table.view, Qt.Key.Key_1)
    assert table.editor.text() == "1"
    table.qtbot.keyClicks(table.editor, "/4")
    table.qtbot.keyClick(table.editor, Qt.Key.Key_Tab)
    assert table.point(2).y == 0.25


def test_enter_edits_a_cell_and_enter_again_moves_down(table):
    table.click(0, X)
    for text in ("1", "2", "3"):
        table.qtbot.keyClick(table.view, Qt.Key.Key_Return)
        table.qtbot.keyClicks(table.editor, text)
        table.qtbot.keyClick(table.editor, Qt.Key.Key_Return)
    assert [table.point(row).x for row in range(3)] == [1.0, 2.0, 3.0]
    assert table.view.currentIndex().row() == 3


def type_row(table, *texts):
    """Type numbers from the current cell on, with Tab between them and Enter at the end."""
    for place, text in enumerate(texts, 1):
        for letter in text:
            # The first letter opens the editor.
            table.qtbot.keyClicks(table.editor or table.view, letter)
        table.qtbot.keyClick(table.editor, Qt.Key.Key_Tab if place < len(texts) else Qt.Key.Key_Return)


def current_cell(table):
    index = table.view.currentIndex()
    return index.row(), index.column()


def test_enter_goes_on_in_the_column_in_which_typing_began(hermite):
    """As in a spreadsheet: it went on below the last number, and x, y, x, y needed the mouse in between."""
    hermite.click(0, X)
    for row in range(3):
        type_row(hermite, f"{row + 0.5}", f"{row + 0.25}")
        assert hermite.session.active_curve.points[row].position == (row + 0.5, row + 0.25)
        assert current_cell(hermite) == (row + 1, X)
    # In the last row there is no further one.
    hermite.click(7, X)
    type_row(hermite, "1", "2")
    assert current_cell(hermite) == (7, Y)


def test_a_column_that_was_only_passed_is_not_the_first_that_was_typed_in(hermite):
    hermite.edit(1, T)
    hermite.qtbot.keyClick(hermite.editor, Qt.Key.Key_Tab)
    hermite.editor.selectAll()
    type_row(hermite, "1", "2", "3")
    assert current_cell(hermite) == (2, X)


@pytest.mark.parametrize("leave", ["click in the row", "click elsewhere", "arrow"])
def test_a_click_or_an_arrow_begins_another_run_of_typing(hermite, leave):
    hermite.click(0, X)
    type_row(hermite, "1", "2")
    if leave == "arrow":
        hermite.qtbot.keyClick(hermite.view, Qt.Key.Key_Right)
        hermite.qtbot.keyClick(hermite.view, Qt.Key.Key_Down)
    else:
        hermite.click(1 if leave == "click in the row" else 4, Y)
    row = hermite.view.currentIndex().row()
    type_row(hermite, "3")
    assert current_cell(hermite) == (row + 1, Y)


def test_tab_commits_and_edits_the_next_cell(table):
    table.type(1, X, "7", Qt.Key.Key_Tab)
    assert table.point(1).x == 7.0
    assert table.view.currentIndex().column() == Y
    table.qtbot.keyClick(table.editor, Qt.Key.Key_Escape)


def test_an_invalid_number_keeps_the_editor_open_with_a_reason(table):
    before = table.session.document
    said = refusals_of(table.session)
    editor = table.type(3, X, "2*")
    assert table.session.document is before
    assert editor.isVisible()
    assert editor.text() == "2*"
    assert "⚠ x of point 3: The number or expression is incomplete" in table.message
    assert len(said) == 1
    editor.setCursorPosition(2)
    table.qtbot.keyClick(editor, Qt.Key.Key_4)
    assert table.message == ""
    table.qtbot.keyClick(editor, Qt.Key.Key_Return)
    assert table.point(3).x == 8.0


def test_an_invalid_number_is_discarded_when_the_editor_loses_focus(table):
    before = table.session.document
    editor = table.edit(3, X)
    table.qtbot.keyClicks(editor, "abc")
    table.click(5, Y)
    assert table.session.document is before
    assert table.displayed(3, X) == "1.25"
    assert table.message == ""


def test_half_typed_numbers_do_not_reach_the_curve(table):
    before = table.session.document
    editor = table.edit(3, X)
    table.qtbot.keyClicks(editor, "12.5e")
    assert table.session.document is before
    table.qtbot.keyClick(editor, Qt.Key.Key_Escape)
    assert table.session.document is before
    assert table.session.undo_stack.count() == 1
    assert table.displayed(3, X) == "1.25"


def test_an_unchanged_text_is_no_edit(table):
    # 0.1 + 0.2 has 17 digits; 1/3 has more than the table shows.
    table.session.commit(point_edits.set_position(table.session.document, 0, 0, (1 / 3, 0.1 + 0.2)), "Move")
    steps, before = table.session.undo_stack.count(), table.session.document
    for column, exact in ((X, 1 / 3), (Y, 0.1 + 0.2)):
        editor = table.edit(0, column)
        assert editor.text() == repr(exact)
        table.qtbot.keyClick(editor, Qt.Key.Key_Return)
    table.type(0, X, repr(1 / 3))
    assert table.session.undo_stack.count() == steps
    assert table.session.document is before


@pytest.mark.parametrize(
    ("times", "shown"),
    [
        ([0.1 * k for k in range(3)] + [0.1 + 0.2, 0.4], ["0.0", "0.1", "0.2", "0.3", "0.4"]),
        ([k / 30 for k in range(5)], ["0.00000", "0.03333", "0.06667", "0.10000", "0.13333"]),
        # A clock's seconds: they were 1.7e9, one like the other.
        (
            [1.7e9 + 0.04 * k for k in range(5)],
            ["1700000000.00", "1700000000.04", "1700000000.08", "1700000000.12", "1700000000.16"],
        ),
    ],
)
def test_imported_parameters_read_well_and_are_whole_when_edited(table, times, shown):
    points = tuple(Point(float(k), float(k % 2), t=t) for k, t in enumerate(times))
    curve = replace(
        table.session.active_curve, points=points, parametrization=Parametrization(ParametrizationKind.MANUAL)
    )
    table.session.commit(table.session.document.with_curve(0, curve), "Import")
    QApplication.processEvents()
    delegate = table.view.cell_delegate
    assert [delegate.text(row, T) for row in range(5)] == shown
    for row, t in enumerate(times):
        editor = table.edit(row, T)
        assert float(editor.text()) == t
        table.qtbot.keyClick(editor, Qt.Key.Key_Escape)
    metrics = table.view.fontMetrics()
    assert table.view.columnWidth(T) >= metrics.horizontalAdvance(shown[-1]) + 3
    assert sum(table.view.columnWidth(each) for each in (T, X, Y)) <= table.view.viewport().width()


def test_an_estimated_cell_that_is_not_edited_stays_estimated(hermite):
    editor = hermite.edit(2, VX)
    hermite.qtbot.keyClick(editor, Qt.Key.Key_Return)
    assert hermite.point(2).velocity is None


def test_a_text_being_typed_survives_a_change_of_the_curve(table):
    editor = table.edit(3, X)
    table.qtbot.keyClicks(editor, "42")
    table.session.commit(point_edits.move_points(table.session.document, 0, [3], (1.0, 1.0)), "Move point 3")
    assert editor.text() == "42"
    table.qtbot.keyClick(editor, Qt.Key.Key_Return)
    assert table.point(3).position == (42.0, 3.5)


def test_the_editor_grows_with_the_text(table):
    table.session.commit(point_edits.set_position(table.session.document, 0, 0, (-1 / 3e-7, 0.0)), "Move")
    editor = table.edit(0, X)
    assert editor.width() > editor.fontMetrics().horizontalAdvance(editor.text())
    assert editor.geometry().right() <= table.view.viewport().rect().right()
    table.qtbot.keyClick(editor, Qt.Key.Key_Escape)


def test_numbers_with_a_decimal_comma(table):
    QLocale.setDefault(QLocale("de_DE"))
    table.type(3, X, "1,5")
    assert table.point(3).x == 1.5
    assert table.displayed(3, X) == "1,5"
    table.type(3, X, "1.234,5")
    assert table.point(3).x == 1.5
    assert "group separators" in table.message
    table.qtbot.keyClick(table.editor, Qt.Key.Key_Escape)
    table.type(3, X, "1.234")
    assert table.point(3).x == 1.234


def test_set_data_accepts_numbers_and_expressions(table):
    index = table.model.index(4, Y)
    assert table.model.setData(index, 0.5)
    assert table.point(4).y == 0.5
    assert table.model.setData(index, "1/3")
    assert table.point(4).y == 1 / 3
    before = table.session.document
    for bad in (float("nan"), float("inf"), 1e13, "x", "", None, True, "9**9**9"):
        assert not table.model.setData(index, bad)
        assert table.message.startswith("⚠ ")
    assert table.session.document is before
    assert not table.model.setData(index, "1", Role.DisplayRole)


# Parameters


def test_typing_t_makes_the_parameters_manual(table):
    others = [table.value(row, T) for row in range(8)]
    table.type(2, T, "1/4")
    others[2] = 0.25
    curve = table.session.active_curve
    assert curve.parametrization.kind is ParametrizationKind.MANUAL
    assert [point.t for point in curve.points] == others
    assert table.session.undo_stack.undoText() == "Set t of point 2"


def test_parameters_that_would_change_their_order_are_refused(table):
    before = table.session.document
    table.type(2, T, "0.9")
    assert table.session.document is before
    assert "must be less than" in table.message
    assert table.message.count("point 2") == 1
    table.qtbot.keyClick(table.editor, Qt.Key.Key_Escape)
    table.type(2, T, "0")
    assert table.session.document is before
    assert "must be greater than" in table.message


# Velocities and accelerations


def test_a_typed_component_makes_both_components_explicit(quintic):
    velocity = quintic.session.active_view.curve.jets[2, 1]
    quintic.type(2, VY, "1.5")
    assert quintic.point(2).velocity == (velocity[0], 1.5)
    assert quintic.session.undo_stack.undoText() == "Set vy of point 2"
    # The velocity is a condition of the acceleration's estimate.
    acceleration = quintic.session.active_view.curve.jets[2, 2]
    quintic.type(2, AX, "-2")
    assert quintic.point(2).acceleration == (-2.0, acceleration[1])


def test_a_jerk_can_be_typed_reset_and_pasted_with_the_point(septic):
    jerk = septic.session.active_view.curve.jets[2, 3]
    septic.type(2, JY, "1.5")
    assert septic.point(2).jerk == (jerk[0], 1.5)
    assert septic.session.undo_stack.undoText() == "Set jy of point 2"
    assert septic.point(2).acceleration is None
    septic.click(2, JX)
    septic.qtbot.keyClick(septic.view, Qt.Key.Key_Delete)
    assert septic.point(2).jerk is None
    assert septic.session.undo_stack.undoText() == "Reset jerk of point 2"


def set_derivatives(table, *indices):
    document = table.session.document
    for index in indices:
        document = point_edits.set_velocity(document, 0, index, (1.0, 2.0))
        document = point_edits.set_derivative(document, 0, index, 2, (3.0, 4.0))
    table.session.commit(document, "Set")


def test_delete_resets_the_selected_derivatives(quintic):
    QShortcut(QKeySequence("Del"), quintic.window, lambda: pytest.fail("the shortcut took the key"))
    set_derivatives(quintic, 2, 3)
    quintic.click(2, VX)
    quintic.qtbot.keyClick(quintic.view, Qt.Key.Key_Delete)
    assert quintic.point(2).velocity is None
    assert quintic.point(2).acceleration == (3.0, 4.0)
    assert quintic.point(3).velocity == (1.0, 2.0)
    assert quintic.session.undo_stack.undoText() == "Reset velocity of point 2"


def test_delete_in_other_columns_is_handled_by_the_window(hermite):
    heard = []
    QShortcut(QKeySequence("Del"), hermite.window, lambda: heard.append("Del"))
    set_derivatives(hermite, 2)
    hermite.click(2, X)
    hermite.qtbot.keyClick(hermite.view, Qt.Key.Key_Delete)
    assert heard == ["Del"]
    assert hermite.point(2).velocity == (1.0, 2.0)


def test_the_button_resets_the_selected_points(quintic):
    button = quintic.panel.findChild(QToolButton, "resetToEstimated")
    set_derivatives(quintic, 2, 3, 5)
    quintic.session.selected.set_points([1])
    assert not button.isEnabled()
    quintic.session.selected.set_points([2, 3])
    assert button.isEnabled()
    quintic.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert [quintic.point(i).velocity for i in (2, 3, 5)] == [None, None, (1.0, 2.0)]
    assert [quintic.point(i).acceleration for i in (2, 3, 5)] == [None, None, (3.0, 4.0)]
    assert quintic.session.undo_stack.undoText() == "Reset derivatives of 2 points"
    assert not button.isEnabled()


def test_the_reset_is_enabled_only_with_derivatives_that_are_set(table):
    assert not table.panel.findChild(QToolButton, "resetToEstimated").isVisible()
    assert not table.panel.findChild(QAction, "resetCellsToEstimated").isVisible()


# Selection


def test_a_click_on_rows_selects_the_points(table):
    table.click(2, X)
    assert table.session.selection == {2}
    table.click(4, Y, Qt.KeyboardModifier.ShiftModifier)
    assert table.session.selection == {2, 3, 4}
    table.click(6, X, Qt.KeyboardModifier.ControlModifier)
    assert table.session.selection == {2, 3, 4, 6}
    table.qtbot.keyClick(table.view, Qt.Key.Key_Down)
    assert table.session.selection == {7}


def test_the_row_header_selects_the_whole_row(table):
    header = table.view.verticalHeader()
    place = QPoint(5, header.sectionViewportPosition(3) + 4)
    table.qtbot.mouseClick(header.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert table.session.selection == {3}
    assert table.view.selected_cells() == {(3, column) for column in range(WIDTH)}


def test_selected_points_select_the_rows(table):
    changes = QSignalSpy(table.session.selection_changed)
    table.session.selected.set_points([1, 2, 5])
    assert table.view.selected_rows() == {1, 2, 5}
    table.session.selected.set_points([])
    assert table.view.selected_rows() == frozenset()
    assert changes.count() == 2  # no echo


def test_cells_selected_by_the_user_stay_selected(table):
    table.click(2, X)
    assert table.view.selected_cells() == {(2, X)}


def test_rows_and_columns_match_the_cells(hermite):
    for row, column in ((1, T), (4, VX), (6, VX)):
        hermite.click(row, column, Qt.KeyboardModifier.ControlModifier)
        cells = hermite.view.selected_cells()
        assert (row, column) in cells
        assert hermite.view.selected_rows() == {row for row, _ in cells}
        assert hermite.view.selected_columns() == {column for _, column in cells}
    assert hermite.view.selected_columns() == {T, VX}


def test_the_row_of_a_new_selected_point_is_selected(table):
    document = point_edits.insert_points(table.session.document, 0, 8, [make_curve([(5.0, 5.0)]).points[0]])
    table.session.selected.set_points([8])
    assert table.session.selection == frozenset()
    table.session.commit(document, "Add point 8")
    table.session.selected.set_points([8])
    assert table.view.selected_rows() == {8}
    assert table.session.selection == {8}


def test_deleting_points_never_writes_a_selection_back(table):
    table.session.selected.set_points([6, 7])
    changes = QSignalSpy(table.session.selection_changed)
    table.session.commit(point_edits.delete_points(table.session.document, 0, {6, 7}), "Delete points")
    assert table.view.selected_rows() == frozenset()
    assert changes.count() == 1  # the session's own


def test_another_family_keeps_the_selection(table):
    table.session.selected.set_points([3])
    table.session.commit(rule_edits.set_family(table.session.document, 0, HERMITE), "Family")
    assert table.model.columnCount() == len(columns_of(derivatives=1))
    assert table.view.selected_rows() == {3}
    assert table.session.selection == {3}


# Copy and paste


def test_copied_cells_are_whole_numbers_with_tabs_between(table):
    table.session.commit(point_edits.set_position(table.session.document, 0, 1, (1 / 3, -2.0)), "Move")
    table.click(0, X)
    table.click(1, Y, Qt.KeyboardModifier.ShiftModifier)
    assert table.copy() == "3.1\t3.35\n0.3333333333333333\t-2.0"


def test_copied_numbers_are_pasted_bit_for_bit(hermite):
    before = hermite.session.active_view.curve.jets
    hermite.session.selected.set_points(range(8))
    text = hermite.copy()
    hermite.click(0, T)
    hermite.paste(text)
    assert (hermite.session.active_view.curve.jets == before).all()


def test_paste_writes_a_block_as_one_step(table):
    steps = table.session.undo_stack.count()
    table.click(2, X)
    table.paste("10\t11\n12\t13\n14,5\t15")
    assert [table.point(row).position for row in (2, 3, 4)] == [(10, 11), (12, 13), (14.5, 15)]
    assert table.session.undo_stack.undoText() == "Paste 3 points"
    assert table.session.selection == {2, 3, 4}
    assert table.session.undo_stack.count() == steps + 1


def test_paste_beyond_the_end_appends_points(table):
    table.click(7, X)
    table.paste("1 2\n3 4\n5 6\n")
    curve = table.session.active_curve
    assert [point.position for point in curve.points[7:]] == [(1, 2), (3, 4), (5, 6)]
    assert table.model.rowCount() == 10
    assert curve.parametrization.kind is ParametrizationKind.CHORD_LENGTH


def test_a_paste_with_parameters_makes_parameters_manual(table):
    table.click(6, T)
    table.paste("t\tx\ty\n2\t1\t1\n3\t2\t2\n4\t3\t3\n")
    curve = table.session.active_curve
    assert [point.t for point in curve.points[6:]] == [2, 3, 4]
    assert [point.position for point in curve.points[6:]] == [(1, 1), (2, 2), (3, 3)]
    assert curve.is_manual
    assert table.session.undo_stack.undoText() == "Paste 3 points"


def test_a_paste_appends_manual_parameters_at_the_last_step(table):
    document = rule_edits.freeze_parameters(table.session.document, 0, list(range(8)))
    table.session.commit(document, "Freeze")
    table.click(7, X)
    table.paste("1 1\n2 2\n3 3")
    times = [point.t for point in table.session.active_curve.points]
    assert times == sorted(times)
    assert table.session.active_view.is_current


@pytest.mark.parametrize("is_closed", [False, True])
def test_pasted_points_keep_the_handles_of_other_points(hermite, is_closed):
    if is_closed:
        closed(hermite)
    document = point_edits.set_velocity(hermite.session.document, 0, 2, (3.0, 4.0))
    hermite.session.commit(document, "Set")

    def handle():
        view = hermite.session.active_view
        return np.multiply(view.spacing(2, ahead=True), view.velocity_of(2))

    before = handle()
    hermite.click(7, X)
    hermite.paste("0.75 0.6\n3 4\n5 6")
    np.testing.assert_allclose(handle(), before, rtol=1e-13)


def test_paste_into_an_empty_table(qtbot):
    table = Table(qtbot, points=[])
    table.paste("0 0\n1 1\n2 0\n")
    assert [point.position for point in table.session.active_curve.points] == [(0, 0), (1, 1), (2, 0)]
    table = Table(qtbot, HERMITE, points=[])
    table.paste("0;0;0;1;1\n2;1;1;1;0\n")
    assert [point.t for point in table.session.active_curve.points] == [0, 2]
    assert table.point(1).velocity == (1, 0)


def test_paste_velocities(hermite):
    kept = hermite.session.active_view.velocity_of(3)
    hermite.click(3, VX)
    hermite.paste("5\n6")
    assert hermite.point(3).velocity == (5.0, kept[1])
    assert hermite.point(4).velocity[0] == 6.0
    assert hermite.session.undo_stack.undoText() == "Paste 2 values"


BAD_PASTES = [
    ((0, X), "1\t2\n3\t4\n5\tabc", "Row 3, column 2: “abc” is not a number."),
    ((0, X), "1\t2\n3\t", "Row 2, column 2 is empty."),
    ((0, X), "1\t2\n3", "Row 2 has 1 cell, but the first row has 2."),
    ((0, X), "1\t1/0", "Row 1, column 2: Division by zero."),
    ((0, X), "1\t2e12", "Row 1, column 2: Enter a number between"),
    ((0, X), "1,234\t1,000", "Row 1, column 1: “1,234” is ambiguous"),
    ((0, X), "1,234.5\t1", "group separators"),
    (
        (0, X),
        "\t".join("1" * WIDTH),
        f"{WIDTH} columns do not fit: from x on there is room for {WIDTH - 1} columns.",
    ),
    ((7, T), "5\n6", "new points need x and y"),
    ((0, T), "0\n0", "The t of point 1 must be greater than 0"),
    ((0, X), "", "no numbers on the clipboard"),
    ((0, X), "hello", "“hello” is not a number"),
]


def test_an_invalid_paste_changes_nothing_and_shows_a_reason(table):
    for cell, text, words in BAD_PASTES:
        before, steps = table.session.document, table.session.undo_stack.count()
        table.click(*cell)
        table.paste(text)
        assert words in table.message, text
        assert table.session.document is before, text
        assert table.session.undo_stack.count() == steps, text


def test_new_points_need_whole_vectors(hermite):
    hermite.click(7, X)
    hermite.paste("1 2 3\n4 5 6")
    assert "not vx alone" in hermite.message


def test_copy_and_paste_belong_to_the_table_only_with_the_focus(table):
    field = QLineEdit(table.window)
    field.show()
    field.setFocus()
    table.session.selected.set_points([0])
    QGuiApplication.clipboard().setText("kept")
    table.qtbot.keyClick(field, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert QGuiApplication.clipboard().text() == "kept"


@pytest.mark.parametrize("key", ["Ctrl+C", "Ctrl+V"])
def test_shortcuts_of_the_window_do_not_replace_copy_and_paste(table, key):
    QShortcut(QKeySequence(key), table.window, lambda: pytest.fail("the shortcut took the key"))
    table.click(0, X)
    assert table.copy() == "3.1"
    table.paste("7")
    assert table.point(0).x == 7


# Pace


def many_points(count):
    x = np.linspace(0, 10, count)
    return list(zip(x, np.sin(x), strict=True))


def test_a_thousand_rows_are_updated_and_not_reset(qtbot):
    table = Table(qtbot, HERMITE, many_points(1000))
    document = rule_edits.freeze_parameters(table.session.document, 0, list(range(1000)))
    table.session.commit(document, "Freeze")
    resets, changes = QSignalSpy(table.model.modelReset), QSignalSpy(table.model.dataChanged)
    rows = QSignalSpy(table.model.rowsInserted)
    document = rule_edits.set_rule(document, 0, VelocityRule.FINITE_DIFFERENCE)
    table.session.commit(document, "Rule")
    changed = changes.count()
    table.session.commit(
        point_edits.move_points(table.session.document, 0, [500], (0.0, 1.0)), "Move point 500"
    )
    # Finite differences reach as far as the neighbours.
    assert (changes.at(changed)[0].row(), changes.at(changed)[1].row()) == (499, 501)
    assert changes.count() == changed + 1
    assert resets.count() == rows.count() == 0


def test_a_stream_of_previews_is_followed_at_a_pace_and_ends_on_the_last(qtbot):
    table = Table(qtbot)
    table.rest()
    changes = QSignalSpy(table.model.dataChanged)
    before = table.session.document
    for step in range(1, 51):
        table.session.preview(point_edits.move_points(before, 0, [3], (0.01 * step, 0.0)))
    assert changes.count() < 10
    until(lambda: table.value(3, X) == 1.25 + 0.5)
    table.session.preview(point_edits.move_points(before, 0, [3], (1.0, 0.0)))
    table.session.commit(table.session.document, "Move point 3")
    assert table.value(3, X) == 2.25  # a step of the history does not wait


def test_a_cancelled_drag_leaves_the_old_numbers(qtbot):
    table = Table(qtbot)
    for step in range(5):
        table.session.preview(point_edits.move_points(table.session.document, 0, [3], (0.1 * step, 0.0)))
    table.session.cancel()
    until(lambda: table.value(3, X) == 1.25)


def test_a_hidden_table_is_updated_when_it_becomes_visible(qtbot):
    table = Table(qtbot)
    table.panel.hide()
    changes = QSignalSpy(table.model.dataChanged)
    table.session.preview(point_edits.move_points(table.session.document, 0, [3], (1.0, 0.0)))
    until(lambda: not table.panel._timer.isActive())
    assert changes.count() == 0
    table.panel.show()
    assert table.value(3, X) == 2.25


def test_rendering_commits_nothing(quintic):
    steps = quintic.session.undo_stack.count()
    for family in FAMILIES:
        quintic.session.preview(rule_edits.set_family(quintic.session.document, 0, family))
        quintic.rest()
    quintic.session.cancel()
    assert quintic.session.undo_stack.count() == steps


def test_everything_has_a_name_and_a_tooltip(hermite):
    for kind in (QToolButton, QAction):
        for widget in hermite.panel.findChildren(kind):
            assert widget.objectName()
            assert widget.toolTip()
    editor = hermite.edit(2, VX)
    assert editor.accessibleName() == "vx of point 2"
    assert "1/3" in editor.toolTip()
    hermite.qtbot.keyClick(editor, Qt.Key.Key_Escape)
    assert hermite.view.accessibleName() == "Points"


@pytest.mark.parametrize("points", [((0, 0), (1, 2), (3, 2)), ((0, 0), (1, 2), (3, 2), (4, 0), (5, 1))])
def test_other_rows_are_painted_once(arch, points):
    """They were painted, laid out, and painted again: with every point that was added."""
    paints = paints_of(arch.window.point_table.viewport())
    arch.session.commit(Document((make_curve(points),)), "Other points")
    arch.settle()
    arch.settle()
    assert paints.count == 1


# Left by a click elsewhere


def test_a_number_that_was_typed_but_not_entered_never_reaches_the_curve(table):
    field = QLineEdit(table.window)
    field.show()
    before, said = table.session.document, refusals_of(table.session)
    table.click(3, X)
    table.qtbot.keyClick(table.view, Qt.Key.Key_2)
    table.qtbot.mouseClick(field, Qt.MouseButton.LeftButton)
    field.setFocus(Qt.FocusReason.MouseFocusReason)
    assert table.editor is None
    assert table.session.document is before
    assert said == ["X of point 3 was not changed. Press Enter or Tab to set a typed number."]
    table.click(3, X)
    table.qtbot.keyClick(table.view, Qt.Key.Key_7)
    table.click(5, Y)
    assert table.editor is None
    assert table.session.document is before


def test_another_window_leaves_the_editor_open(table):
    editor = table.edit(3, X)
    table.qtbot.keyClicks(editor, "42")
    QApplication.sendEvent(
        editor, QFocusEvent(QFocusEvent.Type.FocusOut, Qt.FocusReason.ActiveWindowFocusReason)
    )
    assert table.editor is editor
    table.qtbot.keyClick(editor, Qt.Key.Key_Return)
    assert table.point(3).x == 42.0


# Messages go when their cause has gone


@pytest.mark.parametrize("way", ["escape", "click elsewhere", "another edit", "a preview", "another widget"])
def test_a_refusal_is_removed_with_its_cause(table, way):
    field = QLineEdit(table.window)
    field.show()
    editor = table.type(3, X, "2*")
    assert table.message
    document = point_edits.move_points(table.session.document, 0, [0], (1.0, 0.0))
    if way == "escape":
        table.qtbot.keyClick(editor, Qt.Key.Key_Escape)
    elif way == "click elsewhere":
        table.click(5, Y)
    elif way == "another edit":
        table.session.commit(document, "Move point 0")
    elif way == "a preview":
        table.session.preview(document)
    else:
        field.setFocus()
    assert table.message == ""


def test_a_refused_paste_is_explained_until_another_cell_is_current(table):
    table.click(2, X)
    table.paste("abc")
    assert table.message
    table.qtbot.keyClick(table.view, Qt.Key.Key_Down)
    assert table.message == ""


# Decimals


def texts(table, column):
    delegate = table.view.cell_delegate
    return [delegate.text(row, column) for row in range(table.model.rowCount())]


def decimals(table, column):
    return {len(text.partition(".")[2]) for text in texts(table, column)}


def test_a_column_keeps_its_decimals_while_previews_stream(table):
    assert decimals(table, X) == {2}
    before, seen = table.session.document, []
    for step in range(1, 6):
        table.session.preview(
            point_edits.move_points(before, 0, [3], (0.5 * step + 0.1 ** (step % 3 + 1), 0.0))
        )
        table.rest()
        assert len(decimals(table, X)) == 1
        seen.append(decimals(table, X))
    assert seen == [seen[0]] * 5
    table.session.cancel()
    table.rest()
    assert decimals(table, X) == {2}


def test_a_number_that_outgrows_its_column_loses_decimals_once(table):
    before = table.session.document
    counts = []
    for x in (0.123, 5000.123, 0.123):
        table.session.preview(point_edits.set_position(before, 0, 3, (x, 0.0)))
        table.rest()
        counts.append(decimals(table, X))
    assert max(counts[1]) < max(counts[0])
    assert counts[1] == counts[2]


def test_a_change_of_decimals_is_painted_in_every_row(table):
    table.rest()
    painted = []
    paint = table.view.cell_delegate.paint
    table.view.cell_delegate.paint = lambda painter, option, index: (
        painted.append(index.row()),
        paint(painter, option, index),
    )
    table.session.preview(point_edits.set_position(table.session.document, 0, 3, (1 / 3, 2.5)))
    table.rest()
    assert set(painted) == set(range(8))


def test_rounding_residues_are_displayed_as_zero_and_stored_exactly(hermite):
    document = point_edits.set_velocity(hermite.session.document, 0, 2, (8e-16, -1043.4))
    hermite.session.commit(document, "Set")
    assert float(texts(hermite, VX)[2]) == 0
    assert hermite.displayed(2, VX) == "0"
    assert texts(hermite, VY)[2].startswith("−1043")
    assert "8e−16" in hermite.model.data(hermite.model.index(2, VX), Role.ToolTipRole)
    assert hermite.edit(2, VX).text() == "8e-16"
    hermite.qtbot.keyClick(hermite.editor, Qt.Key.Key_Escape)
    assert hermite.point(2).velocity == (8e-16, -1043.4)


def test_a_quintic_curve_fits_in_a_dock(quintic):
    # Columns beyond x, y, t and the derivatives have room of their own.
    width = 360 + 60 * (quintic.model.columnCount() - 7)
    quintic.window.resize(width, 400)
    header, viewport = quintic.view.horizontalHeader(), quintic.view.viewport()
    until(lambda: header.length() <= viewport.width() < width)
    metrics = quintic.view.fontMetrics()
    for column in range(7):
        room = quintic.view.columnWidth(column)
        # Nine pixels between two numbers, twice a space: with five they were read as one.
        assert all(metrics.horizontalAdvance(text) + 9 <= room for text in texts(quintic, column))
    assert max(len(text.partition(".")[2]) for text in texts(quintic, X)) >= 2


# Pasting over velocities, with titles, one value into many


def test_points_that_keep_their_own_velocities_are_named_and_can_be_reset(hermite):
    set_derivatives(hermite, 2, 6)
    hermite.click(1, X)
    hermite.paste("1 1\n2 2\n3 3")
    assert hermite.message.startswith("⚠ Point 2 keeps its own velocity · ")
    label = hermite.panel.findChild(QLabel, "pointTableMessage")
    label.linkActivated.emit("reset")
    assert hermite.point(2).velocity is None
    assert hermite.point(2).acceleration == (3.0, 4.0)  # not this family's
    assert hermite.point(6).velocity == (1.0, 2.0)
    assert hermite.session.undo_stack.undoText() == "Reset velocity of point 2"
    assert hermite.message == ""


def test_the_link_in_the_message_is_clicked(hermite):
    set_derivatives(hermite, 2)
    hermite.click(2, X)
    hermite.paste("1 1")
    label = hermite.panel.findChild(QLabel, "pointTableMessage")
    end = label.fontMetrics().horizontalAdvance("⚠ Point 2 keeps its own velocity · Reset")
    place = QPoint(10 + end - 8, label.height() // 2)
    hermite.qtbot.mouseMove(label, place)
    hermite.qtbot.mouseClick(label, Qt.MouseButton.LeftButton, pos=place)
    assert hermite.point(2).velocity is None


def test_pasted_velocities_keep_nothing(quintic):
    set_derivatives(quintic, 2)
    quintic.click(2, X)
    quintic.paste("1 1 0 0")
    assert "Point 2 keeps its own acceleration" in quintic.message
    quintic.click(2, X)
    quintic.paste("1 1 0 0 0 0")
    assert quintic.message == ""


def test_titles_name_the_columns_wherever_the_current_cell_is(hermite):
    hermite.click(6, VX)
    hermite.paste("t;x;y\n2;1;1\n3;2;2")
    assert [hermite.point(row).t for row in (6, 7)] == [2, 3]
    assert [hermite.point(row).position for row in (6, 7)] == [(1, 1), (2, 2)]
    hermite.click(0, T)
    hermite.paste("#\tY\tvy\tX\tvx\n0\t5\t6\t7\t8")
    assert hermite.point(0).position == (7, 5)
    assert hermite.point(0).velocity == (8, 6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("t;x;y;vx;vy\n0;1;2;3;4", "no vx"),
        ("x;x\n1;2", "twice"),
        ("x;y\n1;2;3", "2 titles, but 3 columns"),
        ("#\n1", "no column"),
    ],
)
def test_titles_that_do_not_fit_are_explained(table, text, words):
    before = table.session.document
    table.click(0, X)
    table.paste(text)
    assert words in table.message
    assert table.session.document is before


def test_one_value_fills_the_selected_cells(quintic):
    kept = quintic.point(2).y
    quintic.click(2, X)
    for row, column in ((4, X), (3, VX), (3, VY)):
        quintic.click(row, column, Qt.KeyboardModifier.ControlModifier)
    quintic.paste("1/2")
    assert quintic.point(2).position == (0.5, kept)
    assert quintic.point(4).x == 0.5
    assert quintic.point(3).velocity == (0.5, 0.5)
    assert quintic.session.undo_stack.undoText() == "Fill 4 cells"
    assert quintic.shown_points == [quintic.session.document]


def test_points_cannot_share_a_t(table):
    before = table.session.document
    table.click(2, T)
    table.click(3, T, Qt.KeyboardModifier.ControlModifier)
    table.paste("0.5")
    assert "its own t" in table.message
    assert table.session.document is before
    table.click(3, T)
    table.click(3, X, Qt.KeyboardModifier.ControlModifier)
    table.paste("0.5")
    assert (table.point(3).t, table.point(3).x) == (0.5, 0.5)


# Closed curves and corners


def closed(table):
    table.session.commit(curve_edits.set_closed(table.session.document, 0, True), "Close")
    return table.session.active_view


def test_a_closed_curve_has_a_row_for_each_point(quintic):
    view = closed(quintic)
    assert quintic.model.rowCount() == 8
    assert len(view.parameters) == 9
    assert [quintic.value(row, T) for row in range(8)] == list(view.parameters[:8])
    quintic.type(3, T, "(0.0+1/3)")
    curve = quintic.session.active_curve
    assert curve.is_manual
    assert quintic.session.active_view.parameters[-1] == 1.0
    quintic.type(7, T, "1")
    assert "at which the curve returns to its first point" in quintic.message
    quintic.qtbot.keyClick(quintic.editor, Qt.Key.Key_Escape)


def test_pasting_into_a_closed_curve(hermite):
    closed(hermite)
    hermite.click(0, T)
    hermite.paste("\n".join(str(t) for t in range(8)))
    assert hermite.session.active_view.parameters.tolist() == list(range(9))
    hermite.click(7, X)
    hermite.paste("0 0\n1 1\n2 2")
    view = hermite.session.active_view
    assert view.is_current
    assert view.parameters.tolist() == list(range(11))


def test_at_a_corner_the_table_shows_the_number_before_the_corner(hermite):
    document = point_edits.make_corner(hermite.session.document, 0, 3, (1.0, 2.0), (3.0, 4.0))
    hermite.session.commit(document, "Corner")
    assert (hermite.value(3, VX), hermite.value(3, VY)) == (1.0, 2.0)
    tip = hermite.model.data(hermite.model.index(3, VY), Role.ToolTipRole)
    assert "before the corner; 4.0 after it" in tip
    hermite.type(3, VX, "7")
    assert hermite.point(3).velocity == (7.0, 2.0)
    assert hermite.point(3).velocity_after == (3.0, 4.0)
    hermite.session.selected.set_points([3])
    hermite.panel.reset_to_estimated()
    assert hermite.point(3).velocity is hermite.point(3).velocity_after is None


def test_a_velocity_that_is_set_only_after_a_corner_can_be_reset(hermite):
    document = point_edits.make_corner(hermite.session.document, 0, 3, None, (3.0, 4.0))
    hermite.session.commit(document, "Corner")
    hermite.session.selected.set_points([3])
    button = hermite.panel.findChild(QToolButton, "resetToEstimated")
    assert button.isEnabled()
    hermite.qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert hermite.point(3).velocity_after is None


def test_a_corner_at_the_first_point_shows_the_number_after_the_corner(hermite):
    document = point_edits.make_corner(hermite.session.document, 0, 0, None, (3.0, 4.0))
    hermite.session.commit(document, "Corner")
    assert (hermite.value(0, VX), hermite.value(0, VY)) == (3.0, 4.0)
    hermite.type(0, VX, "5")
    assert hermite.session.active_view.curve.jets[0, 1].tolist() == [5.0, 4.0]


@pytest.mark.parametrize("scale", [1.0, 100.0, 0.01])
def test_neighbouring_numbers_of_a_quintic_table_never_touch(qtbot, scale):
    """Where 9 pixels are promised, 6 were left before a dragged x that got its minus, and 5 before −1043."""
    table = Table(qtbot, QUINTIC_HERMITE, [(x * scale, y * scale - 0.001) for x, y in POINTS])
    session, view, before = table.session, table.view, table.session.document
    metrics, across = view.fontMetrics(), view.horizontalHeader()

    def least_gap():
        """Between the beginning of any number and the end of the one before it."""
        rows, columns = range(view.model().rowCount()), range(across.count())
        texts = [[view.cell_delegate.text(row, column) for column in columns] for row in rows]
        return min(
            across.sectionSize(c) - metrics.horizontalAdvance(line[c]) for line in texts for c in columns
        )

    promised = PADDING + LEFT_PADDING
    assert least_gap() >= promised
    for x in (-1.59, -159.0, 1.59):
        session.preview(point_edits.set_position(before, 0, 3, (x * scale, 1.1 * scale)))
        table.rest()
        assert least_gap() >= promised
    session.cancel()
    table.rest()
    assert least_gap() >= promised
