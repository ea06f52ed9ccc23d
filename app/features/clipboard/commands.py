"""Points and derivatives on the clipboard: between curves, windows, and with text from anywhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, Qt
from PySide6.QtGui import QGuiApplication

from ...actions.clipboard_watch import DERIVATIVES
from ...actions.declaration import action, also
from ...actions.needs import HERMITE_POINTS, POINTS_OR_CURVES, Need
from ...actions.sections import EDIT_CLIPBOARD, EDIT_COPY_AS
from ...actions.strips import CANVAS_MENU, POINT_MENU
from ...document import curve_edits, derivatives, edits
from ...document.edits import EditError
from ...document.model import Curve, Document, Point
from ...document.shape_edits import place_above
from ...document.words import count_of
from ...exchange.table.clipboard import Block, TableTextError, read_titled_block, write_block
from ...storage.format import decode, encode
from ...storage.format_error import FormatError
from ...view_model.pasting import (
    appended,
    appended_with_parameters,
    as_new_curve,
    copied,
    copied_as_new_curve,
    points_of_rows,
    refuse_unordered,
)
from ...view_model.point_columns import known_titles
from ...widgets.number_text import decimal_mark, exact_text
from ...workbench.clipboard import put_on_clipboard
from ...workbench.context import WindowContext
from .curve_clipboard import CurveClipboard

POINTS = "application/x-curvebench-points"
"""MIME type of points: a document of one curve that has these points only."""


class _Pasted(msgspec.Struct, frozen=True):
    """Content of the clipboard: points, whether they came as text, and the row they begin in.

    `note` goes on the sentence that tells what was pasted.
    """

    points: tuple[Point, ...]
    like: Curve | None = None
    first_row: int = 1
    note: str = ""


class ClipboardCommands:
    """Cut, copy and paste with the canvas in focus; the point table has its own for cells."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._session = context.session
        self._curves = CurveClipboard(context)
        for each in context.actions.declared_by(ClipboardCommands):
            # The point table and the fields of the panels use the same keys for what they show.
            each.setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            context.central.canvas.addAction(each)

    # Points

    @action(
        "cutPoints", "Cut", EDIT_CLIPBOARD, "Ctrl+X", "cut", full_name="Cut Points", needs=POINTS_OR_CURVES
    )
    @also(POINT_MENU(30))
    def _cut(self) -> None:
        """Copy the selected points, or the selected curves, and delete them."""
        session, selected = self._session, self._session.selection
        if self._curves.has_several:
            self._curves.cut()
        if not selected:
            return
        self._copy()
        if session.change(
            f"Cut {count_of(len(selected), 'point')}",
            lambda document: edits.delete_points(document, session.active_index, selected),
        ):
            session.selected.set_points([])
            session.say(f"Cut {count_of(len(selected), 'point')}.")

    @action(
        "copyPoints",
        "Copy",
        EDIT_CLIPBOARD,
        "Ctrl+C",
        "copy",
        full_name="Copy Points",
        needs=POINTS_OR_CURVES,
    )
    @also(POINT_MENU(31))
    def _copy(self) -> None:
        """Copy the selected points with their derivatives, or the selected curves."""
        view, selected = self._session.active_view, self._session.selection
        if self._curves.has_several:
            self._curves.copy()
        if not selected:
            return
        clip, mark = copied(view, selected), decimal_mark()
        rows = [
            [exact_text(number, mark) for number in _row(point, timed=view.source.is_manual)]
            for point in clip.points
        ]
        data = QMimeData()
        data.setData(POINTS, encode(Document((clip,))))
        data.setText(write_block(rows))
        put_on_clipboard(data)
        self._session.say(f"Copied {count_of(len(clip.points), 'point')}.")

    @action("pastePoints", "Paste", EDIT_CLIPBOARD, "Ctrl+V", "paste", full_name="Paste Points")
    @also(CANVAS_MENU(20))
    def _paste_points(self) -> None:
        """Append the points on the clipboard (two columns x y, or three t x y), or add the curves."""
        self._paste(self._append)

    @action("pasteAsCurve", "Paste as New Curve", EDIT_CLIPBOARD, "Ctrl+Shift+V")
    @also(CANVAS_MENU(21))
    def _paste_as_curve(self) -> None:
        """Make a curve of the points on the clipboard."""
        self._paste(self._add_curve)

    def _paste(self, put: Callable[[_Pasted], None]) -> None:
        try:
            if not self._curves.paste():
                put(_on_clipboard())
        except (EditError, TableTextError) as reason:
            self._session.refuse(str(reason))

    def _append(self, pasted: _Pasted) -> None:
        session, view = self._session, self._session.active_view
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

    def _add_curve(self, pasted: _Pasted) -> None:
        session = self._session
        place = place_above(session.document, session.active_index)
        name = curve_edits.free_name(session.document)
        if pasted.like is not None:
            curve = copied_as_new_curve(pasted.like, name)
        else:
            refuse_unordered(pasted.points, pasted.first_row) if pasted.points[0].t is not None else None
            curve = as_new_curve(session.active_curve, pasted.points, name)
        document = curve_edits.add_curve(session.document, place, curve)
        edits.set_points(document, place, curve.points)
        if session.change(f"Paste as {name}", lambda _: document, active=place):
            self._show_points()
            session.say(f"Pasted {count_of(len(curve.points), 'point')} as “{name}”{pasted.note}.")

    def _show_points(self) -> None:
        """Fit the view if points that were pasted lie outside it."""
        if not self._context.central.canvas.framing.shows_all_points:
            self._context.actions["fitView"].trigger()

    # Derivatives

    @action(
        "copyDerivatives",
        "Copy Derivatives",
        EDIT_COPY_AS,
        "Ctrl+Alt+C",
        needs=Need(
            "one selected point of a Hermite curve",
            lambda now: HERMITE_POINTS.is_met(now) and len(now.selection) == 1,
        ),
    )
    @also(POINT_MENU(32))
    def _copy_derivatives(self) -> None:
        """Copy the derivatives of the selected point."""
        view, index = self._session.active_view, self._session.selected.point
        if index is None or not view.is_current:
            return
        point = view.source.points[index]
        before, after = (
            [view.derivative_of(index, each.order, ahead=ahead) for each in derivatives.DERIVATIVES]
            for ahead in (False, True)
        )
        jet = Point(0.0, 0.0, corner=point.corner, tied=point.tied).with_derivatives(before, after)
        mark = decimal_mark()
        numbers = [number for vector in before for number in vector or ()]
        data = QMimeData()
        data.setData(DERIVATIVES, msgspec.json.encode(jet))
        data.setText(write_block([[exact_text(number, mark) for number in numbers]]))
        put_on_clipboard(data)
        self._session.say(f"Copied the derivatives of point {index}.")

    @action(
        "pasteDerivatives",
        "Paste Derivatives",
        EDIT_COPY_AS,
        "Ctrl+Alt+V",
        needs=Need(
            "copied derivatives, and selected points of a Hermite curve",
            lambda now: now.has_derivatives and bool(now.selection) and now.has_copied_derivatives,
        ),
    )
    @also(POINT_MENU(33))
    def _paste_derivatives(self) -> None:
        """Give the selected points the derivatives that were copied."""
        session, selected = self._session, self._session.selection
        jet = _derivatives_on_clipboard()
        if jet is None:
            session.refuse("There are no derivatives on the clipboard; Copy Derivatives puts them there.")
            return
        points = (
            _with_derivatives(point, jet) if index in selected else point
            for index, point in enumerate(session.active_curve.points)
        )
        what = f"point {next(iter(selected))}" if len(selected) == 1 else count_of(len(selected), "point")
        if session.change(
            f"Paste derivatives to {what}",
            lambda document: edits.set_points(document, session.active_index, points),
        ):
            session.say(f"Pasted the derivatives into {what}.")


