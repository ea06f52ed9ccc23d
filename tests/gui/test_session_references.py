"""Plain numbers in the session; selection, hover and scrub line refer only to existing objects."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLabel

from app.document import point_edits, rule_edits
from app.document.model import Document, Point, make_curve
from app.families import HERMITE, LAGRANGE
from app.features.point_table.commands import PointTableCommands
from app.session import Session
from app.tools.add_points import selection_of
from app.tools.canvas.select import SELECT
from app.tools.pointer import Pointer
from app.tools.tool import Drag
from app.tools.toolbox import Toolbox

EDGE = 1e12


@pytest.fixture
def at_the_edge(editor):
    """Three points at the end of what a file can hold, and a view that shows more than that."""
    points = [(EDGE - 4e9, 0.0), (EDGE - 2e9, 1e9), (EDGE, 0.0)]
    editor.session.commit(Document((make_curve(points),)), "Begin")
    editor.fit()
    editor.select([1])
    editor.trigger("addTool")
    return editor


def named(session):
    """What the session names, as a value."""
    return (
        session.active_index,
        session.selection,
        session.selected.curves,
        session.selected.hovered,
        session.scrub.t,
    )


def assert_exists(session):
    """Raise unless everything that the session names is there."""
    curves, points = range(len(session.document.curves)), range(len(session.active_curve.points))
    assert session.active_index in curves
    assert session.active_index in session.selected.curves
    assert all(index in curves for index in session.selected.curves)
    assert all(type(index) is int and index in points for index in session.selection)
    assert session.selected.hovered == -1 or session.selected.hovered in points
    if session.scrub.t is not None:
        start, end = session.active_view.curve.domain
        assert type(session.scrub.t) is float
        assert start <= session.scrub.t <= end


# Plain numbers


def test_after_a_fit_the_pointer_has_plain_floats(editor):
    for plot in (editor.window.canvas, editor.window.basis_panel):
        places = [*plot.to_plane(QPointF(50.5, 60.0)), *plot.pixel_map.box, plot.camera.pixel_size]
        assert [type(value) for value in places] == [float] * 7


def test_a_point_clicked_after_a_fit_is_nudged_by_a_grid_step(editor):
    """`repr` of its x was "np.float64(1.0021264288264025)": decimal.InvalidOperation."""
    editor.fit()
    editor.trigger("addTool")
    editor.click((1.0, 1.0))
    editor.trigger("toggleSnap")
    (new,) = editor.session.selected.points
    x, y = editor.point(new)
    editor.key(Qt.Key.Key_Right)
    assert editor.point(new) == pytest.approx(
        (x + editor.window.canvas.tools.canvas.grid_spacing(), y), abs=1e-15
    )


def test_numpy_values_of_a_program_become_plain_numbers(odd_values):
    session = Session()
    session.new()
    points = tuple(Point(*row) for row in np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]]))
    document = Document((replace(session.active_curve, points=points),))
    assert odd_values(document)
    assert session.preview(document)
    assert odd_values(session.document) == []
    assert session.commit(document, "Numbers of NumPy")
    assert odd_values(session.document) == []
    session.files.restore(document, None)
    assert odd_values(session.document) == []


# What exists


def test_a_point_added_beyond_the_limits_is_refused_and_not_selected(at_the_edge):
    """It was: {3} of three points, and the next hover raised IndexError."""
    editor, before = at_the_edge, at_the_edge.session.document
    editor.click((EDGE + 1e8, 0.0))
    assert "must lie between" in editor.status
    assert editor.session.document is before
    assert editor.session.selection == {1}
    editor.hover((EDGE - 1e9, 1e8))
    assert_exists(editor.session)


def test_a_point_dragged_into_the_limits_is_selected_once_added(at_the_edge):
    editor = at_the_edge
    editor.press((EDGE + 1e8, 0.0))
    assert editor.session.selection == {1}
    editor.move((EDGE - 1e8, 2e8))
    assert editor.session.selection == {3}
    editor.release((EDGE - 1e8, 2e8))
    assert len(editor.curve.points) == 4
    assert editor.session.selection == {3}


def test_a_curve_begun_beyond_the_limits_is_refused_and_the_edited_curve_stays(at_the_edge):
    editor = at_the_edge
    editor.key(Qt.Key.Key_Return)
    before = named(editor.session)
    editor.click((EDGE + 1e8, -2e8))
    assert "must lie between" in editor.status
    assert len(editor.session.document.curves) == 1
    assert named(editor.session)[:3] == before[:3]
    assert_exists(editor.session)


class Append(Drag, kw_only=True):
    """A drag that appends a point which no file can hold."""

    starts_at_press = True
    done: list[bool]

    def document_at(self, pointer):
        point = Point(pointer.position[0], 2e12)
        curve = self.document.curves[0]
        return Document((replace(curve, points=(*curve.points, point)),))

    def undo_text(self, pointer):
        return "Append"

    def committed(self, event):
        self.done.append(True)


def test_a_gesture_refused_at_its_end_leaves_the_selection_and_offers_nothing():
    """What is said when it is done was said of what was refused, and the new point stayed selected."""
    session, done = Session(), []
    session.selected.set_points([1, 2])
    tools, count = Toolbox(session, SELECT), len(session.active_curve.points)
    pointer = Pointer((1.0, 1.0), (10.0, 10.0))
    selects = selection_of(0, count)
    tools.begin(lambda event: Append(document=event.session.document, selects=selects, done=done), pointer)
    assert session.selection == {count}
    tools.release(pointer)
    assert not done
    assert len(session.active_curve.points) == count
    assert session.selection == {1, 2}


def test_a_paste_into_the_table_of_a_locked_curve_is_refused_with_a_message(editor):
    """The table said "Pasted 2 points." of what was refused, and selected rows that are not there."""
    editor.trigger("curveLocked")
    editor.select([4])
    table = editor.window.point_table
    panel = editor.window.commands[PointTableCommands].panel
    QGuiApplication.clipboard().setText("1\t2\n3\t4\n5\t6\n")
    table.setCurrentIndex(table.model().index(4, 1))
    before = editor.session.document
    panel.paste()
    assert editor.session.document is before
    assert "is locked" in editor.status
    assert_exists(editor.session)


def test_selection_hover_and_scrub_refer_only_to_existing_objects():
    session = Session()
    session.commit(
        Document((make_curve([(0, 0), (1, 1), (2, 0)]), make_curve([(0, 0), (1, 1)], name="Other"))), "Begin"
    )
    session.selected.set_points([-1, 0, np.int64(2), 3, 99])
    assert session.selection == {0, 2}
    for index, there in ((7, -1), (2, 2), (-5, -1), (2, 2)):
        session.selected.set_hovered(index)
        assert session.selected.hovered == there
    session.scrub.set(3.0)
    assert session.scrub.t == 1.0
    session.selected.set_curves([0, 5], 5)
    assert session.selected.curves == {0}
    session.selected.set_curves([-1, 1, 2])
    assert (session.active_index, session.selected.curves) == (1, {1})
    assert_exists(session)
    session.selected.activate(0)
    session.selected.set_points([0, 2])
    session.selected.set_hovered(2)
    session.preview(point_edits.delete_points(session.document, 0, [1, 2]))
    assert named(session) == (0, {0}, {0}, -1, None)
    session.cancel()
    assert session.scrub.t == 1.0
    session.commit(Document((make_curve([(0, 0), (1, 1)], name="Lone"),)), "Leave one")
    assert_exists(session)


def test_the_scrub_line_keeps_its_relative_place_in_the_interval():
    """A preview of a shorter interval left it at 3 of [0, 2]."""
    session = Session()
    session.commit(rule_edits.set_interval(session.document, 0, 0.0, 5.0), "To 5")
    session.scrub.set(3.0)
    session.preview(rule_edits.set_interval(session.document, 0, 0.0, 2.0))
    assert session.scrub.t == pytest.approx(1.2)
    session.preview(rule_edits.set_interval(session.document, 0, 0.0, 4.0))
    assert session.scrub.t == pytest.approx(2.4)
    session.preview(rule_edits.set_interval(session.document, 0, 3.5, 4.0))
    assert session.scrub.t == pytest.approx(3.8)
    session.cancel()
    assert session.scrub.t == 3.0
    session.commit(point_edits.delete_points(session.document, 0, range(1, 9)), "Delete")
    assert session.scrub.t is None
    session.undo_stack.undo()
    assert session.scrub.t == 3.0


def test_actions_are_checked_by_the_document_that_the_panels_show(editor):
    """Undo told of a selection that is there no more while the panels still showed the other family."""
    few = make_curve([(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)], family=LAGRANGE)
    many = make_curve([(float(i), float(i % 2)) for i in range(6)], family=HERMITE)
    editor.session.commit(Document((few,)), "Few")
    editor.session.commit(Document((many,)), "Many")
    editor.select([5])
    seen = []
    render = editor.window.commands.render_panels

    def recording(view):
        seen.append(view.source.family is editor.window.basis_panel.drawing._view.source.family)
        render(view)

    editor.window.commands.render_panels = recording
    try:
        editor.trigger("undo")
    finally:
        del editor.window.commands.render_panels
    assert editor.session.active_curve == few
    assert seen
    assert all(seen)
    assert "Λ 1.25" in {label.text() for label in editor.window.status_line.findChildren(QLabel)}
