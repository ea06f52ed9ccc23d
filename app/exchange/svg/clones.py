"""Clones of an SVG file: what a `use` shows, as clones of the paths that its target is drawn as."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import replace

import numpy as np

from curvecore.arrays import FloatArray

from ...document.clone import Clone
from ...document.model import MAX_MAGNITUDE
from .groups import Drawn
from .matrices import combined, inverse_of
from .text_paths import linked as along_linked

_ROUNDING = 1e-14


def linked(drawn: Sequence[Drawn], key: str) -> list[Drawn]:
    """Return paths that know what they are clones of; identities begin with `key`.

    What is drawn only where it is used, as a symbol, has no original: none of its places moves the others.
    """
    known: dict[Hashable, int] = {}
    for place, each in enumerate(drawn):
        known.setdefault((each.state.inside, each.source), place)
    found: dict[int, tuple[int, FloatArray]] = {}
    for place, each in enumerate(drawn):
        uses = each.state.inside
        if not uses or each.source is None:
            continue
        ways = (known.get((uses[cut:], each.source)) for cut in range(1, len(uses) + 1))
        original = next((way for way in ways if way is not None), None)
        if original is not None and (by := _map(drawn[original], each)) is not None:
            found[place] = original, by
    paths = [each.path for each in drawn]
    for place, (original, by) in found.items():
        identity = f"{key}{original}"
        paths[original] = replace(paths[original], identity=identity)
        paths[place] = replace(paths[place], clone=_clone(identity, by))
    paths = along_linked(drawn, paths, key)
    return [replace(each, path=path) for each, path in zip(drawn, paths, strict=True)]


def _map(original: Drawn, clone: Drawn) -> FloatArray | None:
    """Return the matrix (2, 3) from an original to its clone; None where there is none."""
    before, after = original.state.matrix, clone.state.matrix
    if np.array_equal(before[:, :2], after[:, :2]):
        # Without the rounding of an inverse.
        return np.column_stack([np.eye(2), after[:, 2] - before[:, 2]])
    try:
        by = combined(after, inverse_of(before))
    except np.linalg.LinAlgError:
        return None
    return by if (np.abs(by) <= MAX_MAGNITUDE).all() else None


def _clone(identity: str, by: FloatArray) -> Clone:
    off = by[:, :2] - np.eye(2)
    off[np.abs(off) <= _ROUNDING] = 0.0
    return Clone(identity, *off.ravel().tolist(), *by[:, 2].tolist())
