"""Cut, copy, duplicate and delete, of the selected points or else of curves; derivatives of a point."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QMimeData

from ...actions.declaration import action, also
from ...actions.menus import (
    CURVE_LIST_MENU,
    CURVE_MENU,
    EDIT_CLIPBOARD,
    EDIT_DELETE,
    EDIT_DERIVATIVES,
    POINT_MENU,
    POINTS_NUMBER,
    WHOLES_MENU,
)
from ...actions.needs import HERMITE_POINTS, HIGHLIGHTED, Need
from ...actions.state import DERIVATIVES
from ...document import derivatives, point_edits
from ...document.limits import EditError
from ...document.model import Curve, Document, Point
from ...document.selection import all_points
from ...document.several_curves import name_or_count
from ...exchange.table.clipboard import write_block
from ...session.selection import ClipboardSelection
from ...view_model.paste import copied, parts_of, with_parts
from ...widgets.number_text import decimal_mark, exact_text
from ...workbench.clipboard import CURVES, POINTS, clipboard_data, put_on_clipboard
from ...workbench.context import CommandSet, WindowContext
from ...workbench.highlight import highlighted, remove
from .clipboard_content import ClipboardContent
from .paste_commands import PasteCommands, give_keys_to_drawing


class ClipboardCommands:
    """Cut and copy, with the canvas or the list of curves in focus; the point table has its own."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        give_keys_to_drawing(context, ClipboardCommands)

    @action("cutPoints", "Cut", EDIT_CLIPBOARD, "Ctrl+X", "cut", needs=HIGHLIGHTED)
    @also(POINT_MENU(30), CURVE_MENU(18), WHOLES_MENU(10), CURVE_LIST_MENU(36))
    def _cut(self) -> None:
        """Cut the selected points, or the selected curves if no points are selected."""
        session = self._session
        what = highlighted(self._context).unlocked(session.document)
        offer, words = self._content_of(what), what.label_with_remark(session.document)
        # Locked curves stay, and then the clipboard stays unchanged.
        if remove(self._context, what, "Cut"):
            put_on_clipboard(offer)
            session.say(f"Cut {words}.")

    @action("copyPoints", "Copy", EDIT_CLIPBOARD, "Ctrl+C, Ctrl+Ins", "copy", needs=HIGHLIGHTED)
    @also(POINT_MENU(31), CURVE_MENU(19), WHOLES_MENU(11), CURVE_LIST_MENU(37))
    def _copy(self) -> None:
        """Copy the selected points with their derivatives, or else the selected curves."""
        what = highlighted(self._context)
        put_on_clipboard(self._content_of(what))
        self._session.say(f"Copied {what.label_in_sentence(self._session.document)}.")

    def _content_of(self, what: ClipboardSelection) -> ClipboardContent:
        """Return the content: for other programs, points as a table and curves as SVG."""
        session, mark = self._session, decimal_mark()
        if len(what.points.parts) != 1:
            return ClipboardContent(CURVES, self._copied(*self._copied_curves(what)))
        ((curve, indices),) = what.points.parts
        view = session.views[curve]
        clip = copied(view, indices)
        rows = [
            [exact_text(number, mark) for number in _row(point, timed=view.source.is_manual)]
            for point in clip.points
        ]
        return ClipboardContent(POINTS, self._copied(clip), write_block(rows))

    def _copied(self, *curves: Curve) -> Document:
        document = self._session.document
        return Document(curves, unit=document.unit, paper=document.paper)

    def _copied_curves(self, what: ClipboardSelection) -> tuple[Curve, ...]:
        """Return the selected curves, or curves of the selected points."""
        session = self._session
        if not what.points.parts:
            return tuple(session.document.curves[index] for index in sorted(what.curves))
        parts = parts_of(session.views, what.points)
        if not parts:
            raise EditError("Select at least two points of a curve to copy them.")
        return tuple(parts)


