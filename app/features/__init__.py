"""Features: one package for each capability, with its commands and its panel. None imports another.

The docstring of each package says what it does and lists its modules.

To add a feature: a package here, and its name in `FEATURES`. Its module ``commands`` has a tuple
`COMMAND_SETS`. A command set is a class that takes a `WindowContext` (``app/workbench/context.py``); its
decorated methods are the actions (see ``app/actions``), and it takes part in the window by the methods that
`hooks` lists there. Features communicate only through the session, the state of the window and signals.

To add a panel to a feature: a widget with `render_view(value)` and signals for what the person did, and a
method of the command set that builds it in a given parent::

    @Panel("countDock", "Count", on_demand=True)  # app/workbench/docks.py
    def build_panel(self, parent: QWidget) -> QWidget:
        ...

A panel holds no session (a test reads all panels): its command set connects the signals to
`session.change`. A module that is imported when first used stands in the ``__init__.pyi`` of its package,
and is asked of the package: `from .. import overlays`, then `overlays.panel`.
``tests/gui/test_declared_actions.py`` has a command set and a panel.
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
)
"""The packages; tabs, and actions in a section of a menu, stand in this order."""


def command_sets() -> Iterator[type]:
    """Yield the command sets of all features."""
    for name in FEATURES:
        yield from import_module(f"{__name__}.{name}.commands").COMMAND_SETS
