"""Several whole curves on the clipboard, to the last bit; for other programs, tables of their points."""

from __future__ import annotations

from PySide6.QtCore import QMimeData
from PySide6.QtGui import QGuiApplication

from ...document.edits import EditError
from ...document.model import Document
from ...document.several_curves import active_after_removal, add_curves, named, remove_curves
from ...document.shape_edits import place_above
from ...exchange.table.clipboard import write_block
from ...storage.format import decode, encode
from ...storage.format_error import FormatError
from ...widgets.number_text import decimal_mark, exact_text
from ...workbench.clipboard import put_on_clipboard
from ...workbench.context import WindowContext

CURVES = "application/x-curvebench-curves"
"""MIME type of several curves: a document of them."""


class CurveClipboard:
    """Copies, cuts and pastes the selected curves; with one alone the clipboard is about its points."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session

    @property
    def has_several(self) -> bool:
        """Whether there are curves to copy: several are selected, and no point is selected."""
        return bool(self._session.selected.chosen) and not self._session.selection

    def copy(self) -> None:
        """Copy all selected curves."""
        session = self._session
        curves = tuple(session.document.curves[place] for place in sorted(session.selected.curves))
        mark = decimal_mark()
        tables = [
            write_block([[exact_text(number, mark) for number in point.position] for point in curve.points])
            for curve in curves
            if curve.points
        ]
        data = QMimeData()
        data.setData(CURVES, encode(Document(curves)))
        data.setText("\n".join(tables))
        put_on_clipboard(data)
        session.say(f"Copied {len(curves)} curves.")

    def cut(self) -> None:
        """Copy all selected curves and delete them."""
        session, document = self._session, self._session.document
        selected = session.selected.curves
        self.copy()
        session.change(
            f"Cut {named(document, selected)}",
            lambda document: remove_curves(document, selected),
            active=active_after_removal(document, selected, session.active_index),
        )

    def paste(self) -> bool:
        """Add the curves that were copied, in front of the active one; return whether there are any."""
        data = QGuiApplication.clipboard().mimeData() or QMimeData()  # None where nothing was ever copied
        if not data.hasFormat(CURVES):
            return False
        try:
            curves = decode(bytes(data.data(CURVES).data())).curves
        except FormatError as reason:
            raise EditError(f"The curves on the clipboard cannot be read: {reason}.") from None
        session = self._session
        first = place_above(session.document, session.active_index)
        pasted = add_curves(session.document, curves, first)
        if session.change(f"Paste {len(curves)} curves", lambda _: pasted, active=first):
            session.selected.set_curves(range(first, first + len(curves)))
            session.say(f"Pasted {len(curves)} curves; they are chosen.")
        return True
