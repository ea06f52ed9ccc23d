"""Curves as LaTeX: formulas, and pictures with TikZ and PGFPlots."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from curvecore import CurveError
from curvecore.arithmetic import vector_lengths
from curvecore.arrays import FloatArray

from ...document.lengths import MILLIMETRES, known_unit
from ...document.model import Document
from ...document.style import FillRule, LineCap, LineJoin, Style
from ...tasks.progress import part, with_progress
from ...view_model.curve.core_curve import in_words
from ...view_model.curve.curve_view import ParametricCurve
from ..drawing.drawing import Drawing, drawing_of
from ..drawing.outlines import Frame, Outline
from ..errors import ExchangeError
from ..exported_curves import (
    Deviation,
    ExportedCurve,
    accuracy,
    bezier_values,
    beziers_of,
    curves_of,
    largest_deviation,
    measured_deviation,
    one_line,
)
from ..options import DEFAULT, TOLERANCE, TRUE_SIZE, Options, Whole
from ..units import size_text
from . import ExportResult, Format

DIGITS = Whole(
    name="digits",
    label="Digits",
    title="Significant digits",
    tip="Significant digits of the numbers in the formula; 17 hold every number exactly",
    default=6,
    limits=(1, 17),
    help="LaTeX formula: significant digits of its numbers (default: %(default)s)",
)

PICTURE_SIDE = 12.0
"""Longer side of a TikZ picture, in centimetres."""

_LEAST_SIDE, _LARGEST_SIDE = 0.01, 500.0
"""Limits of a TikZ picture at true size: TeX's largest length is 575 cm, its unit 5e-6 cm."""

_PICTURE_DIGITS = 5  # TeX itself counts in 1/65536 pt, 5e-6 cm
_LINES_OF_ARRAY = 42
_GAP_OF_ROWS = 4 / 12  # of a line: [4pt]
_POINTS_OF_LINE = 2  # as many as fit into the text width of an article
_SPECIAL = {
    **{char: f"\\{char}" for char in "#$%&_{}"},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}

_CAPS = {LineCap.BUTT: "butt", LineCap.ROUND: "round", LineCap.SQUARE: "rect"}


