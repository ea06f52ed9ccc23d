"""History of a document: undo, redo, and the panel with the list of steps."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize
from PySide6.QtGui import QPalette, QUndoStack
from PySide6.QtWidgets import QStyledItemDelegate, QStyleOptionViewItem, QUndoView, QWidget

from ...actions.declaration import action, also
from ...actions.menus import EDIT_BACK, EDIT_HISTORY, TOOLBAR
from ...actions.needs import Need
from ...appearance.theme import mix, theme_of
from ...qt.labels import menu_text
from ...qt.overrides import SafeOverrides
from ...widgets.boxes import column_of
from ...widgets.controls import named
from ...workbench.context import WindowContext
from ...workbench.docks import UPPER, Panel


def _titled(verb: str, step: str) -> str:
    return f"{verb}: {menu_text(step)}" if step else verb


class HistoryCommands:
    """Actions Undo and Redo, and the panel with the list of steps.

    Attributes
    ----------
    panel
        The list of steps, once its dock has been shown.
    """

    panel: HistoryPanel | None = None

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        canvas = context.central.canvas
        canvas.gesture_began.connect(lambda: self._follow_gesture(is_held=True))
        canvas.gesture_ended.connect(self._follow_gesture)
        canvas.background_changed.connect(self._follow_gesture)
        self._session.history_changed.connect(self._name_steps)
        # What the history begins with; empty for a window that has opened nothing.
        self._beginning = ""
        self._session.opened.connect(self._name_beginning)
        if self._session.files.path is not None:
            self._name_beginning()

    def _name_steps(self) -> None:
        """Add the names of the next steps to the texts of Undo and Redo."""
        actions, stack = self._context.actions, self._session.undo_stack
        actions["undo"].setText(_titled("Undo", stack.undoText()))
        actions["redo"].setText(_titled("Redo", stack.redoText()))

    def _follow_gesture(self, *, is_held: bool = False) -> None:
        """Enable Undo during a gesture or background work, also if there is no step to undo."""
        canvas = self._context.central.canvas
        is_in_flight = is_held or canvas.is_dragging or canvas.tools.background.is_busy
        self._context.store.change(in_flight=is_in_flight and not self._session.undo_stack.canUndo())

    @Panel("historyDock", "History", UPPER)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel with the list of steps."""
        panel = self.panel = HistoryPanel(self._session.undo_stack, parent)
        if self._beginning:
            panel.name_beginning(self._beginning)
        return panel

    def _name_beginning(self) -> None:
        """Name the first entry of the list after the document that was opened."""
        session = self._session
        if session.undo_stack.count():
            return  # a lesson or an example was opened as a step; it began with something else
        files, curve = session.files, session.active_curve
        name = files.origin.file_stem or (curve.name if curve.points else "")
        opened = files.path.name if files.path is not None else name
        self._beginning = f"Opened {opened}" if opened else "New document"
        if self.panel is not None:
            self.panel.name_beginning(self._beginning)

    @action(
        "undo",
        "Undo",
        EDIT_HISTORY,
        "Ctrl+Z",
        "undo",
        needs=Need("", lambda state: state.can_undo, "Nothing to undo."),
        during_gesture=True,
    )
    @also(TOOLBAR(20))
    def _undo(self) -> None:
        """Undo the last step."""
        # Undo during a drag cancels the drag, not the step before it; then background work of a drag.
        stack = self._session.undo_stack
        if self._context.cancel_gesture():
            return
        if title := self._context.central.canvas.tools.background.cancel_last():
            self._session.say(f"{title} was cancelled.")
        elif self._context.store.state.undoes_discard:
            self._context.actions["recoverWork"].trigger()
        elif stack.canUndo():
            text = stack.undoText()
            stack.undo()
            self._session.say(f"Undone: {text}.")

    @action(
        "goBack",
        "Return to Document",
        EDIT_BACK,
        icon="history",
        full_name="Return to the Document Before the Lesson",
        needs=Need("work that was replaced by a lesson or an example", lambda state: state.can_go_back),
    )
    def _go_back(self) -> None:
        """Reopen the document that was open before this lesson or example; Redo returns here."""
        files, stack = self._session.files, self._session.undo_stack
        here = files.origin
        while files.origin is here and here.before is not None and stack.canUndo():
            stack.undo()
        self._session.say("Your document is open again. Redo returns to the lesson or example.")

    @action(
        "redo",
        "Redo",
        EDIT_HISTORY,
        "Ctrl+Shift+Z, Ctrl+Y",
        "redo",
        needs=Need("", lambda state: state.can_redo, "Nothing to redo."),
    )
    @also(TOOLBAR(21))
    def _redo(self) -> None:
        """Redo the last undone step."""
        stack = self._session.undo_stack
        if stack.canRedo():
            text = stack.redoText()
            stack.redo()
            self._session.say(f"Redone: {text}.")


COMMAND_SETS = (HistoryCommands,)


# The panel

_MARGIN = 6
"""Additional pixels between the edge and the text of a row."""


class _StepDelegate(SafeOverrides, QStyledItemDelegate):
    """Delegate that draws undone steps in muted italics."""

    def __init__(self, view: QUndoView) -> None:
        super().__init__(view)
        self._view = view

    def initStyleOption(
        self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().initStyleOption(option, index)
        theme = theme_of(self._view.palette())
        palette = QPalette(option.palette)
        palette.setColor(QPalette.ColorRole.Highlight, mix(theme.accent, theme.paper, 0.2))
        palette.setColor(QPalette.ColorRole.HighlightedText, theme.ink)
        if index.row() > self._view.stack().index():
            palette.setColor(QPalette.ColorRole.Text, theme.muted)
            option.font.setItalic(True)
        option.palette = palette
        # An empty icon before the text is a margin, while the background of the row keeps its width.
        option.features |= QStyleOptionViewItem.ViewItemFeature.HasDecoration
        option.decorationSize = QSize(_MARGIN, 1)

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        # As wide as the list; the default asks the style for everything that the row draws.
        return QSize(0, option.fontMetrics.height() + 8)


class HistoryPanel(QWidget):
    """Panel with the undo stack; a click on a step goes to it.

    Attributes
    ----------
    view
        The QUndoView.
    """

    def __init__(self, steps: QUndoStack, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("historyPanel")
        self.view = QUndoView(steps, self)
        named(self.view, "historyView", "History", "Click a step to return to it (↑ ↓)")
        self.view.setFrameShape(QUndoView.Shape.NoFrame)
        self.view.setUniformItemSizes(True)
        self._delegate = _StepDelegate(self.view)
        self.view.setItemDelegate(self._delegate)
        column_of(self.view, margins=0, parent=self)
        self.name_beginning("Start")

    def name_beginning(self, text: str) -> None:
        """Set the name of the state before the first step."""
        if text != self.view.emptyLabel():
            self.view.setEmptyLabel(text)
