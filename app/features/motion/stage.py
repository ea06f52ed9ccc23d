"""Parts of a motion in the window: the bar with its controls, and the dots on the canvas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QSizePolicy, QToolButton, QWidget

from curvecore.arrays import FloatArray

from ...actions.keymap import action_name, plain
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...families import Family
from ...view_model.curve.curve_view import CurveView
from ...view_model.motion import (
    ACTIVE,
    Course,
    Dot,
    Role,
    Scales,
    dots_at,
    jump_sentences,
    rivals_of,
    scales_of,
    three_digits,
)
from ...view_model.motion_settings import SPEEDS, MotionSettings, Pace, Repeat
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import ICON, action_button, choice_box, tool_button
from ...widgets.elided_label import ElidedLabel
from ...workbench.context import WindowContext
from .export import MotionExport
from .player import Player


class MotionBar(FollowsTheme, QWidget):
    """Lies under the canvas while there is a motion.

    Signals
    -------
    speed_changed
        Another speed was selected.
    """

    speed_changed = Signal(float)

    def __init__(self, actions: Callable[[str], QAction], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("motionBar")
        self._actions = actions
        self._play, self._is_playing = self._play_button(), False
        tip = "Seconds of the motion per second (J slower, L faster)"
        self._speed = _box("motionSpeed", "Speed", tip, [f"{speed:g}×" for speed in SPEEDS])
        self._speed.activated.connect(lambda index: self.speed_changed.emit(SPEEDS[index]))
        self._repeat = self._action_box(
            "motionRepeat", "At the end of the curve", [action_name("motion", value) for value in Repeat]
        )
        self._pace = self._action_box(
            "motionPace", "Quantity that grows uniformly", [action_name("motionBy", value) for value in Pace]
        )
        self._readout, self._words = ElidedLabel("motionReadout"), ElidedLabel("motionWords")
        self._readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._words.hide()
        self._lay_out()
        self.follow_theme()

    def _play_button(self) -> QToolButton:
        """Return the button whose icon shows the effect of a press: play or pause."""
        action = self._actions("playMotion")
        button = tool_button("playPauseButton", "", action.toolTip(), icon_size=ICON, flat=True)
        button.clicked.connect(action.trigger)
        return button

    def _button(self, action: str, name: str = "") -> QToolButton:
        return action_button(self._actions(action), name=name, flat=True)

    def _action_box(self, name: str, label: str, actions: Sequence[str]) -> QComboBox:
        box = _box(name, label, label, [plain(self._actions(action).text()) for action in actions])
        box.activated.connect(lambda index: self._actions(actions[index]).trigger())
        return box

    def _lay_out(self) -> None:
        boxes = (self._speed, self._repeat, self._pace)
        compare, export = self._button("motionCompare", "compareMotion"), self._button("exportMotion")
        controls = row_of(
            self._play, self._button("stopMotion"), *boxes, compare, (self._readout, 1), export,
            margins=(10, 3, 8, 3), spacing=6,
        )  # fmt: skip
        column_of(controls, row_of(self._words, margins=(12, 0, 10, 5)), margins=0, spacing=0, parent=self)

    # Content

    def set_theme(self, theme: Theme) -> None:
        """Apply the colours of `theme`."""
        self._play.setIcon(icon("pause" if self._is_playing else "play", theme))

    def show_settings(self, settings: MotionSettings, *, playing: bool) -> None:
        """Show the settings of the motion."""
        self._speed.setCurrentIndex(SPEEDS.index(settings.speed))
        self._repeat.setCurrentIndex(list(Repeat).index(settings.repeat))
        self._pace.setCurrentIndex(list(Pace).index(settings.pace))
        self._is_playing = playing
        self.set_theme(self.theme)
        self._play.setAccessibleName("Pause" if playing else "Play")

    def show_words(self, text: str) -> None:
        """Show sentences below the controls; hide them when empty."""
        self._words.show_text(text)

    def show_dots(self, dots: Sequence[Dot], t: float | None, view: CurveView) -> None:
        """Show the numbers of the dot of the active curve at `t`, or why there is none.

        In the frame that shows the dot: the rail and the status line show the same t in it.
        """
        active = next((dot for dot in dots if dot.role is ACTIVE), None)
        text = view.problem if active is None else _numbers(active, view.t_text(active.t if t is None else t))
        if self._readout.text() != text:
            self._readout.setText(text)


def _numbers(dot: Dot, t: str) -> str:
    return f"t {t}   |v| {three_digits(dot.speed)}   |a| {three_digits(dot.acceleration)}"


def _box(name: str, label: str, tip: str, items: Iterable[str]) -> QComboBox:
    box = choice_box(name, label, tip, items)
    # The least width where there is no room; then the text ends in dots.
    box.setMinimumContentsLength(4)
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    return box


class MotionStage(QObject):
    """The motion in the window: the bar, and the dots on the canvas."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context = context
        self.player = Player(context.session, context.store, self)
        self._bar = MotionBar(context.actions.__getitem__, context.window)
        self._bar.hide()
        context.central.under_canvas.addWidget(self._bar)
        self.export = MotionExport(context)
        self._rivals: dict[Role, CurveView] = {}
        self._rivals_of: tuple[CurveView, frozenset[Family]] | None = None
        self._courses: dict[Role, Course] = {}
        self._scales: Scales | None = None
        self._bar.speed_changed.connect(lambda speed: self.player.change(speed=speed))
        self.player.moved.connect(self.draw)
        self.player.changed.connect(self._render)

    # Content

    def settle(self, view: CurveView) -> None:
        """Update the scale of the arrows and the jumps, which are fixed during a drag."""
        if not self.player.is_open or self._context.session.is_previewing:
            return
        self._scales = None
        self.draw()
        self._bar.show_words(jump_sentences(self._rivals))

    def follow(self) -> None:
        """Draw the dots on a curve that is being changed; running dots at the present time."""
        if self.player.is_playing and self.player.course is not None:
            self.player.tick()
        else:
            self.draw()

    def draw(self) -> None:
        """Draw the dots at their present positions."""
        player, context = self.player, self._context
        course = player.course if player.is_open else None
        if course is None:
            context.central.canvas.drawing.render_motion(())
            if player.is_open:
                self._bar.show_dots((), None, context.session.active_view)
            return
        courses = {ACTIVE: course, **self._courses_to_compare()}
        if self._scales is None:
            self._scales = scales_of(list(courses.values()))
        dots = dots_at(courses, player.seconds, player.settings.repeat, self._scales)
        context.central.canvas.drawing.render_motion(dots, self._lines())
        self._bar.show_dots(dots, context.session.scrub.t, context.session.active_view)

    def _courses_to_compare(self) -> dict[Role, Course]:
        settings, view = self.player.settings, self._context.session.active_view
        asked = (view, settings.compared)
        if self._rivals_of != asked:
            self._rivals, self._rivals_of = rivals_of(view, settings.compared), asked
        # By identity: curves compare by all their numbers.
        known = {id(old.curve): old for old in self._courses.values() if old.pace is settings.pace}
        self._courses = {}
        for role, rival in self._rivals.items():
            assert rival.curve is not None
            self._courses[role] = known.get(id(rival.curve)) or Course(rival.curve, settings.pace)
        return self._courses

    def _lines(self) -> list[tuple[Role, FloatArray]]:
        """Return the compared curves, without the active one."""
        family = self._context.session.active_view.source.family
        return [(role, view.polyline) for role, view in self._rivals.items() if family not in role.families]

    def _render(self) -> None:
        player = self.player
        self._bar.show_settings(player.settings, playing=player.is_playing)
        self._bar.setVisible(player.is_open)
        self.settle(self._context.session.active_view)
        if not player.is_open:
            self._context.central.canvas.drawing.render_motion(())
