"""Run the editor, let overrides of Qt's methods fail one after the other, and tell what came of it.

What fails is raised by C code, for which Python 3.11 makes the exception only when somebody looks at it.
Prints a line of JSON for each place before the next one is tried: if the process dies, the last line names
the place before the one that did it.
"""

from __future__ import annotations

import functools
import json
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from PySide6.QtCore import QEvent, QMimeData, QPoint, QSize, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QStatusTipEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMessageBox, QPushButton, QVBoxLayout, QWidget

from app.autosave import snapshot_folder
from app.canvas.canvas import Canvas
from app.icons import _IconEngine, icon
from app.lifecycle import Lifecycle
from app.main_window import MainWindow
from app.panels.command_palette import CommandPalette, _CommandDelegate
from app.panels.curve_list_model import CurveListModel
from app.panels.curve_list_view import _RowDelegate
from app.panels.elided_label import ElidedLabel, SteadyLabel
from app.panels.point_table_delegate import PointTableDelegate
from app.panels.point_table_model import PointTableModel
from app.panels.point_table_view import PointTableView
from app.panels.preferences_dialog import PreferencesDialog
from app.panels.weight_bars import WeightBars
from app.plot.layered_plot import Layer, LayeredPlot
from app.plot.plot_widget import PlotWidget
from app.settle import Settler, _Work
from app.start import open_windows
from app.testing import Editor
from app.toolbar import Toolbar
from app.undo_step import UndoStep

FAULTS: tuple[Callable[[], object], ...] = (
    lambda: 1 / 0,
    lambda: int("x"),
    lambda: np.zeros(2)[5],
)


class Place(NamedTuple):
    """An override, and what makes Qt call it."""

    owner: type
    name: str
    provoke: Callable[[], object]


def plant(owner: type, name: str, fault: Callable[[], object]) -> Callable[[], bool]:
    """Let a method fail once, behind the guard that it has or has not; return whether it was called."""
    there = vars(owner)[name]
    bare = getattr(there, "__wrapped__", there)
    calls: list[str] = []

    @functools.wraps(bare)
    def failing(*arguments: Any) -> Any:
        calls.append(name)
        if len(calls) == 1:
            fault()
        return bare(*arguments)

    if bare is there:
        setattr(owner, name, failing)
    else:
        there.__closure__[there.__code__.co_freevars.index("method")].cell_contents = failing
    return lambda: bool(calls)


