"""Paths of robots: PathPlanner and Choreo are read, PathWeaver is read and written.

PathPlanner: cubic Bézier pieces in metres, by anchors and handles.

PathWeaver: points with tangents, as CSV. It draws WPILib's quintic Hermite splines: between two waypoints s
runs from 0 to 1, the tangents are the velocities per unit of s, and the accelerations are zero
(`WpilibSpline.java`). A waypoint that is reversed begins a piece that is driven backwards: its tangents point
in the direction in which the robot looks.

Choreo: samples with velocities at times, in metres and seconds, as tables. Between two samples of a swerve
drive the acceleration is constant (`SwerveSample.java`), so that the cubic with the positions and velocities
of both is the motion itself. A differential drive moves in its heading.
"""

from __future__ import annotations

import math
import re
from typing import Any

import msgspec
import numpy as np

from curvecore.bezier.control_points import chebyshev_samples

from ...document.model import Document
from ...families import QUINTIC_HERMITE
from ...view_model.curve.curve_view import ParametricCurve
from ..cubics_in import ImportedPath, ImportResult, Look, import_paths
from ..errors import ExchangeError, Loss, Losses
from ..exported_curves import ExportedCurve, bezier_values, cell_of_number, curves_of
from ..options import DEFAULT, TOLERANCE, Options
from ..table.columns import AFTER, ROLES, mapping_of
from ..table.table import RowProblem, Table, TextLayout, table_of
from ..table.text import preview_table, read_table
from ..unique_names import numbered
from . import ContentKind, ExportResult, Format
from .json_tables import is_object, json_in

# PathPlanner


class _Position(msgspec.Struct):
    x: float
    y: float


class _Waypoint(msgspec.Struct, rename="camel"):
    anchor: _Position | None = None
    anchor_point: _Position | None = None  # until 2023
    prev_control: _Position | None = None
    next_control: _Position | None = None


class _Path(msgspec.Struct, rename="camel"):
    waypoints: list[_Waypoint]
    rotation_targets: list[Any] = []
    constraint_zones: list[Any] = []
    point_towards_zones: list[Any] = []
    event_markers: list[Any] = []
    markers: list[Any] = []  # until 2023


def read_pathplanner(data: bytes, _tolerance: float | None = None) -> ImportResult:
    """Return the curve of a path, the same but for rounding.

    Raises
    ------
    ExchangeError
        With the position of a missing or invalid number.
    """
    path, losses = json_in(data, _Path), Losses()
    sides = ((0, "anchor"), (0, "next_control"), (1, "prev_control"), (1, "anchor"))
    starts = range(len(path.waypoints) - 1)
    pieces = [[_position(path.waypoints, start + ahead, name) for ahead, name in sides] for start in starts]
    if not pieces:
        raise ExchangeError("A path needs two waypoints.")
    for name in path.__struct_fields__[1:]:
        for number, _lost in enumerate(getattr(path, name)):
            losses.note(Loss(name.removesuffix("s").replace("_", " ")), number)
    return import_paths([ImportedPath("Path", Look(), np.array(pieces), closed=False)], losses).with_curves()


def _position(waypoints: list[_Waypoint], index: int, name: str) -> tuple[float, float]:
    waypoint = waypoints[index]
    at: _Position | None = getattr(waypoint, name) or (waypoint.anchor_point if name == "anchor" else None)
    if at is None:
        raise ExchangeError(f"Waypoint {index + 1} has no {name.replace('_', ' ')}.")
    return at.x, at.y


PATHPLANNER = Format(
    endings=(".path",),
    title="PathPlanner path",
    rank=76,
    kind=ContentKind.DRAWING,
    read=read_pathplanner,
    recognises=lambda data: is_object(data) and b'"prevControl"' in data,
)


# PathWeaver

MOST_WAYPOINTS = 10_000

_WAYPOINT_TITLES = "X,Y,Tangent X,Tangent Y,Fixed Theta,Reversed,Name"
_HEAD = re.compile(rb"(?i)(\xef\xbb\xbf)?\s*x\s*,\s*y\s*,\s*tangent x\s*,\s*tangent y\b")
_LAYOUT = TextLayout(",", decimal_comma=False, header=True)
_ROUNDING = 1e-14  # of the size
_MOST_SAMPLED = 30  # degree up to which the deviation is a bound


