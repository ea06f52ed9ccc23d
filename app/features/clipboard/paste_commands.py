"""Paste: points, curves and drawings, at the pointer or in place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtWidgets import QWidget

from ... import exchange
from ...actions.declaration import action, also
from ...actions.keymap import key_or_name
from ...actions.menus import CANVAS_MENU, CURVE_LIST_MENU, EDIT_CLIPBOARD, EDIT_DERIVATIVES, WHOLES_MENU
from ...canvas.fitting import box_of
from ...document import curve_edits, point_edits
from ...document.limits import EditError
from ...document.model import Curve, Point, Vector
from ...document.several_curves import common_name, is_blank, name_or_count
from ...document.words import count_of
from ...exchange.table.clipboard import Block, TableTextError, read_titled_block
from ...storage.format import Decoded, decode_counting
from ...storage.format_error import FormatError
from ...storage.validation import prevalidate
from ...tasks.progress import Report, part, silent
from ...view_model.paste import (
    AddedCurves,
    PasteTarget,
    appended,
    appended_with_parameters,
    as_new_curve,
    copied_as_new_curve,
    points_of_rows,
    refuse_unordered,
)
from ...view_model.point_columns import known_titles
from ...widgets.number_text import decimal_mark
from ...workbench.clipboard import CURVES, POINTS, clipboard_data, drawing_in, holds_picture
from ...workbench.context import WindowContext
from .clipboard_content import ClipboardContent

if TYPE_CHECKING:
    from ...exchange.cubics_in import ImportResult

_NO_CURVE = "A picture is not a curve. To trace it, use File › Reference Image."
_MANY_POINTS = 200
"""Points of curves that are worked out beside the window."""

_SPECK = 24
"""Pixels of the longer side of a drawing that is too small to be seen."""


class PasteCommands:
    """Paste from the clipboard, and drops of drawings."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        give_keys_to_drawing(context, PasteCommands)

    @action("pastePoints", "Paste", EDIT_CLIPBOARD, "Ctrl+V, Shift+Ins", "paste")
    @also(CANVAS_MENU(20), WHOLES_MENU(12), CURVE_LIST_MENU(38))
    def _paste_here(self) -> None:
        """Paste curves or SVG at the pointer; points (x y, or t x y) are appended to the curve."""
        position = self._context.central.canvas.pointed_position
        self._paste(position, partial(self._append, position))

    @action("pasteInPlace", "Paste in Place", EDIT_CLIPBOARD, "Ctrl+Alt+V")
    @also(CANVAS_MENU(21))
    def _paste_in_place(self) -> None:
        """Paste curves or SVG at their original position; points are appended to the curve."""
        self._paste(None, partial(self._append, None))

    @action("pasteAsCurve", "Paste as New Curve", EDIT_DERIVATIVES, "Ctrl+Alt+N")
    @also(CANVAS_MENU(22))
    def _paste_as_curve(self) -> None:
        """Create a curve from the points on the clipboard."""
        self._paste(self._context.central.canvas.pointed_position, self._add_curve)

    def _paste(self, position: Vector | None, add_points: Callable[[PointsContent], None]) -> None:
        data = clipboard_data()
        try:
            if not self._add_drawing_in(data, position):
                self._add_points_in(data, add_points)
        except (EditError, TableTextError) as reason:
            self._session.refuse(str(reason))

    def _add_points_in(self, data: QMimeData, add_points: Callable[[PointsContent], None]) -> None:
        try:
            points = points_in(data)
        except TableTextError:
            # A spreadsheet also offers a picture of its cells; then numbers are expected.
            if holds_picture(data):
                raise EditError(_NO_CURVE) from None
            raise
        add_points(points)

    def holds_drawing(self, data: QMimeData) -> bool:
        """Whether dragged data hold a drawing, or curves of this program."""
        return data.hasFormat(CURVES) or drawing_in(data) is not None

    def paste_dropped(self, data: QMimeData, position: Vector) -> None:
        """Add a drawing that was dropped at a position."""
        try:
            self._add_drawing_in(data, position)
        except EditError as reason:
            self._session.refuse(str(reason))

    def _add_drawing_in(self, data: QMimeData, position: Vector | None) -> bool:
        """Add the curves or the drawing in `data`, at a position or their own; return whether there are any.

        Raises
        ------
        EditError
            If curves cannot be read.
        """
        if decoded := curves_in(data):
            count = sum(len(curve.points) for curve in decoded.document.curves)
            self._import(partial(_import_result, decoded), position, count)
            return True
        if (fragment := drawing_in(data)) is None:
            return False
        is_first = is_blank(self._session.committed)
        # Path data keep their numbers where no other curve says where to look for them.
        self._import(
            lambda report: exchange.svg.fragments.read_fragment(fragment, report),
            None if fragment.is_bare and is_first else position,
            fits=fragment.is_bare or is_first,
        )
        return True

    # Curves

    def _import(
        self,
        read: Callable[[Report], ImportResult],
        position: Vector | None,
        points: int = _MANY_POINTS,
        *,
        fits: bool = False,
    ) -> None:
        """Read curves beside the window, and add them to the open document; few `points` at once.

        With `fits` the view shows all of them, whatever their size.
        """
        origin, target = self._session.files.origin, self._target(position)

        def work(report: Report) -> tuple[ImportResult, AddedCurves]:
            result = read(part(report, 0.0, 0.5))
            return result, _filled(target, result, lambda share: report(0.5 + share / 2, "Computing curves"))

        def done(work_result: tuple[ImportResult, AddedCurves]) -> None:
            result, arrival = work_result
            now = replace(self._target(position), pixel=target.pixel)
            if self._session.files.origin is not origin:
                self._session.refuse("Not pasted because another document was opened in the meantime.")
            else:
                self._add(arrival if now == target else _filled(now, result), result.remarks, fits=fits)

        if points < _MANY_POINTS:
            result = read(silent)
            self._add(_filled(target, result), result.remarks, fits=fits)
        else:
            self._context.work.start("Reading the drawing", work, done, Path("The drawing"), "pasted")

    def _target(self, position: Vector | None) -> PasteTarget:
        session, pixel = self._session, self._context.central.canvas.camera.pixel_size
        return PasteTarget(session.committed, position, pixel, session.views)

    def _add(self, arrival: AddedCurves, remarks: Sequence[str], *, fits: bool) -> None:
        session, indices = self._session, arrival.indices
        document, canvas = arrival.document, self._context.central.canvas
        framing = canvas.framing
        name, style = name_or_count(document, indices), session.template_curve.style
        session.expect(arrival.views)
        with session.batch:
            if not session.change(f"Paste {name}", lambda _: document, active=indices.start):
                return
            session.selected.select_imported(indices, style)
        is_one = common_name(document, indices) is not None
        message = f"Pasted “{name}”; it is selected." if is_one else f"Pasted {name}; they are selected."
        it, is_visible = ("it" if is_one else "them"), framing.shows_curves(indices)
        box = box_of([session.views[index] for index in indices])
        is_speck = box is None or (box.high - box.low).max() < _SPECK * canvas.camera.pixel_size
        if fits and (is_speck or not is_visible):
            self._fit("fitSelection")
            message = f"{message} The view was changed to show all of {it}."
        elif not is_visible:
            # The view does not move while somebody works in it.
            key = key_or_name(self._context.actions["fitSelection"])
            part = f"Part of {it} is outside the view"
            message = f"{message} {part}; {key} shows the selection."
        session.say(message)
        self._context.work.warn_of(remarks)

    # Points

    def _append(self, position: Vector | None, pasted: PointsContent) -> None:
        session, view = self._session, self._session.active_view
        if not session.selected.is_editing:
            # There is no active curve to append to.
            self._add_curve(pasted)
            return
        count = len(view.source.points)
        if pasted.like is None and pasted.points[0].t is not None:
            curve = appended_with_parameters(view, pasted.points, pasted.first_row)
        else:
            curve = appended(view, pasted.points)
        if session.change(
            f"Paste {count_of(len(pasted.points), 'point')}",
            lambda document: curve_edits.replace_curve(document, session.active_index, curve),
        ):
            session.selected.set_points(range(count, count + len(pasted.points)))
            self._show_points()
            session.say(f"Pasted {count_of(len(pasted.points), 'point')}{pasted.note}.")

    def _add_curve(self, pasted: PointsContent) -> None:
        session = self._session
        index = len(session.document.curves)
        name = curve_edits.unused_name(session.document)
        if pasted.like is not None:
            curve = copied_as_new_curve(pasted.like, name)
        else:
            refuse_unordered(pasted.points, pasted.first_row) if pasted.points[0].t is not None else None
            curve = as_new_curve(session.active_curve, pasted.points, name)
        document = curve_edits.add_curve(session.document, index, replace(curve, shape="", groups=()))
        point_edits.set_points(document, index, curve.points)
        if session.change(f"Paste as {name}", lambda _: document, active=index):
            self._show_points()
            session.say(f"Pasted {count_of(len(curve.points), 'point')} as “{name}”{pasted.note}.")

    def _show_points(self) -> None:
        """Fit the view if pasted points lie outside it."""
        if not self._context.central.canvas.framing.shows_all_points:
            self._fit("fitView")

    def _fit(self, action: str) -> None:
        """Fit the view; undo of the paste brings it back."""
        camera = self._context.central.canvas.camera
        before = camera.ranges
        self._context.actions[action].trigger()
        self._session.history.note_scroll((before, camera.ranges))


