"""The gallery of lessons, and the lesson that is being taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import (
    QCommandLinkButton,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QStackedWidget,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from app.features.lessons.lesson import Lesson
from app.qt.labels import Label, html_of
from app.view_model.goals import GoalResult

_MARGIN = 10
_LEAST_WIDTH = 256
"""No title of the gallery is cut off."""
Named = TypeVar("Named", bound=QWidget)


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
        self.goal = _named(Label(wordWrap=True, is_html=True), "lessonGoal")
        self.goal.setFrameShape(QFrame.Shape.StyledPanel)
        self.goal.setMargin(8)
        self.gallery_button = _button("lessonGallery", "All Lessons", "Back to the list of lessons")
        self.again_button = _button(
            "lessonAgain", "Begin Again", "Begin this lesson again; Undo goes back to what you have now"
        )
        self.back_button = _button("lessonBack", "Back", "The step before")
        self.next_button = _button("lessonNext", "Next", "The next step")
        self._title = _named(Label(wordWrap=True, is_html=True), "lessonTitle")
        self._place = _named(Label(), "lessonPlace")
        self._pages = QStackedWidget()
        self._pages.addWidget(self.gallery)
        self._pages.addWidget(self._make_page())
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._pages)
        self.gallery_button.clicked.connect(lambda: self.step_chosen.emit(-1))
        self.again_button.clicked.connect(self.again_wanted)
        self.back_button.clicked.connect(lambda: self.step_chosen.emit(self._step - 1))
        self.next_button.clicked.connect(lambda: self.step_chosen.emit(self._step + 1))

    def _make_gallery(self, lessons: Sequence[Lesson]) -> QScrollArea:
        cards = QWidget()
        column = QVBoxLayout(cards)
        column.setContentsMargins(4, 4, 4, 4)
        column.setSpacing(0)
        for number, lesson in enumerate(lessons, start=1):
            card = _card(number, lesson)
            card.clicked.connect(lambda _checked=False, place=number - 1: self.lesson_chosen.emit(place))
            column.addWidget(card)
        column.addStretch(1)
        gallery = QScrollArea()
        gallery.setObjectName("lessonList")
        gallery.setAccessibleName("Lessons")
        gallery.setFrameShape(QFrame.Shape.NoFrame)
        gallery.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        gallery.setWidgetResizable(True)
        # The keyboard goes to its cards, which show that they have the focus.
        gallery.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        gallery.setWidget(cards)
        return gallery

    def _make_text(self) -> QTextBrowser:
        text = _named(QTextBrowser(), "lessonText")
        text.setAccessibleName("What to do in this step")
        text.setFrameShape(QFrame.Shape.NoFrame)
        text.document().setDocumentMargin(_MARGIN)
        text.setOpenLinks(False)
        text.anchorClicked.connect(self._follow)
        return text

    def _make_page(self) -> QWidget:
        page = QWidget()
        top, bottom = QHBoxLayout(), QHBoxLayout()
        top.addWidget(self.gallery_button)
        top.addWidget(self.again_button)
        top.addStretch(1)
        bottom.addWidget(self.back_button, 1)
        bottom.addWidget(self._place)
        bottom.addWidget(self.next_button, 1)
        layout = QVBoxLayout(page)
        layout.setContentsMargins(_MARGIN, _MARGIN, _MARGIN, _MARGIN)
        layout.addLayout(top)
        layout.addWidget(self._title)
        layout.addWidget(self.text, 1)
        layout.addWidget(self.goal)
        layout.addLayout(bottom)
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
        self.show_standing(None, reached=False)

    def show_standing(self, standing: GoalResult | None, *, reached: bool) -> None:
        """Show whether the goal of the step is met; None where the step has none.

        A goal that was reached once stays ticked: what comes after may lead away from it.
        """
        self.goal.setVisible(standing is not None)
        if standing is not None:
            sign = "✓ Reached" if reached else "○ Goal"
            self.goal.setText(f"<b>{sign}</b><br>{html_of(standing.text)}")


def _card(number: int, lesson: Lesson) -> QCommandLinkButton:
    card = QCommandLinkButton(f"{number}  {lesson.title}", lesson.summary)
    card.setObjectName(f"lesson{number}")
    card.setAccessibleName(f"Lesson {number}: {lesson.title}")
    card.setToolTip("Begin this lesson")
    # The style's green arrow is a colour with no meaning here.
    card.setIcon(QIcon())
    return card


def _named(widget: Named, name: str) -> Named:
    widget.setObjectName(name)
    return widget


def _button(name: str, text: str, tip: str) -> QPushButton:
    button = QPushButton(text)
    button.setObjectName(name)
    button.setToolTip(tip)
    button.setAccessibleName(tip)
    return button
