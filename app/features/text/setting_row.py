"""How the letters of a text stand to each other: which part of a line is where it began, spaces, lines."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QToolButton, QWidget

from ...document.expression import ExpressionError
from ...document.text import LETTER_SPACING, LINE_SPACING, Setting, TextAlign
from ...document.transforms import decimal_sum
from ...document.words import number
from ...qt.labels import Label
from ...widgets.boxes import row_of
from ...widgets.choice_row import ChoiceRow
from ...widgets.field_edit import NumberEdit, read_number
from ...widgets.number_text import decimal_mark

_STEP = 0.01
"""Share by which an arrow key goes on."""

_ICONS = ("text-left", "text-centre", "text-right", "text-justify")
_JUSTIFY = "textAlign_justify"
_WIDEST = "−100.00 %"


class SettingRow(QWidget):
    """A row of choices and of per cents.

    Attributes
    ----------
    setting
        What is shown and asked for.
    word_spacing
        What is shown between words, in sizes.
    edits
        The fields of letter, word and line spacing.

    Signals
    -------
    changed
        Another one is asked for.
    spaced
        Letters that may differ are to stand otherwise: which space, and how many sizes it takes.
    refused
        Why what was typed cannot be used; empty once it was taken back.
    """

    changed = Signal()
    spaced = Signal(str, float)
    refused = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setting, self.word_spacing, self._has_parts = Setting(), 0.0, False
        self._align = ChoiceRow(
            "textAlign", "Alignment", "Part of each line where the text began", TextAlign, icons=_ICONS
        )
        self._align.chosen.connect(lambda align: self._take(align=align))
        self._justify = next(
            each for each in self._align.findChildren(QToolButton) if each.objectName() == _JUSTIFY
        )
        self._justify.setToolTip("Lines as wide as their frame, the last one of a paragraph as it is")
        for button in self._align.findChildren(QToolButton):
            # Else a click on it would give the focus to the canvas.
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        fields = {
            "letter_spacing": (
                "textLetterSpacing",
                "Letter spacing",
                "Space between letters",
                LETTER_SPACING,
            ),
            "word_spacing": ("textWordSpacing", "Word spacing", "Space between words", LETTER_SPACING),
            "line_spacing": ("textLineSpacing", "Line spacing", "Way from line to line", LINE_SPACING),
        }
        self.edits = {name: self._edit(name, *words) for name, words in fields.items()}
        letters, words, lines = self.edits.values()
        self._words = Label("Words")
        spaces = ("Letters", letters, self._words, words, "Lines", lines)
        row_of((self._align, 1), *spaces, margins=0, spacing=6, parent=self)
        self.set_has_parts(has_parts=False)
        self.show_setting(self.setting)

    def _edit(
        self, name: str, object_name: str, label: str, tip: str, limits: tuple[float, float]
    ) -> NumberEdit:
        of = "of the size more" if name != "line_spacing" else "of what the font has"
        edit = NumberEdit(
            object_name,
            label,
            f"{tip}, in per cent {of} (Enter to set; ↑ ↓ by 1 %)",
            partial(_read, limits),
            partial(_stepped, limits),
        )
        edit.setFixedWidth(self.fontMetrics().horizontalAdvance(_WIDEST))
        for taken in (edit.entered, edit.stepped):
            taken.connect(lambda value: self._take_space(name, value))
        edit.refused.connect(self.refused)
        edit.left.connect(lambda: self.refused.emit(""))
        return edit

    def set_in_frame(self, in_frame: bool) -> None:
        """Have lines that fill a frame, or lines that end where they do: only the first can be justified."""
        self._justify.setEnabled(in_frame)
        if not in_frame and self.setting.align is TextAlign.JUSTIFIED:
            self.show_setting(self.setting._replace(align=TextAlign.LEFT))

    def set_has_parts(self, *, has_parts: bool) -> None:
        """Have letters that may differ, whose spaces are their own, or such as all stand alike."""
        self._has_parts = has_parts
        for part in (self._words, self.edits["word_spacing"]):
            part.setVisible(has_parts)

    def show_spaces(self, letters: float, words: float) -> None:
        """Show how far letters and words of a part are apart, in sizes."""
        self.word_spacing = words
        self.show_setting(self.setting._replace(letter_spacing=letters))

    def _take_space(self, name: str, value: float) -> None:
        if not self._has_parts or name == "line_spacing":
            self._take(**{name: value})
            return
        spaces = {"letter_spacing": self.setting.letter_spacing, "word_spacing": self.word_spacing} | {
            name: value
        }
        self.show_spaces(*spaces.values())
        self.spaced.emit(name, value)

    def show_setting(self, setting: Setting) -> None:
        """Show how letters stand."""
        self.setting = setting
        self._align.render_value(setting.align)
        shares = setting._asdict() | {"word_spacing": self.word_spacing}
        for name, edit in self.edits.items():
            edit.show_text(f"{number(100 * shares[name], 6, decimal_mark())} %")

    def _take(self, **fields: object) -> None:
        self.show_setting(self.setting._replace(**fields))  # type: ignore[arg-type]
        self.changed.emit()


def _read(limits: tuple[float, float], text: str) -> float:
    share = read_number(text.replace("%", " ").strip()) / 100
    least, most = limits
    if not least <= share <= most:
        raise ExpressionError(f"From {number(100 * least)} % to {number(100 * most)} %.")
    return share


def _stepped(limits: tuple[float, float], share: float, count: int) -> float:
    least, most = limits
    return min(max(decimal_sum(share, count * _STEP), least), most)
