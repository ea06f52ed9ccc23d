"""Handles that stay where they are while points move.

A velocity is per unit of t; what a person sees and drags of it is the handle, h v / 3. Where a rule spaces
the parameters by distance, every h is a share of the whole length, so one moved point changes them all, and
with them the handles of finished parts far away. The derivatives that the person set are rescaled here for
the new h: what lies between points that stay keeps its shape, points that move together keep their handles,
or scale them as their distances, and where a distance changes the handles along it change with it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from itertools import pairwise

from msgspec.structs import replace

from app.document.limits import checked_vector
from app.document.model import Curve, Node, ParametrizationKind

DERIVATIVES = (
    (1, "velocity"),
    (2, "acceleration"),
    (1, "velocity_after"),
    (2, "acceleration_after"),
)
"""The derivatives of a node: their orders and names."""

_NOISE = 1e-12
"""A change of h that is rounding."""


def with_handles_kept(before: Curve, after: Curve, together: Collection[int] = ()) -> Curve:
    """Return `after`, whose points are elsewhere or fewer, with derivatives set for the new spacing.

    Those of the nodes `together` went with them: handles between two of these grow as their distance does.
    """
    exponent = _exponent(after)
    if exponent is None or not before.has_derivatives:
        return after
    old, new = _spacings(before, exponent), _spacings(after, exponent)
    whole = sum(old), sum(new)
    if not all(0.0 < total < math.inf for total in whole):
        return after
    far = whole[0] / whole[1]
    if len(old) != len(new):
        factors = [far] * len(after.nodes)
    else:
        factors = [far * near for near in _near(after, together, old, new)]
    return replace(after, nodes=tuple(map(_for_spacing, after.nodes, factors)))


def _exponent(curve: Curve) -> float | None:
    """Return the power of the distances that the spacings are in proportion to; None where to nothing."""
    match curve.parametrization.kind:
        case ParametrizationKind.UNIFORM:
            return 0.0
        case ParametrizationKind.CENTRIPETAL:
            return 0.5
        case ParametrizationKind.CHORD_LENGTH:
            return 1.0
        case ParametrizationKind.POWER:
            return curve.parametrization.alpha
        case _:
            return None


def _spacings(curve: Curve, exponent: float) -> list[float]:
    """Return what the spacings are in proportion to, one for each segment."""
    nodes = (*curve.nodes, curve.nodes[0]) if curve.is_closed else curve.nodes
    return [math.dist(a.position, b.position) ** exponent for a, b in pairwise(nodes)]


def _near(after: Curve, together: Collection[int], old: Sequence[float], new: Sequence[float]) -> list[float]:
    """Return by how much the segments at each node grow that have both ends among the nodes `together`."""
    count, together = len(after.nodes), frozenset(together)
    lengths = [(0.0, 0.0)] * count
    for segment, pair in enumerate(zip(old, new, strict=True)):
        ends = segment, (segment + 1) % count
        if all(end in together for end in ends):
            for end in ends:
                lengths[end] = lengths[end][0] + pair[0], lengths[end][1] + pair[1]
    return [now / was if was > 0.0 and now > 0.0 else 1.0 for was, now in lengths]


def _for_spacing(node: Node, factor: float) -> Node:
    return node if abs(factor - 1.0) < _NOISE else stretched(node, factor)


def stretched(node: Node, factor: float) -> Node:
    """Rescale derivatives for a time that runs `factor` times as long."""
    if factor == 1:
        return node
    changed = {
        name: checked_vector(
            (_divided(vector[0], factor, order), _divided(vector[1], factor, order)), "a derivative"
        )
        for order, name in DERIVATIVES
        if (vector := getattr(node, name)) is not None
    }
    return replace(node, **changed) if changed else node


def _divided(value: float, factor: float, times: int) -> float:
    """Divide by `factor` several times: its powers may vanish, or be infinite, where it is not."""
    for _ in range(times):
        value /= factor
    return value
