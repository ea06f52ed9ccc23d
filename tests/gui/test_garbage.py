"""Garbage is collected between two events: in no destructor of Qt's, and not all of it again and again."""

from __future__ import annotations

import gc
import random
import weakref
from functools import partial

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer
from PySide6.QtWidgets import QApplication, QLabel, QMainWindow, QMenu, QWidget

from app.cli.windows import Lifecycle
from app.session import Session
from app.tasks import garbage
from app.tasks.garbage import Generations
from app.testing import spin
from app.window.main_window import MainWindow
from tests.waiting import until


class Searches:
    """The generations that are searched, and those of them while an object of Qt's is deleted."""

    def __init__(self):
        self.generations, self.in_destructors, self._deletions = [], [], 0

    def note(self, phase, info):
        if phase == "start":
            self.generations.append(info["generation"])
            if self._deletions:
                self.in_destructors.append(info["generation"])

    def delete(self, event, go_on):
        """Go on with the event of an object; a deletion makes more than lets Python's collector begin."""
        if event.type() != QEvent.Type.DeferredDelete:
            return go_on(event)
        self._deletions += 1
        try:
            made = [[] for _ in range(3000)]
            assert len(made) == 3000
            return go_on(event)
        finally:
            self._deletions -= 1


@pytest.fixture
def searches():
    noted = Searches()
    gc.callbacks.append(noted.note)
    yield noted
    gc.callbacks.remove(noted.note)


@pytest.fixture
def soon_due(garbage_collected_in_loop, monkeypatch):
    """Have every generation due as soon as there is anything new in it."""
    monkeypatch.setattr(garbage, "_INTERVAL_MS", 1)
    before = gc.get_threshold()
    gc.set_threshold(100, 1, 1)
    yield
    gc.set_threshold(*before)


def recording_class(kind, searches):
    """Return a class derived from one of Qt's whose deletions are noted."""

    class Noted(kind):
        def event(self, event):
            return searches.delete(event, super().event)

    return Noted


class Cycle:
    """Garbage once nobody else holds it."""

    def __init__(self, held):
        self.itself, self.held = self, held


def test_the_first_window_disables_pythons_collector(garbage_collected_in_loop, qtbot):
    assert gc.isenabled()
    for _ in range(2):
        window = MainWindow(Session())
        window.asks_before_closing = False
        qtbot.addWidget(window)
        assert not gc.isenabled()
        assert len(garbage._collectors) == 1
        gc.enable()
    gc.disable()


def test_garbage_is_collected_by_the_event_loop(soon_due):
    garbage.collect_between_events()
    assert not gc.isenabled()
    gone = [weakref.ref(Cycle([])) for _ in range(3)]
    gc.collect(1)
    gone += [weakref.ref(Cycle([])) for _ in range(3)]
    kept = []
    until(lambda: kept.append([[] for _ in range(1000)]) or all(each() is None for each in gone))


@pytest.mark.parametrize("seed", range(5))
def test_no_garbage_is_collected_while_objects_are_deleted(soon_due, searches, seed):
    """The program stood still for ever when a window was closed."""
    garbage.collect_between_events()
    kinds = [
        recording_class(each, searches) for each in (QObject, QWidget, QMainWindow, QLabel, QMenu, QTimer)
    ]
    chance = random.Random(seed)
    pool = []
    for _ in range(60):
        made = chance.choice(kinds)()
        if isinstance(made, QWidget):
            recording_class(QLabel, searches)("x", made)
        made.destroyed.connect(lambda: [Cycle([]) for _ in range(1000)])
        made.cycle = Cycle(made) if chance.random() < 0.5 else None
        pool.append(made)
        each = pool[chance.randrange(len(pool))]
        each.deleteLater()
        pool.remove(each)
        del each, made
        match chance.randrange(4):
            case 0:
                spin(chance.randrange(3))
            case 1:
                QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
            case 2:
                garbage.collect_due()
    while pool:
        pool.pop().deleteLater()
    until(lambda: 2 in searches.generations)
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert searches.in_destructors == []


def test_no_garbage_is_collected_while_windows_are_deleted(soon_due, searches, qapp, monkeypatch):
    event_of = MainWindow.event
    monkeypatch.setattr(
        MainWindow, "event", lambda self, event: searches.delete(event, partial(event_of, self))
    )
    windows = [MainWindow(Session()) for _ in range(2)]
    gone = [weakref.ref(each) for each in windows]
    lifecycle = Lifecycle(qapp, windows)
    lifecycle.start()
    try:
        for each in windows:
            each.show()
        spin(50)
        while windows:
            each = windows.pop()
            each.asks_before_closing = False
            each.close()
            each = None
            spin(5)
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        kept = []
        until(lambda: kept.append([[] for _ in range(1000)]) or all(each() is None for each in gone))
    finally:
        lifecycle.stop()
    assert searches.in_destructors == []
    assert not [each for each in QApplication.topLevelWidgets() if isinstance(each, MainWindow)]


def test_the_oldest_generation_is_collected_again_after_growing_by_a_quarter(only_new_garbage, searches):
    before = gc.get_threshold()
    gc.set_threshold(100, 1, 1)
    try:
        generations = Generations()
        kept = [[] for _ in range(10_000)]
        # Python's own collector is off: nothing is searched but what is asked for here.
        while 2 not in searches.generations:
            kept += [[] for _ in range(200)]
            generations.collect_due()
        searches.generations.clear()
        count = len(kept)
        for _ in range(200):
            # Most of the new ones go.
            kept += [[] for _ in range(150)]
            generations.collect_due()
            del kept[-145:]
        assert searches.generations.count(0) > 10
        assert searches.generations.count(1) > 10
        assert 2 not in searches.generations
        while 2 not in searches.generations:
            kept += [[] for _ in range(150)]
            generations.collect_due()
        assert 1.2 * count < len(kept) < 1.6 * count
    finally:
        gc.set_threshold(*before)
