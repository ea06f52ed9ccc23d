"""A test that takes for ever: its process ends, in whatever phase it hangs, and the others go on."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

PLANTED = """
import pytest
from PySide6.QtCore import QCoreApplication, QEventLoop, QTimer


def hang():
    application = QCoreApplication.instance() or QCoreApplication([])
    timer = QTimer(interval=1)
    timer.timeout.connect(lambda: None)
    timer.start()
    QEventLoop().exec()


@pytest.fixture
def hangs_before():
    hang()


@pytest.fixture
def hangs_behind():
    yield
    hang()


def test_in_its_call():
    hang()


def test_in_its_setup(hangs_before):
    pass


def test_in_its_teardown(hangs_behind):
    pass


def test_in_its_teardown_after_a_failure(hangs_behind):
    raise ZeroDivisionError


def test_of_another_kind():
    pass


@pytest.mark.time_limit(0)
def test_without_a_limit():
    import time
    time.sleep(0.7)
"""


@pytest.fixture(scope="module")
def planted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("planted")
    (folder / "test_planted.py").write_text(PLANTED)
    (folder / "pytest.ini").write_text("[pytest]\n")
    (folder / "conftest.py").write_text("from tests import time_limit\n\ntime_limit.LIMIT_S = 0.5\n")
    options = (
        "-p",
        "xdist",
        "-p",
        "tests.time_limit",
        "-p",
        "no:cacheprovider",
        "--color=no",
        "-c",
        str(folder / "pytest.ini"),
    )
    return subprocess.run(
        # One after the other: tracebacks of two that end at once are written into each other.
        [sys.executable, "-m", "pytest", "-n", "1", *options, str(folder)],
        cwd=ROOT,
        # Five processes start, one for each that ends: without plugins that none of them needs.
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_run_ends_and_the_others_are_run(planted):
    assert planted.returncode == 1, planted.stdout + planted.stderr
    # The one that fails before it hangs is counted twice.
    assert "5 failed, 3 passed" in planted.stdout, planted.stdout


@pytest.mark.parametrize(
    ("test", "function"),
    [
        ("test_in_its_call", "test_in_its_call"),
        ("test_in_its_setup", "hangs_before"),
        ("test_in_its_teardown", "hangs_behind"),
        ("test_in_its_teardown_after_a_failure", "hangs_behind"),
    ],
)
def test_the_test_is_named_and_where_it_hangs(planted, test, function):
    reported = [line for line in planted.stdout.splitlines() if line.endswith(f"::{test}'")]
    assert any("crashed while running" in line for line in reported), planted.stdout
    assert f" in {function}\n" in planted.stderr, planted.stderr


def test_only_benchmarks_have_no_limit(request):
    """Collected together with them, all tests had none."""
    without = {
        item.path
        for item in request.session.items
        if (marker := item.get_closest_marker("time_limit")) and marker.args == (0,)
    }
    assert {path.parent for path in without} <= {ROOT / "tests/bench"}
