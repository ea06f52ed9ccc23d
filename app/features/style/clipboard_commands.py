"""Styles on the clipboard: copied from one curve, pasted to others."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec
from PySide6.QtCore import QMimeData

from ... import exchange
from ...actions.declaration import action, also
from ...actions.menus import CHOSEN_MENU, EDIT_STYLE
from ...actions.needs import CHOSEN
from ...document.several_curves import named
from ...document.style import Style
from ...document.style_edits import with_style
from ...storage.field_check import check_fields
from ...storage.format_error import FormatError
from ...workbench.clipboard import CURVES, clipboard_data, drawing_in, own_in, put_on_clipboard
from ...workbench.context import WindowContext

if TYPE_CHECKING:
    from ...exchange.cubics_in import Imported

STYLE = "application/x-curvebench-style"
"""MIME type of a style, as JSON."""

_NOTHING_TO_PASTE = "There is no style on the clipboard; Copy Style puts one there, and so does copied SVG."


class StyleClipboardCommands:
    """Copies how a curve looks, and has others look so."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session

    @action(
        "copyStyle",
        "Copy Style",
        EDIT_STYLE,
        "Ctrl+Alt+Shift+C",
        "style-copy",
        keywords="colour format painter",
        needs=CHOSEN,
    )
    @also(CHOSEN_MENU(41))
    def _copy(self) -> None:
        """Copy stroke and fill of the curve that is edited."""
        session, data = self._session, QMimeData()
        data.setData(STYLE, msgspec.json.encode(session.active_curve.style))
        put_on_clipboard(data)
        session.say(f"Copied the style of “{session.active_curve.seen_name}”.")

    @action(
        "pasteStyle",
        "Paste Style",
        EDIT_STYLE,
        "Ctrl+Shift+V",
        "style-paste",
        keywords="colour format painter",
        needs=CHOSEN,
    )
    @also(CHOSEN_MENU(42))
    def _paste(self) -> None:
        """Give the curve, or all that are selected, the stroke and the fill that were copied.

        Of curves, or of an SVG, those of the first.
        """
        data = clipboard_data()
        fragment = None if any(map(data.hasFormat, (STYLE, CURVES))) else drawing_in(data)
        if fragment is not None and not fragment.is_bare:
            read = partial(exchange.svg.fragments.read_fragment, fragment)
            self._context.work.start("Reading the style", read, self._give_first, Path("The style"), "pasted")
        elif found := _style_in(data):
            self._give(found)
        else:
            self._session.refuse(_NOTHING_TO_PASTE)

    def _give_first(self, drawing: Imported) -> None:
        """Give the style of the first element of a drawing, in the unit of the document."""
        unit = self._session.document.unit
        self._give(exchange.units.in_unit(drawing.document, unit).curves[0].style)

    def _give(self, found: Style) -> None:
        """Give the selected curves a style."""
        session, curves = self._session, self._session.selected.marked
        subject = named(session.document, curves)
        words = f"Paste style to {subject}"
        fields = msgspec.structs.asdict(found)
        if session.change(words, lambda document: with_style(document, curves, **fields)):
            session.say(f"Pasted the style to {subject}.")


def _style_in(data: QMimeData) -> Style | None:
    """Return the style that was copied, or that of the first of the curves that were; None without either."""
    try:
        if data.hasFormat(STYLE):
            found = msgspec.json.decode(bytes(data.data(STYLE).data()), type=Style)
            check_fields(found, "style")
            return found
        if copied := own_in(data):
            return copied.curves[0].style
    except (msgspec.DecodeError, UnicodeDecodeError, FormatError):
        pass
    return None