class Trial:
    """Tries places in a window that is open."""

    def __init__(self, lifecycle: Lifecycle, editor: Editor) -> None:
        self.lifecycle, self.editor = lifecycle, editor
        self.window = editor.window

    def places(self) -> list[Place]:
        """Every place, with another Python-to-Qt call on the stack each time."""
        window, editor = self.window, self.editor
        canvas, table, curves = window.canvas, window.point_table, window.curve_list.view
        palette = window.findChild(CommandPalette)
        assert palette is not None
        bars, label, holder = WeightBars(), ElidedLabel(), QWidget()
        QVBoxLayout(holder).addWidget(label)
        settler = Settler(window, settle_ms=0)
        cell = table.model().index(0, 1)
        return [
            Place(Layer, "paint", canvas.grab),
            Place(Layer, "paint", self.paint_behind_a_dialog),
            Place(LayeredPlot, "paintEvent", canvas.viewport().repaint),
            Place(Canvas, "event", lambda: QTest.keyClick(canvas, Qt.Key.Key_Right)),
            Place(Canvas, "keyPressEvent", lambda: QTest.keyClick(canvas, Qt.Key.Key_Right)),
            Place(PlotWidget, "mouseMoveEvent", lambda: editor.hover((0.5, 0.5))),
            Place(PlotWidget, "mousePressEvent", lambda: editor.click((0.5, 0.5))),
            Place(PlotWidget, "wheelEvent", lambda: editor.wheel((0.5, 0.5), 1)),
            Place(MainWindow, "event", lambda: QApplication.sendEvent(window, QStatusTipEvent("tip"))),
            Place(MainWindow, "event", lambda: QApplication.sendEvent(window, QCloseEvent())),
            Place(MainWindow, "closeEvent", window.close),
            Place(MainWindow, "closeEvent", QApplication.closeAllWindows),
            Place(MainWindow, "changeEvent", lambda: QApplication.sendEvent(window, palette_change())),
            Place(MainWindow, "dragEnterEvent", self.drag_a_file_in),
            Place(Toolbar, "resizeEvent", lambda: window.resize(window.size() + QSize(40, 40))),
            Place(PointTableModel, "data", cell.data),
            Place(PointTableModel, "headerData", table.horizontalHeader().viewport().repaint),
            Place(PointTableModel, "rowCount", table.model().layoutChanged.emit),
            Place(PointTableModel, "flags", lambda: table.edit(cell)),
            Place(PointTableDelegate, "paint", table.viewport().repaint),
            Place(PointTableDelegate, "createEditor", lambda: table.edit(cell)),
            Place(PointTableView, "resizeEvent", lambda: table.resize(table.width() + 1, table.height())),
            Place(CurveListModel, "data", curves.model().index(0, 0).data),
            Place(_RowDelegate, "paint", lambda: editor.show_dock("curvesDock")),
            Place(_RowDelegate, "sizeHint", curves.doItemsLayout),
            Place(_CommandDelegate, "paint", palette.grab),
            Place(WeightBars, "paintEvent", bars.grab),
            Place(ElidedLabel, "minimumSizeHint", holder.grab),
            Place(SteadyLabel, "sizeHint", label.adjustSize),
            Place(_IconEngine, "pixmap", lambda: icon("undo", editor.window._theme).pixmap(31, 31)),
            Place(UndoStep, "undo", editor.session.undo_stack.undo),
            Place(UndoStep, "redo", editor.session.undo_stack.redo),
            Place(PreferencesDialog, "keyPressEvent", self.type_into_preferences),
            Place(_Work, "run", lambda: settler.ask(lambda _is_stale: None)),
        ]

    def try_all(self) -> None:
        for number, place in enumerate(self.places()):
            print(json.dumps(self.try_one(place, FAULTS[number % len(FAULTS)])), flush=True)

    def try_one(self, place: Place, fault: Callable[[], object]) -> dict[str, object]:
        """Plant a fault, provoke it, and tell what came of it."""
        for path in snapshot_folder().glob("*"):
            path.unlink()
        self.lifecycle.crashes._seen.clear()
        was_called = plant(place.owner, place.name, fault)
        raised = ""
        try:
            place.provoke()
        except Exception as problem:
            raised = repr(problem)
        told = self.told()
        return {
            "place": f"{place.owner.__name__}.{place.name}",
            "called": was_called(),
            "raised elsewhere": raised,
            "told": told,
            "kept": any(snapshot_folder().glob("*.snapshot.json")),
            "open": self.window.isVisible(),
        }

    def told(self) -> int:
        """Put the crash dialogs away as they come, and return how many did."""
        shown = 0
        deadline = time.monotonic() + 5
        while time.monotonic() < deadline:
            QApplication.processEvents()
            dialogs = [
                each
                for each in QApplication.topLevelWidgets()
                if each.objectName() == "crashDialog" and each.isVisible()
            ]
            for dialog in dialogs:
                shown += 1
                QTest.mouseClick(dialog.findChild(QPushButton, "goOn"), Qt.MouseButton.LeftButton)
            if shown and not dialogs:
                break
        return shown

    # What provokes some of them

    def paint_behind_a_dialog(self) -> None:
        box = QMessageBox(self.window)

        def paint() -> None:
            self.window.canvas.viewport().repaint()
            box.accept()

        QTimer.singleShot(0, paint)
        box.exec()

    def drag_a_file_in(self) -> None:
        data, actions = QMimeData(), Qt.DropAction.CopyAction
        buttons, keys = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
        event = QDragEnterEvent(QPoint(10, 10), actions, data, buttons, keys)
        QApplication.sendEvent(self.window, event)

    def type_into_preferences(self) -> None:
        self.editor.trigger("preferences")
        dialog = self.window.findChild(PreferencesDialog)
        assert dialog is not None
        QTest.keyClick(dialog, Qt.Key.Key_F8)
        dialog.close()


def palette_change() -> QEvent:
    return QEvent(QEvent.Type.PaletteChange)


def main() -> int:
    application = QApplication(sys.argv[:1])
    (window,) = open_windows(())
    lifecycle = Lifecycle(application, [window])
    lifecycle.start()
    editor = Editor.on(window)

    def drive() -> None:
        editor.drag_point(1, to=(1, 3))
        editor.drag_point(1, to=(1, 2))
        editor.find_command("fit")
        editor.escape()
        try:
            Trial(lifecycle, editor).try_all()
        finally:
            editor.session.undo_stack.setClean()
            application.exit()

    QTimer.singleShot(0, drive)
    application.exec()
    lifecycle.stop()
    window.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
