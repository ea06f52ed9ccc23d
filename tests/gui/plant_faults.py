"""Run the editor, let overrides of Qt's methods fail one after the other, and tell what came of it.

What fails is raised by C code, for which Python 3.11 makes the exception only when somebody looks at it.
Prints a line of JSON for each place before the next one is tried: if the process dies, the last line names
the place before the one that did it.
"""

from __future__ import annotations

import functools
import json
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, QMimeData, QModelIndex, QPoint, QSize, Qt, QTimer
from PySide6.QtGui import QDragEnterEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QPushButton, QVBoxLayout, QWidget

from app.appearance.icons import _IconEngine, icon
from app.cli.windows import Lifecycle, open_windows
from app.features.curve_list.commands import CurveListCommands
from app.features.curve_list.model import CurveListModel
from app.features.curve_list.rows import RowDelegate
from app.features.point_table.model import PointTableModel
from app.features.point_table.view import PointTableDelegate, PointTableView
from app.features.recovery.autosave import snapshot_folder
from app.features.wiggle.panel import WeightBars
from app.plotting.layers import Layer
from app.plotting.plot_widget import PaintedPlot, PlotWidget
from app.plotting.tool_plot import ToolPlot
from app.session.history import UndoStep
from app.tasks.task import DebouncedTask, Task
from app.testing import Editor
from app.widgets.elided_label import ElidedLabel, SteadyLabel
from app.window import MainWindow
from app.window.command_palette import CommandPalette, _CommandDelegate
from app.window.preferences_dialog import PreferencesDialog
from app.window.toolbar import Toolbar
from tests.waiting import until

FAULTS: tuple[Callable[[], object], ...] = (
    lambda: 1 / 0,
    lambda: int("x"),
    lambda: np.zeros(2)[5],
)


class Place:
    """An override, and what makes Qt call it.

    It is taken over before any window is there, for Qt's bindings look an override up once.
    """

    def __init__(self, owner: type, name: str, provoke: Callable[[Editor], object]) -> None:
        self.name = f"{owner.__name__}.{name}"
        self.provoke = provoke
        self.was_called = False
        self._fault: Callable[[], object] | None = None
        there = vars(owner)[name]
        places = there.__code__.co_freevars
        guarded = there.__closure__[places.index("method")] if "method" in places else None
        bare = guarded.cell_contents if guarded is not None else there

        @functools.wraps(bare)
        def failing(*arguments: Any) -> Any:
            fault, self._fault = self._fault, None
            if fault is not None:
                self.was_called = True
                fault()
            return bare(*arguments)

        if guarded is not None:
            guarded.cell_contents = failing  # behind the guard, which stays as it is
        else:
            setattr(owner, name, failing)

    def fail_next(self, fault: Callable[[], object]) -> None:
        """Let the next call fail."""
        self._fault = fault


# What provokes some of them


def press_arrow(editor: Editor) -> None:
    QTest.keyClick(editor.window.canvas, Qt.Key.Key_Right)


def paint_behind_a_dialog(editor: Editor) -> None:
    box = QMessageBox(editor.window)

    def paint() -> None:
        editor.window.canvas.viewport().repaint()
        box.accept()

    QTimer.singleShot(0, paint)
    box.exec()


def drag_a_file_in(editor: Editor) -> None:
    data, actions = QMimeData(), Qt.DropAction.CopyAction
    buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(editor.window, QDragEnterEvent(QPoint(10, 10), actions, data, buttons, keys))


def type_into_preferences(editor: Editor) -> None:
    editor.trigger("preferences")
    dialog = editor.window.findChild(PreferencesDialog)
    assert dialog is not None
    QTest.keyClick(dialog, Qt.Key.Key_F8)
    dialog.close()


def lay_a_label_out(_editor: Editor) -> None:
    holder = QWidget()
    QVBoxLayout(holder).addWidget(ElidedLabel())
    holder.grab()


def cell(editor: Editor) -> QModelIndex:
    return editor.window.point_table.model().index(0, 1)


def repaint_table(editor: Editor) -> None:
    editor.window.point_table.viewport().repaint()


def repaint_header(editor: Editor) -> None:
    editor.window.point_table.horizontalHeader().viewport().repaint()


def curve_list(editor):
    return editor.window.commands[CurveListCommands].panel


def resize_table(editor: Editor) -> None:
    table = editor.window.point_table
    table.resize(table.width() + 1, table.height())


def compute_beside_the_window(editor: Editor) -> None:
    DebouncedTask(editor.window, settle_ms=0).ask(lambda _report: None)


