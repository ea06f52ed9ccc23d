"""Numbers as people type them: ``0.5``, ``1/3``, ``sqrt(2)/2``, with a decimal comma where that is usual.

The text is computed while it is read, by precedence climbing, from numbers, a closed list of names, + - * / ^
and parentheses. Every number is a float: no power makes it work for minutes. What is refused is refused with
a sentence for the person.
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable
from typing import NoReturn

import msgspec

from app.document.model import MAX_MAGNITUDE
from app.document.words import number

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
    tokens = _tokens(text, decimal_comma=decimal_comma)
    try:
        value = _Reader(tokens).whole()
    except ZeroDivisionError:
        raise ExpressionError("Division by zero has no value.") from None
    except OverflowError:
        raise ExpressionError("The result is too large.") from None
    except RecursionError:
        raise ExpressionError("This is nested too deeply.") from None
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


_OPERATORS: dict[str, tuple[int, Callable[[float, float], float]]] = {
    "+": (1, operator.add),
    "-": (1, operator.sub),
    "*": (2, operator.mul),
    "/": (2, operator.truediv),
    "^": (4, _power),
    "**": (4, _power),
}
"""Tightness of binding and function of each."""

_SIGN, _POWER = 3, 4
"""A sign binds less than a power, and more than the rest: −2^2 is −4."""


# From text to tokens


class _Token(msgspec.Struct, frozen=True):
    """A piece of the text: its kind, as typed, and what a number or constant is worth."""

    kind: str
    text: str
    value: float = 0.0

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


def _tokens(text: str, *, decimal_comma: bool) -> list[_Token]:
    pattern = _WITH_COMMA if decimal_comma else _WITH_POINT
    found = [
        _token(str(match.lastgroup), match.group())
        for match in pattern.finditer(text)
        if match.lastgroup != "space"
    ]
    if not found:
        raise ExpressionError("A number is missing.")
    return found


def _token(kind: str, text: str) -> _Token:
    if kind == "number":
        return _Token(kind, text, _number(text))
    if kind == "name":
        if text in FUNCTIONS:
            return _Token("function", text)
        if text in CONSTANTS:
            return _Token("constant", text, CONSTANTS[text])
        raise ExpressionError(f"“{_short(text)}” is not a number, nor a function or constant known here.")
    if kind == "other":
        raise ExpressionError(f"“{text}” has no place in a number.")
    return _Token(kind, text)


def _number(text: str) -> float:
    value = float(text.replace(",", "."))
    if not math.isfinite(value):
        raise ExpressionError("A number here must lie between −1e12 and 1e12.")
    return value


# From tokens to a number


class _Reader:
    """Reads tokens from the left, and says what is wrong where it stops."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens, self._place = tokens, 0

    @property
    def _next(self) -> str:
        """The text of the next token; empty at the end."""
        return self._tokens[self._place].text if self._place < len(self._tokens) else ""

    def whole(self) -> float:
        """Return what all tokens together are worth."""
        value = self._sum()
        if self._next:
            self._refuse()
        return value

    def _sum(self, tightness: int = 0) -> float:
        """Return what the next operands are worth that are bound as tightly at least."""
        value = self._operand()
        while self._next in _OPERATORS and _OPERATORS[self._next][0] >= tightness:
            binds, compute = _OPERATORS[self._next]
            self._place += 1
            # A tower of powers is read from the right.
            value = _finite(compute(value, self._sum(binds if binds == _POWER else binds + 1)))
        return value

    def _operand(self) -> float:
        if not self._next:
            raise _incomplete()
        token = self._tokens[self._place]
        if token.kind == "symbol" and token.text not in "(+-":
            self._refuse()
        self._place += 1
        if token.kind == "function":
            return self._call(token)
        if token.text == "(":
            value = self._sum()
            self._close()
            return value
        if token.kind == "symbol":
            value = self._sum(_SIGN)
            return -value if token.text == "-" else value
        return token.value

    def _call(self, function: _Token) -> float:
        if self._next != "(":
            raise ExpressionError(f"{function.text} needs its number in parentheses, {function.text}(2).")
        arguments = []
        self._place += 1
        while self._next != ")":
            arguments.append(self._sum())
            if self._next not in (",", ";"):
                break
            self._place += 1
        self._close()
        return FUNCTIONS[function.text](*arguments)

    def _close(self) -> None:
        if self._next != ")":
            self._refuse()
        self._place += 1

    def _refuse(self) -> NoReturn:
        """Say why the next token cannot stand where it does."""
        if self._next in (",", ";"):
            # It is somebody's decimal comma or group separator.
            _refuse_comma(self._tokens, self._place)
        if self._next and self._place and self._tokens[self._place].starts_operand:
            _refuse_neighbours(*self._tokens[self._place - 1 : self._place + 1])
        raise _incomplete()


def _incomplete() -> ExpressionError:
    return ExpressionError("This is not a complete number or expression.")


def _refuse_comma(tokens: list[_Token], index: int) -> NoReturn:
    around = tokens[max(index - 1, 0) : index + 2]
    if tokens[index].text == "," and [token.kind for token in around] == ["number", "symbol", "number"]:
        whole, fraction = around[0].text, around[2].text
        typed = _short(f"{whole},{fraction}")
        if "." in whole + fraction:
            raise ExpressionError(f"“{typed}”: write the number without group separators.")
        raise ExpressionError(f"“{typed}” is unclear; write {_short(f'{whole}.{fraction}')} with a point.")
    raise ExpressionError(f"“{tokens[index].text}” separates the numbers of a function, such as max(1; 2).")


def _refuse_neighbours(before: _Token, after: _Token) -> NoReturn:
    if before.kind == after.kind == "number":
        pair = f"“{_short(before.text)}” and “{_short(after.text)}”"
        raise ExpressionError(f"{pair} are two numbers; write one, without group separators.")
    raise ExpressionError(f"Write * between “{_short(before.text)}” and “{_short(after.text)}” to multiply.")


def _short(text: str) -> str:
    return text if len(text) <= 20 else text[:19] + "…"
