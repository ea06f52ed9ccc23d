"""Hit test of the basis panel."""

from __future__ import annotations

import numpy as np

from ...plotting.pixel_map import PixelMap
from ...tools.pointer import Hit, Part, Pointer
from ...view_model.basis_view import BasisView
from .layers import RailLayer, rail_height

TICK_REACH = 10.0
"""Pixels to either side of a tick within which it is grabbed."""

FUNCTION_REACH = 10.0

_SCRUB_REACH = 4.0


def hit_test(
    pointer: Pointer, shown: PixelMap, basis: BasisView | None, rail: RailLayer, kinds: frozenset[int]
) -> Hit | None:
    """Return what lies under the pointer: on the rail a tick, above it the scrub line before functions."""
    if pointer.pixel[1] > shown.height - rail_height(rail.scale) - 2:
        return _hit_tick(pointer, shown, rail)
    scrub = rail.scrub
    if scrub is not None and abs(shown.point(scrub, 0)[0] - pointer.pixel[0]) <= _SCRUB_REACH:
        return Hit(Part.SCRUB, -1, (scrub, 0.0))
    return _hit_function(pointer, shown, basis, kinds) if basis is not None else None


def _hit_tick(pointer: Pointer, shown: PixelMap, rail: RailLayer) -> Hit | None:
    parameters = rail.parameters
    if not len(parameters):
        return None
    distances = np.abs(shown.x(parameters) - pointer.pixel[0])
    # A selected tick wins over its neighbours.
    for index in np.flatnonzero(distances <= TICK_REACH).tolist():
        if rail.owner(index) in rail.selection:
            distances[index] -= TICK_REACH
    index = int(np.argmin(distances))
    if distances[index] > TICK_REACH:
        return None
    return Hit(Part.TICK, rail.owner(index), (float(parameters[index]), 0.0), knot=index)


def _hit_function(pointer: Pointer, shown: PixelMap, basis: BasisView, kinds: frozenset[int]) -> Hit | None:
    t = pointer.position[0]
    start, end = basis.curve.domain
    if not start <= t <= end:
        return None
    best: tuple[float, Hit] | None = None
    for kind in basis.shown_of(kinds):
        values = basis.value_at(t, kind)
        distances = np.abs(shown.y(values) - pointer.pixel[1])
        # Functions that are zero here lie on top of each other; none of them is meant.
        distances[values == 0] = np.inf
        index = int(np.argmin(distances))
        if distances[index] <= FUNCTION_REACH and (best is None or distances[index] < best[0]):
            hit = Hit(Part.FUNCTION, basis.owners[index], (t, float(values[index])), kind=kind)
            best = (float(distances[index]), hit)
    return best[1] if best is not None else None
