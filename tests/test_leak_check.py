"""Planted leaks of tests are named, and gone when the next test begins."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[1]

pytestmark = pytest.mark.window

PLANTED = """
import gc, os, signal, subprocess, sys, threading, time
import pytest
from PySide6.QtCore import QEventLoop, QLocale, QObject, QTimer
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget
from tests import leak_check

leak_check.GRACE_S = 0.1
kept = []
ended = threading.Event()


def test_thread():
    threading.Thread(target=ended.wait, daemon=True).start()


def test_thread_that_ends():
    ended.set()
    threading.Thread(target=time.sleep, args=(0.01,)).start()


def test_process():
    kept.append(subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE))


def test_process_is_gone():
    kept.pop().communicate()


def test_folder(tmp_path):
    os.chdir(tmp_path)


def test_environment():
    os.environ["CURVEBENCH_PLANTED"] = "1"


def test_collector():
    gc.disable()


def test_thresholds():
    gc.set_threshold(5, 5, 5)


def test_callbacks():
    gc.callbacks.append(print)


def test_handler():
    signal.signal(signal.SIGTERM, signal.SIG_IGN)


def test_alarm():
    signal.signal(signal.SIGALRM, signal.SIG_IGN)
    signal.setitimer(signal.ITIMER_REAL, 1000.0)


@pytest.fixture
def sets_hook():
    yield
    sys.excepthook = threading.excepthook = print


def test_hook(sets_hook):
    pass


def test_all_is_as_it_was():
    assert "CURVEBENCH_PLANTED" not in os.environ
    assert gc.isenabled() and gc.get_threshold() != (5, 5, 5) and print not in gc.callbacks
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    assert threading.excepthook is not print


def test_timer(qapp):
    kept.append(QTimer(interval=20_000))
    kept[0].start()


def test_timer_is_stopped():
    assert not kept.pop().isActive()


def test_single_shot(qapp):
    QTimer.singleShot(20_000, qapp.quit)


def test_timer_in_a_cycle(qapp):
    cycle = [QTimer(interval=20_000)]
    cycle.append(cycle)
    cycle[0].start()


def test_timer_of_a_kept_window(qapp):
    window = QWidget()
    window.setProperty("isKept", True)
    QTimer(window, interval=20_000).start()
    kept.append(window)


def test_window(qapp):
    window = QWidget()
    window.show()
    kept.append(window)


def test_hidden_window(qapp):
    kept.append(QMainWindow())


def test_quit(qapp):
    qapp.exit(3)


def test_loops_run():
    loop = QEventLoop()
    QTimer.singleShot(0, loop.quit)
    assert loop.exec() == 0


def test_locale(qapp):
    QLocale.setDefault(QLocale("de_CH"))


def test_font(qapp):
    font = qapp.font()
    font.setPointSize(font.pointSize() + 3)
    qapp.setFont(font)


def test_deleted_later(qapp):
    kept.append(QObject())
    kept[-1].deleteLater()
"""

NAMED = {
    "thread": r"thread Thread-\d+ .* of <bound method Event.wait",
    "process": r"process \[.*\] of .*test_planted.py:\d+",
    "folder": "the folder: '.*' instead of",
    "environment": "the environment: .*CURVEBENCH_PLANTED.* instead of",
    "collector": "whether garbage is collected: False instead of True",
    "thresholds": r"the collector's thresholds: \(5, 5, 5\)",
    "callbacks": "the collector's callbacks: .*print",
    "handler": "the handler of SIGTERM: .*SIG_IGN.* instead of .*SIG_DFL",
    "alarm": "the alarm: True instead of False",
    "hook": "sys.excepthook: .*print.*; threading.excepthook: .*print",
    "timer": r"timer of 20000 ms of .*test_planted.py:\d+",
    "single_shot": r"timer of 20000 ms of .*test_planted.py:\d+",
    "timer_in_a_cycle": r"timer of 20000 ms of .*test_planted.py:\d+",
    "window": r"window <PySide6.QtWidgets.QWidget",
    "hidden_window": r"window <PySide6.QtWidgets.QMainWindow",
    "quit": "an application that was told to quit",
    "locale": "the locale: .*instead of",
    "font": "the application's font: .*instead of",
}


@pytest.fixture(scope="module")
def planted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("planted")
    (folder / "test_planted.py").write_text(PLANTED)
    (folder / "pytest.ini").write_text("[pytest]\nqt_api = pyside6\n")
    plugins = ("-p", "pytestqt.plugin", "-p", "tests.leak_check", "-p", "no:cacheprovider")
    options = ("-q", "--tb=short", "--color=no", "-c", str(folder / "pytest.ini"))
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *plugins, *options, str(folder)],
        cwd=ROOT,
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


@each_row("kind", NAMED)
def test_a_leak_is_reported_for_its_test(planted, kind):
    parts = re.split(r"^_+ ERROR at teardown of test_(\w+) _+$", planted, flags=re.MULTILINE)
    reports = dict(zip(parts[1::2], parts[2::2], strict=True))
    assert re.search(f"left over: {NAMED[kind]}", reports[kind]), reports[kind]


def test_only_leaks_are_reported_and_every_leak_is_cleaned_up(planted):
    count = len(re.findall(r"^def test_", PLANTED, flags=re.MULTILINE))
    assert f"{count} passed, {len(NAMED)} errors" in planted, planted
