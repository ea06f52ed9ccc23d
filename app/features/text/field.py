"""The field on the canvas into which a text is typed, with its font and its size."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial

from msgspec.structs import replace
from PySide6.QtCore import QEvent, QObject, QRect, QSignalBlocker, QStringListModel, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication, QKeyEvent
from PySide6.QtWidgets import QApplication, QFontComboBox, QToolButton, QWidget

from ...appearance.theme import Theme
from ...document.content import TextRun
from ...document.text import Setting
from ...document.transforms import decimal_sum
from ...qt.glyphs import Face
from ...qt.keys import ENTER, ClaimsKeys
from ...qt.labels import Label
from ...qt.overrides import Guarded
from ...widgets.boxes import column_of, row_of
from ...widgets.choice_style import choice_style
from ...widgets.controls import named
from ...widgets.field_edit import NumberEdit
from ...widgets.length_text import read_length
from ...widgets.overlay_frame import OverlayFrame
from ...widgets.tool_buttons import tool_button
from ...workbench.typed_letters import TypedLetters
from .setting_row import SettingRow
from .wording import BOLD, WEIGHTS, Typed
from .words_edit import WordsEdit, grown

_WIDTH, _FONT_WIDTH = 360, 140
_MAKER = re.compile(r"\s*\[[^\[\]]*\]$")
_LONGEST_SIZE = "00000.000"
_LEAST = 1e-9
_GAP = 10
"""Pixels between the field and the text."""


def plain_family(family: str) -> str:
    """Return the name of a family without that of its maker, which Qt adds where there are several."""
    return _MAKER.sub("", family)


class FontBox(Guarded, QFontComboBox):
    """Fonts with outlines: of the list, while it is open, the one pointed at counts.

    Signals
    -------
    pointed_at
        Another one is to be seen; none any more where that is empty.
    picked
        One is chosen.
    """

    pointed_at = Signal(str)
    picked = Signal(str)

    def __init__(self, family: str) -> None:
        super().__init__()
        tip = "Font of the text; point at one in the list to see the text in it"
        named(self, "textFont", "Font", tip)
        # Those made of pixels have none.
        self.setFontFilters(QFontComboBox.FontFilter.ScalableFonts)
        self._pointed_at = ""
        self.take(family)
        QGuiApplication.instance().fontDatabaseChanged.connect(self._name_each_once)  # type: ignore[union-attr]
        self.textHighlighted.connect(self._point_at)
        self.activated.connect(self._pick)
        # Not told of in other ways: Escape puts the list away.
        self.view().installEventFilter(self)

    @property
    def family(self) -> str:
        """Family of the font that counts."""
        return self._pointed_at or plain_family(self.currentFont().family())

    def take(self, family: str) -> None:
        """Have another one count."""
        self.setCurrentFont(QFont(plain_family(family)))
        self._name_each_once()
        self._pointed_at = ""
        if (line := self.lineEdit()) is not None:
            # Of a long name the beginning is seen.
            line.home(False)

    def _name_each_once(self) -> None:
        """List a family that several makers have once, by its plain name."""
        fonts, shown = self.model(), self.currentText()
        assert isinstance(fonts, QStringListModel)
        names = fonts.stringList()
        plain = list(dict.fromkeys(map(plain_family, names)))
        if plain != names:
            with QSignalBlocker(self):
                fonts.setStringList(plain)
                self.setCurrentIndex(self.findText(plain_family(shown)))

    def _point_at(self, family: str) -> None:
        family = plain_family(family)
        if family != self._pointed_at:
            self._pointed_at = family
            self.pointed_at.emit(family)

    def _pick(self) -> None:
        self._point_at("")
        self.picked.emit(plain_family(self.currentFont().family()))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Hide:
            self._point_at("")
        return super().eventFilter(watched, event)


class TextField(ClaimsKeys, OverlayFrame):
    """A small frame beside a text on the canvas, in which the text is typed.

    Attributes
    ----------
    words
        The lines that are typed into.
    font_box, bold, italic, size_edit, setting_row
        The widgets of font and size, and of how letters stand to each other.
    text_size
        What an em is long.

    Signals
    -------
    changed
        Another text, font or size was typed or chosen.
    entered
        It is to be made.
    given_up
        It is not: Escape.
    left
        The person has gone on to something else in the window.
    """

    changed = Signal()
    entered = Signal()
    given_up = Signal()
    left = Signal()

    def __init__(self, below: QWidget, face: Face, letters: TypedLetters) -> None:
        super().__init__("textField", below)
        self._letters = letters
        self.setAccessibleName("Text")
        self.text_size, self._unit = 1.0, ""
        self._area: Callable[[], QRect] = QRect
        # How long a unit of the text is, and whether its letters may differ.
        self._scale, self._has_parts = 1.0, False
        self._is_trying = False
        self.words = WordsEdit()
        self.words.textChanged.connect(self._follow_words)
        self.words.chosen_changed.connect(self._show_chosen)
        self.words.chosen_changed.connect(letters.changed)
        self.changed.connect(letters.changed)
        self.font_box = FontBox(face.family)
        self.font_box.setMinimumWidth(_FONT_WIDTH)
        self.font_box.pointed_at.connect(self._look_at_font)
        self.font_box.picked.connect(self._take_font)
        self.bold = self._letter("textBold", "B", "Bold", face.bold)
        self.italic = self._letter("textItalic", "I", "Italic", face.italic)
        self.bold.clicked.connect(lambda is_on: self._set(weight=WEIGHTS[is_on]))
        self.italic.clicked.connect(lambda is_on: self._set(italic=is_on))
        self._make_size_edit()
        self.setting_row = SettingRow()
        self.setting_row.changed.connect(self.changed)
        self.setting_row.refused.connect(self.remark)
        self._suffix, self._remark = Label(), Label(name="textRemark", wordWrap=True)
        row = row_of(self.font_box, self.bold, self.italic, self.size_edit, self._suffix, spacing=6)
        column_of(
            self.words, row, self.setting_row, self._remark, margins=(8, 8, 8, 8), spacing=6, parent=self
        )
        self.hide()
        self.follow_theme()

    def _make_size_edit(self) -> None:
        tip = "Size of the text, the length of an em: a number or an expression, with a unit if you like"
        self.size_edit = NumberEdit("textSize", "Size", tip, self._read_size, _stepped)
        self.size_edit.setFixedWidth(self.fontMetrics().horizontalAdvance(_LONGEST_SIZE))
        self.size_edit.entered.connect(self._take_size)
        self.size_edit.stepped.connect(self._take_size)
        self.size_edit.refused.connect(self.remark)
        self.size_edit.left.connect(lambda: self.remark(""))

    def _letter(self, name: str, letter: str, title: str, is_on: bool) -> QToolButton:
        tip = f"{title} letters (Ctrl+{letter}): those that are chosen, else all"
        button = tool_button(name, title, tip, text=letter)
        font = button.font()
        font.setBold(letter == "B")
        font.setItalic(letter == "I")
        button.setFont(font)
        button.setCheckable(True)
        button.setChecked(is_on)
        # Else a click on it would give the focus to the canvas.
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        return button

    # What is asked for

    @property
    def text(self) -> str:
        """The text."""
        return self.words.toPlainText()

    @property
    def typed(self) -> Typed:
        """Its letters, and how they look."""
        return self.words.typed

    @property
    def face(self) -> Face:
        """The font that is shown."""
        return Face(self.font_box.family, self.bold.isChecked(), self.italic.isChecked())

    @property
    def setting(self) -> Setting:
        """How the letters stand to each other."""
        return self.setting_row.setting

    def set_setting(self, setting: Setting) -> None:
        """Have a setting to begin with."""
        self.setting_row.show_setting(setting)

    def remark(self, text: str) -> None:
        """Say what is to be said of the text; nothing where that is empty."""
        self._remark.setText(f"⚠ {text}" if text else "")
        self._remark.setVisible(bool(text))
        self.place()

    # Opened and closed

    def begin_with(self, text: str, face: Face) -> None:
        """Have a text all of whose letters are in one font to begin with."""
        self._has_parts = False
        self.words.setPlainText(text)
        self._show_face(face)

    def begin_new(self, size: float, *, has_parts: bool) -> None:
        """Have a text of a size to begin with, in the font of the last one, or words that are there."""
        self._scale, self._has_parts = 1.0, has_parts
        face = self.face
        run = TextRun("", (face.family,), size, WEIGHTS[face.bold], face.italic)
        if has_parts and self.text:
            self.words.restyle(partial(grown, by=size / self.words.first.size), chosen=False)
        else:
            self.words.begin_in(run)

    def begin_again(self, typed: Typed, scale: float, face: Face) -> None:
        """Have the letters of a text to begin with, a unit of which is so long."""
        self._scale, self._has_parts = scale, True
        self.words.begin_with(typed)
        self._show_face(face)

    def _show_face(self, face: Face) -> None:
        self.font_box.take(face.family)
        self.bold.setChecked(face.bold)
        self.italic.setChecked(face.italic)

    def open_beside(self, area: Callable[[], QRect], size: float, unit: str) -> None:
        """Ask for a text of a size, beside the area on the canvas that it takes."""
        self._area, self._unit = area, unit
        self._show_size(size)
        self._suffix.setText(unit)
        self._suffix.setVisible(bool(unit))
        self.remark("")
        self.show()
        self.raise_()
        self.words.setFocus(Qt.FocusReason.OtherFocusReason)
        self.words.selectAll()
        _application().focusChanged.connect(self._follow_focus)

    def close_field(self, *, keeps_words: bool = False) -> None:
        """Put it away; words that are kept are there when it is opened again."""
        _application().focusChanged.disconnect(self._follow_focus)
        self.hide()
        # What was only looked at is not there when it is opened again.
        self._end_trial()
        if not keeps_words:
            self.words.clear()

    def _follow_focus(self, _before: QWidget | None, now: QWidget | None) -> None:
        # Without any another window has it; a menu, or the list of fonts, only borrows it.
        if now is None or now.window().windowType() is Qt.WindowType.Popup:
            return
        if now is not self and not self.isAncestorOf(now) and not self._letters.has_tool(now):
            self.left.emit()

    def claims(self, event: QKeyEvent) -> bool:
        return event.key() in (*ENTER, Qt.Key.Key_Escape) or self._button_of(event) is not None

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if (button := self._button_of(event)) is not None:
            button.click()
        elif event.key() == Qt.Key.Key_Escape:
            self.given_up.emit()
        elif event.key() not in ENTER:
            super().keyPressEvent(event)
        elif self.words.hasFocus():
            self.entered.emit()
        elif not any(edit.isModified() for edit in (self.size_edit, *self.setting_row.edits.values())):
            # What was typed beside them was taken; one that cannot be used is mended first.
            self.words.setFocus(Qt.FocusReason.OtherFocusReason)

    def _button_of(self, event: QKeyEvent) -> QToolButton | None:
        is_control = event.modifiers() == Qt.KeyboardModifier.ControlModifier
        buttons = {Qt.Key.Key_B: self.bold, Qt.Key.Key_I: self.italic}
        return buttons.get(Qt.Key(event.key())) if is_control else None

    # Changes

    def _set(self, **fields: object) -> None:
        self.restyle(lambda run: replace(run, **fields))

    def restyle(self, change: Callable[[TextRun], TextRun]) -> None:
        """Have the chosen letters, or all where none are, look otherwise."""
        self._end_trial()
        self.words.restyle(change, chosen=self._has_parts)
        self.changed.emit()

    def _look_at_font(self, family: str) -> None:
        self.look_at((lambda run: replace(run, font=(family,))) if family else None)

    def _end_trial(self) -> None:
        if self._is_trying:
            self._is_trying = False
            self.words.document().undo()

    def look_at(self, change: Callable[[TextRun], TextRun] | None) -> None:
        """Show how the chosen letters, or all where none are, would look, until another change or none."""
        self._end_trial()
        if change is not None and self.text:
            self._is_trying = True
            self.words.restyle(change, chosen=self._has_parts)
        else:
            self.changed.emit()

    def _take_font(self, family: str) -> None:
        self._set(font=(family,))

    def _show_chosen(self) -> None:
        """Show font and size of the letters that are chosen."""
        if not self._has_parts or self.isHidden():
            return
        run = self.words.run
        family = run.font[0] if run.font else ""
        self._show_face(Face(family, run.weight >= BOLD, run.italic))
        self._show_size(run.size * self._scale)

    def _show_size(self, size: float) -> None:
        self.text_size = size
        self.size_edit.show_number(size, 6)

    def _follow_words(self) -> None:
        self.words.fit_height()
        if not self.isHidden():
            self.place()
            self.changed.emit()

    def _read_size(self, text: str) -> float:
        return read_length(text, self._unit, self.text_size)

    def _take_size(self, size: float) -> None:
        if size < _LEAST:
            self.size_edit.keep()
            self.remark("A size is greater than 0.")
            return
        by = size / self.text_size
        self._show_size(size)
        self.restyle(partial(grown, by=by))

    # Look

    def place(self) -> None:
        if (layout := self.layout()) is not None:
            layout.activate()
        # Large type takes more.
        width = max(_WIDTH, self.minimumSizeHint().width())
        height, below, area = self.heightForWidth(width), self.below.size(), self._area()
        height = height if height > 0 else self.sizeHint().height()
        y = area.bottom() + _GAP
        if y + height > below.height():
            y = area.top() - _GAP - height
        x = max(min(area.left(), below.width() - width), 0)
        self.setGeometry(x, max(min(y, below.height() - height), 0), width, height)

    def set_theme(self, theme: Theme) -> None:
        self.set_sheet(choice_style(theme))
        self._remark.setStyleSheet(f"color: {theme.warning.name()}")


def _application() -> QApplication:
    application = QApplication.instance()
    assert isinstance(application, QApplication)
    return application


def _stepped(size: float, count: int) -> float:
    """Return a size so many steps larger, of which it has 10 to 99."""
    step = 10.0 ** (math.floor(math.log10(size)) - 1) if size > 0 else 1.0
    return decimal_sum(size, count * step) if size + count * step > 0 else size
