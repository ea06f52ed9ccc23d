"""Numbers as people type them: ``0.5``, ``1/3``, ``sqrt(2)/2``, with a decimal comma where that is usual.

The text is translated into Python's words; simpleeval computes them, with our operators and closed lists of
names and functions. Every number is a float: no power makes it work for minutes. What is refused is refused
with a sentence for the person.
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
"""Characters of the longest text that is read; it bounds the work, and the depth of nesting."""


class ExpressionError(ValueError):
    """A text that is not a number a document may hold; the message tells the person why."""


def parse_number(text: str, locale_decimal: str = ".") -> float:
    """Return the number that `text` means.

    Parameters
    ----------
    text
        A number or an expression of numbers, ``pi``, ``e``, ``tau``, the functions in `FUNCTIONS` and
        + - * / ^ ( ). The real minus sign and × · ÷ are read, too. Arguments are separated by ``;``, or by
        ``,`` where that is not the decimal mark.
    locale_decimal
        The decimal mark of the person's locale. A point is always a decimal mark, a comma only where this
        is one or where it can be nothing else, as in ``0,8``. There are no group separators, so that 1.234
        never becomes 1234, and 1,234 is refused.

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
        raise ExpressionError(f"This is too long to be a number; {MAX_LENGTH} characters are read at most.")
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
        raise ExpressionError("A number here must lie between −1e12 and 1e12.")
    return value


def _is_plain_with_comma(text: str) -> bool:
    """Tell whether `text` is one number whose comma can only be a decimal mark: not one of thousands."""
    return bool(_PLAIN_WITH_COMMA.fullmatch(text)) and not _IN_THOUSANDS.match(text)


# Functions and operators: each gives a finite float or says why not.


class _Function(msgspec.Struct, frozen=True):
    """A function that takes from `least` to `most` arguments."""

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
            shown = "; ".join(number(value, 6) for value in arguments)
            raise ExpressionError(f"{self.name}({shown}) is not a real number.") from None

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
        raise ExpressionError("A negative number has no real power with a fraction as exponent.") from None


_OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: lambda a, b: _finite(a + b),
    ast.Sub: lambda a, b: _finite(a - b),
    ast.Mult: lambda a, b: _finite(a * b),
    ast.Div: lambda a, b: _finite(a / b),
    ast.Pow: lambda a, b: _finite(_power(a, b)),
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}


# From text to words of Python


class _Word(msgspec.Struct, frozen=True):
    """A piece of the text: its kind, as typed, as Python writes it, and where it begins there."""

    kind: str
    text: str
    code: str
    place: int

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
    place = 0
    for match in (_WITH_COMMA if decimal_comma else _WITH_POINT).finditer(text):
        kind, typed = str(match.lastgroup), match.group()
        if kind != "space":
            kind, code = _translated(kind, typed)
            words.append(_Word(kind, typed, code, place))
            place += len(code) + 1
    if not words:
        raise ExpressionError("A number is missing.")
    return words


def _translated(kind: str, text: str) -> tuple[str, str]:
    """Return the kind of a word, and what Python writes for it."""
    if kind == "number":
        value = float(text.replace(",", "."))
        if not math.isfinite(value):
            raise ExpressionError("A number here must lie between −1e12 and 1e12.")
        # Never an integer, nor what Python refuses: 007 and 9…9 too.
        return kind, repr(value)
    if kind == "name":
        if text in FUNCTIONS:
            return "function", text
        if text in CONSTANTS:
            return "constant", text
        raise ExpressionError(f"“{_short(text)}” is not a number, nor a function or constant known here.")
    if kind == "other":
        raise ExpressionError(f"“{text}” has no place in a number.")
    return kind, {"^": "**", ";": ","}.get(text, text)


# From words to a number


def _computed(words: list[_Word]) -> float:
    # The first expression is typed long after the start.
    from simpleeval import InvalidExpression, SimpleEval  # noqa: PLC0415

    code = " ".join(word.code for word in words)
    evaluator = SimpleEval(_OPERATORS, FUNCTIONS, CONSTANTS)
    evaluator.nodes |= {ast.Name: _constant, ast.Tuple: _refuse_tuple}
    try:
        return float(evaluator.eval(code))
    except ZeroDivisionError:
        raise ExpressionError("Division by zero has no value.") from None
    except OverflowError:
        raise ExpressionError("The result is too large.") from None
    except (RecursionError, MemoryError):
        raise ExpressionError("This is nested too deeply.") from None
    except SyntaxError as problem:
        first = (problem.offset or 0) - 1
        _refuse(words, first, max((problem.end_offset or 0) - 1, first + 1))
    except (InvalidExpression, TypeError):
        # A call of what is no function, or a star before an argument.
        _refuse(words, 0, len(code))


def _constant(node: ast.Name) -> float:
    if node.id not in CONSTANTS:
        _refuse_bare(node.id)
    return CONSTANTS[node.id]


def _refuse_tuple(node: ast.Tuple) -> NoReturn:
    """Refuse a comma outside of a function, at the end of what is before it."""
    place = node.elts[0].end_col_offset or 0 if node.elts else 0
    raise SyntaxError("a tuple", ("", 1, place + 1, "", 1, place + 1))


def _refuse(words: list[_Word], first: int, end: int) -> NoReturn:
    """Say what is wrong with the words that begin from `first` to before `end` in Python's text."""
    for before, after in pairwise(words):
        if first <= after.place < end:
            if before.kind == "function" and after.text != "(":
                _refuse_bare(before.text)
            if before.ends_operand and after.starts_operand:
                _refuse_neighbours(before, after)
    index = next((i for i, word in enumerate(words) if word.place >= first and word.text != ")"), -1)
    if words[index].code == ",":
        # It is somebody's decimal comma or group separator.
        _refuse_comma(words, index)
    raise ExpressionError("This is not a complete number or expression.")


def _refuse_bare(function: str) -> NoReturn:
    raise ExpressionError(f"{function} needs its number in parentheses, {function}(2).")


def _refuse_comma(words: list[_Word], index: int) -> NoReturn:
    around = words[max(index - 1, 0) : index + 2]
    if words[index].text == "," and [word.kind for word in around] == ["number", "symbol", "number"]:
        whole, fraction = around[0].text, around[2].text
        typed = _short(f"{whole},{fraction}")
        if "." in whole + fraction:
            raise ExpressionError(f"“{typed}”: write the number without group separators.")
        raise ExpressionError(f"“{typed}” is unclear; write {_short(f'{whole}.{fraction}')} with a point.")
    raise ExpressionError(f"“{words[index].text}” separates the numbers of a function, such as max(1; 2).")


def _refuse_neighbours(before: _Word, after: _Word) -> NoReturn:
    if before.kind == after.kind == "number":
        pair = f"“{_short(before.text)}” and “{_short(after.text)}”"
        raise ExpressionError(f"{pair} are two numbers; write one, without group separators.")
    raise ExpressionError(f"Write * between “{_short(before.text)}” and “{_short(after.text)}” to multiply.")


def _short(text: str) -> str:
    return text if len(text) <= 20 else text[:19] + "…"
