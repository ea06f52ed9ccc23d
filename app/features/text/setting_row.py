"""How the letters of a text stand to each other: which part of a line is where it began, spaces, lines."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QToolButton, QWidget

from ...document.expression import ExpressionError
from ...document.text import LETTER_SPACING, LINE_SPACING, Setting, TextAlign
from ...document.transforms import decimal_sum
from ...document.words import number
from ...widgets.boxes import row_of
from ...widgets.choice_row import ChoiceRow
from ...widgets.field_edit import NumberEdit, read_number
from ...widgets.number_text import decimal_mark

_STEP = 0.01
"""Share by which an arrow key goes on."""

_WIDEST = "−100.00 %"


class SettingRow(QWidget):
    """A row of choices and of per cents.

    Attributes
    ----------
    setting
        What is shown and asked for.
    edits
        The fields of letter and line spacing.

    Signals
    -------
    changed
        Another one is asked for.
    refused
        Why what was typed cannot be used; empty once it was taken back.
    """

    changed = Signal()
    refused = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setting = Setting()
        self._align = ChoiceRow("textAlign", "Alignment", "Part of each line where the text began", TextAlign)
        self._align.chosen.connect(lambda align: self._take(align=align))
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
            "line_spacing": ("textLineSpacing", "Line spacing", "Way from line to line", LINE_SPACING),
        }
        self.edits = {name: self._edit(name, *words) for name, words in fields.items()}
        letters, lines = self.edits.values()
        row_of((self._align, 1), "Letters", letters, "Lines", lines, margins=0, spacing=6, parent=self)
        self.show_setting(self.setting)

    def _edit(
        self, name: str, object_name: str, label: str, tip: str, limits: tuple[float, float]
    ) -> NumberEdit:
        of = "of the size more" if name == "letter_spacing" else "of what the font has"
        edit = NumberEdit(
            object_name,
            label,
            f"{tip}, in per cent {of} (Enter to set; ↑ ↓ by 1 %)",
            partial(_read, limits),
            partial(_stepped, limits),
        )
        edit.setFixedWidth(self.fontMetrics().horizontalAdvance(_WIDEST))
        for taken in (edit.entered, edit.stepped):
            taken.connect(lambda value: self._take(**{name: value}))
        edit.refused.connect(self.refused)
        edit.left.connect(lambda: self.refused.emit(""))
        return edit

    def show_setting(self, setting: Setting) -> None:
        """Show how letters stand."""
        self.setting = setting
        self._align.render_value(setting.align)
        for name, edit in self.edits.items():
            edit.show_text(f"{number(100 * getattr(setting, name), 6, decimal_mark())} %")

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
