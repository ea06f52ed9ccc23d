"""Commands of the lessons: open documents, go from step to step, check goals."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec.structs import replace

from ... import view_model
from ...actions.declaration import action
from ...actions.menus import ANALYSIS, HELP_ALL
from ...session import DocumentOrigin
from ...storage.files import load
from ...view_model.analysis.overlay import PARAMETER_ERROR, POINT_ERROR
from ...view_model.analysis.settings import Calculation
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import LEFT, Panel
from .. import lessons

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

    from ...document.model import Document
    from .lesson import Lesson, Step
    from .panel import LessonPanel

_GALLERY = -1
_ERRORS = {"epsilon": POINT_ERROR, "delta": PARAMETER_ERROR}


@dataclass
class _Visit:
    """Progress in a lesson: the step, and the steps whose goals were reached."""

    step: int = 0
    reached: set[int] = field(default_factory=set)


class LessonCommands:
    """The lessons of one window.

    No lesson is imported or read before the dock is first opened. The origin of the document identifies the
    lesson, so that Undo goes back to the lesson before, and to the step at which it was left.
    """

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._panel: LessonPanel | None = None
        self._lesson: Lesson | None = None
        self._given: Document | None = None
        self._visits: dict[DocumentOrigin, _Visit] = {}
        self._switched_on: list[str] = []
        self._dock = context.docks["lessonsDock"]
        self._dock.visibilityChanged.connect(lambda visible: context.store.change(lessons=visible))

    def render_panel(self, view: CurveView) -> None:
        """Tick the goal when the curve meets it."""
        if self._panel is None or self._lesson is None or not self._panel.isVisible():
            return
        visit = self._visit
        goal = self._lesson.steps[visit.step].goal
        if goal is None or self._given is None:
            return
        given = next(curve for curve in self._given.curves if curve.name == goal.curve)
        result = view_model.analysis.goals.result_of(goal, view, given)
        if result.is_met:
            visit.reached.add(visit.step)
        self._panel.show_result(result, reached=visit.step in visit.reached)

    @property
    def _visit(self) -> _Visit:
        return self._visits.setdefault(self._context.session.files.origin, _Visit())

    def open(self, name: str) -> None:
        """Start the lesson with this name."""
        self._dock.show()
        # In a window that is not visible yet the dock is not built, but the panel must follow the document.
        self._dock.fill()
        self._start([lesson.name for lesson in self._lessons].index(name))

    @Panel("lessonsDock", "Lessons", LEFT, on_demand=True)
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel; called when the dock is first shown."""
        panel = self._panel = lessons.panel.LessonPanel(self._lessons, parent)
        panel.lesson_wanted.connect(self._start)
        panel.restart_wanted.connect(self._start_again)
        panel.step_wanted.connect(self._go)
        panel.action_wanted.connect(self._trigger)
        # After the window itself, which fits the view to another document.
        self._context.session.opened.connect(self._follow_document)
        return panel

    @cached_property
    def _lessons(self) -> list[Lesson]:
        return [lessons.lesson.load_lesson(name) for name in lessons.lesson.lesson_names()]

    @action("toggleLessons", "Lessons", HELP_ALL, "F4", "lessons", checked=lambda state: state.window.lessons)
    def _toggle(self) -> None:
        """Learn step by step why a curve goes where it goes."""
        self._dock.setVisible(not self._context.store.state.lessons)

    def _start(self, number: int) -> None:
        """Open the document of a lesson; the work before stays in the history, or the person is asked."""
        lesson = self._lessons[number]
        self._context.files.open_example(lesson.document, f"Lesson {number + 1}: {lesson.title}")

    def _start_again(self) -> None:
        session = self._context.session
        if self._lesson is not None and (session.undo_stack.count() or session.files.path is not None):
            self._context.files.open_example(self._lesson.document, "Start Again")
        else:
            self._go(0)

    def _switch_all_off(self) -> None:
        """Switch off all analysis that another lesson or the person has switched on."""
        for switch, _action in self._context.actions.of_menu(ANALYSIS):
            if not switch.group and self._context.actions.is_on(switch.name):
                self._trigger(switch.name)
        self._context.session.scrub.set(None)
        self._context.analysis.reset()
        self._switched_on.clear()

    def _follow_document(self) -> None:
        """Show the lesson whose document is open, at the step where it was left; else the list of lessons."""
        copied = self._context.session.files.origin.copied
        lesson = next((lesson for lesson in self._lessons if lesson.document == copied), None)
        if lesson is None:
            if self._lesson is not None:
                self._go(_GALLERY)
            return
        self._switch_all_off()
        self._lesson, self._given = lesson, load(lesson.document)
        step = self._visit.step
        if self._context.session.document == self._given:
            self._activate(lesson.steps[step].curve)
        self._show(step)
        self._context.central.fit_panes(whole=True)

    def _go(self, step: int) -> None:
        """Go to a step of the open lesson; beyond its end, to the next lesson."""
        if self._lesson is None:
            return
        if step == len(self._lesson.steps):
            self._start(self._lessons.index(self._lesson) + 1)
            return
        if step == _GALLERY:
            self._switch_off(keep=())
            self._lesson = None
            assert self._panel is not None
            self._panel.show_gallery()
            return
        self._show(step)
        self._activate(self._lesson.steps[step].curve)
        self._context.central.fit_panes(whole=True)

    def _show(self, step: int) -> None:
        assert self._panel is not None
        assert self._lesson is not None
        self._switch_off(keep=self._lesson.steps[step].show)
        self._visit.step = step
        self._panel.show_step(self._lesson, step, is_last=self._lesson is self._lessons[-1])
        self._set_up(self._lesson.steps[step])
        self.render_panel(self._context.session.active_view)

    def _switch_off(self, keep: Collection[str]) -> None:
        """Switch off the actions of the step before, except those to keep."""
        for name in self._switched_on:
            if name not in keep and self._context.actions.is_on(name):
                self._context.actions[name].trigger()
        self._switched_on = [name for name in self._switched_on if name in keep]

    def _activate(self, name: str) -> None:
        session = self._context.session
        for index, curve in enumerate(session.document.curves):
            if curve.name == name:
                session.selected.activate(index)

    def _set_up(self, step: Step) -> None:
        self._set_up_analysis(step.settings)
        for name in step.show:
            if not self._context.actions.is_on(name):
                self._trigger(name)
                self._switched_on.append(name)

    def _set_up_analysis(self, settings: Mapping[str, object]) -> None:
        analysis = self._context.analysis
        for name, setting in _ERRORS.items():
            if isinstance(error := settings.get(name), float):
                analysis.set_value(setting, error)
        experiment = {name: value for name, value in settings.items() if name not in _ERRORS}
        if isinstance(count := experiment.get("methods"), int):
            experiment["methods"] = frozenset(list(Calculation)[:count])
        analysis.change(laboratory=replace(analysis.settings.laboratory, **experiment))

    def _trigger(self, name: str) -> None:
        if name in self._context.actions:
            self._context.actions[name].trigger()


COMMAND_SETS = (LessonCommands,)
