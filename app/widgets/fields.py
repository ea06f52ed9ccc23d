"""Fields for numbers and words: edits, spin boxes, forms, and fields in the cells of a table."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QLocale, Qt, Signal
from PySide6.QtGui import QFocusEvent, QFont, QKeyEvent, QKeySequence, QWheelEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QAbstractSpinBox,
    QDialog,
    QDoubleSpinBox,
    QHeaderView,
    QLineEdit,
    QSpinBox,
    QStyledItemDelegate,
    QTableView,
    QWidget,
)

from ..appearance.theme import FollowsTheme
from ..document.expression import ExpressionError, parse_number
from ..document.words import number, with_minus
from ..qt.labels import WARNING, Label, set_tip
from ..qt.overrides import ENTER, PASSING, ClaimsKeys
from .controls import WheelNeedsFocus, named
from .number_text import angle_text, decimal_mark, field_text, typed_text

_DOCUMENT_KEYS = (QKeySequence.StandardKey.Undo, QKeySequence.StandardKey.Redo)

_STEPS = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}
"""Keys, and the steps up that they make."""

_KEYPAD = Qt.KeyboardModifier.KeypadModifier
_NOTCH = 120
"""Eighths of a degree of one notch of a wheel."""


class FieldEdit(ClaimsKeys, QLineEdit):
    """A line that shows a text of the document, and reports a typed text with Enter or Tab, if it differs.

    A receiver of `committed` that cannot use the text calls `keep`: the text stays for correction, with the
    cursor in it. Escape, or a click elsewhere, restores the document's text; the same happens to a text that
    was not entered, because half a number must never reach the curve.

    Attributes
    ----------
    is_pressed_again
        Whether Enter acts each time, even with the same text; otherwise the focus returns to the canvas.
    is_entered_when_left
        Whether a click elsewhere enters the text, as in a dialog, where a button follows.

    Signals
    -------
    committed
        A different text was typed and entered.
    left
        Typing begins or was given up: a message about the last text is out of date.
    """

    committed = Signal(str)
    left = Signal()

    def __init__(self, name: str, label: str, tip: str) -> None:
        super().__init__()
        self.is_pressed_again = self.is_entered_when_left = False
        named(self, name, label, tip)
        self.setTextMargins(3, 0, 3, 0)
        self._full = self._short = self._entered = ""
        self.returnPressed.connect(self._commit)
        self.textEdited.connect(self.left)

    def show_text(self, text: str, short: str | None = None) -> None:
        """Show the document's text, unless another one is being typed.

        Without the focus, the field shows `short` in place of a text that is too long for it.
        """
        self._full, self._short = text, text if short is None else short
        if not self.isModified():
            self._show_document_text()

    def revert(self) -> None:
        """Show the document's text again."""
        self.setModified(False)
        self._show_document_text()

    def give_up(self) -> None:
        """Discard the typed text and show the document's again."""
        self.revert()
        self.left.emit()

    def _show_document_text(self) -> None:
        text = self._full if self.hasFocus() else self._short
        if self.text() != text:
            self.setText(text)
            self.setCursorPosition(0)

    def _commit(self) -> None:
        typed = self.text()
        # The short text is another one: typing exactly that is a change.
        changed = self.isModified() and typed != self._full
        # Unmodified from here on, so that the document's answer is shown; typing cannot be undone.
        self.setText(typed)
        if changed:
            self._entered = typed
            self.committed.emit(typed)
        else:
            self.left.emit()

    def enter(self) -> None:
        """Enter the typed text, as the Return key does."""
        if self.isModified():
            self._commit()

    def keep(self) -> None:
        """Keep the text that was entered last in the field, for correction."""
        self.setText(self._entered)
        self.setModified(True)
        self.selectAll()

    def focusInEvent(self, event: QFocusEvent) -> None:
        if not self.isModified():
            self._show_document_text()
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in PASSING:
            (self.enter if self.is_entered_when_left else self.give_up)()

    def focusNextPrevChild(self, forward: bool) -> bool:
        self._commit()
        # A refused text keeps the focus for correction.
        return self.isModified() or super().focusNextPrevChild(forward)

    def claims(self, event: QKeyEvent) -> bool:
        # Escape belongs to the window as well; during typing it discards the typed text.
        return event.key() == Qt.Key.Key_Escape and self.isModified()

    def _passes_on(self, event: QKeyEvent) -> bool:
        """Return whether a key goes to the document: no text is selected to copy, none typed to undo."""
        if event.matches(QKeySequence.StandardKey.Copy):
            return not self.hasSelectedText()
        return not self.isModified() and any(map(event.matches, _DOCUMENT_KEYS))

    def event(self, event: QEvent) -> bool:
        is_claim = event.type() == QEvent.Type.ShortcutOverride
        if is_claim and isinstance(event, QKeyEvent) and self._passes_on(event):
            # A QLineEdit claims these keys even where they do nothing.
            event.ignore()
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self._passes_on(event):
            event.ignore()
        elif self.claims(event):
            self.give_up()
            # The key goes on to the window, which focuses the canvas, but not to a dialog.
            event.setAccepted(isinstance(self.window(), QDialog))
        else:
            super().keyPressEvent(event)


