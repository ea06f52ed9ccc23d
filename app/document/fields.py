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
"""A place or a way in the plane."""


class Value(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """An immutable value of the document; a file leaves out what is at its default."""


class Requirement(NamedTuple):
    """Requirement of what a field holds, beyond its type.

    Attributes
    ----------
    is_met
        Tells of a value of the type whether it meets it.
    text
        It, to follow "must": "be 0 or greater".
    of_all
        Whether it is one of the whole tuple, where a field holds one.
    displayed
        What of the value a refusal tells.
    """

    is_met: Callable[[Any], bool]
    text: str
    of_all: bool = False
    displayed: Callable[[Any], object] = lambda value: value


def at_least(least: float) -> Requirement:
    """Return the requirement of a number that is not below another."""
    return Requirement(lambda value: value >= least, f"be {least:g} or greater")


def above(bound: float) -> Requirement:
    """Return the requirement of a number that is greater than another."""
    return Requirement(lambda value: value > bound, f"be greater than {bound:g}")


def between(least: float, most: float) -> Requirement:
    """Return the requirement of a number that lies between two others, or is one of them."""
    return Requirement(lambda value: least <= value <= most, f"lie between {least:g} and {most:g}")


def printable(most: int, words: str) -> Requirement:
    """Return the requirement of a text on one line, of at most so many characters."""
    return Requirement(lambda text: len(text) <= most and text.isprintable(), words)


def at_most_items(most: int, words: str) -> Requirement:
    """Return the requirement of a tuple of at most so many."""
    return Requirement(lambda values: len(values) <= most, words, of_all=True, displayed=len)


SHARE = between(0, 1)


def matching(pattern: str, words: str) -> Requirement:
    """Return the requirement of a text that a pattern describes."""
    return Requirement(lambda text: re.fullmatch(pattern, text) is not None, words)


LENGTH: Final = object()
"""Mark of a field whose numbers are twice as large in a drawing twice as large."""


class Field(NamedTuple):
    """A field of a value.

    Attributes
    ----------
    name
        Of the field.
    kind
        What it holds, or holds several of: float, bool, str, a `Value`, or something else.
    is_many, is_optional
        Whether it is a tuple of these, and whether it may be None.
    requirements
        Of each of them, or of all.
    label
        What people call it; its name where that is not said.
    is_length
        Whether its numbers are lengths in the plane.
    default
        What it holds where nothing else was said; `msgspec.NODEFAULT` where there is no such thing.
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
        """Whether it holds other values of the document."""
        return isinstance(self.kind, type) and issubclass(self.kind, Value)


@cache
def fields_of(kind: type[Value]) -> tuple[Field, ...]:
    """Return the fields of a kind of value, in order."""
    hints = get_type_hints(kind, include_extras=True)
    return tuple(_field(each.name, hints[each.name], each.default) for each in msgspec.structs.fields(kind))


def _field(name: str, hint: object, default: object) -> Field:
    hint, *notes = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    requirements = tuple(note for note in notes if isinstance(note, Requirement))
    words = next((note for note in notes if isinstance(note, str)), name)
    choices = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    first = next(choice for choice in choices if choice is not NoneType)
    is_many = get_origin(first) is tuple
    kind = get_args(first)[0] if is_many else first
    return Field(name, kind, is_many, NoneType in choices, requirements, words, LENGTH in notes, default)
