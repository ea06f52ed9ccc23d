"""What a test leaves behind fails it, by name: the next one would find it there.

Looked at after each test, and cleaned up, so that one failure stays one failure: timers, threads, child
processes and windows that are new; event loops that end at once, because the application was told to quit;
and settings of the process that have changed: signal handlers, hooks, the collector, folder, environment,
locale. The window that is kept for the next test (``gui/shared_window.py``) has the property ``isKept``.
"""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import NamedTuple
from weakref import WeakKeyDictionary

import pytest

GRACE_S = 10.0
"""Seconds in which threads and processes that were told to end do so; those still there are left over."""

_SIGNALS = [
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK", "SIGUSR1")
    if hasattr(signal, name)
]


class Value(NamedTuple):
    """Setting of the process: how to read it and to write it; what it is compared by, if not by itself."""

    read: Callable[[], object]
    write: Callable[[object], object]
    key: Callable[[object], object] = lambda value: value


# Processes and timers that somebody holds, each with the line that made it.
_processes: WeakKeyDictionary[subprocess.Popen, str] = WeakKeyDictionary()
_timers: WeakKeyDictionary[object, str] = WeakKeyDictionary()


def _note_makers(kind: type, made: WeakKeyDictionary) -> None:
    """Record every instance of `kind` with the line that makes it."""
    begin = kind.__init__

    def recording(self, *arguments, **named):
        frame = sys._getframe(1)
        while frame.f_code.co_filename == subprocess.__file__:
            frame = frame.f_back
        made[self] = f"{os.path.relpath(frame.f_code.co_filename)}:{frame.f_lineno}"
        begin(self, *arguments, **named)

    kind.__init__ = recording


def _environment() -> dict[object, object]:
    # As the system has it: to decode every name and value takes longer than all the rest.
    values = os.environ._data.copy()
    values.pop(os.environ.encodekey("PYTEST_CURRENT_TEST"), None)
    return values


def _set_environment(before: dict[object, object]) -> None:
    decoded = {os.environ.decodekey(name): os.environ.decodevalue(value) for name, value in before.items()}
    for name in _environment().keys() - before.keys():
        del os.environ[os.environ.decodekey(name)]
    os.environ.update(decoded)


def _wakeup_descriptor() -> int:
    descriptor = signal.set_wakeup_fd(-1)
    signal.set_wakeup_fd(descriptor, warn_on_full_buffer=False)
    return descriptor


def _alarm() -> bool:
    return hasattr(signal, "getitimer") and signal.getitimer(signal.ITIMER_REAL) != (0.0, 0.0)


def _set_alarm(is_set: bool) -> None:
    if not is_set:
        signal.setitimer(signal.ITIMER_REAL, 0.0)


def _hook(module: ModuleType, name: str) -> Value:
    def key(hook: object) -> object:
        # pytest-qt has one of its own in most phases of a test.
        hook = getattr(hook, "func", hook)
        return None if hook is sys.__excepthook__ or hook.__module__.startswith("pytestqt") else hook

    return Value(lambda: getattr(module, name), lambda hook: setattr(module, name, hook), key)


def _set_collector(is_on: bool) -> None:
    (gc.enable if is_on else gc.disable)()


def _callbacks() -> list[object]:
    # Hypothesis has one from its first test on.
    return [each for each in gc.callbacks if not getattr(each, "__module__", "").startswith("hypothesis")]


def _set_callbacks(before: list[object]) -> None:
    for each in _callbacks():
        if each not in before:
            gc.callbacks.remove(each)


def _handler(number: int) -> Value:
    return Value(lambda: signal.getsignal(number), lambda handler: signal.signal(number, handler))


VALUES = {
    "the folder": Value(os.getcwd, os.chdir),
    "the environment": Value(_environment, _set_environment),
    "whether garbage is collected": Value(gc.isenabled, _set_collector),
    "the collector's thresholds": Value(gc.get_threshold, lambda values: gc.set_threshold(*values)),
    "the collector's callbacks": Value(_callbacks, _set_callbacks),
    "sys.excepthook": _hook(sys, "excepthook"),
    "sys.unraisablehook": _hook(sys, "unraisablehook"),
    "threading.excepthook": _hook(threading, "excepthook"),
    "the descriptor that signals wake": Value(
        _wakeup_descriptor, lambda number: signal.set_wakeup_fd(number, warn_on_full_buffer=False)
    ),
    # The handler of the alarm stays with the program, see app/families/family_file.py.
    "the alarm": Value(_alarm, _set_alarm),
    **{f"the handler of {number.name}": _handler(number) for number in _SIGNALS},
}


def _qt_values(core: ModuleType, application: object) -> dict[str, Value]:
    # The one that is the system's is not equal to itself set by name.
    locale = Value(core.QLocale, core.QLocale.setDefault, lambda it: (it.name(), it.numberOptions()))
    values = {"the locale": locale}
    if hasattr(application, "setStyleSheet"):
        values |= {
            "the application's font": Value(
                application.font, application.setFont, lambda font: font.toString()
            ),
        }
    return values