def read_pathweaver(data: bytes) -> Table:
    """Return a path as the rows of a quintic Hermite curve, whose t counts its points.

    Raises
    ------
    ExchangeError
        With the row of an invalid number, and for a missing column.
    """
    titles = preview_table(data, _LAYOUT).titles
    words = ",curve=Reversed" if "reversed" in map(str.lower, titles) else ""
    mapping = mapping_of(f"x=X,y=Y,vx=Tangent X,vy=Tangent Y{words}", titles)
    table = read_table(data, _LAYOUT, mapping)
    cells = table.words.get(mapping.curve or 0, ["false"] * len(table.values))
    for row, word in enumerate(cells):
        if word.lower() not in ("true", "false"):
            raise RowProblem(f": “{word[:20]}” is neither true nor false.", table.line_of(row))
    ahead = np.array([-1.0 if word.lower() == "true" else 1.0 for word in cells])[:, None]
    behind = np.concatenate([ahead[:1], ahead[:-1]])
    ahead[-1] = behind[-1]
    columns = list(mapping.columns(("x", "y", "vx", "vy")).values())
    points, tangents = np.split(table.values[:, columns], 2, axis=1)
    turns = ahead != behind
    t, zero, empty = np.arange(len(points))[:, None], np.zeros_like(points), np.full_like(points, np.nan)
    parts = [t, points, behind * tangents, zero]
    if turns.any():
        parts += [np.where(turns, ahead * tangents, np.nan), np.where(turns, zero, np.nan)]
    used = (*ROLES[:7], *(AFTER[:4] if turns.any() else ()), "family")
    return Table(
        used,
        np.hstack([*parts, empty[:, :1]]),
        table.first_row,
        table.gaps,
        words={len(used) - 1: [QUINTIC_HERMITE.name] * len(points)},
        remark="Tangents are velocities, and t counts the points. Fixed Theta and Name are left out.",
    )


def path_table(document: Document, options: Options = DEFAULT) -> ExportResult:
    """Return the first visible curve as a path of PathWeaver.

    The path is the curve itself where that is a quintic Hermite curve with even parameters and without
    accelerations. Of any other there are waypoints at equal steps of t, as many as the tolerance takes.

    Raises
    ------
    ExchangeError
        If there is no curve, or `MOST_WAYPOINTS` do not suffice.
    """
    curves = curves_of(document, options)
    remarks, (first, *_) = curves.remarks, curves.curves
    rows, deviation = list[str](), 0.0
    for curve in curves:
        if curve is first:
            rows, deviation = _rows_of(curve, curves.tolerance)
        else:
            remarks = (*remarks, f"“{curve.name}” was left out: a PathWeaver file has one path.")
    is_bound = not deviation or (first.core.degree or math.inf) <= _MOST_SAMPLED
    return ExportResult("\n".join([_WAYPOINT_TITLES, *rows]) + "\n", deviation, remarks, is_bound)


def _rows_of(curve: ExportedCurve, tolerance: float) -> tuple[list[str], float]:
    """Return the rows of a curve, and the largest distance of the path from it."""
    count = len(curve.core.parameters) - 1
    while count < MOST_WAYPOINTS:
        path = _WaypointPath(curve.core, count)
        if path.deviation <= tolerance:
            return path.rows, path.deviation if path.deviation > _ROUNDING * curve.size else 0.0
        count *= 2
    raise ExchangeError(
        f"“{curve.name}” needs more than {MOST_WAYPOINTS:,} waypoints. Choose a larger tolerance or a "
        "smoother curve: such a path has no corners."
    )


class _WaypointPath:
    """Path with waypoints at equal steps of t along a curve.

    Attributes
    ----------
    rows
        Rows of the file.
    deviation
        Largest distance of the path from the curve.
    """

    def __init__(self, core: ParametricCurve, count: int) -> None:
        grid = np.linspace(*core.domain, count + 1)
        step = grid[1] - grid[0]
        points, leaving, arriving = core.evaluate(grid), np.empty((count, 2)), np.empty((count, 2))
        for piece in core.pieces:
            inside = np.flatnonzero((grid[1:] + grid[:-1]) / 2 > piece.domain[0])
            leaving[inside] = step * piece.evaluate(grid[inside], 1)
            arriving[inside] = step * piece.evaluate(grid[inside + 1], 1)
        # Where the curve reverses, the robot drives backwards.
        goes_on = np.einsum("kd,kd->k", arriving[:-1], leaving[1:]) >= 0
        signs = np.cumprod([1.0, *np.where(goes_on, 1.0, -1.0)])
        tangents = np.append(signs[:, None] * leaving, signs[-1:] * arriving[-1:], axis=0)
        self.rows = [
            ",".join([*map(cell_of_number, numbers), "true", "true" if sign < 0 else "false", ""])
            for numbers, sign in zip(np.hstack([points, tangents]).tolist(), (*signs, signs[-1]), strict=True)
        ]
        a, b = points[:-1], points[1:]
        start, end = signs[:, None] * tangents[:-1] / 5, signs[:, None] * tangents[1:] / 5
        controls = np.stack([a, a + start, a + 2 * start, b - 2 * end, b - end, b], axis=1)
        nodes, margin = chebyshev_samples(min(max(core.degree or 0, 5), _MOST_SAMPLED))
        ends = np.union1d(grid, core.breaks)
        t = (ends[:-1, None] + np.diff(ends)[:, None] * nodes).ravel()
        away = np.hypot(*(bezier_values(controls, grid, t) - core.evaluate(t)).T)
        self.deviation = float(away.max()) * margin


