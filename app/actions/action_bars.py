"""Strips: places for actions besides the menu bar, such as the toolbar, context menus and rows of buttons."""

from __future__ import annotations

import msgspec


class BarPosition(msgspec.Struct, frozen=True):
    """A place in a bar; entries stand in ascending order, with a separator between the tens."""

    bar: ActionBar
    number: int


class ActionBar(msgspec.Struct, frozen=True):
    """A bar of actions; ``STRIP(21)`` is a place in it.

    Attributes
    ----------
    name
        What it is.
    """

    name: str

    def __call__(self, number: int) -> BarPosition:
        """Return a place in it."""
        return BarPosition(self, number)


TOOLBAR = ActionBar("toolbar")
MORE_TOOLS_MENU = ActionBar("menu of further tools in the toolbar")
SNAP_MENU = ActionBar("menu of the magnet in the toolbar")
FAMILIES_MENU = ActionBar("menu of further families in the toolbar")
POINT_MENU = ActionBar("menu of a point")
CURVE_MENU = ActionBar("menu of a curve")
CHOSEN_MENU = ActionBar("menu of curves that are chosen as wholes")
CANVAS_MENU = ActionBar("menu of the canvas")
POINT_BUTTONS = ActionBar("buttons above the point table")
CURVE_LIST_MENU = ActionBar("menu of the list of curves")
CURVE_LIST_BUTTONS = ActionBar("buttons under the list of curves")
IMAGE_BUTTONS = ActionBar("buttons under the picture to trace")
TRANSFORM_BUTTONS = ActionBar("buttons of the Transform panel")
ALIGN_BUTTONS = ActionBar("buttons for aligning in the Transform panel")
RAIL_MENU = ActionBar("menu of the t-rail")
ZOOM_MENU = ActionBar("menu of the zoom in the status line")
