"""Homes of tests: folders for settings, recent files and recovery files, away from the person's own.

The next test gets the same one as long as nothing is in it.
"""

from __future__ import annotations

import sys
from itertools import count
from pathlib import Path

import pytest

_HOMES = ("HOME", "USERPROFILE", "APPDATA", "LOCALAPPDATA")
_XDG = ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME")


class _Homes:
    """Homes in a folder, in the environment one after the other."""

    def __init__(self, folder: Path, environment: pytest.MonkeyPatch) -> None:
        self._folder, self._environment = folder, environment
        self._numbers = count()
        self._move()

    def empty(self) -> Path:
        """Return the home, which is an empty folder."""
        if any(self._home.iterdir()):
            self._move()
        return self._home

    def _move(self) -> None:
        self._home = self._folder / f"home{next(self._numbers)}"
        self._home.mkdir(mode=0o700)
        for name in _HOMES:
            self._environment.setenv(name, str(self._home))
        for name in _XDG:
            self._environment.setenv(name, str(self._home / name.lower()))
        self._settings_are_there = False

    def have_settings_there(self) -> None:
        """Have Qt keep settings there, from the first test on that has Qt."""
        core = sys.modules.get("PySide6.QtCore")
        if core is None or self._settings_are_there:
            return
        for scope in (core.QSettings.Scope.UserScope, core.QSettings.Scope.SystemScope):
            core.QSettings.setPath(core.QSettings.Format.IniFormat, scope, str(self._home / "settings"))
        self._settings_are_there = True


@pytest.fixture(scope="session")
def _homes(tmp_path_factory):
    with pytest.MonkeyPatch.context() as environment:
        yield _Homes(tmp_path_factory.mktemp("homes"), environment)


@pytest.fixture(autouse=True)
def own_home(_homes):
    """Keep the person's own settings, recent files and recovery files out of reach."""
    home = _homes.empty()
    _homes.have_settings_there()
    return home
