"""Documents as tiles of patterns, and tiles as documents."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.gradient import Gradient, Tile
from ...document.layers import out_of_layers
from ...document.model import Document, Vector
from ...document.several_curves import mapped, whole_curves
from ...document.transforms import Affine
from ..errors import ExchangeError
from .cascade import Cascade
from .elements import Elements
from .matrices import box_of
from .reader import read_svg
from .tiles import TileBody
from .writer import svg_of
from .xml_tree import parsed

_BLACK = "#000000"


def tile_of(document: Document) -> Tile:
    """Return what lies on the page of a document as the tile of a pattern.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    root = parsed(svg_of(replace(out_of_layers(document), guides=())).data)
    box = box_of(root.get("viewBox", ""))
    if box is None:
        raise ExchangeError("It needs a width and a height.")
    return Tile(TileBody(Elements.within(root, Cascade(root).of)).of_elements(root), box)


def document_of(pattern: Gradient) -> Document:
    """Return what the tile of a pattern shows, where its first one lies, as curves.

    Raises
    ------
    ExchangeError
        If there are none in it.
    """
    if pattern.tile is None:
        raise ExchangeError("It is no pattern.")
    return _laid(pattern.tile, pattern.stops[0].colour or _BLACK, pattern.start, pattern.end, pattern.side)


def _laid(tile: Tile, colour: str, start: Vector, end: Vector, side: Vector) -> Document:
    left, top, width, height = tile.view
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width!r}" height="{height!r}" viewBox="{left!r} {top!r} {width!r} {height!r}">'
        f"{tile.body.replace('currentColor', colour)}</svg>"
    )
    found = read_svg(text.encode()).document
    page = found.page
    assert page is not None
    corner = (page.x, page.y + page.height)
    (x, y), (a, b), (c, d) = start, end, side
    # Its plane has y upwards, and the side is what leads down the tile.
    place = Affine(
        (a - x) / page.width - 1.0,
        -(c - x) / page.height,
        (b - y) / page.width,
        -(d - y) / page.height - 1.0,
        corner,
        (x - corner[0], y - corner[1]),
    )
    return mapped(found, whole_curves(found, range(len(found.curves))), place)
