"""A person who does anything at all: every action, field, list, key and drag of one window, by real events.

All chance comes from one seed. What is done is noted before it is done, in a file, too, so that it is known
where the process dies.
"""

from __future__ import annotations

import random
from collections import deque
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt, QTimer, QUrl
from PySide6.QtGui import (
    QAction,
    QContextMenuEvent,
    QDragEnterEvent,
    QDropEvent,
    QGuiApplication,
    QKeyEvent,
    QMouseEvent,
    QWheelEvent,
)
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDialog,
    QFileDialog,
    QHeaderView,
    QLineEdit,
    QMenu,
    QMessageBox,
    QTableView,
    QWidget,
)
from shiboken6 import isValid

from app.plotting.plot_widget import PlotWidget

_PAUSE_MS = 5
NOT_DONE = {"quit", "closeWindow"}
"""What ends the program."""

KEYS = (
    [Qt.Key(code) for code in range(Qt.Key.Key_A.value, Qt.Key.Key_Z.value + 1)]
    + [Qt.Key(code) for code in range(Qt.Key.Key_0.value, Qt.Key.Key_9.value + 1)]
    + [Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down] * 3
    + [Qt.Key.Key_Tab, Qt.Key.Key_Backtab, Qt.Key.Key_Home, Qt.Key.Key_End, Qt.Key.Key_F2, Qt.Key.Key_Menu]
    + [Qt.Key.Key_Escape, Qt.Key.Key_Return, Qt.Key.Key_Space, Qt.Key.Key_Delete, Qt.Key.Key_Backspace] * 2
    + [Qt.Key.Key_PageUp, Qt.Key.Key_PageDown, Qt.Key.Key_Plus, Qt.Key.Key_Minus, Qt.Key.Key_Period]
)
NO_KEYS = Qt.KeyboardModifier.NoModifier
HELD = [NO_KEYS] * 4 + [
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.ControlModifier,
    Qt.KeyboardModifier.AltModifier,
    Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier,
]
TYPED = (
    *(
        "0",
        "1",
        "-2.5",
        "0,5",
        "1/3",
        "2 + 3*4",
        "1e12",
        "-1e13",
        "1e-300",
        "nan",
        "inf",
        "",
        " ",
        "x",
        "1 2",
    ),
    *("0.5", "0.25", "3", "7", "12", "100", "Curve", "<b>ß→∞</b>", "sqrt(2)", "9**9**9", "1/0", "#00ff00"),
)
CLIPBOARD = (
    *("1\t2\n3\t4\n", "t\tx\ty\n0\t1\t2\n1\t3\t1\n", "1;2\n3;4", "nan\t1\n", "words", "", "5", "1e13\t0\n"),
    *("1,5\t2,5\n", "0\t0\n0\t0\n", "x\n" * 50),
)
BUTTONS = [Qt.MouseButton.LeftButton] * 8 + [Qt.MouseButton.RightButton] * 2 + [Qt.MouseButton.MiddleButton]


