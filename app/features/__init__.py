"""Features: one package for each capability, with its commands and its panel. None imports another.

- ``files``: new, open, save.  ``import_export``: other formats.  ``clipboard``: copy, cut and paste.
- ``view``: tools, zoom, panels, theme.  ``snapping``: snapping, grid and unit.
- ``rules``: family and parameters.
- ``points``, ``curves``, ``tangents``, ``transform``: what is done to points and curves.
- ``basis``: the functions over t.  ``plots``: other plots over t.  ``teaching``: warnings that teach.
- ``point_table``: the points as numbers.  ``curve_list``: the curves.  ``curve_settings``: the active one in
  numbers and rules.  ``history``: undo, as a list.  ``reference_image``: the picture to trace.
- ``overlays``: what is drawn over the curve, and its ghosts.  ``hodograph``: its velocity, as a curve.
- ``joints``: how smooth it is.  ``wiggle``: who pulls it where it swings out.  ``laboratory``: few digits.
- ``motion``: a dot that runs along it.  ``lessons``: why it goes where it goes.  ``help``: keys and mouse.
- ``recovery``: backups of unsaved work, and what a crash left behind.
- ``file_on_disk``: the document's file while it is open: changed, gone, or open elsewhere.

To add one is a folder and a name in `FEATURES`. Its module ``commands`` has a tuple `COMMAND_SETS`.
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
    "tangents",
    "rules",
    "points",
    "transform",
    "clipboard",
    "basis",
    "plots",
    "teaching",
    "point_table",
    "curve_list",
    "history",
    "curve_settings",
    "joints",
    "overlays",
    "laboratory",
    "wiggle",
    "hodograph",
    "motion",
    "lessons",
    "help",
    "reference_image",
    "recovery",
    "file_on_disk",
)
"""The packages; tabs, and actions in a section of a menu, stand in this order."""


def command_sets() -> Iterator[type]:
    """Yield the command sets of all features."""
    for name in FEATURES:
        yield from import_module(f"{__name__}.{name}.commands").COMMAND_SETS
