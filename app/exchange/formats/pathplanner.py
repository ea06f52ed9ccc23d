"""Paths of PathPlanner in: the cubic Bézier pieces that robots follow, in metres, by anchors and handles."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np

from ..cubics_in import Imported, ImportedPath, Look, imported
from ..errors import ExchangeError, Flaw, Missed
from ..json_in import is_object, json_in
from . import ContentKind, Format


class _Place(msgspec.Struct):
    x: float
    y: float


class _Waypoint(msgspec.Struct, rename="camel"):
    anchor: _Place | None = None
    anchor_point: _Place | None = None  # until 2023
    prev_control: _Place | None = None
    next_control: _Place | None = None


class _Path(msgspec.Struct, rename="camel"):
    waypoints: list[_Waypoint]
    rotation_targets: list[Any] = []
    constraint_zones: list[Any] = []
    point_towards_zones: list[Any] = []
    event_markers: list[Any] = []
    markers: list[Any] = []  # until 2023


def read_path(data: bytes, _tolerance: float | None = None) -> Imported:
    """Return the curve of a path, the same but for rounding.

    Raises
    ------
    ExchangeError
        With the place of what is missing, or no number.
    """
    path, missed = json_in(data, _Path), Missed()
    sides = ((0, "anchor"), (0, "next_control"), (1, "prev_control"), (1, "anchor"))
    starts = range(len(path.waypoints) - 1)
    pieces = [[_place(path.waypoints, start + ahead, name) for ahead, name in sides] for start in starts]
    if not pieces:
        raise ExchangeError("A path needs two waypoints.")
    for name in path.__struct_fields__[1:]:
        for number, _lost in enumerate(getattr(path, name)):
            missed.note(Flaw(name.removesuffix("s").replace("_", " ")), number)
    return imported([ImportedPath("Path", Look(), np.array(pieces), closed=False)], missed).with_curves()


def _place(waypoints: list[_Waypoint], index: int, name: str) -> tuple[float, float]:
    waypoint = waypoints[index]
    found: _Place | None = getattr(waypoint, name) or (waypoint.anchor_point if name == "anchor" else None)
    if found is None:
        raise ExchangeError(f"Waypoint {index + 1} has no {name.replace('_', ' ')}.")
    return found.x, found.y


PATHPLANNER = Format(
    endings=(".path",),
    title="PathPlanner path",
    rank=76,
    kind=ContentKind.DRAWING,
    plural="PathPlanner paths",
    read=read_path,
    recognises=lambda data: is_object(data) and b'"prevControl"' in data,
)
