"""What is asked of a text beside it while it is typed on the canvas: its font, its size, how it is set."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import methodcaller

from msgspec.structs import replace
from PySide6.QtCore import QRect, Qt, Signal
from PySide6.QtGui import QKeyEvent, QTransform
from PySide6.QtWidgets import QApplication, QToolButton, QWidget

from ...appearance.theme import Theme
from ...document.content import TextRun
from ...document.text import Setting
from ...document.value import Vector
from ...qt.caret_places import CaretPlaces
from ...qt.glyphs import Face
from ...qt.keys import ENTER, ClaimsKeys
from ...qt.labels import Label
from ...widgets.boxes import column_of, row_of
from ...widgets.choice_style import choice_style
from ...widgets.overlay_frame import OverlayFrame
from ...workbench.typed_letters import TypedLetters
from .font_box import FontBox
from .letter_button import letter_button
from .raised import ABOVE, BELOW, raised
from .setting_row import SettingRow
from .size_box import SizeBox
from .weight_box import WeightBox
from .wording import BOLD, WEIGHTS, Typed
from .words_on_page import WordsOnPage

_WIDTH, _FONT_WIDTH = 360, 140
_WAYS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
"""Keys, and where they move letters, y downwards."""

_GAP = 10
"""Pixels between the field and the text."""


class TextField(ClaimsKeys, OverlayFrame):
    """A small frame beside a text that is typed on the canvas.

    Attributes
    ----------
    words
        The text, typed where it is seen.
    font_box, weight_box, bold, italic, underline, strike, superscript, subscript, size_box,
    setting_row
        The widgets of font, lines and size, and of how letters stand to each other.

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
        # How long a unit of the text is, and whether its letters may differ.
        self._scale, self._has_parts = 1.0, False
        self._is_trying = False
        self.words = WordsOnPage(below, self)
        self.words.textChanged.connect(self._follow_words)
        self.words.chosen_changed.connect(self._show_chosen)
        self.words.chosen_changed.connect(letters.changed)
        self.changed.connect(letters.changed)
        self.font_box = FontBox(face.family)
        self.font_box.setMinimumWidth(_FONT_WIDTH)
        self.font_box.pointed_at.connect(self._look_at_font)
        self.font_box.picked.connect(self._take_font)
        self.bold = letter_button("textBold", "B", "Bold", face.bold)
        self.italic = letter_button("textItalic", "I", "Italic", face.italic)
        self.bold.clicked.connect(lambda is_on: self._set(weight=WEIGHTS[is_on]))
        self.italic.clicked.connect(lambda is_on: self._set(italic=is_on))
        self.underline = letter_button("textUnderline", "U", "Underlined", is_on=False)
        self.strike = letter_button("textStrike", "S", "Struck-through", is_on=False)
        self.underline.clicked.connect(lambda is_on: self._set(underline=is_on))
        self.strike.clicked.connect(lambda is_on: self._set(strike=is_on))
        self.weight_box = WeightBox()
        self.weight_box.picked.connect(self._take_weight)
        self.size_box = SizeBox()
        self.size_box.sized.connect(self._take_size)
        self.size_box.refused.connect(self.remark)
        self.size_box.left.connect(lambda: self.remark(""))
        self.setting_row = SettingRow()
        self.setting_row.changed.connect(self.changed)
        self.setting_row.spaced.connect(self._space)
        self.setting_row.refused.connect(self.remark)
        self._remark = Label(name="textRemark", wordWrap=True)
        self.superscript = letter_button("textSuperscript", "x²", "Superscript", is_on=False)
        self.subscript = letter_button("textSubscript", "x₂", "Subscript", is_on=False)
        self.superscript.clicked.connect(lambda is_on: self._raise(ABOVE if is_on else 0.0))
        self.subscript.clicked.connect(lambda is_on: self._raise(BELOW if is_on else 0.0))
        letters_row = (self.bold, self.italic, self.underline, self.strike, self.superscript, self.subscript)
        row = row_of(self.font_box, self.weight_box, *letters_row, self.size_box, spacing=6)
        column_of(row, self.setting_row, self._remark, margins=(8, 8, 8, 8), spacing=6, parent=self)
        QWidget.setTabOrder(self.words, self.font_box)
        # A press between its widgets is none on the canvas below, and leaves the focus where it was.
        self.setAttribute(Qt.WidgetAttribute.WA_NoMousePropagation)
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setFocusProxy(self.words)
        self.hide()
        self.follow_theme()

    # What is asked for

    @property
    def text(self) -> str:
        """The text."""
        return self.words.text

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
        """How the letters stand to each other; those that may differ know for themselves how far apart."""
        setting = self.setting_row.setting
        return setting._replace(letter_spacing=0.0) if self._has_parts else setting

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
        self._show_letters()

    def begin_new(self, size: float, *, has_parts: bool) -> None:
        """Have a text of a size to begin with, in the font of the last one, or words that are there."""
        self._scale, self._has_parts = 1.0, has_parts
        face = self.face
        apart = self.setting_row.setting.letter_spacing * size
        run = TextRun("", (face.family,), size, WEIGHTS[face.bold], face.italic, apart)
        if has_parts and self.text:
            self.words.restyle(methodcaller("resized", size / self.words.first.size), chosen=False)
        else:
            self.words.begin_in(run)
        self._show_letters()

    def begin_again(self, typed: Typed, scale: float, face: Face) -> None:
        """Have the letters of a text to begin with, a unit of which is so long."""
        self._scale, self._has_parts = scale, True
        self.words.begin_with(typed)
        self._show_face(face)
        self._show_letters()

    def _show_face(self, face: Face) -> None:
        self.font_box.take(face.family)
        self.bold.setChecked(face.bold)
        self.italic.setChecked(face.italic)

    def _show_letters(self) -> None:
        """Show lines and spaces of the letters that are chosen; letters that become curves have none."""
        run = self.words.run
        self.setting_row.set_has_parts(has_parts=self._has_parts)
        if self._has_parts:
            self.setting_row.show_spaces(run.spacing / run.size, run.word_spacing / run.size)
            self.weight_box.show_weight(self.font_box.family, run.weight)
        else:
            self.weight_box.hide()
        shown: dict[QToolButton, bool] = {
            self.underline: run.underline,
            self.strike: run.strike,
            self.superscript: run.raised > 0,
            self.subscript: run.raised < 0,
        }
        for button, is_on in shown.items():
            button.setChecked(is_on)
            button.setVisible(self._has_parts)

    def open_beside(self, way: Callable[[], QTransform], size: float) -> None:
        """Ask for a text of a size, beside where it lies: a way leads from the plane to the pixels there."""
        self.words.way = way
        self.size_box.show_size(size)
        self.remark("")
        self.words.show()
        self.show()
        self.words.raise_()
        self.raise_()
        self.words.setFocus(Qt.FocusReason.OtherFocusReason)
        self.words.selectAll()
        _application().focusChanged.connect(self._follow_focus)

    def close_field(self, *, keeps_words: bool = False) -> None:
        """Put it away; words that are kept are there when it is opened again."""
        _application().focusChanged.disconnect(self._follow_focus)
        self.hide()
        self.words.hide()
        # What was only looked at is not there when it is opened again.
        self._end_trial()
        if not keeps_words:
            self.words.clear()

    def _follow_focus(self, _before: QWidget | None, now: QWidget | None) -> None:
        # Without any another window has it; a menu, or the list of fonts, only borrows it.
        if now is None or now.window().windowType() is Qt.WindowType.Popup:
            return
        if not any(each is now or each.isAncestorOf(now) for each in (self, self.words)) and not (
            self._letters.has_tool(now)
        ):
            self.left.emit()

    def claims(self, event: QKeyEvent) -> bool:
        keys = (*ENTER, Qt.Key.Key_Escape)
        return event.key() in keys or self._button_of(event) is not None or self._way_of(event) is not None

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() not in ENTER:
            if self.claims(event):
                self.take_key(event)
            else:
                super().keyPressEvent(event)
        elif not any(edit.isModified() for edit in (self.size_box.edit, *self.setting_row.edits.values())):
            # What was typed beside them was taken; one that cannot be used is mended first.
            self.words.setFocus(Qt.FocusReason.OtherFocusReason)

    def take_key(self, event: QKeyEvent) -> None:
        """Do what a key is for that is pressed among the words."""
        if (button := self._button_of(event)) is not None:
            button.click()
        elif (way := self._way_of(event)) is not None:
            self.words.kern(*way)
        elif event.key() == Qt.Key.Key_Escape:
            self.given_up.emit()
        elif event.modifiers() & Qt.KeyboardModifier.ControlModifier:
            self.entered.emit()
        else:
            self.words.insertPlainText("\n")

    def _way_of(self, event: QKeyEvent) -> Vector | None:
        """Return how far a key moves letters that may differ: by pixels, in units of the text."""
        keys = Qt.KeyboardModifier
        held = event.modifiers() & ~keys.KeypadModifier
        if not self._has_parts or held & ~keys.ShiftModifier != keys.AltModifier:
            return None
        right, down = _WAYS.get(Qt.Key(event.key()), (0, 0))
        pixel = 1.0 / (abs(self.words.way().m11()) * self._scale)
        far = 10 * pixel if held & keys.ShiftModifier else pixel
        return (right * far, down * far) if right or down else None

    def _button_of(self, event: QKeyEvent) -> QToolButton | None:
        is_control = event.modifiers() == Qt.KeyboardModifier.ControlModifier
        buttons = {Qt.Key.Key_B: self.bold, Qt.Key.Key_I: self.italic}
        if self._has_parts:
            buttons[Qt.Key.Key_U] = self.underline
        return buttons.get(Qt.Key(event.key())) if is_control else None

    # Changes

    def _set(self, **fields: object) -> None:
        self.restyle(lambda run: replace(run, **fields))
        if "weight" in fields:
            self._show_letters()

    def restyle(self, change: Callable[[TextRun], TextRun]) -> None:
        """Have the chosen letters, or all where none are, look otherwise."""
        self._end_trial()
        self.words.restyle(change, chosen=self._has_parts)
        self.changed.emit()

    def _raise(self, share: float) -> None:
        self.restyle(lambda run: raised(run, share))
        self._show_letters()
        self.size_box.show_size(self.words.run.size * self._scale)

    def _space(self, name: str, share: float) -> None:
        field = {"letter_spacing": "spacing"}.get(name, name)
        self.restyle(lambda run: replace(run, **{field: share * run.size}))

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
        self._show_letters()
        self.place()

    def _take_weight(self, weight: float) -> None:
        self._set(weight=weight)
        self.bold.setChecked(weight >= BOLD)

    def _show_chosen(self) -> None:
        """Show font and size of the letters that are chosen."""
        if not self._has_parts or self.isHidden():
            return
        run = self.words.run
        family = run.font[0] if run.font else ""
        self._show_face(Face(family, run.weight >= BOLD, run.italic))
        self._show_letters()
        self.size_box.show_size(run.size * self._scale)

    def _follow_words(self) -> None:
        if not self.isHidden():
            self.changed.emit()

    def _take_size(self, size: float) -> None:
        by = size / self.size_box.em
        self.size_box.show_size(size)
        self.restyle(methodcaller("resized", by))

    # Look

    def lie_at(self, places: CaretPlaces, corners: Sequence[Vector]) -> None:
        """Have the words where they are in the plane, and in the frame with some corners that they fill."""
        self.words.lie_at(places, corners)
        self.place()

    def place(self) -> None:
        if self.isHidden():
            return
        self.words.follow_view()
        self._place_beside(self.words.area)

    def _place_beside(self, area: QRect) -> None:
        if (layout := self.layout()) is not None:
            layout.activate()
        # Large type takes more.
        width = max(_WIDTH, self.minimumSizeHint().width())
        height, below = self.heightForWidth(width), self.below.size()
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
