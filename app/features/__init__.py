"""Features: one package for each capability, with its commands and its panel. None imports another.

Each package says what it is. To add one is a folder and a name in `FEATURES`. Its module ``commands`` has a
tuple `COMMAND_SETS`.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module

FEATURES = (
    "files",
    "view",
    "snapping",
    "import_export",
    "curves",
    "points",
    "rules",
    "own_families",
    "transform",
    "clipboard",
    "basis",
    "plots",
    "teaching",
    "point_table",
    "curve_list",
    "style",
    "history",
    "curve_settings",
    "joints",
    "overlays",
    "laboratory",
    "wiggle",
    "hodograph",
    "fitting",
    "motion",
    "lessons",
    "help",
    "reference_image",
    "document_settings",
    "recovery",
    "file_on_disk",
)
"""The packages; tabs, and actions in a section of a menu, stand in this order."""


def command_sets() -> Iterator[type]:
    """Yield the command sets of all features."""
    for name in FEATURES:
        yield from import_module(f"{__name__}.{name}.commands").COMMAND_SETS
