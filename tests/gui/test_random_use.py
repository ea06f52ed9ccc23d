"""A window used at random, by real events: nothing fails, and what is shown and kept stays what it must be.

Short by default. ``CURVEBENCH_RANDOM_MINUTES=10`` goes on for so long, one window after the other, each with
the next seed; ``CURVEBENCH_RANDOM_SEED=1234`` begins with another one. With ``CURVEBENCH_RANDOM_STEPS`` it
repeats what a failure has named.
"""

from __future__ import annotations

import faulthandler
import itertools
import os
import shutil
import sys
import threading
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from random_person import RandomPerson

from app.session import Session
from app.storage.format import decode, encode
from app.testing import Editor
from app.window import MainWindow
from tests.gui.editor_facts import assert_actions_as_rendered_anew
from tests.gui.family_files import forget_family_files
from tests.time_limit import watchdog

ROOT = Path(__file__).resolve().parents[2]
SEED = int(os.environ.get("CURVEBENCH_RANDOM_SEED", "1"))
MINUTES = float(os.environ.get("CURVEBENCH_RANDOM_MINUTES", "0"))
STEPS = int(os.environ.get("CURVEBENCH_RANDOM_STEPS", "400" if MINUTES else "140"))
ROUND_TRIP_EVERY = 25
PATIENCE = 90
"""Seconds after which a step is taken to hang."""


class Faults:
    """What goes wrong where no caller can see it: in slots, overrides, threads, and in Qt's own words."""

    def __init__(self, monkeypatch, qtlog) -> None:
        self.found: list[str] = []
        self._log, self._heard = qtlog, 0
        monkeypatch.setattr(sys, "excepthook", lambda *problem: self.add(problem[1]))
        monkeypatch.setattr(sys, "unraisablehook", lambda problem: self.add(problem.exc_value))
        monkeypatch.setattr(threading, "excepthook", lambda problem: self.add(problem.exc_value))

    def add(self, problem: BaseException) -> None:
        """Take down an exception."""
        self.found.append("".join(traceback.format_exception(problem)))

    def check(self) -> None:
        """Raise where anything went wrong since the last time."""
        records = self._log.records[self._heard :]
        self._heard = len(self._log.records)
        said = [
            record.message
            for record in records
            if not record.ignored and record.log_type_name != "QtDebugMsg"
        ]
        assert not self.found, "\n".join(self.found)
        assert not said, f"Qt says: {said}"


def assert_sound(editor, odd_values) -> None:
    """Raise unless the document can be kept, and everything that is named or drawn is there and finite."""
    session = editor.session
    assert odd_values(session.document) == []
    curves, count = session.document.curves, len(session.active_curve.points)
    assert decode(encode(session.committed)) == session.committed
    assert session.active_index in session.selected.curves
    assert session.selected.curves <= set(range(len(curves)))
    assert session.selection <= set(range(count))
    assert -1 <= session.selected.hovered < count
    for view in session.views:
        assert view.is_current or view.problem
        assert np.isfinite(view.points).all()
        assert np.isfinite(view.parameters).all()
        if view.curve is not None:
            assert np.isfinite(view.polyline).all()
            assert np.isfinite(view.flattened(1.0, editor.window.canvas.pixel_map.box).points).all()
    if session.scrub.t is not None:
        start, end = session.active_view.curve.domain
        assert start <= session.scrub.t <= end
    for plot in (editor.window.canvas, editor.window.basis_panel):
        assert np.isfinite(plot.pixel_map.box).all()


def note_edited(session) -> dict[int, int]:
    """Return what is filled with the curve that is edited behind each step, by the number of steps."""
    edited = {}

    def note() -> None:
        if session.history.is_pushing:
            edited[session.undo_stack.index()] = session.active_index

    session.history_changed.connect(note)
    return edited


