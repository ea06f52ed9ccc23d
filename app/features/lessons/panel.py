"""Panel of the lessons: the list, and one step of a lesson."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import (
    QCommandLinkButton,
    QFrame,
    QPushButton,
    QScrollArea,
    QStackedWidget,
    QTextBrowser,
    QWidget,
)

from ...qt.labels import Label, html_of
from ...view_model.analysis.goals import GoalResult
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import named, push_button
from ...widgets.frames import scroll_vertically
from .lesson import Lesson

_MARGIN = 10
_LEAST_WIDTH = 256
"""Width in pixels that no title in the list exceeds."""


class LessonPanel(QWidget):
    """Panel with the list of lessons, or with one step of a lesson.

    Signals
    -------
    lesson_wanted
        The person selects the lesson with this number.
    step_wanted
        The person goes to another step; −1 is the list, the number of steps the next lesson.
    restart_wanted
        The person starts the lesson again, with its original document.
    action_wanted
        The person follows a link that names this action.
    """

    lesson_wanted = Signal(int)
    step_wanted = Signal(int)
    restart_wanted = Signal()
    action_wanted = Signal(str)

    def __init__(self, lessons: Sequence[Lesson], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("lessonPanel")
        self.setMinimumWidth(_LEAST_WIDTH)
        self._step = 0
        self.gallery = self._make_gallery(lessons)
        self.text = self._make_text()
        self.goal = Label(name="lessonGoal", wordWrap=True, is_html=True)
        self.goal.setFrameShape(QFrame.Shape.StyledPanel)
        self.goal.setMargin(8)
        self.gallery_button = _button("lessonGallery", "All Lessons", "Show the list of lessons")
        self.again_button = _button(
            "lessonAgain", "Start Again", "Start this lesson again; Undo restores your work"
        )
        self.back_button = _button("lessonBack", "Back", "Go to the previous step")
        self.next_button = _button("lessonNext", "Next", "Go to the next step")
        self._title = Label(name="lessonTitle", wordWrap=True, is_html=True)
        self._position = Label(name="lessonPlace")
        self._pages = QStackedWidget()
        self._pages.addWidget(self.gallery)
        self._pages.addWidget(self._make_page())
        column_of(self._pages, margins=0, parent=self)
        self.gallery_button.clicked.connect(lambda: self.step_wanted.emit(-1))
        self.again_button.clicked.connect(self.restart_wanted)
        self.back_button.clicked.connect(lambda: self.step_wanted.emit(self._step - 1))
        self.next_button.clicked.connect(lambda: self.step_wanted.emit(self._step + 1))

    def _make_gallery(self, lessons: Sequence[Lesson]) -> QScrollArea:
        cards = QWidget()
        buttons = [self._card(number, lesson) for number, lesson in enumerate(lessons, start=1)]
        column_of(*buttons, 1, margins=4, spacing=0, parent=cards)
        gallery = scroll_vertically(QScrollArea(), "lessonList", "Lessons")
        # The cards take the keyboard focus, and show it.
        gallery.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        gallery.setWidget(cards)
        return gallery

    def _card(self, number: int, lesson: Lesson) -> QCommandLinkButton:
        card = QCommandLinkButton(f"{number}  {lesson.title}", lesson.summary)
        named(card, f"lesson{number}", f"Lesson {number}: {lesson.title}", "Start this lesson")
        # Without the green arrow of the style.
        card.setIcon(QIcon())
        card.clicked.connect(lambda: self.lesson_wanted.emit(number - 1))
        return card

    def _make_text(self) -> QTextBrowser:
        text = named(QTextBrowser(), "lessonText", "Text of this step")
        text.setFrameShape(QFrame.Shape.NoFrame)
        text.document().setDocumentMargin(_MARGIN)
        text.setOpenLinks(False)
        text.anchorClicked.connect(self._follow)
        return text

    def _make_page(self) -> QWidget:
        page = QWidget()
        top = row_of(self.gallery_button, self.again_button, 1)
        bottom = row_of((self.back_button, 1), self._position, (self.next_button, 1))
        column_of(top, self._title, (self.text, 1), self.goal, bottom, margins=_MARGIN, parent=page)
        return page

    def _follow(self, link: QUrl) -> None:
        if link.scheme() == "action":
            self.action_wanted.emit(link.path())

    # Rendering

    def show_gallery(self) -> None:
        """Show the list of lessons."""
        self._pages.setCurrentIndex(0)

    def show_step(self, lesson: Lesson, step: int, *, is_last: bool) -> None:
        """Show one step of a lesson; “Next” leads to the next lesson after the last step."""
        self._step = step
        self._pages.setCurrentIndex(1)
        self._title.setText(f"<b>{html_of(lesson.title)}</b>")
        self._position.setText(f"{step + 1} of {len(lesson.steps)}")
        self.text.setMarkdown(f"### {lesson.steps[step].title}\n\n{lesson.steps[step].text}")
        self.back_button.setEnabled(step > 0)
        at_end = step + 1 == len(lesson.steps)
        self.next_button.setText("Next Lesson" if at_end else "Next")
        self.next_button.setEnabled(not (at_end and is_last))
        self.show_result(None, reached=False)

    def show_result(self, result: GoalResult | None, *, reached: bool) -> None:
        """Show whether the goal of the step is met; hide the goal for None.

        A goal that was reached once stays ticked: later changes may lead away from it.
        """
        self.goal.setVisible(result is not None)
        if result is not None:
            sign = "✓ Reached" if reached else "○ Goal"
            self.goal.setText(f"<b>{sign}</b><br>{html_of(result.text)}")


def _button(name: str, text: str, tip: str) -> QPushButton:
    return push_button(name, text, tip, tip)