def latex_formula(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return every curve as a formula in LaTeX with the numbers that go into it; needs amsmath.

    Lagrange curves are written in Lagrange's form, Hermite curves by the Bézier control points of their
    segments. The deviation is that of rounding the numbers to `DIGITS`.

    Raises
    ------
    ExchangeError
        If there is no curve, or if so few digits would make two parameters equal.
    """
    curves, digits = curves_of(document, options), options[DIGITS]
    formulas, deviation, is_bound = list[str](), 0.0, True
    for curve in curves:
        rounding, is_certain = largest_deviation(_rounding(piece, digits) for piece in curve.formulas.pieces)
        deviation = max(deviation, rounding + curve.formulas.deviation)
        is_bound &= is_certain and curve.formulas.is_bound
        formulas.append(_formula(curve, digits))
    return _file(formulas, Deviation(deviation, is_bound), curves.remarks, "amsmath")


def tikz_picture(document: Document, options: Options = DEFAULT) -> ExportResult:
    r"""Return a ``tikzpicture`` of the curves as cubic Bézier curves; needs tikz.

    The picture is `PICTURE_SIDE` cm large; in a unit of length it has true size.

    Raises
    ------
    ExchangeError
        If nothing can be drawn, or if the size is out of range for TeX.
    """
    drawing = drawing_of(document, options.tolerance, part(options.report, 0.0, 0.7))
    frame, known = drawing.frame, known_unit(options.unit)
    scale = MILLIMETRES[known] / 10 if known else PICTURE_SIDE / frame.side
    if not _LEAST_SIDE <= frame.side * scale <= _LARGEST_SIDE:
        raise ExchangeError(
            f"At true size the picture would be {size_text(frame.width, frame.height, known)}; "
            f"a TikZ picture can be {_LEAST_SIDE:g} to {_LARGEST_SIDE:g} cm."
        )
    fitted = drawing.fitted(frame.width * scale, frame.height * scale)
    # Rounding moves every control point, and so the curve, by half a unit of the last digit in x and y.
    deviation = drawing.deviation + math.sqrt(0.5) * 10.0**-_PICTURE_DIGITS / scale
    lines = [f"  % One centimetre is {1 / scale:.6g} {known or 'of the document'}."]
    for shape in with_progress(fitted.shapes, part(options.report, 0.7, 1.0), "Writing"):
        lines.append(f"  % {one_line(shape[0].shape or shape[0].name)}")
        lines.append(_path(shape, lambda v: f"{v + 0.0:.{_PICTURE_DIGITS}f}"))
    return _picture(lines, deviation, drawing, "tikz")


def pgfplots_axis(document: Document, options: Options = DEFAULT) -> ExportResult:
    r"""Return a ``tikzpicture`` of an axis with the curves and their points; needs pgfplots.

    Coordinates are the document's own in full precision; pgfplots computes with about seven digits.

    Raises
    ------
    ExchangeError
        If nothing can be drawn.
    """
    drawing = drawing_of(document, options.tolerance, part(options.report, 0.0, 0.7))
    lines = [f"  \\begin{{axis}}[axis equal image, {_limits(drawing.frame)}]"]
    for shape in with_progress(drawing.shapes, part(options.report, 0.7, 1.0), "Writing"):
        lines.append(f"    % {one_line(shape[0].shape or shape[0].name)}")
        lines.append(_path(shape, _plain, "axis cs:", margin="    "))
        points = [point for outline in shape for point in outline.points.tolist()]
        marks = " ".join(f"({_plain(x)},{_plain(y)})" for x, y in points)
        lines.append(f"    \\addplot[only marks, mark size=1.2pt] coordinates {{{marks}}};")
    lines.append("  \\end{axis}")
    return _picture(lines, drawing.deviation, drawing, "pgfplots")


# Formulas


def _formula(curve: ExportedCurve, digits: int) -> str:
    blocks = [
        _lagrange(piece, digits) if piece.is_one_polynomial else _segments(piece, digits)
        for piece in curve.formulas.pieces
    ]
    return "\n".join([rf"\paragraph{{{_text(curve.name)}}}", *blocks])


def _lagrange(piece: ParametricCurve, digits: int) -> str:
    last = len(piece.points) - 1
    start, end = (tex_number(value, digits) for value in piece.domain)
    formula = (
        rf"\[ \mathbf{{c}}(t) = \sum_{{i=0}}^{{{last}}} \mathbf{{p}}_i "
        rf"\prod_{{\substack{{j=0 \\ j \neq i}}}}^{{{last}}} \frac{{t - t_j}}{{t_i - t_j}}, "
        rf"\qquad {start} \le t \le {end} \]"
    )
    data = zip(piece.parameters.tolist(), piece.points.tolist(), strict=True)
    rows = [[[str(i), tex_number(t, digits), _point(point, digits)]] for i, (t, point) in enumerate(data)]
    return "\n".join([formula, *_arrays([["i", "t_i", r"\mathbf{p}_i"]], rows)])


def _segments(piece: ParametricCurve, digits: int) -> str:
    pieces = beziers_of(piece, 1.0)
    degree = pieces.degree
    formula = (
        rf"\[ \mathbf{{c}}(t) = \sum_{{k=0}}^{{{degree}}} \binom{{{degree}}}{{k}} s^k (1-s)^{{{degree}-k}}\, "
        r"\mathbf{b}_k, \qquad s = \frac{t - t_i}{t_{i+1} - t_i}, \qquad t_i \le t \le t_{i+1} \]"
    )
    t = [tex_number(value, digits) for value in piece.breaks.tolist()]
    controls = pieces.control_points.tolist()
    rows = [
        _in_lines([t[i], t[i + 1]], [_point(point, digits) for point in segment])
        for i, segment in enumerate(controls)
    ]
    titles = [rf"\mathbf{{b}}_{k}" for k in range(degree + 1)]
    return "\n".join([formula, *_arrays(_in_lines(["t_i", "t_{i+1}"], titles), rows)])


def _in_lines(head: list[str], points: list[str]) -> list[list[str]]:
    """Return the cells of one segment as lines of the width of a page, the head before the first."""
    starts = range(0, len(points), _POINTS_OF_LINE)
    return [
        [*(head if first == 0 else [""] * len(head)), *points[first : first + _POINTS_OF_LINE]]
        for first in starts
    ]


def _arrays(titles: list[list[str]], rows: list[list[list[str]]]) -> list[str]:
    """Return rows, each of as many lines of cells as the titles, as arrays short enough for a page."""
    gap, end = (_GAP_OF_ROWS, r"\\[4pt]") if len(titles) > 1 else (0.0, r"\\")
    step = max(1, int(_LINES_OF_ARRAY / (len(titles) + gap)) - 1)
    result = []
    for first in range(0, len(rows), step):
        blocks = [
            " \\\\\n".join(" & ".join(cells) for cells in row)
            for row in [titles, *rows[first : first + step]]
        ]
        body = f" {end}\n".join(blocks)
        result.append(f"\\[ \\begin{{array}}{{@{{}}{'l' * len(titles[0])}@{{}}}}\n{body}\n\\end{{array}} \\]")
    return result


def tex_number(value: float, digits: int) -> str:
    r"""Return a number as LaTeX writes it: 0.25, -3 or 1.5 \cdot 10^{-7}."""
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def _point(point: list[float], digits: int) -> str:
    x, y = point
    return rf"({tex_number(x, digits)},\; {tex_number(y, digits)})"


def _text(text: str) -> str:
    """Return text escaped for LaTeX; characters that its usual fonts lack become question marks."""
    plain = one_line(text).encode("latin-1", "replace").decode("latin-1")
    return "".join(_SPECIAL.get(letter, letter) for letter in plain)


def _rounded(values: FloatArray, digits: int) -> FloatArray:
    return np.array([float(f"{value:.{digits}g}") for value in values.ravel().tolist()]).reshape(values.shape)


def _rounding(piece: ParametricCurve, digits: int) -> Deviation:
    """Return the distance of the curve of the rounded numbers from the true one at the same t."""
    t = _rounded(piece.parameters, digits)
    if not (np.diff(t) > 0).all():
        enough = (n for n in range(digits, 17) if (np.diff(_rounded(piece.parameters, n)) > 0).all())
        least = next(enough, 17)
        raise ExchangeError(
            f"With {digits} digits two parameters would be equal. Use {least} or more: the option “Digits” "
            f"of the export, or {DIGITS.flag} {least} on the command line."
        )
    if piece.is_one_polynomial:
        try:
            rounded = piece.with_data(_rounded(piece.jets, digits), t)
        except CurveError as problem:
            raise ExchangeError(f"The formula cannot be written: {in_words(str(problem))}.") from problem
        return Deviation(measured_deviation(piece, rounded.evaluate), is_bound=False)
    pieces = beziers_of(piece, 1.0)
    controls, ends = _rounded(pieces.control_points, digits), _rounded(pieces.parameters, digits)
    if np.array_equal(ends, pieces.parameters):
        # Two pieces are nowhere farther apart than their control points.
        away = float(vector_lengths(controls - pieces.control_points).max())
        return Deviation(away + pieces.deviation, pieces.is_bound)
    return Deviation(measured_deviation(piece, lambda at: bezier_values(controls, ends, at)), is_bound=False)


# Pictures


def _picture(lines: list[str], deviation: float, drawing: Drawing, package: str) -> ExportResult:
    whole = ["\\begin{tikzpicture}", *lines, "\\end{tikzpicture}"]
    return _file(whole, Deviation(deviation, drawing.is_bound), drawing.left_out, package)


def _file(lines: list[str], worst: Deviation, remarks: tuple[str, ...], package: str) -> ExportResult:
    """Return lines below comments on their accuracy, the package they need, and curves left out."""
    head = [accuracy(*worst), f"Needs \\usepackage{{{package}}}.", *map(one_line, remarks)]
    return ExportResult(
        "\n".join([*(f"% {line}" for line in head), *lines]) + "\n", worst.deviation, remarks, worst.is_bound
    )


def _path(
    shape: tuple[Outline, ...], number: Callable[[float], str], system: str = "", margin: str = "  "
) -> str:
    """Return the outlines of a shape as one path, a piece a line; in centimetres, or in another system."""

    def at(point: list[float]) -> str:
        return f"({system}{number(point[0])},{number(point[1])})"

    lines = []
    for outline in shape:
        pieces = outline.control_points.tolist()
        steps = [f"{margin}  .. controls {at(b)} and {at(c)} .. {at(d)}" for _, b, c, d in pieces]
        # Closed, the stroke has a join at the seam like everywhere else.
        steps[-1] += " -- cycle" if outline.closed else ""
        lines += [f"{margin}  {at(pieces[0][0])}", *steps]
    command = tikz_command(shape[0].style, has_lengths=not system)
    return "\n".join([f"{margin}{command} {lines[0].strip()}", *lines[1:]]) + ";"


def _limits(frame: Frame) -> str:
    edges = {"xmin": frame.left, "xmax": frame.left + frame.width, "ymin": frame.bottom, "ymax": frame.top}
    return ", ".join(f"{name}={_plain(value)}" for name, value in edges.items())


def _plain(value: float) -> str:
    return repr(value + 0.0)


LATEX = Format(
    endings=(".tex",),
    title="LaTeX formula",
    description="The polynomials as a formula.",
    rank=100,
    options=(DIGITS,),
    write=latex_formula,
    deviation_limit=1.5,  # that of digits
)
TIKZ = Format(
    endings=(".tikz", ".tikz.tex"),
    title="TikZ picture",
    description="Bézier curves for a TeX document.",
    rank=110,
    options=(TRUE_SIZE, TOLERANCE),
    write=tikz_picture,
    deviation_limit=1.1,  # rounded to the grid of 1e-5 cm
)
PGFPLOTS = Format(
    endings=(".pgfplots.tex",),
    title="PGFPlots axis",
    description="A plot with axes for a TeX document.",
    rank=120,
    options=(TOLERANCE,),
    write=pgfplots_axis,
)


def tikz_command(style: Style, *, has_lengths: bool = True) -> str:
    r"""Return ``\draw`` or ``\fill`` with its options; without lengths where no centimetre is one of them.

    A line of the usual width has that of TikZ.
    """
    pairs = [f"line join={style.join.value}"] if style.has_stroke else []
    if style.has_stroke and style.stroke:
        pairs.append(f"{'draw' if style.has_fill else 'color'}={_colour(style.stroke)}")
    if style.has_fill:
        pairs.append(f"fill={_colour(style.fill) if style.fill else 'black'}")
        pairs += ["even odd rule"] if style.fill_rule is FillRule.EVENODD else []
    if style.has_stroke and has_lengths and style.width is not None:
        pairs += _of_line(style, style.width)
    pairs += _opacities(style)
    return rf"\{'draw' if style.has_stroke else 'fill'}[{', '.join(pairs)}]"


def _of_line(style: Style, width: float) -> list[str]:
    pairs = [f"line width={_length(width)}", f"line cap={_CAPS[style.cap]}"]
    if style.join is LineJoin.MITER:
        pairs.append(f"miter limit={style.miter_limit:g}")
    if style.dash:
        lengths = enumerate(style.dashes_and_gaps)
        words = (f"{'off' if i % 2 else 'on'} {_length(length * width)}" for i, length in lengths)
        pairs.append(f"dash pattern={' '.join(words)}")
        pairs += [f"dash phase={_length(style.dash_offset * width)}"] if style.dash_offset else []
    return pairs


def _opacities(style: Style) -> list[str]:
    shares = {"draw": style.stroke_opacity, "fill": style.fill_opacity}
    is_drawn = {"draw": style.has_stroke, "fill": style.has_fill}
    return [f"{name} opacity={share:.4g}" for name, share in shares.items() if is_drawn[name] and share < 1]


def _colour(code: str) -> str:
    red, green, blue = bytes.fromhex(code[1:])
    return f"{{rgb,255:red,{red};green,{green};blue,{blue}}}"


def _length(centimetres: float) -> str:
    return f"{centimetres:.5g}cm" if abs(centimetres) >= 1e-4 or centimetres == 0 else "0.0001cm"
