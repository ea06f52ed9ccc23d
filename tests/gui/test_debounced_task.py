"""Work beside the window: the last question is answered, earlier ones are forgotten."""

from __future__ import annotations

import threading

import pytest

from app.tasks.progress import Cancelled
from app.tasks.task import DebouncedTask
from tests.waiting import LIMIT, until


@pytest.fixture
def debounced(qtbot):
    made = DebouncedTask(settle_ms=1)
    yield made
    made.close()


def test_only_the_last_request_is_computed(qtbot, debounced):
    answers = []
    debounced.ready.connect(answers.append)
    with qtbot.waitSignal(debounced.ready):
        for number in range(5):
            debounced.ask(lambda _report, number=number: number)
    assert answers == [4]
    assert not debounced.is_busy


def test_running_work_is_cancelled_by_a_new_request(qtbot, debounced):
    began, was_stale = threading.Event(), threading.Event()

    def endless(report):
        began.set()
        try:
            while True:
                report(0.0, "Counting")
        except Cancelled:
            was_stale.set()
            raise

    debounced.ask(endless)
    until(began.is_set)
    with qtbot.waitSignal(debounced.ready) as answer:
        debounced.ask(lambda _report: "second")
    assert was_stale.wait(LIMIT)
    assert answer.args == ["second"]


def test_a_dropped_request_has_no_result(debounced):
    answers = []
    debounced.ready.connect(answers.append)
    debounced.ask(lambda _report: 1)
    debounced.give_up()
    assert not debounced._timer.isActive()
    assert debounced._task is None
    assert answers == []
    assert not debounced.is_busy


def test_an_exception_reaches_the_window(qtbot, debounced):
    def fails(_report):
        raise ValueError("seven")

    with qtbot.captureExceptions() as caught:
        debounced.ask(fails)
        until(lambda: not debounced.is_busy and bool(caught))
    assert str(caught[0][1]) == "seven"
