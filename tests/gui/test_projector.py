"""On the projector: a presentation and a larger drawing, and everything as it was before."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QTabBar, QToolButton, QWidget

from app.document.model import Document, make_curve
from app.families import HERMITE, QUINTIC_HERMITE
from app.features.lessons.commands import LessonCommands
from tests.waiting import until

POINTS = [(0, 0), (1, 1), (2, 0.2), (4, 1), (5.3, -1.2)]


@pytest.fixture
def wave(editor):
    editor.session.commit(Document((make_curve(POINTS, family=HERMITE),)), "Begin")
    editor.fit()
    return editor


def layout_of(editor):
    """Return the view, rounded below what is seen, and the sizes of all parts that are seen."""
    window = editor.window
    docks = [dock for dock in window.context.docks.all if not dock.visibleRegion().isEmpty()]
    return (
        tuple(round(edge, 9) for edge in window.canvas.pixel_map.box),
        window.canvas.size().toTuple(),
        window.size().toTuple(),
        tuple(window.splitter.sizes()),
        {dock.objectName(): dock.geometry().getRect() for dock in docks},
        window.store.state.scale,
        window.canvas.getAxis("bottom").font.pointSizeF(),
    )


def press_f11(editor):
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_F11)
    editor.settle()


def enlarge(editor, times=3):
    for _ in range(times):
        editor.trigger("enlarge")
    editor.settle()


def test_a_presentation_fits_the_drawing_anew(wave):
    """It kept the scale of the window: a curve in the corner, or half of it outside."""
    canvas = wave.window.canvas
    for zoom in ("zoomIn", "zoomOut", "zoomOut"):
        for _ in range(4):
            wave.trigger(zoom)
        press_f11(wave)
        for larger in range(3):
            pixels = canvas.pixel_map.points(wave.session.active_view.points)
            share = (pixels.max(axis=0) - pixels.min(axis=0)) / (
                canvas.pixel_map.width,
                canvas.pixel_map.height,
            )
            assert pixels.min() > 0, larger
            assert 0.6 < share.max() < 0.9, larger
            enlarge(wave, 1)
        press_f11(wave)


LEAVE = {
    "F11": press_f11,
    "Escape": lambda editor: editor.escape(),
    "after Larger Drawing": lambda editor: (enlarge(editor), press_f11(editor)),
    "after another size": lambda editor: (editor.window.resize(700, 600), editor.settle(), editor.escape()),
    "after a zoom": lambda editor: (editor.trigger("zoomIn"), editor.escape()),
    "after a panel": lambda editor: (editor.show_dock("jointsDock"), editor.escape()),
    "twice": lambda editor: (press_f11(editor), press_f11(editor), enlarge(editor), editor.escape()),
}


@pytest.mark.parametrize("leave", LEAVE.values(), ids=LEAVE)
@pytest.mark.parametrize("is_fitted", [True, False], ids=["fitted", "zoomed"])
def test_after_a_presentation_everything_is_as_it_was(wave, leave, is_fitted):
    wave.window.splitter.setSizes([500, 250, 0])
    if not is_fitted:
        wave.trigger("zoomIn")
    wave.settle()
    before, fitted = layout_of(wave), wave.window.canvas.framing.is_as_fitted
    press_f11(wave)
    assert layout_of(wave) != before
    leave(wave)
    wave.settle()
    assert layout_of(wave) == before
    assert wave.window.canvas.framing.is_as_fitted == fitted
    # Later changes of the window are no more those of the presentation.
    wave.trigger("zoomIn")
    after = layout_of(wave)
    wave.window.resize(wave.window.width() - 50, wave.window.height())
    wave.settle()
    assert layout_of(wave)[2] != after[2]


def test_all_texts_grow_with_the_drawing_and_come_back(wave):
    """Titles of panels, digits of the point table and headers of the charts stayed as small as they were."""
    wave.trigger("plotCurvature")
    wave.show_dock("jointsDock")
    wave.select([1])
    window = wave.window
    joints = window.findChild(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly)

    def sizes():
        titles = [dock.titleBarWidget().findChild(QLabel) for dock in window.context.docks.side[:1]]
        parts = {
            "table": window.point_table,
            "columns": window.point_table.horizontalHeader(),
            "title": titles[0],
            "tab": joints,
            "functions": window.findChild(QLabel, "basisTitle"),
            "formula": window.findChild(QToolButton, "positionFunctions"),
            "chart": window.findChild(QLabel, "plotValues"),
        }
        fonts = {name: part.font().pointSizeF() for name, part in parts.items()}
        for plot in window.central.plots:
            fonts[plot.objectName()] = plot.getAxis("bottom").font.pointSizeF()
        return fonts

    before, row = sizes(), window.point_table.rowHeight(0)
    enlarge(wave)
    assert sizes() == pytest.approx({name: 2 * size for name, size in before.items()})
    table = window.point_table
    assert table.rowHeight(0) >= table.fontMetrics().height() > row
    for column in range(table.model().columnCount()):
        text = table.cell_delegate.text(0, column)
        assert table.fontMetrics().horizontalAdvance(text) < table.columnWidth(column)
    wave.trigger("usualSize")
    assert sizes() == pytest.approx(before)
    assert table.rowHeight(0) == row


def test_the_basis_functions_grow_and_their_switches_stay_in_reach(wave):
    """Nothing wrote the header anew when its letters grew without a new width; the plot kept its height."""
    pane, height = wave.window.central["basisPane"], None
    wave.choose_family(QUINTIC_HERMITE)
    press_f11(wave)
    heights = wave.window.splitter.sizes()
    height = pane.height()
    for times in range(1, 5):
        wave.key(Qt.Key.Key_Equal, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier)
        wave.settle()
        for button in pane.findChildren(QToolButton):
            if button.isVisible():
                right = button.mapTo(pane, button.rect().topRight()).x()
                assert right < pane.width(), (times, button.objectName())
        scale = wave.window.store.state.scale
        assert scale > 1.0
        assert pane.height() >= min(scale * height, sum(heights) / 2) - 2
    wave.trigger("usualSize")
    wave.settle()
    assert wave.window.splitter.sizes() == heights


@pytest.mark.parametrize("size", [(1440, 900), (1024, 700)])
def test_the_canvas_keeps_half_of_the_width(wave, size):
    """At three times the size the panels took 1050 of 1440 pixels."""
    window = wave.window
    window.resize(*size)
    wave.settle()
    before = layout_of(wave)
    for _ in range(4):
        enlarge(wave, 1)
        assert window.canvas.width() >= window.width() / 2 - 6
        assert window.point_table.isVisible()
    assert window.context.docks["pointsDock"].width() > 0.45 * window.width()
    wave.trigger("usualSize")
    wave.settle()
    assert layout_of(wave) == before


def test_a_lesson_and_its_laboratory_leave_the_canvas_half_of_the_width(editor):
    window = editor.window
    window.resize(1440, 900)
    window.commands[LessonCommands].open("04_decimal_accuracy")
    editor.settle()
    before = layout_of(editor)
    table = window.findChild(QWidget, "digitsTable")

    def digits():
        return [label.font().pointSizeF() for label in table.findChildren(QLabel)]

    until(lambda: len(digits()) > 6)
    small = digits()
    press_f11(editor)
    # Wider than the screen of the tests.
    window.resize(1440, 900)
    enlarge(editor)
    assert window.context.docks["laboratoryDock"].isVisible()
    # The digits of the laboratory have a font of their own.
    assert digits() == pytest.approx([2 * size for size in small])
    assert window.canvas.width() >= window.width() / 2 - 12
    press_f11(editor)
    editor.settle()
    assert layout_of(editor) == before
    assert digits() == small
