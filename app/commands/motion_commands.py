"""Motion: a dot that runs along the curve."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from app.commands.file_work import FileWork
from app.commands.parts import Handlers, Parts
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from app.commands.motion_stage import MotionStage


class MotionCommands:
    """The actions of a motion; what they act on is made when the first of them is used."""

    def __init__(self, parts: Parts, work: FileWork) -> None:
        self._parts, self._work = parts, work
        self._stage: MotionStage | None = None
        for name in ("motionLoop", "motionByT"):
            parts.actions[name].setChecked(True)
        parts.actions["stopMotion"].setEnabled(False)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        names = ("motionOnce", "motionLoop", "motionPingPong", "motionByT", "motionByLength")
        return {
            "playMotion": self._play,
            "stopMotion": self._stop,
            "motionSlower": lambda: self.stage.player.change_speed(-1),
            "motionFaster": lambda: self.stage.player.change_speed(1),
            **{name: partial(self._choose, name) for name in names},
            "motionCompare": self._compare,
            "exportMotion": self._export,
        }

    def render(self, view: CurveView) -> None:
        """Enable what needs a curve."""
        actions = self._parts.actions
        for name in ("motionCompare", "exportMotion"):
            actions[name].setEnabled(view.is_current)
        is_open = self._stage is not None and self._stage.player.is_open
        actions["playMotion"].setEnabled(view.is_current or is_open)
        if self._stage is not None:
            self._stage.settle(view)

    @property
    def stage(self) -> MotionStage:
        """What the motion needs in the window; made when it is first asked for."""
        if self._stage is None:
            # Nobody waits at the start for what is perhaps never played.
            from app.commands.motion_stage import MotionStage  # noqa: PLC0415

            self._stage = MotionStage(self._parts, self._work)
            self._stage.settle(self._parts.session.active_view)
        return self._stage

    def follow(self, view: CurveView) -> None:
        """Keep dots and arrows on the curve."""
        if self._stage is not None:
            self._stage.follow()

    def _play(self) -> None:
        self.stage.play_or_pause()

    def _compare(self) -> None:
        self.stage.compare()

    def _export(self) -> None:
        self.stage.ask_and_export()

    def _stop(self) -> None:
        self.stage.player.stop()

    def _choose(self, name: str) -> None:
        from app.view_model.motion import Pace, Repeat  # noqa: PLC0415

        fields: dict[str, dict[str, object]] = {
            "motionOnce": {"repeat": Repeat.ONCE},
            "motionLoop": {"repeat": Repeat.LOOP},
            "motionPingPong": {"repeat": Repeat.PING_PONG},
            "motionByT": {"pace": Pace.PARAMETER},
            "motionByLength": {"pace": Pace.LENGTH},
        }
        self.stage.player.change(**fields[name])
