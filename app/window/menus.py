"""Menu bar, the menus of files in it, and context menus of the canvas."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import pairwise
from pathlib import Path

from msgspec.structs import replace
from PySide6.QtCore import QPoint
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QMainWindow, QMenu, QWidget

from ..actions.declaration import position_actions
from ..actions.keymap import give_mnemonics, set_full_name, with_mnemonics
from ..actions.menus import (
    CANVAS_MENU,
    CURVE_CONVERT,
    CURVE_MENU,
    FILE_EXAMPLES,
    FILE_RECENT,
    MENUS,
    POINT_MENU,
    POINTS_KINDS,
    VIEW_PANELS,
    WHOLES_MENU,
    Menu,
    MenuSection,
)
from ..actions.qactions import Actions
from ..document.group_edits import pressed_curves
from ..qt.labels import menu_text
from ..settings.preferences import Preferences
from ..storage.examples import example_name, example_paths
from ..tools.pointer import Hit, Part
from ..workbench.context import WindowContext, bar_menu


class Menus:
    """Builds the menus of a window.

    Attributes
    ----------
    recent, examples
        The menus in File that `fill_with_files` fills.
    """

    def __init__(self, window: QMainWindow, actions: Actions) -> None:
        self._actions = actions
        self._window = window
        self._submenus: dict[tuple[Menu, str], QMenu] = {}
        self._menu_of_section: dict[MenuSection, QMenu] = {}
        titles = with_mnemonics([menu.title for menu in MENUS])
        for menu, marked in zip(MENUS, titles, strict=True):
            self._fill(window.menuBar().addMenu(marked), menu)
        self.recent, self.examples = self._submenu(FILE_RECENT), self._submenu(FILE_EXAMPLES)
        # Tooltips tell why an entry is disabled.
        for section in (POINTS_KINDS, CURVE_CONVERT):
            self._menu_of_section[section].setToolTipsVisible(True)
        self._submenu(CURVE_CONVERT).aboutToShow.connect(lambda: actions.open_section(CURVE_CONVERT))
        actions.redeclared.connect(self._follow_actions)

    def _submenu(self, section: MenuSection) -> QMenu:
        return self._submenus[section.menu, section.submenu]

    def _fill(self, bar_menu: QMenu, menu: Menu) -> None:
        for section in menu.sections:
            target, actions = self._menu_for(section, bar_menu), self._actions.in_section(section)
            self._menu_of_section[section] = target
            if actions and section.is_separated and not target.isEmpty():
                target.addSeparator()
            target.addActions(actions)

    def _follow_actions(self) -> None:
        """Insert the new actions; removed ones have left their menus already."""
        for section, menu in self._menu_of_section.items():
            put_in(menu, self._actions.in_section(section))

    def _menu_for(self, section: MenuSection, menu: QMenu) -> QMenu:
        """Return the menu of a section; a submenu is created with its first section."""
        title, key = section.submenu, (section.menu, section.submenu)
        if title and key not in self._submenus:
            if section.is_separated:
                menu.addSeparator()
            submenu = self._submenus[key] = menu.addMenu(title)
            submenu.setObjectName(f"{title.lower().replace(' ', '_')}Menu")
        return self._submenus[key] if title else menu

    def fill_with_panels(self, docks: Sequence[QDockWidget]) -> None:
        """Add an entry for each dock, to show or hide it."""
        for dock in docks:
            action = dock.toggleViewAction()
            action.setObjectName(f"{dock.objectName()}Shown")
            _name_panel(action, dock.windowTitle())
            dock.windowTitleChanged.connect(partial(_name_panel, action))
            self._submenu(VIEW_PANELS).addAction(action)

    def fill_with_files(
        self,
        preferences: Preferences,
        open_file: Callable[[Path], object],
        open_example: Callable[[Path], object],
    ) -> None:
        """Fill the menus of recent files and of examples."""
        self.recent.aboutToShow.connect(lambda: self._fill_recent(preferences, open_file))
        for path in example_paths():
            name = path.name.removesuffix(".curve.json")
            title = name.replace("_", " ").capitalize()
            _add_file(self.examples, path, title, f"example_{name}").triggered.connect(
                lambda _checked=False, path=path: open_example(path)
            )
        self.examples.aboutToShow.connect(self._name_examples)
        # Connected last to aboutToShow: by then the entries have their final texts.
        for menu in self._window.menuBar().findChildren(QMenu):
            # A menu without a title belongs to Qt, for entries that do not fit into a narrow bar.
            if menu.title():
                give_mnemonics(menu)

    def _fill_recent(self, preferences: Preferences, open_file: Callable[[Path], object]) -> None:
        self.recent.clear()
        for path in preferences.recent_files:
            _add_file(self.recent, path, path.name, str(path)).triggered.connect(
                lambda _checked=False, path=path: open_file(path)
            )
        self.recent.setEnabled(True)
        if self.recent.isEmpty():
            self.recent.addAction("No recent files").setEnabled(False)
        else:
            self.recent.addSeparator()
            self.recent.addActions(self._actions.in_section(FILE_RECENT))

    def _name_examples(self) -> None:
        # Only now, because reading the files would delay the start.
        for action, path in zip(self.examples.actions(), example_paths(), strict=True):
            action.setText(menu_text(example_name(path)))


def put_in(widget: QWidget, actions: Sequence[QAction]) -> None:
    """Put those of some actions that a menu or a toolbar does not have behind the ones before them."""
    for before, action in pairwise(actions):
        present = widget.actions()
        if action not in present:
            at = present.index(before) + 1
            widget.insertAction(present[at] if at < len(present) else None, action)  # type: ignore[arg-type]


def _add_file(menu: QMenu, path: Path, title: str, name: str) -> QAction:
    action = menu.addAction(menu_text(title))
    action.setObjectName(name)
    action.setStatusTip(f"Open {path.name}")
    return action


def _name_panel(action: QAction, title: str) -> None:
    action.setStatusTip(f"Show or hide the {title} panel")
    set_full_name(action, f"{title} Panel")


class ContextMenus:
    """Context menus of a point, of a curve, of selected curves and of the canvas."""

    def __init__(
        self,
        context: WindowContext,
        command_sets: Mapping[type, object],
        attempt: Callable[[Callable[[], object]], None],
    ) -> None:
        self._context, self._attempt = context, attempt
        self._at_position = [
            pair for kind, commands in command_sets.items() for pair in position_actions(kind, commands)
        ]
        context.central.canvas.menu_requested.connect(self._open_on_canvas)

    def _open_on_canvas(self, hit: Hit | None, position: QPoint) -> None:
        session = self._context.session
        if hit is not None and hit.curve >= 0:
            hit = self._on_active_curve(hit)
        if hit is not None and hit.part is Part.OTHER_CURVE:
            # A right-click on a selected curve keeps the selection: the menu acts on all of it.
            selected = session.selected.marked
            if session.selected.is_editing or hit.index in selected:
                session.selected.set_curves(selected if hit.index in selected else (hit.index,), hit.index)
            else:
                session.selected.select_whole(
                    pressed_curves(session.document, hit.index, session.selected.state)
                )
            self._open_on_active(position)
        elif hit is not None and hit.part is Part.CURVE:
            self._curve_menu(hit.t).popup(position)
        elif hit is not None and hit.part is not Part.GUIDE:
            if hit.index not in session.selection:
                session.selected.set_points([hit.index])
            bar_menu(self._context, POINT_MENU, is_short=True).popup(position)
        else:
            bar_menu(self._context, CANVAS_MENU).popup(position)

    def _on_active_curve(self, hit: Hit) -> Hit:
        """Activate the curve of a point or handle; a curve that is selected as a whole stays so."""
        selected = self._context.session.selected
        if hit.curve in selected.whole_curves and hit.index not in selected.group.of(hit.curve):
            return replace(hit, part=Part.OTHER_CURVE, index=hit.curve)
        selected.switch_active(hit.curve)
        return hit.on_active_curve

    def _open_on_active(self, position: QPoint) -> None:
        """Open the menu at a position on the curve that the right button has activated."""
        hit = self._context.central.canvas.hit_at(position)
        is_alone = len(self._context.session.selected.curves) == 1
        if hit is not None and hit.part is not Part.OTHER_CURVE and (is_alone or hit.part is Part.CURVE):
            self._open_on_canvas(hit, position)
        else:
            self._open_on_curves(position)

    def _open_on_curves(self, position: QPoint) -> None:
        """Open the menu of the selected curves, or of the edited curve."""
        is_whole = bool(self._context.session.selected.whole_curves)
        bar_menu(self._context, WHOLES_MENU if is_whole else CURVE_MENU, is_short=is_whole).popup(position)

    def _curve_menu(self, t: float) -> QMenu:
        """Return the menu for a position on the active curve."""
        menu = bar_menu(self._context, CURVE_MENU)
        top = menu.actions()[0]
        for entry, act in self._at_position:
            known = self._context.actions[entry.like]
            here = menu.addAction(known.icon(), entry.text)
            here.setObjectName(entry.name)
            here.setStatusTip(known.statusTip())
            here.setToolTip(known.toolTip())
            here.setEnabled(known.isEnabled())
            here.triggered.connect(lambda _checked=False, act=act: self._attempt(lambda: act(t)))
            menu.insertAction(top, here)
        menu.insertSeparator(top)
        return menu
