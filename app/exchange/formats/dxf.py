"""DXF, by ezdxf: splines with the control points and knots of their true degree, and every curve read.

A chain of Bézier pieces is a B-spline whose inner knots have the multiplicity of its degree, so the
control points go out, and come back, as they are.
"""

from __future__ import annotations

import dataclasses
import io
import math
import re
from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from curvecore import LagrangeCurve, chebyshev, cubic_path
from curvecore.arrays import FloatArray
from curvecore.bezier.control_points import cubic_shape

from ... import exchange
from ...document.model import Document
from ...document.style import Style
from ...tasks.progress import Report
from ...view_model.cubics import RELATIVE_TOLERANCE
from ..cubics_in import (
    ImportedPath,
    ImportResult,
    Look,
    PathThroughPoints,
    error_of_arc,
    import_paths,
    lines,
    pieces_of_arc,
)
from ..errors import LEFT_OUT, ExchangeError, Loss, Losses
from ..exported_curves import (
    Beziers,
    ExportedCurve,
    accuracy,
    bezier_values,
    beziers_of,
    cubics_of,
    curves_of,
    largest_deviation,
    one_line,
)
from ..options import DEFAULT, POINTS, TOLERANCE, Check, Options
from ..unique_names import UniqueNames
from ..units import dxf_code, unit_of_dxf
from . import ContentKind, ExportResult, Format

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic
    from ezdxf.entities.spline import Spline
    from ezdxf.math import Vec3

_NOT_IN_A_LAYER = re.compile(r'[<>/\\":;?*|=`,\x00-\x1f\x7f-\x9f]')
_LONGEST_LAYER = 200


CUBIC = Check(
    name="cubic",
    title="No splines above degree 3",
    tip="Write cubic pieces within the tolerance, for programs that draw no splines of higher degree",
    help="DXF: no splines above degree 3, for programs that draw none, such as LibreCAD",
    default=False,
)


