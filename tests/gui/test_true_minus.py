"""Numbers on the screen have a true minus sign, in widgets and where they are painted."""

from __future__ import annotations

import re
from itertools import product
from xml.etree import ElementTree

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QAbstractListModel, QBuffer, QModelIndex, Qt
from PySide6.QtGui import QAction, QPainter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QAbstractButton, QAbstractItemView, QComboBox, QLabel, QWidget

from app.document.model import Document, Parametrization, ParametrizationKind, make_curve
from app.families import HERMITE, LAGRANGE
from app.plotting.plot_widget import PaintedPlot

HYPHEN = re.compile(r"(?<![\w-])-\s?[0-9.]|[0-9]e-[0-9]")
POINTS = [(-4.0, -1.5), (-2.5, -3.0), (-1.0, -0.5), (-0.00002, -2.0)]


def painted(widget):
    """The texts that a widget paints."""
    buffer = QBuffer()
    generator = QSvgGenerator()
    generator.setOutputDevice(buffer)
    generator.setSize(widget.size())
    painter = QPainter(generator)
    widget.render(painter)
    if isinstance(widget, PaintedPlot):
        # Axes and still layers are one picture there, which holds no text to be read.
        widget.layers.paint_still(painter, widget.pixel_map, widget.camera.origin)
    painter.end()
    root = ElementTree.fromstring(bytes(buffer.data().data()))
    return ["".join(each.itertext()) for each in root.iter("{http://www.w3.org/2000/svg}text")]


def widget_texts(window):
    """The texts in all widgets that nobody types into, and their tooltips."""
    for widget in window.findChildren(QWidget):
        yield widget, widget.toolTip()
        yield widget, widget.accessibleName()
        if isinstance(widget, QLabel | QAbstractButton):
            yield widget, widget.text()
        elif isinstance(widget, QComboBox):
            yield from ((widget, widget.itemText(row)) for row in range(widget.count()))
        elif isinstance(widget, QAbstractItemView) and widget.model() is not None:
            model, root = widget.model(), QModelIndex()
            columns = 1 if isinstance(model, QAbstractListModel) else model.columnCount(root)
            for row, column in product(range(min(model.rowCount(root), 20)), range(columns)):
                for role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
                    yield widget, str(model.data(model.index(row, column), role) or "")
    for action in window.findChildren(QAction):
        yield action, f"{action.text()} {action.toolTip()}"


def hyphened(editor):
    window = editor.window
    texts = [(each.objectName() or type(each).__name__, text) for each, text in widget_texts(window)]
    texts += [("canvas", text) for text in painted(window.canvas)]
    texts += [("basisPanel", text) for text in painted(window.basis_panel)]
    return [(name, text) for name, text in texts if HYPHEN.search(text)]


@pytest.fixture(params=[LAGRANGE, HERMITE], ids=lambda family: family.name)
def negative(editor, request):
    """A curve whose points and parameters are negative."""
    rule = Parametrization(ParametrizationKind.UNIFORM, start=-2.0, end=-0.5)
    curve = replace(make_curve(POINTS, family=request.param), parametrization=rule)
    editor.session.change("Begin", lambda _document: Document((curve,)))
    editor.fit()
    return editor


def test_the_axes_paint_negative_numbers(negative):
    """That the axes paint numbers, and that these are what the test reads."""
    assert any(text.startswith("−") for text in painted(negative.window.canvas))
    assert any(text.startswith("−") for text in painted(negative.window.basis_panel))


def test_no_hyphen_stands_for_a_minus(negative):
    editor = negative
    assert hyphened(editor) == []
    for dock in editor.window.context.docks.side:
        editor.show_dock(dock.objectName())
    editor.select_point(1)
    editor.scrub(-1.2)
    for name in ("overlayBezier", "overlayCircle", "overlayVelocities", "overlayMarks", "overlayBand"):
        editor.trigger(name)
    editor.settle()
    assert hyphened(editor) == []


@pytest.mark.parametrize(("t", "words"), [("-3", "greater than −2"), ("-0.9", "less than −1")])
def test_the_reason_of_a_refused_parameter_has_a_true_minus(negative, t, words):
    negative.rail.type(1, t)
    assert words in negative.message + negative.status
    assert not HYPHEN.search(negative.message + negative.status)


def test_coordinates_and_drags_are_displayed_with_a_true_minus(negative):
    editor = negative
    editor.drag_point(1, to=(-2.0, -2.75))
    assert hyphened(editor) == []
