"""What every test gets: no display, a home of its own, repeatable randomness."""

from __future__ import annotations

import os
import sys

# Before Qt and NumPy are imported: both read these once.
if not os.environ.get("QT_QPA_PLATFORM"):
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import pytest
from hypothesis import settings

settings.register_profile("curvebench", deadline=None, derandomize=True, max_examples=60)
settings.load_profile("curvebench")

_HOMES = ("HOME", "USERPROFILE", "APPDATA", "LOCALAPPDATA")
_XDG = ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME")


@pytest.fixture(autouse=True)
def own_home(tmp_path_factory, monkeypatch):
    """Keep the person's own settings, recent files and recovery files out of reach."""
    home = tmp_path_factory.mktemp("home", numbered=True)
    for name in _HOMES:
        monkeypatch.setenv(name, str(home))
    for name in _XDG:
        monkeypatch.setenv(name, str(home / name.lower()))
    core = sys.modules.get("PySide6.QtCore")
    if core is not None:
        for scope in (core.QSettings.Scope.UserScope, core.QSettings.Scope.SystemScope):
            core.QSettings.setPath(core.QSettings.Format.IniFormat, scope, str(home / "settings"))
    return home


@pytest.fixture(autouse=True)
def _no_window_left_over():
    """Fail a test that leaves a window, shown or hidden; the next one would find it there."""
    yield
    widgets = sys.modules.get("PySide6.QtWidgets")
    if widgets is None or not isinstance(widgets.QApplication.instance(), widgets.QApplication):
        return
    core = sys.modules["PySide6.QtCore"]
    # What qtbot closed is deleted by an event loop, which not every next test has.
    core.QCoreApplication.sendPostedEvents(None, core.QEvent.Type.DeferredDelete)
    left = [
        widget
        for widget in widgets.QApplication.topLevelWidgets()
        if not widget.property("isKept") and (widget.isVisible() or isinstance(widget, widgets.QMainWindow))
    ]
    for widget in left:
        widget.hide()
        widget.deleteLater()
    assert not left, f"left over: {left} (give windows to qtbot.addWidget)"
