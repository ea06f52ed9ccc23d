"""An amount typed into a drag: one number or expression; with Tab one for x and one for y, or an angle."""

from __future__ import annotations

import re
from collections.abc import Sequence

import msgspec
from msgspec.structs import replace

from ..document.expression import ExpressionError, parse_number
from ..document.lengths import check_unit, typed_length
from ..document.limits import EditError
from ..document.model import Vector
from ..document.words import with_minus

_FIRST = frozenset("0123456789.-(")
_FURTHER = frozenset("+*/)")
_PLAIN = re.compile(r"-?[0-9.]*")
_LAST_NUMBER = re.compile(r"[0-9.]*$")


class TypedAmount(msgspec.Struct, frozen=True):
    """Amount as typed so far.

    Attributes
    ----------
    fields
        The text of the one number, or those of x and y.
    at
        Which of them is typed.
    unit
        The unit of the document, which lengths are in; None for a factor or an angle.
    is_polar
        Whether the two are a length and an angle, in place of x and y.
    """

    fields: tuple[str, ...] = ("",)
    at: int = 0
    unit: str | None = None
    is_polar: bool = False

    @property
    def names(self) -> tuple[str, str]:
        """The names of the two numbers."""
        return ("length", "angle") if self.is_polar else ("x", "y")

    @property
    def is_pair(self) -> bool:
        """Whether the amount has two numbers, for x and for y."""
        return len(self.fields) > 1

    @property
    def counts(self) -> bool:
        """Whether the amount is typed, and not that of the pointer."""
        return self.is_pair or bool(self.fields[0])

    # Keys

    def claims(self, key: str) -> bool:
        """Return whether a key belongs to the amount, even without effect: once begun, all do."""
        return key in _FIRST or key == "backspace" or (self.counts and len(key) == 1)

    def continues_unit(self, key: str) -> bool:
        """Return whether a key is a further letter of a unit."""
        if not self.fields[self.at][-1:].isalpha():
            return False
        try:
            return self.after(key) is not None and key.isalpha()
        except EditError:
            return False

    def after(self, key: str) -> TypedAmount | None:
        """Return the amount after a character or "backspace"; None for a key that means nothing here.

        Raises
        ------
        EditError
            For a letter that is none of a unit.
        """
        text = self.fields[self.at]
        if key == "backspace":
            return self.joined() if self.is_pair and self.at == 1 and not text else self._with(text[:-1])
        if key == "-" and _PLAIN.fullmatch(text):
            # A minus sign turns a number round, wherever it is typed.
            return self._with(text[1:] if text.startswith("-") else f"-{text}")
        if len(key) == 1 and key.isalpha() and self.counts:
            return self._with(self._with_letter(text + key))
        if key == "." and "." in _LAST_NUMBER.findall(text)[0]:
            return None
        return self._with(text + key) if key in _FIRST or (text and key in _FURTHER) else None

    def _with_letter(self, text: str) -> str:
        """Return a text that ends with a letter of a unit; raise EditError where that has no place."""
        unit = self._unit_at(self.at)
        if unit is None:
            raise EditError(f"A factor or an angle has no unit; type a number without “{text[-1]}”.")
        try:
            check_unit(text, unit)
        except ExpressionError as problem:
            raise EditError(str(problem)) from None
        return text

    def _with(self, text: str) -> TypedAmount:
        fields = (*self.fields[: self.at], text, *self.fields[self.at + 1 :])
        return replace(self, fields=fields)

    def after_tab(self, axis: int | None) -> TypedAmount:
        """Go on to the other number; one typed along a locked `axis` stays that of this axis."""
        if self.is_pair:
            return replace(self, at=1 - self.at)
        fields = ("", self.fields[0]) if axis == 1 else (self.fields[0], "")
        return replace(self, fields=fields, at=0 if axis == 1 else 1)

    def joined(self, axis: int = 0) -> TypedAmount:
        """Return the one number for an axis."""
        return replace(self, fields=(self.fields[axis],), at=0) if self.is_pair else self

    # What it means

    def number(self, default: float) -> float:
        """Return the one number, `default` while it is none yet."""
        return self._number(0, default)

    def pair(self, default: float) -> Vector:
        """Return the numbers for x and y, `default` for a text that is none yet."""
        return (self._number(0, default), self._number(1, default))

    def over(self, present: Vector) -> Vector:
        """Return two numbers: those that are typed, in place of the present ones."""
        second = self._number(1, present[1]) if self.is_pair else present[1]
        return (self._number(0, present[0]), second)

    @property
    def refusal(self) -> str:
        """Why the typed text is no number yet; empty where it is one, or nothing is typed."""
        for at, text in enumerate(self.fields):
            try:
                if text:
                    self._read(at)
            except ExpressionError as problem:
                return f"“{with_minus(text)}”: {problem}"
        return ""

    def _number(self, at: int, default: float) -> float:
        try:
            return self._read(at)
        except ExpressionError:
            return default

    def _read(self, at: int) -> float:
        text, unit = self.fields[at], self._unit_at(at)
        return parse_number(text) if unit is None else typed_length(text, unit)

    def _unit_at(self, at: int) -> str | None:
        return None if at and self.is_polar else self.unit

    @property
    def mark(self) -> str:
        """The one text as typed: " (1/3)" for an expression, " (−…)" for no number yet, "" for a number."""
        text = self.fields[0]
        if self.is_pair or not text:
            return ""
        try:
            self._read(0)
        except ExpressionError:
            return f" ({with_minus(text)}…)"
        return "" if _PLAIN.fullmatch(text) else f" ({with_minus(text)})"

    def texts(self, present: Sequence[str]) -> list[str]:
        """Return the texts of two numbers: as typed, with a mark where the next digit goes, or as now."""
        texts = list(present)
        for at, text in enumerate(self.fields):
            if text or (self.is_pair and at == self.at):
                texts[at] = f"{with_minus(text)}{'|' if at == self.at else ''}"
        return texts

    def pair_text(self, default: str) -> str:
        """Return both numbers as typed, with a mark where the next digit goes: "x 1, y 2|"."""
        parts = []
        for at, text in enumerate(self.fields):
            displayed = f"{with_minus(text)}|" if at == self.at else with_minus(text) or default
            parts.append(f"{self.names[at]} {displayed}")
        return ", ".join(parts)

    @property
    def keys(self) -> str:
        """The number of two that is typed, and the way to the other one."""
        return f"typing {self.names[self.at]} · Tab: {self.names[1 - self.at]}"
