"""Pictures: in pixels, as a drawing, which is also read, and as a page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .. import drawing, svg
from ..cubics_in import ImportResult
from ..options import (
    BY_DPI,
    DECIMALS,
    DPI,
    PICTURE,
    SCALE,
    SVG_SCALE,
    SVG_WIDTH,
    TOLERANCE,
    TRUE_SIZE,
    WIDTH,
    Option,
)
from ..svg.writer import svg_of
from . import ContentKind, Format

_IDLE_IN_PIXELS: dict[bool | None, tuple[Option[Any], ...]] = {
    True: (WIDTH, SCALE),
    False: (SCALE, DPI),
    # Without a unit of length there is no inch.
    None: (BY_DPI, DPI),
}
"""Options that do nothing where the resolution says how many pixels there are, and where the width does."""

_IN_PIXELS = (BY_DPI, WIDTH, SCALE, DPI, *PICTURE[1:])


def _idle_in_svg(values: Mapping[str, Any]) -> tuple[Option[Any], ...]:
    """Return the options that do nothing where width or scale are set."""
    if values[SVG_WIDTH.name] is not None:
        return SVG_SCALE, TRUE_SIZE
    return () if values[SVG_SCALE.name] is None else (TRUE_SIZE,)


def read(data: bytes, tolerance: float | None) -> ImportResult:
    """Return the curves of a drawing, above the x axis; see `svg.reader.read_svg_above`."""
    return svg.reader.read_svg_above(data, tolerance)


# Qt is slow to import, and everything else does without: the lambdas ask for `drawing.image` when needed.
# ruff: noqa: PLW0108
PNG = Format(
    endings=(".png",),
    title="PNG picture",
    description="Pixels, for slides and web pages.",
    rank=10,
    options=_IN_PIXELS,
    hidden=lambda values: _IDLE_IN_PIXELS[values[BY_DPI.name]],
    write=lambda document, options: drawing.image.png_file(document, options),
    preview=lambda document, options, room: drawing.image.png_preview(document, options, room),
)
SVG = Format(
    endings=(".svg",),
    title="SVG drawing",
    description="Bézier curves in groups, a path for each shape; exact for cubic Hermite curves but circles.",
    rank=20,
    options=(*PICTURE, SVG_WIDTH, SVG_SCALE, DECIMALS, TOLERANCE),
    hidden=_idle_in_svg,
    write=svg_of,
    preview=lambda document, options, room: drawing.image.svg_preview(document, options, room),
    kind=ContentKind.DRAWING,
    read=read,
)
PDF = Format(
    endings=(".pdf",),
    title="PDF document",
    description="One page, sharp at every size.",
    rank=30,
    options=(*PICTURE, TOLERANCE),
    write=lambda document, options: drawing.image.pdf_file(document, options),
    preview=lambda document, options, room: drawing.image.pdf_preview(document, options, room),
)
