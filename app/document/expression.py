"""Numbers as people type them: ``0.5``, ``1/3``, ``sqrt(2)/2``, with a decimal comma where that is usual.

The text is translated into an expression of Python, which simpleeval computes with the operators, names and
functions listed here. Every number is a float, so that no power takes minutes. `ExpressionError` explains
each refusal to the person.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable
from itertools import pairwise
from typing import NoReturn

import msgspec

from .limits import MAX_MAGNITUDE
from .words import number

MAX_LENGTH = 200
"""Length of the longest text that is read; it bounds the work and the depth of nesting."""


class ExpressionError(ValueError):
    """A text is not a number that a document may hold; the message tells the person why."""


def parse_number(text: str, locale_decimal: str = ".") -> float:
    """Return the value of a number or expression.

    Parameters
    ----------
    text
        A number or an expression of numbers, ``pi``, ``e``, ``tau``, the functions in `FUNCTIONS` and
        + - * / ^ ( ). True minus signs and × · ÷ are read. Arguments are separated by ``;``, or by
        ``,`` where that is not the decimal mark.
    locale_decimal
        The decimal mark of the person's locale. A point is always a decimal mark, a comma only where this
        is the mark or where it can be nothing else, as in ``0,8``. Group separators are not read, so that
        1.234 never becomes 1234, and 1,234 is refused.

    Returns
    -------
    float
        Finite, and of a magnitude that a document may hold.

    Raises
    ------
    ExpressionError
        In every other case.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(f"The number is too long. Type at most {MAX_LENGTH} characters.")
    text = text.translate(_SIGNS).strip().removeprefix("=")
    decimal_comma = locale_decimal == "," or _is_plain_with_comma(text)
    words = _words(text, decimal_comma=decimal_comma)
    signed = len(words) == 2 and words[0].text in ("-", "+")
    if words[-1].kind == "number" and (len(words) == 1 or signed):
        # A pasted block has thousands of these, and no expression.
        value = float("".join(word.code for word in words))
    else:
        value = _computed(words)
    if not abs(value) <= MAX_MAGNITUDE:
        raise ExpressionError("Enter a number between −1e12 and 1e12.")
    return value


def _is_plain_with_comma(text: str) -> bool:
    """Return whether `text` is a single number whose comma can only be a decimal mark, not a separator."""
    return bool(_PLAIN_WITH_COMMA.fullmatch(text)) and not _IN_THOUSANDS.match(text)


# Functions and operators: each returns a finite float or raises an error


class _Function(msgspec.Struct, frozen=True):
    """Function of an expression that takes from `least` to `most` arguments."""

    name: str
    compute: Callable[..., float]
    least: int = 1
    most: int = 1

    def __call__(self, *arguments: float) -> float:
        if not self.least <= len(arguments) <= self.most:
            raise ExpressionError(f"{self.name} takes {self._count()}.")
        try:
            return _finite(float(self.compute(*arguments)))
        except ValueError:
            values = "; ".join(number(value, 6) for value in arguments)
            raise ExpressionError(f"{self.name}({values}) is not a real number.") from None

    def _count(self) -> str:
        if self.least == self.most == 1:
            return "one number"
        if self.most == 2:
            return "two numbers" if self.least == 2 else "one or two numbers"
        return "two numbers or more"


_ONE = ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log10", "log2")

FUNCTIONS: dict[str, _Function] = {
    **{name: _Function(name, getattr(math, name)) for name in (*_ONE, "degrees", "radians")},
    "abs": _Function("abs", abs),
    "log": _Function("log", math.log, 1, 2),
    "ln": _Function("ln", math.log),
    "atan2": _Function("atan2", math.atan2, 2, 2),
    "hypot": _Function("hypot", math.hypot, 2, 2),
    "min": _Function("min", min, 2, MAX_LENGTH),
    "max": _Function("max", max, 2, MAX_LENGTH),
}

CONSTANTS = {"pi": math.pi, "e": math.e, "tau": math.tau}


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise OverflowError
    return value


def _power(base: float, exponent: float) -> float:
    # math.pow, because ** makes complex numbers of negative bases.
    try:
        return math.pow(base, exponent)
    except ValueError:
        if base == 0:
            raise ZeroDivisionError from None
        raise ExpressionError("A negative number has no real power with a fractional exponent.") from None


_OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: lambda a, b: _finite(a + b),
    ast.Sub: lambda a, b: _finite(a - b),
    ast.Mult: lambda a, b: _finite(a * b),
    ast.Div: lambda a, b: _finite(a / b),
    ast.Pow: lambda a, b: _finite(_power(a, b)),
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}


# From text to words of a Python expression


class _Word(msgspec.Struct, frozen=True):
    """Word of the text: its kind, as typed, as Python code, and the column at which that code begins."""

    kind: str
    text: str
    code: str
    column: int

    @property
    def ends_operand(self) -> bool:
        return self.kind in {"number", "constant"} or self.text == ")"

    @property
    def starts_operand(self) -> bool:
        return self.kind in {"number", "constant", "function"} or self.text == "("


