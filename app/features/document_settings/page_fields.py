"""The fields of a document's page: a usual size, width and height, and a turn by a quarter."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from ...appearance.icons import icon
from ...appearance.theme import Theme
from ...document.model import Document, Page
from ...document.plane_edits import set_page, set_unit, with_page_size
from ...exchange.lengths import typed_length
from ...exchange.units import known_unit
from ...qt.labels import Label
from ...widgets.boxes import row_of
from ...widgets.controls import choice_box
from ...widgets.field_edit import NumberEdit
from ...widgets.length_text import length_text, read_length
from ...widgets.tool_buttons import ICON, tool_button

_FLAGS = Qt.ItemDataRole.UserRole - 1
"""Where a box keeps whether an entry can be chosen."""

Edit = Callable[[Document], Document]
Change = Callable[[str, Edit], object]
"""Is given the name of a step and its edit."""

_NONE, _OWN = "none", "own size"
_SAME = 1e-9
"""Share by which sizes differ that are the same but for rounding."""


class Size(NamedTuple):
    """Width and height of a page."""

    width: float
    height: float

    @property
    def turned(self) -> Size:
        """It, lying where it stood."""
        return Size(self.height, self.width)

    def is_like(self, other: Size) -> bool:
        """Whether it is the other but for rounding."""
        return all(abs(one - two) <= _SAME * two for one, two in zip(self, other, strict=True))


class UsualSize(NamedTuple):
    """A size that many pages have, of a sheet or of an icon.

    Attributes
    ----------
    name
        What people call it.
    width, height
        As they would be typed, the unit apart.
    unit
        In which they are.
    """

    name: str
    width: str
    height: str
    unit: str

    def in_unit(self, unit: str) -> Size | None:
        """Return it in the unit of a document; None of a sheet where that is no length.

        Where nobody has said how long a length of 1 is, it is a pixel.
        """
        if not known_unit(unit):
            return Size(float(self.width), float(self.height)) if self.unit == "px" else None
        return Size(*(typed_length(f"{each}{self.unit}", unit) for each in (self.width, self.height)))


_USUAL = (
    *(UsualSize(f"{side} × {side} px", str(side), str(side), "px") for side in (16, 24, 32, 48, 64, 512)),
    UsualSize("A3", "297", "420", "mm"),
    UsualSize("A4", "210", "297", "mm"),
    UsualSize("A5", "148", "210", "mm"),
    UsualSize("Letter", "8.5", "11", "in"),
)


class PageFields:
    """Rows of a form that show the page of a document, and ask for another.

    Parameters
    ----------
    change
        Makes what was asked for.
    watch
        Is given the fields whose refusals the form tells.

    Attributes
    ----------
    rows
        Its rows: labels and widgets.
    width, height
        The lines to type into.
    """

    def __init__(self, change: Change, watch: Callable[..., None]) -> None:
        self._change, self._unit = change, ""
        self._page: Page | None = None
        self._offered: list[tuple[str, Size]] = []
        self._sheets: dict[str, UsualSize] = {}
        self.usual = choice_box(
            "pageUsual",
            "Usual sizes of the page",
            "None, or a usual size; pictures show what lies on the page",
        )
        self.usual.activated.connect(self._choose)
        self.width = self._length("pageWidth", "Width")
        self.height = self._length("pageHeight", "Height")
        watch(self.width, self.height)
        self.width.entered.connect(
            lambda width: self._ask(Size(width, self._page.height if self._page else width))
        )
        self.height.entered.connect(
            lambda height: self._ask(Size(self._page.width if self._page else height, height))
        )
        self.turn = tool_button("pageTurn", "Turn the page", "Make the page lie, or stand", icon_size=ICON)
        self.turn.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.turn.clicked.connect(self._turn)
        size = QWidget()
        row_of((self.width, 1), Label("×"), (self.height, 1), self.turn, margins=0, spacing=6, parent=size)
        self.rows: Sequence[tuple[str, QWidget]] = (("Page", self.usual), ("Page size", size))

    def _length(self, name: str, side: str) -> NumberEdit:
        tip = f"{side} of the page: a number or an expression, with a unit or without, or +10% (Enter to set)"
        edit = NumberEdit(name, f"{side} of the page", tip, lambda text: self._read(side, text))
        edit.setPlaceholderText(side.lower())
        return edit

    def _read(self, side: str, text: str) -> float:
        now = None if self._page is None else self._page.width if side == "Width" else self._page.height
        return read_length(text, self._unit, now)

    def show(self, page: Page | None, unit: str) -> None:
        """Show a page, or that there is none, in the unit of its document."""
        if unit != self._unit or not self._offered:
            self._offer(unit)
        self._page = page
        self._show_length(self.width, None if page is None else page.width)
        self._show_length(self.height, None if page is None else page.height)
        self.turn.setEnabled(page is not None and page.width != page.height)
        self._show_usual()

    def _show_length(self, edit: NumberEdit, length: float | None) -> None:
        if length is None:
            edit.show_text("")
        else:
            edit.show_length(length)

    def _offer(self, unit: str) -> None:
        self._unit = unit
        sizes = [(each.name, each.in_unit(unit)) for each in _USUAL]
        self._offered = [(name, size) for name, size in sizes if size is not None]
        # Who chooses a sheet has said how long a length of 1 is.
        self._sheets = {each.name: each for each in _USUAL if not unit and each.in_unit(unit) is None}
        self.usual.clear()
        self.usual.addItems([_NONE, *(name for name, _size in self._offered), *self._sheets, _OWN])
        # It is shown, and got by typing.
        self.usual.setItemData(self.usual.count() - 1, 0, _FLAGS)

    def _show_usual(self) -> None:
        """Show which usual size the page has, lying or standing."""
        size = _size_of(self._page)
        if size is None:
            name = _NONE
        else:
            alike = (
                each for each, usual in self._offered if size.is_like(usual) or size.is_like(usual.turned)
            )
            name = next(alike, _OWN)
        self.usual.setCurrentText(name)

    def _choose(self, row: int) -> None:
        chosen = self.usual.itemText(row)
        self._show_usual()
        if chosen == _NONE:
            self._change("No Page", lambda document: set_page(document, None))
        elif (sheet := self._sheets.get(chosen)) is not None:
            size = Size(float(sheet.width), float(sheet.height))
            self._change(
                f"Page {sheet.name}",
                lambda document: with_page_size(set_unit(document, sheet.unit), *size),
            )
        else:
            self._ask(dict(self._offered)[chosen])

    def _turn(self) -> None:
        if (size := _size_of(self._page)) is not None:
            self._ask(size.turned)

    def _ask(self, size: Size) -> None:
        words = f"Page {length_text(size.width, '', 4)} × {length_text(size.height, self._unit, 4)}"
        self._change(words, lambda document: with_page_size(document, *size))

    def begin_typing(self) -> None:
        """Let the width be typed, then the height."""
        self.width.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.width.selectAll()

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self.turn.setIcon(icon("rotate-right", theme))


def _size_of(page: Page | None) -> Size | None:
    return None if page is None else Size(page.width, page.height)
