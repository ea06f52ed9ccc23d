"""Fields of a style: a colour, a dash pattern, a percentage."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from PySide6.QtCore import QPoint, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon
from PySide6.QtWidgets import QApplication, QBoxLayout, QComboBox, QToolButton, QWidget

from ...appearance.colours import CURVE_COLOURS, fill_colour, paint_picture
from ...appearance.theme import FollowsTheme, Theme, theme_of
from ...document.expression import ExpressionError
from ...document.style import INK, LARGEST_DASHES, NO_PAINT
from ...document.words import decimal_sum, number
from ...widgets.boxes import column_of, remove_widgets, row_of
from ...widgets.colour_popup import ColourPopup
from ...widgets.controls import choice_box, named, tool_button
from ...widgets.fields import NumberEdit, read_number
from ...widgets.number_text import decimal_mark, typed_text
from ...widgets.sliders import LiveSlider

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
        raise ExpressionError("Type a colour as #0072b2, a name such as “teal”, “ink” or “none”.")
    return colour.name()


class PaintField(FollowsTheme, QWidget):
    """Shows a paint and asks for another one.

    Signals
    -------
    chosen
        Another paint was picked.
    previewed
        A colour is previewed in the popup.
    cancelled
        The preview is cancelled.

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
        tip = f"{label}: choose any colour, with a live preview; Escape cancels"
        self._button = tool_button(f"{name}Button", f"{label}, choose a colour", tip, icon_size=_PICTURE)
        # The same height with a colour and with the dots of mixed colours.
        self._button.setFixedSize(_PICTURE + 13, _PICTURE + 7)
        self._button.clicked.connect(self.open_popup)
        tip = f"{label}: #rrggbb, a name, “ink” or “none” (Enter to set)"
        self.edit = NumberEdit(f"{name}Hex", label, tip, read_paint)
        self.edit.entered.connect(lambda paint: self.chosen.emit(paint))  # noqa: PLW0108 - of other types
        top = row_of(self._button, (self.edit, 1), margins=0, spacing=6)
        # Recent colours have a separate row, because the panel would be too wide otherwise. It is
        # there from the start, so that the first colour moves nothing.
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
        # Colours can be typed in the field; so many tab stops would be in the way.
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        button.setIcon(QIcon(paint_picture(paint, self.theme)))
        button.clicked.connect(lambda: self._choose(paint))
        self._swatches[paint] = button
        row.insertWidget(row.count() - 1, button)

    def _choose(self, paint: str) -> None:
        """Pick a paint, and discard typed text."""
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
        """Show recent colours after the fixed ones, then others while there is room."""
        first = [colour for colour in colours if colour not in _PAINTS.values()][:MOST_RECENT]
        rest = (colour for colour in others if colour not in _PAINTS.values())
        recent = tuple(dict.fromkeys([*first, *rest]))[: len(_PAINTS)]
        if recent == self._recent:
            return
        for colour in self._recent:
            button = self._swatches.pop(colour)
            remove_widgets(self._used, [button])
            # Not found by name until it is deleted.
            button.setObjectName("")
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

    # Input of the user

    def open_popup(self) -> ColourPopup:
        """Open the choice of colours below the button."""
        begin = self._value if isinstance(self._value, str) else INK
        popup = ColourPopup(f"{self.objectName()}Popup", fill_colour(begin, self.theme).name(), self)
        popup.colour_changed.connect(self.previewed)
        popup.chosen.connect(self._choose)
        popup.cancelled.connect(self.cancelled)
        popup.open_at(self._button.mapToGlobal(QPoint(0, self._button.height())))
        return popup

    def abandon(self) -> None:
        """Close the popup and cancel its preview."""
        for popup in self.findChildren(ColourPopup):
            popup.cancel()


_PRESETS: dict[str, tuple[float, ...]] = {
    "Solid": (),
    "Dots": (0.0, 2.0),
    "Short": (2.0, 2.0),
    "Dashes": (4.0, 2.0),
    "Long": (8.0, 3.0),
    "Dash-dot": (5.0, 2.5, 0.0, 2.5),
}
"""Dashes and gaps in multiples of the width; one of length 0 is a dot where line ends are round."""

_CUSTOM = "Custom"
_LEAST = 48


