"""Lessons: opens their documents, goes from step to step, and sees whether a goal is met."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec.structs import replace

from app.commands.parts import Handlers, Parts
from app.view_model.curve_view import CurveView

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

    from app.lessons import Lesson
    from app.panels.lesson_panel import LessonPanel

_GALLERY = -1
_DESK = ("plotErrors", "toggleLaboratory", "playMotion", "motionCompare", "toggleScrub")
"""What can be switched on and is no setting of the analysis."""

_ERRORS = {"epsilon": "point_error", "delta": "parameter_error"}


class LessonCommands:
    """The lessons of one window.

    Nothing of it is imported or read before the dock is first opened.
    """

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._panel: LessonPanel | None = None
        self._lesson: Lesson | None = None
        self._step = 0
        self._reached: set[int] = set()
        self._switched_on: list[str] = []
        self._is_opening = False
        parts.session.opened.connect(self._leave)
        parts.lessons_dock.visibilityChanged.connect(parts.actions["toggleLessons"].setChecked)

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {"toggleLessons": self._toggle}

    def render(self, view: CurveView) -> None:
        """Tick the goal when the curve meets it."""
        if self._panel is None or self._lesson is None or not self._panel.isVisible():
            return
        goal = self._lesson.steps[self._step].goal
        if goal is None:
            return
        from app.view_model.goals import standing_of  # noqa: PLC0415

        standing = standing_of(goal, view)
        if standing.is_met:
            self._reached.add(self._step)
        self._panel.show_standing(standing, reached=self._step in self._reached)

    def open(self, name: str) -> None:
        """Begin the lesson of this name."""
        self._parts.lessons_dock.show()
        self._begin([lesson.name for lesson in self._lessons].index(name))

    def build(self) -> QWidget:
        """Return the panel; called when the dock is first shown."""
        from app.panels.lesson_panel import LessonPanel  # noqa: PLC0415

        panel = self._panel = LessonPanel(self._lessons)
        panel.lesson_chosen.connect(self._begin)
        panel.step_chosen.connect(self._go)
        panel.action_wanted.connect(self._trigger)
        return panel

    @cached_property
    def _lessons(self) -> list[Lesson]:
        from app.lessons import lesson_names, load_lesson  # noqa: PLC0415

        return [load_lesson(name) for name in lesson_names()]

    def _toggle(self) -> None:
        self._parts.lessons_dock.setVisible(self._parts.actions["toggleLessons"].isChecked())

    def _begin(self, number: int) -> None:
        lesson, session = self._lessons[number], self._parts.session
        # What was tried out in a lesson is no work to lose; under a name of its own it is.
        is_own = self._lesson is None or session.path is not None
        self._is_opening = True
        opened = self._parts.files.open_example(lesson.document, asks=is_own)
        self._is_opening = False
        if not opened:
            return
        self._clear_the_desk()
        self._lesson, self._reached = lesson, set()
        self._go(0)

    def _clear_the_desk(self) -> None:
        """Put away what another lesson, or somebody before it, has switched on."""
        for name in _DESK:
            if self._parts.actions[name].isChecked():
                self._trigger(name)
        self._parts.analysis.reset()
        self._switched_on.clear()

    def _leave(self) -> None:
        """Go back to the gallery: the document is no lesson's any more."""
        if self._lesson is not None and not self._is_opening:
            self._go(_GALLERY)

    def _go(self, step: int) -> None:
        assert self._panel is not None
        steps = self._lesson.steps if self._lesson is not None else ()
        showing = steps[step].show if 0 <= step < len(steps) else ()
        self._put_away(but=showing)
        if step == _GALLERY or self._lesson is None:
            self._lesson = None
            self._panel.show_gallery()
            return
        if step == len(self._lesson.steps):
            self._begin(self._lessons.index(self._lesson) + 1)
            return
        self._step = step
        self._panel.show_step(self._lesson, step, is_last=self._lesson is self._lessons[-1])
        self._set_up()
        self.render(self._parts.session.active_view)

    def _put_away(self, but: Collection[str]) -> None:
        """Switch off what the step before has switched on, `but` what the next one shows as well."""
        for name in self._switched_on:
            if name not in but and self._parts.actions[name].isChecked():
                self._parts.actions[name].trigger()
        self._switched_on = [name for name in self._switched_on if name in but]

    def _set_up(self) -> None:
        assert self._lesson is not None
        step, session = self._lesson.steps[self._step], self._parts.session
        for index, curve in enumerate(session.document.curves):
            if curve.name == step.curve:
                session.activate(index)
        self._set_up_analysis(step.settings)
        for name in step.show:
            if not self._parts.actions[name].isChecked():
                self._trigger(name)
                self._switched_on.append(name)

    def _set_up_analysis(self, settings: Mapping[str, object]) -> None:
        from app.view_model.analysis.laboratory_settings import Calculation  # noqa: PLC0415

        analysis = self._parts.analysis
        errors = {_ERRORS[name]: value for name, value in settings.items() if name in _ERRORS}
        experiment = {name: value for name, value in settings.items() if name not in _ERRORS}
        if isinstance(count := experiment.get("methods"), int):
            experiment["methods"] = frozenset(list(Calculation)[:count])
        analysis.change(**errors, laboratory=replace(analysis.settings.laboratory, **experiment))

    def _trigger(self, name: str) -> None:
        if name in self._parts.actions:
            self._parts.actions[name].trigger()
