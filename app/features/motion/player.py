"""Player of a motion: moves the scrub line with the clock."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from msgspec.structs import replace
from PySide6.QtCore import QObject, Qt, QTimer, Signal

from ...families import Family
from ...session import Session
from ...state.window_state import WindowStore
from ...view_model.curve.curve_view import ParametricCurve
from ...view_model.motion import Course, folded, round_duration
from ...view_model.motion_settings import SPEEDS, MotionSettings, Repeat

FRAME_MS = 16
"""Milliseconds from frame to frame; slower drawing drops frames, because each frame reads the clock."""

_LEAST_PAUSE = 0.5e-3 * FRAME_MS


class Player(QObject):
    """A motion along the active curve, which moves the scrub line.

    Attributes
    ----------
    seconds
        Time of the motion, at speed 1.
    clock
        Function that returns seconds; tests replace it.

    Signals
    -------
    moved
        The dot has moved.
    changed
        The motion started, paused or stopped, or its settings changed.
    """

    moved = Signal()
    changed = Signal()

    def __init__(self, session: Session, store: WindowStore, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._store = session, store
        self.seconds = 0.0
        self.clock: Callable[[], float] = time.perf_counter
        self._last = 0.0
        self._scrub_before: float | None = None
        self._is_moving = False
        self._course: Course | None = None
        self._ran_on: ParametricCurve | None = None
        self._timer = QTimer(self, interval=FRAME_MS)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._tick_unless_just_done)
        session.scrub_changed.connect(self._follow_scrub)

    @property
    def settings(self) -> MotionSettings:
        """Speed, pace, and repetition at the end."""
        return self._store.state.motion

    @property
    def is_open(self) -> bool:
        """Whether a motion plays or is paused."""
        return self._store.state.motion_visible

    @property
    def is_playing(self) -> bool:
        """Whether the dot is running."""
        return self._store.state.motion_plays

    @property
    def course(self) -> Course | None:
        """The course along the active curve; None while there is no curve."""
        view = self._session.active_view
        if view.curve is None or not view.is_current:
            return None
        old = self._course
        if old is None or old.curve is not view.curve or old.pace is not self.settings.pace:
            self._course = Course(view.curve, self.settings.pace)
        return self._course

    def play(self) -> None:
        """Run the dot from its position; from the start where it has reached the end."""
        course = self.course
        if course is None or self.is_playing:
            return
        if not self.is_open:
            self._scrub_before = scrub = self._session.scrub.t
            self.seconds = course.elapsed_at(scrub) if scrub is not None else 0.0
        if self.settings.repeat is Repeat.ONCE and self.seconds >= course.duration:
            self.seconds = 0.0
        self._last = self.clock()
        self._timer.start()
        self._store.change(motion_visible=True, motion_plays=True)
        self._show()
        self.changed.emit()

    def toggle(self) -> None:
        """Play, or pause."""
        if self.is_playing:
            self.pause()
        else:
            self.play()

    def compare(self, families: frozenset[Family]) -> None:
        """Add families to the comparison, or remove them if all are in it."""
        compared = self.settings.compared
        if families <= compared:
            self.change(compared=compared - families)
        else:
            self.change(compared=compared | families)
            self.play()

    def pause(self) -> None:
        """Pause the dot at its position."""
        if self.is_playing:
            self._timer.stop()
            self._store.change(motion_plays=False)
            self.changed.emit()

    def stop(self) -> None:
        """End the motion; the scrub line returns to where the person left it."""
        if self.is_open:
            self._timer.stop()
            self._store.change(motion_visible=False, motion_plays=False)
            self._move_scrub(self._scrub_before)
            self.changed.emit()

    def change(self, **fields: object) -> None:
        """Change settings; the dot continues from its position."""
        before = self.settings
        self._store.change(motion=replace(before, **fields))
        if self.settings == before:
            return
        t = self._session.scrub.t
        restarts = (self.settings.repeat, self.settings.pace) != (before.repeat, before.pace)
        if self.is_open and restarts and t is not None:
            self._go_on_from(t)
        self.changed.emit()

    def change_speed(self, step: int) -> None:
        """Set the next speed, up (1) or down (-1)."""
        rank = SPEEDS.index(self.settings.speed) + step
        self.change(speed=SPEEDS[min(max(rank, 0), len(SPEEDS) - 1)])

    def tick(self) -> None:
        """Move the dot to its position at the present time."""
        now = self.clock()
        passed, self._last = now - self._last, now
        # Where the interval has changed, the dot goes on from its relative place.
        self._session.scrub.follow()
        if self.course is not None:
            self.seconds += passed * self.settings.speed
            self._show()

    def _tick_unless_just_done(self) -> None:
        """Skip a frame that a drag has just drawn."""
        if self.clock() - self._last >= _LEAST_PAUSE:
            self.tick()

    def _show(self) -> None:
        course, repeat = self.course, self.settings.repeat
        if course is None:
            return
        self._ran_on = course.curve
        elapsed = folded(np.array([self.seconds]), course.duration, repeat)
        self._move_scrub(float(course.parameters_at(elapsed)[0]))
        self.moved.emit()
        if repeat is Repeat.ONCE and self.seconds >= course.duration:
            self.seconds = course.duration
            self.pause()

    def _move_scrub(self, t: float | None) -> None:
        self._is_moving = True
        self._session.scrub.set(t)
        self._is_moving = False

    def _follow_scrub(self, t: float | None) -> None:
        """Follow a scrub line moved by others: hidden, it ends the motion; dragged, it pauses the dot."""
        if self._is_moving or not self.is_open or self.course is None:
            # Without a curve the line is hidden, but the person did not hide it.
            return
        if t is None:
            self._scrub_before = None
            self.stop()
            return
        if self.is_playing and self._session.active_view.curve is not self._ran_on:
            # The person did not: another curve, with another domain, moved the scrub line.
            self._go_on_from(t)
            return
        self.pause()
        self._scrub_before = t
        self._go_on_from(t)
        self.moved.emit()

    def _go_on_from(self, t: float) -> None:
        course = self.course
        if course is None:
            return
        elapsed = course.elapsed_at(t)
        # The trail reaches back over the seam after the first round.
        whole = round_duration(course.duration, self.settings.repeat)
        has_been_round = self.settings.repeat is not Repeat.ONCE and self.seconds >= whole
        self.seconds = elapsed + whole if has_been_round else elapsed