class RandomPerson:
    """Does one thing after the other, each drawn at random.

    Parameters
    ----------
    editor
        The driver of the window.
    seed
        Where all chance comes from.
    files
        Files to open, import and drop; new ones are written beside the first.
    log
        Where every step is noted before it is done.
    """

    def __init__(self, editor, seed: int, files: list[Path], log: Path) -> None:
        self.editor, self.window, self.session = editor, editor.window, editor.session
        self.choose = random.Random(seed)
        self.files, self.log = files, log
        self.steps: deque[str] = deque(maxlen=40)
        self._deeds = [
            (30, self.trigger_something),
            (25, self.drag_on_a_plot),
            (14, self.press_a_key),
            (12, self.click_somewhere),
            (9, self.type_into_a_field),
            (6, self.turn_the_wheel),
            (6, self.use_a_list),
            (5, self.select_points),
            (5, self.walk_the_history),
            (3, self.open_a_menu),
            (2, self.drag_somewhere),
            (2, self.copy_something),
            (1, self.drop_a_file),
            (1, self.resize),
        ]
        self._is_at_work, self._step = False, 0

    def note(self, what: str) -> None:
        """Take down what is about to be done."""
        self.steps.append(what)
        with self.log.open("a", encoding="utf-8") as file:
            file.write(what + "\n")

    def step(self) -> None:
        """Do one thing, and answer what asks back."""
        weights, deeds = zip(*self._deeds, strict=True)
        deed = self.choose.choices(deeds, weights)[0]
        if QApplication.activeWindow() is None:
            self.window.activateWindow()  # no window manager does it where there is no screen
        self._is_at_work, self._step = True, self._step + 1
        QTimer.singleShot(_PAUSE_MS, partial(self._answer_from_within, self._step))
        try:
            deed()
            self.editor.settle()
            self.answer_all()
        finally:
            self._is_at_work = False

    def _answer_from_within(self, step: int) -> None:
        """Answer what waits in an event loop of its own, for as long as the step takes."""
        # A new timer each time: one does not fire again while what it has called goes on.
        if self._is_at_work and step == self._step:
            QTimer.singleShot(_PAUSE_MS, partial(self._answer_from_within, step))
            self._answer_what_waits()

    # What asks back

    def answer_all(self) -> None:
        """Answer dialogs and menus until there is none."""
        for attempt in range(40):
            if not self._answer_what_waits(hard=attempt > 12):
                return
            self.editor.settle()
        left = QApplication.activePopupWidget() or QApplication.activeModalWidget()
        raise AssertionError(f"a {type(left).__name__} is left ({left.objectName()})")

    def _answer_what_waits(self, *, hard: bool = False) -> bool:
        popup, dialog = QApplication.activePopupWidget(), QApplication.activeModalWidget()
        if popup is not None:
            self._answer_popup(popup, hard)
        elif dialog is not None:
            self._answer_dialog(dialog, hard)
        return popup is not None or dialog is not None

    def _answer_popup(self, popup: QWidget, hard: bool) -> None:
        entries = []
        if isinstance(popup, QMenu):
            entries = [
                each
                for each in popup.actions()
                if each.isEnabled() and not each.isSeparator() and each.objectName() not in NOT_DONE
            ]
        if entries and not hard and self.choose.random() < 0.7:
            entry = self.choose.choice(entries)
            self.note(f"  choose {entry.objectName() or entry.text()!r}")
            self._click(popup, popup.actionGeometry(entry).center())
            return
        self.note(f"  Escape in {type(popup).__name__}")
        QTest.keyClick(popup, Qt.Key.Key_Escape)
        if hard and popup.isVisible():
            popup.close()

    def _answer_dialog(self, dialog: QWidget, hard: bool) -> None:
        if isinstance(dialog, QFileDialog):
            self._answer_file_dialog(dialog)
        elif isinstance(dialog, QMessageBox) and dialog.buttons():
            button = self.choose.choice(dialog.buttons())
            self.note(f"  answer {button.text()!r}")
            QTest.mouseClick(button, Qt.MouseButton.LeftButton)
        elif hard or self.choose.random() < 0.3:
            self.note(f"  close {type(dialog).__name__}")
            dialog.close() if hard else QTest.keyClick(dialog, Qt.Key.Key_Escape)
        elif self.choose.random() < 0.5:
            self.type_into_a_field(dialog)
        else:
            self.click_somewhere(dialog)

    def _answer_file_dialog(self, dialog: QFileDialog) -> None:
        if self.choose.random() < 0.3:
            self.note("  no file")
            dialog.reject()
            return
        folder = self.files[0].parent
        if dialog.acceptMode() == QFileDialog.AcceptMode.AcceptSave:
            endings = (".curve.json", ".svg", ".csv", ".dxf", ".py", ".tex", ".png", ".pdf", ".tsv", "", ".x")
            path = folder / f"written {self.choose.randrange(4)}{self.choose.choice(endings)}"
        else:
            path = self.choose.choice(self.files)
        self.note(f"  file {path.name}")
        line = dialog.findChild(QLineEdit)
        line.setText(str(path))
        dialog.accept()
        if dialog.isVisible():
            dialog.reject()

    # Things to do

    def trigger_something(self) -> None:
        """Trigger an action that can be triggered."""
        actions = [
            each
            for each in self.window.findChildren(QAction)
            if each.objectName() and each.isEnabled() and each.objectName() not in NOT_DONE
        ]
        action = self.choose.choice(actions)
        self.note(f"trigger {action.objectName()}")
        action.trigger()

    def drag_on_a_plot(self) -> None:
        """Press, move and let go on one of the plots, or give up half way."""
        plots = [each for each in self.window.findChildren(PlotWidget) if self._is_in_sight(each.viewport())]
        plot = self.window.canvas if self.choose.random() < 0.6 else self.choose.choice(plots)
        if not self._is_in_sight(plot.viewport()):
            return
        at, held, button = self._aim(plot), self.choose.choice(HELD), self.choose.choice(BUTTONS)
        keys = self._name_of(held)
        self.note(f"press {button.name} on {plot.objectName()} at {at.toTuple()} {keys}")
        target = plot.viewport()
        self._mouse(target, QEvent.Type.MouseMove, at, held=held)
        self._mouse(target, QEvent.Type.MouseButtonPress, at, button, held)
        for _ in range(self.choose.choice((0, 0, 1, 2, 4))):
            at = self._aim(plot) if self.choose.random() < 0.5 else at + self._little()
            self.note(f"  move to {at.toTuple()}")
            self._mouse(target, QEvent.Type.MouseMove, at, button, held)
            if self.choose.random() < 0.25:
                self.editor.settle()
            if self.choose.random() < 0.15:
                self.press_a_key()
            if self.choose.random() < 0.04:
                self.trigger_something()
        self.note("  release")
        self._mouse(target, QEvent.Type.MouseButtonRelease, at, button, held)
        if button == Qt.MouseButton.RightButton:
            self._ask_for_menu(target, at)
        elif self.choose.random() < 0.1:
            self.note("  double-click")
            self._mouse(target, QEvent.Type.MouseButtonDblClick, at, button, held)
            self._mouse(target, QEvent.Type.MouseButtonRelease, at, button, held)
        self._mouse(target, QEvent.Type.MouseMove, at + self._little())
        self.editor.settle()

    def press_a_key(self) -> None:
        """Press a key where the keyboard is."""
        if self.choose.random() < 0.5:
            self.window.canvas.setFocus()
        key, held = self.choose.choice(KEYS), self.choose.choice(HELD)
        if held & Qt.KeyboardModifier.ControlModifier and key in (Qt.Key.Key_Q, Qt.Key.Key_W):
            return
        self.note(f"key {key.name} {self._name_of(held)} in {self._called(self._keyboard)}")
        self._key(key, held)

    def click_somewhere(self, within: QWidget | None = None) -> None:
        """Click, or double-click, anywhere in a window."""
        target = self._widget_in(within, QWidget)
        if target is None:
            return
        at = self._place_in(target)
        button, held = self.choose.choice(BUTTONS), self.choose.choice(HELD)
        self.note(f"click {button.name} {self._called(target)} at {at.toTuple()} {self._name_of(held)}")
        self._click(target, at, button, held)
        if button == Qt.MouseButton.RightButton:
            self._ask_for_menu(target, at)
        elif self.choose.random() < 0.2:
            self.note("  double-click")
            self._mouse(target, QEvent.Type.MouseButtonDblClick, at, button, held)
            self._mouse(target, QEvent.Type.MouseButtonRelease, at, button, held)

    def type_into_a_field(self, within: QWidget | None = None) -> None:
        """Type something into a field, a box or a slider, and leave it in one way or another."""
        fields = (QLineEdit, QAbstractSpinBox, QComboBox, QAbstractSlider)
        field = self._widget_in(within, fields)
        if field is None:
            return
        text = self.choose.choice(TYPED)
        end = self.choose.choice((Qt.Key.Key_Return, Qt.Key.Key_Return, Qt.Key.Key_Tab, Qt.Key.Key_Escape))
        self.note(f"type {text!r} {end.name} into {self._called(field)}")
        field.setFocus()
        if isinstance(field, QComboBox | QAbstractSlider):
            for _ in range(self.choose.randrange(1, 5)):
                self._key(self.choose.choice((Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home)))
            return
        if self.choose.random() < 0.8:
            self._key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        self._type(text)
        if self.choose.random() < 0.9:
            self._key(end)

    def turn_the_wheel(self) -> None:
        """Turn the wheel over anything."""
        plots = [each.viewport() for each in self.window.findChildren(PlotWidget) if each.isVisible()]
        target = self.choose.choice(plots) if self.choose.random() < 0.7 else self._widget_in(None, QWidget)
        if target is None:
            return
        at, notches = self._place_in(target), self.choose.choice((1, -1, 2, -2, 5, -5, 30, -30))
        held = self.choose.choice(HELD)
        self.note(f"wheel {notches} {self._called(target)} at {at.toTuple()} {self._name_of(held)}")
        place, turn = QPointF(at), QPoint(0, 120 * notches)
        event = QWheelEvent(
            place, target.mapToGlobal(place), QPoint(), turn, Qt.MouseButton.NoButton, held,
            Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QApplication.sendEvent(target, event)

    def use_a_list(self) -> None:
        """Choose cells or rows of a list or table, and type, delete or paste there."""
        view = self._widget_in(None, QAbstractItemView)
        if view is None or isinstance(view, QHeaderView) or not view.model() or not view.model().rowCount():
            return
        model = view.model()
        columns = model.columnCount() if isinstance(view, QTableView) else 1
        index = model.index(self.choose.randrange(model.rowCount()), self.choose.randrange(max(columns, 1)))
        self.note(f"cell ({index.row()}, {index.column()}) of {self._called(view)}")
        view.scrollTo(index)
        at, held = view.visualRect(index).center(), self.choose.choice(HELD)
        if not view.viewport().rect().contains(at):
            return
        self._click(view.viewport(), at, held=held)
        match self.choose.randrange(5):
            case 0:
                text = self.choose.choice(TYPED)
                self.note(f"  type {text!r}")
                self._type(text)
                self._key(Qt.Key.Key_Return)
            case 1:
                self._click(view.viewport(), at)
                self.note("  double-click")
                self._mouse(view.viewport(), QEvent.Type.MouseButtonDblClick, at)
                self._mouse(view.viewport(), QEvent.Type.MouseButtonRelease, at)
            case 2:
                self.press_a_key()
            case 3:
                self._ask_for_menu(view.viewport(), at)

    def select_points(self) -> None:
        """Select some points, as many gestures in a row would."""
        count = len(self.session.active_curve.points)
        chosen = self.choose.sample(range(count), self.choose.randint(0, min(3, count)))
        self.note(f"select {chosen} of {count}")
        self.session.selected.set_points(chosen)

    def walk_the_history(self) -> None:
        """Undo and redo a few times."""
        names = [self.choose.choice(("undo", "undo", "redo")) for _ in range(self.choose.randint(1, 5))]
        self.note(f"{', '.join(names)}")
        for name in names:
            action = self.editor.action(name)
            if action.isEnabled():
                action.trigger()

    def open_a_menu(self) -> None:
        """Open one of the menus of the menu bar."""
        titles = [each for each in self.window.menuBar().actions() if each.menu() is not None]
        title = self.choose.choice(titles)
        self.note(f"menu {title.text()}")
        title.menu().popup(self.window.mapToGlobal(QPoint(20, 20)))

    def drag_somewhere(self) -> None:
        """Drag anything: a dock by its title, a slider, the edge of a panel, a row of a list."""
        target = self._widget_in(None, QWidget)
        if target is None:
            return
        at, to = self._place_in(target), self._place_in(target) + self._little() * 10
        self.note(f"drag {self._called(target)} from {at.toTuple()} to {to.toTuple()}")
        self._mouse(target, QEvent.Type.MouseButtonPress, at)
        for place in ((at + to) / 2, to):
            self._mouse(target, QEvent.Type.MouseMove, place, Qt.MouseButton.LeftButton)
        self._mouse(target, QEvent.Type.MouseButtonRelease, to)

    def copy_something(self) -> None:
        """Put something on the clipboard."""
        text = self.choose.choice(CLIPBOARD)
        self.note(f"clipboard {text[:20]!r}")
        QGuiApplication.clipboard().setText(text)

    def drop_a_file(self) -> None:
        """Drop a file on the window."""
        path = self.choose.choice(self.files)
        self.note(f"drop {path.name}")
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(path))])
        place, left = QPoint(300, 300), Qt.MouseButton.LeftButton
        QApplication.sendEvent(
            self.window, QDragEnterEvent(place, Qt.DropAction.CopyAction, data, left, NO_KEYS)
        )
        QApplication.sendEvent(
            self.window, QDropEvent(QPointF(place), Qt.DropAction.CopyAction, data, left, NO_KEYS)
        )

    def resize(self) -> None:
        """Make the window another size."""
        size = self.choose.choice(((1200, 800), (800, 500), (640, 480), (1900, 1100), (1000, 1400)))
        self.note(f"resize {size}")
        self.window.resize(*size)

    # How

    def _aim(self, plot: PlotWidget) -> QPoint:
        """Return a pixel worth pressing at: a point, a place on the curve, a handle, a grip, or anywhere."""
        canvas, view, chance = self.window.canvas, self.session.active_view, self.choose.random()
        place = None
        if plot is canvas and view.source.points and chance < 0.35:
            place = self.choose.choice(view.source.points).position
        elif plot is canvas and canvas.drawing.points.handles and chance < 0.45:
            place = self.choose.choice(canvas.drawing.points.handles).position
        elif plot is canvas and view.curve is not None and chance < 0.65:
            place = tuple(view.curve.evaluate(self.choose.uniform(*view.curve.domain)))
        elif plot is self.window.basis_panel and len(view.parameters) and chance < 0.5:
            pixel = plot.rail_pixel(self.choose.choice(view.parameters.tolist())).toPoint()
            if plot.viewport().rect().contains(pixel):
                return pixel
        if place is not None:
            pixel = plot.pixel_map.point(*place)
            # Far outside there is no pixel that Qt could be told.
            if max(map(abs, pixel)) < 1e4 and plot.viewport().rect().contains(plot.to_pixel(*place)):
                return plot.to_pixel(*place)
        return self._place_in(plot.viewport())

    def _place_in(self, widget: QWidget) -> QPoint:
        return QPoint(
            self.choose.randrange(max(widget.width(), 1)), self.choose.randrange(max(widget.height(), 1))
        )

    def _little(self) -> QPoint:
        return QPoint(self.choose.randint(-9, 9), self.choose.randint(-9, 9))

    def _widget_in(self, within: QWidget | None, kinds) -> QWidget | None:
        """Return a widget of one of these kinds that is in sight, in `within` or in any window."""
        window = within or self.choose.choice([each for each in self._windows() if each.isVisible()])
        kinds = kinds if isinstance(kinds, tuple) else (kinds,)
        found = [each for kind in kinds for each in window.findChildren(kind) if self._is_in_sight(each)]
        return self.choose.choice(found) if found else None

    def _windows(self) -> list[QWidget]:
        shown = (each for each in QApplication.topLevelWidgets() if each.isVisible())
        own = [each for each in shown if isinstance(each, QDialog)]
        return [self.window] * 4 + sorted(own, key=lambda each: type(each).__name__)

    @staticmethod
    def _is_in_sight(widget: QWidget) -> bool:
        return widget.isVisible() and widget.isEnabled() and not widget.visibleRegion().isEmpty()

    def _click(self, target, at, button=Qt.MouseButton.LeftButton, held=NO_KEYS) -> None:
        self._mouse(target, QEvent.Type.MouseMove, at, held=held)
        self._mouse(target, QEvent.Type.MouseButtonPress, at, button, held)
        self._mouse(target, QEvent.Type.MouseButtonRelease, at, button, held)

    @staticmethod
    def _mouse(target, kind, at, button=None, held=NO_KEYS) -> None:
        """Send a mouse event; without a `button` a move has none, and anything else the left one."""
        if not isValid(target) or not target.isVisible():
            return  # what was pressed has put itself away
        nothing, place = Qt.MouseButton.NoButton, QPointF(target.mapToGlobal(at))
        if kind == QEvent.Type.MouseMove:
            pair = nothing, button or nothing
        else:
            button = button or Qt.MouseButton.LeftButton
            pair = button, nothing if kind == QEvent.Type.MouseButtonRelease else button
        QApplication.sendEvent(target, QMouseEvent(kind, QPointF(at), place, *pair, held))

    def _type(self, text: str) -> None:
        for character in text:
            if character.isascii():
                self._key(character)
            else:
                # QTest aborts over what is no key of an English keyboard.
                key = QKeyEvent(QEvent.Type.KeyPress, Qt.Key.Key_unknown, NO_KEYS, character)
                QApplication.sendEvent(self._keyboard, key)

    def _key(self, key: Qt.Key | str, held=NO_KEYS) -> None:
        QTest.keyClick(self._keyboard, key, held)

    @property
    def _keyboard(self) -> QWidget:
        """Where keys go: asked for each, since each may take them elsewhere."""
        return QApplication.activePopupWidget() or QApplication.focusWidget() or self.window

    @staticmethod
    def _ask_for_menu(target: QWidget, at: QPoint) -> None:
        if not isValid(target):
            return
        QApplication.sendEvent(
            target, QContextMenuEvent(QContextMenuEvent.Reason.Mouse, at, target.mapToGlobal(at))
        )

    @staticmethod
    def _called(widget: QWidget) -> str:
        parent = widget.parentWidget()
        return (
            widget.objectName() or f"{type(widget).__name__} of {parent.objectName() if parent else 'none'}"
        )

    @staticmethod
    def _name_of(held: Qt.KeyboardModifier) -> str:
        return "" if held == NO_KEYS else str(held).removeprefix("KeyboardModifier.")
