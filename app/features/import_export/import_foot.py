"""The buttons at the foot of an import; where more files wait, what becomes of those."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QDialog, QDialogButtonBox, QWidget

from ...document.words import count_of
from ...widgets.boxes import row_of
from ...widgets.controls import push_button
from .form_parts import Verb, buttons
from .import_series import Turn


class ImportFoot(QWidget):
    """Import, or Open, and Cancel; while other files wait, Skip and Skip the Rest.

    Signals
    -------
    rest_skipped
        The person wants neither this file nor those that wait.
    """

    rest_skipped = Signal()

    def __init__(self, dialog: QDialog, name: str, tip: str, verb: Verb, into: QComboBox) -> None:
        super().__init__()
        self._dialog, self._title = dialog, dialog.windowTitle()
        self.box, self.ok = buttons(verb.value, name, tip, "cancelImport")
        into.currentTextChanged.connect(lambda where: self.ok.setText(verb.towards(where).value))
        self.box.rejected.connect(dialog.reject)
        self._cancel = self.box.button(QDialogButtonBox.StandardButton.Cancel)
        self._words, self._tip = self._cancel.text(), self._cancel.toolTip()
        self.rest = push_button("skipRest", "Skip the Rest", "")
        self.rest.clicked.connect(self.rest_skipped)
        self.rest.hide()
        row_of(self.rest, (self.box, 1), margins=0, parent=self)

    def show_turn(self, turn: Turn) -> None:
        """Say which file of how many this is, and offer to leave out what waits."""
        self._dialog.setWindowTitle(
            f"{self._title} ({turn.place} of {turn.count})" if turn.count > 1 else self._title
        )
        waits = turn.waiting > 0
        self._cancel.setText("Skip" if waits else self._words)
        self._cancel.setToolTip("Leave out this file and go on to the next (Esc)" if waits else self._tip)
        self.rest.setToolTip(f"Leave out this file and the {count_of(turn.waiting, 'file')} after it")
        self.rest.setVisible(waits)
