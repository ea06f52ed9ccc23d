"""Documents as SVG: cubic Hermite curves exactly, all others within a tolerance.

`svg_of` writes a document; `Tree` writes its paths in their groups, with names, ids and styles.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable, Iterator, Sequence

from msgspec.structs import replace

from ... import __version__
from ...document.lengths import MILLIMETRES, known_unit
from ...document.model import Document
from ...document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from ...tasks.progress import Report, part, silent, with_progress
from .. import drawing
from ..cubics_in import guessed_letters, joined_letters
from ..drawing.drawing import (
    POINT_RADIUS,
    Annotation,
    Circle,
    Drawing,
    circle_of,
    drawing_of,
    rounded,
    trimmed_to_curves,
)
from ..drawing.outlines import Frame, Outline, are_lines
from ..drawing.styles import INK, ON_PAPER, PictureStyle
from ..exported_curves import deviation_text
from ..formats import ExportResult
from ..options import DECIMALS, DEFAULT, SVG_SCALE, SVG_WIDTH, Options
from ..unique_names import UniqueNames
from ..units import enlarged, factor_between, in_unit, shifted
from .own_files import MARK, NO_CURVES
from .xml_tree import INKSCAPE_SPACE, SODIPODI_SPACE

NOMINAL_SIDE, SMALLEST_ICON = 800, 24
"""Longer sides in CSS pixels: of a picture that would be smaller than the smallest icons, and theirs."""

_CORNER_ROUNDING = 1e-9
_SCALE_ROUNDING = 1e-9
_CSS_UNITS = ("mm", "cm", "in", "pt", "pc", "px")
_SPACES = f'xmlns:inkscape="{INKSCAPE_SPACE}" xmlns:sodipodi="{SODIPODI_SPACE}"'


def svg_of(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return a document as SVG.

    Coordinates are the document's own with y negated, in full precision but for noise (see `number`); of a
    part of a document they may be those from its upper left corner. A piece of a cubic Hermite curve is
    exactly one ``C`` of the path. Lagrange and quintic Hermite curves become as many cubics as the tolerance
    takes; the largest deviation stands in a comment and in the metadata. The curves of a shape are one path,
    a circle of four quarters is a circle, in their groups and with its style; hidden ones are written, but
    not displayed. Points are discs in a group of their own. The size is that of `pixels_per_unit`, or the
    true one.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or if the coordinates are out of range for a picture.
    """
    options = with_size(options)
    style, report = options.vector_style, part(options.report, 0.0, 0.7)
    drawing = picture_of(document, options, style, report, with_hidden=True)
    if options.from_corner:
        by = (-float(number(drawing.frame.left)), -float(number(drawing.frame.top)))
        drawing = _with_corner_at_origin(
            picture_of(shifted(document, by), options, style, silent, with_hidden=True)
        )
    if options[DECIMALS] != DECIMALS.default:
        scale = 1.0 if options.is_to_scale else pixels_per_unit(drawing.frame, options)
        drawing = rounded(drawing, options[DECIMALS] + math.ceil(math.log10(scale) - _SCALE_ROUNDING))
    tree = _tree(drawing, style, part(options.report, 0.7, 1.0))
    deviation = max(drawing.deviation, tree.deviation)
    text = _text(drawing, tree.lines, accuracy_of(drawing, deviation), style, options)
    return ExportResult(text, deviation, drawing.left_out, drawing.is_bound)


def picture_of(
    document: Document,
    options: Options,
    style: PictureStyle,
    report: Report,
    *,
    with_hidden: bool = False,
) -> Drawing:
    """Return the drawing of a document with its annotations; see `svg_of`."""
    plain = drawing_of(document, options.tolerance, report, with_hidden=with_hidden)
    if not (options.handles or options.grid or options.basis is not None):
        return trimmed_to_curves(plain) if options.is_to_scale and not options.points else plain
    # A plain drawing does without the modules for basis functions and handles.
    return drawing.annotations.with_annotations(plain, document, options, style.theme)


def _with_corner_at_origin(drawing: Drawing) -> Drawing:
    """Return a drawing with its upper left corner exactly at the origin, where it is but for rounding."""
    frame = drawing.frame
    if max(abs(frame.left), abs(frame.top)) > _CORNER_ROUNDING * frame.side:
        return drawing  # too far away to be moved within a document
    return replace(drawing, frame=replace(frame, left=0.0, bottom=-frame.height))