def assert_history_is_exact(session, edited: dict[int, int]) -> None:
    """Raise unless undo to the beginning and redo to the end pass the same documents and curves."""
    stack = session.undo_stack
    steps = stack.index()
    there = [session.committed]
    for _ in range(steps):
        stack.undo()
        there.append(session.committed)
    for document in reversed(there[:-1]):
        stack.redo()
        # An equal one where a change has taken its own step back: the step before has what was there first.
        assert session.committed is document or session.committed == document
        # Whole curves that are chosen stay so; a curve that is edited is the one that was behind the step.
        assert session.active_index in {edited[stack.index()], *session.selected.whole_curves}
    assert stack.index() == steps


def files_of(folder: Path) -> list[Path]:
    """Return files of many kinds to open, import and drop, whole and broken."""
    hostile = sorted((ROOT / "tests/data/hostile").iterdir())[::7]
    for path in (
        *(ROOT / "resources/examples").glob("*.json"),
        *(ROOT / "resources/lessons").glob("0[1-3]*/*.json"),
        *hostile,
    ):
        shutil.copy(path, folder)
    (folder / "points.csv").write_text("x,y\n0,0\n1,2\n3,1\n", encoding="utf-8")
    (folder / "lines.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C1 2 3 4 5 0S9 1 9 9Z"/></svg>',
        encoding="utf-8",
    )
    shutil.copy(next((ROOT / "resources/screenshots").glob("*.png")), folder / "picture.png")
    return sorted(folder.iterdir())


@pytest.fixture
def folder(tmp_path):
    """Where the files lie that are opened, and where new ones are written."""
    (tmp_path / "files").mkdir()
    return tmp_path / "files"


@contextmanager
def patience(log: Path):
    """End the process where a step hangs; where it does stands after the steps."""
    with log.open("a", encoding="utf-8") as file:
        faulthandler.dump_traceback_later(PATIENCE, exit=True, file=file)
        try:
            yield
        finally:
            watchdog.end()


@contextmanager
def random_person(qtbot, seed, folder, log):
    """Put a random person in front of a new window; what is raised names the last steps."""
    window = MainWindow(Session())
    window.resize(1200, 800)
    with qtbot.waitExposed(window):
        window.show()
    person = RandomPerson(Editor.on(window), seed, files_of(folder), log)
    try:
        yield person
    except BaseException as problem:
        steps = "\n".join(person.steps)
        again = f"CURVEBENCH_RANDOM_SEED={seed} CURVEBENCH_RANDOM_STEPS={STEPS}"
        problem.add_note(f"The last steps ({again} repeats them):\n{steps}")
        raise
    finally:
        window.asks_before_closing = False
        window.close()
        window.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        forget_family_files()


def use(qtbot, seed, folder, log, faults, odd_values) -> None:
    """Use one window for a while; raise with the seed and the last steps where anything is wrong."""
    with random_person(qtbot, seed, folder, log) as person:
        person.note(f"— seed {seed}")
        edited = note_edited(person.editor.session)
        for number in range(STEPS):
            with patience(log):
                person.step()
            faults.check()
            assert_actions_as_rendered_anew(person.editor)
            assert_sound(person.editor, odd_values)
            if number % ROUND_TRIP_EVERY == 0 and not person.editor.session.is_previewing:
                assert_history_is_exact(person.editor.session, edited)
        person.editor.wait_for_work()


@pytest.mark.time_limit(60 * MINUTES + 600)
@pytest.mark.usefixtures("garbage_collected_in_loop")
def test_nothing_breaks_a_window_that_is_used_at_random(
    qtbot, qtlog, monkeypatch, folder, tmp_path, odd_values
):
    faults, log = Faults(monkeypatch, qtlog), tmp_path / "steps.txt"
    until = time.monotonic() + 60 * MINUTES
    for seed in itertools.count(SEED):
        use(qtbot, seed, folder, log, faults, odd_values)
        faults.check()
        if time.monotonic() >= until:
            break
