"""Coordinates of drawings as they are told and typed: down from the upper left corner of the page."""

from __future__ import annotations

import re

import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit, QTableView

from app.document.model import Axis, Document, Guide, Page, Point, make_curve
from app.document.readings import readings_of
from app.families import HERMITE

Key = Qt.Key
ALT = Qt.KeyboardModifier.AltModifier
WIDTH, HEIGHT = 100.0, 80.0
PATH = (((10.0, 12.0), (20.0, 9.0)), ((32.0, 18.0), (24.0, -6.0)), ((46.0, 7.0), (15.0, -12.0)))
LEAF = (((60.0, 50.0), (9.0, -12.0)), ((80.0, 56.0), (12.0, 15.0)), ((68.0, 66.0), (-15.0, 9.0)))
KEPT = ("zoomField", "transformTurn", "transformSkew")
"""Fields that tell nothing of the document."""

ANALYSES = {
    "analysisDock", "basisPane", "fitDock", "jointsDock", "laboratoryDock", "lessonsDock", "plotPanel",
    "wiggleDock",
}  # fmt: skip
"""What tells numbers of a curve as mathematics has them: curvature is positive where it turns left."""

NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?")


def told_drawing(corner=(0.0, 0.0), *, up=False):
    """Return a drawing that is told as PATH and LEAF say, wherever its page lies and whichever way y goes."""
    frame = Document((make_curve(()),), page=Page(*corner, WIDTH, HEIGHT), unit="mm", y_up=up)
    readings = readings_of(frame)

    def curve(name, points):
        made = [Point(*readings.meant(place), velocity=readings.way(velocity)) for place, velocity in points]
        return replace(make_curve((), name=name, family=HERMITE), points=tuple(made))

    guides = (Guide(Axis.Y, readings.meant_at(1, 72.0)),)
    return replace(frame, curves=(curve("Path", PATH), curve("Leaf", LEAF)), guides=guides)


class Reader:
    """A person who reads all that a window tells, and does what is told."""

    def __init__(self, editor, document):
        self.editor, self.window, self.canvas = editor, editor.window, editor.window.canvas
        self.heard = []
        editor.session.files.begin(document)
        editor.settle()
        editor.trigger("fitPage")
        self.canvas.setFocus()
        editor.hover(self.at((95.0, 75.0)))

    @property
    def readings(self):
        return readings_of(self.editor.session.document)

    def at(self, told):
        return self.readings.meant(told)

    def down(self):
        return Key.Key_Down if self.readings.is_down else Key.Key_Up

    def reads(self, widget):
        """Whether a widget is in sight, and none of an analysis."""
        if not widget.isVisibleTo(self.window):
            return False
        while widget is not None and widget.objectName() not in ANALYSES:
            widget = widget.parentWidget()
        return widget is None

    def listen(self, step):
        """Note all texts with numbers that are in sight, and the document as it is told."""
        self.editor.wait_for_rest()
        session, readings = self.editor.session, self.readings
        texts = [f"undo {session.undo_stack.undoText()}", f"status {self.editor.status}"]
        for kind in (QLabel, QLineEdit):
            texts += [
                f"{each.objectName()} {each.text()}"
                for each in self.window.findChildren(kind)
                if self.reads(each) and each.objectName() not in KEPT
            ]
        for table in self.window.findChildren(QTableView):
            model = table.model()
            if self.reads(table) and model is not None:
                texts += [
                    f"{table.objectName()} {model.headerData(column, Qt.Orientation.Horizontal)} "
                    f"{model.index(row, column).data()}"
                    for row in range(model.rowCount())
                    for column in range(model.columnCount())
                ]
        points = [
            (readings.shown(point.position), point.velocity and readings.way(point.velocity))
            for curve in session.document.curves
            for point in curve.points
        ]
        self.heard.append((step, sorted({text for text in texts if NUMBER.search(text)}), points))


def press_move(reader, start, to, *, name):
    """Drag between two told places, and listen on the way and afterwards."""
    editor = reader.editor
    editor.press(reader.at(start))
    editor.move(reader.at(to))
    reader.listen(f"{name} on the way")
    editor.release(reader.at(to))
    reader.listen(name)


def keys(reader, *pressed):
    for key in pressed:
        QTest.keyClick(reader.canvas, key)
    reader.editor.settle()


def typed_transforms(reader):
    editor = reader.editor
    editor.session.selected.choose({0})
    reader.canvas.setFocus()
    keys(reader, Key.Key_G, Key.Key_5, Key.Key_Tab, Key.Key_3)
    reader.listen("move typed")
    keys(reader, Key.Key_Return)
    reader.listen("moved")
    for action in ("rotateSelection", "skewSelection"):
        editor.trigger(action)
        reader.canvas.setFocus()
        keys(reader, Key.Key_1, Key.Key_5)
        reader.listen(f"{action} typed")
        keys(reader, Key.Key_Return)
        reader.listen(action)
    editor.trigger("rotateLeftStep" if reader.readings.is_down else "rotateRightStep")
    reader.listen("rotated by a step")


