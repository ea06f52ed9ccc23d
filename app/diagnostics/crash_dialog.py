"""Crash dialog: the report of an error inside the program."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import (
    QApplication,
    QDialogButtonBox,
    QPlainTextEdit,
    QPushButton,
    QWidget,
)

from ..appearance.theme import theme_of
from ..qt.labels import Label
from ..widgets.boxes import column_of
from ..widgets.controls import named
from ..widgets.frames import FittedDialog

_SAFE = "Your work is safe: a backup has just been written."
_NOT_SAFE = "A backup could not be written. Save your work under another name now."


class CrashDialog(FittedDialog):
    """Dialog that an error occurred and whether the work is safe, with a report to copy.

    After the dialog is closed, the program continues.

    Signals
    -------
    quit_asked
        The person wants to save the work and quit.
    """

    quit_asked = Signal()

    def __init__(self, parent: QWidget | None, report: str, *, is_safe: bool) -> None:
        super().__init__("crashDialog", "Curvebench", parent)
        # Application modal, to be above any other open dialog.
        self.setWindowModality(Qt.WindowModality.ApplicationModal)
        self._report = QPlainTextEdit(report)
        tip = "Send this report to the developers; it contains no names of files or folders"
        named(self._report, "crashReport", "Report", tip)
        self._report.setReadOnly(True)
        self._report.setTabChangesFocus(True)
        self._report.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._report.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self._report.setMinimumHeight(150)
        safety = Label(f"{_SAFE if is_safe else _NOT_SAFE} You can continue working.", wordWrap=True)
        hint = Label(
            "This report helps to fix the error. It contains no names of files or folders.", wordWrap=True
        )
        hint.setStyleSheet(f"color: {theme_of(QApplication.palette()).muted.name()}")
        parts = (self._title(), safety, hint, (self._report, 1))
        column_of(*parts, margins=(20, 18, 20, 0), spacing=10, parent=self.body)
        self.hold(self._buttons(), preferred=QSize(560, 0))

    def _title(self) -> Label:
        title = Label("Something went wrong in Curvebench.", name="crashTitle")
        font = title.font()
        font.setBold(True)
        font.setPointSizeF(font.pointSizeF() * 1.15)
        title.setFont(font)
        return title

    def _buttons(self) -> QDialogButtonBox:
        box = QDialogButtonBox()
        roles = QDialogButtonBox.ButtonRole
        self._copy = self._button("copyReport", "Copy Report", "Copy the report to the clipboard")
        self._copy.clicked.connect(self._copy_report)
        box.addButton(self._copy, roles.ActionRole)
        quit_button = self._button("saveAndQuit", "Save and Quit", "Save your work and quit Curvebench")
        box.addButton(quit_button, roles.DestructiveRole)
        go_on = self._button("goOn", "Continue", "Close this dialog and continue working")
        box.addButton(go_on, roles.AcceptRole)
        go_on.setDefault(True)
        quit_button.clicked.connect(self._save_and_quit)
        go_on.clicked.connect(self.accept)
        return box

    def _button(self, name: str, text: str, tip: str) -> QPushButton:
        return named(QPushButton(text, self), name, tip, tip)

    def _save_and_quit(self) -> None:
        self.accept()
        self.quit_asked.emit()

    def _copy_report(self) -> None:
        QGuiApplication.clipboard().setText(self._report.toPlainText())
        self._copy.setText("Copied")
