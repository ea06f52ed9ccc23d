"""Work beside the window's thread: its result, what it raises, and taking it back."""

from __future__ import annotations

import gc
import threading
import time

import pytest
from PySide6.QtTest import QTest

from app.exchange.progress import FINAL, part
from app.worker import Jobs


@pytest.fixture
def jobs(qtbot):
    made = Jobs()
    yield made
    made.close()
    until(gc.isenabled)


def until(condition, seconds=10):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        QTest.qWait(2)


class Heard:
    """What came of the work, and in which thread."""

    def __init__(self):
        self.results, self.problems, self.threads = [], [], []

    def done(self, result):
        self.results.append(result)
        self.threads.append(threading.current_thread())

    def failed(self, problem):
        self.problems.append(problem)
        self.threads.append(threading.current_thread())


def test_the_result_arrives_in_the_windows_thread(jobs):
    heard, worker = Heard(), []

    def work(report):
        worker.append(threading.current_thread())
        report(0.5, "Halfway")
        return 42

    assert jobs.start("Thinking", work, heard.done, heard.failed)
    assert jobs.is_busy
    assert jobs.title == "Thinking"
    until(lambda: heard.results)
    assert heard.results == [42]
    assert heard.threads == [threading.current_thread()]
    assert worker != heard.threads
    assert not jobs.is_busy


def test_what_is_raised_arrives_there_too(jobs):
    heard = Heard()

    def work(_report):
        raise ValueError("no")

    jobs.start("Failing", work, heard.done, heard.failed)
    until(lambda: heard.problems)
    assert str(heard.problems[0]) == "no"
    assert heard.threads == [threading.current_thread()]
    assert not heard.results


def test_nothing_comes_of_work_that_was_taken_back(jobs):
    heard, ended, went_on = Heard(), [], threading.Event()

    def work(report):
        went_on.wait(10)
        report(0.5, "Too late")
        return "unwanted"

    jobs.ended.connect(lambda: ended.append(True))
    jobs.start("Waiting", work, heard.done, heard.failed)
    jobs.cancel()
    assert not jobs.is_busy
    assert ended == [True]
    # The next begins while the first has not noticed yet.
    assert jobs.start("Next", lambda _report: "wanted", heard.done, heard.failed)
    until(lambda: heard.results)
    went_on.set()
    until(gc.isenabled)
    assert heard.results == ["wanted"]
    assert heard.problems == []


def test_a_result_that_is_already_on_its_way_is_dropped(jobs):
    heard, finished = Heard(), threading.Event()

    def work(_report):
        finished.set()
        return 1

    jobs.start("Quick", work, heard.done, heard.failed)
    assert finished.wait(10)
    time.sleep(0.05)  # the signal waits in the queue
    jobs.cancel()
    QTest.qWait(50)
    assert heard.results == []


def test_one_thing_at_a_time(jobs):
    heard, release = Heard(), threading.Event()
    assert jobs.start("First", lambda _report: release.wait(10), heard.done, heard.failed)
    assert not jobs.start("Second", lambda _report: 2, heard.done, heard.failed)
    assert jobs.title == "First"
    release.set()
    until(lambda: heard.results)
    assert heard.results == [True]


def test_only_long_work_is_shown(jobs):
    heard, shown, shares, release = Heard(), [], [], threading.Event()
    jobs.shown.connect(shown.append)
    jobs.progressed.connect(lambda share, word: shares.append((share, word)))
    jobs.start("Short", lambda _report: 1, heard.done, heard.failed)
    until(lambda: heard.results)
    QTest.qWait(250)
    assert shown == []

    def long(report):
        report(0.25, "Working")
        release.wait(10)

    jobs.start("Long", long, heard.done, heard.failed)
    until(lambda: shown)
    assert shown == ["Long"]
    assert shares == [(0.25, "Working")]
    release.set()
    until(lambda: not jobs.is_busy)


def test_closing_waits_until_the_work_has_noticed(jobs):
    steps = []

    def work(report):
        while True:
            report(0.0, "Again")
            steps.append(1)
            time.sleep(0.005)

    heard = Heard()
    jobs.start("Endless", work, heard.done, heard.failed)
    until(lambda: len(steps) > 3)
    jobs.close()
    count = len(steps)
    time.sleep(0.05)
    assert len(steps) == count
    assert heard.results == heard.problems == []


def test_the_last_step_cannot_be_taken_back(jobs):
    """What has been put in place is there; it must not be called undone."""
    heard, begun, release = Heard(), threading.Event(), threading.Event()

    def work(report):
        report(FINAL, "Putting it in place")
        begun.set()
        release.wait(10)
        report(0.5, "Later reports are heard by nobody")
        return "written"

    jobs.start("Writing", work, heard.done, heard.failed)
    assert begun.wait(10)
    assert not jobs.cancel()
    assert jobs.is_busy
    release.set()
    until(lambda: heard.results)
    assert heard.results == ["written"]


def test_nothing_is_collected_in_the_other_thread(jobs):
    """A widget in a cycle that is collected there would be destroyed there, and take the program along."""
    heard, states, release = Heard(), [], threading.Event()

    def work(_report):
        states.append(gc.isenabled())
        release.wait(10)

    jobs.start("Watching", work, heard.done, heard.failed)
    until(lambda: states)
    release.set()
    until(gc.isenabled)
    assert states == [False]


def test_a_part_of_the_work_reports_its_share_of_the_whole():
    told = []
    half = part(lambda share, word: told.append((share, word)), 0.5, 1.0)
    half(0.0, "a")
    half(1.0, "b")
    assert told == [(0.5, "a"), (1.0, "b")]
