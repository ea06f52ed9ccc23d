"""Arrow keys and Tab while no gesture is in flight: move the selected points, select the next one."""

from __future__ import annotations

import math

from ..document import words
from ..document.model import Vector
from ..document.point_group import PointGroup, points_of
from ..document.several_curves import step_group
from .editing_session import EditingSession

DIRECTIONS: dict[str, Vector] = {
    "left": (-1.0, 0.0),
    "right": (1.0, 0.0),
    "up": (0.0, 1.0),
    "down": (0.0, -1.0),
}
"""Names of the arrow keys, and their directions in the plane."""


def nudge(session: EditingSession, group: PointGroup, step: Vector) -> None:
    """Move points, or whole curves, by a step; quick nudges of the same group are one undo step."""
    if not session.change(
        f"Nudge {group.label}", lambda document: step_group(document, group, step), run=("points", group)
    ):
        return
    text, one = f"{group.label} nudged", group.only_point
    if one is not None:
        curve, index = one
        text = words.point_at(index, session.document.curves[curve].points[index].position, math.hypot(*step))
    session.say(" · ".join(filter(None, (f"{text} · step {words.pair_text(step)}", group.remark))))


def select_next(session: EditingSession, step: int) -> bool:
    """Select the next (1) or previous (−1) point of the edited curves; return whether there is one."""
    order = [
        (curve, index)
        for curve in sorted(session.selected.active_curves)
        for index in range(len(session.document.curves[curve].points))
    ]
    points, active = session.selected.points, session.active_index
    if points:
        rank = order.index((active, max(points) if step > 0 else min(points))) + step
    else:
        # The first of the active curve, or its last.
        ranks = [rank for rank, (curve, _) in enumerate(order) if curve == active]
        rank = ranks[0 if step > 0 else -1] if ranks else -1
    if not 0 <= rank < len(order):
        return False
    curve, index = order[rank]
    session.selected.set_group(points_of(curve, [index]))
    return True