def _row(point: Point, *, timed: bool) -> Sequence[float]:
    return (point.t, *point.position) if timed and point.t is not None else point.position


def _on_clipboard() -> _Pasted:
    """Return the points on the clipboard, as they were copied here or read from text."""
    data = QGuiApplication.clipboard().mimeData() or QMimeData()  # None where nothing was ever copied
    if data.hasFormat(POINTS):
        try:
            (curve, *_) = decode(bytes(data.data(POINTS).data())).curves
        except FormatError as reason:
            raise EditError(f"The points on the clipboard cannot be read: {reason}.") from None
        if curve.points:
            return _Pasted(curve.points, curve)
    text = data.text() if data.hasText() else ""
    block = read_titled_block(text, decimal_mark(), known_titles())
    # A row of titles was skipped.
    first_row = 1 + len(text.rstrip().splitlines()) - len(block.rows)
    note = "; the row of titles was skipped" if block.titles else ""
    return _Pasted(points_of_rows(_in_order(block)), first_row=first_row, note=note)


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
            f"Points are x y, or t x y; the titles are {' '.join(names)}. The point table takes them all."
        )
    places = [block.titles.index(name) for name in sorted(names)]
    return [[row[place] for place in places] for row in block.rows]


def _derivatives_on_clipboard() -> Point | None:
    data = QGuiApplication.clipboard().mimeData() or QMimeData()
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
    return replace(point, corner=jet.corner, tied=jet.tied, **vectors)


COMMAND_SETS = (ClipboardCommands,)
