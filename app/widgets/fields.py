"""Fields for numbers and words: edits, spin boxes, forms, and fields in the cells of a table."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QEvent, QLocale, Qt, Signal
from PySide6.QtGui import QFocusEvent, QKeyEvent, QKeySequence, QWheelEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QAbstractSpinBox,
    QDialog,
    QDoubleSpinBox,
    QLineEdit,
    QSpinBox,
    QStyledItemDelegate,
    QWidget,
)

from ..appearance.theme import FollowsTheme, Theme
from ..document.expression import ExpressionError, parse_number
from ..document.words import number, with_minus
from ..qt.labels import Label, set_tip
from ..qt.overrides import PASSING, ClaimsKeys, SafeOverrides
from .controls import named
from .number_text import angle_text, decimal_mark, field_text, typed_text

_OF_DOCUMENT = (QKeySequence.StandardKey.Undo, QKeySequence.StandardKey.Redo)

_STEPS = {Qt.Key.Key_Up: 1, Qt.Key.Key_Down: -1}
"""Keys, and how many steps up they mean."""

_KEYPAD = Qt.KeyboardModifier.KeypadModifier
_NOTCH = 120
"""Eighths of a degree by which a wheel turns from notch to notch."""


class FieldEdit(ClaimsKeys, QLineEdit):
    """Shows a text of the document; what is typed is reported with Enter or Tab, and only if it differs.

    Who hears `committed` and cannot use the text calls `keep`: it stays to be mended, the cursor with it, and
    gives way to the document's when Escape is pressed or the field is left by a click elsewhere. So does a
    text that was not entered: half a number must never reach the curve.

    Attributes
    ----------
    is_pressed_again
        Whether Enter acts each time, also with the same text; else the window goes back to the canvas.

    Signals
    -------
    committed
        Another text was typed and entered.
    left
        Typing begins, or was given up: what was said about the last text is out of date.
    """

    committed = Signal(str)
    left = Signal()

    def __init__(self, name: str, label: str, tip: str) -> None:
        super().__init__()
        self.is_pressed_again = False
        named(self, name, label, tip)
        self.setTextMargins(3, 0, 3, 0)
        self._whole = self._short = self._entered = ""
        self.returnPressed.connect(self._commit)
        self.textEdited.connect(self.left)

    def show_text(self, text: str, short: str | None = None) -> None:
        """Show the document's text, unless somebody is typing another.

        While nobody has the cursor in the field it shows `short` in place of a text too long for it.
        """
        self._whole, self._short = text, text if short is None else short
        if not self.isModified():
            self._show_own_text()

    def revert(self) -> None:
        """Show the document's text again."""
        self.setModified(False)
        self._show_own_text()

    def give_up(self) -> None:
        """Take back what was typed: the document's text is shown again."""
        self.revert()
        self.left.emit()

    def _show_own_text(self) -> None:
        text = self._whole if self.hasFocus() else self._short
        if self.text() != text:
            self.setText(text)
            self.setCursorPosition(0)

    def _commit(self) -> None:
        typed = self.text()
        # What is shown short is another text: who types just that wants just that.
        changed = self.isModified() and typed != self._whole
        # So that the document's answer may be shown; and how it was typed is forgotten.
        self.setText(typed)
        if changed:
            self._entered = typed
            self.committed.emit(typed)
        else:
            self.left.emit()

    def enter(self) -> None:
        """Enter what was typed, as the Return key does."""
        if self.isModified():
            self._commit()

    def keep(self) -> None:
        """Leave the text that was entered last in the field, to be mended."""
        self.setText(self._entered)
        self.setModified(True)
        self.selectAll()

    def focusInEvent(self, event: QFocusEvent) -> None:
        if not self.isModified():
            self._show_own_text()
        super().focusInEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() not in PASSING:
            self.give_up()

    def focusNextPrevChild(self, forward: bool) -> bool:
        self._commit()
        # A text that was refused is mended first.
        return self.isModified() or super().focusNextPrevChild(forward)

    def claims(self, event: QKeyEvent) -> bool:
        # Escape is the window's key, too; while somebody types here it takes back what was typed.
        return event.key() == Qt.Key.Key_Escape and self.isModified()

    def _passes_on(self, event: QKeyEvent) -> bool:
        """Whether a key is meant for the document: nothing is chosen here to copy, nor typed to take back."""
        if event.matches(QKeySequence.StandardKey.Copy):
            return not self.hasSelectedText()
        return not self.isModified() and any(map(event.matches, _OF_DOCUMENT))

    def event(self, event: QEvent) -> bool:
        is_asked = event.type() == QEvent.Type.ShortcutOverride
        if is_asked and isinstance(event, QKeyEvent) and self._passes_on(event):
            # A QLineEdit claims these keys, whatever it can do with them.
            event.ignore()
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if self._passes_on(event):
            event.ignore()
        elif self.claims(event):
            self.give_up()
            # The same key goes on: to the window, which gives the canvas the focus, but not to a dialog.
            event.setAccepted(isinstance(self.window(), QDialog))
        else:
            super().keyPressEvent(event)


