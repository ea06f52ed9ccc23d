"""The menu bar, made from the registry of actions, and the menus of files in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QMainWindow, QMenu

from app.action_specs import MENUS
from app.actions import Actions
from app.examples import example_name, example_paths
from app.keymap import call_alone
from app.labels import menu_text
from app.mnemonics import give_mnemonics, with_mnemonics
from app.preferences import Preferences


class Menus:
    """Builds the menus of a window.

    Attributes
    ----------
    parameters
        The menu in Curve that begins with the rules, which others fill in.
    recent, examples
        The menus in File that `fill_with_files` fills.
    """

    def __init__(self, window: QMainWindow, actions: Actions) -> None:
        self._actions = actions
        self._window = window
        for title, marked in zip(MENUS, with_mnemonics(MENUS), strict=True):
            menu = window.menuBar().addMenu(marked)
            submenus = self._fill(menu, title)
            if title == "Curve":
                self.parameters = submenus["Parameters"]
                # A tooltip tells why an entry cannot be used.
                submenus["Tangents"].setToolTipsVisible(True)

    def _fill(self, menu: QMenu, title: str) -> dict[str, QMenu]:
        submenus: dict[str, QMenu] = {}
        for spec, action in self._actions.of_menu(title):
            if spec.submenu and spec.submenu not in submenus:
                if spec.separated:
                    menu.addSeparator()
                submenus[spec.submenu] = menu.addMenu(spec.submenu)
                submenus[spec.submenu].setObjectName(f"{spec.submenu.lower().replace(' ', '_')}Menu")
            place = submenus.get(spec.submenu, menu)
            if spec.separated and not place.isEmpty():
                place.addSeparator()
            place.addAction(action)
            if spec.name == "openDocument":
                self.recent = menu.addMenu("Open Recent")
                self.examples = menu.addMenu("Examples")
            elif spec.name == "toggleSidePanel":
                self._panels = menu.addMenu("Panels")
                self._panels.setObjectName("panelsMenu")
        return submenus

    def fill_with_panels(self, docks: Sequence[QDockWidget]) -> None:
        """Offer every dock to be shown or put away."""
        for dock in docks:
            action = dock.toggleViewAction()
            action.setObjectName(f"{dock.objectName()}Shown")
            action.setStatusTip(f"Show or put away the panel {dock.windowTitle()}")
            call_alone(action, f"{dock.windowTitle()} Panel")
            self._panels.addAction(action)

    def fill_with_files(
        self,
        preferences: Preferences,
        open_file: Callable[[Path], object],
        open_example: Callable[[Path], object],
    ) -> None:
        """Offer the files that were open lately, and the examples."""
        self.recent.aboutToShow.connect(lambda: self._fill_recent(preferences, open_file))
        for path in example_paths():
            name = path.name.removesuffix(".curve.json")
            title = name.replace("_", " ").capitalize()
            _add_file(self.examples, path, title, f"example_{name}").triggered.connect(
                lambda _checked=False, path=path: open_example(path)
            )
        self.examples.aboutToShow.connect(self._name_examples)
        # Last of all who hear that a menu opens: then its entries are what they are called.
        for menu in self._window.menuBar().findChildren(QMenu):
            # One without a title is Qt's own, for what a narrow bar has no room for.
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
            self.recent.addAction("No files yet").setEnabled(False)

    def _name_examples(self) -> None:
        # Only now: nobody waits at the start for files to be read that are perhaps never opened.
        for action, path in zip(self.examples.actions(), example_paths(), strict=True):
            action.setText(menu_text(example_name(path)))


def _add_file(menu: QMenu, path: Path, title: str, name: str) -> QAction:
    action = menu.addAction(menu_text(title))
    action.setObjectName(name)
    action.setStatusTip(f"Open {path.name}")
    return action
