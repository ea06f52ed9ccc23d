"""Manual: the pages of ``resources/manual`` in a window, with a list of pages and a search."""

from __future__ import annotations

from typing import NamedTuple

from PySide6.QtCore import QSize, QUrl
from PySide6.QtGui import QColor, QPalette, QTextCursor, QTextDocument
from PySide6.QtWidgets import QLineEdit, QListWidget, QTextBrowser, QTextEdit, QWidget

from ...storage.resources import resource
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import named, push_button
from ...widgets.frames import FittedDialog

_LIST_WIDTH, _MARGIN = 190, 12
_SIZE = QSize(860, 620)


class ManualPage(NamedTuple):
    """Page of the manual: the name of its file, its title, and its text in Markdown."""

    name: str
    title: str
    text: str

    def has(self, words: list[str]) -> bool:
        """Return whether all words are in the text."""
        text = self.text.casefold()
        return all(word in text for word in words)


def manual_pages() -> list[ManualPage]:
    """Return all pages, in the order of their numbers; the first line of each is its title."""
    texts = {path.name: path.read_text(encoding="utf-8") for path in sorted(resource("manual").glob("*.md"))}
    return [
        ManualPage(name, text.partition("\n")[0].removeprefix("# "), text) for name, text in texts.items()
    ]


class ManualWindow(FittedDialog):
    """The manual: pages at the left, the text of the current one at the right.

    The search field lists only the pages that have all words of a text, and marks these words.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__("manual", "Manual", parent)
        self._pages = manual_pages()
        self._listed = self._pages
        self._search = named(QLineEdit(), "manualSearch", "Search the manual", "Type words to find pages")
        self._search.setPlaceholderText("Search")
        self._search.setClearButtonEnabled(True)
        self._list = named(QListWidget(), "manualPages", "Pages of the manual")
        self._text = named(QTextBrowser(), "manualText", "Text of the page")
        self._text.setOpenLinks(False)
        self._text.document().setDocumentMargin(_MARGIN)
        self._text.setMinimumSize(200, 120)
        self._list.setFixedWidth(_LIST_WIDTH)
        self._search.setFixedWidth(_LIST_WIDTH)
        left = column_of(self._search, (self._list, 1))
        row_of(left, (self._text, 1), margins=(12, 12, 12, 0), parent=self.body)
        close = push_button("closeManual", "Close", "Close the manual (Esc)")
        close.clicked.connect(self.reject)
        foot = QWidget()
        row_of(1, close, margins=0, parent=foot)
        self.hold(foot, preferred=_SIZE)
        self._search.textEdited.connect(self._list_pages)
        self._list.currentRowChanged.connect(self._show_row)
        self._text.anchorClicked.connect(self._follow)
        self._list_pages("")

    def show_page(self, name: str) -> None:
        """Show the page of this file name; a search that hides it is cleared."""
        if name not in [page.name for page in self._listed]:
            self._search.clear()
            self._list_pages("")
        self._list.setCurrentRow([page.name for page in self._listed].index(name))

    def _list_pages(self, text: str) -> None:
        """List the pages with all words of a text, and show the first of them."""
        words = text.casefold().split()
        self._listed = [page for page in self._pages if page.has(words)]
        self._list.clear()
        self._list.addItems([page.title for page in self._listed])
        self._list.setCurrentRow(0)
        if not self._listed:
            self._text.setMarkdown("No page has all of these words.")

    def _show_row(self, row: int) -> None:
        if row >= 0:
            self._text.setMarkdown(self._listed[row].text)
            self._text.setExtraSelections(self._marks(self._search.text().split()))

    def _marks(self, words: list[str]) -> list[QTextEdit.ExtraSelection]:
        """Return the places of all words in the text, with a background."""
        marks = []
        for word in words:
            cursor = QTextCursor(self._text.document())
            while not (
                cursor := self._text.document().find(word, cursor, QTextDocument.FindFlag(0))
            ).isNull():
                mark = QTextEdit.ExtraSelection()
                mark.cursor = cursor
                mark.format.setBackground(_faint(self.palette().color(QPalette.ColorRole.Highlight)))
                marks.append(mark)
        return marks

    def _follow(self, link: QUrl) -> None:
        self.show_page(link.fileName())


def _faint(colour: QColor) -> QColor:
    colour.setAlphaF(0.3)
    return colour