def with_size(options: Options) -> Options:
    """Return options whose width and unit are those that the size and the scale of an SVG leave."""
    if options.width is None:
        options = replace(options, width=options[SVG_WIDTH])
    return options if options[SVG_SCALE] is None else replace(options, unit="")


def pixels_per_unit(frame: Frame, options: Options) -> float:
    """Return the CSS pixels for each unit of the document, in files and on the clipboard.

    Without true size, a width or a scale one unit is a pixel: the user unit of SVG, which Inkscape, Figma and
    browsers take numbers for. A drawing of a few units, such as a plot, would be a speck in all of them: one
    that is smaller than the smallest icons gets a longer side of `NOMINAL_SIDE`.
    """
    if options.width is not None:
        return options.width / (frame.width or frame.side or 1.0)
    if options.is_to_scale:
        return factor_between(options.unit, "px")
    return options[SVG_SCALE] or (NOMINAL_SIDE / frame.side if 0 < frame.side < SMALLEST_ICON else 1.0)


def _text(drawing: Drawing, curves: Sequence[str], note: str, style: PictureStyle, options: Options) -> str:
    """Return the SVG of a drawing with the elements of its curves and a note on their accuracy."""
    frame = drawing.frame
    wide, high = _size_attributes(frame, options)
    box = " ".join(number(value) for value in (frame.left, -frame.top, frame.width, frame.height))
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


def _css_length(value: float, unit: str) -> str:
    """Return a length with its unit for SVG."""
    if unit not in _CSS_UNITS:
        value, unit = value * MILLIMETRES[unit], "mm"
    return f"{number(value)}{unit}"


def _size_attributes(frame: Frame, options: Options) -> tuple[str, str]:
    """Return width and height: true size in a unit, or in CSS pixels."""
    if options.is_to_scale:
        unit = known_unit(options.unit)
        return _css_length(frame.width, unit), _css_length(frame.height, unit)
    scale = pixels_per_unit(frame, options)
    return f"{frame.width * scale:.9g}", f"{frame.height * scale:.9g}"


def accuracy_of(drawing: Drawing, deviation: float) -> str:
    """Return a sentence with the largest deviation of a file with the drawing from the true curves."""
    losses = "" if deviation <= drawing.tolerance else ", which was not reached"
    return (
        f"{MARK}: {deviation_text(deviation, drawing.is_bound)} "
        f"(tolerance {drawing.tolerance:g}{losses}), in the unit of the coordinates."
    )


def _paper(frame: Frame, colour: str) -> str:
    x, y, width, height = (number(v) for v in (frame.left, -frame.top, frame.width, frame.height))
    return f'  <rect id="paper" x="{x}" y="{y}" width="{width}" height="{height}" fill="{colour}"/>'


def _tree(drawing: Drawing, style: PictureStyle, report: Report) -> Tree:
    """Return the elements of the curves."""
    tree = Tree(style, drawing.usual_width)
    for shape in with_progress(drawing.all_shapes, report, "Writing"):
        tree.add(shape)
    tree.close()
    return tree


def _points(drawing: Drawing, style: PictureStyle) -> list[str]:
    radius = number(POINT_RADIUS * drawing.frame.side)
    discs = [
        f'    <circle cx="{number(x)}" cy="{number(-y)}" r="{radius}"{colour}/>'
        for outline in drawing.outlines
        # A curve of no colour of its own has the ink of the picture.
        for colour in [f' fill="{style.visible_colour(outline.colour)}"' if outline.colour else ""]
        for x, y in outline.points.tolist()
    ]
    return [f'  <g id="points" fill="{style.ink}">', *discs, "  </g>"]


def _annotations(drawing: Drawing, style: PictureStyle, name: str) -> list[str]:
    """Return the group of annotations with this name; empty without any."""
    paths = [_strokes(annotation, style) for annotation in drawing.annotations if annotation.name == name]
    return [f'  <g id="{name}" fill="none" stroke-linejoin="round">', *paths, "  </g>"] if paths else []


def _strokes(annotation: Annotation, style: PictureStyle) -> str:
    data = " ".join(
        f"M {' L '.join(point_text(point) for point in line.tolist())}" for line in annotation.lines
    )
    colour = style.visible_colour(annotation.colour)
    opacity = f' opacity="{annotation.opacity:g}"' if annotation.opacity < 1 else ""
    if annotation.filled:
        return f'    <path d="{data}" fill="{colour}"{opacity}/>'
    dash = f' style="{dash_style(annotation.dash)}"' if annotation.dash else ""
    return (
        f'    <path d="{data}" stroke="{colour}" stroke-width="{number(annotation.width)}"{dash}{opacity}/>'
    )


