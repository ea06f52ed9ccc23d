"""DXF, by ezdxf: splines with the control points and knots of their true degree.

A chain of Bézier pieces is a B-spline whose inner knots have the multiplicity of its degree, so the
control points go out, and come back, as they are.
"""

from __future__ import annotations

import io
import re
from typing import TYPE_CHECKING

import numpy as np

from ...document.model import Document
from ...tasks.progress import Report, part, told
from ...view_model.curve.curve_view import ParametricCurve
from ..dxf_reader import CLOSED, PLANAR, WHITE, ezdxf_module, read_dxf
from ..naming import Names
from ..options import DEFAULT, POINTS, TOLERANCE, Check, Options
from ..parts import (
    Beziers,
    Source,
    accuracy,
    beziers_of,
    checked_tolerance,
    cubics_of,
    one_line,
    sources_of,
    worst_of,
)
from ..units import dxf_code
from . import ContentKind, Format, Written

if TYPE_CHECKING:
    from ezdxf.document import Drawing

_NOT_IN_A_LAYER = re.compile(r'[<>/\\":;?*|=`,\x00-\x1f\x7f-\x9f]')
_LONGEST_LAYER = 200


CUBIC = Check(
    name="cubic",
    title="No spline above degree 3",
    tip="Cubic pieces within the tolerance: LibreCAD, for one, draws no spline of higher degree",
    help="of a DXF: no spline above degree 3, for programs that draw none, such as LibreCAD",
    default=False,
)


def dxf_text(document: Document, options: Options = DEFAULT) -> Written:
    """Return the curves as DXF (R2010): one SPLINE each, on a layer of its own.

    Hermite curves, and Lagrange curves up to degree 10, are written exactly but for
    rounding, with their parameters as knots; others as cubics within the tolerance. With `CUBIC` all above
    degree 3 are: some programs, LibreCAD among them, show nothing of a spline of higher degree. With points
    the layer of each curve holds its points as well, as POINTs. The header names the `unit`.

    Raises
    ------
    ExchangeError
        If there is no curve to write, or ezdxf is not installed.
    """
    ezdxf = ezdxf_module()
    sources, remarks = sources_of(document, part(options.report, 0.0, 0.2))
    allowed = checked_tolerance(sources, options.tolerance)
    drawing: Drawing = ezdxf.new("R2010", units=dxf_code(options.unit))
    parts = list[Beziers]()
    names = Names(drawing.layers)
    for source in told(sources, part(options.report, 0.2, 0.6), "Writing"):
        layer = _layer(drawing, source, names)
        pieces = _pieces(source, allowed, options[CUBIC])
        _add_spline(drawing, source, pieces, layer)
        parts += pieces
        for x, y in source.core.points[: len(source.curve.points)].tolist() if options.points else ():
            drawing.modelspace().add_point((x, y, 0.0), dxfattribs={"layer": layer})
    deviation, is_bound = worst_of(parts)
    comments = [accuracy(deviation, is_bound), *map(one_line, remarks)]
    drawing.header.custom_vars.append("Accuracy", comments[0])
    stream = _ToldStream(options.report)
    drawing.write(stream)
    # 999 is the group of comments; they stand before everything else.
    head = "".join(f"999\n{comment}\n" for comment in comments)
    return Written(head + stream.getvalue(), deviation, remarks, is_bound)


class _ToldStream(io.StringIO):
    """Text that reports at every piece that is written: what ezdxf writes can be stopped."""

    def __init__(self, report: Report) -> None:
        super().__init__()
        self._report = report

    def write(self, text: str) -> int:
        """Write and report; how much is still to come only ezdxf knows."""
        self._report(0.8, "Writing")
        return super().write(text)


def _pieces(source: Source, tolerance: float, cubic: bool) -> list[Beziers]:
    return [
        cubics_of(piece, tolerance) if cubic and _is_high(piece) else beziers_of(piece, tolerance)
        for piece in source.core.pieces
    ]


def _is_high(piece: ParametricCurve) -> bool:
    return piece.degree is None or piece.degree > 3


def _add_spline(drawing: Drawing, source: Source, parts: list[Beziers], layer: str) -> None:
    degree = parts[0].degree
    points = [parts[0].control_points[0, :1]]
    points += [part.control_points[:, 1:].reshape(-1, 2) for part in parts]
    joints = np.concatenate([parts[0].parameters, *(part.parameters[1:] for part in parts[1:])])
    knots = [joints[0], *np.repeat(joints, degree), joints[-1]]
    flags = PLANAR | (CLOSED if source.curve.is_closed else 0)
    # The usual tolerance, 1e-10, lets readers round the knots.
    attributes = {"layer": layer, "flags": flags, "knot_tolerance": 1e-15}
    spline = drawing.modelspace().add_spline(degree=degree, dxfattribs=attributes)
    spline.control_points = [(x, y, 0.0) for x, y in np.concatenate(points).tolist()]
    spline.knots = [float(knot) for knot in knots]


def _layer(drawing: Drawing, source: Source, names: Names) -> str:
    """Add a layer with the curve's name, as far as DXF allows it, and its colour."""
    base = _NOT_IN_A_LAYER.sub("_", one_line(source.name)).strip()[:_LONGEST_LAYER] or "Curve"
    name = names.different(base)
    layer = drawing.layers.add(name, color=WHITE)
    if source.curve.style.colour:
        digits = source.curve.style.colour
        layer.rgb = (int(digits[1:3], 16), int(digits[3:5], 16), int(digits[5:7], 16))
    return name


DXF = Format(
    endings=(".dxf",),
    title="DXF splines",
    description="SPLINE entities of the true degree with their knots, a layer for each curve.",
    rank=40,
    options=(POINTS, TOLERANCE, CUBIC),
    write=dxf_text,
    kind=ContentKind.DRAWING,
    plural="DXF drawings",
    read=read_dxf,
)
