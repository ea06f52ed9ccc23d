"""CSV and TSV in: what spreadsheets and programs write, and what is refused, by row."""

import tracemalloc

import msgspec
import numpy as np
import pytest

from app.document.model import Document, Point, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.formats.tables import sampled_table
from app.exchange.options import Options
from app.exchange.table import text as tables_of_text
from app.exchange.table.columns import ColumnMapping
from app.exchange.table.curves import TableOptions
from app.exchange.table.table import TextLayout
from app.exchange.table.text import preview_table
from app.exchange.table.thinning import thin_out
from app.families import HERMITE, LAGRANGE, QUINTIC_HERMITE
from app.storage.format import encode
from app.storage.validation import validate
from app.view_model.curve.curve_view import view_of
from tests.effort import calls_of
from tests.rows import each_row
from tests.tables import document_of_table, read_table

ROWS = [[0.0, 1.5, -2.0], [1.0, 2.25, 3.0], [2.5, 1e-3, 4e5]]


@each_row(
    "text",
    [
        "t,x,y\n0,1.5,-2\n1,2.25,3\n2.5,1e-3,4e5\n",
        "t\tx\ty\r\n0\t1.5\t-2\r\n1\t2.25\t3\r\n2.5\t.001\t4E+5\r\n",
        "t;x;y\n0;1,5;-2\n1;2,25;3,0\n2,5;0,001;400000\n",
        "0 1.5 -2\n1 2.25 3\n  2.5   1e-3 4e5",
        "0\t1,5\t-2\n1\t2,25\t3\n2,5\t0,001\t4e5",
        '"t","x","y"\n"0","1.5","-2"\n"1","2.25","3"\n"2.5","1e-3","4e5"\n',
        "# made by hand\n\nt, x, y\n0, 1.5, -2\n# a pause\n1, 2.25, 3\n\n2.5, 1e-3, 4e5\n\n",
        "\ufefft,x,y\n0,1.5,-2\n1,2.25,3\n2.5,1e-3,4e5\n",
        "0;1.5;-2;\n1;2.25;3;\n2.5;1e-3;4e5;\n",
    ],
)
def test_many_layouts_hold_the_same_numbers(text):
    table = read_table(text.encode())
    assert table.values.tolist() == ROWS
    made = document_of_table(table)
    document, deviation = made.document, made.deviation
    assert deviation == 0
    assert [(n.t, n.x, n.y) for n in document.curves[0].points] == [tuple(row) for row in ROWS]


def test_utf_16_tables_of_spreadsheets_are_read():
    text = "t\tx\ty\r\n0\t1,5\t-2\r\n1\t2,25\t3\r\n2,5\t0,001\t400000\r\n"
    assert read_table(text.encode("utf-16")).values.tolist() == ROWS


@each_row(
    ("text", "sentence"),
    [
        ("", "The file is empty."),
        (" \n\n", "The file is empty."),
        ("# only words\n", "The table contains no rows of numbers."),
        ("x,y\n", "Row 1, column 1: “x” is not a number."),
        ("x,y\n1,2\n3,4,5\n", "Row 3 has 3 cells; the first row has 2."),
        ("x,y\n1,2\n\n3,four\n", "Row 4, column 2: “four” is not a number."),
        ("x,y\n1,2\n3\n", "Row 3 has 1 cells; the first row has 2."),
        (
            "x,y\n1,2\n=cmd|' /C calc'!A0,4\n",
            "Row 3, column 1: “=cmd|' /C calc'!A0” is a formula; only numbers are read.",
        ),
        ("x,y\n1,2\n@SUM(A1),4\n", "Row 3, column 1: “@SUM(A1)” is a formula; only numbers are read."),
        ("x,y\n1,2\n-cmd(1),4\n", "Row 3, column 1: “-cmd(1)” is a formula; only numbers are read."),
        ("x,y\n1,2\nnan,4\n", "Row 3, column 1: “nan” is not a number."),
        ("x,y\n1,2\ninf,4\n", "Row 3, column 1: “inf” is not a number."),
        ("x,y\n1,2\n9**9**9,4\n", "Row 3, column 1: “9**9**9” is not a number."),
        ("x,y\n1,2\n__import__('os'),4\n", "Row 3, column 1: “__import__('os')” is not a number."),
        ("x,y\n1,2\n1e999,4\n", "Row 3, column 1 must lie between −1e12 and 1e12."),
        ("x,y\n1,2\n1e13,4\n", "Row 3, column 1 must lie between −1e12 and 1e12."),
        ("x,y\n1,2\n1_0,4\n", "Row 3, column 1: “1_0” is not a number."),
        ("x,y\n1,2\n0x10,4\n", "Row 3, column 1: “0x10” is not a number."),
        ("x,y\n1,2\n1\0,4\n", "Row 3 contains a zero byte; this is not text."),
    ],
)
def test_invalid_tables_are_refused_with_the_row(text, sentence):
    with pytest.raises(ExchangeError) as refusal:
        read_table(text.encode(), ColumnMapping(x=0, y=1))
    assert str(refusal.value) == sentence


