"""PNG and JPEG files as pictures of a drawing: embedded, at their natural size."""

from __future__ import annotations

from base64 import b64encode

from .. import exchange
from ..document.content import MOST_DATA, Picture
from ..document.edits import EditError
from ..document.form_edits import framed
from ..document.model import Curve, Document, Vector
from ..qt.picture_data import ImageFileError, upright

USUAL_DENSITY = 96.0
"""Pixels to the inch of a picture that does not say how many."""

_BYTES = MOST_DATA // 4 * 3


def picture_curve(data: bytes, name: str, title: str, document: Document) -> Curve:
    """Return the frame of a picture in the unit of a document, its lower left corner at the origin.

    Parameters
    ----------
    data
        A PNG or JPEG file.
    name
        What it is called on the canvas.
    title
        What it is called where it is refused.

    Raises
    ------
    EditError
        For what is no such picture, is broken, too large, or more than a drawing holds.
    """
    try:
        data = upright(data, title)
    except ImageFileError as problem:
        raise EditError(str(problem)) from None
    size = exchange.picture_sizes.size_of(data)
    if size is None:
        raise EditError(f"{title} is broken: its head does not say how large it is.")
    text = b64encode(data).decode()
    held = sum(len(each.form.data) for each in document.curves if isinstance(each.form, Picture))
    if held + len(text) > MOST_DATA:
        there = f", and there are {_megabytes(held // 4 * 3)} in it" if held else ""
        raise EditError(
            f"{title} takes {_megabytes(len(data))}; a drawing holds {_megabytes(_BYTES)} of pictures"
            f"{there}. Make it smaller first."
        )
    width, height = _fitted(_natural(size, exchange.picture_sizes.density_of(data), document), document)
    corners = [(0.0, height), (width, height), (width, 0.0), (0.0, 0.0)]
    return framed(Picture(0.0, 0.0, width, height, text), corners, name)


def _natural(size: Vector, density: Vector | None, document: Document) -> Vector:
    """Return how large so many pixels are in a document, whose unit is a pixel where it is no length."""
    across, up = density or (USUAL_DENSITY, USUAL_DENSITY)
    units = exchange.units
    inch = units.MILLIMETRES["in"] / units.MILLIMETRES[units.known_unit(document.unit) or "px"]
    return size[0] / across * inch, size[1] / up * inch


def _fitted(size: Vector, document: Document) -> Vector:
    """Return a size, or as much of it as the page has room for."""
    (width, height), page = size, document.page
    if page is None:
        return size
    scale = min(1.0, page.width / width, page.height / height)
    return width * scale, height * scale


def _megabytes(count: int) -> str:
    return f"{count / 1e6:.3g} MB"
