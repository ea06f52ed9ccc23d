"""Typed numbers: what is read, what is refused, and that neither takes long."""

import contextlib
import math
import sys

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from app.document.expression import CONSTANTS, FUNCTIONS, ExpressionError, parse_number
from app.document.limits import MAX_MAGNITUDE
from tests.effort import calls_of
from tests.rows import each_row
from tests.texts import texts

MOST_CALLS = 10_000
"""A long text that is read takes about two thousand; whatever is typed, it is done before the next key."""


def refusal_of(text, decimal):
    with pytest.raises(ExpressionError) as refused:
        parse_number(text, decimal)
    return str(refused.value)


@each_row(
    ("text", "value"),
    [
        ("0", 0.0),
        ("1/3", 1 / 3),
        ("sqrt(2)/2", math.sqrt(2) / 2),
        ("pi", math.pi),
        ("π/2", math.pi / 2),
        ("2*sin(pi/6)", 2 * math.sin(math.pi / 6)),
        ("1e-3", 1e-3),
        ("-0.5", -0.5),
        ("−0.5", -0.5),
        ("  .5 ", 0.5),
        ("=1+2", 3.0),
        ("007", 7.0),
        ("2^10", 1024.0),
        ("2**-1", 0.5),
        ("-2^2", -4.0),
        ("3×(1+1)÷4", 1.5),
        ("max(1, 5, 3)", 5.0),
        ("max(1; 5)", 5.0),
        ("hypot(3,4)", 5.0),
        ("atan2(1, 1)", math.atan2(1, 1)),
        ("log(8, 2)", 3.0),
        ("degrees(tau)", 360.0),
        ("abs(-2)", 2.0),
        ("1e12", 1e12),
        ("1.234", 1.234),
        ("0.1", 0.1),
        ("1e-300", 1e-300),
    ],
)
def test_expressions_have_their_values(text, value):
    assert parse_number(text) == value


@each_row(
    ("text", "value"),
    [
        ("0,8", 0.8),
        ("-1,25", -1.25),
        ("−1,25", -1.25),
        ("+0,5", 0.5),
        (" 1,5e-3 ", 1.5e-3),
        ("0,125", 0.125),
        ("1234,567", 1234.567),
        ("1,2345", 1.2345),
    ],
)
def test_a_comma_that_can_only_be_a_decimal_mark(text, value):
    assert parse_number(text) == value


@each_row(
    ("text", "value"),
    [
        ("1,5", 1.5),
        ("-,5", -0.5),
        ("1,5e-3", 1.5e-3),
        ("1.234", 1.234),
        ("0.5", 0.5),
        ("max(1,5; 2)", 2.0),
        ("1,5*2,5", 3.75),
        ("max(1, 5)", 5.0),
    ],
)
def test_with_a_decimal_comma(text, value):
    assert parse_number(text, ",") == value


