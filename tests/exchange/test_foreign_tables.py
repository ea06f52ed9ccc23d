"""Tables as other programs write them: roles of their columns, and rows that are no points."""

from __future__ import annotations

import io
import json

import numpy as np
import pytest

from app.cli import main
from app.exchange.errors import ExchangeError
from app.exchange.files import ImportOptions, import_file
from app.exchange.formats import FORMATS, ContentKind
from app.exchange.table.columns import guess, mapping_summary, role_of
from tests.rows import each_row


def read(tmp_path, name, content, **options):
    """What comes of a file: the names and points of its curves, and what is said."""
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    found = import_file(path, ImportOptions(**options))
    curves = {
        each.name: [(point.t, point.x, point.y) for point in each.points] for each in found.document.curves
    }
    return curves, found.remarks


def points(*pairs):
    return [(None, float(x), float(y)) for x, y in pairs]


def npy(array, **options):
    stream = io.BytesIO()
    np.save(stream, array, **options)
    return stream.getvalue()


TWO_LINES = [[[9, 53, 4], [10, 54]], [[1, 2], [3, 4]]]
FEATURES = {
    "type": "FeatureCollection",
    "features": [
        {
            "type": "Feature",
            "properties": {"name": "Elbe"},
            "geometry": {"type": "MultiLineString", "coordinates": TWO_LINES},
        },
        {"type": "Feature", "geometry": {"type": "LineString", "coordinates": [[5, 6], [7, 8]]}},
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}},
    ],
}
DAMAGED = "not a .npy file, or its header is damaged"
FIRST_TWO = ("Columns: x = column 1, y = column 2.",)
PAIR = points((0, 1), (2, 3))

# The name, the content, the curves, and what is said.
TABLES = [
    (
        "pandas.csv",
        ",time,pos_x,pos_y\n0,0.0,1.5,2\n1,0.1,2.5,3\n",
        {"pandas": [(0.0, 1.5, 2.0), (0.1, 2.5, 3.0)]},
        ("Columns: t = “time”, x = “pos_x”, y = “pos_y”. Left out: column 1.",),
    ),
    (
        "index.csv",
        ",width,height\n0,0,1\n1,2,3\n",
        {"index": PAIR},
        ("Columns: x = “width”, y = “height”. Left out: column 1.",),
    ),
    ("graph.csv", "time,speed\n0,1\n2,3\n", {"graph": PAIR}, ("Columns: x = “time”, y = “speed”.",)),
    ("de.csv", "X-Wert;Y-Wert\n0;1\n2,0;3\n", {"de": PAIR}, ("Columns: x = “X-Wert”, y = “Y-Wert”.",)),
    ("track.csv", "lat,lon\n1,0\n3,2\n", {"track": PAIR}, ("Columns: x = “lon”, y = “lat”.",)),
    (
        "labels.csv",
        "place,x,y\nA,0,1\nB,2,3\n",
        {"labels": PAIR},
        ("Columns: x = “x”, y = “y”. Left out: “place”.",),
    ),
    (
        "units.csv",
        "time,x,y\ns,mm,mm\n0,1,2\n1,2,3\n",
        {"units": [(0.0, 1.0, 2.0), (1.0, 2.0, 3.0)]},
        ("The row below the titles contains units.", "Columns: t = “time”, x = “x”, y = “y”."),
    ),
    (
        "empty.csv",
        "x,y,note\n0,1,\n2,3,\n",
        {"empty": PAIR},
        ("Columns: x = “x”, y = “y”. Left out: “note”.",),
    ),
    (
        "selig.dat",
        "NACA 2412\n1.0 0.0\n0.5 0.05\n0 0\n0.5 -0.05\n1 0\n",
        {"selig": points((1, 0), (0.5, 0.05), (0, 0), (0.5, -0.05), (1, 0))},
        ("Not read as numbers: “NACA 2412”.", FIRST_TWO[0]),
    ),
    (
        "lednicer.dat",
        "CLARK Y AIRFOIL\n   3.   2.\n\n 0 0\n .5 .1\n 1 0\n\n 0 0\n 1 0\n",
        {"lednicer (1)": points((0, 0), (0.5, 0.1), (1, 0)), "lednicer (2)": points((0, 0), (1, 0))},
        (
            "Not read as numbers: “CLARK Y AIRFOIL”.",
            FIRST_TWO[0],
            "The rows are divided into 2 curves.",
        ),
    ),
    (
        "blocks.dat",
        "# of gnuplot\n0 1\n2 3\n\n\n# the second\n0 1\n2 3\n4 5\n",
        {"blocks (1)": PAIR, "blocks (2)": [*PAIR, *points((4, 5))]},
        (FIRST_TWO[0], "The rows are divided into 2 curves."),
    ),
    ("pairs.json", "[[0, 1], [2, 3]]", {"pairs": PAIR}, FIRST_TWO),
    ("records.json", '[{"y":1,"x":0},{"x":2,"y":3}]', {"records": PAIR}, ("Columns: x = “x”, y = “y”.",)),
    ("columns.json", '{"x": [0, 2], "y": [1, 3]}', {"columns": PAIR}, ()),
    ("array.npy", npy(np.array([[0, 1], [2, 3]])), {"array": PAIR}, FIRST_TWO),
    ("complex.npy", npy(np.array([1j, 2 + 3j])), {"complex": PAIR}, FIRST_TWO),
    (
        "named.npy",
        npy(np.array([(1, 0), (3, 2)], dtype=[("y", "i4"), ("x", "f4")])),
        {"named": PAIR},
        ("Columns: x = “x”, y = “y”.",),
    ),
    (
        "cube.npy",
        npy(np.asfortranarray(np.arange(12).reshape(2, 3, 2))),
        {"cube (1)": points((0, 1), (2, 3), (4, 5)), "cube (2)": points((6, 7), (8, 9), (10, 11))},
        (FIRST_TWO[0], "The rows are divided into 2 curves."),
    ),
    (
        "rivers.geojson",
        json.dumps(FEATURES),
        {
            "Elbe (1)": points((9, 53), (10, 54)),
            "Elbe (2)": points((1, 2), (3, 4)),
            "Line 2": points((5, 6), (7, 8)),
        },
        ("Left out: 1 Point.", "Columns: x = “lon”, y = “lat”, curve = “curve”."),
    ),
]  # fmt: skip


