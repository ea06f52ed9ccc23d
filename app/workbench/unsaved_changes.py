"""The question what to do with changes that are not saved."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from ..qt.labels import breakable
from ..session import Session
from .file_names import short_name, title_of


def ask_about_changes(session: Session, window: QWidget) -> int:
    """Ask what to do with changes that are not saved; return the button that answers."""
    asked, told = _question_about(session)
    question = QMessageBox(window)
    question.setObjectName("saveChanges")
    question.setWindowTitle("Curvebench")
    question.setTextFormat(Qt.TextFormat.PlainText)
    question.setIcon(QMessageBox.Icon.Question)
    question.setText(breakable(asked))
    question.setInformativeText(told)
    buttons = QMessageBox.StandardButton
    question.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    question.setDefaultButton(buttons.Save)
    answer = question.exec()
    # Else every question ever asked would stay a part of the window.
    question.setParent(None)
    return answer


def _question_about(session: Session) -> tuple[str, str]:
    """Return what is asked before a document goes that is not in its file, and why."""
    files, file = session.files, session.files.file
    is_named = files.path is not None or files.beginning.title
    name = short_name(title_of(session)) if is_named else "the sketch"
    why = f"{file.change.value} " if file is not None and file.has_lost_document else ""
    if files.has_changes:
        return f"Save the changes to {name}?", f"{why}Without saving they are lost."
    return f"Save {name} as it is shown here?", f"{why}Without saving, what is shown here is lost."
