"""Work beside the window: the last question is answered, earlier ones are forgotten."""

from __future__ import annotations

import threading

import pytest

from app.worker import Settler


@pytest.fixture
def settler(qtbot):
    made = Settler(settle_ms=1)
    yield made
    made.close()


def test_only_the_last_question_is_answered(qtbot, settler):
    answers = []
    settler.ready.connect(answers.append)
    with qtbot.waitSignal(settler.ready):
        for number in range(5):
            settler.ask(lambda _stale, number=number: number)
    assert answers == [4]
    assert not settler.is_busy


def test_running_work_learns_that_nobody_waits_for_it(qtbot, settler):
    began, was_stale = threading.Event(), threading.Event()

    def endless(is_stale):
        began.set()
        while not is_stale():
            pass
        was_stale.set()

    settler.ask(endless)
    qtbot.waitUntil(began.is_set)
    with qtbot.waitSignal(settler.ready) as answer:
        settler.ask(lambda _stale: "second")
    assert was_stale.is_set()
    assert answer.args == ["second"]


def test_dropped_work_says_nothing(settler):
    answers = []
    settler.ready.connect(answers.append)
    settler.ask(lambda _stale: 1)
    settler.give_up()
    assert not settler._timer.isActive()
    assert settler._task is None
    assert answers == []
    assert not settler.is_busy


def test_an_exception_reaches_the_window(qtbot, settler):
    def fails(_stale):
        raise ValueError("seven")

    with qtbot.captureExceptions() as caught:
        settler.ask(fails)
        qtbot.waitUntil(lambda: not settler.is_busy and bool(caught))
    assert str(caught[0][1]) == "seven"
