"""Check for a display: without one Qt ends the process in words of its own."""

from __future__ import annotations

import ctypes
import errno
import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

_PACKAGES: Final = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libglib-2.0.so.0": "libglib2.0-0",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
    "libX11-xcb.so.1": "libx11-xcb1",
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-image.so.0": "libxcb-image0",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-randr.so.0": "libxcb-randr0",
    "libxcb-render-util.so.0": "libxcb-render-util0",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxcb-xkb.so.1": "libxcb-xkb1",
}
"""Libraries that Qt needs of the system, and the packages of Debian and Ubuntu that have them."""

NO_DISPLAY = "There is no display to open a window on."


def has_display() -> bool:
    """Whether the environment names a display, or a platform."""
    names = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    return sys.platform != "linux" or any(os.environ.get(name) for name in names)


@contextmanager
def why_no_window(plugins: Path) -> Iterator[str]:
    """Yield the reason why Qt cannot open a window, as a sentence; empty where none is known.

    Only X11 is tested: with Wayland, or a platform that the user chose, Qt decides by itself.
    Qt does not load these libraries again. Create the application within: an X server that has no
    other client restarts when this connection ends, and would then not answer Qt.

    Parameters
    ----------
    plugins
        Folder of Qt's platform plugins.
    """
    if not has_display():
        yield NO_DISPLAY
    elif not _is_x11():
        yield ""
    elif problem := _loading_problem(plugins / "libqxcb.so"):
        yield missing_library(problem)
    else:
        with _connection_to_x() as answers:
            yield "" if answers else f"The display “{os.environ.get('DISPLAY', '')}” does not answer."


def _is_x11() -> bool:
    platform = os.environ.get("QT_QPA_PLATFORM", "")
    is_wanted = platform.startswith("xcb") or (not platform and not os.environ.get("WAYLAND_DISPLAY"))
    return sys.platform == "linux" and is_wanted


def _loading_problem(plugin: Path) -> str:
    try:
        if plugin.exists():
            ctypes.CDLL(str(plugin))
    except OSError as problem:
        return str(problem)
    return ""


def missing_library(problem: str) -> str:
    """Return a sentence on the package of the library that a loader misses; empty for other problems."""
    # The text between is in the language of the system.
    missing_file = re.escape(os.strerror(errno.ENOENT))
    match = re.fullmatch(rf"(lib[\w.+-]+\.so[\w.]*): .*: {missing_file}", problem)
    if match is None:
        return ""
    missing = {match[1]: _PACKAGES.get(match[1], "")} | _also_missing()
    packages = [package for package in missing.values() if package]
    where = f" On Debian and Ubuntu: sudo apt install {' '.join(packages)}" if packages else ""
    return f"Qt needs {', '.join(missing)}, which this system does not have.{where}"


def _also_missing() -> dict[str, str]:
    """Return all missing libraries at once, so that nobody has to install them one by one."""
    missing = {}
    for name, package in _PACKAGES.items():
        try:
            ctypes.CDLL(name)
        except OSError:
            missing[name] = package
    return missing


@contextmanager
def _connection_to_x() -> Iterator[bool]:
    """Connect to the X server that DISPLAY names; yield whether it answers."""
    try:
        xcb = ctypes.CDLL("libxcb.so.1")
    except OSError:
        yield True  # Qt will say so itself
        return
    xcb.xcb_connect.restype = ctypes.c_void_p
    xcb.xcb_connect.argtypes = [ctypes.c_char_p, ctypes.c_void_p]
    xcb.xcb_connection_has_error.argtypes = xcb.xcb_disconnect.argtypes = [ctypes.c_void_p]
    # There is always a connection object; without a server it holds an error.
    connection = xcb.xcb_connect(None, None)
    try:
        yield not xcb.xcb_connection_has_error(connection)
    finally:
        xcb.xcb_disconnect(connection)