class Before:
    """What was there before a test."""

    def __init__(self) -> None:
        self.threads = set(threading.enumerate())
        self.processes = {each for each in _processes if each.poll() is None}
        self.values = {name: value.read() for name, value in VALUES.items()}
        core, application = _qt()
        self.qt_values = (
            {name: value.read() for name, value in _qt_values(core, application).items()}
            if application
            else {}
        )
        self.timers = set(_active_timers())

    def leaks(self) -> list[str]:
        """Return what is new or has changed, in words, and clean it up."""
        # First of all: what has ended is told by events, and stops timers.
        found = self._threads()
        core, application = _qt()
        values = VALUES
        if application is not None:
            found += _end_of_loops(core, application)
            # With what those events have begun: a task that follows one that has ended, say.
            found += self._threads()
            application.processEvents()
            found += self._windows()
            found += self._timers()
            values = VALUES | _qt_values(core, application)
        found += self._processes()
        before = self.values | self.qt_values
        for name, value in values.items():
            if name in before and value.key(now := value.read()) != value.key(before[name]):
                found.append(f"{name}: {now!r} instead of {before[name]!r}")
                value.write(before[name])
        return found

    def _threads(self) -> list[str]:
        new = set(threading.enumerate()) - self.threads

        def have_ended() -> bool:
            return not any(each.is_alive() for each in new) and not _has_ended_tasks()

        if have_ended() or _is_soon(have_ended):
            return []
        return [
            f"thread {each.name} of {getattr(each, '_target', None) or type(each)}"
            for each in new
            if each.is_alive()
        ]

    def _processes(self) -> list[str]:
        def running() -> list[subprocess.Popen]:
            return [each for each in _processes if each not in self.processes and each.poll() is None]

        if not running() or _is_soon(lambda: not running()):
            return []
        left = running()
        for each in left:
            each.kill()
            each.wait()
        return [f"process {each.args} of {_processes[each]}" for each in left]

    def _timers(self) -> list[str]:
        left = [each for each in _active_timers() if each not in self.timers and not _is_of_window(each)]
        for each in left:
            each.stop()
        return [f"timer of {each.interval()} ms of {_timers[each]}" for each in left]

    def _windows(self) -> list[str]:
        widgets = sys.modules.get("PySide6.QtWidgets")
        if widgets is None or not isinstance(widgets.QApplication.instance(), widgets.QApplication):
            return []
        left = [
            widget
            for widget in widgets.QApplication.topLevelWidgets()
            if not widget.property("isKept")
            and (widget.isVisible() or isinstance(widget, widgets.QMainWindow))
        ]
        for widget in left:
            widget.hide()
            widget.deleteLater()
        return [f"window {widget} (give windows to qtbot.addWidget)" for widget in left]


def _qt() -> tuple[ModuleType | None, object]:
    """Return Qt's core and the application, if there are any."""
    core = sys.modules.get("PySide6.QtCore")
    if core is None:
        return None, None
    if not _timers_are_noted:
        _timers_are_noted.append(True)
        _note_makers(core.QTimer, _timers)
    return core, core.QCoreApplication.instance()


_timers_are_noted: list[bool] = []


def _end_of_loops(core: ModuleType, application: object) -> list[str]:
    """Tell whether event loops end at once, and have them run again; deliver what is pending."""

    def turn(loop: object) -> int:
        core.QMetaObject.invokeMethod(loop, "quit", core.Qt.ConnectionType.QueuedConnection)
        return loop.exec()

    found = []
    if turn(core.QEventLoop()) == -1:
        core.QTimer.singleShot(0, lambda: application.exit(0))
        application.exec()
        found.append("an application that was told to quit: no event loop runs any more")
    return found


def _active_timers() -> Iterator[object]:
    if not _timers:
        return
    from shiboken6 import isValid

    yield from (each for each in list(_timers) if isValid(each) and each.isActive())


def _is_of_window(timer: object) -> bool:
    while (above := timer.parent()) is not None:
        timer = above
    return bool(timer.property("isKept"))


def _has_ended_tasks() -> bool:
    """Whether a task has ended that the thread of the window still takes to run; a timer tells it soon."""
    tasks = sys.modules.get("app.tasks.task")
    keepers = tasks._keepers if tasks is not None else ()
    return any(not task.thread.is_alive() for keeper in keepers for task in keeper.running)


def _is_soon(condition: Callable[[], bool]) -> bool:
    """Wait until `condition` holds, for a while; return whether it does."""
    deadline = time.monotonic() + GRACE_S
    while not condition():
        if time.monotonic() > deadline:
            return False
        _, application = _qt()
        if application is not None:
            # What has ended is told to the window's thread.
            application.processEvents()
        time.sleep(0.002)
    return True


_note_makers(subprocess.Popen, _processes)


@pytest.fixture(autouse=True)
def _no_leaks():
    """Fail a test that leaves something behind."""
    before = Before()
    yield
    leaks = before.leaks()
    assert not leaks, f"left over: {'; '.join(leaks)}"
