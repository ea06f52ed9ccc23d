"""Work beside the window's thread: its result, what it raises, and taking it back."""

from __future__ import annotations

import gc
import threading
import time
import weakref
from contextlib import suppress
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QCoreApplication, QObject, QTimer
from PySide6.QtWidgets import QWidget

from app.tasks import garbage, task
from app.tasks.progress import FINAL, part
from app.tasks.task import SHOWN_AFTER_MS, DebouncedTask, SingleTask, Task, TaskOwner, close_all
from tests.waiting import LIMIT, until


@pytest.fixture
def jobs(qtbot):
    made = SingleTask()
    yield made
    made.close()
    until(no_task_runs)


def no_task_runs():
    return not any(keeper.running for keeper in task._keepers)


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


def test_no_progress_arrives_after_the_end(qtbot):
    """A dialog said "Reading…" for ever: a tick had found the end of a thread before its signals arrived."""
    heard = []
    work = Task(
        lambda report: report(0.5, "Halfway"),
        then=lambda _task: heard.append("end"),
        on_progress=lambda *_share: heard.append("share"),
    )
    work.thread.join()
    task._keeper()._tick()
    assert heard == ["end"]
    QCoreApplication.processEvents()
    assert heard == ["end"]


def test_an_exception_arrives_in_the_windows_thread(jobs):
    heard = Heard()

    def work(_report):
        raise ValueError("no")

    jobs.start("Failing", work, heard.done, heard.failed)
    until(lambda: heard.problems)
    assert str(heard.problems[0]) == "no"
    assert heard.threads == [threading.current_thread()]
    assert not heard.results


def test_cancelled_work_has_no_result(jobs):
    heard, ended, went_on = Heard(), [], threading.Event()

    def work(report):
        went_on.wait(LIMIT)
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
    until(no_task_runs)
    assert heard.results == ["wanted"]
    assert heard.problems == []


def test_a_pending_result_of_cancelled_work_is_dropped(jobs):
    heard, finished = Heard(), threading.Event()

    def work(_report):
        finished.set()
        return 1

    jobs.start("Quick", work, heard.done, heard.failed)
    assert finished.wait(LIMIT)
    jobs._task.thread.join()  # from now on the signal waits in the queue
    jobs.cancel()
    until(no_task_runs)  # it has arrived
    assert heard.results == []


def test_only_one_task_runs_at_a_time(jobs):
    heard, release = Heard(), threading.Event()
    assert jobs.start("First", lambda _report: release.wait(LIMIT), heard.done, heard.failed)
    assert not jobs.start("Second", lambda _report: 2, heard.done, heard.failed)
    assert jobs.title == "First"
    release.set()
    until(lambda: heard.results)
    assert heard.results == [True]


def test_only_long_work_shows_progress(jobs):
    heard, shown, shares, release = Heard(), [], [], threading.Event()
    assert jobs._patience.interval() == SHOWN_AFTER_MS
    jobs._patience.setInterval(60_000)  # so that on no machine "short" takes longer
    jobs.shown.connect(shown.append)
    jobs.progressed.connect(lambda share, word: shares.append((share, word)))
    jobs.start("Short", lambda _report: 1, heard.done, heard.failed)
    until(lambda: heard.results)
    assert not jobs._patience.isActive()
    assert shown == []
    jobs._patience.setInterval(1)

    def long(report):
        report(0.25, "Working")
        release.wait(LIMIT)

    jobs.start("Long", long, heard.done, heard.failed)
    until(lambda: shown and shares)
    assert shown == ["Long"]
    assert shares == [(0.25, "Working")]
    release.set()
    until(lambda: not jobs.is_busy)


def test_closing_waits_for_cancelled_work(jobs, monkeypatch):
    monkeypatch.setattr(task, "PATIENCE_S", LIMIT)
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
    assert work_threads() == []
    assert heard.results == heard.problems == []


