"""Numbers as the panels show them."""

import numpy as np
import pytest

from app.panels.number_text import column_decimals, column_text, exact_text, rounded_text


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
def test_rounded_text(value, mark, text):
    assert rounded_text(value, mark) == text


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
