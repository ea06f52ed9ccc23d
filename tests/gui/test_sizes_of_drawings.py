"""Sizes typed in drawings grow from the place that X and Y show, as in Inkscape; real keys and clicks."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QToolButton

Key = Qt.Key


@pytest.fixture
def rectangle(open_drawing, point_locale):
    """A rectangle of 40 × 20 at (4, 5) of the page; sides are typed apart."""
    editor = open_drawing(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="80mm" viewBox="0 0 100 80">'
        '<rect x="4" y="5" width="40" height="20" fill="#c04000"/></svg>'
    )
    editor.session.selected.choose([0])
    editor.trigger("openTransform")
    assert not editor.window.store.state.keep_proportions
    return editor


def field(editor, name):
    return editor.window.findChild(QLineEdit, f"transform{name}")


def enter(editor, name, text):
    edit = field(editor, name)
    edit.setFocus()
    edit.selectAll()
    editor.type_text(edit, text)
    QTest.keyClick(edit, Key.Key_Return)
    editor.settle()


def shown(editor):
    """X, Y, W and H as the panel shows them."""
    names = ("X", "Y", "Width", "Height")
    return tuple(float(field(editor, name).text().replace("−", "-")) for name in names)


def place(editor, name):
    button = editor.window.findChild(QToolButton, f"pivot{name}")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor.settle()
    return button


def test_a_typed_width_and_height_leave_the_corner_of_x_and_y_where_it_is(rectangle):
    """X became 5, for the rectangle was scaled about its middle."""
    assert shown(rectangle) == (4, 5, 40, 20)
    enter(rectangle, "Width", "38")
    assert shown(rectangle) == (4, 5, 38, 20)
    enter(rectangle, "Height", "30")
    assert shown(rectangle) == (4, 5, 38, 30)


@pytest.mark.parametrize(
    ("name", "x", "y"), [("Middle", 24, 15), ("BottomRight", 44, 25), ("TopLeft", 4, 5), ("Right", 44, 15)]
)
def test_a_place_that_is_chosen_is_that_of_x_and_y_and_stays(rectangle, name, x, y):
    assert place(rectangle, name).isChecked()
    assert shown(rectangle) == (x, y, 40, 20)
    enter(rectangle, "Width", "30")
    enter(rectangle, "Height", "50")
    assert shown(rectangle) == (x, y, 30, 50)
    enter(rectangle, "X", "60")
    assert shown(rectangle) == (60, y, 30, 50)


def test_nothing_is_chosen_first_and_a_pivot_elsewhere_leaves_the_corner(rectangle):
    names = [f"pivot{name}" for name in ("TopLeft", "Middle", "BottomRight")]
    assert not any(rectangle.window.findChild(QToolButton, name).isChecked() for name in names)
    target = rectangle.window.canvas.tools.target
    target.pivot = (90.0, 70.0)
    rectangle.settle()
    assert shown(rectangle) == (4, 5, 40, 20)
    assert target.centre == (90.0, 70.0), "turns are about it"