class DashField(QWidget):
    """Field of a dash pattern: presets, and a list of lengths.

    Signals
    -------
    chosen
        A pattern was picked or typed: a tuple of numbers.
    dots_chosen
        A preset with dots was picked: dashes of length 0, which need round ends.

    Attributes
    ----------
    edit
        The field.
    """

    chosen = Signal(object)
    dots_chosen = Signal(object)

    def __init__(self) -> None:
        super().__init__()
        tip = "Dashes and gaps, in multiples of the width"
        self._box = choice_box("dashBox", "Dashes", tip, (*_PRESETS, _CUSTOM))
        self._box.setMinimumContentsLength(6)
        self._box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        tip = "Alternating lengths of dashes and gaps, in multiples of the width, such as 4 2 (Enter to set)"
        self.edit = NumberEdit("dashList", "List of dashes", tip, _read)
        self._value: object = ()
        self.edit.setMinimumWidth(_LEAST)
        row_of((self._box, 1), (self.edit, 1), margins=0, spacing=6, parent=self)
        self._box.activated.connect(self._choose)
        self.edit.entered.connect(self.chosen)

    def render_value(self, value: object) -> None:
        """Show dashes; anything but a tuple for several."""
        self._value = value
        if not isinstance(value, tuple):
            self._box.setCurrentIndex(-1)
            self.edit.show_text(MIXED)
            return
        names = [name for name, preset in _PRESETS.items() if preset == value]
        self._box.setCurrentText(names[0] if names else _CUSTOM)
        short = " ".join(number(length, 6, decimal_mark()) for length in value)
        self.edit.show_text(" ".join(map(typed_text, value)), short)

    def _choose(self, row: int) -> None:
        presets = list(_PRESETS.values())
        if row < len(presets):
            dash = presets[row]
            (self.dots_chosen if 0.0 in dash else self.chosen).emit(dash)
        else:
            self.render_value(self._value)
            self.edit.setFocus()


def _read(text: str) -> Sequence[float]:
    lengths = tuple(read_number(word) for word in text.replace(";", " ").split())
    if len(lengths) > LARGEST_DASHES:
        raise ExpressionError(f"Type at most {LARGEST_DASHES} dashes and gaps.")
    if any(length < 0 for length in lengths) or (lengths and not any(lengths)):
        raise ExpressionError("Dashes and gaps must be 0 or longer, and not all 0.")
    return lengths


STEPS = 100
"""Positions of the slider from nothing to all."""

MIXED = "mixed"
"""Text of a field with different values."""

_FIELD_WIDTH = 60

_STEP = 0.05
"""Share by which an arrow key goes on."""


class PercentField(QWidget):
    """Slider from 0 to `STEPS` with a field for a percentage.

    Attributes
    ----------
    slider, edit
        What is dragged, and typed into; `edit` reports shares from 0 to 1.
    """

    def __init__(self, name: str, label: str, tip: str) -> None:
        super().__init__()
        self.slider = named(LiveSlider(), f"{name}Slider", f"{label}, slider", f"{tip}; Escape cancels")
        self.slider.setRange(0, STEPS)
        self.edit = NumberEdit(name, label, f"{tip}, in % (Enter to set; ↑ ↓ by 5 %)", read_percent, _step)
        self.edit.setFixedWidth(_FIELD_WIDTH)
        row_of((self.slider, 1), self.edit, margins=0, spacing=8, parent=self)
        self._value: object = None
        self.slider.drag_ended.connect(lambda: self.render_value(self._value))

    def render_value(self, value: object) -> None:
        """Show a share; anything but a number for several."""
        self._value = value
        self.edit.show_text(f"{number(100 * value, 4)} %" if isinstance(value, float) else MIXED)
        if isinstance(value, float) and not self.slider.isSliderDown():
            self.slider.setValue(round(value * STEPS))


def read_percent(text: str) -> float:
    """Return the share from 0 to 1 that a text such as "40 %" means; raise ExpressionError for others."""
    share = read_number(text.replace("%", " ")) / 100
    if not 0 <= share <= 1:
        raise ExpressionError("Type a value from 0 % to 100 %.")
    return share


def _step(share: float, count: int) -> float:
    return min(max(decimal_sum(share, count * _STEP), 0.0), 1.0)
