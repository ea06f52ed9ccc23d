"""Ini file of the settings: read with care, and set aside where it is damaged."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, QSettings

_NAME: Final = "curvebench"

_SETTING = re.compile(r"\[.*\]$|[^=]+=")


class SettingsFile:
    """
    The ini file of the settings, by key; a value that cannot be read counts as not stored.

    Parameters
    ----------
    store : pathlib.Path or QSettings, optional
        Path of the file; in the user's configuration folder by default.

    Attributes
    ----------
    complaint : str
        What was wrong with the stored values, in one sentence; empty when nothing was.
    """

    def __init__(self, store: Path | QSettings | None = None) -> None:
        self.complaint = ""
        self._settings = _open(store)
        if not isinstance(store, QSettings) and _set_aside_damaged(Path(self._settings.fileName())):
            self.complaint = (
                f"{self._settings.fileName()} was damaged and has been set aside. Default settings are used."
            )
            # A new QSettings object: the first one has cached the damaged file.
            self._settings.sync()
            self._settings = _open(store)
        if self._settings.status() is not QSettings.Status.NoError:
            self.complaint = f"{self._settings.fileName()} cannot be read. Default settings are used."

    def value(self, key: str) -> object:
        """Return the stored value; None without one, or for a type that Python does not know."""
        try:
            return self._settings.value(key)
        except Exception:
            # PySide raises a RuntimeError for the types of QVariant that have no counterpart.
            self.complain(key, "its type is unknown")
            return None

    def text(self, key: str) -> str:
        """Return the stored text; empty where there is none."""
        stored = self.value(key)
        if stored is None or isinstance(stored, str):
            return stored or ""
        self.complain(key, "it is not text")
        return ""

    def layout(self, key: str) -> QByteArray:
        """Return a layout saved by Qt; empty where there is none."""
        stored = self.value(key)
        if stored is None or isinstance(stored, QByteArray):
            return stored or QByteArray()
        self.complain(key, "it is not a saved layout")
        return QByteArray()

    def write(self, key: str, value: object) -> None:
        """Store a value."""
        self._settings.setValue(key, value)

    def complain(self, key: str, reason: str) -> None:
        """Record that the value of `key` cannot be used."""
        self.complaint = f"The saved setting {key} cannot be used ({reason}). The default is used."


def _open(store: Path | QSettings | None) -> QSettings:
    if isinstance(store, QSettings):
        return store
    if store is not None:
        return QSettings(str(store), QSettings.Format.IniFormat)
    return QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, _NAME, _NAME)


def _set_aside_damaged(path: Path) -> bool:
    """Rename a damaged file of settings at `path`; return whether it was renamed.

    QSettings reads any bytes as settings, and would overwrite the file with the result.
    """
    try:
        if not path.is_file() or not _is_damaged(path.read_bytes()):
            return False
        path.replace(path.with_name(path.name + ".damaged"))
    except OSError:
        return False
    return True


def _is_damaged(data: bytes) -> bool:
    """Return whether this is no ini file: no text, an open section, or neither sections nor settings."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        return True
    lines = [line.strip() for line in text.splitlines()]
    lines = [line for line in lines if line and not line.startswith((";", "#"))]
    is_open = any(line.startswith("[") and "]" not in line for line in lines)
    return "\0" in text or is_open or bool(lines and not any(map(_SETTING.match, lines)))
