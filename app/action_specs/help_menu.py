"""The menu Help: lessons, keys and mouse."""

from __future__ import annotations

from app.action_specs.spec import ActionSpec

HELP_MENU = (
    ActionSpec(
        "toggleLessons",
        "Lessons",
        "Help",
        "F4",
        "lessons",
        "Learn why a curve goes where it goes, in ten lessons",
        checkable=True,
    ),
    ActionSpec("showShortcuts", "Keys and Mouse", "Help", "F1", "help", "Show what keys and mouse do"),
    ActionSpec("about", "About Curvebench", "Help", "", "", "Version and licence"),
)
