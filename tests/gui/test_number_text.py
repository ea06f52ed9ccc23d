"""Numbers as the panels show them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtGui import QFontMetrics, QGuiApplication

from app.document.words import number
from app.features.point_table.view import COMPACT_DIGITS, ColumnWidths, width_for
from app.widgets.number_text import (
    NEGLIGIBLE,
    column_decimals,
    column_text,
    exact_text,
    numbers_of_columns,
    widest_texts,
)

numbers = st.one_of(
    st.floats(-1e4, 1e4),
    st.floats(),
    st.builds(lambda sign, digits, power: sign * digits * 10.0**power,
              st.sampled_from([-1, 1]), st.sampled_from([1, 2.5, 9.996, 9.999]), st.integers(-20, 20)),
    st.sampled_from([0.0, -0.0, math.nan, math.inf, 5e-324, -1.7e308]),
)  # fmt: skip
tables = st.integers(1, 4).flatmap(
    lambda columns: st.lists(st.lists(numbers, min_size=columns, max_size=columns), max_size=10).map(
        lambda rows: np.array(rows, dtype=float).reshape(len(rows), columns)
    )
)


@pytest.mark.parametrize(
    ("value", "mark", "text"),
    [
        (1 / 3, ".", "0.333333"),
        (-0.5, ",", "−0,5"),
        (1e-7, ".", "1e−7"),
        (123456789.0, ".", "1.23457e8"),
        (float("nan"), ".", "–"),
    ],
)
def test_a_number_with_six_digits(value, mark, text):
    assert number(value, 6, mark) == text


def test_exact_text():
    assert exact_text(0.1 + 0.2) == "0.30000000000000004"
    assert exact_text(1.5, ",") == "1,5"
    assert exact_text(float("nan")) == ""


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ([1.0, 2.0], ["1", "2"]),
        ([3.1, 3.35, -2.0], ["3.10", "3.35", "−2.00"]),
        ([0.0, 1 / 3, 1.0], ["0.0000", "0.3333", "1.0000"]),
        ([123.456, 1.0], ["123.46", "1.00"]),
        ([1000.5, 1e-6, -1e-9], ["1000.5", "1e−6", "−1e−9"]),
        ([1.5e9, 0.0], ["1.5e9", "0"]),
        ([np.nan, 1.0], ["–", "1"]),
        ([np.nan], ["–"]),
    ],
)
def test_a_column_shares_its_decimals(values, texts):
    decimals = column_decimals(np.array(values), 5)
    assert [column_text(value, decimals, 5) for value in values] == texts


def finite(column):
    return [value for value in column.tolist() if math.isfinite(value)]


def whole_digits(column):
    greatest = max(map(abs, finite(column)), default=0.0)
    return math.floor(math.log10(greatest)) + 1 if greatest >= 1 else 1


def alike(column, digits):
    """Return for every number that a column shows the text of one of its sign and power of ten."""
    negligible = NEGLIGIBLE * max(map(abs, finite(column)), default=0.0)
    texts = set()
    for value in finite(column):
        if value != 0 and abs(value) >= negligible:
            decade = math.floor(math.log10(abs(value)) + 2e-4)
            ones = math.copysign(float(f"1.111111e{decade}"), value)
            decimals = max(digits - whole_digits(column), 0)
            texts.add(column_text(ones, decimals, digits, negligible=negligible))
    return texts


@given(tables)
def test_the_widest_texts_of_columns_follow_from_each_number(values):
    for column, known in zip(values.T, numbers_of_columns(values), strict=True):
        assert known.greatest == max(map(abs, finite(column)), default=0.0)
        assert known.extent.is_signed == any(value < 0 for value in column.tolist())
        for digits in (3, 4, 5, 6):
            assert widest_texts(known.extent, digits) == alike(column, digits)


@given(tables)
def test_a_column_has_room_for_all_its_numbers(qapp, values):
    metrics, widths = QFontMetrics(QGuiApplication.font()), ColumnWidths()
    for column, known in zip(values.T, numbers_of_columns(values), strict=True):
        for digits in (*COMPACT_DIGITS[0], 3):
            decimals = column_decimals(column, digits)
            texts = [column_text(each, decimals, digits, negligible=known.negligible) for each in column]
            width = width_for(known.extent, digits, metrics)
            assert max(map(metrics.horizontalAdvance, texts), default=0) <= width
            # Measured once, and known from then on.
            assert (
                widths.of(known.extent, digits, metrics) == widths.of(known.extent, digits, metrics) == width
            )


def test_widths_depend_on_the_font(qapp):
    (known,) = numbers_of_columns(np.array([[-12.5], [1e-7]]))
    font, widths = QGuiApplication.font(), ColumnWidths()
    for size in (9, 18, 9):
        font.setPointSize(size)
        metrics = QFontMetrics(font)
        assert widths.of(known.extent, 4, metrics) == width_for(known.extent, 4, metrics)


@given(tables)
def test_a_column_has_as_few_decimals_as_show_its_numbers(values):
    for column in values.T:
        for digits in (3, 6):
            most = max(digits - whole_digits(column), 0)
            slack = NEGLIGIBLE * max(map(abs, finite(column)), default=0.0)
            shows = (
                decimals
                for decimals in range(most)
                if all(abs(np.round(value, decimals) - value) <= slack for value in finite(column))
            )
            assert column_decimals(column, digits) == next(shows, most)
