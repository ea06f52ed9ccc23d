"""Titles in comments above a table: as NumPy, gnuplot and others write them, and when they are none."""

from __future__ import annotations

import io
from itertools import product

import numpy as np
import pytest

from app.exchange.files import ImportOptions, import_file
from app.exchange.table.columns import ColumnMapping, guess, role_of
from app.exchange.table.text import comment_in, is_data
from tests.rows import each_row

HASH_YX = "# y,x\n0.96,3.56\n4.93,6.58\n8.89,9.61\n"
RACELINE = (
    "# s_m; x_m; y_m; psi_rad; kappa_radpm; vx_mps; ax_mps2\n"
    "0.0; 0.0; 0.0; 1.57; 0.0; 20.0; 1.0\n2.0; 0.1; 2.0; 1.55; 0.01; 20.1; 1.0\n"
)


def read(tmp_path, text, **options):
    """The points of the one curve in a table of text, and what is said of it."""
    path = tmp_path / "a.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    found = import_file(path, ImportOptions(**options))
    (curve,) = found.document.curves
    return [(point.t, point.x, point.y) for point in curve.points], found.remarks


def test_titles_in_a_comment_give_the_roles_of_the_columns(tmp_path):
    """“# y,x” was passed over, and x and y were exchanged without a word."""
    points, said = read(tmp_path, HASH_YX)
    assert points == [(None, 3.56, 0.96), (None, 6.58, 4.93), (None, 9.61, 8.89)]
    assert said == ("Columns: x = “x”, y = “y”.",)


@each_row(
    ("text", "said"),
    [
        ("t,x,y\n0,1,2\n1,3,4\n", ()),
        ("# x,y,vx,vy\n1,2,0,1\n3,4,0,1\n", ()),
        ("# x,y\n1,2\n3,4\n# x,y\n5,6\n7,8\n", ()),
        (
            "# x,y\n1,2\n3,4\n# y,x\n5,6\n7,8\n",
            ("The titles “y, x” in a comment below the first row are ignored.",),
        ),
        ("t,y,x\n0,1,2\n1,3,4\n", ("Columns: t = “t”, x = “x”, y = “y”.",)),
        ("x,y,z\n1,2,5\n3,4,6\n", ("Columns: x = “x”, y = “y”. Left out: “z”.",)),
        ("X,Y\n1,2\n3,4\n", ("Columns: x = “X”, y = “Y”.",)),
    ],
)
def test_columns_named_after_their_roles_give_no_remark(text, said, tmp_path):
    assert read(tmp_path, text)[1] == said


def test_a_race_line_has_units_behind_its_titles_and_no_velocities(tmp_path):
    """Its “vx” is the speed along the way: without a “vy” it is no coordinate of a velocity."""
    points, said = read(tmp_path, RACELINE)
    assert points == [(0.0, 0.0, 0.0), (2.0, 0.1, 2.0)]
    assert said == (
        "Columns: t = “s_m”, x = “x_m”, y = “y_m”. Left out: “psi_rad”, “kappa_radpm”, “vx_mps”, “ax_mps2”.",
    )


@pytest.mark.parametrize("header", ["y x t", "y,x,t", "y [m], x [m], t [s]", "y_m\tx_m\ttime_s", "y; x; t"])
@pytest.mark.parametrize("delimiter", [" ", ",", "\t", ";", ", "])
def test_tables_of_savetxt_are_read_number_by_number(tmp_path, header, delimiter):
    """Its usual delimiter is a blank, whatever stands in the header."""
    values = np.random.default_rng(32).normal(size=(9, 3))
    values[:, 2] = np.arange(9)
    stream = io.StringIO()
    np.savetxt(stream, values, delimiter=delimiter, header=f"of one run\n{header}")
    points, _said = read(tmp_path, stream.getvalue())
    assert np.array(points).tolist() == values[:, [2, 1, 0]].tolist()


