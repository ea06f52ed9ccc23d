"""The command ``lesson``."""

from __future__ import annotations

from .. import cli
from ..features.lessons.lesson import LessonError, find_lesson, lesson_names, load_lesson
from .refusals import RefusalError, say


def lesson(name: str | None) -> int:
    """Open the editor with a lesson, by its name or number; without one list them."""
    if name is None:
        for number, each in enumerate(lesson_names(), start=1):
            say(f"{number:2}  {each.partition('_')[2]:28}{load_lesson(each).title}")
        return 0
    try:
        return cli.start.edit((), find_lesson(name))
    except LessonError as problem:
        raise RefusalError(str(problem)) from None
