"""Preferences: settings that are saved between starts, outside any document."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QSettings

from .. import exchange
from ..appearance.theme import ThemeMode
from ..tools.snapping import SnapKind
from ..tools.tool import TOOLS, ToolRecord
from ..view_model.settings import Count, OwnedSetting, SettingValues, SwitchSetting, ToolSetting
from .file import SettingsFile
from .kinds import (
    Choice,
    Distance,
    Folder,
    Keys,
    SavedCurve,
    SavedLayout,
    SavedStyle,
    SavedText,
    Setting,
    Several,
    Switch,
    Text,
    WholeNumber,
)

_MAX_RECENT: Final = 10
_RECENT: Final = "files/recent"


NO_UNIT: Final = "none"
USUAL_UNITS: Final = (NO_UNIT, "mm", "cm", "m", "in", "px", "s")


def _note_of_unit(name: str) -> str:
    # The module of units is loaded when first used.
    return exchange.units.note_of_unknown(name)


def stored_tool_settings() -> dict[OwnedSetting[Any], Setting[Any]]:
    """Return the settings of all tools, with how each is stored."""
    return {setting: _stored(tool, setting) for tool in TOOLS for setting in tool.settings}


def _stored(tool: ToolRecord, setting: ToolSetting) -> Setting[Any]:
    key = setting.stored_as or f"tools/{tool.name}/{setting.name}"
    label, tip, widget = setting.label, setting.tip or setting.label, setting.name
    if isinstance(setting, SwitchSetting):
        return Switch(key, default=setting.default, label=label, tip=tip, widget=widget)
    if isinstance(setting, Count):
        return WholeNumber(key, setting.default, setting.limits, label, tip, widget)
    return Choice(key, setting.default, label, tip, widget)


class Preferences:
    """
    The person's settings, typed, over an ini file in the user's configuration folder.

    A value that cannot be read counts as not set; nothing here raises because of what is in the
    file, for a broken preference must never keep the editor from opening.

    Parameters
    ----------
    store : pathlib.Path or QSettings, optional
        Place of the settings, for tests and portable use; by default that of the user.

    Attributes
    ----------
    file : SettingsFile
        The file of the settings.
    """

    theme_mode = Choice(
        "theme", ThemeMode.SYSTEM, "Theme", "Light or dark colours of the window and the canvas", "themeBox"
    )
    """Light theme, dark theme, or the theme of the system."""

    unit_name = Text(
        "grid/unit",
        "Unit of new documents",
        "Unit of length in new documents; type any name. File › Document… sets the unit of this document",
        longest=12,
        usual=USUAL_UNITS,
        note=_note_of_unit,
        widget="unitBox",
    )
    """Unit of new documents, such as "mm"; empty for none."""

    grid_spacing = Distance(
        "grid/spacing",
        "Grid of new documents",
        "Grid spacing of new documents: “adaptive”, or a distance in the plane (Enter to set)",
        none="adaptive",
        refusal="Enter a grid spacing greater than 0, or “adaptive”.",
        widget="gridSpacing",
    )
    """Grid spacing of new documents; 0 for a grid that adapts to the zoom."""

    snap_kinds = Several("snap/kinds", SnapKind, "Snap to", "Snap dragged points to: {}", "snap_{}")
    """Targets of snapping."""

    window_geometry = SavedLayout("window/geometry")
    """The result of ``QWidget.saveGeometry``."""

    window_state = SavedLayout("window/state")
    """The result of ``QMainWindow.saveState``."""

    splitter_state = SavedLayout("window/splitter")
    """The result of ``QSplitter.saveState``."""

    basis = Switch("window/basis", default=True)
    """Whether the basis functions are shown."""

    numbered = Switch("window/numbered", default=True)
    """Whether points have numbers and colours."""

    plot_height = WholeNumber("window/plots", 0, (0, 99_999))
    """Height of the plots below the basis functions, in pixels; 0 when not set."""

    snap_on = Switch("snap/on", default=False)
    """Whether dragged and added points snap."""

    transform_box = Switch("view/transform_box", default=True)
    """Whether two or more selected points have a box with grips."""

    rulers = Switch("view/rulers", default=True)
    """Whether the axes of the canvas are rulers."""

    recent_colours = SavedText("style/recent_colours")
    """Recent colours, the latest first, "#rrggbb" separated by spaces."""

    new_style = SavedStyle("document/new_style")
    """Style of the first curve of a new document."""

    new_curve = SavedCurve("document/new_curve")
    """Family and rules of the first curve of a new document: the last ones in use."""

    keep_proportions = Switch("transform/keep_proportions", default=False)
    """Whether width and height are scaled together when one of them is typed."""

    handle_columns = Switch("table/handles", default=False)
    """Whether the point table shows lengths and angles of handles."""

    with_estimates = Switch("basis/with_estimates", default=False)
    """Whether the basis functions include the estimated derivatives."""

    shortcuts = Keys("shortcuts")
    """Keys that differ from the defaults, by the name of the action."""

    export_choice = SavedText("export/choice")
    """Options of the last export, as JSON; unusable ones count as not set."""

    last_folder = Folder("files/folder")
    """Folder of file dialogs: the last one in use, or the home folder."""

    def __init__(self, store: Path | QSettings | None = None) -> None:
        self.file = SettingsFile(store)

    @property
    def tool_settings(self) -> SettingValues:
        """The settings of the tools, each kept under its key."""
        kinds = stored_tool_settings()
        return SettingValues(frozenset((setting, kind.read(self.file)) for setting, kind in kinds.items()))

    @tool_settings.setter
    def tool_settings(self, values: SettingValues) -> None:
        for setting, kind in stored_tool_settings().items():
            kind.write(self.file, values.value(setting))

    @property
    def complaint(self) -> str:
        """Sentence about an unusable stored value; empty where there is none."""
        return self.file.complaint

    @property
    def recent_files(self) -> list[Path]:
        """At most ten recent files that exist, the latest first."""
        # Also False for a missing drive or a name with a NUL.
        return [path for path in self._recent() if os.path.isfile(path)]  # noqa: PTH113

    def add_recent_file(self, path: Path) -> None:
        """Add a file at the head of the recent files."""
        path = path.absolute()
        others = [other for other in self._recent() if other != path]
        self._set_recent([path, *others])

    def clear_recent_files(self) -> None:
        """Clear the recent files."""
        self._set_recent([])

    def _recent(self) -> list[Path]:
        stored = self.file.value(_RECENT)
        if stored is None or stored == "":
            return []
        # The ini format stores a list of one string as that string.
        names = [stored] if isinstance(stored, str) else stored
        if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
            self.file.complain(_RECENT, "it is not a list of file names")
            return []
        return [Path(name) for name in names][:_MAX_RECENT]

    def _set_recent(self, paths: list[Path]) -> None:
        self.file.write(_RECENT, [str(path) for path in paths[:_MAX_RECENT]])
