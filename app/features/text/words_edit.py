"""Lines to type into, whose letters keep the looks that they have in the text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, cast

from msgspec.structs import replace
from PySide6.QtCore import Signal
from PySide6.QtGui import (
    QFont,
    QInputMethodEvent,
    QTextBlock,
    QTextCharFormat,
    QTextCursor,
    QTextFormat,
)
from PySide6.QtWidgets import QPlainTextEdit, QWidget

from ...document.content import TextRun
from ...qt.overrides import Guarded
from ...widgets.controls import named
from .wording import BOLD, Letters, Look, Typed

_LOOK = QTextFormat.Property.UserProperty.value
"""Property of letters that tells their look: its place among those there are."""


class _Part(NamedTuple):
    """Letters of one look, from a position up to another one."""

    start: int
    end: int
    words: str
    look: int


class WordsEdit(Guarded, QPlainTextEdit):
    """Lines to type into, whose letters are seen elsewhere.

    What is typed between letters looks as the one before. Undo takes looks back, too.

    Signals
    -------
    chosen_changed
        Other letters are chosen.

    Attributes
    ----------
    preedit
        What is composed at the caret and not yet taken: an accent that waits for its letter, a word in kana.
    """

    chosen_changed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        named(self, "textWords", "Words", "Type; Escape ends the text")
        self.setTabChangesFocus(True)
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self._looks = [Look(TextRun(""), 0)]
        self.preedit, self._behind = "", 0
        self.selectionChanged.connect(self.chosen_changed)

    # What is composed

    @property
    def caret_place(self) -> int:
        """The place of the caret among the letters, what is composed among them."""
        return self.textCursor().position() + self._behind

    def inputMethodEvent(self, event: QInputMethodEvent) -> None:
        before, kinds = self.preedit, QInputMethodEvent.AttributeType
        self.preedit = event.preeditString()
        marks = [each.start for each in event.attributes() if each.type == kinds.Cursor]
        self._behind = marks[0] if marks else _count(self.preedit)
        super().inputMethodEvent(event)
        if self.preedit != before:
            self.textChanged.emit()

    @property
    def text(self) -> str:
        """All letters, what is composed among them."""
        return "\n".join("".join(words for words, _ in line) for line in self.typed)

    def _composed(self, line: tuple[Letters, ...], column: int) -> tuple[Letters, ...]:
        """Return a line with what is composed behind so many letters, looking as the one before."""
        found, is_in = list[Letters](), False
        for letters in line:
            words, many = letters.words, _count(letters.words)
            if not is_in and column <= many:
                head, tail = _cut(words, column)
                words, is_in = head + self.preedit + tail, True
            column -= many
            found.append(letters._replace(words=words))
        return tuple(found)

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
        lines = [
            tuple(Letters(each.words, self._look_at(each.look)) for each in _parts_of(block))
            or (Letters("", self._look_at(_look_in(block.charFormat()))),)
            for block in self._blocks()
        ]
        if self.preedit:
            cursor = self.textCursor()
            number = cursor.blockNumber()
            lines[number] = self._composed(lines[number], cursor.positionInBlock())
        return tuple(lines)

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

    def kern(self, right: float, down: float) -> None:
        """Move what begins at the caret, or with the chosen letters, by lengths of the text."""
        cursor = self.textCursor()
        cursor.setPosition(cursor.selectionStart())
        start = cursor.position()
        if cursor.atBlockEnd():
            return
        cursor.movePosition(QTextCursor.MoveOperation.NextCharacter)
        look = self._look_at(_look_in(cursor.charFormat()))
        run = look.run
        if any(self._look_at(each.look)[1:] == look[1:] for each in self._parts() if each.start < start):
            # Those before it were moved by that.
            run = replace(run, right=0.0, down=0.0)
        run = replace(run, right=run.right + right, down=run.down + down)
        kerned = 1 + max(each.kerned for each in self._looks)
        self._set(_Part(start, cursor.position(), "", 0), Look(run, look.source, kerned))

    def take_back(self, *, again: bool = False) -> None:
        """Undo or redo; where the letters stay the same, those that are chosen stay so."""
        cursor, words = self.textCursor(), self.toPlainText()
        anchor, place = cursor.anchor(), cursor.position()
        (self.redo if again else self.undo)()
        if self.toPlainText() == words:
            cursor = self.textCursor()
            cursor.setPosition(anchor)
            cursor.setPosition(place, QTextCursor.MoveMode.KeepAnchor)
            self.setTextCursor(cursor)
        self.chosen_changed.emit()

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
        made.setFontUnderline(look.run.underline)
        made.setFontStrikeOut(look.run.strike)
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


def _count(words: str) -> int:
    """Return how many letters there are as Qt counts, in words of 16 bits."""
    return len(words.encode("utf-16-le", "surrogatepass")) // 2


def _cut(words: str, at: int) -> tuple[str, str]:
    """Return words before and behind so many letters."""
    found = words.encode("utf-16-le", "surrogatepass")
    head, tail = (each.decode("utf-16-le", "surrogatepass") for each in (found[: 2 * at], found[2 * at :]))
    return head, tail


def _parts_of(block: QTextBlock) -> Iterator[_Part]:
    for each in cast(Iterable[QTextBlock.iterator], block):
        fragment = each.fragment()
        start, look = fragment.position(), _look_in(fragment.charFormat())
        yield _Part(start, start + fragment.length(), fragment.text(), look)


def _look_in(found: QTextCharFormat) -> int:
    look = found.property(_LOOK)
    # Letters that came with none, into an empty line, look as the first of all.
    return look if isinstance(look, int) else 0
