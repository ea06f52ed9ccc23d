"""The bar of a motion: play, stop, speed, repeat and pace, and where the dot is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from PySide6.QtCore import QTimer, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QSizePolicy, QToolButton, QWidget

from ...actions.keymap import action_name, plain
from ...appearance.icons import icon
from ...appearance.theme import FollowsTheme, Theme
from ...document.words import with_decimals
from ...view_model.motion import OWN, Dot, in_three_digits
from ...view_model.motion_settings import SPEEDS, MotionSettings, Pace, Repeat
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import ICON, action_button, choice_box, tool_button
from ...widgets.elided_label import ElidedLabel

_READ_MS = 80
"""Numbers that change faster cannot be read."""


class MotionBar(FollowsTheme, QWidget):
    """Lies under the canvas while there is a motion.

    Signals
    -------
    speed_chosen
        Another speed was chosen.
    """

    speed_chosen = Signal(float)

    def __init__(self, actions: Callable[[str], QAction], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("motionBar")
        self._actions = actions
        self._play, self._is_playing = self._play_button(), False
        tip = "Seconds of the motion in a second (J slower, L faster)"
        self._speed = _box("motionSpeed", "Speed", tip, [f"{speed:g}×" for speed in SPEEDS])
        self._speed.activated.connect(lambda index: self.speed_chosen.emit(SPEEDS[index]))
        self._repeat = self._action_box(
            "motionRepeat", "At the end", [action_name("motion", each) for each in Repeat]
        )
        self._pace = self._action_box(
            "motionPace", "What grows evenly", [action_name("motionBy", each) for each in Pace]
        )
        self._readout, self._words = ElidedLabel(), ElidedLabel()
        self._readout.setObjectName("motionReadout")
        self._readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self._words.setObjectName("motionWords")
        self._words.hide()
        self._lay_out()
        self._next = ""
        self._soon = QTimer(self, singleShot=True, interval=_READ_MS)
        self._soon.timeout.connect(self._write)
        self.follow_theme()

    def _play_button(self) -> QToolButton:
        """Return a button with an icon of its own: it tells what a press would do."""
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

    # What is shown

    @property
    def readout(self) -> str:
        """Place and speed of the dot."""
        return self._next

    @property
    def words(self) -> str:
        """Words about the jumps; empty while nothing is compared."""
        return "" if self._words.isHidden() else self._words.text()

    def set_theme(self, theme: Theme) -> None:
        """Take the colours of `theme`."""
        self._play.setIcon(icon("pause" if self._is_playing else "play", theme))

    def show_settings(self, settings: MotionSettings, *, playing: bool) -> None:
        """Show how the dot runs."""
        self._speed.setCurrentIndex(SPEEDS.index(settings.speed))
        self._repeat.setCurrentIndex(list(Repeat).index(settings.repeat))
        self._pace.setCurrentIndex(list(Pace).index(settings.pace))
        self._is_playing = playing
        self.set_theme(self.theme)
        self._play.setAccessibleName("Pause" if playing else "Play")

    def show_words(self, text: str) -> None:
        """Say something below the controls; nothing when empty."""
        self._words.setText(text)
        self._words.setVisible(bool(text))

    def show_dots(self, dots: Sequence[Dot], problem: str) -> None:
        """Show the numbers of the dot that stands for the curve, or why there is none."""
        own = next((dot for dot in dots if dot.role is OWN), None)
        self._next = _numbers(own) if own is not None else problem
        if not self._soon.isActive():
            self._soon.start()

    def _write(self) -> None:
        if self._readout.text() != self._next:
            self._readout.setText(self._next)


def _numbers(dot: Dot) -> str:
    t = with_decimals(dot.t, 3)
    return f"t {t}   |v| {in_three_digits(dot.speed)}   |a| {in_three_digits(dot.pull)}"


def _box(name: str, label: str, tip: str, items: Iterable[str]) -> QComboBox:
    box = choice_box(name, label, tip, items)
    # As short as that where there is no room; then the words end in dots.
    box.setMinimumContentsLength(4)
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    return box
