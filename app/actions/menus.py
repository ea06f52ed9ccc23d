"""Menus, the sections in them, and bars: toolbar, context menus, rows of buttons.

An action names its section; `also` places it in bars besides. Menus and sections stand in the order in which
they are made; within a section, actions stand in the order of their definition: of the command sets, then of
the methods.
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import count

import msgspec

from ..view_model.analysis.overlay import Group
from .needs import NOTHING, SELECTED_CURVE, Need


class BarPosition(msgspec.Struct, frozen=True):
    """Position in a bar; entries are sorted by number, with a separator between the tens."""

    bar: ActionBar
    number: int


class ActionBar(msgspec.Struct, frozen=True):
    """Bar of actions; ``TOOLBAR(21)`` is a position in it.

    Attributes
    ----------
    name
        The name of the bar, for developers and screen readers.
    """

    name: str

    def __call__(self, number: int) -> BarPosition:
        """Return a position in the bar."""
        return BarPosition(self, number)


TOOLBAR = ActionBar("toolbar")
MORE_TOOLS_MENU = ActionBar("menu of further tools in the toolbar")
SNAP_MENU = ActionBar("menu of the magnet in the toolbar")
FAMILIES_MENU = ActionBar("menu of further families in the toolbar")
POINT_MENU = ActionBar("menu of a point")
CURVE_MENU = ActionBar("menu of a curve")
WHOLES_MENU = ActionBar("menu of curves that are selected as wholes")
CANVAS_MENU = ActionBar("menu of the canvas")
POINT_BUTTONS = ActionBar("buttons above the point table")
CURVE_LIST_MENU = ActionBar("menu of the list of curves")
CURVE_LIST_BUTTONS = ActionBar("buttons under the list of curves")
IMAGE_BUTTONS = ActionBar("buttons under the picture to trace")
TRANSFORM_BUTTONS = ActionBar("buttons of the Transform panel")
ALIGN_BUTTONS = ActionBar("buttons for aligning in the Transform panel")
RAIL_MENU = ActionBar("menu of the t-rail")
ZOOM_MENU = ActionBar("menu of the zoom in the status line")


MENUS: list[Menu] = []
"""The menus of the menu bar, in order."""

_ranks = count()


class MenuSection(msgspec.Struct, frozen=True):
    """Group of entries in a menu, or in a submenu of it.

    Attributes
    ----------
    menu, submenu
        The menu, and the title of the submenu; empty for entries in the menu itself.
    is_separated
        Whether a separator precedes the section; for the first section of a submenu, the submenu.
    rank
        Position in the order of all sections.
    needs
        Condition of all actions of the section, besides their own.
    also
        Positions in context menus, where the section is a submenu.
    called
        Title of that submenu; adjacent sections of one title share the submenu.
    """

    menu: Menu
    submenu: str
    is_separated: bool
    rank: int
    needs: Need
    also: tuple[BarPosition, ...] = ()
    called: str = ""


class Menu:
    """A menu of the menu bar.

    Attributes
    ----------
    title
        Its text, without mnemonic.
    interrupts
        Whether its actions cancel a gesture in flight before they run, because they may change the document.
    needs
        Condition of the actions of all sections that have no other one.
    sections
        The sections of the menu, in order.
    """

    def __init__(self, title: str, *, interrupts: bool = False, needs: Need = NOTHING) -> None:
        self.title, self.interrupts, self.needs = title, interrupts, needs
        self.sections: list[MenuSection] = []
        MENUS.append(self)

    def section(
        self,
        submenu: str = "",
        *,
        is_separated: bool = True,
        needs: Need | None = None,
        also: Collection[BarPosition] = (),
        called: str = "",
    ) -> MenuSection:
        """Add a section at the end of the menu; `called` is its title in context menus."""
        needs = self.needs if needs is None else needs
        title = called or submenu
        section = MenuSection(self, submenu, is_separated, next(_ranks), needs, tuple(also), title)
        self.sections.append(section)
        return section


FILE = Menu("File", interrupts=True)
FILE_OPEN = FILE.section()
FILE_RECENT = FILE.section("Open Recent", is_separated=False)
FILE_EXAMPLES = FILE.section("Examples", is_separated=False)
FILE_RECOVERY = FILE.section(is_separated=False)
FILE_SAVE = FILE.section()
FILE_DISK = FILE.section("Disk", is_separated=False)
FILE_EXCHANGE = FILE.section()
FILE_DOCUMENT = FILE.section(is_separated=False)
FILE_IMAGE = FILE.section("Reference Image", is_separated=False)
FILE_FAMILY = FILE.section("Family File", is_separated=False)
FILE_FAMILY_MORE = FILE.section("Family File", is_separated=False)
FILE_QUIT = FILE.section()

EDIT = Menu("Edit", interrupts=True)
EDIT_HISTORY = EDIT.section()
EDIT_BACK = EDIT.section(is_separated=False)
EDIT_WORK = EDIT.section(is_separated=False)
EDIT_CLIPBOARD = EDIT.section()
EDIT_COPY_AS = EDIT.section("Copy and Paste Special", is_separated=False)
EDIT_DERIVATIVES = EDIT.section("Copy and Paste Special")
EDIT_STYLE = EDIT.section("Copy and Paste Special")
EDIT_DELETE = EDIT.section(is_separated=False)
EDIT_SELECT = EDIT.section()
EDIT_TOOLS = EDIT.section("Tools")
EDIT_TOOL_SETTINGS = EDIT.section("Tools")
EDIT_PROGRAM = EDIT.section()

CURVE = Menu("Curve", interrupts=True, needs=SELECTED_CURVE)
CURVE_FAMILY = CURVE.section()
CURVE_FAMILIES = CURVE.section("More Families", is_separated=False)
CURVE_RULES = CURVE.section("Parameters", is_separated=False)
CURVE_PARAMETERS = CURVE.section("Parameters")
CURVE_STARTS = CURVE.section("Parameters")
CURVE_ESTIMATES = CURVE.section("Estimates", is_separated=False)
CURVE_RESETS = CURVE.section("Estimates")
CURVE_CONVERT = CURVE.section("Convert", is_separated=False)
CURVE_NEW = CURVE.section(needs=NOTHING)
CURVE_NUMBER = CURVE.section(is_separated=False)
CURVE_SHAPE = CURVE.section()
CURVE_FEWER = CURVE.section(is_separated=False)
CURVE_PROPERTIES = CURVE.section("Properties", is_separated=False)
CURVE_ALL_FREE = CURVE.section("Properties", is_separated=False, needs=NOTHING)
CURVE_COLOUR = CURVE.section("Properties")
CURVE_STYLE = CURVE.section("Properties", is_separated=False, needs=NOTHING)
CURVE_SETTINGS = CURVE.section("Properties")
CURVE_NAME = CURVE.section("Properties", is_separated=False)

POINTS = Menu("Points", interrupts=True, needs=SELECTED_CURVE)
POINTS_EDITING = POINTS.section(needs=NOTHING)
POINTS_KINDS = POINTS.section()
POINTS_VELOCITIES = POINTS.section()
POINTS_INSERT = POINTS.section("Insert Points")
POINTS_SPECIAL = POINTS.section("Insert Points", also=[CURVE_MENU(15)])
POINTS_NUMBER = POINTS.section(is_separated=False)
POINTS_TYPED = POINTS.section()

ARRANGE = Menu("Arrange", interrupts=True)
ARRANGE_TRANSFORM = ARRANGE.section("Transform", is_separated=False)
ARRANGE_PANEL = ARRANGE.section(is_separated=False)
ARRANGE_BOX = ARRANGE.section("Box", is_separated=False)
ARRANGE_ALIGN_ACROSS = ARRANGE.section("Align and Distribute")
ARRANGE_ALIGN_UP = ARRANGE.section("Align and Distribute")
ARRANGE_DISTRIBUTE = ARRANGE.section("Align and Distribute")
ARRANGE_ALIGN_TO = ARRANGE.section("Align and Distribute")
ARRANGE_ORDER = ARRANGE.section(
    "Order",
    is_separated=False,
    needs=SELECTED_CURVE,
    also=[WHOLES_MENU(21), CURVE_MENU(45), CURVE_LIST_MENU(20)],
)
ARRANGE_GROUPS = ARRANGE.section(needs=SELECTED_CURVE)
ARRANGE_SHAPES = ARRANGE.section(
    needs=SELECTED_CURVE, also=[WHOLES_MENU(35), CURVE_LIST_MENU(56)], called="Shape"
)
ARRANGE_SPLIT = ARRANGE.section(is_separated=False, needs=SELECTED_CURVE)
ARRANGE_WALK = ARRANGE.section()

ANALYSIS = Menu("Analysis")
OVERLAY_SECTIONS = [ANALYSIS.section("Overlays", is_separated=group > 0) for group in Group]
GHOSTS_FAMILY = ANALYSIS.section("Ghosts", is_separated=False)
GHOSTS_RULE = ANALYSIS.section("Ghosts")
PLOTS_OVER_T = ANALYSIS.section("Plots", is_separated=False)
PLOTS_IN_PLANE = ANALYSIS.section("Plots")
ANALYSIS_JOINTS = ANALYSIS.section()
ANALYSIS_EXPLAIN = ANALYSIS.section()
MOTION_RUN = ANALYSIS.section("Motion", is_separated=False)
MOTION_REPEAT = ANALYSIS.section("Motion")
MOTION_PACE = ANALYSIS.section("Motion")
MOTION_MORE = ANALYSIS.section("Motion")
MOTION_COMPARE = ANALYSIS.section("Compare in Motion", is_separated=False)

VIEW = Menu("View")
VIEW_ZOOM = VIEW.section()
VIEW_ZOOM_STEPS = VIEW.section("Zoom", is_separated=False)
VIEW_DRAWING = VIEW.section()
VIEW_SNAP = VIEW.section("Snapping", is_separated=False)
VIEW_SNAP_TO = VIEW.section("Snapping")
VIEW_GUIDES = VIEW.section("Guides", is_separated=False)
VIEW_ELEMENTS = VIEW.section()
VIEW_PANELS = VIEW.section("Panels", is_separated=False)
VIEW_FOCUS = VIEW.section("Keyboard Focus", is_separated=False)
VIEW_PRESENTATION = VIEW.section()
VIEW_SIZE = VIEW.section("Drawing Size", is_separated=False)
VIEW_THEME = VIEW.section("Theme", is_separated=False)

HELP = Menu("Help")
HELP_ALL = HELP.section()
HELP_ABOUT = HELP.section()