_SIGNS = str.maketrans({"−": "-", "–": "-", "×": "*", "·": "*", "⋅": "*", "÷": "/", "π": "pi", "τ": "tau"})
_SYMBOL = r"(?P<name>[A-Za-z_][A-Za-z0-9_]*)|(?P<symbol>\*\*|[-+*/^(),;])|(?P<space>\s+)|(?P<other>.)"
_POINT = r"[0-9]+(?:\.[0-9]*)?|\.[0-9]+"
_COMMA = r"[0-9]*,[0-9]+"  # with digits after it: "max(1, 5)" has none
_EXPONENT = r"(?:[eE][-+]?[0-9]+)?"
_PLAIN_WITH_COMMA = re.compile(rf"\s*[-+]?[0-9]+,[0-9]+{_EXPONENT}")
_IN_THOUSANDS = re.compile(r"\s*[-+]?[1-9][0-9]{0,2},[0-9]{3}(?![0-9])")
_WITH_POINT = re.compile(rf"(?P<number>(?:{_POINT}){_EXPONENT})|{_SYMBOL}", re.DOTALL)
_WITH_COMMA = re.compile(rf"(?P<number>(?:{_COMMA}|{_POINT}){_EXPONENT})|{_SYMBOL}", re.DOTALL)


def _words(text: str, *, decimal_comma: bool) -> list[_Word]:
    words: list[_Word] = []
    column = 0
    for match in (_WITH_COMMA if decimal_comma else _WITH_POINT).finditer(text):
        kind, typed = str(match.lastgroup), match.group()
        if kind != "space":
            kind, code = _translated(kind, typed)
            words.append(_Word(kind, typed, code, column))
            column += len(code) + 1
    if not words:
        raise ExpressionError("A number is missing.")
    return words


def _translated(kind: str, text: str) -> tuple[str, str]:
    """Return the kind of a word, and its Python code."""
    if kind == "number":
        value = float(text.replace(",", "."))
        if not math.isfinite(value):
            raise ExpressionError("Enter a number between −1e12 and 1e12.")
        # As a float: Python refuses the integers 007 and 99…9.
        return kind, repr(value)
    if kind == "name":
        if text in FUNCTIONS:
            return "function", text
        if text in CONSTANTS:
            return "constant", text
        raise ExpressionError(f"“{_short(text)}” is not a number, function or constant.")
    if kind == "other":
        raise ExpressionError(f"“{text}” cannot be part of a number.")
    return kind, {"^": "**", ";": ","}.get(text, text)


# From words to a number


def _computed(words: list[_Word]) -> float:
    # Late, because the first expression is typed long after the start.
    from simpleeval import InvalidExpression, SimpleEval  # noqa: PLC0415

    code = " ".join(word.code for word in words)
    evaluator = SimpleEval(_OPERATORS, FUNCTIONS, CONSTANTS)
    evaluator.nodes |= {ast.Name: _constant, ast.Tuple: _refuse_tuple}
    try:
        return float(evaluator.eval(code))
    except ZeroDivisionError:
        raise ExpressionError("Division by zero.") from None
    except OverflowError:
        raise ExpressionError("The result is too large.") from None
    except (RecursionError, MemoryError):
        raise ExpressionError("The expression is nested too deeply.") from None
    except SyntaxError as problem:
        first = (problem.offset or 0) - 1
        _refuse(words, first, max((problem.end_offset or 0) - 1, first + 1))
    except (InvalidExpression, TypeError):
        # A call of something that is not a function, or a star before an argument.
        _refuse(words, 0, len(code))


def _constant(node: ast.Name) -> float:
    if node.id not in CONSTANTS:
        _refuse_bare(node.id)
    return CONSTANTS[node.id]


def _refuse_tuple(node: ast.Tuple) -> NoReturn:
    """Refuse a comma outside a function, at the end of the operand before it."""
    column = node.elts[0].end_col_offset or 0 if node.elts else 0
    raise SyntaxError("a tuple", ("", 1, column + 1, "", 1, column + 1))


def _refuse(words: list[_Word], first: int, end: int) -> NoReturn:
    """Raise the error for the words that begin between the columns `first` and `end` of the Python code."""
    for before, after in pairwise(words):
        if first <= after.column < end:
            if before.kind == "function" and after.text != "(":
                _refuse_bare(before.text)
            if before.ends_operand and after.starts_operand:
                _refuse_neighbours(before, after)
    index = next((i for i, word in enumerate(words) if word.column >= first and word.text != ")"), -1)
    if words[index].code == ",":
        # It may be a decimal comma or a group separator.
        _refuse_comma(words, index)
    raise ExpressionError("The number or expression is incomplete.")


def _refuse_bare(function: str) -> NoReturn:
    raise ExpressionError(f"Write the argument of {function} in parentheses: {function}(2).")


def _refuse_comma(words: list[_Word], index: int) -> NoReturn:
    around = words[max(index - 1, 0) : index + 2]
    if words[index].text == "," and [word.kind for word in around] == ["number", "symbol", "number"]:
        whole, fraction = around[0].text, around[2].text
        typed = _short(f"{whole},{fraction}")
        if "." in whole + fraction:
            raise ExpressionError(f"Write “{typed}” without group separators.")
        raise ExpressionError(
            f"“{typed}” is ambiguous. Write {_short(f'{whole}.{fraction}')} with a decimal point."
        )
    raise ExpressionError(f"“{words[index].text}” separates the arguments of a function, as in max(1; 2).")


def _refuse_neighbours(before: _Word, after: _Word) -> NoReturn:
    if before.kind == after.kind == "number":
        pair = f"“{_short(before.text)}” and “{_short(after.text)}”"
        raise ExpressionError(f"{pair} are two numbers. Write one, without group separators.")
    raise ExpressionError(f"Write * between “{_short(before.text)}” and “{_short(after.text)}” to multiply.")


def _short(text: str) -> str:
    return text if len(text) <= 20 else text[:19] + "…"
