"""Blocks of numbers as spreadsheets write them."""

import pytest

from app.exchange.table_text import TableTextError, read_block, write_block


@pytest.mark.parametrize(
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
    assert read_block(text, mark) == block


def test_a_block_has_an_end():
    with pytest.raises(TableTextError, match="10000 can be pasted"):
        read_block("1\n" * 10_001)


def test_what_is_written_is_read():
    assert write_block([["1", "2.5"], ["-3", ""]]) == "1\t2.5\n-3\t"
    assert read_block(write_block([["1", "2.5"], ["-3", "4"]])) == [[1, 2.5], [-3, 4]]
