"""Drags that transform what is selected, as they begin in the context of a press or a key."""

from __future__ import annotations

import math

from msgspec.structs import replace

from ..document.point_group import PointGroup
from .drags import MovePoints
from .tool import ToolContext
from .transform import Transform, TransformKind
from .transform_box import Grip, ScaleBox


def moving(context: ToolContext, group: PointGroup) -> MovePoints:
    """Return the drag of a group from the pointer on; what snaps is its point that is nearest."""
    grip = _nearest(context, group)
    snapper = context.snappers.for_group(group, grip)
    return MovePoints(context.host.document, group, context.pointer.position, snapper, grip)


def transforming(context: ToolContext, kind: TransformKind) -> Transform:
    """Return the transform that begins at the pointer; with nothing selected, of all points."""
    target = context.target
    group = target.for_keys
    grip = _nearest(context, group)
    return Transform(
        context.host.document,
        kind,
        group,
        target.centre,
        target.bounds.place(1, 1),
        context.pointer.position,
        context.snappers.for_group(group, grip),
        grip,
        everything=target.group is None,
    )


def turning(context: ToolContext, grip: Grip) -> Transform:
    """Return the drag of a grip of the box that rotates or skews."""
    drag, box = replace(transforming(context, grip.does), by_grip=True), context.target.box
    if box is None or not box.turns:
        return drag
    hold, opposite = box.place(grip.x, grip.y), box.place(-grip.x, -grip.y)
    return replace(drag, hold=hold, opposite=opposite, axis=int(grip.y == 0))


def scaling(context: ToolContext, grip: Grip) -> ScaleBox:
    """Return the drag of a grip of the box that scales."""
    host, target, settings = context.host, context.target, context.settings
    group, box = target.group, target.box
    assert group is not None
    assert box is not None
    return ScaleBox(
        host.document,
        host.views,
        group,
        box,
        target.centre,
        grip,
        context.pointer.position,
        context.snappers.for_grip(grip, group),
        even=settings.keeps_proportions and bool(grip.x and grip.y),
    )


def _nearest(context: ToolContext, group: PointGroup) -> tuple[int, int]:
    """Return the curve and the index of the point that is nearest to the pointer: it snaps."""
    curves, pointer = context.host.document.curves, context.pointer
    places = [(curve, index) for curve, indices in group.parts for index in indices]
    return min(places, key=lambda at: math.dist(curves[at[0]].points[at[1]].position, pointer.position))
