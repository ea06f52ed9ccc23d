"""Blocks of numbers as spreadsheets write them."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.exchange.table.clipboard import TableTextError, read_titled_block, write_block
from tests.effort import calls_of
from tests.rows import each_row
from tests.texts import texts


@each_row(
    ("text", "mark", "block"),
    [
        ("1\t2", ".", [[1, 2]]),
        ("1,5\t2,25\r\n3\t4\r\n", ".", [[1.5, 2.25], [3, 4]]),
        ("1;2,5", ".", [[1, 2.5]]),
        ("1;2;\n3;4;", ".", [[1, 2], [3, 4]]),
        ("1.5,2.5\n3,4", ".", [[1.5, 2.5], [3, 4]]),
        ("1, 2\n3, 4", ".", [[1, 2], [3, 4]]),
        ("1,2", ".", [[1, 2]]),
        ("1,2", ",", [[1.2]]),
        ("1,5 2,5", ".", [[1.5, 2.5]]),
        ("1,5   2,5\n3 4", ".", [[1.5, 2.5], [3, 4]]),
        ("x\ty\n1\t2", ".", [[1, 2]]),
        ("1/3\tsqrt(4)", ".", [[1 / 3, 2]]),
        ("1,234\t2", ",", [[1.234, 2]]),
        ("7", ".", [[7]]),
    ],
)
def test_blocks_of_numbers(text, mark, block):
    assert read_titled_block(text, mark).rows == block


@each_row("text", ["x [mm]\ty (mm)\n1\t2", "# x y\n1 2", "#;X;Y\n7;1;2", "X[mm], Y[mm]\n1, 2"])
def test_titles_have_units_and_signs(text):
    block = read_titled_block(text)
    assert tuple(title for title in block.titles if title != "#") == ("x", "y")
    assert block.rows[0][-2:] == [1, 2]


def test_a_block_has_an_end():
    with pytest.raises(TableTextError, match="10000 can be pasted"):
        read_titled_block("1\n" * 10_001)
    with pytest.raises(TableTextError, match="16 can be pasted"):
        read_titled_block("1\t" * 1_000_000)


def test_ten_thousand_rows_are_read_by_some_calls_for_each_cell():
    text = "0.125\t-1.5e-3\n"
    assert len(read_titled_block(text * 10_000).rows) == 10_000
    calls = [calls_of(lambda rows=rows: read_titled_block(text * rows)) for rows in (1000, 2000)]
    assert calls[1] < 2.1 * calls[0]
    assert calls[1] < 50 * (2 * 2000)  # 32 for a cell


@given(texts(40, "0123456789.,;\t\n -eax\r") | texts(40), st.sampled_from(".,"))
def test_any_text_is_a_rectangle_of_numbers_or_a_sentence(text, mark):
    with contextlib.suppress(TableTextError):
        block = read_titled_block(text, mark).rows
        assert len({len(row) for row in block}) == 1
        assert all(type(value) is float for row in block for value in row)


def test_every_written_dxf_is_read():
    assert write_block([["1", "2.5"], ["-3", ""]]) == "1\t2.5\n-3\t"
    assert read_titled_block(write_block([["1", "2.5"], ["-3", "4"]])).rows == [[1, 2.5], [-3, 4]]
