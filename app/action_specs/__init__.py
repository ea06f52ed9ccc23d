"""The one registry of actions: menus, toolbar, palette, shortcuts and tooltips are made from it.

- ``spec``: what is known of an action.
- ``file_menu``, ``edit_menu``, ``curve_menu``, ``analysis_menu``, ``view_menu``, ``help_menu``: the actions.
"""

from __future__ import annotations

from app.action_specs.analysis_menu import ANALYSIS_MENU
from app.action_specs.curve_menu import CURVE_MENU
from app.action_specs.edit_menu import EDIT_MENU
from app.action_specs.file_menu import FILE_MENU
from app.action_specs.help_menu import HELP_MENU
from app.action_specs.spec import ActionSpec
from app.action_specs.view_menu import VIEW_MENU

__all__ = ["MENUS", "SPECS", "ActionSpec"]

MENUS = ("File", "Edit", "Curve", "Analysis", "View", "Help")

SPECS = (*FILE_MENU, *EDIT_MENU, *CURVE_MENU, *ANALYSIS_MENU, *VIEW_MENU, *HELP_MENU)
