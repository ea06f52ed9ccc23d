"""Documents as tiles of patterns, and tiles as documents."""

from __future__ import annotations

from msgspec.structs import replace

from ...document.gradient import Gradient, Tile
from ...document.layers import out_of_layers
from ...document.model import Document
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
        raise ExchangeError("A pattern needs a width and a height.")
    return Tile(TileBody(Elements.within(root, Cascade(root).of)).of_elements(root), box)


def document_of(pattern: Gradient) -> Document:
    """Return what the tile of a pattern shows, where its first one lies, as curves.

    Raises
    ------
    ExchangeError
        If there are none in it.
    """
    tile = pattern.tile
    if tile is None:
        raise ExchangeError("It is no pattern.")
    left, top, width, height = tile.view
    colour = pattern.stops[0].colour or _BLACK
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width!r}" height="{height!r}" viewBox="{left!r} {top!r} {width!r} {height!r}">'
        f"{tile.body.replace('currentColor', colour)}</svg>"
    )
    found = read_svg(text.encode()).document
    page = found.page
    assert page is not None
    corner = (page.x, page.y + page.height)
    (a, b), (c, d) = pattern.axes
    # Its plane has y upwards, and the side of a pattern is what leads down the tile.
    place = Affine(
        a / page.width - 1.0,
        -c / page.height,
        b / page.width,
        -d / page.height - 1.0,
        corner,
        (pattern.start[0] - corner[0], pattern.start[1] - corner[1]),
    )
    return mapped(found, whole_curves(found, range(len(found.curves))), place)
