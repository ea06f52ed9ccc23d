"""Tracks of GPX: metres against great circles, times as they stand in the file."""

from __future__ import annotations

from math import asin, cos, hypot, radians, sin, sqrt

import numpy as np
import pytest

from app.exchange.errors import ExchangeError
from app.exchange.files import ImportOptions, import_file
from app.exchange.formats.gpx import EARTH, read_gpx
from tests.rows import each_row

HEAD = '<?xml version="1.0"?>\n<gpx xmlns="http://www.topografix.com/GPX/1/1" version="1.1" creator="a">'
WALK = [
    (47.6445, -122.3269, 26),
    (47.6452, -122.3269, 31),
    (47.6452, -122.3281, 34),
    (47.6448, -122.3290, 40.5),
]


def point_of(latitude, longitude, second=None, tag="trkpt"):
    time = f"<ele>4.5</ele><time>2009-10-17T18:37:{second:06.3f}Z</time>" if second is not None else ""
    return f'<{tag} lat="{latitude}" lon="{longitude}">{time}</{tag}>'


def track(*segments, name="Walk"):
    inner = "".join(
        f"<trkseg>{''.join(point_of(*point) for point in segment)}</trkseg>" for segment in segments
    )
    return f"<trk><name>{name}</name>{inner}</trk>"


def read(tmp_path, text, **options):
    path = tmp_path / "a.gpx"
    path.write_text(f"{HEAD}{text}</gpx>")
    found = import_file(path, ImportOptions(**options))
    return found.document.curves, found.remarks


def great_circle(first, second):
    """Metres on the sphere, by the haversine formula."""
    (a, b), (c, d) = (map(radians, pair[:2]) for pair in (first, second))
    return 2 * EARTH * asin(sqrt(sin((c - a) / 2) ** 2 + cos(a) * cos(c) * sin((d - b) / 2) ** 2))


def test_a_track_is_in_metres_and_seconds(tmp_path):
    (curve,), said = read(tmp_path, '<wpt lat="1" lon="2"/>' + track(WALK))
    assert curve.name == "Walk"
    assert [point.t for point in curve.points] == [0.0, 5.0, 8.0, 14.5]
    points = [(point.x, point.y) for point in curve.points]
    for k, (x, y) in enumerate(points):
        for other, (u, v) in enumerate(points):
            # Lengths are off by 1e-5 at most, as is said.
            assert hypot(x - u, y - v) == pytest.approx(
                great_circle(WALK[k], WALK[other]), rel=2e-5, abs=1e-8
            )
    assert points[1][0] == points[0][0]
    assert points[1][1] > points[0][1]  # north is up
    assert points[2][0] < points[1][0]  # west is left
    assert said[0] == (
        "Degrees were converted to metres around latitude 47.64485, longitude -122.32795 (equirectangular; "
        "east–west lengths are off by up to 0.00067 %). t is in seconds since 2009-10-17T18:37:26+00:00. "
        "Elevations are left out. 1 waypoint left out."
    )
    off = max(abs(cos(radians(latitude)) / cos(radians(47.64485)) - 1) for latitude, *_ in WALK)
    assert 100 * off == pytest.approx(0.00067, abs=5e-6)


def test_segments_and_routes_are_curves_that_share_one_clock_and_one_middle(tmp_path):
    text = track(WALK[:2], WALK[2:], [WALK[0]]) + track(WALK[1:3], name=" B\n b ")
    curves, said = read(tmp_path, text)
    assert said[0].endswith(" Elevations are left out. 1 single point left out.")
    assert [(each.name, [point.t for point in each.points]) for each in curves] == [
        ("Walk (1)", [0.0, 5.0]),
        ("Walk (2)", [8.0, 14.5]),
        ("B b", [5.0, 8.0]),
    ]
    assert curves[2].points[0].x == curves[0].points[1].x
    route = "".join(point_of(*point, tag="rtept") for point in WALK)
    curves, said = read(tmp_path, f"<rte>{route}</rte>")
    assert [each.name for each in curves] == ["Route"]
    assert "t is in seconds" in said[0]


def test_points_without_a_later_time_are_left_out_and_counted(tmp_path):
    late = [WALK[0], (47.7, -122.3, 26), (47.7, -122.3, 20), *WALK[1:]]
    (curve,), said = read(tmp_path, track(late))
    assert [point.t for point in curve.points] == [0.0, 5.0, 8.0, 14.5]
    assert " 2 points left out, as their times do not increase." in said[0]


@each_row(
    "points",
    [
        [point[:2] for point in WALK],
        [WALK[0], *[point[:2] for point in WALK[1:]]],
        [(latitude, longitude, 7) for latitude, longitude, _ in WALK],
        [(latitude, longitude, 59 - second) for latitude, longitude, second in WALK],
    ],
)
def test_times_that_do_not_increase_or_are_missing_are_left_out(points, tmp_path):
    (curve,), said = read(tmp_path, track(points))
    assert [point.t for point in curve.points] == [None] * 4
    has_times = any(len(point) > 2 for point in points)
    assert ("Times are left out because they do not increase." in said[0]) is has_times


def test_a_track_continues_across_the_date_line(tmp_path):
    """179.9° and −179.9° lie 22 km apart at the equator, not 40,000."""
    (curve,), _said = read(tmp_path, track([(0.0, 179.9), (0.1, -179.9), (0.0, -179.8)]))
    x = [point.x for point in curve.points]
    assert np.diff(x) == pytest.approx([EARTH * radians(0.2), EARTH * radians(0.1)], rel=1e-5)


def test_a_long_track_can_be_thinned_out(tmp_path):
    turns = np.linspace(0, 6, 400)
    points = [(50 + 0.001 * sin(turn), 8 + 0.001 * turn) for turn in turns]
    (curve,), _said = read(tmp_path, track(points), thin=0.5)
    assert 4 < len(curve.points) < 60


@each_row(
    ("text", "sentence"),
    [
        ("", "The GPX file contains no track or route of at least two points."),
        (track([WALK[0]]), "The GPX file contains no track or route of at least two points."),
        (
            track(WALK).replace('lat="47.6452"', 'lat="north"'),
            "Point 2 has no latitude and longitude in degrees.",
        ),
        (track(WALK).replace('lon="-122.329"', ""), "Point 4 has no latitude and longitude in degrees."),
        (
            track(WALK).replace('lat="47.6452"', 'lat="91"'),
            "Point 2 has no latitude and longitude in degrees.",
        ),
        (
            track(WALK).replace('lat="47.6452"', 'lat="nan"'),
            "Point 2 has no latitude and longitude in degrees.",
        ),
        ("<trk>", "The file is not XML: line 2, column "),
        ("<a>" * 300, "Element 201 is nested deeper than 200 levels."),
    ],
)
def test_invalid_tracks_are_refused_with_their_position(text, sentence):
    with pytest.raises(ExchangeError) as refusal:
        read_gpx(f"{HEAD}{text}</gpx>".encode())
    assert str(refusal.value).startswith(sentence)


def test_external_entities_are_not_read():
    bomb = '<!DOCTYPE gpx [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
    text = f"{bomb}<gpx>{track(WALK, name='&a;')}</gpx>"
    with pytest.raises(ExchangeError, match="entity"):
        read_gpx(text.encode())


def test_a_track_of_more_points_than_a_drawing_has_elements_is_read():
    table = read_gpx(f"{HEAD}{track([(50 + k / 1e5, 8.0) for k in range(11_000)])}</gpx>".encode())
    assert len(table.values) == 11_000