def svg_for_clipboard(document: Document, report: Report = silent, in_pixels: bool = True) -> ExportResult:
    """Return a document as SVG of the size of an exported file; see `pixels_per_unit`.

    Its coordinates are pixels: Inkscape 1.2 pastes coordinates as they are, whatever the view box. Without a
    unit of length and without `in_pixels` they are the numbers of the document, for all other programs.

    Raises
    ------
    ExchangeError
        As `svg_of`.
    """
    style = ON_PAPER.get(document.paper)
    if known_unit(document.unit):
        return svg_of(in_unit(document, "px"), Options(unit="px", style=style, report=report))
    frame = picture_of(document, DEFAULT, INK, part(report, 0.0, 0.5)).frame
    if in_pixels:
        document = enlarged(document, pixels_per_unit(frame, DEFAULT))
    return svg_of(document, Options(style=style, report=part(report, 0.5, 1.0)))


# Paths in their groups


_NOT_IN_ID = r"[^A-Za-z0-9_.-]+"


class Tree:
    """Lines of SVG for shapes in order, which open and close groups as needed.

    Parameters
    ----------
    style
        Style of the picture.
    usual_width
        Width of strokes whose style has none.

    Attributes
    ----------
    lines
        Lines written so far.
    deviation
        Largest distance of a circle written so far from its curve.
    """

    def __init__(self, style: PictureStyle, usual_width: float) -> None:
        self._style, self._usual_width = style, usual_width
        self._open: tuple[str, ...] = ()
        self._ids = UniqueNames(NO_CURVES, between="_")
        self.lines: list[str] = []
        self.deviation = 0.0

    def add(self, shape: tuple[Outline, ...]) -> None:
        """Write the outlines of a shape as one path."""
        first = shape[0]
        self._go_into(first.groups)
        called = self._id_attributes(first.shape or first.name)
        style = _style_attributes(first.style, self._style, self._usual_width)
        unseen = "" if first.visible else ' display="none"'
        locked = ' sodipodi:insensitive="true"' if first.locked else ""
        types = _node_types(shape)
        drawn = f'path{called} d="{path_data(shape)}"{types}'
        # A circle with kinds of points would not be read as the same.
        if len(shape) == 1 and not types and (circle := circle_of(first)) is not None:
            drawn = _circle(circle, called)
            self.deviation = max(self.deviation, first.deviation + circle.deviation)
        self._write(f"<{drawn}{style}{unseen}{locked}/>")

    def close(self) -> None:
        """Close all groups."""
        self._go_into(())

    def _go_into(self, groups: tuple[str, ...]) -> None:
        common = 0
        while groups[common : common + 1] == self._open[common : common + 1] != ():
            common += 1
        while len(self._open) > common:
            self._open = self._open[:-1]
            self._write("</g>")
        for name in groups[common:]:
            self._write(f"<g{self._id_attributes(name)}>")
            self._open = (*self._open, name)

    def _write(self, element: str) -> None:
        self.lines.append("  " * (len(self._open) + 1) + element)

    def _id_attributes(self, name: str) -> str:
        """Return a unique id and, where the name differs, the name as Inkscape's label."""
        ident = self._ids.unique(_as_id(name))
        return f' id="{ident}"' + (f' inkscape:label="{quoted(name)}"' if name and name != ident else "")


def _as_id(name: str) -> str:
    """Return a name as a valid id."""
    word = re.sub(_NOT_IN_ID, "_", name).strip("_.-")
    return word if word[:1].isalpha() else f"curve_{word}".rstrip("_")


def _circle(circle: Circle, called: str) -> str:
    """Return a circle as an element with these attributes."""
    x, y = circle.centre.tolist()
    angle = round(-math.degrees(circle.start), _DIGITS - 3)
    turn = f' transform="rotate({number(angle)} {point_text([x, y])})"' if angle % 90 else ""
    return f'circle{called} cx="{number(x)}" cy="{number(-y)}" r="{number(circle.radius)}"{turn}'


