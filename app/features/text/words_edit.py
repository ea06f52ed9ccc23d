"""Lines to type into, whose letters keep the looks that they have in the text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, cast

from msgspec.structs import replace
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QKeyEvent, QTextBlock, QTextCharFormat, QTextCursor, QTextFormat
from PySide6.QtWidgets import QPlainTextEdit

from ...document.content import TextRun
from ...qt.keys import ENTER
from ...qt.overrides import Guarded
from ...widgets.controls import named
from .wording import BOLD, Letters, Look, Typed

_MOST_LINES = 4
_LOOK = QTextFormat.Property.UserProperty.value
"""Property of letters that tells their look: its place among those there are."""


class _Part(NamedTuple):
    """Letters of one look, from a position up to another one."""

    start: int
    end: int
    words: str
    look: int


class WordsEdit(Guarded, QPlainTextEdit):
    """Lines to type into, as high as they are many; Shift+Enter or Ctrl+Enter begins another.

    What is typed between letters looks as the one before. Undo takes looks back, too.

    Signals
    -------
    chosen_changed
        Other letters are chosen.
    """

    chosen_changed = Signal()

    def __init__(self) -> None:
        super().__init__()
        named(self, "textWords", "Words", "Enter ends the text, Shift+Enter begins another line")
        self.setPlaceholderText("Type; Enter ends the text")
        self.setTabChangesFocus(True)
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._looks = [Look(TextRun(""), 0)]
        self.selectionChanged.connect(self.chosen_changed)
        self.fit_height()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() not in ENTER:
            super().keyPressEvent(event)
        elif event.modifiers() & (Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.ControlModifier):
            self.insertPlainText("\n")
        else:
            # It belongs to the frame.
            event.ignore()

    def fit_height(self) -> None:
        """Be as high as the lines are many, up to some."""
        lines, policy = self.blockCount(), Qt.ScrollBarPolicy
        # One with little room for a single line would show its bar there.
        self.setVerticalScrollBarPolicy(
            policy.ScrollBarAlwaysOff if lines <= _MOST_LINES else policy.ScrollBarAsNeeded
        )
        lines = min(lines, _MOST_LINES)
        around = 2 * (self.frameWidth() + round(self.document().documentMargin()))
        self.setFixedHeight(lines * self.fontMetrics().lineSpacing() + around)

    # Looks

    def begin_with(self, typed: Typed) -> None:
        """Have lines of letters to begin with."""
        self._looks = list(dict.fromkeys(each.look for line in typed for each in line))
        self.document().setUndoRedoEnabled(False)
        self.clear()
        cursor = QTextCursor(self.document())
        for number, line in enumerate(typed):
            if number:
                cursor.insertBlock()
            for letters in line:
                cursor.insertText(letters.words, self._format(letters.look))
        self.document().setUndoRedoEnabled(True)

    def begin_in(self, run: TextRun) -> None:
        """Have all letters look as a run, and those that are typed."""
        self._looks = [Look(run, 0)]
        for part in self._parts():
            self._set(part, self._looks[0])

    @property
    def typed(self) -> Typed:
        """The lines of letters."""
        return tuple(
            tuple(Letters(each.words, self._look_at(each.look)) for each in _parts_of(block))
            for block in self._blocks()
        )

    @property
    def first(self) -> TextRun:
        """How the first letter looks, and what is typed before there are any."""
        return self._look_at(next((each.look for each in self._parts()), 0)).run

    @property
    def run(self) -> TextRun:
        """How the first of the chosen letters looks; where none are, the first of all."""
        return self.runs[0]

    @property
    def runs(self) -> list[TextRun]:
        """How the chosen letters look, or all where none are, or what is typed first."""
        places = dict.fromkeys(each.look for each in self._parts(chosen=True))
        return [self._look_at(each).run for each in places] or [self.first]

    def restyle(self, change: Callable[[TextRun], TextRun], *, chosen: bool = True) -> bool:
        """Have the chosen letters, or all where none are, look otherwise; return whether there are any."""
        parts = list(self._parts(chosen=chosen))
        if not parts:
            self._looks[0] = self._looks[0]._replace(run=change(self._looks[0].run))
            return False
        cursor = QTextCursor(self.document())
        cursor.beginEditBlock()
        for part in parts:
            look = self._look_at(part.look)
            self._set(part, look._replace(run=change(look.run)))
        cursor.endEditBlock()
        return True

    def _set(self, part: _Part, look: Look) -> None:
        cursor = QTextCursor(self.document())
        cursor.setPosition(part.start)
        cursor.setPosition(part.end, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(self._format(look))

    def _format(self, look: Look) -> QTextCharFormat:
        if look not in self._looks:
            self._looks.append(look)
        made = QTextCharFormat()
        made.setProperty(_LOOK, self._looks.index(look))
        if look.run.weight >= BOLD:
            made.setFontWeight(QFont.Weight.Bold)
        made.setFontItalic(look.run.italic)
        return made

    def _look_at(self, place: int) -> Look:
        return self._looks[place if place < len(self._looks) else 0]

    def _blocks(self) -> Iterator[QTextBlock]:
        block = self.document().begin()
        while block.isValid():
            yield block
            block = block.next()

    def _parts(self, *, chosen: bool = False) -> Iterator[_Part]:
        """Yield the letters of one look after those of another; the chosen ones alone, if any are."""
        cursor = self.textCursor()
        is_part = chosen and cursor.hasSelection()
        for block in self._blocks():
            for part in _parts_of(block):
                if not is_part:
                    yield part
                    continue
                start, end = max(part.start, cursor.selectionStart()), min(part.end, cursor.selectionEnd())
                if start < end:
                    yield part._replace(start=start, end=end)


def _parts_of(block: QTextBlock) -> Iterator[_Part]:
    for each in cast(Iterable[QTextBlock.iterator], block):
        fragment = each.fragment()
        start, look = fragment.position(), fragment.charFormat().property(_LOOK)
        # Letters that came with none, into an empty line, look as the first of all.
        yield _Part(start, start + fragment.length(), fragment.text(), look if look is not None else 0)


def grown(run: TextRun, by: float) -> TextRun:
    """Return a run of another size, with its ways and spaces."""
    return replace(
        run, size=run.size * by, right=run.right * by, down=run.down * by, spacing=run.spacing * by
    )