def _import_result(decoded: Decoded, _report: Report) -> ImportResult:
    remarks = (decoded.left_out.message_about("The clipboard content"),) if decoded.left_out else ()
    return exchange.cubics_in.ImportResult(decoded.document, remarks=remarks)


def _filled(
    target: PasteTarget, result: ImportResult, report: Callable[[float], object] | None = None
) -> AddedCurves:
    """Return the target with the imported curves, in the unit of the document."""
    sized = exchange.units.in_unit(result.document, target.document.unit)
    added = target.filled(sized.curves, report)
    if report is not None:
        prevalidate(target.document, added.document)
    return added


# Content of the clipboard


class PointsContent(msgspec.Struct, frozen=True):
    """Points, and the first row of their text.

    `like` is the curve that they were copied from, in `unit`; `note` is appended to the message about
    the paste.
    """

    points: tuple[Point, ...]
    like: Curve | None = None
    unit: str = ""
    first_row: int = 1
    note: str = ""


def curves_in(data: QMimeData) -> Decoded | None:
    """Return the curves that were copied in this program, with their unit and the content left out.

    Raises
    ------
    EditError
        If they cannot be read.
    """
    return _document(data, CURVES, "curves")


def points_in(data: QMimeData) -> PointsContent:
    """Return points, as they were copied here or read from text.

    Raises
    ------
    EditError
        If they cannot be read, or the columns are something else.
    TableTextError
        If the text holds no numbers, with the row and the column.
    """
    decoded = _document(data, POINTS, "points")
    if decoded is not None and (curve := decoded.document.curves[0]).points:
        return PointsContent(curve.points, curve, decoded.document.unit)
    text = data.text() if data.hasText() else ""
    block = read_titled_block(text, decimal_mark(), known_titles())
    # A row of titles was skipped.
    first_row = 1 + len(text.rstrip().splitlines()) - len(block.rows)
    note = "; the row of titles was skipped" if block.titles else ""
    return PointsContent(tuple(points_of_rows(_in_order(block))), first_row=first_row, note=note)


