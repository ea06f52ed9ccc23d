"""The question what to do with changes that are not saved."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from .. import exchange
from ..document.model import Document
from ..document.paper import kind_of
from ..qt.labels import breakable
from ..session import Session
from ..storage.foreign import Foreign
from .file_names import short_name, title_of


def ask_about_changes(session: Session, foreign: Foreign | None, window: QWidget) -> int:
    """Ask what to do with changes that are not saved; return the button that answers.

    `foreign` is the file of another format that the document is saved to; with what that would not keep,
    Save As is offered, too.
    """
    lost = words_of_loss(foreign, session.committed) if foreign is not None else ""
    asked, told = _question_about(session, lost)
    question = QMessageBox(window)
    question.setObjectName("saveChanges")
    question.setWindowTitle("Curvebench")
    question.setTextFormat(Qt.TextFormat.PlainText)
    question.setIcon(QMessageBox.Icon.Question)
    question.setText(breakable(asked))
    question.setInformativeText(told)
    buttons = QMessageBox.StandardButton
    question.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    if foreign is not None and lost:
        question.addButton(buttons.SaveAll).setText("Save As…")
        question.button(buttons.Save).setText(f"Save in {short_name(foreign.path.name)}")
    question.setDefaultButton(buttons.Save)
    answer = question.exec()
    # Else every question ever asked would stay a part of the window.
    question.setParent(None)
    return answer


def words_of_loss(foreign: Foreign, document: Document) -> str:
    """Return what a file would not keep of a document, until it was written to all the same."""
    return "" if foreign.written else exchange.lasting.words_about_loss(document, foreign.path)


def _question_about(session: Session, lost: str) -> tuple[str, str]:
    """Return what is asked before a document goes that is not in its file, and why.

    `lost` is what the file of another format that it was opened from would not keep.
    """
    files, file = session.files, session.files.file
    if lost:
        return f"Save the changes to {short_name(title_of(session))}?", lost
    is_named = files.path is not None or files.foreign is not None or files.beginning.title
    name = short_name(title_of(session)) if is_named else f"the {kind_of(session.document).noun}"
    why = f"{file.change.value} " if file is not None and file.has_lost_document else ""
    if files.has_changes:
        return f"Save the changes to {name}?", f"{why}Without saving they are lost."
    return f"Save {name} as it is shown here?", f"{why}Without saving, what is shown here is lost."
