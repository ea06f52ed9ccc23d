"""The gallery of lessons, and the lesson that is being taken."""

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
from .lesson import Lesson

_MARGIN = 10
_LEAST_WIDTH = 256
"""No title of the gallery is cut off."""


class LessonPanel(QWidget):
    """Shows the gallery, or one step of a lesson.

    Signals
    -------
    lesson_chosen
        The lesson of this number is wanted.
    step_chosen
        Another step of the lesson is wanted; −1 is the gallery, the number of steps the next lesson.
    again_wanted
        The lesson is to begin again, with its document as it comes.
    action_wanted
        A link in the text names this action.
    """

    lesson_chosen = Signal(int)
    step_chosen = Signal(int)
    again_wanted = Signal()
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
        self.gallery_button = _button("lessonGallery", "All Lessons", "Back to the list of lessons")
        self.again_button = _button(
            "lessonAgain", "Begin Again", "Begin this lesson again; Undo goes back to what you have now"
        )
        self.back_button = _button("lessonBack", "Back", "The step before")
        self.next_button = _button("lessonNext", "Next", "The next step")
        self._title = Label(name="lessonTitle", wordWrap=True, is_html=True)
        self._place = Label(name="lessonPlace")
        self._pages = QStackedWidget()
        self._pages.addWidget(self.gallery)
        self._pages.addWidget(self._make_page())
        column_of(self._pages, margins=0, parent=self)
        self.gallery_button.clicked.connect(lambda: self.step_chosen.emit(-1))
        self.again_button.clicked.connect(self.again_wanted)
        self.back_button.clicked.connect(lambda: self.step_chosen.emit(self._step - 1))
        self.next_button.clicked.connect(lambda: self.step_chosen.emit(self._step + 1))

    def _make_gallery(self, lessons: Sequence[Lesson]) -> QScrollArea:
        cards = QWidget()
        shown = [self._card(number, lesson) for number, lesson in enumerate(lessons, start=1)]
        column_of(*shown, 1, margins=4, spacing=0, parent=cards)
        gallery = named(QScrollArea(), "lessonList", "Lessons")
        gallery.setFrameShape(QFrame.Shape.NoFrame)
        gallery.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        gallery.setWidgetResizable(True)
        # The keyboard goes to its cards, which show that they have the focus.
        gallery.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        gallery.setWidget(cards)
        return gallery

    def _card(self, number: int, lesson: Lesson) -> QCommandLinkButton:
        card = QCommandLinkButton(f"{number}  {lesson.title}", lesson.summary)
        named(card, f"lesson{number}", f"Lesson {number}: {lesson.title}", "Begin this lesson")
        # The style's green arrow is a colour with no meaning here.
        card.setIcon(QIcon())
        card.clicked.connect(lambda: self.lesson_chosen.emit(number - 1))
        return card

    def _make_text(self) -> QTextBrowser:
        text = named(QTextBrowser(), "lessonText", "What to do in this step")
        text.setFrameShape(QFrame.Shape.NoFrame)
        text.document().setDocumentMargin(_MARGIN)
        text.setOpenLinks(False)
        text.anchorClicked.connect(self._follow)
        return text

    def _make_page(self) -> QWidget:
        page = QWidget()
        top = row_of(self.gallery_button, self.again_button, 1)
        bottom = row_of((self.back_button, 1), self._place, (self.next_button, 1))
        column_of(top, self._title, (self.text, 1), self.goal, bottom, margins=_MARGIN, parent=page)
        return page

    def _follow(self, link: QUrl) -> None:
        if link.scheme() == "action":
            self.action_wanted.emit(link.path())

    # Rendering

    def show_gallery(self) -> None:
        """Show all lessons."""
        self._pages.setCurrentIndex(0)

    def show_step(self, lesson: Lesson, step: int, *, is_last: bool) -> None:
        """Show one step of a lesson; after its end comes the next lesson, unless it is the last one."""
        self._step = step
        self._pages.setCurrentIndex(1)
        self._title.setText(f"<b>{html_of(lesson.title)}</b>")
        self._place.setText(f"{step + 1} of {len(lesson.steps)}")
        self.text.setMarkdown(f"### {lesson.steps[step].title}\n\n{lesson.steps[step].text}")
        self.back_button.setEnabled(step > 0)
        at_end = step + 1 == len(lesson.steps)
        self.next_button.setText("Next Lesson" if at_end else "Next")
        self.next_button.setEnabled(not (at_end and is_last))
        self.show_result(None, reached=False)

    def show_result(self, result: GoalResult | None, *, reached: bool) -> None:
        """Show whether the goal of the step is met; None where the step has none.

        A goal that was reached once stays ticked: what comes after may lead away from it.
        """
        self.goal.setVisible(result is not None)
        if result is not None:
            sign = "✓ Reached" if reached else "○ Goal"
            self.goal.setText(f"<b>{sign}</b><br>{html_of(result.text)}")


def _button(name: str, text: str, tip: str) -> QPushButton:
    return push_button(name, text, tip, tip)
