"""A test over a table asks every row, and names those that fail."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

from tests.rows import each_row


def test_every_row_of_all_tables_is_tested():
    tested = []

    @each_row("first", [1, 2])
    @each_row(("second", "third"), [("a", "b"), ("c", "d")])
    def of_rows(first, second, third, fixture):
        tested.append((first, second, third, fixture))

    assert list(inspect.signature(of_rows).parameters) == ["fixture"]
    of_rows(fixture=0)
    assert tested == [(1, "a", "b", 0), (1, "c", "d", 0), (2, "a", "b", 0), (2, "c", "d", 0)]


def test_all_rows_that_fail_are_named():
    @each_row("kind", [int, str, float, bool])
    @each_row("number", [1], ids=["one"])
    def of_rows(kind, number):
        if kind is int:
            raise ZeroDivisionError
        if kind is str:
            pytest.skip("not this one")
        if kind is bool:
            pytest.fail("nor this one")

    with pytest.raises(BaseExceptionGroup, match="3 of 4 rows fail") as failure:
        of_rows()
    assert str(failure.value).endswith(": int-one, str-one, bool-one (3 sub-exceptions)")
    kinds = [type(each) for each in failure.value.exceptions]
    assert kinds == [ZeroDivisionError, pytest.skip.Exception, pytest.fail.Exception]
    assert failure.value.exceptions[0].__notes__ == ["In the row int-one."]


def test_rows_have_the_same_random_numbers():
    found = []

    @each_row("row", [1, 2])
    def of_rows(row, rng):
        found.append(rng.random())

    of_rows(rng=np.random.default_rng(7))
    assert found[0] == found[1]


@pytest.mark.parametrize("names", ["row", "row, missing"])
def test_a_table_without_rows_is_refused(names):
    with pytest.raises(ValueError, match="no rows of"):
        each_row(names, [])


def test_names_without_a_parameter_of_the_test_are_refused():
    with pytest.raises(ValueError, match="does not take"):
        each_row(("row", "missing"), [(1, 2)])(lambda row: None)
