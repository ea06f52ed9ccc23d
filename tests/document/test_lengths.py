"""Lengths as people type them."""

from __future__ import annotations

import pytest

from app.document.expression import ExpressionError
from app.document.lengths import MILLIMETRES, typed_length
from tests.rows import each_row

MEANT = {
    "70": 70.0,
    "70 mm": 70.0,
    "70mm": 70.0,
    "1in": 25.4,
    '1"': 25.4,
    "0.1 inch": 2.54,
    "72pt": 25.4,
    "96 px": 25.4,
    "6pc": 25.4,
    "1ft": 304.8,
    "1,5 cm": 15.0,
    "-3 mm": -3.0,
    "−3 mm": -3.0,
    "1e3 mm": 1000.0,
    "1/3": 1 / 3,
    "2in + 3mm": 53.8,
    "(1+1) in": 50.8,
    "sqrt(4) cm": 20.0,
    "2*pi": 6.283185307179586,
    "50%": 100.0,
    "+10%": 220.0,
    "-25 %": 150.0,
}


@each_row("text", MEANT)
def test_typed_lengths_are_in_the_unit_of_the_document(text):
    # Of these numbers only "1/3" and pi are no decimal ones; all others are exact.
    assert typed_length(text, "mm", 200.0) == MEANT[text]


@each_row(("text", "unit"), [("3 squares", "squares"), ("1+2 s", "s"), ("3e0", "e"), ("3", "e")])
def test_any_unit_of_the_document_may_be_typed(text, unit):
    assert typed_length(text, unit) == 3.0


@each_row("unit", MILLIMETRES)
@each_row("other", MILLIMETRES)
def test_every_unit_is_converted_to_every_other(unit, other):
    # Two roundings.
    assert typed_length(f"3 {unit}", other, 0.0) == pytest.approx(
        3 * MILLIMETRES[unit] / MILLIMETRES[other], rel=4e-16
    )


def test_a_decimal_comma_is_read_in_its_locale():
    assert typed_length("1,5 in + 0,5 in", "mm", 0.0, ",") == 50.8


@each_row(
    ("text", "unit", "reason"),
    [
        ("1in", "", "The document has no unit of length. Type a number without “in”."),
        (
            "1in",
            "furlong",
            "The unit “furlong” is not a length. Type a number without “in”.",
        ),
        ("3 foo", "mm", "“foo” is not a unit of length. Use mm, cm, in, pt or px."),
        ("3 foo", "", "The document has no unit of length. Type a number without “foo”."),
        ("3 + foo", "mm", "“foo” is not a number, function or constant."),
        ("mm", "mm", "A number is missing."),
        ("", "mm", "A number is missing."),
    ],
)
def test_bad_lengths_are_refused_with_a_reason(text, unit, reason):
    with pytest.raises(ExpressionError) as refusal:
        typed_length(text, unit, 1.0)
    assert str(refusal.value) == reason