def test_bad_utf_8_is_refused_with_the_row():
    with pytest.raises(ExchangeError, match="Row 2 is not UTF-8 text"):
        read_table(b"1,2\n3,\xff\n")


@each_row(
    ("text", "sentence"),
    [
        ("x,y\n1,2\n", "The table has only one row of numbers; a curve needs two points."),
        ("x\n1\n2\n", "The table has only one column; a curve needs x and y."),
        ("t,x,y\n0,1,2\n1,1,2\n1,3,4\n", "Row 4: t must increase from row to row."),
        ("t,x,y\n0,1,2\n-1,1,2\n", "Row 3: t must increase from row to row."),
        ("t,x,y\n\n0,1,2\n# pause\n\n1,1,2\n\n1,3,4\n", "Row 8: t must increase from row to row."),
        ("x\ty\n1\t2\n\n3\t\n", "Row 4, column 2 is empty, but y is needed."),
    ],
)
def test_tables_that_are_no_curve_are_refused(text, sentence):
    with pytest.raises(ExchangeError) as refusal:
        document_of_table(read_table(text.encode()))
    assert str(refusal.value) == sentence


def test_the_preview_shows_the_first_rows_and_a_guess_of_the_roles():
    preview = preview_table(b"Y [mm];time;X [mm]\n1,5;2;3\n" * 1)
    assert preview.layout == TextLayout(";", decimal_comma=True, header=True)
    assert preview.titles == ("Y [mm]", "time", "X [mm]")
    assert preview.cells == (("1,5", "2", "3"),)
    assert preview.mapping == ColumnMapping(x=2, y=0, t=1)
    assert preview_table(b"1 2 3\n4 5 6").mapping == ColumnMapping(x=1, y=2, t=0)
    assert preview_table(b"1\n2").mapping is None
    assert len(preview_table(b"1,2\n" * 1000).cells) == 50


def test_columns_are_mapped_by_their_roles():
    mapping = ColumnMapping(x=1, y=0, t=3)
    table = read_table(b"5,1,2,7\n6,3,4,8\n", mapping)
    document = document_of_table(table, mapping, TableOptions(family=LAGRANGE, name="mine")).document
    curve = document.curves[0]
    assert (curve.name, curve.family) == ("mine", LAGRANGE)
    assert [(n.x, n.y, n.t) for n in curve.points] == [(1, 5, 7), (3, 6, 8)]
    with pytest.raises(ExchangeError, match="There is no column 9 for y"):
        document_of_table(table, ColumnMapping(x=0, y=8))


def test_a_written_table_reads_back_as_the_same_quintic():
    curve = make_curve(np.random.default_rng(4).normal(size=(6, 2)).tolist(), family=QUINTIC_HERMITE)
    core = view_of(curve).curve
    written = sampled_table(Document((curve,)), Options(format_options={"samples": 60}))
    # Curvature and length are not roles; the rest is.
    document = document_of_table(
        read_table(written.text.encode()), options=TableOptions(family=curve.family)
    ).document
    back = view_of(document.curves[0]).curve
    t = np.linspace(*core.domain, 500)
    assert np.abs(back.evaluate(t) - core.evaluate(t)).max() < 1e-3


def test_empty_cells_matter_only_in_used_columns():
    # The curvature of a point at rest is empty in our own tables.
    curve = make_curve([(0, 0), (1, 1), (2, 0)], family=HERMITE)
    first = Point(0.0, 0.0, velocity=(0.0, 0.0))
    curve = msgspec.structs.replace(curve, points=(first, *curve.points[1:]))
    text = sampled_table(Document((curve,)), Options(format_options={"samples": 9})).text
    assert [place for place, cell in enumerate(text.splitlines()[1].split(",")) if not cell] == [7]
    table = read_table(text.encode())
    assert np.isfinite(table.values[:, :7]).all()
    document = document_of_table(table).document
    assert document.curves[0].points[0].velocity == (0.0, 0.0)