PATHWEAVER = Format(
    endings=(".pathweaver.csv",),
    title="PathWeaver path",
    description="Waypoints with tangents for robots: one curve of quintic pieces.",
    rank=75,
    options=(TOLERANCE,),
    write=path_table,
    kind=ContentKind.TABLE,
    read=read_pathweaver,
    recognises=lambda data: _HEAD.match(data) is not None,
    writes_dots=False,
)


# Choreo

_SAMPLE_TITLES = ("curve", "t", "x", "y", "vx", "vy")
_LEFT_OUT = "Headings, forces and events are left out."
_MARKS = re.compile(rb'"(?:sampleType|omega|velocityX|vl)"')


class _Sample(msgspec.Struct, rename="camel"):
    """Position and velocity at a time; the long names are those of the versions until 2024."""

    x: float
    y: float
    t: float | None = None
    timestamp: float | None = None
    vx: float | None = None
    vy: float | None = None
    velocity_x: float | None = None
    velocity_y: float | None = None
    vl: float | None = None
    vr: float | None = None
    heading: float = 0.0

    def row(self, number: int) -> tuple[float, ...]:
        """Return time, position and velocity."""
        t = self.timestamp if self.t is None else self.t
        vx, vy = (self.velocity_x, self.velocity_y) if self.vx is None else (self.vx, self.vy)
        if self.vl is not None and self.vr is not None:
            speed = (self.vl + self.vr) / 2
            vx, vy = speed * math.cos(self.heading), speed * math.sin(self.heading)
        if t is None or vx is None or vy is None:
            raise ExchangeError(f"Sample {number} has no {'time' if t is None else 'velocity'}.")
        return (t, self.x, self.y, vx, vy)


class _Trajectory(msgspec.Struct):
    samples: list[_Sample] = []


class _OldPath(msgspec.Struct):
    trajectory: list[_Sample] | None = None


class _File(msgspec.Struct):
    name: str = ""
    trajectory: _Trajectory | None = None
    samples: list[_Sample] = []
    paths: dict[str, _OldPath] = {}


def read_trajectories(data: bytes) -> Table:
    """Return the samples of a trajectory, or of all in a project of 2024, as rows.

    Raises
    ------
    ExchangeError
        With the position of a missing or invalid number, and without a generated trajectory.
    """
    content = json_in(data, _File)
    samples = content.trajectory.samples if content.trajectory else content.samples
    paths = {content.name or "Trajectory": samples}
    paths |= {name: path.trajectory or [] for name, path in content.paths.items()}
    trajectories = [(" ".join(name.split())[:200], samples) for name, samples in paths.items() if samples]
    if not trajectories:
        raise ExchangeError("The file has no trajectory. Generate one in Choreo and import its .traj file.")
    names = zip(numbered([name for name, _ in trajectories]), trajectories, strict=True)
    words = [name for name, (_, samples) in names for _sample in samples]
    rows = [(np.nan, *sample.row(k)) for _, samples in trajectories for k, sample in enumerate(samples, 1)]
    return table_of(np.array(rows), _SAMPLE_TITLES, words={0: words}, remark=_LEFT_OUT)


CHOREO = Format(
    endings=(".traj", ".chor"),
    title="Choreo trajectory",
    rank=77,
    kind=ContentKind.TABLE,
    plural="Choreo trajectories",
    read=read_trajectories,
    recognises=lambda data: is_object(data) and b'"samples"' in data and bool(_MARKS.search(data)),
)