@each_row(
    ("text", "decimal", "word"),
    [
        ("", ".", "missing"),
        ("abc", ".", "“abc” is not a number"),
        ("1,234", ".", "1.234 with a decimal point"),
        ("-12,345", ".", "ambiguous"),
        ("1,234e2", ".", "ambiguous"),
        ("1,5+1", ".", "ambiguous"),
        ("1.5,5", ".", "group separators"),
        ("1,234,567", ".", "1,234"),
        ("1,234.5", ".", "group separators"),
        ("1.234,5", ",", "group separators"),
        ("1.234.567", ",", "group separators"),
        ("1 234", ".", "group separators"),
        ("1\u202f234", ".", "group separators"),
        ("1'234", ".", "cannot be part"),
        ("1_000", ".", "not a number"),
        ("max(1,5)", ",", "takes two numbers or more"),
        ("1,", ",", "separates"),
        ("1/0", ".", "Division by zero"),
        ("0^-1", ".", "Division by zero"),
        ("sqrt(-1)", ".", "sqrt(−1) is not a real number"),
        ("asin(2)", ".", "not a real number"),
        ("(-8)^(1/3)", ".", "no real power"),
        ("abs((-8)**(1/3))", ".", "no real power"),
        ("9**9**9", ".", "too large"),
        ("1/(1e308*10)", ".", "too large"),
        ("exp(1000)", ".", "too large"),
        ("1e400", ".", "1e12"),
        ("1.1e12", ".", "1e12"),
        ("nan", ".", "“nan”"),
        ("inf", ".", "“inf”"),
        ("True", ".", "“True”"),
        ("2j", ".", "“j”"),
        ("0x10", ".", "“x10”"),
        ("2pi", ".", "Write * between “2” and “pi”"),
        ("2(3)", ".", "Write *"),
        ("sqrt", ".", "parentheses"),
        ("sqrt 2", ".", "parentheses"),
        ("sqrt()", ".", "takes one number"),
        ("sin(1, 2)", ".", "takes one number"),
        ("hypot(1)", ".", "takes two numbers"),
        ("(1, 2)", ".", "ambiguous"),
        ("1 +", ".", "is incomplete"),
        ("()", ".", "is incomplete"),
        ("pi()", ".", "Write *"),
        ("1//2", ".", "is incomplete"),
        ("1 if 1 else 2", ".", "“if”"),
        ("1 < 2", ".", "“<” cannot be part"),
        ("'a'", ".", "cannot be part"),
        ("a.b", ".", "“a”"),
        ("(1).real", ".", "“.” cannot be part"),
        ("__import__('os')", ".", "“__import__”"),
        ("[1 for _ in (1, 2)]", ".", "cannot be part"),
        ("lambda: 1", ".", "“lambda”"),
        ("1; 2", ".", "separates"),
        ("1\n2", ".", "two numbers"),
        ("1 # one", ".", "“#” cannot be part"),
        ("9" * 1_000_000, ".", "too long"),
        ("(" * 100 + "1" + ")" * 99, ".", "is incomplete"),
        ("½", ".", "cannot be part"),
        ("\x00", ".", "cannot be part"),
    ],
)
def test_bad_expressions_are_refused_with_a_message(text, decimal, word):
    refused = []
    assert calls_of(lambda: refused.append(refusal_of(text, decimal))) < MOST_CALLS
    (refused,) = refused
    assert word in refused
    assert refused.endswith(".")
    assert len(refused) < 120


def test_a_displayed_value_is_read_bit_for_bit():
    for value in (1 / 3, 0.1, -1e-17, 123456.789, 5e-324, 1e12):
        assert parse_number(repr(value)) == value
        assert parse_number(repr(value).replace(".", ","), ",") == value


def test_deep_nesting_is_refused_without_a_crash():
    for text in ("-" * 199 + "1", "(" * 99 + "1" + ")" * 99, "sin(" * 39 + "1" + ")" * 39):
        with contextlib.suppress(ExpressionError):  # where little of the stack is left
            assert abs(parse_number(text)) <= 1


def test_a_nearly_full_stack_is_refused_without_a_crash():
    def at_depth(remaining):
        return parse_number("-" * 190 + "1") if remaining == 0 else at_depth(remaining - 1)

    room = sys.getrecursionlimit() - 250
    with pytest.raises(ExpressionError, match="deeply"):
        at_depth(room)


def test_every_function_returns_the_result_of_python():
    for name, function in FUNCTIONS.items():
        arguments = (0.5, 0.25)[: function.least]
        text = f"{name}({'; '.join(map(repr, arguments))})"
        assert parse_number(text) == function.compute(*arguments)
    for name, value in CONSTANTS.items():
        assert parse_number(name) == value


WORDS = st.sampled_from(
    [
        *FUNCTIONS,
        *CONSTANTS,
        *"0123456789.,;()+-*/^ eEjx_'\"[]{}:=<>#\n",
        "**",
        "9999",
        "e308",
        "if",
        "__",
        "−",
    ]
)


@given(st.one_of(texts(60), st.lists(WORDS, max_size=30).map("".join)), st.sampled_from(".,"))
@example("9**9**9**9", ".")
@example("e**e**e**e**e", ".")
def test_any_text_is_a_finite_number_or_refused(text, decimal):
    def read():
        with contextlib.suppress(ExpressionError):
            value = parse_number(text, decimal)
            assert type(value) is float
            assert abs(value) <= MAX_MAGNITUDE

    assert calls_of(read) < MOST_CALLS


@given(st.floats(-MAX_MAGNITUDE, MAX_MAGNITUDE))
def test_every_float_survives_its_own_text(value):
    assert parse_number(repr(value)) == value
