"""Strips: places for actions besides the menu bar, such as the toolbar, context menus and rows of buttons."""

from __future__ import annotations

import msgspec


class Place(msgspec.Struct, frozen=True):
    """A place in a strip; entries stand in ascending order, with a separator between the tens."""

    strip: Strip
    number: int


class Strip(msgspec.Struct, frozen=True):
    """A strip of actions; ``STRIP(21)`` is a place in it.

    Attributes
    ----------
    name
        What it is.
    """

    name: str

    def __call__(self, number: int) -> Place:
        """Return a place in it."""
        return Place(self, number)


TOOLBAR = Strip("toolbar")
MORE_TOOLS_MENU = Strip("menu of further tools in the toolbar")
SNAP_MENU = Strip("menu of the magnet in the toolbar")
FAMILIES_MENU = Strip("menu of further families in the toolbar")
POINT_MENU = Strip("menu of a point")
CURVE_MENU = Strip("menu of a curve")
CHOSEN_MENU = Strip("menu of curves that are chosen as wholes")
CANVAS_MENU = Strip("menu of the canvas")
POINT_BUTTONS = Strip("buttons above the point table")
CURVE_LIST_MENU = Strip("menu of the list of curves")
CURVE_LIST_BUTTONS = Strip("buttons under the list of curves")
IMAGE_BUTTONS = Strip("buttons under the picture to trace")
TRANSFORM_BUTTONS = Strip("buttons of the Transform panel")
ALIGN_BUTTONS = Strip("buttons for aligning in the Transform panel")
RAIL_MENU = Strip("menu of the t-rail")
ZOOM_MENU = Strip("menu of the zoom in the status line")
