"""Trajectories of Choreo in: samples with velocities at times, in metres and seconds, as tables.

Between two samples of a swerve drive the acceleration is constant (`SwerveSample.java`), so that the cubic
with the positions and velocities of both is the motion itself. A differential drive goes where it heads.
"""

from __future__ import annotations

import math
import re

import msgspec
import numpy as np

from ..errors import ExchangeError
from ..json_in import is_object, json_in
from ..naming import numbered
from ..table.table import Table, table_of
from . import ContentKind, Format

_TITLES = ("curve", "t", "x", "y", "vx", "vy")
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
        With the place of what is missing, or no number, and where nothing was generated yet.
    """
    content = json_in(data, _File)
    own = content.trajectory.samples if content.trajectory else content.samples
    paths = {content.name or "Trajectory": own}
    paths |= {name: each.trajectory or [] for name, each in content.paths.items()}
    found = [(" ".join(name.split())[:200], samples) for name, samples in paths.items() if samples]
    if not found:
        raise ExchangeError("It holds no trajectory. Generate one in Choreo, and import its .traj file.")
    names = zip(numbered([name for name, _ in found]), found, strict=True)
    words = [name for name, (_, samples) in names for _sample in samples]
    rows = [(np.nan, *each.row(k)) for _, samples in found for k, each in enumerate(samples, start=1)]
    return table_of(np.array(rows), _TITLES, words={0: words}, said=_LEFT_OUT)


CHOREO = Format(
    endings=(".traj", ".chor"),
    title="Choreo trajectory",
    rank=77,
    kind=ContentKind.TABLE,
    plural="Choreo trajectories",
    read=read_trajectories,
    recognises=lambda data: is_object(data) and b'"samples"' in data and bool(_MARKS.search(data)),
)