def read_number(text: str) -> float:
    """Return the number that was typed, or the value of an expression; raise `ExpressionError` if neither."""
    return parse_number(text, decimal_mark())


class NumberEdit(FieldEdit):
    """Reports what is typed as a number; what is none stays to be mended.

    Parameters
    ----------
    read
        Returns what a text means, and raises `ExpressionError` with the reason where it cannot be used.
    step
        Returns the number that is so many steps up (1) or down (−1) from another, by an arrow key or, while
        the field has the focus, the wheel. None where numbers are only typed.

    Signals
    -------
    entered
        Another number was entered; who cannot use it calls `keep`.
    stepped
        Another number was reached by a step; what follows quickly is meant as one.
    refused
        Why a text that was entered cannot be used.
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
        # Parts of a notch that the wheel has turned.
        self._turned = 0
        self.committed.connect(self._enter)

    def show_text(self, text: str, short: str | None = None) -> None:
        """Show the document's text; the tip begins with it where `short` leaves out some of it."""
        super().show_text(text, short)
        exact = with_minus(text)
        set_tip(self, self._tip if short in (None, text, exact) else f"{exact} · {self._tip}")

    def show_number(self, value: float, digits: int | None = None) -> None:
        """Show a number, while nobody has the cursor in the field with so many digits."""
        self.show_text(typed_text(value), None if digits is None else number(value, digits, decimal_mark()))

    def show_length(self, value: float, unit: str = "") -> None:
        """Show a number with its unit, while nobody has the cursor in the field in few decimals."""
        self.show_text(*(f"{text} {unit}".rstrip() for text in (typed_text(value), field_text(value))))

    def show_angle(self, degrees: float) -> None:
        """Show an angle, while nobody has the cursor in the field to a thousandth of a degree."""
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
            # Whatever lies around it scrolls.
            super().wheelEvent(event)
            return
        self._turned += event.angleDelta().y()
        while abs(self._turned) >= _NOTCH:
            count = 1 if self._turned > 0 else -1
            self._turned -= count * _NOTCH
            self._step_by(count)
        event.accept()

    def _step_by(self, count: int) -> None:
        """Go on from the number that is in the field; from what is no number there is no step."""
        assert self._step is not None
        try:
            value = self._read(self.text())
        except ExpressionError:
            return
        if isinstance(value, float) and (other := self._step(value, count)) != value:
            self._entered = self.text()
            self.setModified(False)
            self.stepped.emit(other)


_FAR = 999_999_999


def _step_between(box: RangedSpinBox | RangedDoubleSpinBox, steps: int) -> None:
    """Step, and stay between the limits; called by Qt."""
    QAbstractSpinBox.stepBy(box, steps)
    box.setValue(min(max(box.value(), box.least), box.most))  # type: ignore[arg-type]  # each has its own kind


def _turn(box: RangedSpinBox | RangedDoubleSpinBox, event: QWheelEvent) -> None:
    """Step while it has the focus; else what lies around it scrolls. Called by Qt."""
    if box.hasFocus():
        QAbstractSpinBox.wheelEvent(box, event)
    else:
        event.ignore()


