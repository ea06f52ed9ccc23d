"""Move, scale, rotate and mirror the selected points, the selected curves or the curve that is edited."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeVar

from ...actions.declaration import Action, action, action_for_each, also_for_each, switch
from ...actions.menus import ARRANGE_BOX, ARRANGE_TRANSFORM, CURVE_MENU, TRANSFORM_BUTTONS
from ...actions.needs import CURVE_WITH_POINTS, Need
from ...document.model import Axis, Vector
from ...document.several_curves import transform_group
from ...document.transforms import Affine, reflection, rotation
from ...document.words import number
from ...state.window_state import WindowState
from ...tools.box import TransformKind
from ...tools.canvas.mirror import MIRROR_RESULT, MirrorResult, mirror_about_axis
from ...workbench.context import CommandSet, WindowContext
from .align_commands import AlignCommands
from .panel_commands import TransformPanelCommands


class _Transform(NamedTuple):
    """A transform by the pointer, and the words of its action."""

    kind: TransformKind
    text: str
    key: str
    tip: str


class _Flip(NamedTuple):
    """Mirror image, and the words of its action."""

    direction: str
    axis: int
    key: str
    tip: str


class _Turn(NamedTuple):
    """Turn by a fixed angle, the words of its action, and its place among the buttons."""

    name: str
    direction: str
    degrees: float
    key: str
    icon: str
    number: int


_TRANSFORMS = (
    _Transform(
        TransformKind.MOVE, "Move", "G",
        "Move the selection, or else all points, with the pointer; type x, Tab, y",
    ),
    _Transform(
        TransformKind.SCALE, "Scale", "S",
        "Scale the selection, or else all points, with the pointer; type a factor, or x, Tab, y",
    ),
    _Transform(
        TransformKind.ROTATE, "Rotate", "R",
        "Rotate the selection, or else all points, with the pointer; type an angle",
    ),
    _Transform(
        TransformKind.SKEW, "Skew", "Shift+R",
        "Skew the selection, or else all points, with the pointer; type an angle; Y: vertically",
    ),
)  # fmt: skip

_FLIPS = (
    _Flip("horizontally", 0, "H", "Flip the selection, or else all points, left to right"),
    _Flip("vertically", 1, "Shift+V", "Flip the selection, or else all points, top to bottom"),
)

_TURNS = (
    _Turn("rotateLeft", "left", 90.0, "Ctrl+[", "rotate", 12),
    _Turn("rotateRight", "right", -90.0, "Ctrl+]", "rotate-right", 13),
)

_BOX = Need(
    "at least two selected points, or a selected curve",
    lambda state: state.active_selected_count > 1 or state.whole_count > 0,
)

_MIRRORED = {MirrorResult.COPY: "a Copy ", MirrorResult.IN_PLACE: ""}


def _result(state: WindowState) -> MirrorResult:
    return state.tool_settings.value(MIRROR_RESULT)


_Amount = TypeVar("_Amount", int, float)


class SelectionCommands(CommandSet):
    """Actions on several points at once."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context)
        self._target = context.central.canvas.tools.box
        context.store.changed.connect(self._show_state)
        self._session.history_changed.connect(self._target.keep_pivot)
        for changed in (self._session.pivot_changed, self._session.grips_changed):
            changed.connect(context.central.canvas.show_marks)

    def _show_state(self, _before: WindowState, state: WindowState) -> None:
        canvas = self._context.central.canvas
        box = canvas.tools.box
        box.is_visible, box.keeps_proportions = state.transform_box, state.keep_proportions
        canvas.show_marks()

    @action_for_each(
        _TRANSFORMS,
        lambda transform: Action(
            f"{transform.kind.name.lower()}Selection",
            transform.text,
            ARRANGE_TRANSFORM,
            transform.key,
            transform.text.lower(),
            transform.tip,
            f"{transform.text} Points",
            during_gesture=True,
        ),
    )
    def _begin(self, transform: _Transform) -> None:
        if self._context.store.state.moves_image:
            self._session.refuse("Move Image is in use. Press Escape to return to the points.")
        else:
            self._context.central.canvas.begin_transform(transform.kind)

    @action_for_each(
        _FLIPS,
        lambda flip: Action(
            f"flip{flip.direction.capitalize()}",
            f"Flip {flip.direction.capitalize()}",
            ARRANGE_TRANSFORM,
            flip.key,
            f"flip-{flip.direction}",
            flip.tip,
            needs=CURVE_WITH_POINTS,
            keywords="mirror reflect",
        ),
    )
    @also_for_each(lambda flip: (CURVE_MENU(16 + flip.axis), TRANSFORM_BUTTONS(10 + flip.axis)))
    def _flip(self, flip: _Flip) -> None:
        self._map(f"Flip {{}} {flip.direction}", reflection, flip.axis)

    @action_for_each(
        [*Axis],
        lambda axis: Action(
            f"mirror{axis.upper()}Axis",
            f"Mirror about the {axis} Axis",
            ARRANGE_TRANSFORM,
            icon="mirror",
            title=lambda state: f"Mirror {_MIRRORED[_result(state.window)]}about the {axis} Axis",
            tip=f"Mirror the selection about the {axis} axis; as a copy or in place, like the Mirror tool",
            needs=CURVE_WITH_POINTS,
            keywords="flip reflect symmetry copy",
        ),
    )
    def _mirror(self, axis: Axis) -> None:
        canvas, result = self._context.central.canvas.tools.canvas, _result(self._context.store.state)
        mirror_about_axis(self._session, self._target, canvas, result, axis)

    @action_for_each(
        _TURNS,
        lambda turn: Action(
            turn.name,
            f"Rotate {abs(turn.degrees):g}° {turn.direction.capitalize()}",
            ARRANGE_TRANSFORM,
            turn.key,
            turn.icon,
            f"Rotate the selection, or else all points, by {abs(turn.degrees):g}° to the {turn.direction}",
            needs=CURVE_WITH_POINTS,
            keywords="turn quarter clockwise",
        ),
    )
    @also_for_each(lambda turn: (TRANSFORM_BUTTONS(turn.number),))
    def _turn(self, turn: _Turn) -> None:
        self._map(f"Rotate {{}} by {number(turn.degrees)}°", rotation, turn.degrees)

    def _map(self, text: str, make: Callable[[_Amount, Vector], Affine], amount: _Amount) -> None:
        """Transform the selection about the pivot."""
        target, session = self._target, self._session
        if refusal := target.refusal_of_keys:
            session.refuse(refusal)
            return
        group, by = target.for_keys, make(amount, target.centre)
        is_done = session.change(
            text.format(target.words), lambda document: transform_group(document, group, by)
        )
        if is_done and group.remark:
            session.say(f"{group.remark}.")

    @action(
        "turnGrips",
        "Rotate and Skew Grips",
        ARRANGE_BOX,
        needs=_BOX,
        checked=lambda state: state.grips_turn,
        keywords="shear slant second click box",
    )
    def _turn_grips(self) -> None:
        """Switch the grips of the box between scaling and rotating, like a click on a selected curve."""
        box = self._session.box
        box.set_turns(not box.turns)

    @switch(
        "transform_box",
        "toggleTransformBox",
        "Box with Grips",
        ARRANGE_BOX,
        icon="transform-box",
        full_name="Transform Box with Grips",
        during_gesture=True,
    )
    def _toggle_box(self) -> None:
        """Show a box with grips around two or more selected points, or around selected curves."""

    @switch(
        "keep_proportions",
        "keepProportions",
        "Keep Proportions",
        ARRANGE_BOX,
        icon="lock",
        full_name="Transform Panel: Keep Proportions",
    )
    def _toggle_proportions(self) -> None:
        """Scale width and height together when either is typed."""


COMMAND_SETS = (SelectionCommands, AlignCommands, TransformPanelCommands)