def test_every_mark_separator_and_decimal_mark(tmp_path):
    marks, separators = ("#", "# ", "##", "% ", "%", "// "), ("; ", "\t", " ", ";")
    for mark, separator, decimal in product(marks, separators, ".,"):
        rows = [separator.join(cells).replace(".", decimal) for cells in (("1.5", "2.5"), ("3.5", "-4.5"))]
        text = "\n".join([f"{mark}lat{separator}lon", *rows])
        points, _said = read(tmp_path, text)
        assert points == [(None, 2.5, 1.5), (None, -4.5, 3.5)], text
    assert read(tmp_path, "; y x\n1 2\n3 4\n")[0] == [(None, 2.0, 1.0), (None, 4.0, 3.0)]


@each_row(
    ("text", "x"),
    [
        ("# x y\n# y x\n1 2\n3 4\n", 2.0),  # the last one
        ("# y x\n# of the second day\n1 2\n3 4\n", 2.0),  # that fits
        ("# Columns: y, x\n1,2\n3,4\n", 2.0),
        ("#,y,x\n0,1,2\n1,3,4\n", 2.0),  # an index without a title
        ('# "y","x"\n1,2\n3,4\n', 2.0),
        ("# y,x\nx,y\n1,2\n3,4\n", 1.0),  # titles of the table's own count
        ("1 2\n# y x\n3 4\n", 1.0),  # below the first row
        ("# of gnuplot\n1 2\n3 4\n", 1.0),  # a sentence of two words
        ("# 5 6\n1 2\n3 4\n", 1.0),  # a row that somebody took out
    ],
)
def test_which_comment_holds_titles(text, x, tmp_path):
    assert read(tmp_path, text)[0][0][1] == x


def test_columns_with_other_titles_can_be_chosen_by_name(tmp_path):
    text = "# width, height, depth\n1,2,3\n4,5,6\n"
    assert read(tmp_path, text, columns="x=depth,y=width")[0] == [(None, 3.0, 1.0), (None, 6.0, 4.0)]


@each_row(
    ("text", "said"),
    [
        ("# y,x,speed\n1,2\n3,4\n", "The comment “y,x,speed” does not have one title for each column. "),
        ("# measured in May\n1,2\n3,4\n", ""),
        ("1,2\n3,4\n# y,x\n5,6\n", "The titles “y, x” in a comment below the first row are ignored. "),
        ("1,2\n3,4\n# of x and y\n5,6\n", ""),
    ],
)
def test_a_comment_with_titles_that_do_not_fit_gives_a_remark(text, said, tmp_path):
    points, remarks = read(tmp_path, text)
    assert points[0] == (None, 1.0, 2.0)
    assert " ".join(remarks) == f"{said}Columns: x = column 1, y = column 2."


@each_row(
    ("line", "comment"),
    [("# a", "a"), ("  %% a,b ", "a,b"), ("//x y", "x y"), ("; x y", "x y"), ("#", ""), ("1 2", "")],
)
def test_marks_of_comments(line, comment):
    assert comment_in(line) == comment
    assert is_data(line) is (line == "1 2")


@each_row("line", [";1;2", "; 5", ";x;y", ";nan", "; nan ", ";NA;", "/a", "-1 2"])
def test_an_empty_cell_before_a_semicolon_is_no_comment(line):
    assert is_data(line)


@each_row(
    ("title", "role"),
    [
        ("x_m", "x"), ("y [m]", "y"), ("x in m", "x"), ("y {mm}", "y"), ("x/m", "x"), ("t_sec", "t"),
        ("x meters", "x"), ("vx_m/s", "vx"), ("vy [m/s]", "vy"), ("vx_mps", "vx"), ("m", ""),
    ],
)  # fmt: skip
def test_units_behind_titles(title, role):
    assert role_of(title) == role


def test_an_increasing_column_of_lengths_is_t_without_another_one():
    titles, rows = ("s_m", "x", "y"), [("0,5", "1", "2"), ("1", "2", "3")]
    assert guess(titles, rows).mapping == ColumnMapping(1, 2, t=0)
    assert guess(titles, rows[::-1]).mapping == ColumnMapping(1, 2)
    assert guess(titles).mapping == ColumnMapping(1, 2)
    assert guess((*titles, "t"), [(*row, "7") for row in rows]).mapping == ColumnMapping(1, 2, t=3)
    timed = ColumnMapping(1, 2, vx=3, vy=4)  # velocities are per second, not per metre
    assert guess((*titles, "vx", "vy"), [(*row, "7", "7") for row in rows]).mapping == timed