class PopupLine(ClaimsKeys, QLineEdit):
    """A line edit in a small frame that appears for it.

    Signals
    -------
    entered
        Enter was pressed.
    given_up
        Escape was pressed.
    left
        The focus has gone elsewhere.
    """

    entered = Signal()
    given_up = Signal()
    left = Signal()

    def __init__(self, name: str, label: str, tip: str) -> None:
        super().__init__()
        named(self, name, label, tip)

    def claims(self, event: QKeyEvent) -> bool:
        return event.key() in (*ENTER, Qt.Key.Key_Escape)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self.claims(event):
            (self.entered if event.key() in ENTER else self.given_up).emit()
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in PASSING:
            self.left.emit()


def read_number(text: str) -> float:
    """Return the typed number, or the value of an expression; raise `ExpressionError` if it is neither."""
    return parse_number(text, decimal_mark())


class NumberEdit(FieldEdit):
    """A line that reports a typed number; a text that is none stays for correction.

    Parameters
    ----------
    read
        Returns the value of a text, or raises `ExpressionError` with the reason why it cannot be used.
    step
        Returns the number some steps up (1) or down (−1) from another, for the arrow keys and, while the
        field has the focus, the wheel. None where numbers are only typed.

    Signals
    -------
    entered
        Another number was entered; a receiver that cannot use it calls `keep`.
    stepped
        Another number was reached by a step; quick steps count as one.
    refused
        The reason why an entered text cannot be used.
    """

    entered = Signal(object)
    stepped = Signal(object)
    refused = Signal(str)

    def __init__(
        self,
        name: str,
        label: str,
        tip: str,
        read: Callable[[str], object] = read_number,
        step: Callable[[float, int], float] | None = None,
    ) -> None:
        super().__init__(name, label, tip)
        self._read, self._step, self._tip = read, step, tip
        # The turn of the wheel since the last notch.
        self._turned = 0
        self.committed.connect(self._enter)

    def show_text(self, text: str, short: str | None = None) -> None:
        """Show the document's text; the tip begins with it where `short` differs."""
        super().show_text(text, short)
        exact = with_minus(text)
        set_tip(self, self._tip if short in (None, text, exact) else f"{exact} · {self._tip}")

    def show_number(self, value: float, digits: int | None = None) -> None:
        """Show a number, without the focus rounded to `digits`."""
        self.show_text(typed_text(value), None if digits is None else number(value, digits, decimal_mark()))

    def show_length(self, value: float, unit: str = "") -> None:
        """Show a number with its unit, without the focus with few decimals."""
        self.show_text(*(f"{text} {unit}".rstrip() for text in (typed_text(value), field_text(value))))

    def show_angle(self, degrees: float) -> None:
        """Show an angle, without the focus rounded to a thousandth of a degree."""
        self.show_text(typed_text(degrees), angle_text(degrees))

    def _enter(self, text: str) -> None:
        try:
            value = self._read(text)
        except ExpressionError as reason:
            self.keep()
            self.refused.emit(str(reason))
        else:
            self.entered.emit(value)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        count = _STEPS.get(Qt.Key(event.key())) if not event.modifiers() & ~_KEYPAD else None
        if self._step is None or count is None:
            super().keyPressEvent(event)
        else:
            self._step_by(count)

    def wheelEvent(self, event: QWheelEvent) -> None:
        if self._step is None or not self.hasFocus():
            # The area around the field scrolls.
            super().wheelEvent(event)
            return
        self._turned += event.angleDelta().y()
        while abs(self._turned) >= _NOTCH:
            count = 1 if self._turned > 0 else -1
            self._turned -= count * _NOTCH
            self._step_by(count)
        event.accept()

    def _step_by(self, count: int) -> None:
        """Step from the number in the field; a text that is no number does not step."""
        assert self._step is not None
        try:
            value = self._read(self.text())
        except ExpressionError:
            return
        if isinstance(value, float) and (stepped := self._step(value, count)) != value:
            self._entered = self.text()
            self.setModified(False)
            self.stepped.emit(stepped)


_UNLIMITED = 999_999_999


def _step_between(box: RangedSpinBox | RangedDoubleSpinBox, steps: int) -> None:
    """Step between the limits; called by Qt."""
    QAbstractSpinBox.stepBy(box, steps)
    box.setValue(min(max(box.value(), box.least), box.most))  # type: ignore[arg-type]  # each has its own kind


