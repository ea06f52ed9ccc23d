"""Content of the clipboard: curves or points of ours, SVG from elsewhere, or numbers."""

from __future__ import annotations

import msgspec
from PySide6.QtCore import QMimeData

from ...document.limits import EditError
from ...document.model import Curve, Point
from ...exchange.table.clipboard import Block, read_titled_block
from ...storage.format import Decoded, decode_counting
from ...storage.format_error import FormatError
from ...view_model.paste import points_of_rows
from ...view_model.point_columns import known_titles
from ...widgets.number_text import decimal_mark
from ...workbench.clipboard import CURVES, POINTS
from .offer import Offer


class PointsContent(msgspec.Struct, frozen=True):
    """Points, and the row of the text that they begin in.

    `like` is the curve that they were copied from, in `unit`; `note` goes on the sentence that tells what
    was pasted.
    """

    points: tuple[Point, ...]
    like: Curve | None = None
    unit: str = ""
    first_row: int = 1
    note: str = ""


def curves_in(data: QMimeData) -> Decoded | None:
    """Return the curves that were copied in this program, with the unit they are in, and what is left out.

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
    found = _document(data, POINTS, "points")
    if found is not None and (curve := found.document.curves[0]).points:
        return PointsContent(curve.points, curve, found.document.unit)
    text = data.text() if data.hasText() else ""
    block = read_titled_block(text, decimal_mark(), known_titles())
    # A row of titles was skipped.
    first_row = 1 + len(text.rstrip().splitlines()) - len(block.rows)
    note = "; the row of titles was skipped" if block.titles else ""
    return PointsContent(tuple(points_of_rows(_in_order(block))), first_row=first_row, note=note)


def _document(data: QMimeData, kind: str, what: str) -> Decoded | None:
    if not data.hasFormat(kind):
        return None
    if isinstance(data, Offer) and (document := data.document_of(kind)) is not None:
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
            f"Points are x y, or t x y; the titles are {' '.join(names)}. The point table takes them all."
        )
    places = [block.titles.index(name) for name in sorted(names)]
    return [[row[place] for place in places] for row in block.rows]