def dragged(reader):
    editor = reader.editor
    editor.hover(reader.at((70.0, 20.0)))
    reader.listen("hover")
    editor.click(reader.at(PATH[0][0]))
    reader.listen("a click on a point")
    press_move(reader, PATH[0][0], (14.0, 25.0), name="point dragged")
    keys(reader, reader.down())
    reader.listen("nudged")
    editor.hover(reader.at((50.0, 72.0)))
    reader.listen("over a guide")
    press_move(reader, (50.0, 72.0), (50.0, 60.0), name="guide dragged")
    middle = editor.session.views[1].curve.evaluate(0.25)
    place = reader.readings.shown((float(middle[0]), float(middle[1])))
    editor.click(reader.at(place))
    reader.listen("a click on another curve")
    editor.trigger("turnGrips")
    centre = reader.canvas.tools.target.centre
    press_move(reader, reader.readings.shown(centre), (90.0, 50.0), name="pivot dragged")
    editor.trigger("rotateRight" if reader.readings.is_down else "rotateLeft")
    reader.listen("turned about the pivot")
    editor.trigger("undo")
    editor.session.selected.choose({1})
    editor.session.selected.edit_chosen()
    editor.settle()
    editor.click(reader.at(place))
    reader.listen("a click on the curve")
    editor.select([1])
    handle = reader.readings.shown(editor.handle(1, index=1).position)
    press_move(reader, handle, (handle[0] + 6.0, handle[1] + 4.0), name="handle dragged")
    press_move(reader, LEAF[2][0], (62.0, 70.0), name="point of a curve dragged")


def drawn(reader):
    editor = reader.editor
    editor.trigger("measureTool")
    press_move(reader, (20.0, 40.0), (45.0, 58.0), name="measured")
    editor.escape()
    editor.trigger("selectTool")
    editor.trigger("addTool")
    editor.click(reader.at((15.0, 40.0)))
    reader.listen("a point added")
    press_move(reader, (30.0, 50.0), (38.0, 62.0), name="a point with a handle")
    editor.escape()
    editor.trigger("selectTool")


def in_panels(reader):
    editor = reader.editor
    editor.trigger("openTransform")
    editor.session.selected.choose({1})
    reader.listen("transform panel")
    for name, text in (("X", "12"), ("Y", "33"), ("Angle", "20"), ("Turn", "15"), ("Skew", "10")):
        edit = editor.window.findChild(QLineEdit, f"transform{name}")
        edit.setFocus()
        edit.selectAll()
        editor.type_text(edit, text)
        QTest.keyClick(edit, Key.Key_Return)
        reader.listen(f"transform {name}")
    editor.session.selected.choose({0})
    editor.session.selected.edit_chosen()
    editor.show_dock("pointsDock")
    table = editor.window.point_table
    for column in ("y", "vy"):
        place = [each.name for each in table.model().columns].index(column)
        table.model().setData(table.model().index(1, place), "21.5")
        reader.listen(f"{column} typed")
    editor.session.selected.set_points([0, 1])
    editor.trigger("copyPoints")
    reader.heard[-1][1].append(f"copied {QGuiApplication.clipboard().text()}")
    editor.show_dock("hodographDock")
    editor.session.scrub.set(0.3)
    reader.listen("hodograph")
    editor.session.scrub.set(None)


def in_fields(reader):
    editor = reader.editor
    editor.session.selected.choose({1})
    editor.double_click(reader.at((50.0, 72.0)))
    editor.type_text(editor.window.focusWidget(), "22")
    QTest.keyClick(editor.window.focusWidget(), Key.Key_Return)
    reader.listen("guide typed")
    editor.paste_text("15 61\n35 69\n")
    editor.trigger("pasteAsCurve")
    reader.listen("pasted")


WALKS = (typed_transforms, dragged, drawn, in_panels, in_fields)


def heard_of(editor, document, walk):
    reader = Reader(editor, document)
    walk(reader)
    return reader.heard


def alike(told, other):
    """Whether two texts are the same but for what a pixel makes of numbers."""
    if NUMBER.sub("#", told) != NUMBER.sub("#", other):
        return False
    numbers = ([float(each.replace("−", "-")) for each in NUMBER.findall(text)] for text in (told, other))
    return all(abs(one - two) <= 1.0 for one, two in zip(*numbers, strict=True))


def compare(first, second):
    assert [step for step, _, _ in first] == [step for step, _, _ in second]
    for (step, texts, points), (_, others, other_points) in zip(first, second, strict=True):
        missing = [text for text in texts if not any(alike(text, other) for other in others)]
        more = [text for text in others if not any(alike(text, other) for other in texts)]
        assert (missing, more) == ([], []), step
        flat, other = (
            [number for point in each for pair in point if pair for number in pair]
            for each in (points, other_points)
        )
        assert flat == pytest.approx(other, abs=1.0), step


@pytest.mark.parametrize("walk", WALKS)
def test_all_that_is_told_and_typed_counts_from_the_page_wherever_that_lies(editor, point_locale, walk):
    """Whatever shows a place of the plane itself is off by the thousands that the page is away."""
    compare(heard_of(editor, told_drawing(), walk), heard_of(editor, told_drawing((1000.0, -3000.0)), walk))


@pytest.mark.parametrize("walk", WALKS)
def test_what_is_told_upwards_of_the_mirror_image_is_told_downwards(editor, point_locale, walk):
    """What forgets a sign tells another number of a drawing than of its mirror image, told upwards."""
    compare(heard_of(editor, told_drawing(), walk), heard_of(editor, told_drawing(up=True), walk))
