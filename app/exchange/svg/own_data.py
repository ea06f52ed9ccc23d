"""What we know of a shape and SVG has no word for: data beside its element, which others pass over.

Data of a file are never trusted: they hold what a document may, or count for nothing, and so they do where
another program has made the element another shape. Moved, turned and stretched it is the same.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Final

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ...document.text import Text
from ...storage.field_check import check_fields
from ...storage.format_error import FormatError
from ..drawing.outlines import Outline

ATTRIBUTE: Final = "data-curvebench"
"""Name of what holds them."""

_LONGEST = 10_000
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_DIGITS, _NEAR = 6, 1e-3


class OwnData(msgspec.Struct, frozen=True, omit_defaults=True):
    """Data of a shape.

    To keep more of it: a field here, and its place in `ImportedPath` and `Outline`.

    Attributes
    ----------
    text
        What it was written as, if it is a letter.
    """

    text: Text | None = None

    def text_of(self, outline: int) -> Text | None:
        """Return what one of the outlines of the shape was written as: of a text the first begins it."""
        return replace(self.text, begins=False) if self.text is not None and outline else self.text


class _Sealed(OwnData, frozen=True, kw_only=True):
    """The same with what tells whether the shape is still the one that they were written of."""

    seal: float


_DECODER = msgspec.json.Decoder(_Sealed)
NOTHING = OwnData()
"""Data of a shape of which there is nothing to be said."""


def of_shape(shape: Sequence[Outline]) -> OwnData:
    """Return the data of a shape: what all its outlines have in common."""
    first, *others = shape
    is_one = first.text is not None and all(each.text == replace(first.text, begins=False) for each in others)
    return OwnData(first.text if is_one else None)


def words_of(data: OwnData, outlines: Sequence[FloatArray]) -> str:
    """Return data as the attribute of a shape with these outlines, each (k, 4, 2); empty without any."""
    if data == NOTHING:
        return ""
    sealed = _Sealed(**msgspec.structs.asdict(data), seal=round(_seal(outlines), _DIGITS))
    # All in ASCII: XML knows neither all letters nor all ends of lines.
    return json.dumps(msgspec.to_builtins(sealed), separators=(",", ":"))


def read(words: str | None, outlines: Sequence[FloatArray]) -> OwnData:
    """Return the data that an attribute holds of a shape with these outlines; none where it does not fit."""
    if not words or len(words) > _LONGEST:
        return NOTHING
    try:
        found = _DECODER.decode(words)
        if found.text is not None:
            check_fields(found.text)
    except (msgspec.MsgspecError, FormatError, UnicodeEncodeError):
        return NOTHING
    # Written so that NaN fails.
    return OwnData(found.text) if abs(found.seal - _seal(outlines)) <= _NEAR else NOTHING


def _seal(outlines: Sequence[FloatArray]) -> float:
    """Return a number that tells shapes apart, and is the same after any affine map.

    To twice the number of points it adds how far each is off their middle, weighted, in all 2 at most; far
    is measured by the spread of all, which a map takes along.
    """
    points = np.concatenate(outlines).reshape(-1, 2)
    off = points - points.mean(axis=0)
    extent = np.abs(off).max()
    base, sizes, _ = np.linalg.svd(off / extent if extent > 0 else off, full_matrices=False)
    far = (base[:, sizes > _NEAR * sizes.max()] ** 2).sum(axis=1)
    weights = _GOLDEN * np.arange(len(points)) % 1.0
    return 2.0 * len(points) + float(weights @ far)
