"""Command palette: search for a command by a few letters, and run it with Enter."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import msgspec
from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    QPoint,
    QRect,
    QSize,
    Qt,
)
from PySide6.QtGui import QAction, QFocusEvent, QFont, QIcon, QKeyEvent, QPainter
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QLineEdit,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)
from shiboken6 import isValid

from ..actions.keymap import full_name_of, keywords_of, native, reason_disabled
from ..appearance.theme import Theme, mix, theme_of
from ..qt.labels import Label
from ..qt.overrides import ENTER, SafeOverrides
from ..widgets.boxes import column_of
from ..widgets.controls import named
from ..widgets.frames import OverlayFrame
from .fuzzy import SearchEntry, ranked

_WIDEST, _ROWS, _ROW_HEIGHT, _TOP = 560, 10, 30, 12
_COMMAND = Qt.ItemDataRole.UserRole + 1
_ROOT = QModelIndex()


class Command(msgspec.Struct, frozen=True):
    """Entry of the palette: an action and its path in the menus.

    Attributes
    ----------
    is_on
        Whether the action is a switch that is on.
    """

    action: QAction
    path: str
    is_on: bool = False

    @property
    def name(self) -> str:
        """Name of the action where its menu is not visible."""
        return full_name_of(self.action)

    @property
    def entry(self) -> SearchEntry:
        """The texts by which the search finds the command."""
        return SearchEntry(self.name, self.path, self.action.statusTip(), keywords_of(self.action))


class CommandPalette(OverlayFrame):
    """Search field over a list of commands, on top of another widget.

    Parameters
    ----------
    below
        The widget below the palette, which keeps its size.
    commands
        Function that returns the commands, called when the palette opens.
    """

    def __init__(self, below: QWidget, commands: Callable[[], Sequence[Command]]) -> None:
        super().__init__("commandPalettePanel", below)
        self.setAccessibleName("Command palette")
        self._commands_now = commands
        # With their search texts, collected once per opening and not at every letter.
        self._commands: list[tuple[Command, SearchEntry]] = []
        # The ids of actions that exist.
        self._heard: set[int] = set()
        self._focus_before: QWidget | None = None
        self.search = _SearchField(self)
        self.list = _command_list()
        self._note = Label(name="paletteNote")
        self._model = _CommandModel(self)
        self.list.setModel(self._model)
        self.list.setItemDelegate(_CommandDelegate(self.list))
        self._rows = column_of(self.search, self.list, self._note, margins=8, spacing=6, parent=self)
        self.search.textChanged.connect(self._look_up)
        self.list.clicked.connect(self._run)
        self.follow_theme()
        self.hide()

    # Opening and closing

    def open(self) -> None:
        """Show all commands, with the focus in the search field."""
        self._focus_before = QApplication.focusWidget()
        self._commands = [(command, command.entry) for command in self._commands_now()]
        self._hear_of_ends()
        self.search.clear()
        self._look_up("")
        self.show()
        self.raise_()
        self.search.setFocus(Qt.FocusReason.PopupFocusReason)

    def _hear_of_ends(self) -> None:
        """Drop each action that is deleted while it is listed: a menu that opens may be filled again."""
        for action in (command.action for command, _ in self._commands):
            if id(action) not in self._heard:
                self._heard.add(id(action))
                action.destroyed.connect(partial(self._drop, action))

    def _drop(self, action: QAction, *_: object) -> None:
        if not isValid(self):
            return
        self._heard.discard(id(action))
        self._commands = [pair for pair in self._commands if pair[0].action is not action]
        left = [command for command in self._model.commands if command.action is not action]
        if len(left) < self._model.rowCount():
            self._model.show(left)

    def close_and_return(self) -> None:
        """Close, and restore the focus."""
        before, self._focus_before = self._focus_before, None
        # The editor of a table cell is gone by now: it closes when it loses the focus.
        target = before if before is not None and isValid(before) and before.isVisible() else self.below
        target.setFocus(Qt.FocusReason.PopupFocusReason)
        self.hide()

    # Search and run

    @property
    def matches(self) -> list[str]:
        """Names of the listed commands, best first."""
        return [command.name for command in self._model.commands]

    def _look_up(self, typed: str) -> None:
        self._model.show(_ranked(self._commands, typed))
        self._note.show_text("" if self._model.rowCount() else "No command matches.")
        self.list.setVisible(not self._note.text())
        if self._model.rowCount():
            self.list.setCurrentIndex(self._model.index(0, 0))
        self.place()

    def step(self, rows: int) -> None:
        """Move the selection up or down; single steps wrap around at the ends."""
        count = self._model.rowCount()
        if not count:
            return
        here = self.list.currentIndex().row()
        row = (here + rows) % count if abs(rows) == 1 else min(max(here + rows, 0), count - 1)
        self.list.setCurrentIndex(self._model.index(row, 0))

    def run_current(self) -> None:
        """Run the selected command."""
        self._run(self.list.currentIndex())

    def _run(self, index: QModelIndex) -> None:
        command = index.data(_COMMAND)
        if command is None:
            return
        if not command.action.isEnabled():
            self._note.show_text(reason_disabled(command.action))
            self.place()
            return
        # Closed first: the command may open a dialog, or depend on the focus.
        self.close_and_return()
        command.action.trigger()

    def place(self) -> None:
        """Move to the top centre of the widget, as high as the list needs and the room allows."""
        below = self.below
        width = min(_WIDEST, below.width() - 2 * _TOP)
        rows = min(self._model.rowCount(), _ROWS, max((below.height() - 90) // _ROW_HEIGHT, 3))
        self.list.setFixedHeight(rows * _ROW_HEIGHT + 4)
        self._rows.activate()
        self.setGeometry((below.width() - width) // 2, _TOP, width, self.sizeHint().height())

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet(
            "#paletteSearch { padding: 4px 6px }"
            f"#paletteNote {{ color: {theme.muted.name()}; padding: 4px }}",
            line=0.2,
        )


def _ranked(commands: Sequence[tuple[Command, SearchEntry]], typed: str) -> list[Command]:
    """Return the matching commands, best first, disabled ones last."""
    order = ranked(typed, [entry for _, entry in commands]) if typed.strip() else range(len(commands))
    matching = [commands[index][0] for index in order]
    return sorted(matching, key=lambda command: not command.action.isEnabled())


class _CommandModel(SafeOverrides, QAbstractListModel):
    """List model of the matching commands."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.commands: Sequence[Command] = ()

    def show(self, commands: Sequence[Command]) -> None:
        """Show these commands."""
        self.beginResetModel()
        self.commands = commands
        self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = _ROOT) -> int:
        return 0 if parent.isValid() else len(self.commands)

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = _COMMAND) -> object:
        command = self.commands[index.row()]
        if role == _COMMAND:
            return command
        if role == Qt.ItemDataRole.DisplayRole:
            return command.name
        return command.action.statusTip() if role == Qt.ItemDataRole.ToolTipRole else None


