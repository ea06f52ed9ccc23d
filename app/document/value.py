"""Base of the document's values."""

from __future__ import annotations

import msgspec

Vector = tuple[float, float]
"""A place or a way in the plane."""


class Value(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """An immutable value of the document; a file leaves out what is at its default."""
