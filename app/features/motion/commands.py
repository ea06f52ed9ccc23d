"""Motion: a dot that runs along the curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ...actions.declaration import Action, action, action_for_each, also
from ...actions.keymap import action_name
from ...actions.menus import (
    MOTION_COMPARE,
    MOTION_MORE,
    MOTION_PACE,
    MOTION_REPEAT,
    MOTION_RUN,
    TOOLBAR,
    MenuSection,
)
from ...actions.needs import CURVE_THROUGH_TWO, Need
from ...families import Family
from ...view_model.curve.curve_view import CurveView
from ...view_model.motion_settings import Pace, Repeat, timed_families
from ...workbench.context import WindowContext
from .. import motion

if TYPE_CHECKING:
    from .stage import MotionStage


class _Choice(NamedTuple):
    """A value of a setting with several values, and the texts of its action."""

    value: Repeat | Pace
    text: str
    tip: str
    full_name: str
    icon: str = ""


_REPEATS = (
    _Choice(Repeat.ONCE, "Once", "Run to the end of the curve and stop", "Play Motion Once"),
    _Choice(Repeat.LOOP, "Loop", "Start again from the beginning", "Loop Motion", "loop"),
    _Choice(Repeat.PING_PONG, "Ping-Pong", "Run back and forth", "Ping-Pong Motion"),
)
_PACES = (
    _Choice(Pace.PARAMETER, "By t", "Increase t uniformly: the speed of the dot is |c′|", "Motion by t"),
    _Choice(
        Pace.LENGTH,
        "By Arc Length",
        "Increase the arc length uniformly: the dot has a constant speed",
        "Motion by Arc Length",
    ),
)


def _action_of(choice: _Choice, prefix: str, section: MenuSection, group: str, field: str) -> Action:
    """Return the action that gives the setting `field` a value."""
    return Action(
        action_name(prefix, choice.value),
        choice.text,
        section,
        icon=choice.icon,
        tip=choice.tip,
        full_name=choice.full_name,
        checked=lambda state: getattr(state.window.motion, field) is choice.value,
        group=group,
    )


class MotionCommands:
    """The actions of a motion; its parts in the window are made when the first action is used."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._stage: MotionStage | None = None

    def render_panel(self, view: CurveView) -> None:
        """Update the scale and the jumps, which are fixed during a drag."""
        if self._stage is not None:
            self._stage.settle(view)

    @property
    def stage(self) -> motion.stage.MotionStage:
        """The parts of the motion in the window; made at the first use."""
        if self._stage is None:
            self._stage = motion.stage.MotionStage(self._context)
            self._stage.settle(self._context.session.active_view)
        return self._stage

    def follow_drag(self, _view: CurveView) -> bool:
        """Keep dots and arrows on the curve."""
        if self._stage is not None:
            self._stage.follow()
        return self._stage is not None

    @action(
        "playMotion",
        "Play",
        MOTION_RUN,
        "K",
        "play",
        full_name="Play Motion",
        needs=Need(CURVE_THROUGH_TWO.words, lambda state: state.is_current or state.window.motion_visible),
        checked=lambda state: state.window.motion_plays,
    )
    @also(TOOLBAR(64))
    def _play(self) -> None:
        """Run a dot along the curve, with its velocity and acceleration; press again to pause."""
        self.stage.player.toggle()

    @action(
        "stopMotion",
        "Stop",
        MOTION_RUN,
        icon="stop",
        full_name="Stop Motion",
        needs=Need("", lambda state: state.window.motion_visible, "No motion is shown."),
    )
    def _stop(self) -> None:
        """Stop the motion (Escape)."""
        self.stage.player.stop()

    @action("motionSlower", "Slower", MOTION_RUN, "J", "slower", full_name="Slower Motion")
    def _slow_down(self) -> None:
        """Play slower."""
        self.stage.player.change_speed(-1)

    @action("motionFaster", "Faster", MOTION_RUN, "L", "faster", full_name="Faster Motion")
    def _speed_up(self) -> None:
        """Play faster."""
        self.stage.player.change_speed(1)

    @action_for_each(
        _REPEATS, lambda choice: _action_of(choice, "motion", MOTION_REPEAT, "motionRepeat", "repeat")
    )
    def _use_repeat(self, choice: _Choice) -> None:
        self.stage.player.change(repeat=choice.value)

    @action_for_each(_PACES, lambda choice: _action_of(choice, "motionBy", MOTION_PACE, "motionPace", "pace"))
    def _use_pace(self, choice: _Choice) -> None:
        self.stage.player.change(pace=choice.value)

    @action_for_each(
        timed_families,
        lambda family: Action(
            family.action_name.replace("family", "motionWith"),
            f"Compare with {family.label}",
            MOTION_COMPARE,
            tip=f"Also run a dot on {family.a_curve} through the same points",
            full_name=f"Compare Motion with {family.label}",
            needs=CURVE_THROUGH_TWO,
            checked=lambda state: family in state.window.motion.compared,
        ),
    )
    def _compare_with(self, family: Family) -> None:
        self.stage.player.compare(frozenset((family,)))

    @action(
        "motionCompare",
        "Compare All Families",
        MOTION_COMPARE,
        icon="compare",
        full_name="Compare Motion, All Families",
        needs=CURVE_THROUGH_TWO,
        checked=lambda state: frozenset(timed_families()) <= state.window.motion.compared,
    )
    def _compare(self) -> None:
        """Also run dots on curves of all families through the same points."""
        self.stage.player.compare(frozenset(timed_families()))

    @action("exportMotion", "Export Motion…", MOTION_MORE, icon="film", needs=CURVE_THROUGH_TWO)
    def _export(self) -> None:
        """Export the motion as GIF, APNG or MP4."""
        self.stage.export.ask(self.stage.player.settings)


COMMAND_SETS = (MotionCommands,)
