"""What the editor remembers from one start to the next, outside any document."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, QSettings

from app.gestures.snapping import SnapKind
from app.theme import ThemeMode

_NAME: Final = "curvebench"
_MAX_RECENT: Final = 10
_SWITCHES: Final = ("off", "on")
_LEAST_SPACING, _GREATEST_SPACING = 1e-9, 1e9

_SETTING = re.compile(r"\[.*\]$|[^=]+=")

LONGEST_UNIT: Final = 12
"""Letters that the name of a unit may have."""


class Preferences:
    """
    The person's settings, typed, over an ini file in the user's configuration folder.

    A value that cannot be read counts as not set; nothing here raises because of what is in the
    file, for a broken preference must never keep the editor from opening.

    Parameters
    ----------
    store : pathlib.Path or QSettings, optional
        Where to keep them, for tests and portable use; the user's own place by default.

    Attributes
    ----------
    complaint : str
        What was wrong with the stored values, in one sentence; empty when nothing was.
    """

    def __init__(self, store: Path | QSettings | None = None) -> None:
        self.complaint = ""
        self._settings = _open(store)
        if not isinstance(store, QSettings) and _set_aside_damaged(Path(self._settings.fileName())):
            self.complaint = f"{self._settings.fileName()} was damaged and set aside; the defaults are used."
            # What the first one has read of it is forgotten.
            self._settings.sync()
            self._settings = _open(store)
        if self._settings.status() is not QSettings.Status.NoError:
            self.complaint = f"{self._settings.fileName()} cannot be read; the defaults are used."

    @property
    def theme_mode(self) -> ThemeMode:
        """Light, dark, or as the system has it."""
        stored = self._text("theme")
        try:
            return ThemeMode(stored or ThemeMode.SYSTEM.value)
        except ValueError:
            self._complain("theme", f"“{stored}” is none of system, light and dark")
            return ThemeMode.SYSTEM

    @theme_mode.setter
    def theme_mode(self, mode: ThemeMode) -> None:
        self._settings.setValue("theme", mode.value)

    @property
    def window_geometry(self) -> QByteArray:
        """What ``QWidget.saveGeometry`` gave; empty when nothing is remembered."""
        return self._bytes("window/geometry")

    @window_geometry.setter
    def window_geometry(self, value: QByteArray) -> None:
        self._settings.setValue("window/geometry", value)

    @property
    def window_state(self) -> QByteArray:
        """What ``QMainWindow.saveState`` gave; empty when nothing is remembered."""
        return self._bytes("window/state")

    @window_state.setter
    def window_state(self, value: QByteArray) -> None:
        self._settings.setValue("window/state", value)

    @property
    def splitter_state(self) -> QByteArray:
        """What ``QSplitter.saveState`` gave; empty when nothing is remembered."""
        return self._bytes("window/splitter")

    @splitter_state.setter
    def splitter_state(self, value: QByteArray) -> None:
        self._settings.setValue("window/splitter", value)

    @property
    def plot_height(self) -> int:
        """How high the plots below the basis functions are, in pixels; 0 when nothing is remembered."""
        stored = self._text("window/plots")
        if not stored or (stored.isdecimal() and len(stored) < 6):
            return int(stored or 0)
        self._complain("window/plots", f"“{stored}” is no height")
        return 0

    @plot_height.setter
    def plot_height(self, height: int) -> None:
        self._settings.setValue("window/plots", str(height))

    @property
    def snap_on(self) -> bool:
        """Whether dragged and added points snap."""
        return self._switch("snap/on", default=False)

    @snap_on.setter
    def snap_on(self, value: bool) -> None:
        self._settings.setValue("snap/on", _SWITCHES[value])

    @property
    def snap_kinds(self) -> frozenset[SnapKind]:
        """What they snap to."""
        stored = self._value("snap/kinds")
        if stored is None:
            return frozenset(SnapKind)
        try:
            return frozenset(SnapKind(word) for word in str(stored).split())
        except ValueError:
            self._complain("snap/kinds", f"“{stored}” names something else than {', '.join(SnapKind)}")
            return frozenset(SnapKind)

    @snap_kinds.setter
    def snap_kinds(self, kinds: Collection[SnapKind]) -> None:
        self._settings.setValue("snap/kinds", " ".join(kind.value for kind in SnapKind if kind in kinds))

    @property
    def grid_spacing(self) -> float:
        """Distance of the grid's lines in units of the plane; 0 where it adapts to the zoom."""
        stored = self._text("grid/spacing")
        try:
            spacing = float(stored or 0)
        except ValueError:
            spacing = math.nan
        if spacing == 0 or _LEAST_SPACING <= spacing <= _GREATEST_SPACING:
            return spacing
        self._complain("grid/spacing", f"“{stored}” is no distance")
        return 0.0

    @grid_spacing.setter
    def grid_spacing(self, spacing: float) -> None:
        self._settings.setValue("grid/spacing", repr(float(spacing)))

    @property
    def unit_name(self) -> str:
        """The name of the unit of the plane, such as "mm"; empty for none."""
        return self._text("grid/unit")[:LONGEST_UNIT]

    @unit_name.setter
    def unit_name(self, name: str) -> None:
        self._settings.setValue("grid/unit", name)

    @property
    def transform_box(self) -> bool:
        """Whether two or more selected points get a box with grips."""
        return self._switch("view/transform_box", default=True)

    @transform_box.setter
    def transform_box(self, value: bool) -> None:
        self._settings.setValue("view/transform_box", _SWITCHES[value])

    @property
    def shortcuts(self) -> dict[str, str]:
        """The keys that differ from the defaults, by the action's name."""
        stored = self._text("shortcuts")
        try:
            found = json.loads(stored or "{}")
        except ValueError:
            found = None
        if isinstance(found, dict) and all(isinstance(keys, str) for keys in found.values()):
            return found
        self._complain("shortcuts", "they are not a list of keys")
        return {}

    @shortcuts.setter
    def shortcuts(self, keys: Mapping[str, str]) -> None:
        self._settings.setValue("shortcuts", json.dumps(dict(keys), sort_keys=True))

    @property
    def export_choice(self) -> str:
        """The options of the last export, as JSON; what cannot be used counts as none."""
        return self._text("export/choice")

    @export_choice.setter
    def export_choice(self, text: str) -> None:
        self._settings.setValue("export/choice", text)

    @property
    def recent_files(self) -> list[Path]:
        """At most ten files, the latest first; those that are no longer there are left out."""
        return [path for path in self._recent() if _is_file(path)]

    def add_recent_file(self, path: Path) -> None:
        """Put a file at the head of the recent ones."""
        path = path.absolute()
        others = [other for other in self._recent() if other != path]
        self._set_recent([path, *others])

    def clear_recent_files(self) -> None:
        """Forget the recent files."""
        self._set_recent([])

    @property
    def last_folder(self) -> Path:
        """Where a file dialog starts: the folder last used, or the home folder."""
        stored = self._text("files/folder")
        folder = Path(stored) if stored else Path.home()
        return folder if _is_folder(folder) else Path.home()

    @last_folder.setter
    def last_folder(self, folder: Path) -> None:
        self._settings.setValue("files/folder", str(folder.absolute()))

    def _recent(self) -> list[Path]:
        stored = self._value("files/recent")
        if stored is None or stored == "":
            return []
        # The ini format stores a list of one string as that string.
        names = [stored] if isinstance(stored, str) else stored
        if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
            self._complain("files/recent", "it is not a list of file names")
            return []
        return [Path(name) for name in names][:_MAX_RECENT]

    def _set_recent(self, paths: list[Path]) -> None:
        self._settings.setValue("files/recent", [str(path) for path in paths[:_MAX_RECENT]])

    def _switch(self, key: str, *, default: bool) -> bool:
        stored = self._text(key)
        if stored and stored not in _SWITCHES:
            self._complain(key, f"“{stored}” is neither on nor off")
        return stored == "on" if stored in _SWITCHES else default

    def refuse(self, key: str, reason: str) -> None:
        """Say that the value of `key` could be read but not used."""
        self._complain(key, reason)

    def _value(self, key: str) -> object:
        """Return what is stored, None where there is nothing, or nothing that Python knows."""
        try:
            return self._settings.value(key)
        except Exception:
            # PySide raises a RuntimeError for the types of QVariant that have no counterpart.
            self._complain(key, "it is of a foreign type")
            return None

    def _text(self, key: str) -> str:
        stored = self._value(key)
        if stored is None or isinstance(stored, str):
            return stored or ""
        self._complain(key, "it is not a text")
        return ""

    def _bytes(self, key: str) -> QByteArray:
        stored = self._value(key)
        if stored is None or isinstance(stored, QByteArray):
            return stored or QByteArray()
        self._complain(key, "it is not a saved layout")
        return QByteArray()

    def _complain(self, key: str, reason: str) -> None:
        self.complaint = f"The remembered {key} is not usable ({reason}); the default is used."


def _open(store: Path | QSettings | None) -> QSettings:
    if isinstance(store, QSettings):
        return store
    if store is not None:
        return QSettings(str(store), QSettings.Format.IniFormat)
    return QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, _NAME, _NAME)


def _set_aside_damaged(path: Path) -> bool:
    """Rename the file of settings at `path` where it is none; return whether it was.

    QSettings takes any bytes for settings, and writes what it made of them back for good.
    """
    try:
        if not path.is_file() or not _is_damaged(path.read_bytes()):
            return False
        path.replace(path.with_name(path.name + ".damaged"))
    except OSError:
        return False
    return True


def _is_damaged(data: bytes) -> bool:
    """Whether this can be no ini file: no text, an open section, or nothing that is a section or setting."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return True
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and not line.startswith((";", "#"))]
    is_open = any(line.startswith("[") and "]" not in line for line in lines)
    return "\0" in text or is_open or bool(lines and not any(map(_SETTING.match, lines)))


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a drive that is gone, a name with a NUL in it
        return False


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False