def test_the_final_step_cannot_be_cancelled(jobs):
    """What has been put in place is there; it must not be called undone."""
    heard, begun, release = Heard(), threading.Event(), threading.Event()

    def work(report):
        report(FINAL, "Putting it in place")
        begun.set()
        release.wait(LIMIT)
        report(0.5, "Later reports are heard by nobody")
        return "written"

    jobs.start("Writing", work, heard.done, heard.failed)
    assert begun.wait(LIMIT)
    assert not jobs.cancel()
    assert jobs.is_busy
    release.set()
    until(lambda: heard.results)
    assert heard.results == ["written"]


class Cyclic(QWidget):
    """A widget that only the collector frees; with a timer, which no other thread can stop."""

    def __init__(self):
        super().__init__()
        self.me = self
        QTimer(self, interval=10_000).start()


def churn(ends):
    """Make garbage, more than lets a collector begin, until `ends`."""
    while not ends():
        assert len([[] for _ in range(2000)]) == 2000


@pytest.fixture
def quick_keeper(garbage_collected_in_loop, monkeypatch):
    """Look for garbage often, in generations that are soon due."""
    monkeypatch.setattr(task, "_TICK_MS", 5)
    monkeypatch.setattr(task, "_keepers", [])
    before = gc.get_threshold()
    gc.set_threshold(700, 1, 1)
    yield
    until(no_task_runs)
    gc.set_threshold(*before)


@pytest.mark.parametrize("kind", ["jobs", "debounced", "task"])
def test_garbage_is_collected_in_the_windows_thread_while_work_runs(quick_keeper, jobs, kind):
    """Three widgets in cycles were destroyed by the thread of a `DebouncedTask`, and of the autosave.

    Young ones and those of the oldest generation: all go, and while the work goes on.
    """
    threads, release = [], threading.Event()
    widgets = [Cyclic() for _ in range(3)]
    gc.collect()
    widgets += [Cyclic() for _ in range(3)]
    for each in widgets:
        weakref.finalize(each, lambda: threads.append(threading.current_thread()))
    debounced = DebouncedTask(settle_ms=0)
    if kind == "jobs":
        jobs.start("Churning", lambda _report: churn(release.is_set), print, print)
    elif kind == "debounced":
        debounced.ask(lambda _report: churn(release.is_set))
        until(lambda: not gc.isenabled())
    else:
        Task(lambda _report: churn(release.is_set))
    del each, widgets
    until(lambda: len(threads) == 6)
    assert set(threads) == {threading.main_thread()}
    release.set()
    until(no_task_runs)


def test_garbage_collection_of_the_oldest_generation_is_limited_during_a_task(quick_keeper):
    """A twentieth of a second it took at the beginning of nearly every task, and the window stood still."""
    collected, release = [], threading.Event()

    def note(phase, info):
        if phase == "start":
            collected.append(info["generation"])

    for _ in range(3):
        gc.collect(1)
    assert gc.get_count()[2] > gc.get_threshold()[2]
    gc.callbacks.append(note)
    Task(lambda _report: churn(release.is_set))
    until(lambda: 2 in collected)
    gc.callbacks.remove(note)
    release.set()
    assert collected[: collected.index(2)].count(1) > gc.get_threshold()[2]


def test_objects_of_a_task_are_destroyed_in_the_windows_thread(qapp):
    threads = []
    widget = QWidget()
    weakref.finalize(widget, lambda: threads.append(threading.current_thread()))
    Task(lambda _report, widget=widget: None)
    del widget
    until(lambda: threads)
    assert threads == [threading.main_thread()]


def test_a_collector_that_was_off_stays_off(garbage_collected_in_loop):
    gc.disable()
    Task(lambda _report: None)
    until(no_task_runs)
    assert not gc.isenabled()
    assert garbage._collectors == []


def work_threads():
    return [each for each in threading.enumerate() if each.name == "work"]


def test_cancelled_work_that_never_reports_is_ended(jobs, monkeypatch):
    """Stop said "stopped", and the thread went on until the memory was gone."""
    monkeypatch.setattr(task, "_GRACE_S", 0.02)
    heard, begun, cleaned = Heard(), threading.Event(), threading.Event()

    def work(_report):
        try:
            begun.set()
            while True:
                with suppress(Exception):
                    sum(range(100))
        finally:
            cleaned.set()

    jobs.start("Endless", work, heard.done, heard.failed)
    assert begun.wait(LIMIT)
    assert jobs.cancel()
    until(lambda: not work_threads())
    until(no_task_runs)
    assert cleaned.is_set()
    assert heard.results == heard.problems == []


