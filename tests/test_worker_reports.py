"""What a worker leaves unsaid of tests is what passed beside their calls."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

PLANTED = """
import pytest


@pytest.fixture
def tells(record_property):
    yield
    record_property("told", "of its teardown")


@pytest.fixture
def fails_before():
    raise ZeroDivisionError


@pytest.fixture
def fails_behind():
    yield
    raise ZeroDivisionError


def test_that_tells(tells): pass
def test_failing_before(fails_before): pass
def test_failing_behind(fails_behind): pass
@pytest.mark.skip
def test_skipped(): pass
@pytest.mark.xfail(strict=True)
def test_expected_to_fail(): assert False
def test_that_fails(): assert False
"""

CONFTEST = """
def pytest_terminal_summary(terminalreporter):
    for report in terminalreporter.stats.get("", ()):
        print("said of", report.when, report.user_properties)
"""


@pytest.mark.parametrize(("options", "beside"), [(["-q"], 1), (["-v"], 9), (["-q", "--durations=1"], 9)])
def test_all_failures_and_what_a_test_tells_arrive(tmp_path, options, beside):
    (tmp_path / "test_planted.py").write_text(PLANTED)
    (tmp_path / "conftest.py").write_text(CONFTEST)
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    plugins = ["-p", "xdist", "-p", "tests.worker_reports", "-p", "no:cacheprovider"]
    run = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-n",
            "1",
            *options,
            *plugins,
            "--color=no",
            "-c",
            "pytest.ini",
            ".",
        ],
        cwd=tmp_path,
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "1 failed, 2 passed, 1 skipped, 1 xfailed, 2 errors" in run.stdout, run.stdout + run.stderr
    assert "said of teardown [('told', 'of its teardown')]" in run.stdout, run.stdout
    # Of six tests two get no further than their set-up, and one fails in its teardown: four and five pass.
    assert run.stdout.count("said of") == beside, run.stdout
