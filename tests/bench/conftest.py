"""The helpers of the benchmarks are imported by name; the targets are printed at the end."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import pytest
import targets


def pytest_itemcollected(item):
    """Let a benchmark take as long as it takes: pytest calls this for the items of this folder only."""
    item.add_marker(pytest.mark.time_limit(0))


def pytest_terminal_summary(terminalreporter):
    """Print every target with its figure."""
    if targets.rows:
        terminalreporter.section("targets")
        for row in targets.rows:
            terminalreporter.write_line(str(row))
