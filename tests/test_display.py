"""Looking before Qt does: a dead display and missing libraries are told in one line."""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path

import PySide6
import pytest

from app.cli.display import has_display, missing_library, why_no_window
from tests.test_cli import run

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere there is always a display")

PLATFORMS = Path(PySide6.__file__).parent / "Qt" / "plugins" / "platforms"


@pytest.fixture
def dead(monkeypatch):
    monkeypatch.setenv("QT_QPA_PLATFORM", "xcb")
    monkeypatch.setenv("DISPLAY", ":7391")


def why(plugins):
    with why_no_window(plugins) as sentence:
        return sentence


def test_a_display_that_is_dead(dead, tmp_path):
    assert why(tmp_path) == "The display “:7391” does not answer."


def test_the_editor_on_a_dead_display_ends_with_one_line():
    done = run(env={"DISPLAY": ":7391"})
    # Qt aborted: −6 and five lines.
    assert done.returncode == 1
    assert done.stdout == ""
    assert done.stderr.startswith("curvebench: ")
    assert done.stderr.count("\n") == 1


def test_a_library_that_qt_does_not_find(dead, tmp_path):
    plugin = (PLATFORMS / "libqxcb.so").read_bytes()
    (tmp_path / "libqxcb.so").write_bytes(plugin.replace(b"libQt6XcbQpa.so.6\0", b"libQt6XcbNoQ.so.6\0"))
    assert why(tmp_path).startswith("Qt needs libQt6XcbNoQ.so.6")


def test_the_package_is_named():
    reason = os.strerror(errno.ENOENT)
    told = missing_library(f"libxcb-cursor.so.0: cannot open shared object file: {reason}")
    assert told.startswith("Qt needs libxcb-cursor.so.0")
    assert "which this system does not have. On Debian and Ubuntu: sudo apt install libxcb-cursor0" in told
    assert "\n" not in told
    assert missing_library("libqxcb.so: invalid ELF header") == ""


def test_wayland_and_a_given_platform_are_left_to_qt(monkeypatch, tmp_path):
    monkeypatch.setenv("DISPLAY", ":7391")
    for name, value in (("WAYLAND_DISPLAY", "wayland-0"), ("QT_QPA_PLATFORM", "offscreen")):
        monkeypatch.setenv("QT_QPA_PLATFORM", "")
        monkeypatch.setenv(name, value)
        assert why(tmp_path) == ""
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name)
    assert not has_display()
    assert why(tmp_path) == "There is no display to open a window on."