@pytest.mark.parametrize("tolerance", [1e-1, 1e-3, 1e-5])
def test_a_thinned_table_stays_within_the_tolerance(tolerance):
    angles = np.linspace(0, 7, 4001)
    points = np.column_stack([np.cos(angles) * angles, np.sin(angles)])
    kept = thin_out(points, None, tolerance)
    assert kept.deviation <= tolerance
    assert len(kept.rows) < 40 * tolerance**-0.25
    text = "\n".join(f"{x!r},{y!r}" for x, y in points.tolist())
    made = document_of_table(read_table(text.encode()), options=TableOptions(thin=tolerance))
    document, deviation = made.document, made.deviation
    core = view_of(document.curves[0]).curve
    length = np.append(0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    assert np.hypot(*(core.evaluate(length) - points).T).max() == pytest.approx(deviation)


def test_thinning_keeps_a_corner_and_skips_repeated_points():
    x = np.linspace(-1, 1, 401)
    points = np.repeat(np.column_stack([x, np.abs(x)]), 2, axis=0)
    kept = thin_out(points, None, 1e-4)
    assert kept.deviation <= 1e-4
    assert len(kept.rows) < 60
    assert (0.0, 0.0) in [tuple(p) for p in points[kept.rows].round(9).tolist()]


def test_thinning_refuses_impossible_tolerances():
    noise = np.random.default_rng(0).normal(size=(30_000, 2))
    with pytest.raises(ExchangeError, match="More than 20000 points would be left"):
        thin_out(noise, None, 1e-6)
    with pytest.raises(ExchangeError, match="All points coincide"):
        thin_out(np.ones((5, 2)), None, 1.0)
    with pytest.raises(ExchangeError, match="positive"):
        thin_out(noise, None, 0.0)


def test_very_many_rows_are_read_and_thinned_by_arrays():
    """Seconds for a million, not minutes: two calls for a row, not some for each of its cells."""
    t = np.linspace(0, 20, 200_000)
    lines = map("{:.7f},{:.7f},{:.7f}".format, t.tolist(), np.cos(t).tolist(), np.sin(2 * t).tolist())
    data = ("t,x,y\n" + "\n".join(lines)).encode()
    read, look = [], preview_table(data)

    def work():
        read.append(tables_of_text.read_table(data, look.layout, look.mapping))
        read.append(document_of_table(read[0], options=TableOptions(thin=1e-4)))

    assert calls_of(work) < 2.2 * len(t)
    table, made = read
    document, deviation = made.document, made.deviation
    assert table.values.shape == (len(t), 3)
    assert deviation <= 1e-4
    assert len(document.curves[0].points) < 400


def test_a_large_table_takes_less_than_twice_its_size():
    """The peak used to be 2.9 times the file; of writing a document 5.1 times what was written."""
    t = np.linspace(0, 20, 200_000)
    rows = map("{:.6f},{:.6f},{:.6f}".format, t.tolist(), np.cos(t).tolist(), np.sin(t).tolist())
    data = ("t,x,y\n" + "\n".join(rows)).encode()
    document = Document((make_curve(np.column_stack([t, np.cos(t)])[::8].tolist()),))
    # What is imported when it is first wanted shall not count.
    read_table(b"1,2\n3,4\n")
    assert peak_of(lambda: read_table(data)) < 2.0 * len(data)
    assert peak_of(lambda: encode(document)) < 2.5 * len(encode(document))


def test_a_curve_of_all_rows_takes_little_more_than_its_memory():
    """Lists of whole columns, and 86 bytes a point to look at its t: 401 MB for a document of 200."""
    t = np.linspace(0, 20, 20_000)
    rows = zip(t.tolist(), np.cos(t).tolist(), np.sin(t).tolist(), strict=True)
    table = read_table(("t,x,y\n" + "\n".join(",".join(map(repr, row)) for row in rows)).encode())
    kept, told = [], []
    document_of_table(table, report=lambda share, _word: told.append(share))
    tracemalloc.start()
    try:
        kept.append(document_of_table(table))
        size, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert len(kept[0].document.curves[0].points) == len(t)
    assert peak < 1.45 * size
    assert peak_of(lambda: validate(kept[0].document)) < 20 * len(t)
    assert told == [0.0, 0.25, 0.5, 0.75]


def peak_of(work):
    """The most memory that was in use at once."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@each_row(
    ("text", "points", "said"),
    [
        (
            "x,y\n0,0\n1,1\n1,1\n2,0\n",
            [(0, 0), (1, 1), (2, 0)],
            "Row 4 repeats the point of the previous row; they were merged, because parameters by distance "
            "need distinct points.",
        ),
        (
            "x,y\n0,0\n1,1\n1,1\n1,1\n2,0\n2,0\n0,0\n",
            [(0, 0), (1, 1), (2, 0), (0, 0)],
            "3 rows repeat the point of the previous row, first row 4; they were merged, because "
            "parameters by distance need distinct points.",
        ),
        (
            "t,x,y\n0,0,0\n1,1,1\n2,1,1\n3,2,0\n",
            [(0, 0), (1, 1), (1, 1), (2, 0)],
            "Row 4 repeats the point of the previous row; it is kept, with its own t.",
        ),
        ("x,y\n0,0\n1,1\n0,0\n", [(0, 0), (1, 1), (0, 0)], ""),
    ],
)
def test_repeated_points_give_a_remark_and_a_curve(text, points, said):
    """They came in as "exact", a curve that could not be drawn: chord length has no step between them."""
    made = document_of_table(read_table(text.encode()))
    (curve,) = made.document.curves
    assert [point.position for point in curve.points] == points
    assert view_of(curve).curve is not None
    assert made.remarks == ((said,) if said else ())


def test_one_point_many_times_is_no_curve():
    with pytest.raises(ExchangeError, match="All points coincide"):
        document_of_table(read_table(b"1,1\n1,1\n1,1\n"))