def _problem_of(box: RangedSpinBox | RangedDoubleSpinBox) -> str:
    """Why the number that stands here is not possible; empty where it is."""
    if box.least <= box.value() <= box.most:
        return ""
    return f"{box.accessibleName()}: from {number(box.least, 6)} to {number(box.most, 6)}."


def _describe(box: RangedSpinBox | RangedDoubleSpinBox, name: str, label: str, tip: str) -> None:
    box.setRange(-_FAR, _FAR)
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    named(box, name, label, tip)


class RangedSpinBox(SafeOverrides, QSpinBox):
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

    # In the body of each class, where `SafeOverrides` finds what overrides Qt's.
    stepBy = _step_between  # noqa: N815 - as Qt calls it
    wheelEvent = _turn
    problem = property(_problem_of)


class RangedDoubleSpinBox(SafeOverrides, QDoubleSpinBox):
    """As `RangedSpinBox`, with decimals."""

    def __init__(self, name: str, label: str, tip: str, limits: tuple[float, float]) -> None:
        super().__init__()
        self.least, self.most = limits
        _describe(self, name, label, tip)

    stepBy = _step_between  # noqa: N815 - as Qt calls it
    wheelEvent = _turn
    problem = property(_problem_of)


class FieldForm(FollowsTheme, QWidget):
    """A form with a line for what is wrong.

    Signals
    -------
    edited
        A change is wanted: the name of the step, and its edit, a function of the document and of the place of
        the curve that is edited. Who cannot make it calls `refuse`.
    refused
        Why a text that was typed is no number.

    Attributes
    ----------
    problem
        The line, hidden while nothing is wrong.
    """

    edited = Signal(str, object)
    refused = Signal(str)

    def __init__(self, name: str, problem: str, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.problem = Label(name=problem, wordWrap=True)
        # The field that was typed in last.
        self._entry: FieldEdit | None = None
        self._refusal = self._standing = ""

    def watch(self, *fields: FieldEdit) -> None:
        """Say what is wrong with what is typed in these fields; to be called before they are connected."""
        for field in fields:
            field.left.connect(self._clear_refusal)
            if isinstance(field, NumberEdit):
                field.entered.connect(partial(self._begin, field))
                field.stepped.connect(partial(self._begin, field))
                field.refused.connect(partial(self._refuse_text, field))
            else:
                field.committed.connect(partial(self._begin, field))

    def forget_entry(self) -> None:
        """Forget the field that was typed in last: it may be gone."""
        self._entry = None

    def _begin(self, field: FieldEdit, _value: object) -> None:
        self._entry = field
        self._clear_refusal()

    def _refuse_text(self, field: NumberEdit, reason: str) -> None:
        self._entry = field
        self.refuse(reason)
        self.refused.emit(reason)

    def refuse(self, reason: str) -> None:
        """Say why what was asked for cannot be done; a text stays to be mended while the cursor is there."""
        self._refusal = reason
        if self._entry is not None and self._entry.hasFocus():
            self._entry.keep()
        elif self._entry is not None:
            self._entry.revert()
        self._render_problem()

    def show_problem(self, text: str) -> None:
        """Say what is wrong with what is shown; empty where nothing is."""
        self._standing = text
        self._render_problem()

    def clear_refusal(self) -> None:
        """Say no longer why something was refused: it was about something else."""
        self._refusal = ""

    def _clear_refusal(self) -> None:
        self.clear_refusal()
        self._render_problem()

    def _render_problem(self) -> None:
        text = self._refusal or self._standing
        self.problem.setText(f"⚠ {text}" if text else "")
        self.problem.setVisible(bool(text))

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.problem.setStyleSheet(f"color: {theme.warning.name()}")


def end_editing(view: QAbstractItemView) -> None:
    """Close the open text field, if there is one, as if the keyboard left it; Qt edits one cell at a time."""
    editor = view.viewport().findChild(QLineEdit)
    if view.state() == QAbstractItemView.State.EditingState and editor is not None:
        view.commitData(editor)
        view.closeEditor(editor, QStyledItemDelegate.EndEditHint.NoHint)
