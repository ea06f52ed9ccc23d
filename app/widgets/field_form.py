"""Forms whose fields show values of the document, and say why what was typed cannot be taken."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from ..appearance.theme import Theme
from ..appearance.themed import FollowsTheme
from ..qt.labels import Label
from .field_edit import FieldEdit, NumberEdit


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
