"""The limit of processor time, each in a process of its own."""

import subprocess
import sys
from pathlib import Path

import pytest

from app.tasks import processor_limit

ROOT = Path(__file__).parents[1]
LIMIT = "from app.tasks.processor_limit import limit_processor_time; limit_processor_time(0.05)\n"
NO_TIMER = "import signal; del signal.setitimer\n"
# As much of the processor as there is, and nothing that another thread could break into.
IN_C = "import re; re.fullmatch('(a+)+', 'a' * 60 + 'b')"
IN_PYTHON = "while True: pass"


def code_of(text):
    return subprocess.run([sys.executable, "-c", text], cwd=ROOT, check=False, timeout=60).returncode


@pytest.mark.skipif("sys.platform == 'win32'", reason="Windows has no such timer")
@pytest.mark.parametrize("work", [IN_C, IN_PYTHON])
def test_the_system_ends_a_busy_process(work):
    assert processor_limit.was_overdue(code_of(LIMIT + work))


def test_a_thread_ends_a_busy_process_without_a_system_timer(monkeypatch):
    code = code_of(NO_TIMER + LIMIT + IN_PYTHON)
    monkeypatch.delattr("signal.setitimer", raising=False)
    assert processor_limit.was_overdue(code)


@pytest.mark.parametrize("system", ["", NO_TIMER])
def test_a_waiting_or_unlimited_process_continues(system):
    lifted = "limit_processor_time(float('inf'))\n"
    busy = "began = time.process_time()\nwhile time.process_time() - began < 0.1: pass\n"
    code = code_of(f"{system}{LIMIT}import time; time.sleep(0.1)\n{lifted}{busy}")
    assert code == 0
    assert not processor_limit.was_overdue(code)


def test_waiting_time_alone_does_not_end_a_process():
    # Beside eight busy programs for every processor a process has a ninth of it.
    assert processor_limit.longest_wait(10.0) > 9 * 10.0