def _problem_of(box: RangedSpinBox | RangedDoubleSpinBox) -> str:
    """Return why the number in the box is not possible; empty if it is."""
    if box.least <= box.value() <= box.most:
        return ""
    return f"{box.accessibleName()}: from {number(box.least, 6)} to {number(box.most, 6)}."


def _describe(box: RangedSpinBox | RangedDoubleSpinBox, name: str, label: str, tip: str) -> None:
    box.setRange(-_UNLIMITED, _UNLIMITED)
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    named(box, name, label, tip)


class RangedSpinBox(WheelNeedsFocus, QSpinBox):
    """A whole number between two limits, typed or stepped; the arrows stay between them.

    Attributes
    ----------
    least, most
        The limits.
    """

    def __init__(self, name: str, label: str, tip: str, limits: tuple[int, int]) -> None:
        super().__init__()
        self.least, self.most = limits
        self.setLocale(QLocale.c())
        _describe(self, name, label, tip)

    # In the body of each class, where `SafeOverrides` finds overrides.
    stepBy = _step_between  # noqa: N815 - as Qt calls it
    problem = property(_problem_of)


class RangedDoubleSpinBox(WheelNeedsFocus, QDoubleSpinBox):
    """A `RangedSpinBox` with decimals."""

    def __init__(self, name: str, label: str, tip: str, limits: tuple[float, float]) -> None:
        super().__init__()
        self.least, self.most = limits
        _describe(self, name, label, tip)

    stepBy = _step_between  # noqa: N815 - as Qt calls it
    problem = property(_problem_of)


class FieldForm(FollowsTheme, QWidget):
    """A form with a line for a problem.

    Signals
    -------
    edited
        A change is requested: the name of the undo step, and the edit, a function of the document and the
        index of the active curve. A receiver that cannot make it calls `refuse`.
    refused
        The reason why a typed text is no number.

    Attributes
    ----------
    problem
        The line, hidden without a problem.
    """

    edited = Signal(str, object)
    refused = Signal(str)

    def __init__(self, name: str, problem: str, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.problem = Label(name=problem, wordWrap=True, role=WARNING)
        # The field in which was typed last.
        self._entry: FieldEdit | None = None
        self._refusal = self._document_problem = ""

    def watch(self, *fields: FieldEdit) -> None:
        """Show problems of texts typed in these fields; to be called before they are connected."""
        for field in fields:
            field.left.connect(self._clear_refusal)
            if isinstance(field, NumberEdit):
                field.entered.connect(partial(self._begin, field))
                field.stepped.connect(partial(self._begin, field))
                field.refused.connect(partial(self._refuse_text, field))
            else:
                field.committed.connect(partial(self._begin, field))

    def forget_entry(self) -> None:
        """Forget the field in which was typed last: it may be deleted."""
        self._entry = None

    def _begin(self, field: FieldEdit, _value: object) -> None:
        self._entry = field
        self._clear_refusal()

    def _refuse_text(self, field: NumberEdit, reason: str) -> None:
        self._entry = field
        self.refuse(reason)
        self.refused.emit(reason)

    def refuse(self, reason: str) -> None:
        """Show why the requested change was refused; a text in the focused field stays for correction."""
        self._refusal = reason
        if self._entry is not None and self._entry.hasFocus():
            self._entry.keep()
        elif self._entry is not None:
            self._entry.revert()
        self._render_problem()

    def show_problem(self, text: str) -> None:
        """Show the problem of the document's own values; empty for none."""
        self._document_problem = text
        self._render_problem()

    def clear_refusal(self) -> None:
        """Remove the reason of a refusal: it was about another curve."""
        self._refusal = ""

    def _clear_refusal(self) -> None:
        self.clear_refusal()
        self._render_problem()

    def _render_problem(self) -> None:
        self.problem.show_problem(self._refusal or self._document_problem)


def set_up_number_table(view: QTableView, padding: int) -> None:
    """Give a table digits of one width, low rows without lines, and headers that are sized by the program."""
    font = QFont(view.font())
    font.setFeature(QFont.Tag("tnum"), 1)
    view.setFont(font)
    view.setShowGrid(False)
    view.setWordWrap(False)
    across, down = view.horizontalHeader(), view.verticalHeader()
    across.setHighlightSections(False)
    across.setStyleSheet(f"QHeaderView::section {{ padding: 5px {padding}px }}")
    for header in (across, down):
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
    # Qt's own least height follows the font too late.
    down.setMinimumSectionSize(1)
    fit_row_height(view)


def fit_row_height(view: QTableView) -> None:
    """Give the rows of a table the height for its font."""
    view.verticalHeader().setDefaultSectionSize(view.fontMetrics().height() + 8)


def end_editing(view: QAbstractItemView) -> None:
    """Close the open text field of a cell, if there is one, and commit its text."""
    editor = view.viewport().findChild(QLineEdit)
    if view.state() == QAbstractItemView.State.EditingState and editor is not None:
        view.commitData(editor)
        view.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
