"""Cut and copy: what is highlighted, to the clipboard."""

from __future__ import annotations

from collections.abc import Sequence

from ...actions.declaration import action, also
from ...actions.menus import CHOSEN_MENU, CURVE_LIST_MENU, CURVE_MENU, EDIT_CLIPBOARD, POINT_MENU
from ...actions.needs import HIGHLIGHTED
from ...document.limits import EditError
from ...document.model import Curve, Document, Point
from ...exchange.table.clipboard import write_block
from ...session.highlight import ClipboardSelection
from ...view_model.paste import copied, parts_of
from ...widgets.number_text import decimal_mark, exact_text
from ...workbench.clipboard import CURVES, POINTS, put_on_clipboard
from ...workbench.context import WindowContext
from ...workbench.highlight import highlighted, remove
from .derivative_commands import DerivativeCommands
from .highlight_commands import HighlightCommands
from .keys import give_keys_to_drawing
from .offer import Offer
from .paste_commands import PasteCommands


class ClipboardCommands:
    """Cut and copy, with the canvas or the list of curves in focus; the point table has its own for cells."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        give_keys_to_drawing(context, ClipboardCommands)

    @action("cutPoints", "Cut", EDIT_CLIPBOARD, "Ctrl+X", "cut", needs=HIGHLIGHTED)
    @also(POINT_MENU(30), CURVE_MENU(18), CHOSEN_MENU(10), CURVE_LIST_MENU(36))
    def _cut(self) -> None:
        """Copy the selected points, or else the curve or all chosen ones, and delete them."""
        session = self._session
        what = highlighted(self._context).changeable(session.document)
        offer, words = self._offer(what), what.told(session.document)
        # What is locked stays, and leaves on the clipboard what is there.
        if remove(self._context, what, "Cut"):
            put_on_clipboard(offer)
            session.say(f"Cut {words}.")

    @action("copyPoints", "Copy", EDIT_CLIPBOARD, "Ctrl+C, Ctrl+Ins", "copy", needs=HIGHLIGHTED)
    @also(POINT_MENU(31), CURVE_MENU(19), CHOSEN_MENU(11), CURVE_LIST_MENU(37))
    def _copy(self) -> None:
        """Copy the selected points with their derivatives, or else the curve or all chosen ones."""
        what = highlighted(self._context)
        put_on_clipboard(self._offer(what))
        self._session.say(f"Copied {what.said(self._session.document)}.")

    def _offer(self, what: ClipboardSelection) -> Offer:
        """Return the offer: for other programs, of points a table, of curves an SVG."""
        session, mark = self._session, decimal_mark()
        if len(what.points.parts) != 1:
            return Offer(CURVES, Document(self._copied_curves(what), unit=session.document.unit))
        ((curve, indices),) = what.points.parts
        view = session.views[curve]
        clip = copied(view, indices)
        rows = [
            [exact_text(number, mark) for number in _row(point, timed=view.source.is_manual)]
            for point in clip.points
        ]
        return Offer(POINTS, Document((clip,), unit=session.document.unit), write_block(rows))

    def _copied_curves(self, what: ClipboardSelection) -> tuple[Curve, ...]:
        """Return the curves, or what the points of several are curves of."""
        session = self._session
        if not what.points.parts:
            return tuple(session.document.curves[place] for place in sorted(what.curves))
        parts = parts_of(session.views, what.points)
        if not parts:
            raise EditError("One point is no curve: select two of a curve, or more, to copy them.")
        return tuple(parts)


def _row(point: Point, *, timed: bool) -> Sequence[float]:
    return (point.t, *point.position) if timed and point.t is not None else point.position


COMMAND_SETS = (ClipboardCommands, PasteCommands, HighlightCommands, DerivativeCommands)
