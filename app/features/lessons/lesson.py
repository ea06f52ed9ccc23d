"""Lessons: the text of a folder, read into steps; see the package for the form of a lesson."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from ...storage.resources import resource
from ...view_model.analysis.goals import Conditions, Goal, GoalError, Measures, parse_goal
from ...view_model.analysis.settings import RoundedPart

_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)
_KEYS = ("curve", "show", "set", "goal", "keep")

SETTINGS: dict[str, Callable[[str], float | RoundedPart]] = {
    "rounding": RoundedPart,
    "digits": int,
    "shift": float,
    "methods": int,
    "epsilon": float,
    "delta": float,
}
"""Settings of a step: those of the laboratory, and the errors of the band."""


class LessonError(ValueError):
    """Lesson that cannot be read; the message says where and why."""


class Step(NamedTuple):
    """One page of a lesson.

    Attributes
    ----------
    text
        Markdown.
    curve
        Name of the curve to edit; empty for the active one.
    show
        Names of the actions to switch on.
    settings
        Settings of the analysis, by names of `SETTINGS`.
    """

    title: str
    text: str
    curve: str
    show: tuple[str, ...]
    settings: dict[str, float | RoundedPart]
    goal: Goal | None


class Lesson(NamedTuple):
    """Text of a lesson in steps, and the path of its document.

    `load_lesson` reads it from a folder by name; a step may have a goal, which is measured on the curve, and
    facts that must stay.
    """

    name: str
    title: str
    summary: str
    steps: tuple[Step, ...]
    document: Path


def lesson_names() -> list[str]:
    """Return the names of all lessons that come with the program, in their order."""
    return sorted(path.parent.name for path in resource("lessons").glob("*/lesson.md"))


def find_lesson(word: str) -> str:
    """Return the name of the lesson with this name or number; raise `LessonError` where there is none."""
    names = lesson_names()
    for name in names:
        number, _, title = name.partition("_")
        if word in (name, title, number.lstrip("0")):
            return name
    known = ", ".join(name.partition("_")[2] for name in names)
    raise LessonError(f"There is no lesson “{word}”; the lessons are {known}.")


def load_lesson(name: str) -> Lesson:
    """Return a lesson that comes with the program."""
    return read_lesson(resource("lessons", name))


def read_lesson(folder: Path) -> Lesson:
    """Return the lesson of a folder; raise `LessonError` where its text is wrong."""
    text = (folder / "lesson.md").read_text(encoding="utf-8")
    code = lesson_code(folder)
    measures: Measures = getattr(code, "MEASURES", {})
    conditions: Conditions = getattr(code, "KEPT", {})
    return parse_lesson(text, folder.name, folder / "document.curve.json", measures, conditions)


def lesson_code(folder: Path) -> ModuleType | None:
    """Return the module ``lesson.py`` of a lesson that comes with the program; None where it has none.

    A lesson from anywhere else is text and a document: its Python is never run.
    """
    path = folder / "lesson.py"
    if not path.exists() or folder.resolve().parent != resource("lessons").resolve():
        return None
    module = ModuleType(folder.name)
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), module.__dict__)
    return module


def parse_lesson(
    text: str,
    name: str,
    document: Path,
    measures: Measures | None = None,
    conditions: Conditions | None = None,
) -> Lesson:
    """Return the lesson that `text` states; raise `LessonError` where a part of it is wrong."""
    head, *pages = re.split(r"^## ", text, flags=re.MULTILINE)
    title, _, summary = head.strip().partition("\n")
    if not title.startswith("# ") or not pages:
        raise LessonError(f"{name}: a lesson begins with “# Title” and has steps “## Title”")
    steps = tuple(
        _step(page, f"{name}, step {number}", measures, conditions)
        for number, page in enumerate(pages, start=1)
    )
    return Lesson(name, title[2:].strip(), " ".join(summary.split()), steps, document)


def _step(page: str, label: str, measures: Measures | None, conditions: Conditions | None) -> Step:
    title, _, body = page.partition("\n")
    comment = _COMMENT.search(body)
    fields = _fields(comment.group(1), label) if comment is not None else {}
    curve, goal = fields.get("curve", ""), None
    if "goal" in fields:
        try:
            goal = parse_goal(
                fields["goal"], curve, fields.get("keep", ""), measures=measures, conditions=conditions
            )
        except GoalError as problem:
            raise LessonError(f"{label}: {problem}") from None
        if not curve or not goal.conditions:
            raise LessonError(f"{label}: a goal needs “curve”, and “keep” with the fixed properties")
    show = tuple(word for word in re.split(r"[,\s]+", fields.get("show", "")) if word)
    text = _COMMENT.sub("", body).strip()
    return Step(title.strip(), text, curve, show, _settings(fields.get("set", ""), label), goal)


def _settings(text: str, label: str) -> dict[str, float | RoundedPart]:
    settings: dict[str, float | RoundedPart] = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, value = part.partition(" ")
        if name not in SETTINGS:
            raise LessonError(f"{label}: “{name}” is not one of {', '.join(SETTINGS)}")
        try:
            settings[name] = SETTINGS[name](value)
        except ValueError:
            raise LessonError(f"{label}: “{value}” is not a value of “{name}”") from None
    return settings


def _fields(comment: str, label: str) -> dict[str, str]:
    fields = {}
    for part in filter(None, (part.strip() for part in comment.split(";"))):
        key, _, value = part.partition(":")
        if key.strip() not in _KEYS or not value.strip():
            raise LessonError(f"{label}: “{part}” is not one of {', '.join(_KEYS)} with a value")
        fields[key.strip()] = value.strip()
    return fields
