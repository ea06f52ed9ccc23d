"""Hit test of the basis panel."""

from __future__ import annotations

import numpy as np

from ...plotting.pixel_map import PixelMap
from ...tools.pointer import Hit, Part, Pointer
from ...view_model.basis import BasisView
from .layers import RailLayer, rail_height

TICK_REACH = 10.0
"""Pixels to either side of a tick within which it is grabbed."""

FUNCTION_REACH = 10.0

_SCRUB_REACH = 4.0

_PLACE_REACH = 5.0


def hit_test(
    pointer: Pointer, shown: PixelMap, basis: BasisView | None, rail: RailLayer, kinds: frozenset[int]
) -> Hit | None:
    """Return what lies under the pointer: on the rail a tick, above it the scrub line before functions.

    On the rail's edge lie the dots of control points; a tick that is nearer, or is pointed at, goes before.
    """
    if (place := _hit_place(pointer, shown, rail)) is not None:
        return place
    if pointer.pixel[1] > shown.height - rail_height(rail.scale) - 2:
        return _hit_tick(pointer, shown, rail)
    scrub = rail.scrub
    if scrub is not None and abs(shown.point(scrub, 0)[0] - pointer.pixel[0]) <= _SCRUB_REACH:
        return Hit(Part.SCRUB, -1, (scrub, 0.0))
    return _hit_function(pointer, shown, basis, kinds) if basis is not None else None


def _hit_place(pointer: Pointer, shown: PixelMap, rail: RailLayer) -> Hit | None:
    if rail.shown_places is None:
        return None
    top = shown.height - rail_height(rail.scale)
    if abs(pointer.pixel[1] - top) > _PLACE_REACH:
        return None
    distances = np.abs(shown.x(rail.shown_places) - pointer.pixel[0])
    index = int(np.argmin(distances))
    nearest_tick = float(np.abs(shown.x(rail.parameters) - pointer.pixel[0]).min())
    if distances[index] > _PLACE_REACH or (pointer.pixel[1] > top and nearest_tick <= distances[index]):
        return None
    return Hit(Part.PLACE, index, (float(rail.shown_places[index]), 0.0))


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
