"""Scaling by keys: a step larger or smaller, twice or half as large."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ...actions.declaration import Action, action_for_each
from ...actions.sections import EDIT_TRANSFORM
from ...document.model import Document
from ...document.several_curves import mapped, scaled_strokes
from ...document.transforms import scaling
from ...tools.pointer import Stride
from ...workbench.context import WindowContext

_LEAST_LEFT = 0.01
"""Share of the longer side that a step leaves at least: nothing is scaled to a point, nor turned over."""


class _Scale(NamedTuple):
    """Another size: the words of its action, and the longer side that comes of one and of the step."""

    name: str
    text: str
    key: str
    icon: str
    tip: str
    verb: str
    size: Callable[[float, float], float]


_SCALES = (
    _Scale(
        "scaleUpStep", "Enlarge by a Step", ">, .", "scale",
        "Make what is selected or chosen longer by the step of the arrow keys, about its middle",
        "Enlarge", lambda side, step: side + step,
    ),
    _Scale(
        "scaleDownStep", "Shrink by a Step", "<, ,", "scale",
        "Make what is selected or chosen shorter by the step of the arrow keys, about its middle",
        "Shrink", lambda side, step: side - step,
    ),
    _Scale(
        "doubleSize", "Double the Size", "Ctrl+>", "scale",
        "Make what is selected or chosen twice as large, about its middle",
        "Double", lambda side, _step: 2.0 * side,
    ),
    _Scale(
        "halveSize", "Halve the Size", "Ctrl+<", "scale",
        "Make what is selected or chosen half as large, about its middle",
        "Halve", lambda side, _step: 0.5 * side,
    ),
)  # fmt: skip


class ScaleCommands:
    """Scales what is chosen by keys."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._tools = context.session, context.central.canvas.tools
        self._camera = context.central.canvas.camera

    @action_for_each(
        _SCALES,
        lambda each: Action(
            each.name,
            each.text,
            EDIT_TRANSFORM,
            each.key,
            each.icon,
            each.tip,
            keywords="scale size grow bigger smaller larger resize half double percent",
        ),
    )
    def _scale(self, each: _Scale) -> None:
        session, target = self._session, self._tools.target
        if refusal := target.refusal_of_keys:
            session.refuse(refusal)
            return
        group, bounds, strokes = target.for_keys, target.bounds, self._tools.settings.strokes
        side = max(bounds.size)
        if not side:
            session.refuse("What is selected lies at one place, which has no size.")
            return
        step = self._tools.context.step_of(Stride(self._camera.pixel_size))
        factor = max(each.size(side, step) / side, _LEAST_LEFT)

        def edit(document: Document) -> Document:
            new = mapped(document, group, scaling(factor, factor, bounds.centre))
            return scaled_strokes(new, group, factor, factor) if strokes.scaled else new

        run = (each.name, group)
        if session.change(f"{each.verb} {target.words}", edit, run=run) and group.stays:
            session.say(f"{group.stays}.")
