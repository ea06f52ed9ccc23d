"""The helpers of the benchmarks are imported by name; the targets are printed at the end."""

from __future__ import annotations

import gc
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import pytest
import targets
from shiboken6 import delete

from app.tasks import garbage


def pytest_itemcollected(item):
    """Let a benchmark take as long as it takes: pytest calls this for the items of this folder only."""
    item.add_marker(pytest.mark.time_limit(0))


@pytest.fixture(autouse=True)
def _garbage_collected():
    """Have garbage collected as in the program; in tests it is between tests."""
    gc.enable()
    yield
    gc.disable()
    while garbage._collectors:
        delete(garbage._collectors.pop())


def pytest_terminal_summary(terminalreporter):
    """Print every target with its figure."""
    if targets.rows:
        terminalreporter.section("targets")
        for row in targets.rows:
            terminalreporter.write_line(str(row))