@each_row(("name", "content", "curves", "said"), TABLES, ids=[each[0] for each in TABLES])
def test_tables_of_other_programs_are_read_with_remarks(name, content, curves, said, tmp_path):
    assert read(tmp_path, name, content) == (curves, said)


@each_row(
    ("missing", "curves"),
    [
        ("skip", {"a": points((0, 1), (1, 2), (3, 4), (5, 3))}),
        ("split", {"a (1)": points((0, 1), (1, 2)), "a (2)": points((3, 4), (5, 3))}),
    ],
)
@each_row("gap", ["nan,nan", "NaN,3", ",", "NA,NA", "2,"])
def test_rows_without_numbers_are_left_out_or_end_the_curve(missing, curves, gap, tmp_path):
    text = f"x,y\n0,1\n1,2\n{gap}\n3,4\n5,3\n"
    assert read(tmp_path, "a.csv", text, missing=missing)[0] == curves
    with pytest.raises(ExchangeError, match=r"Row 4, column \d.* Use --missing skip"):
        read(tmp_path, "a.csv", text)
    arrays = {"a.json": json.dumps([[0, 1], [1, 2], [None, 2], [3, 4], [5, 3]])}
    arrays["a.npy"] = npy(np.array([[0, 1], [1, 2], [np.nan, 2], [3, 4], [5, 3]]))
    for name, content in arrays.items():
        assert read(tmp_path, name, content, missing=missing)[0] == curves


@each_row(
    ("name", "content", "sentence"),
    [
        ("a.npy", npy(np.array([{}], dtype=object), allow_pickle=True), "contains Python objects"),
        ("a.npy", npy(np.zeros((4, 2)))[:-8], "size of the .npy file does not match its header"),
        ("a.npy", npy(np.zeros((4, 2))).replace(b"(4, 2), }   ", b"(9**9, 2), }"), DAMAGED),
        ("a.npy", npy(np.zeros((4, 2))).replace(b"(4, 2), }   ", b"(9999, 2), }"), "not match its header"),
        ("a.npy", b"\x93NUMPY\x01\x00", DAMAGED),
        ("a.npy", npy(np.array(["x", "y"])), "The array contains <U1, not real numbers"),
        ("a.npy", npy(np.zeros(4)), "it can be rows of 2 or more numbers"),
        ("a.npy", npy(np.array([[0, 1], [1, 1e13]])), "Row 2, column 2 must lie between"),
        ("a.json", "[[0, 1], [2]]", "Row 2 does not have 2 numbers like the first row"),
        ("a.json", '[[0, 1], [2, "3"]]', "Row 2, column 2: “3” is not a number"),
        ("a.json", "[[0, true], [2, 3]]", "Row 1, column 2: “True” is not a number"),
        ("a.json", "[[0, 1e999], [2, 3]]", "[0][1] must lie between -1e12 and 1e12"),
        ("a.json", '{"x": [1, 2], "y": [1]}', "The columns differ in length"),
        ("a.json", "[" * 10_000, "The file is nested too deeply"),
        ("a.json", "[1, 2, 3]", "The JSON file is not a table; it can be a list of points"),
        ("a.json", '{"type": "LineString"}', "The GeoJSON is damaged: a LineString without coordinates"),
        ("a.json", '{"type": "Point", "coordinates": [1, 2]}', "file contains no lines. Left out: 1 Point"),
        ("a.json", '{"format": "curvebench", "version": 4, "curves": []}', "curves must hold at least"),
    ],
)  # fmt: skip
def test_files_that_are_no_table_are_refused(name, content, sentence, tmp_path):
    with pytest.raises(ExchangeError) as refusal:
        read(tmp_path, name, content)
    assert sentence in str(refusal.value)