def test_cleanup_of_ended_work_gets_more_time_at_each_attempt(qapp, monkeypatch):
    """Beside busy programs it may take longer than the work had to notice."""
    now, raised, release = [0.0], [], threading.Event()
    monkeypatch.setattr(task.ctypes.pythonapi, "PyThreadState_SetAsyncExc", lambda *_: raised.append(now[0]))
    waiting = Task(lambda _report: release.wait(LIMIT))
    with monkeypatch.context() as patch:
        patch.setattr(task, "time", SimpleNamespace(monotonic=lambda: now[0]))
        waiting.stop()
        for _look in range(70):
            now[0] += 0.125
            waiting.end_overdue()
    release.set()
    assert raised == [1.0, 3.0, 7.0]
    until(lambda: not work_threads())


def test_closing_ends_work_that_never_reports_within_its_patience(qapp, monkeypatch):
    """Work that does not ask kept the window from closing: a `DebouncedTask` waited for it without end."""
    monkeypatch.setattr(task, "_GRACE_S", 0.02)
    monkeypatch.setattr(task, "PATIENCE_S", LIMIT)
    parent, begun = QObject(), threading.Semaphore(0)
    debounced = [DebouncedTask(parent, settle_ms=0) for _ in range(2)]
    stubborn = SingleTask(parent)

    def work(_asks):
        begun.release()
        while True:
            sum(range(100))

    for each in debounced:
        each.ask(work)
    stubborn.start("Endless", work, print, print)
    until(lambda: len(work_threads()) == 3)
    for _ in range(3):
        assert begun.acquire(timeout=LIMIT)
    close_all(parent.findChildren(TaskOwner))
    assert work_threads() == []


def test_a_task_ended_from_outside_is_removed(qapp, monkeypatch):
    """It sends no signal: a timer tells the thread of the window, for which `tests/leak_check.py` waits."""
    monkeypatch.setattr(task, "_GRACE_S", 0.02)
    begun = threading.Event()

    def work(_report):
        begun.set()
        while True:
            sum(range(100))

    endless = Task(work)
    assert begun.wait(LIMIT)
    endless.stop()
    assert endless.wait(LIMIT)
    # As if it had ended between two ticks.
    endless._keeper._timer.start()
    assert not no_task_runs()


def test_closing_does_not_wait_for_work_that_cannot_be_ended(jobs, monkeypatch):
    """A disk of a network that answers no more, for one."""
    monkeypatch.setattr(task, "PATIENCE_S", 0.05)
    monkeypatch.setattr(task, "_GRACE_S", 0.01)
    release = threading.Lock()
    release.acquire()
    jobs.start("Stuck", lambda _report: release.acquire(timeout=LIMIT) and release.release(), print, print)
    jobs.close()
    assert len(work_threads()) == 1
    assert not jobs.is_busy
    release.release()


def test_a_task_can_begin_after_another_one(qapp):
    order, release = [], threading.Event()
    first = Task(lambda _report: (release.wait(LIMIT), order.append(1)))
    last = Task(lambda _report: order.append(2), after=first)
    release.set()
    assert last.wait(LIMIT)
    assert order == [1, 2]
    until(no_task_runs)
    assert last.after is None


def test_an_exception_of_a_task_reaches_the_hook(qtbot):
    def fails(_task):
        raise ValueError("eleven")

    with qtbot.captureExceptions() as caught:
        Task(fails)
        until(lambda: caught)
    assert str(caught[0][1]) == "eleven"


def test_a_part_of_the_work_reports_its_share_of_the_whole():
    told = []
    half = part(lambda share, word: told.append((share, word)), 0.5, 1.0)
    half(0.0, "a")
    half(1.0, "b")
    assert told == [(0.5, "a"), (1.0, "b")]
