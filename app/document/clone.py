"""What a curve is a clone of, and the map from there."""

from __future__ import annotations

from typing import Annotated

from .fields import printed
from .guide import Length
from .value import Value, Vector

_LONGEST_IDENTITY = 64

Identity = Annotated[
    str, printed(_LONGEST_IDENTITY, f"be a text of at most {_LONGEST_IDENTITY} characters on one line")
]
"""What clones know a curve by, whatever it is called."""


class Clone(Value, frozen=True):
    """The original of a clone, and the affine map that takes it to the clone.

    Attributes
    ----------
    of
        The identity of the original.
    xx, xy, yx, yy
        The matrix of the map minus the identity, row by row.
    x, y
        Where the map takes the origin.
    """

    of: Identity
    xx: float = 0.0
    xy: float = 0.0
    yx: float = 0.0
    yy: float = 0.0
    x: Length = 0.0
    y: Length = 0.0

    @property
    def shift(self) -> Vector:
        """Where the map takes the origin."""
        return self.x, self.y
