"""Fields of a panel stay in place when the selection changes their content."""

from __future__ import annotations

import pytest
from event_count import layouts_of
from msgspec.structs import replace
from PySide6.QtCore import QPoint, QSize
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QLabel,
    QLineEdit,
    QScrollArea,
    QSlider,
    QWidget,
)

from app.document.model import Document, make_curve
from app.document.style import Style
from app.testing.waiting import deliver_events
from app.widgets.boxes import column_of
from app.widgets.frames import Scrolled

SHOWN = (QAbstractButton, QComboBox, QLineEdit, QSlider)


def widget_positions(editor, panel):
    """Where every field and button of a panel stands that is shown, in its content."""
    editor.settle()
    dock = editor.window.findChild(QWidget, panel)
    content = dock.findChild(QScrollArea).widget()
    return {
        each.objectName(): (each.mapTo(content, QPoint(0, 0)).toTuple(), each.size().toTuple())
        for kind in SHOWN
        for each in content.findChildren(kind)
        if each.objectName() and not each.objectName().startswith("qt_") and each.isVisibleTo(content)
    }


def moved(before, after):
    return {name for name in before.keys() & after.keys() if before[name] != after[name]}


@pytest.fixture
def panels(editor):
    """Two filled curves and an open one, with both panels open and nothing chosen."""
    editor.show_dock("styleDock")
    editor.show_dock("transformDock")
    filled = Style(fill="#0072b2")
    curves = (
        replace(make_curve([(0, 0), (2, 0), (2, 2), (0, 2)], name="Leaf"), closed=True),
        replace(make_curve([(3, 0), (5, 0), (5, 2), (3, 2)], name="Stem"), closed=True, style=filled),
        make_curve([(0, 4), (3, 5)], name="Root"),
    )
    editor.session.commit(Document(curves), "Begin")
    editor.fit()
    editor.session.selected.select_whole([])
    editor.show_dock("styleDock")
    return editor


@pytest.mark.parametrize("panel", ["styleDock", "transformDock"])
def test_another_selection_moves_no_field_of_a_panel(panels, panel):
    """A rectangle once brought a scroll bar, and all fields of Transform went 14 pixels to the left."""
    panels.window.resize(1200, 700)
    before = widget_positions(panels, panel)
    assert len(before) > 12
    for chosen in ([0], [1], [0, 1], [2], [0, 1, 2], []):
        panels.session.selected.select_whole(chosen)
        assert moved(before, widget_positions(panels, panel)) == set(), chosen
    panels.session.selected.select_whole([0])
    panels.session.selected.edit_selected()
    panels.session.selected.set_points([0])
    assert moved(before, widget_positions(panels, panel)) == set()


def test_neither_panel_scrolls_sideways(panels):
    """With a fifth word for kinds of paint the Style panel was 390 pixels wide, and it has 336."""
    for panel in ("styleDock", "transformDock"):
        area = panels.window.findChild(QWidget, panel).findChild(QScrollArea)
        assert area.horizontalScrollBar().maximum() == 0, panel


@pytest.mark.parametrize("width", [1440, 1280])
def test_an_opened_panel_does_not_widen_the_side(arch, width):
    """The laboratory took 30 pixels from the drawing, and gave them back to nobody."""
    window = arch.window
    window.resize(width, 900)
    arch.settle()
    before, canvas = window.context.docks["pointsDock"].width(), window.canvas.width()
    for name in ("toggleLaboratory", "explainWiggle", "openTransform", "fitFewerPoints", "showJoints"):
        arch.trigger(name)
        deliver_events()
        arch.settle()
        sides = {dock.width() for dock in window.context.docks.side if not dock.visibleRegion().isEmpty()}
        assert (sides, window.canvas.width()) == ({before}, canvas), name


def test_neither_a_step_nor_a_tool_lays_the_window_out_anew(arch):
    """It took as long as to paint the drawing, once or twice at each step, for names of buttons."""
    arch.drag((1, 2), (1, 9))
    for name in ("undo", "redo"):
        arch.trigger(name)
    arch.settle()
    window, toolbar = layouts_of(arch.window), layouts_of(arch.window.toolbar)
    for name in ("undo", "redo", "addTool", "selectTool", "selectAll"):
        arch.trigger(name)
        arch.settle()
    assert (window.count, toolbar.count) == (0, 0)


def test_scrolled_content_requests_a_new_layout_only_for_another_size(qtbot):
    """Each change in a panel had the whole window laid out anew."""
    holder = QWidget()
    qtbot.addWidget(holder)
    area = Scrolled(QWidget, QSize(300, 300), holder)
    column_of(area, margins=0, parent=holder)
    label = QLabel("one")
    label.setMinimumWidth(100)
    column_of(label, parent=area.content)
    with qtbot.waitExposed(holder):
        holder.show()
    layouts, least = layouts_of(holder), holder.minimumSizeHint().width()
    label.setText("two")
    deliver_events()
    deliver_events()
    assert layouts.count == 0
    label.setMinimumWidth(200)
    deliver_events()
    deliver_events()
    assert holder.minimumSizeHint().width() == least + 100
