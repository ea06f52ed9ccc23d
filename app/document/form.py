"""What a curve was drawn as: the base of the forms, their handles and their numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar, NamedTuple, Self

from msgspec.structs import replace

from .guide import Length
from .value import Value, Vector

Piece = tuple[Vector, Vector, Vector, Vector]
"""The control points of a cubic piece."""


class FormHandle(NamedTuple):
    """A place of a form that can be dragged.

    Attributes
    ----------
    name
        What it is to the form.
    place
        Where it is, as the form was drawn.
    words
        What a drag of it changes.
    keys
        What modifier keys do meanwhile.
    is_round
        Whether its mark is a disc, as for what is no size.
    """

    name: str
    place: Vector
    words: str
    keys: str = ""
    is_round: bool = False


class FormField(NamedTuple):
    """A number of a form that can be typed.

    Attributes
    ----------
    name
        Of the field.
    label, words
        A short name before the box, and what it is.
    is_length
        Whether it may have a unit.
    limits
        The least and the largest that it can be; None for any length that there is.
    share
        Of a length: the name of the same as a share of a whole, which per cent set; empty without one.
    """

    name: str
    label: str
    words: str
    is_length: bool = True
    limits: tuple[float, float] | None = None
    share: str = ""

    @property
    def as_share(self) -> FormField:
        """The same as a share of a whole."""
        return FormField(self.share, self.label, self.words, is_length=False)


class Form(Value, frozen=True, tag_field="kind", tag=str.lower):
    """What a closed curve was drawn as, before it was moved, turned or stretched.

    To add a kind: a subclass in ``forms``, which names itself, says how it runs, and what of it is dragged
    and typed; and its name in `AnyForm` there.

    Attributes
    ----------
    x, y
        A place of it, such as a corner of its box.
    noun
        What people call it.
    fields
        Its numbers, in the order in which they are shown.
    stretches
        Whether it is one of its kind still when it is wider than high; else it grows alike both ways.
    """

    x: Length
    y: Length

    noun: ClassVar[str] = ""
    fields: ClassVar[tuple[FormField, ...]] = ()
    stretches: ClassVar[bool] = True

    @property
    def word(self) -> str:
        """What people call it as it is now."""
        return self.noun

    @property
    def pieces(self) -> Sequence[Piece]:
        """How it runs; each piece begins where the one before ends, the first where the last one does."""
        raise NotImplementedError

    @property
    def handles(self) -> Sequence[FormHandle]:
        """What can be dragged; of several at a place the first is meant."""
        raise NotImplementedError

    def dragged(self, handle: str, to: Vector, *, ctrl: bool, shift: bool) -> Self:
        """Return the form with a handle somewhere else."""
        raise NotImplementedError

    def scaled(self, across: float, up: float) -> Self:
        """Return the form so many times as wide and high, about its place."""
        raise NotImplementedError

    def has_number(self, name: str) -> bool:
        """Whether one of its kind's numbers is one of its own."""
        return name in {each.name for each in self.fields}

    def with_number(self, name: str, value: float) -> Self:
        """Return the form with a number that was typed."""
        return replace(self, **{name: value})

    def at(self, place: Vector) -> Self:
        """Return the form at another place."""
        return replace(self, x=place[0], y=place[1])
