"""A picture to trace."""

from __future__ import annotations

from typing import Annotated

from .fields import Requirement, above, between
from .guide import Length
from .value import Value

_PATH = Requirement(lambda path: bool(path.strip()) and path.isprintable(), "be the name of a file")
_OF_THIS_COMPUTER = Requirement(
    # Opening another would knock at that computer, and on some systems with the person's password.
    lambda path: not path.startswith(("//", "\\\\")),
    "lead to a file of this computer, not to one of the network",
)


class ReferenceImage(Value, frozen=True, omit_defaults=False):
    """A picture to trace, behind the curves.

    Attributes
    ----------
    path
        Its file: absolute in a document that is open, with forward slashes and relative to the document's
        own folder in a file.
    x, y
        Where its lower left corner lies.
    width, height
        Its size in the plane; what the file holds is fitted into it.
    opacity
        From 0, invisible, to 1.
    locked
        Whether it is safe from being moved.
    """

    path: Annotated[str, _PATH, _OF_THIS_COMPUTER]
    x: Length
    y: Length
    width: Annotated[Length, above(0)]
    height: Annotated[Length, above(0)]
    opacity: Annotated[float, between(0, 1)] = 0.5
    locked: bool = False