def dxf_text(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return the curves as DXF (R2010): one SPLINE each, on a layer of its own.

    Hermite curves, and Lagrange curves up to degree 10, are written exactly but for
    rounding, with their parameters as knots; others as cubics within the tolerance. With `CUBIC` all above
    degree 3 are: some programs, LibreCAD among them, do not show splines of higher degree. With points
    the layer of each curve holds its points as well, as POINTs. The header names the `unit`.

    Raises
    ------
    ExchangeError
        If there is no curve to write, or ezdxf is not installed.
    """
    ezdxf = ezdxf_module()
    curves = curves_of(document, options)
    tolerance = curves.tolerance
    drawing: Drawing = ezdxf.new("R2010", units=dxf_code(options.unit))
    paths = list[Beziers]()
    names = UniqueNames(drawing.layers)
    for curve in curves:
        layer = _layer(drawing, curve, names)
        pieces = _pieces(curve, tolerance, options[CUBIC])
        _add_spline(drawing, curve, pieces, layer)
        paths += pieces
        for x, y in curve.core.points[: len(curve.source.points)].tolist() if options.points else ():
            drawing.modelspace().add_point((x, y, 0.0), dxfattribs={"layer": layer})
    deviation, is_bound = largest_deviation(paths)
    comments = [accuracy(deviation, is_bound), *map(one_line, curves.remarks)]
    drawing.header.custom_vars.append("Accuracy", comments[0])
    stream = _ReportingStream(options.report)
    drawing.write(stream)
    # 999 is the group of comments; they stand before everything else.
    head = "".join(f"999\n{comment}\n" for comment in comments)
    return ExportResult(head + stream.getvalue(), deviation, curves.remarks, is_bound)


class _ReportingStream(io.StringIO):
    """Text stream that reports at every write, so that the work of ezdxf can be cancelled."""

    def __init__(self, report: Report) -> None:
        super().__init__()
        self._report = report

    def write(self, text: str) -> int:
        """Write and report; only ezdxf knows how much is still to come."""
        self._report(1.0, "Writing")
        return super().write(text)


def _pieces(curve: ExportedCurve, tolerance: float, cubic: bool) -> list[Beziers]:
    return [
        cubics_of(piece, tolerance, cubic_shape)
        if cubic and (piece.degree is None or piece.degree > 3)
        else beziers_of(piece, tolerance)
        for piece in curve.core.pieces
    ]


def _add_spline(drawing: Drawing, curve: ExportedCurve, parts: list[Beziers], layer: str) -> None:
    degree = parts[0].degree
    points = [parts[0].control_points[0, :1]]
    points += [part.control_points[:, 1:].reshape(-1, 2) for part in parts]
    joints = np.concatenate([parts[0].parameters, *(part.parameters[1:] for part in parts[1:])])
    knots = [joints[0], *np.repeat(joints, degree), joints[-1]]
    flags = PLANAR | (CLOSED if curve.source.is_closed else 0)
    # The usual tolerance, 1e-10, lets readers round the knots.
    attributes = {"layer": layer, "flags": flags, "knot_tolerance": 1e-15}
    spline = drawing.modelspace().add_spline(degree=degree, dxfattribs=attributes)
    spline.control_points = [(x, y, 0.0) for x, y in np.concatenate(points).tolist()]
    spline.knots = [float(knot) for knot in knots]


def _layer(drawing: Drawing, curve: ExportedCurve, names: UniqueNames) -> str:
    """Add a layer with the curve's name, as far as DXF allows it, and its colour."""
    base = _NOT_IN_A_LAYER.sub("_", one_line(curve.name)).strip()[:_LONGEST_LAYER] or "Curve"
    name = names.unique(base)
    layer = drawing.layers.add(name, color=WHITE)
    if curve.source.style.colour:
        digits = curve.source.style.colour
        layer.rgb = (int(digits[1:3], 16), int(digits[3:5], 16), int(digits[5:7], 16))
    return name


# DXF in


MAX_ENTITIES = 10_000
HIGHEST_DEGREE_READ = 20

CLOSED, PLANAR = 1, 8
"""Flags of a SPLINE."""

WHITE = 7
"""Black on paper: the ink of the theme."""

_PIECES_OF_A_TURN = 8
"""At least: within 4.3e-6 of the radius, for drawings that are measured."""

_FINEST_TURN = 1024
_WITH_ARCS = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE")
_END = re.compile(r"(^|\n)[ \t]*0[ \t]*\n[ \t]*EOF\s*\Z")


def read_dxf(data: bytes, tolerance: float | None = None) -> ImportResult:
    """Return the curves in the model space of a DXF file.

    SPLINE up to degree 3 and LINE, LWPOLYLINE and POLYLINE without bulges are read exactly; arcs,
    circles, ellipses and splines of higher degree within the tolerance. Rational and periodic splines,
    and splines with fit points only, are left out with a remark.

    Parameters
    ----------
    data
        The whole file, as text.
    tolerance
        Largest distance allowed, in the file's unit; by default `RELATIVE_TOLERANCE` of each curve.

    Raises
    ------
    ExchangeError
        If the file is damaged, incomplete or too large, or holds no curve.
    """
    ezdxf = ezdxf_module()
    text = _text(data)
    try:
        drawing: Drawing = ezdxf.read(io.StringIO(text))
        entities = list(drawing.modelspace())
    except MemoryError:
        raise
    except Exception as problem:
        # A damaged file can make a foreign parser raise anything: StructureError, ValueError, …
        raise _damage_error("The DXF file", problem) from problem
    if len(entities) > MAX_ENTITIES:
        raise ExchangeError(f"The DXF file has {len(entities)} entities; at most {MAX_ENTITIES} can be read.")
    reader = _Reader(drawing, tolerance)
    for number, entity in enumerate(entities, start=1):
        reader.take(entity, number)
    result = import_paths(reader.paths, reader.losses).with_curves()
    unit = unit_of_dxf(int(drawing.units))
    return dataclasses.replace(result, document=replace(result.document, unit=unit))


def _damage_error(what: str, problem: Exception) -> ExchangeError:
    reason = one_line(str(problem))[:120] or type(problem).__name__
    return ExchangeError(f"{what} is damaged: {reason.rstrip('.')}.")


def _text(data: bytes) -> str:
    if not data.strip():
        raise ExchangeError("The file is empty.")
    if data.startswith(b"AutoCAD Binary DXF"):
        raise ExchangeError("This is a binary DXF file. Save it as text.")
    if b"\0" in data:
        raise ExchangeError("The file contains zero bytes, so it is not a DXF text file.")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Before 2007 files were in the code page of the machine; only names are not plain ASCII.
        text = data.decode("cp1252", "replace")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if not _END.search(text):
        raise ExchangeError(
            f"The DXF file ends at line {text.count(chr(10)) + 1} without EOF: it is incomplete."
        )
    return text


class _Reader:
    """Collector of the paths of one file, and of its losses."""

    def __init__(self, drawing: Drawing, tolerance: float | None) -> None:
        self._drawing = drawing
        self._tolerance = tolerance
        self.paths: list[ImportedPath | PathThroughPoints] = []
        self.losses = Losses()

    def take(self, entity: DXFGraphic, number: int) -> None:
        """Add the paths of an entity, counted from 1."""
        kind = entity.dxftype()
        try:
            if kind == "SPLINE":
                self._take_spline(entity)  # type: ignore[arg-type]
            elif kind in _WITH_ARCS:
                self._take_path(entity, number)
            else:
                self._note_loss(entity)
        except (ExchangeError, MemoryError):
            raise
        except Exception as problem:
            # As above: a foreign parser.
            raise _damage_error(f"Entity {number} ({kind})", problem) from problem

    def _note_loss(self, entity: DXFGraphic, outcome: str = LEFT_OUT) -> None:
        self.losses.note(Loss(entity.dxftype(), outcome), entity)

    def _take_spline(self, spline: Spline) -> None:
        points = np.array([tuple(point)[:2] for point in spline.control_points], dtype=float)
        knots = np.array(spline.knots, dtype=float)
        degree = int(spline.dxf.degree)
        weights = list(spline.weights)
        if len(points) == 0:
            self._take_fit_points(spline)
        elif weights and max(weights) != min(weights):
            self._note_loss(spline, "with weights left out")
        elif not 1 <= degree <= HIGHEST_DEGREE_READ:
            self._note_loss(spline, f"of degree {degree} left out")
        elif not _is_clamped(knots, degree, len(points)):
            self._note_loss(spline, "with periodic or invalid knots left out")
        else:
            self._add(spline, _beziers(points, knots, degree), bool(spline.dxf.flags & CLOSED))

    def _take_fit_points(self, spline: Spline) -> None:
        """Add the natural spline through fit points: the file does not define the curve between them."""
        points = [(float(point[0]), float(point[1])) for point in spline.fit_points]
        closed = bool(spline.dxf.flags & CLOSED)
        if closed and len(points) > 1 and points[0] == points[-1]:
            points.pop()
        distinct = [here for here, before in zip(points, [None, *points[:-1]], strict=True) if here != before]
        if len(distinct) < 2:
            self._note_loss(spline, "with fewer than two points left out")
            return
        if not np.isfinite(distinct).all():
            raise ExchangeError(f"The SPLINE on layer “{spline.dxf.layer}” has invalid coordinates.")
        self._note_loss(spline, "with fit points only imported as the natural spline through them")
        self.paths.append(PathThroughPoints(self._name(spline), self._look(spline), tuple(distinct), closed))

    def _name(self, entity: DXFGraphic) -> str:
        layer = str(entity.dxf.layer)
        return layer if layer != "0" else f"{entity.dxftype().capitalize()} {len(self.paths) + 1}"

    def _add(self, entity: DXFGraphic, pieces: FloatArray, closed: bool, deviation: float = 0.0) -> None:
        if not np.isfinite(pieces).all():
            raise ExchangeError(
                f"The {entity.dxftype()} on layer “{entity.dxf.layer}” has invalid coordinates."
            )
        if pieces.shape[1] > 4:
            pieces, deviation = self._as_cubics(pieces)
        meets = bool((pieces[0, 0] == pieces[-1, -1]).all())
        self.paths.append(
            ImportedPath(
                self._name(entity),
                self._look(entity),
                _raised_to_degree_3(pieces),
                meets and (closed or len(pieces) > 1),
                deviation,
            )
        )

    def _as_cubics(self, pieces: FloatArray) -> tuple[FloatArray, float]:
        size = float(np.ptp(pieces.reshape(-1, 2), axis=0).max())
        tolerance = self._tolerance or RELATIVE_TOLERANCE * max(size, 1e-300)
        s = chebyshev(pieces.shape[1])
        paths = [
            cubic_path(LagrangeCurve(bezier_values(piece[None], np.array([0.0, 1.0]), s), s), tolerance)
            for piece in pieces
        ]
        cubics = np.concatenate([path.control_points for path in paths])
        return cubics, max(path.deviation for path in paths)

    def _take_path(self, entity: DXFGraphic, number: int) -> None:
        library = exchange.dxf_library
        radius = _largest_radius(entity)
        count = pieces_of_arc(radius, math.tau, self._tolerance, _FINEST_TURN, turn=_PIECES_OF_A_TURN)
        whole = library.make_path(entity, segments=count)
        closed = bool(getattr(entity, "is_closed", False)) or entity.dxftype() in ("CIRCLE",)
        for path in whole.sub_paths() if whole.has_sub_paths else [whole]:
            pieces = []
            pen = _flat(path.start)
            for command in path.commands():
                if command.type == library.Command.CURVE4_TO:
                    controls = (command.ctrl1, command.ctrl2, command.end)  # type: ignore[union-attr]
                    pieces.append(np.array([[pen, *map(_flat, controls)]]))
                elif command.type == library.Command.LINE_TO:
                    pieces.append(lines(np.array([pen, _flat(command.end)])))
                else:
                    raise ExchangeError(f"Entity {number} ({entity.dxftype()}) has an unsupported curve.")
                pen = _flat(command.end)
            if pieces:
                deviation = radius * error_of_arc(math.tau / count)
                self._add(entity, _with_exact_joints(np.concatenate(pieces)), closed, deviation)

    def _look(self, entity: DXFGraphic) -> Look:
        """Return a line in the colour of an entity, or of its layer."""
        rgb, index = entity.rgb, int(entity.dxf.color)
        if rgb is None and index in (0, 256) and entity.dxf.layer in self._drawing.layers:
            layer = self._drawing.layers.get(entity.dxf.layer)
            rgb, index = layer.rgb, abs(int(layer.dxf.color))
        if rgb is None and 1 <= index <= 255 and index != WHITE:
            rgb = exchange.dxf_library.aci2rgb(index)
        return Look() if rgb is None else Look(Style(stroke="#{:02x}{:02x}{:02x}".format(*rgb)))


def ezdxf_module() -> ModuleType:
    """Return the library, an extra.

    Raises
    ------
    ExchangeError
        If it is not installed.
    """
    try:
        return exchange.dxf_library.ezdxf
    except ImportError:
        raise ExchangeError("DXF needs the package ezdxf: pip install 'curvebench[dxf]'.") from None


def _is_clamped(knots: FloatArray, degree: int, count: int) -> bool:
    """Whether knots are as many as they must be, do not decrease, and begin and end at the points."""
    if count <= degree or len(knots) != count + degree + 1 or not np.isfinite(knots).all():
        return False
    steps = np.diff(knots)
    ends = (*steps[:degree], *steps[len(steps) - degree :])
    inner = np.unique(knots[1:-1], return_counts=True)[1]
    return bool((steps >= 0).all() and not any(ends) and knots[-1] > knots[0] and inner.max() <= degree)


def _beziers(points: FloatArray, knots: FloatArray, degree: int) -> FloatArray:
    """Return the Bézier pieces (k, degree + 1, 2) of a clamped B-spline."""
    if len(knots) > 2 and (np.unique(knots[1:-1], return_counts=True)[1] == degree).all():
        starts = np.arange(0, len(points) - 1, degree)
        return np.asarray(points[starts[:, None] + np.arange(degree + 1)])
    # ezdxf takes knots for equal that differ by less than 1e-9 of their size.
    unit = (knots - knots[0]) / (knots[-1] - knots[0])
    spline = exchange.dxf_library.BSpline(
        [(x, y, 0.0) for x, y in points.tolist()], order=degree + 1, knots=unit.tolist()
    )
    pieces = [[_flat(point) for point in piece] for piece in spline.bezier_decomposition()]
    return _with_exact_joints(np.array(pieces, dtype=float).reshape(-1, degree + 1, 2))


def _with_exact_joints(pieces: FloatArray) -> FloatArray:
    """Return pieces that begin exactly where the one before ends, also the first of a closed path."""
    pieces[1:, 0] = pieces[:-1, -1]
    size = np.ptp(pieces.reshape(-1, 2), axis=0).max()
    if np.abs(pieces[-1, -1] - pieces[0, 0]).max() <= 1e-12 * size:
        pieces[-1, -1] = pieces[0, 0]
    return pieces


def _raised_to_degree_3(pieces: FloatArray) -> FloatArray:
    """Return pieces of degree 1, 2 or 3 as cubics."""
    degree = pieces.shape[1] - 1
    if degree == 1:
        return np.concatenate([lines(piece) for piece in pieces])
    if degree == 2:
        a, b, c = pieces.swapaxes(0, 1)
        return np.stack([a, a + 2 / 3 * (b - a), c + 2 / 3 * (b - c), c], axis=1)
    return pieces


def _flat(point: Vec3) -> tuple[float, float]:
    return (float(point.x), float(point.y))


def _largest_radius(entity: DXFGraphic) -> float:
    kind = entity.dxftype()
    if kind in ("ARC", "CIRCLE"):
        return abs(float(entity.dxf.radius))
    if kind == "ELLIPSE":
        return float(entity.dxf.major_axis.magnitude)
    if kind == "LINE":
        return 0.0
    if kind == "LWPOLYLINE":
        rows = [tuple(map(float, row)) for row in entity.get_points("xyb")]  # type: ignore[attr-defined]
    else:
        rows = [(*_flat(v.dxf.location), float(v.dxf.bulge)) for v in entity.vertices]  # type: ignore[attr-defined]
    radius = 0.0
    for (x0, y0, bulge), (x1, y1, _) in zip(rows, [*rows[1:], *rows[:1]], strict=True):
        if bulge:
            radius = max(radius, math.hypot(x1 - x0, y1 - y0) * (1 / abs(bulge) + abs(bulge)) / 4)
    return radius


DXF = Format(
    endings=(".dxf",),
    title="DXF splines",
    description="SPLINE entities of the true degree with their knots, one layer per curve.",
    rank=40,
    options=(POINTS, TOLERANCE, CUBIC),
    write=dxf_text,
    kind=ContentKind.DRAWING,
    plural="DXF drawings",
    read=read_dxf,
)
