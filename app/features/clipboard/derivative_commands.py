"""Derivatives of a point on the clipboard."""

from __future__ import annotations

from collections.abc import Collection

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QMimeData

from ...actions.declaration import action, also
from ...actions.menus import EDIT_DERIVATIVES, POINT_MENU
from ...actions.needs import HERMITE_POINTS, Need
from ...actions.state import DERIVATIVES
from ...document import derivatives, point_edits
from ...document.model import Document, Point
from ...exchange.table.clipboard import write_block
from ...widgets.number_text import decimal_mark, exact_text
from ...workbench.clipboard import clipboard_data, put_on_clipboard
from ...workbench.context import WindowContext
from .keys import give_keys_to_drawing


class DerivativeCommands:
    """Copies the derivatives of a point, and gives them to others."""

    def __init__(self, context: WindowContext) -> None:
        self._session = context.session
        give_keys_to_drawing(context, DerivativeCommands)

    @action(
        "copyDerivatives",
        "Copy Derivatives",
        EDIT_DERIVATIVES,
        "Ctrl+Alt+C",
        needs=Need(
            "one selected point of a Hermite curve",
            lambda state: HERMITE_POINTS.is_met(state) and state.selected_count == 1,
        ),
    )
    @also(POINT_MENU(32))
    def _copy_derivatives(self) -> None:
        """Copy the derivatives of the selected point."""
        view, selected = self._session.active_view, self._session.selected.group.only_point
        if selected is None or not view.is_current:
            return
        index = selected[1]
        point = view.source.points[index]
        before, after = (
            [view.derivative_of(index, each.order, ahead=ahead) for each in derivatives.DERIVATIVES]
            for ahead in (False, True)
        )
        jet = Point(0.0, 0.0, corner=point.corner, tied=point.tied, even=point.even).with_derivatives(
            before, after
        )
        mark = decimal_mark()
        numbers = [number for vector in before if vector for number in vector]
        data = QMimeData()
        data.setData(DERIVATIVES, msgspec.json.encode(jet))
        data.setText(write_block([[exact_text(number, mark) for number in numbers]]))
        put_on_clipboard(data)
        self._session.say(f"Copied the derivatives of point {index}.")

    @action(
        "pasteDerivatives",
        "Paste Derivatives",
        EDIT_DERIVATIVES,
        "Ctrl+Alt+Shift+V",
        needs=Need(
            "copied derivatives, and selected points of a Hermite curve",
            lambda state: state.has_copied_derivatives,
        ),
    )
    @also(POINT_MENU(33))
    def _paste_derivatives(self) -> None:
        """Give the selected points the derivatives that were copied."""
        session, group = self._session, self._session.selected.group
        jet = _derivatives_on_clipboard()
        if jet is None:
            session.refuse("There are no derivatives on the clipboard; Copy Derivatives puts them there.")
            return

        def pasted(document: Document, curve: int, indices: Collection[int]) -> Document:
            points = list(document.curves[curve].points)
            for index in indices:
                points[index] = _with_derivatives(points[index], jet)
            return point_edits.set_points(document, curve, points)

        change = session.change(
            f"Paste derivatives to {group.words}", lambda document: group.changed(document, pasted)
        )
        if change:
            session.say(f"Pasted the derivatives into {group.words}.")


def _derivatives_on_clipboard() -> Point | None:
    data = clipboard_data()
    if not data.hasFormat(DERIVATIVES):
        return None
    try:
        return msgspec.json.decode(bytes(data.data(DERIVATIVES).data()), type=Point)
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None


def _with_derivatives(point: Point, jet: Point) -> Point:
    """Return `point` with the derivatives of `jet`; of a higher order it keeps its own."""
    copied = [each for each in derivatives.DERIVATIVES if getattr(jet, each.name) is not None]
    vectors = {name: getattr(jet, name) for each in copied for name in (each.name, each.after)}
    return replace(point, corner=jet.corner, tied=jet.tied, even=jet.even, **vectors)
