"""Parts of a motion in the window: a player, a bar, and the dots on the canvas."""

from __future__ import annotations

from PySide6.QtCore import QObject

from curvecore.arrays import FloatArray

from ...families import Family
from ...view_model.curve.curve_view import CurveView
from ...view_model.motion import (
    OWN,
    Course,
    Role,
    Scales,
    dots_at,
    jumps_in_words,
    rivals_of,
    scales_of,
)
from ...workbench.context import WindowContext
from .bar import MotionBar
from .export import MotionExport
from .player import Player


class MotionStage(QObject):
    """Shows what the player plays."""

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
        self._bar.speed_chosen.connect(lambda speed: self.player.change(speed=speed))
        self.player.moved.connect(self.draw)
        self.player.changed.connect(self._render)

    # What is shown

    def settle(self, view: CurveView) -> None:
        """Measure anew what is kept as it is during a drag: the scale of the arrows, and the jumps."""
        if not self.player.is_open or self._context.session.is_previewing:
            return
        self._scales = None
        self.draw()
        self._bar.show_words(jumps_in_words(self._rivals))

    def follow(self) -> None:
        """Draw the dots on a curve that is being changed; if they run, where they are by now."""
        if self.player.is_playing and self.player.course is not None:
            self.player.tick()
        else:
            self.draw()

    def draw(self) -> None:
        """Draw the dots where they are now."""
        player, context = self.player, self._context
        course = player.course if player.is_open else None
        if course is None:
            context.central.canvas.drawing.render_motion(())
            if player.is_open:
                self._bar.show_dots((), context.session.active_view.problem)
            return
        courses = {OWN: course, **self._courses_to_compare()}
        if self._scales is None:
            self._scales = scales_of(list(courses.values()))
        dots = dots_at(courses, player.seconds, player.settings.repeat, self._scales)
        context.central.canvas.drawing.render_motion(dots, self._lines())
        self._bar.show_dots(dots, "")

    def _courses_to_compare(self) -> dict[Role, Course]:
        settings, view = self.player.settings, self._context.session.active_view
        asked = (view, settings.compared)
        if self._rivals_of != asked:
            self._rivals, self._rivals_of = rivals_of(view, settings.compared), asked
        # By identity: curves compare by all their numbers.
        known = {id(each.curve): each for each in self._courses.values() if each.pace is settings.pace}
        self._courses = {}
        for role, rival in self._rivals.items():
            assert rival.curve is not None
            self._courses[role] = known.get(id(rival.curve)) or Course(rival.curve, settings.pace)
        return self._courses

    def _lines(self) -> list[tuple[Role, FloatArray]]:
        """Return the curves that are compared, but for the one that is drawn anyway."""
        family = self._context.session.active_view.source.family
        return [(role, view.polyline) for role, view in self._rivals.items() if family not in role.families]

    def _render(self) -> None:
        player = self.player
        self._bar.show_settings(player.settings, playing=player.is_playing)
        self._bar.setVisible(player.is_open)
        self.settle(self._context.session.active_view)
        if not player.is_open:
            self._context.central.canvas.drawing.render_motion(())
