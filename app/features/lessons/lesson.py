"""The lessons that come with the program: Markdown in steps, each with a document beside it.

A lesson is ``NAME.md`` and ``NAME.curve.json`` in ``resources/lessons``. Its first heading is the title,
the paragraph below it the summary; every second-level heading begins a step. A comment in a step says what
goes with it, separated by semicolons::

    <!-- curve: Careless; show: overlayBand; set: epsilon 0.02; goal: lebesgue < 5; keep: points, family -->

``curve`` names the curve to edit, ``show`` the actions to switch on, ``set`` what the analysis does (see
`SETTINGS`), ``goal`` what that curve shall meet, ``keep`` what may not change on the way (see `goals.KEPT`).
In the text, a link to ``action:NAME`` triggers that action.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from ...storage.resources import resource
from ...view_model.analysis.goals import Goal, GoalError, parse_goal
from ...view_model.analysis.laboratory_settings import RoundedPart

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
"""Settings of a step: rounding, digits, shift and number of methods of the laboratory; errors of the band."""


class LessonError(ValueError):
    """A lesson that cannot be read; the text says where and why."""


class Step(NamedTuple):
    """One page of a lesson.

    Attributes
    ----------
    text
        Markdown.
    curve
        Name of the curve to edit; empty for the one that is edited.
    show
        Names of actions to switch on.
    settings
        What to set, by names out of `SETTINGS`.
    """

    title: str
    text: str
    curve: str
    show: tuple[str, ...]
    settings: dict[str, float | RoundedPart]
    goal: Goal | None


class Lesson(NamedTuple):
    """A lesson, read."""

    name: str
    title: str
    summary: str
    steps: tuple[Step, ...]
    document: Path


def lesson_names() -> list[str]:
    """Return the names of all lessons, in the order to take them."""
    return [path.stem for path in sorted(resource("lessons").glob("*.md"))]


def find_lesson(word: str) -> str:
    """Return the name of the lesson that `word` names, with its number or without; raise `LessonError`."""
    names = lesson_names()
    for name in names:
        if word in (name, name.partition("_")[2], name.partition("_")[0].lstrip("0")):
            return name
    known = ", ".join(name.partition("_")[2] for name in names)
    raise LessonError(f"There is no lesson “{word}”; there are {known}.")


def load_lesson(name: str) -> Lesson:
    """Read a lesson that comes with the program."""
    path = resource("lessons", f"{name}.md")
    return parse_lesson(path.read_text(encoding="utf-8"), name, path.with_name(f"{name}.curve.json"))


def parse_lesson(text: str, name: str, document: Path) -> Lesson:
    """Return the lesson that `text` writes; raise `LessonError` where something in it is wrong."""
    head, *pages = re.split(r"^## ", text, flags=re.MULTILINE)
    title, _, summary = head.strip().partition("\n")
    if not title.startswith("# ") or not pages:
        raise LessonError(f"{name}: a lesson begins with “# Title” and has steps “## Title”")
    steps = tuple(_step(page, f"{name}, step {number}") for number, page in enumerate(pages, start=1))
    return Lesson(name, title[2:].strip(), " ".join(summary.split()), steps, document)


def _step(page: str, place: str) -> Step:
    title, _, body = page.partition("\n")
    found = _COMMENT.search(body)
    fields = _fields(found.group(1), place) if found is not None else {}
    goal = _goal(fields, place) if "goal" in fields else None
    show = tuple(word for word in re.split(r"[,\s]+", fields.get("show", "")) if word)
    text, curve = _COMMENT.sub("", body).strip(), fields.get("curve", "")
    settings = _settings(fields.get("set", ""), place)
    return Step(title.strip(), text, curve, show, settings, goal)


def _goal(fields: dict[str, str], place: str) -> Goal:
    try:
        goal = parse_goal(fields["goal"], fields.get("curve", ""), fields.get("keep", ""))
    except GoalError as problem:
        raise LessonError(f"{place}: {problem}") from None
    if not goal.curve or not goal.kept:
        raise LessonError(f"{place}: a goal needs “curve”, and “keep” for what may not change")
    return goal


def _settings(text: str, place: str) -> dict[str, float | RoundedPart]:
    settings: dict[str, float | RoundedPart] = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, value = part.partition(" ")
        if name not in SETTINGS:
            raise LessonError(f"{place}: “{name}” is not one of {', '.join(SETTINGS)}")
        try:
            settings[name] = SETTINGS[name](value)
        except ValueError:
            raise LessonError(f"{place}: “{part}” is no name with a value of its kind") from None
    return settings


def _fields(comment: str, place: str) -> dict[str, str]:
    fields = {}
    for part in filter(None, (part.strip() for part in comment.split(";"))):
        key, _, value = part.partition(":")
        if key.strip() not in _KEYS or not value.strip():
            raise LessonError(f"{place}: “{part}” is not one of {', '.join(_KEYS)} with a value")
        fields[key.strip()] = value.strip()
    return fields
