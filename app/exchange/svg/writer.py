"""Documents as SVG, written from the core: cubic Hermite curves exactly, others within a tolerance."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from ... import __version__
from ...document.model import Document
from ...document.units import known_unit
from ...tasks.progress import Report, part, silent, told
from .. import drawing
from ..drawing.drawing import POINT_RADIUS, Annotation, Drawing, drawing_of, trimmed
from ..drawing.frames import Frame
from ..drawing.outlines import Outline
from ..drawing.styles import PictureStyle
from ..formats import Written
from ..options import DEFAULT, Options
from ..parts import stated
from ..rescaled import in_unit, shifted
from ..units import css_length
from .numbers import escaped, number
from .our_own import MARK
from .tree import Tree, dash_style, pair
from .xml_tree import INKSCAPE_SPACE, SODIPODI_SPACE

NOMINAL_SIDE = 800
"""Longer side, in CSS pixels, of a picture whose size nobody asked for."""

_ROUNDING = 1e-9
_SPACES = f'xmlns:inkscape="{INKSCAPE_SPACE}" xmlns:sodipodi="{SODIPODI_SPACE}"'


def svg_of(document: Document, options: Options = DEFAULT) -> Written:
    """Return a document as SVG.

    Coordinates are the document's own with y negated, in full precision but for noise (see `number`); of a
    part of a document they may be those from its upper left corner. A piece of a cubic Hermite curve is
    exactly one ``C`` of the path. Lagrange and quintic Hermite curves become as many cubics as the tolerance
    takes; the largest deviation stands in a comment and in the metadata. The curves of a shape are one path,
    in their groups and with its style; hidden ones are there, and not displayed.
    Points are discs in a group of their own. Without a width and a unit the longer side is `NOMINAL_SIDE`.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or if the coordinates are beyond what a picture can hold.
    """
    style, report = options.vector_style, part(options.report, 0.0, 0.7)
    drawing = picture_of(document, options, style, report, with_hidden=True)
    if options.from_corner:
        by = (-float(number(drawing.frame.left)), -float(number(drawing.frame.top)))
        drawing = _cornered(picture_of(shifted(document, by), options, style, silent, with_hidden=True))
    curves = _curves(drawing, style, part(options.report, 0.7, 1.0))
    text = _text(drawing, curves, style, options)
    return Written(text, drawing.deviation, drawing.left_out, drawing.is_bound)


def picture_of(
    document: Document,
    options: Options,
    style: PictureStyle,
    report: Report,
    *,
    with_hidden: bool = False,
) -> Drawing:
    """Return the drawing of a document with what else is to be drawn; see `svg_of`."""
    plain = drawing_of(document, options.tolerance, report, with_hidden=with_hidden)
    if not (options.handles or options.grid or options.basis is not None):
        return trimmed(plain) if options.is_to_scale and not options.points else plain
    # Views of basis functions and handles are no business of a plain drawing.
    return drawing.annotations.annotated(plain, document, options, style.theme)


def _cornered(drawing: Drawing) -> Drawing:
    """Return a drawing whose upper left corner is on the origin but for rounding with it right there."""
    frame = drawing.frame
    if max(abs(frame.left), abs(frame.top)) > _ROUNDING * frame.side:
        return drawing  # too far away for a document
    return replace(drawing, frame=replace(frame, left=0.0, bottom=-frame.height))


def nominal_width(drawing: Drawing, width: float | None) -> float:
    """Return the width in CSS pixels of a picture whose size is that asked for, or nobody's."""
    return NOMINAL_SIDE * drawing.frame.width / drawing.frame.side if width is None else width