@each_row(
    ("title", "role"),
    [
        ("t", "t"), ("Time [s]", "t"), ("time_s", "t"), ("Zeit", "t"), ("pos_x", "x"), ("posX", "x"),
        ("X (mm)", "x"), ("Longitude", "x"), ("y-coordinate", "y"), ("LAT", "y"), ("vel_x", "vx"),
        ("ax", "ax"), ("vx_after", "vx_after"), ("curve", "curve"),
        ("max", ""), ("day", ""), ("exact", ""), ("Column 1", ""), ("text", ""), ("timestamp", ""), ("", ""),
    ],
)  # fmt: skip
def test_columns_are_recognised_by_their_names(title, role):
    assert role_of(title) == role


def test_the_command_line_requires_ambiguous_columns(tmp_path, capsys):
    path = tmp_path / "three.txt"
    path.write_text("0 1 5\n1 3 5\n2 2 6\n", encoding="utf-8")
    out = tmp_path / "out.curve.json"
    assert main(["convert", str(path), str(out)]) == 1
    assert capsys.readouterr().err == (
        "curvebench: “three.txt” cannot be read: Which columns are x and y? The table has 1 (0, …); "
        "2 (1, …); 3 (5, …). Use --columns x=1,y=2 or t=1,x=2,y=3, by title or number.\n"
    )
    assert main(["convert", str(path), str(out), "--columns", "t=1,x=2,y=3"]) == 0
    output = capsys.readouterr()
    assert output.err == "curvebench: Columns: t = column 1, x = column 2, y = column 3.\n"
    (curve,) = import_file(out).document.curves
    assert [(point.t, point.x, point.y) for point in curve.points] == [(0, 1, 5), (1, 3, 5), (2, 2, 6)]


def test_columns_are_selected_by_title_and_by_number(tmp_path):
    text = "when,a,b\n0,1,2\n1,3,4\n"
    with pytest.raises(ExchangeError, match=r"The table has 1 when \(0, …\); 2 a \(1, …\); 3 b \(2, …\)"):
        read(tmp_path, "a.csv", text)
    curves, said = read(tmp_path, "a.csv", text, columns="t=when, x=3,y=A")
    assert curves == {"a": [(0.0, 2.0, 1.0), (1.0, 4.0, 3.0)]}
    assert said == ("Columns: t = “when”, x = “b”, y = “a”.",)
    for columns, sentence in (
        ("x=a,y=c", "There is no column “c”; the columns are “when”, “a”, “b”."),
        ("x=a,z=b", "“z” is not the role of a column; use x, y, t, vx"),
        ("x=a", "A curve needs x and y"),
        ("x=a,y=4", "There is no column “4”"),
    ):
        with pytest.raises(ExchangeError, match=sentence):
            read(tmp_path, "a.csv", text, columns=columns)


def test_a_command_can_choose_columns_to_read_and_columns_to_write(tmp_path):
    path, out = tmp_path / "a.csv", tmp_path / "b.csv"
    path.write_text("p,q,r\n0,1,2\n1,3,4\n", encoding="utf-8")
    words = ["--columns", "x=q,y=r", "--columns", "t,x", "--samples", "2"]
    assert main(["convert", str(path), str(out), *words]) == 0
    assert out.read_text(encoding="utf-8").splitlines()[0] == "t,x"


def test_the_summary_names_the_columns_left_out():
    titles = ("t", "x", "y", "note")
    summary = mapping_summary(guess(titles).mapping, titles)
    assert summary == "Columns: t = “t”, x = “x”, y = “y”. Left out: “note”."


@each_row("each", FORMATS.read, ids=lambda each: each.title)
def test_every_format_has_its_reader(each):
    assert each.title
    assert callable(each.read) or each.kind is ContentKind.DOCUMENT or each.title == "Table"