class _SearchField(SafeOverrides, QLineEdit):
    """Search field that passes arrow keys, Enter and Escape on to the palette."""

    def __init__(self, palette: CommandPalette) -> None:
        super().__init__(palette)
        self._owner = palette
        tip = "Type a few letters of a command; ↑ ↓ select, Enter runs it, Escape closes"
        named(self, "paletteSearch", "Search for a command", tip)
        self.setPlaceholderText("What do you want to do?")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        steps = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -_ROWS, Qt.Key.Key_PageDown: _ROWS}
        key = Qt.Key(event.key())
        if key in steps:
            self._owner.step(steps[key])
        elif key in ENTER:
            self._owner.run_current()
        elif key == Qt.Key.Key_Escape:
            self._owner.close_and_return()
        else:
            super().keyPressEvent(event)

    def focusNextPrevChild(self, forward: bool) -> bool:
        self._owner.step(1 if forward else -1)
        return True

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        # A click elsewhere closes; a switch to another window does not.
        if event.reason() in (Qt.FocusReason.MouseFocusReason, Qt.FocusReason.OtherFocusReason):
            self._owner.hide()


def _command_list() -> QListView:
    view = named(QListView(), "paletteList", "Matching commands", "Click to run the command")
    view.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    view.setUniformItemSizes(True)
    view.setFrameShape(QFrame.Shape.NoFrame)
    view.viewport().setAutoFillBackground(False)
    view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return view


class _CommandDelegate(SafeOverrides, QStyledItemDelegate):
    """Delegate that paints icon, name, menu path and keys of a command, muted where it is disabled."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(200, _ROW_HEIGHT)

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        command = index.data(_COMMAND)
        theme = theme_of(QApplication.palette())
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(option.rect, mix(theme.accent, theme.surface, 0.2))
        enabled = command.action.isEnabled()
        room = option.rect.adjusted(10, 0, -10, 0)
        mode = QIcon.Mode.Normal if enabled else QIcon.Mode.Disabled
        pixmap = command.action.icon().pixmap(QSize(16, 16), painter.device().devicePixelRatioF(), mode)
        if not pixmap.isNull():
            painter.drawPixmap(QPoint(room.left(), room.center().y() - 7), pixmap)
        room.setLeft(room.left() + 28)
        painter.setFont(option.font)
        faint = mix(theme.muted, theme.surface, 0.6)
        keys = command.action.shortcuts()
        painter.setPen(theme.muted if enabled else faint)
        self._write(painter, room, native(keys[0]) if keys else "", right=True)
        painter.setPen(theme.ink if enabled else faint)
        text = f"{command.name}  ✓" if command.is_on else command.name
        room.setLeft(room.left() + self._write(painter, room, text) + 12)
        small = QFont(option.font)
        small.setPointSizeF(max(option.font.pointSizeF() - 1, 7.0))
        painter.setFont(small)
        painter.setPen(theme.muted if enabled else faint)
        self._write(painter, room, command.path)

    @staticmethod
    def _write(painter: QPainter, room: QRect, text: str, *, right: bool = False) -> int:
        """Write text on one line and return its width; text at the right reduces the room."""
        width = painter.fontMetrics().horizontalAdvance(text)
        side = Qt.AlignmentFlag.AlignRight if right else Qt.AlignmentFlag.AlignLeft
        elided = painter.fontMetrics().elidedText(text, Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, int(side | Qt.AlignmentFlag.AlignVCenter), elided)
        if right and text:
            room.setRight(room.right() - width - 12)
        return width