def _text(drawing: Drawing, curves: Sequence[str], style: PictureStyle, options: Options) -> str:
    """Return a drawing, whose curves are written, as SVG."""
    frame = drawing.frame
    wide, high = _size_attributes(drawing, options.width, options.unit)
    box = " ".join(number(value) for value in (frame.left, -frame.top, frame.width, frame.height))
    note = accuracy_of(drawing)
    parts = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<!-- Curvebench {__version__}. {note} -->",
        f'<svg xmlns="http://www.w3.org/2000/svg" {_SPACES} width="{wide}" height="{high}" viewBox="{box}">',
        # No <desc>: Inkscape takes that for the description of a layer.
        f"  <metadata>{escaped(' '.join([note, *drawing.left_out]))}</metadata>",
        *([_paper(frame, style.paper)] if style.paper else []),
        *_annotations(drawing, style, "grid"),
        *curves,
        *_annotations(drawing, style, "handles"),
        *(_points(drawing, style) if options.points else []),
        *_annotations(drawing, style, "basis"),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _size_attributes(drawing: Drawing, width: float | None, unit: str) -> tuple[str, str]:
    """Return width and height: at true size in a unit, of that width in CSS pixels, or of the usual one."""
    frame, known = drawing.frame, known_unit(unit)
    if known and width is None:
        return css_length(frame.width, known), css_length(frame.height, known)
    wide = nominal_width(drawing, width)
    return f"{wide:.6g}", f"{wide * frame.height / frame.width:.6g}"


def accuracy_of(drawing: Drawing) -> str:
    """Return a sentence with the largest deviation of the drawing from the true curves."""
    missed = "" if drawing.deviation <= drawing.tolerance else ", which was out of reach"
    return (
        f"{MARK}: {stated(drawing.deviation, drawing.is_bound)} "
        f"(tolerance {drawing.tolerance:g}{missed}), in the unit of the document."
    )


def _paper(frame: Frame, colour: str) -> str:
    x, y, width, height = (number(v) for v in (frame.left, -frame.top, frame.width, frame.height))
    return f'  <rect id="paper" x="{x}" y="{y}" width="{width}" height="{height}" fill="{colour}"/>'


def _curves(drawing: Drawing, style: PictureStyle, report: Report) -> list[str]:
    """Return the elements of the curves, in lines."""
    tree = Tree(style, drawing.usual_width)
    for shape in told(drawing.all_shapes, report, "Writing"):
        tree.add(shape)
    tree.close()
    return tree.lines


def _points(drawing: Drawing, style: PictureStyle) -> list[str]:
    radius = number(POINT_RADIUS * drawing.frame.side)
    discs = [
        f'    <circle cx="{number(x)}" cy="{number(-y)}" r="{radius}"{_disc_colour(outline, style)}/>'
        for outline in drawing.outlines
        for x, y in outline.points.tolist()
    ]
    return [f'  <g id="points" fill="{style.ink}">', *discs, "  </g>"]


def _disc_colour(outline: Outline, style: PictureStyle) -> str:
    """Return the curve's own colour as an attribute; nothing where the picture's ink is meant."""
    return f' fill="{style.seen(outline.colour)}"' if outline.colour else ""


def _annotations(drawing: Drawing, style: PictureStyle, name: str) -> list[str]:
    """Return the group of lines with this name; nothing where there are none."""
    paths = [_strokes(each, style) for each in drawing.annotations if each.name == name]
    return [f'  <g id="{name}" fill="none" stroke-linejoin="round">', *paths, "  </g>"] if paths else []


def _strokes(annotation: Annotation, style: PictureStyle) -> str:
    data = " ".join(f"M {' L '.join(pair(point) for point in line.tolist())}" for line in annotation.lines)
    colour = style.seen(annotation.colour)
    opacity = f' opacity="{annotation.opacity:g}"' if annotation.opacity < 1 else ""
    if annotation.filled:
        return f'    <path d="{data}" fill="{colour}"{opacity}/>'
    dash = f' style="{dash_style(annotation.dash)}"' if annotation.dash else ""
    return (
        f'    <path d="{data}" stroke="{colour}" stroke-width="{number(annotation.width)}"{dash}{opacity}/>'
    )


def svg_for_clipboard(document: Document, report: Report = silent) -> Written:
    """Return a document as SVG whose coordinates are pixels; without a unit of length, one is a pixel.

    Inkscape 1.2 pastes the coordinates as they are, whatever the view box.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    return svg_of(in_unit(document, "px"), Options(unit="px", report=report))
