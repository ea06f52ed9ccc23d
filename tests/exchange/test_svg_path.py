"""Path data as a second reader draws them: fontTools, which skips what it cannot read.

With an error, the segments before it are drawn: section 9.5.4 of SVG 2.
"""

from __future__ import annotations

import numpy as np
from fontTools.svgLib.path.parser import parse_path
from hypothesis import given
from hypothesis import strategies as st

from app.exchange.svg.shapes import read_path_data, read_points
from tests.rows import each_row

NUMBERS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "Z": 0}


class Pen:
    """What fontTools draws: of every subpath the start, the pieces, and whether it is closed."""

    def __init__(self):
        self.subpaths = []

    def moveTo(self, point):
        self.at = point
        self.subpaths.append([point, [], False])

    def curveTo(self, *points):
        self.subpaths[-1][1].append([self.at, *points])
        self.at = points[-1]

    def lineTo(self, end):
        a, b = np.array(self.at), np.array(end)
        third = (b - a) / 3
        self.curveTo(tuple(a + third), tuple(b - third), end)

    def qCurveTo(self, control, end):
        a, b, c = (np.array(each) for each in (self.at, control, end))
        self.curveTo(tuple(a + 2 / 3 * (b - a)), tuple(c + 2 / 3 * (b - c)), end)

    def closePath(self):
        self.subpaths[-1][2] = True

    def endPath(self):
        start, pieces, _ = self.subpaths[-1]
        self.subpaths[-1][2] = len(pieces) > 1 and pieces[-1][-1] == start


@st.composite
def path_data(draw):
    number = st.sampled_from([0.0, 1.0, 2.0, 3.5, -1.0, 10.0, 0.5, -0.25])
    words = ["M1.0 2.0"]
    for letter in draw(st.lists(st.sampled_from(sorted(NUMBERS)), max_size=8)):
        repeats = draw(st.integers(1, 2)) if letter != "Z" else 1
        values = [draw(number) for _ in range(NUMBERS[letter] * repeats)]
        words.append(draw(st.sampled_from([letter, letter.lower()])) + " ".join(map(repr, values)))
    return "".join(words)


@given(path_data())
def test_path_data_are_drawn_as_in_fonttools(data):
    found = read_path_data(data)
    assert found.error == ""
    assert_drawn(found.subpaths, data)


def assert_drawn(found, data):
    """Assert that subpaths are those that fontTools draws of data without an error."""
    pen = Pen()
    parse_path(data, pen)
    assert len(found) == len(pen.subpaths)
    for subpath, (start, pieces, closed) in zip(found, pen.subpaths, strict=True):
        assert tuple(subpath.start) == start
        np.testing.assert_array_equal(subpath.controls, np.array(pieces).reshape(-1, 4, 2))
        assert subpath.closed == closed


@each_row(
    ("data", "place", "drawn"),
    [
        ("L0 0", 1, ""),
        (",M0 0", 1, ""),
        ("M,0 0", 2, ""),
        ("M0 0L , 1 1", 7, "M0 0"),
        ("M0 0L1 1,,x", 10, "M0 0L1 1"),
        ("M0 0L1 1 ,, 2 2", 11, "M0 0L1 1"),
        ("M0 0x,,", 5, "M0 0"),
        ("M0 0V H1", 7, "M0 0"),
        ("M0 0Az", 6, "M0 0"),
        ("M0 0L1 1 2z", 11, "M0 0L1 1"),
        ("M0 0a1 1 0 02 3 4", 13, "M0 0"),
        ("M0 0L1.. 2", 7, "M0 0"),
        ("M0 0 L1 2 3 4 NaN 1", 15, "M0 0L1 2 3 4"),
        ("M0 0C1 1 2 2 3 3 4 4 5 x 6 6", 24, "M0 0C1 1 2 2 3 3"),
        ("M0 0 L1 2 3 1e999 1", 13, "M0 0L1 2"),
        ("M0 0 L1 2 1e999 1", 11, "M0 0L1 2"),
        ("M0 0L3 0 3 3zM8 8h2#L", 20, "M0 0L3 0 3 3zM8 8h2"),
        # The segment that closes the path is complete.
        ("M0 0L3 0 3 3 Z 5 5", 16, "M0 0L3 0 3 3Z"),
    ],
)
def test_data_are_drawn_up_to_the_first_error(data, place, drawn):
    found = read_path_data(data)
    assert found.error == f"at character {place}, “{data[place - 1 : place + 11]}”"
    assert_drawn(found.subpaths, drawn)


