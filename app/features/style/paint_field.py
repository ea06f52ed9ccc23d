"""A paint: one click on a swatch, a colour typed, or chosen in a popup that shows it at once."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon
from PySide6.QtWidgets import QApplication, QBoxLayout, QToolButton, QWidget

from ...appearance.colours import CURVE_COLOURS, fill_colour, paint_picture
from ...appearance.theme import FollowsTheme, Theme, theme_of
from ...document.expression import ExpressionError
from ...document.style import INK, NO_PAINT
from ...widgets.boxes import column_of, row_of
from ...widgets.colour_popup import ColourPopup
from ...widgets.controls import tool_button
from ...widgets.fields import NumberEdit
from .percent_field import MIXED

MOST_RECENT = 5
"""Colours that are remembered beside those that are always there."""

_SIDE, _PICTURE = 20, 16
_WORDS = {INK: "ink", NO_PAINT: "none"}
_PAINTS = {"None": NO_PAINT, **CURVE_COLOURS}


def read_paint(text: str) -> str:
    """Return the paint that was typed: "none", "ink", "#rrggbb" with or without the sign, or a name of CSS's.

    Raises
    ------
    ExpressionError
        With the sentence for the person.
    """
    word = text.strip().casefold()
    named = {spoken: paint for paint, spoken in _WORDS.items()} | {"": INK}
    if word in named:
        return named[word]
    is_code = len(word) in (3, 6) and all(letter in "0123456789abcdef" for letter in word)
    colour = QColor.fromString(f"#{word}" if is_code else word)
    if not colour.isValid() or colour.alpha() < 255:
        raise ExpressionError("A colour is written as #0072b2, by a name such as “teal”, “ink” or “none”.")
    return colour.name()


class PaintField(FollowsTheme, QWidget):
    """Shows a paint and asks for another one.

    Signals
    -------
    chosen
        Another paint was chosen.
    previewed
        A colour is looked at in the popup.
    cancelled
        It is looked at no more, and was not chosen.

    Attributes
    ----------
    edit
        The field.
    """

    chosen = Signal(str)
    previewed = Signal(str)
    cancelled = Signal()

    def __init__(self, name: str, label: str) -> None:
        super().__init__()
        self.setObjectName(name)
        self._label = label
        self._value: object = None
        self._recent: tuple[str, ...] = ()
        self._swatches: dict[str, QToolButton] = {}
        self._popup: ColourPopup | None = None
        tip = f"{label}: choose any colour; it is seen at once, Escape cancels"
        self._button = tool_button(f"{name}Button", f"{label}, choose a colour", tip, icon_size=_PICTURE)
        # The same with a colour and with the dots of several.
        self._button.setFixedSize(_PICTURE + 13, _PICTURE + 7)
        self._button.clicked.connect(self.open_popup)
        tip = f"{label}: #rrggbb, a name, “ink” or “none” (Enter to set)"
        self.edit = NumberEdit(f"{name}Hex", label, tip, read_paint)
        self.edit.entered.connect(lambda paint: self.chosen.emit(paint))  # noqa: PLW0108 - of other types
        top = row_of(self._button, (self.edit, 1), margins=0, spacing=6)
        # Used colours have a row of their own: beside the others they would make the panel too wide. It is
        # there from the start, for the first one moves nothing under the pointer.
        used = QWidget()
        used.setFixedHeight(_SIDE)
        self._always, self._used = row_of(1, spacing=2), row_of(1, margins=0, spacing=2, parent=used)
        column_of(top, self._always, used, margins=0, spacing=4, parent=self)
        for word, paint in _PAINTS.items():
            self._add_swatch(self._always, word, paint)
        self.follow_theme()

    def _add_swatch(self, row: QBoxLayout, word: str, paint: str) -> None:
        tip = f"{self._label}: {word.lower()}"
        button = tool_button(f"{self.objectName()}_{word}", tip, tip, flat=True)
        button.setFixedSize(_SIDE, _SIDE)
        button.setIconSize(QSize(_PICTURE, _PICTURE))
        # The field takes colours from the keyboard; so many stops would only be in the way.
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        button.setIcon(QIcon(paint_picture(paint, self.theme)))
        button.clicked.connect(lambda: self._choose(paint))
        self._swatches[paint] = button
        row.insertWidget(row.count() - 1, button)

    def _choose(self, paint: str) -> None:
        """Ask for a paint; what was typed is no longer wanted, though the field keeps the cursor."""
        self.edit.give_up()
        self.chosen.emit(paint)

    # What it shows

    def render_value(self, value: object) -> None:
        """Show a paint; anything but a text for several."""
        self._value = value
        text = _WORDS.get(value, value) if isinstance(value, str) else MIXED
        self.edit.show_text(text)
        self._show_button()

    def show_recent(self, colours: Iterable[str], others: Iterable[str] = ()) -> None:
        """Offer these colours beside those that are always there, then others while there is room."""
        first = [each for each in colours if each not in _PAINTS.values()][:MOST_RECENT]
        rest = (each for each in others if each not in _PAINTS.values())
        recent = tuple(dict.fromkeys([*first, *rest]))[: len(_PAINTS)]
        if recent == self._recent:
            return
        for colour in self._recent:
            button = self._swatches.pop(colour)
            self._used.removeWidget(button)
            # Out of the row at once, and found by nobody until it is deleted.
            button.hide()
            button.setObjectName("")
            button.deleteLater()
        self._recent = recent
        for colour in recent:
            self._add_swatch(self._used, colour, colour)

    def _show_button(self) -> None:
        one = self._value if isinstance(self._value, str) else None
        self._button.setIcon(
            QIcon() if one is None else QIcon(paint_picture(one, theme_of(QApplication.palette())))
        )
        self._button.setText("…" if one is None else "")

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._show_button()
        for paint, button in self._swatches.items():
            button.setIcon(QIcon(paint_picture(paint, theme)))

    # What the person did

    def open_popup(self) -> ColourPopup:
        """Open the choice of colours below the button."""
        begin = self._value if isinstance(self._value, str) else INK
        self._popup = ColourPopup(f"{self.objectName()}Popup", fill_colour(begin, self.theme).name(), self)
        self._popup.colour_changed.connect(self.previewed)
        self._popup.chosen.connect(self._choose)
        self._popup.cancelled.connect(self.cancelled)
        self._popup.destroyed.connect(self._forget_popup)
        self._popup.open_below(self._button)
        return self._popup

    def abandon(self) -> None:
        """Close the popup; what was looked at there means nothing any more."""
        if self._popup is not None:
            self._popup.cancel()

    def _forget_popup(self) -> None:
        self._popup = None
