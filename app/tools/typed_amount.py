"""An amount typed into a drag: one number, or with Tab one for x and one for y."""

from __future__ import annotations

import math

import msgspec
from msgspec.structs import replace

from ..document.model import Vector
from ..document.words import with_minus

_AXES = "xy"


class TypedAmount(msgspec.Struct, frozen=True):
    """Amount as typed so far.

    Attributes
    ----------
    fields
        The text of the one number, or those of x and y.
    at
        Which of them is typed.
    """

    fields: tuple[str, ...] = ("",)
    at: int = 0

    @property
    def is_pair(self) -> bool:
        """Whether there is a number for x and one for y."""
        return len(self.fields) > 1

    @property
    def counts(self) -> bool:
        """Whether it gives the amount, rather than the pointer."""
        return self.is_pair or bool(self.fields[0])

    # Keys

    def after(self, key: str) -> TypedAmount | None:
        """Return the amount after a digit, ".", "-" or "backspace"; None for a key that is none of these."""
        text = self.fields[self.at]
        if key == "backspace":
            return self.joined() if self.is_pair and self.at == 1 and not text else self._with(text[:-1])
        if key == "-":
            # A minus sign turns the amount round, wherever it is typed.
            return self._with(text[1:] if text.startswith("-") else f"-{text}")
        if (key == "." and "." not in text) or (len(key) == 1 and key in "0123456789"):
            return self._with(text + key)
        return None

    def _with(self, text: str) -> TypedAmount:
        fields = (*self.fields[: self.at], text, *self.fields[self.at + 1 :])
        return replace(self, fields=fields)

    def after_tab(self, axis: int | None) -> TypedAmount:
        """Go on to the other number; one typed along a locked `axis` stays that of this axis."""
        if self.is_pair:
            return replace(self, at=1 - self.at)
        return TypedAmount(("", self.fields[0]), 0) if axis == 1 else TypedAmount((self.fields[0], ""), 1)

    def joined(self, axis: int = 0) -> TypedAmount:
        """Return the one number for an axis."""
        return TypedAmount((self.fields[axis],)) if self.is_pair else self

    # What it means

    def number(self, default: float) -> float:
        """Return the one number, `default` while it is none yet."""
        return _number(self.fields[0], default)

    def pair(self, default: float) -> Vector:
        """Return the numbers for x and y, `default` for what is none yet."""
        return (_number(self.fields[0], default), _number(self.fields[1], default))

    @property
    def unfinished(self) -> str:
        """The text of one number that is none yet, such as "−"."""
        text = self.fields[0]
        return with_minus(text) if text and not self.is_pair and math.isnan(_number(text, math.nan)) else ""

    def told(self, default: str) -> str:
        """Return both numbers as typed, with a mark where the next digit goes: "x 1, y 2|"."""
        parts = []
        for at, text in enumerate(self.fields):
            shown = f"{with_minus(text)}|" if at == self.at else with_minus(text) or default
            parts.append(f"{_AXES[at]} {shown}")
        return ", ".join(parts)

    @property
    def keys(self) -> str:
        """The number of two that is typed, and the way to the other one."""
        return f"typing {_AXES[self.at]} · Tab: {_AXES[1 - self.at]}"


def _number(text: str, default: float) -> float:
    try:
        value = float(text)
    except ValueError:
        return default
    return value if math.isfinite(value) else default