PLACES = (
    Place(Layer, "draw", lambda editor: editor.window.canvas.grab()),
    Place(Layer, "draw", paint_behind_a_dialog),
    Place(PaintedPlot, "paintEvent", lambda editor: editor.window.canvas.viewport().repaint()),
    Place(
        pg.ViewBox, "resizeEvent", lambda editor: editor.window.resize(editor.window.size() + QSize(40, 40))
    ),
    Place(ToolPlot, "event", press_arrow),
    Place(ToolPlot, "keyPressEvent", press_arrow),
    Place(PlotWidget, "mouseMoveEvent", lambda editor: editor.hover((0.5, 0.5))),
    Place(PlotWidget, "mousePressEvent", lambda editor: editor.press((0.5, 0.5))),
    Place(PlotWidget, "wheelEvent", lambda editor: editor.wheel((0.5, 0.5), 1)),
    Place(MainWindow, "closeEvent", lambda editor: editor.window.close()),
    Place(MainWindow, "closeEvent", lambda _editor: QApplication.closeAllWindows()),
    Place(MainWindow, "changeEvent", lambda editor: QApplication.sendEvent(editor.window, palette_change())),
    Place(MainWindow, "dragEnterEvent", drag_a_file_in),
    Place(Toolbar, "resizeEvent", lambda editor: editor.window.resize(editor.window.size() + QSize(40, 40))),
    Place(PointTableModel, "data", lambda editor: cell(editor).data()),
    Place(PointTableModel, "headerData", repaint_header),
    Place(PointTableModel, "rowCount", lambda editor: editor.window.point_table.model().layoutChanged.emit()),
    Place(PointTableModel, "flags", lambda editor: editor.window.point_table.edit(cell(editor))),
    Place(PointTableDelegate, "paint", repaint_table),
    Place(PointTableDelegate, "createEditor", lambda editor: editor.window.point_table.edit(cell(editor))),
    Place(PointTableView, "resizeEvent", resize_table),
    Place(
        CurveListModel,
        "data",
        lambda editor: curve_list(editor).view.model().index(0, 0).data(),
    ),
    Place(RowDelegate, "paint", lambda editor: editor.show_dock("curvesDock")),
    Place(
        RowDelegate,
        "sizeHint",
        lambda editor: curve_list(editor).view.doItemsLayout(),
    ),
    Place(_CommandDelegate, "paint", lambda editor: editor.window.findChild(CommandPalette).grab()),
    Place(WeightBars, "paintEvent", lambda _editor: WeightBars().grab()),
    Place(ElidedLabel, "minimumSizeHint", lay_a_label_out),
    Place(SteadyLabel, "sizeHint", lambda _editor: ElidedLabel().adjustSize()),
    Place(_IconEngine, "pixmap", lambda editor: icon("undo", editor.window._theme).pixmap(31, 31)),
    Place(UndoStep, "undo", lambda editor: editor.session.undo_stack.undo()),
    Place(UndoStep, "redo", lambda editor: editor.session.undo_stack.redo()),
    Place(PreferencesDialog, "keyPressEvent", type_into_preferences),
    Place(Task, "_run", compute_beside_the_window),
)


def outcome(
    lifecycle: Lifecycle, editor: Editor, place: Place, fault: Callable[[], object]
) -> dict[str, object]:
    """Plant a fault, provoke it, and tell what came of it."""
    for path in snapshot_folder().glob("*"):
        path.unlink()
    lifecycle.crashes._signatures.clear()
    place.fail_next(fault)
    raised = ""
    try:
        place.provoke(editor)
    except Exception as problem:
        raised = repr(problem)
    told = dialogs_put_away()
    return {
        "place": place.name,
        "called": place.was_called,
        "raised elsewhere": raised,
        "told": told,
        "kept": any(snapshot_folder().glob("*.snapshot.json")),
        "open": editor.window.isVisible(),
    }


def dialogs_put_away() -> int:
    """Put the crash dialogs away as they come, and return how many did."""
    shown = 0

    def is_over() -> bool:
        nonlocal shown
        dialogs = [
            each
            for each in QApplication.topLevelWidgets()
            if each.objectName() == "crashDialog" and each.isVisible()
        ]
        for dialog in dialogs:
            shown += 1
            QTest.mouseClick(dialog.findChild(QPushButton, "goOn"), Qt.MouseButton.LeftButton)
        return shown > 0 and not dialogs

    with suppress(TimeoutError):
        until(is_over)
    return shown


def palette_change() -> QEvent:
    return QEvent(QEvent.Type.PaletteChange)


def main() -> int:
    application = QApplication(sys.argv[:1])
    (window,) = open_windows(())
    lifecycle = Lifecycle(application, [window])
    lifecycle.start()
    editor = Editor.on(window)

    def drive() -> None:
        editor.show_dock("pointsDock")
        editor.drag_point(1, to=(1, 3))
        editor.drag_point(1, to=(1, 2))
        editor.find_command("fit")
        editor.escape()
        try:
            for number, place in enumerate(PLACES):
                fault = FAULTS[number % len(FAULTS)]
                print(json.dumps(outcome(lifecycle, editor, place, fault)), flush=True)
        finally:
            editor.session.files.give_up_changes()
            application.exit()

    QTimer.singleShot(0, drive)
    application.exec()
    lifecycle.stop()
    window.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
