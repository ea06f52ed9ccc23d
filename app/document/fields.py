"""Base class of the document's values, and their fields as the annotations describe them.

A field is described where it is declared: ``width: Annotated[float | None, at_least(0), "Stroke width"]``.
`plain_numbers` converts the numbers of such fields, the validation of files and changes checks the
requirements, and the history names the fields.

To add a field to the document: a line in ``model`` or ``style`` with its requirement and its name for
people::

    width: Annotated[float | None, at_least(0), LENGTH, "Stroke width"] = None

Files, `Session.change`, conversion from unit to unit and the names of undo steps read the line, and
``tests/document/test_fields.py`` tests it. The rest of its meaning is an edit beside the others of its kind,
the panel that shows it and, for a style, ``app/qt`` (screen and print), ``app/exchange/svg`` and TikZ.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Final, NamedTuple, Union, get_args, get_origin, get_type_hints

import msgspec

Vector = tuple[float, float]
"""Position or vector in the plane."""

Ranges = tuple[Vector, Vector]
"""Ranges of x and y: a part of the plane."""

Scroll = tuple[Ranges | None, Ranges | None]
"""The parts of the plane visible before and after a drag that has scrolled the view."""

NO_SCROLL: Scroll = (None, None)


class Value(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """Immutable value of the document; files omit fields at their defaults."""


class Requirement(NamedTuple):
    """Requirement of the value of a field, beyond its type.

    Attributes
    ----------
    is_met
        Function that returns whether a value meets the requirement.
    text
        The requirement in words that follow "must": "be 0 or greater".
    of_all
        Whether it applies to the tuple of a field as a whole, not to each item.
    displayed
        Function that returns the part of the value that a refusal shows.
    """

    is_met: Callable[[Any], bool]
    text: str
    of_all: bool = False
    displayed: Callable[[Any], object] = lambda value: value


def at_least(least: float) -> Requirement:
    """Return the requirement that a number is at least `least`."""
    return Requirement(lambda value: value >= least, f"be {least:g} or greater")


def above(bound: float) -> Requirement:
    """Return the requirement that a number is greater than `bound`."""
    return Requirement(lambda value: value > bound, f"be greater than {bound:g}")


def between(least: float, most: float) -> Requirement:
    """Return the requirement that a number lies in [least, most]."""
    return Requirement(lambda value: least <= value <= most, f"lie between {least:g} and {most:g}")


def printable(most: int, text: str) -> Requirement:
    """Return the requirement that a value is one printable line of at most `most` characters."""
    return Requirement(lambda value: len(value) <= most and value.isprintable(), text)


def at_most_items(most: int, text: str) -> Requirement:
    """Return the requirement that a tuple has at most `most` items."""
    return Requirement(lambda values: len(values) <= most, text, of_all=True, displayed=len)


SHARE = between(0, 1)


def matching(pattern: str, text: str) -> Requirement:
    """Return the requirement that a value matches a regular expression."""
    return Requirement(lambda value: re.fullmatch(pattern, value) is not None, text)


LENGTH: Final = object()
"""Mark of a field whose numbers are lengths: they scale with the drawing."""


class Field(NamedTuple):
    """Field of a value, as its annotation describes it.

    Attributes
    ----------
    name
        Name of the field.
    kind
        Type of its value, or of its items: float, bool, str, a `Value`, or another type.
    is_many, is_optional
        Whether it is a tuple of items, and whether it may be None.
    requirements
        Requirements of the value, of each item, or of the tuple.
    label
        Label in the window; by default the name.
    is_length
        Whether its numbers are lengths in the plane.
    default
        Default value; `msgspec.NODEFAULT` where there is none.
    """

    name: str
    kind: type
    is_many: bool
    is_optional: bool
    requirements: tuple[Requirement, ...]
    label: str
    is_length: bool
    default: object

    @property
    def holds_values(self) -> bool:
        """Whether the field holds other values of the document."""
        return isinstance(self.kind, type) and issubclass(self.kind, Value)


@cache
def fields_of(kind: type[Value]) -> tuple[Field, ...]:
    """Return the fields of a kind of value, in order."""
    hints = get_type_hints(kind, include_extras=True)
    return tuple(_field(f.name, hints[f.name], f.default) for f in msgspec.structs.fields(kind))


def _field(name: str, hint: object, default: object) -> Field:
    hint, *notes = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    requirements = tuple(note for note in notes if isinstance(note, Requirement))
    label = next((note for note in notes if isinstance(note, str)), name)
    choices = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    first = next(choice for choice in choices if choice is not NoneType)
    is_many = get_origin(first) is tuple
    kind = get_args(first)[0] if is_many else first
    return Field(name, kind, is_many, NoneType in choices, requirements, label, LENGTH in notes, default)
