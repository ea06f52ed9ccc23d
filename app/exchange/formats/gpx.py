"""Tracks and routes of GPX in, as tables: metres east and north of their middle, and seconds.

The projection is the equirectangular one about the middle, on the sphere of the earth's mean radius.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import numpy as np

from curvecore.arrays import FloatArray

from ...document.words import count_of
from ..errors import ExchangeError
from ..svg.xml_tree import parse_xml, tag_of
from ..table.table import Table, table_of
from ..unique_names import numbered
from . import ContentKind, Format

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

MOST_ELEMENTS = 1_000_000
EARTH = 6_371_008.8
"""Mean radius in metres (IUGG)."""


def read_gpx(data: bytes) -> Table:
    """Return the points of all segments of tracks and of routes; t are their times, where these increase.

    A remark names the content left out: waypoints, segments of one point, elevations.

    Raises
    ------
    ExchangeError
        With the number of a point without a latitude or longitude, and where there is no track.
    """
    root = parse_xml(data, MOST_ELEMENTS)
    segments = list(_tracks(root))
    tracks = [(name, points) for name, points in segments if len(points) > 1]
    if not tracks:
        raise ExchangeError("The GPX file contains no track or route of at least two points.")
    sizes = [len(points) for _name, points in tracks]
    starts = np.cumsum([0, *sizes[:-1]])
    words = np.repeat(np.array(numbered([name for name, _points in tracks]), dtype=object), sizes)
    points = [point for _name, segment in tracks for point in segment]
    x, y, remark = _projected(np.array([_degrees(k, point) for k, point in enumerate(points, start=1)]))
    t = np.array(list(map(_seconds, points)))
    latest = np.concatenate([np.maximum.accumulate(times) for times in np.split(t, starts[1:])])
    later = np.append(True, t[1:] > latest[:-1])
    later[starts] = True
    lost = len(points) - int(later.sum())
    values = {"curve": np.full(len(x), np.nan), "t": t - t[0], "x": x, "y": y}
    left = np.add.reduceat(later, starts, dtype=int).min()
    if np.isfinite(t).all() and 2 * lost < len(points) and left > 1:
        remark += f" t is in seconds since {datetime.fromtimestamp(t[0], UTC).isoformat()}."
        remark += f" {count_of(lost, 'point')} left out, as their times do not increase." if lost else ""
    else:
        del values["t"]
        later[:] = True
        remark += " Times are left out because they do not increase." * bool(np.isfinite(t).any())
    remark += " Elevations are left out." * any(_text(point, "ele") for point in points)
    waypoints = sum(tag_of(child) == "wpt" for child in root)
    single = sum(len(points) == 1 for _, points in segments)
    remark += f" {count_of(waypoints, 'waypoint')} left out." if waypoints else ""
    remark += f" {count_of(single, 'single point')} left out." if single else ""
    rows = np.column_stack(list(values.values()))[later]
    return table_of(rows, tuple(values), words={0: words[later].tolist()}, remark=remark)


def _tracks(root: Element) -> Iterator[tuple[str, list[Element]]]:
    """Yield the name and the points of each segment of a track, and of each route."""
    for line in root:
        tag, name = tag_of(line), " ".join(_text(line, "name").split())[:200]
        if tag == "rte":
            yield name or "Route", [child for child in line if tag_of(child) == "rtept"]
        for segment in line if tag == "trk" else ():
            if tag_of(segment) == "trkseg":
                yield name or "Track", [child for child in segment if tag_of(child) == "trkpt"]


def _text(element: Element, tag: str) -> str:
    return next((child.text or "" for child in element if tag_of(child) == tag), "")


def _degrees(number: int, point: Element) -> tuple[float, float]:
    """Return longitude and latitude of a point."""
    try:
        longitude, latitude = (float(point.get(name, "")) for name in ("lon", "lat"))
    except ValueError:
        longitude = latitude = math.nan
    if not (abs(latitude) <= 90 and abs(longitude) <= 360):
        raise ExchangeError(f"Point {number} has no latitude and longitude in degrees.")
    return longitude, latitude


def _seconds(point: Element) -> float:
    """Return the time of a point, in UTC without a zone; NaN without a time."""
    try:
        time = datetime.fromisoformat(_text(point, "time").strip())
    except ValueError:
        return math.nan
    return (time if time.tzinfo else time.replace(tzinfo=UTC)).timestamp()


def _projected(degrees: FloatArray) -> tuple[FloatArray, FloatArray, str]:
    """Return metres east and north of the middle, and a sentence on the projection."""
    # All longitudes on one side of the date line.
    longitude, latitude = (degrees - [360, 0] * np.round((degrees - degrees[0]) / 360)).T
    east, north = (float(np.round((angle.min() + angle.max()) / 2, 6)) for angle in (longitude, latitude))
    across = np.cos(np.radians([north, *latitude]))
    x = EARTH * across[0] * np.radians(longitude - east)
    y = EARTH * np.radians(latitude - north)
    off = 100 * float(np.abs(across[1:] / across[0] - 1).max())
    remark = f"Degrees were converted to metres around latitude {north}, longitude {east} (equirectangular"
    return x, y, f"{remark}; east–west lengths are off by up to {off:.2g} %)."


GPX = Format(
    endings=(".gpx",),
    title="GPX track",
    rank=79,
    kind=ContentKind.TABLE,
    read=read_gpx,
)