def _row(point: Point, *, timed: bool) -> Sequence[float]:
    return (point.t, *point.position) if timed and point.t is not None else point.position


class HighlightCommands(CommandSet):
    """Duplicate and delete."""

    @action("duplicateSelection", "Duplicate", EDIT_CLIPBOARD, "Ctrl+D", "duplicate", needs=HIGHLIGHTED)
    @also(POINT_MENU(34))
    def _duplicate(self) -> None:
        """Duplicate the segments between the selected points, or else the selected curves."""
        session, what = self._session, highlighted(self._context)
        parts = parts_of(session.views, what.points)
        if all(part in session.document.curves for part in parts):
            # A single point, or all points of a curve: duplicate the curve itself.
            self._context.actions["duplicateCurve"].trigger()
            return
        arrival, words = with_parts(session.document, parts, session.active_index), what.points.count_label
        if session.change(f"Duplicate {words}", lambda _: arrival.document, active=arrival.indices.start):
            session.selected.set_curves(arrival.indices)
            session.selected.set_group(all_points(session.document, session.selected.active_curves))
            name = name_or_count(session.document, arrival.indices)
            it = f"“{name}”, which lies" if len(parts) == 1 else f"{name}, which lie"
            session.say(f"{words} as {it} on the original; drag one to move it.")

    @action("deleteSelection", "Delete", EDIT_DELETE, "Del, Backspace", "delete", needs=HIGHLIGHTED)
    @also(POINT_MENU(40))
    def _delete(self) -> None:
        """Delete the selected points, keeping the shape, or else the selected curves."""
        session = self._session
        what = highlighted(self._context).unlocked(session.document)
        words = what.label_with_remark(session.document)
        if remove(self._context, what, "Delete") and not what.points.parts:
            session.say(f"Deleted {words}.")

    @action(
        "deleteLeavingHandles",
        "Delete, Leaving the Handles",
        POINTS_NUMBER,
        "Ctrl+Del",
        needs=Need("selected points", lambda state: state.selected_count > 0),
        keywords="nodes without keeping the shape",
    )
    def _delete_plainly(self) -> None:
        """Delete the selected points; the handles beside them stay unchanged."""
        remove(self._context, self._session.selected.for_clipboard(), "Delete", keeps_shape=False)


class DerivativeCommands:
    """Copy and paste of derivatives."""

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
            [
                view.derivative_of(index, derivative.order, ahead=ahead)
                for derivative in derivatives.DERIVATIVES
            ]
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
        """Apply the copied derivatives to the selected points."""
        session, group = self._session, self._session.selected.group
        jet = _derivatives_on_clipboard()
        if jet is None:
            session.refuse("There are no derivatives on the clipboard. Copy some with Copy Derivatives.")
            return

        def pasted(document: Document, curve: int, indices: Collection[int]) -> Document:
            points = list(document.curves[curve].points)
            for index in indices:
                points[index] = _with_derivatives(points[index], jet)
            return point_edits.set_points(document, curve, points)

        change = session.change(
            f"Paste derivatives to {group.label}", lambda document: group.apply(document, pasted)
        )
        if change:
            session.say(f"Pasted the derivatives into {group.label}.")


def _derivatives_on_clipboard() -> Point | None:
    data = clipboard_data()
    if not data.hasFormat(DERIVATIVES):
        return None
    try:
        return msgspec.json.decode(bytes(data.data(DERIVATIVES).data()), type=Point)
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None


def _with_derivatives(point: Point, jet: Point) -> Point:
    """Return `point` with the derivatives of `jet`; higher orders stay."""
    copied = [kind for kind in derivatives.DERIVATIVES if getattr(jet, kind.name) is not None]
    vectors = {name: getattr(jet, name) for kind in copied for name in (kind.name, kind.after)}
    return replace(point, corner=jet.corner, tied=jet.tied, even=jet.even, **vectors)


COMMAND_SETS = (ClipboardCommands, PasteCommands, HighlightCommands, DerivativeCommands)