@each_row(
    ("data", "drawn"),
    [
        ("M0 0V", "M0 0"),
        ("M0 0 a", "M0 0"),
        ("M0 0C1 2 3 4 5 ", "M0 0"),
        ("M", ""),
        ("M0 0h", "M0 0"),
        # The case of the issue.
        ("M5 5L20 5 20 20L35", "M5 5L20 5 20 20"),
    ],
)
def test_path_data_with_a_missing_end_are_drawn_up_to_the_end(data, drawn):
    found = read_path_data(data)
    assert found.error == "at the end"
    assert_drawn(found.subpaths, drawn)


@given(path_data(), st.sampled_from(["#", "x1 2", "é", "M", "L?", "NaN", "z7", "C1 2 3 4 5,", "a1 1 0 3"]))
def test_segments_before_an_error_are_drawn(data, rest):
    """The data and whatever breaks them, put together: fontTools draws the data alone."""
    closes = rest.startswith("z")
    found = read_path_data(data + rest)
    assert found.error
    assert_drawn(found.subpaths, data + "z" * closes)


@each_row(
    ("points", "error", "drawn"),
    [
        ("1 2 3,4-5-6", "", "M1 2 3 4-5-6"),
        (" ", "", ""),
        # An odd number: the last one is ignored.
        ("1 2 3 4 5", "at the end", "M1 2 3 4"),
        ("1 2 3 4 x 6 7 8", "at character 9, “x 6 7 8”", "M1 2 3 4"),
        ("1 2 3 4 5 6% 7 8", "at character 12, “% 7 8”", "M1 2 3 4 5 6"),
        # Letters are no commands here.
        ("1 2 3 4 L 6 7 8 9", "at character 9, “L 6 7 8 9”", "M1 2 3 4"),
        ("1 2 3 4,,5 6", "at character 9, “,5 6”", "M1 2 3 4"),
        ("none", "at character 1, “none”", ""),
    ],
)
def test_points_are_joined_up_to_the_first_error(points, error, drawn):
    for closed in (False, True):
        found = read_points(points, closed=closed)
        assert found.error == error
        assert_drawn(found.subpaths, drawn + "z" * (closed and bool(drawn)))


@each_row(
    ("data", "end"),
    [
        ("M007 00.5", (7, 0.5)),
        ("M0 0-6.5e-1.5", (-0.65, 0.5)),
        ("m1 1 1 1", (2, 2)),
        ("M0 0a1 1\n0\n012 3", (2, 3)),
        ("M0 0a1 1 0 00-.5.25", (-0.5, 0.25)),
        ("M1 2,L3 4,", (3, 4)),
        ("M1 1L2 2Zl3 0", (4, 1)),
        ("M1.,1.L2.-3.", (2, -3)),
    ],
)
def test_compact_numbers_and_flags(data, end):
    assert tuple(read_path_data(data).subpaths[-1].end) == end


def test_a_last_line_as_short_as_a_rounding_is_dropped():
    """Steps of eight digits miss the beginning, and the path had two points there, on each other."""
    ((found,), _) = read_path_data("m 10,10 c 0,20 30,20 30,0 0,-20 -30.000004,-20 -30.000007,0.000004 z")
    assert (len(found.controls), found.closed) == (2, True)
    assert found.end.tolist() == [10, 10]
    ((found,), _) = read_path_data("m 10,10 20,0 0,20 -20.000003,-20.000002 z")
    assert len(found.controls) == 3
    assert found.end.tolist() == [10, 10]
    # Small as it is, this one is meant.
    ((found,), _) = read_path_data("m 10,10 20,0 0,20 -20.003,-20 z")
    assert len(found.controls) == 4
