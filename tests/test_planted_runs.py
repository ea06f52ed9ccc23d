"""Runs of planted tests on pytest-xdist's workers.

A test that takes for ever ends its process, in whatever phase it hangs, and the others go on. What a worker
leaves unsaid of tests is what passed beside their calls.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from tests import worker_reports
from tests.rows import each_row

ROOT = Path(__file__).resolve().parents[1]

pytestmark = pytest.mark.window

HANGING = """
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


@pytest.mark.time_limit(0)
def test_without_a_limit():
    import time
    time.sleep(0.5)
"""

ENDING = """
import pytest

pytestmark = pytest.mark.time_limit(600)


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
from tests import time_limit

time_limit.LIMIT_S = 0.3


def pytest_terminal_summary(terminalreporter):
    for report in terminalreporter.stats.get("", ()):
        if "test_ending" in report.nodeid:
            print("said of", report.when, report.user_properties)
"""


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Return both runs: one that shows dots, where tests hang, and one that shows more."""
    folder = tmp_path_factory.mktemp("planted")
    (folder / "test_hanging.py").write_text(HANGING)
    (folder / "test_ending.py").write_text(ENDING)
    (folder / "conftest.py").write_text(CONFTEST)
    (folder / "pytest.ini").write_text("[pytest]\n")
    # Side by side: one waits most of the time.
    started = [run_of(folder), run_of(folder / "test_ending.py", "-v")]
    return [
        SimpleNamespace(code=run.returncode, output=output, errors=errors)
        for run, (output, errors) in [(run, run.communicate()) for run in started]
    ]


def run_of(tests, *options):
    plugins = [f"-p{name}" for name in ("xdist", "tests.time_limit", "tests.worker_reports")]
    options = ["-n1", *plugins, "-pno:cacheprovider", "--color=no", *options]
    return subprocess.Popen(
        # One after the other: tracebacks of two that end at once are written into each other.
        [
            sys.executable,
            "-m",
            "pytest",
            "-n1",
            *plugins,
            "-pno:cacheprovider",
            "--color=no",
            *options,
            tests,
        ],
        cwd=ROOT,
        # Five processes start, one for each that ends: without plugins that none of them needs.
        env={**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.fixture
def hanging(runs):
    return runs[0]


def test_the_run_ends_and_the_others_are_run(hanging):
    assert hanging.code == 1, hanging.output + hanging.errors
    # Four hang: the one that fails before it hangs is counted twice, and the one that passes before it does.
    assert "6 failed, 4 passed, 1 skipped, 1 xfailed, 2 errors" in hanging.output, hanging.output


@each_row(
    ("test", "function"),
    [
        ("test_in_its_call", "test_in_its_call"),
        ("test_in_its_setup", "hangs_before"),
        ("test_in_its_teardown", "hangs_behind"),
        ("test_in_its_teardown_after_a_failure", "hangs_behind"),
    ],
)
def test_a_hanging_test_is_reported_with_its_name_and_function(hanging, test, function):
    reported = [line for line in hanging.output.splitlines() if line.endswith(f"::{test}'")]
    assert any("crashed while running" in line for line in reported), hanging.output
    assert f" in {function}\n" in hanging.errors, hanging.errors


def test_only_benchmarks_have_no_limit(request):
    """Collected together with them, all tests had none."""
    without = {
        item.path
        for item in request.session.items
        if (marker := item.get_closest_marker("time_limit")) and marker.args == (0,)
    }
    assert {path.parent for path in without} <= {ROOT / "tests/bench"}


def test_all_failures_and_their_output_are_reported(runs):
    dots, more = (run.output for run in runs)
    assert "1 failed, 2 passed, 1 skipped, 1 xfailed, 2 errors" in more, more
    for output in (dots, more):
        assert "said of teardown [('told', 'of its teardown')]" in output, output
    # Of six tests two get no further than their set-up, and one fails in its teardown: four and five pass.
    assert [output.count("said of") for output in (dots, more)] == [1, 9], dots


@each_row(
    ("option", "value", "arrive"),
    [
        ("verbose", 0, False),
        ("verbose", -1, False),
        ("verbose", 1, True),
        ("durations", 1, True),
        ("xmlpath", "report.xml", True),
        ("reportchars", "fE", False),
        ("reportchars", "p", True),
        ("reportchars", "P", True),
        ("reportchars", "A", True),
    ],
)
def test_options_that_show_more_than_dots_get_all_reports(option, value, arrive):
    class WorkerInteractor:
        def sendevent(self, name, **event):
            sent.append(name)

    sent, plugin = [], WorkerInteractor()
    options = {"verbose": 0, "durations": None, "xmlpath": None, "reportchars": "fE", option: value}
    manager = SimpleNamespace(get_plugins=lambda: [plugin])
    worker_reports.pytest_configure(
        SimpleNamespace(option=SimpleNamespace(**options), pluginmanager=manager, workerinput={})
    )
    passed = {"when": "setup", "outcome": "passed", "user_properties": []}
    plugin.sendevent("testreport", data=passed)
    assert bool(sent) is arrive