def _node_types(shape: tuple[Outline, ...]) -> str:
    """Return the kinds of the points as an attribute; empty where a reader would guess them."""
    words = joined_letters([(part.letters, part.closed) for part in shape])
    default = [(guessed_letters(part.control_points, closed=part.closed), part.closed) for part in shape]
    return f' sodipodi:nodetypes="{words}"' if words and joined_letters(default) != words else ""


def path_data(shape: Iterable[Outline]) -> str:
    """Return outlines as path data, y negated, one piece per line."""
    return "\n      ".join(line for outline in shape for line in _data_lines(outline))


def _data_lines(outline: Outline) -> Iterator[str]:
    control_points = outline.control_points
    start, *_ = control_points[0].tolist()
    yield f"M {point_text(start)}"
    for piece, is_line in zip(control_points.tolist(), are_lines(control_points), strict=True):
        yield (
            f"L {point_text(piece[3])}"
            if is_line
            else f"C {' '.join(point_text(point) for point in piece[1:])}"
        )
    # Closed, the stroke has a join at the seam like everywhere else.
    if outline.closed:
        yield "Z"


def point_text(point: list[float]) -> str:
    """Return a point, y negated."""
    x, y = point
    return f"{number(x)} {number(-y)}"


def _style_attributes(style: Style, picture: PictureStyle, usual_width: float) -> str:
    """Return a style as attributes, each after a blank; defaults of SVG are left out."""
    pairs = [("fill", picture.fill_of(style) if style.has_fill else NO_PAINT), *_of_fill(style)]
    pairs += _of_stroke(style, picture.stroke_of(style), usual_width)
    return "".join(f' {name}="{value}"' for name, value in pairs)


def dash_style(dashes: Sequence[float], offset: float = 0.0) -> str:
    """Return lengths of dashes and gaps as CSS.

    When Inkscape enlarges a stroke, it keeps attributes unchanged, for instance where a drawing in pixels
    is pasted into one in millimetres; it enlarges both in CSS.
    """
    css = f"stroke-dasharray:{','.join(map(number, dashes))}"
    return f"{css};stroke-dashoffset:{number(offset)}" if offset else css


def _of_fill(style: Style) -> list[tuple[str, str]]:
    pairs = []
    if style.has_fill and style.fill_rule is not FillRule.NONZERO:
        pairs.append(("fill-rule", str(style.fill_rule.value)))
    if style.has_fill and style.fill_opacity < 1:
        pairs.append(("fill-opacity", number(style.fill_opacity)))
    return pairs


def _of_stroke(style: Style, paint: str, usual_width: float) -> list[tuple[str, str]]:
    if not style.has_stroke:
        return []
    width = usual_width if style.width is None else style.width
    pairs = [("stroke", paint), ("stroke-width", number(width))]
    if style.cap is not LineCap.BUTT:
        pairs.append(("stroke-linecap", str(style.cap.value)))
    if style.join is not LineJoin.MITER:
        pairs.append(("stroke-linejoin", str(style.join.value)))
    elif style.miter_limit != 4:
        pairs.append(("stroke-miterlimit", number(style.miter_limit)))
    if style.stroke_opacity < 1:
        pairs.append(("stroke-opacity", number(style.stroke_opacity)))
    if style.dash:
        dashes = [length * width for length in style.dash]
        pairs.append(("style", dash_style(dashes, style.dash_offset * width)))
    return pairs


# Numbers and text


_DIGITS = 12
_NOISE = 8 * sys.float_info.epsilon
_SHORT = 16
"""Characters of a number that has no noise."""

# XML 1.0 cannot contain these characters.
_NOT_IN_XML = "[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"


def number(value: float) -> str:
    """Return the shortest text that reads back as the same float; adding zero turns -0.0 into 0.0.

    A decimal of up to 12 digits but for rounding is written as such: 32.3, not 32.29999999999999.
    """
    text = repr(value + 0.0).removesuffix(".0")
    if len(text) < _SHORT:
        return text
    plain = float(f"{value:.{_DIGITS}g}")
    return repr(plain).removesuffix(".0") if abs(plain - value) <= _NOISE * abs(value) else text


def quoted(text: str) -> str:
    """Return text escaped for an attribute in quotation marks."""
    return escaped(" ".join(text.splitlines())).replace('"', "&quot;")


def escaped(text: str) -> str:
    """Return text escaped for XML."""
    # Compiled late and cached by `re`: compiling takes longer than importing this module.
    text = re.sub(_NOT_IN_XML, "\ufffd", text)
    # As xml.sax.saxutils, without the network modules that it imports.
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