def _document(data: QMimeData, kind: str, what: str) -> Decoded | None:
    if not data.hasFormat(kind):
        return None
    if isinstance(data, ClipboardContent) and (document := data.document_of(kind)) is not None:
        return Decoded(document)
    try:
        return decode_counting(bytes(data.data(kind).data()))
    except FormatError as reason:
        raise EditError(f"The {what} on the clipboard cannot be read: {reason}.") from None


def _in_order(block: Block) -> list[list[float]]:
    """Return the rows of points with the columns that titles name in the order t x y.

    Raises
    ------
    EditError
        If the titles name something else.
    """
    names = [title for title in block.titles if title != "#"]
    if not names:
        return block.rows
    if sorted(names) not in (["x", "y"], ["t", "x", "y"]):
        raise EditError(
            f"Points have the columns x y or t x y, but the titles are {' '.join(names)}. "
            "Paste other columns into the point table."
        )
    columns = [block.titles.index(name) for name in sorted(names)]
    return [[row[column] for column in columns] for row in block.rows]


def give_keys_to_drawing(context: WindowContext, commands: type) -> None:
    """Restrict the keys of a command set to the canvas and to panels without keys of their own."""
    table = context.docks["pointsDock"]
    owners: list[QWidget] = [
        context.central.canvas,
        *(dock for dock in context.docks.all if dock is not table),
    ]
    for key_action in context.actions.declared_by(commands):
        key_action.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        for owner in owners:
            owner.addAction(key_action)
