"""The command ``lesson``."""

from __future__ import annotations

from .. import cli
from ..features.lessons.lesson import LessonError, find_lesson, lesson_names, load_lesson
from .output import RefusalError, print_text


def lesson(name: str | None) -> int:
    """Open the editor with a lesson, by its name or number; without one list all lessons."""
    if name is None:
        for number, lesson_name in enumerate(lesson_names(), start=1):
            print_text(f"{number:2}  {lesson_name.partition('_')[2]:28}{load_lesson(lesson_name).title}")
        return 0
    try:
        return cli.start.edit((), find_lesson(name))
    except LessonError as problem:
        raise RefusalError(str(problem)) from None
