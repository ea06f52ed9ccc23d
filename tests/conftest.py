"""Fixtures of every test: no display, repeatable randomness, documents that are looked at.

How a test passes on any machine, however busy:

- It never asks how long something takes. It waits with `tests.waiting.until(condition)`, counts calls,
  frames or events (``effort``), or sets the clock (`history.clock`, `player.clock`). Where a timer decides,
  the test gives it an interval. A test that hangs for ten minutes ends its process with a traceback
  (``time_limit``; the marker `time_limit(seconds)` sets another limit).
- It leaves nothing behind: a timer, thread, process, window, handler or environment variable fails it by
  name (``leak_check``). A lock needs its `release`: garbage is collected between tests only.
- Products of matrices are compared within their bound, pixels in heights of the font, system errors with
  `os.strerror`. Language, time zone and installed programs may differ.
- A GUI test uses the fixture `editor`, whose window is reset and used again; a new window takes longer than
  most tests, so only tests about new windows make one. Questions about the same drawing are one test, and
  so are the quick rows of a table (``rows``): all rows are tested, and a failure names those that fail. A
  run ends with the tests after which the window differed from a new one; ``gui/fingerprint`` names what was
  drawn last.
- It passes after any other test: ``CURVEBENCH_ORDER=7 python -m pytest -n auto`` runs all in another order.
"""

from __future__ import annotations

import functools
import gc
import locale
import math
import os
import subprocess
import sys
from enum import Enum
from itertools import compress
from operator import is_not
from pathlib import Path

if sys.dont_write_bytecode:
    # Many containers want no bytecode beside the sources. Without any, every run compiles all tests, and
    # every process that a test starts the whole program.
    sys.dont_write_bytecode = False
    sys.pycache_prefix = str(Path(__file__).parents[1] / ".pytest_cache/bytecode")
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix

# Before Qt and NumPy are imported: both read these once. A desktop's scale, font size, style, plugins and log
# are removed; QT_QPA_PLATFORM may name a display on which to watch.
if _of_qt := [name for name in os.environ if name.startswith("QT_") and name != "QT_QPA_PLATFORM"]:
    for _name in _of_qt:
        del os.environ[_name]
if not os.environ.get("QT_QPA_PLATFORM"):
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
if sys.platform == "linux" and locale.nl_langinfo(locale.CODESET) != "UTF-8":
    os.environ["LC_ALL"] = "C.UTF-8"  # Qt takes this one, and would say so on stderr in every process

import msgspec
import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers
from pytestqt.qtbot import QtBot

from app.families import FAMILIES, Family, FamilySettingValues
from app.qt import spare_sources
from app.tasks.garbage import Generations
from tests.waiting import LIMIT_MS

# Those of pytest-qt are 5 s.
for _wait in (QtBot.waitActive, QtBot.waitExposed, QtBot.waitSignal, QtBot.waitUntil):
    _wait.__kwdefaults__["timeout"] = LIMIT_MS

# In this order: each finds the homes of the tests in the environment.
pytest_plugins = [
    "tests.homes",
    "tests.time_limit",
    "tests.leak_check",
    "tests.worker_reports",
    "tests.order",
]

settings.register_profile(
    "curvebench",
    deadline=None,
    derandomize=True,
    max_examples=60,
    suppress_health_check=[HealthCheck.too_slow],  # by the clock
)
settings.load_profile("curvebench")
# Constants of the program would be among the examples: every process would parse all of it for them, and a
# test would have other examples wherever other modules are imported.
providers.is_local_module_file = lambda _path: False

# A disk takes some milliseconds for each, beside other programs twenty: no test asks what is left where the
# power fails. Processes that tests start wait for it.
os.fsync = os.fstat

_generations = Generations()


@pytest.fixture(scope="module")
def own_families():
    """Have the families that only the tests have, from files, as if the command line had named these."""
    from app.families.family_file import families_of_files
    from tests.own_families import FILES

    with families_of_files(FAMILIES, [str(path) for path in FILES]):
        yield FAMILIES


@pytest.fixture
def children(monkeypatch):
    """The processes that were started to read drawings."""
    started, start = [], subprocess.Popen

    def note(*arguments, **options):
        started.append(start(*arguments, **options))
        return started[-1]

    monkeypatch.setattr("app.exchange.reader_process.subprocess.Popen", note)
    return started


@pytest.fixture
def drawings_read_here(monkeypatch):
    """Read drawings in this process: to start one of its own takes longer than reading most of them.

    For questions about what is read. That a process reads it, and what its limits do, others ask.
    """
    from app.exchange import reader_main, reader_process

    def read(reader, data, tolerance, *, report, **_limits):
        report(0.0, "Reading")
        answer = reader_process.response_to(
            reader_process.ReadRequest(reader.__module__, reader.__name__, tolerance, data),
            reader_process.MEMORY,
        )
        if answer.result is None:
            raise reader_process.ExchangeError(answer.problem)
        return answer.result

    monkeypatch.setattr(reader_main, "limit_memory", lambda _extra: None)
    monkeypatch.setattr(reader_process, "read_in_process", read)


def _goes_backwards(config):
    """Whether this is every other process of a run: it reads the folder's modules from the last one on.

    In a new checkout each module is compiled by the process that reads it first, and the others find it so:
    side by side all of them would compile every one.
    """
    # Several folders or files on the command line are collected in that order.
    number = getattr(config, "workerinput", {}).get("workerid", "gw0").removeprefix("gw")
    return int(number) % 2 == 1 and len(config.args) == 1


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Read folders backwards where this process does."""
    report = yield
    if isinstance(collector, pytest.Directory) and _goes_backwards(collector.config):
        report.result.reverse()
    return report


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Have the same order in all processes: folder by folder, by name."""
    if _goes_backwards(config):
        items.sort(key=lambda item: item.path.parts)


def pytest_ignore_collect(collection_path, config):
    """Leave the tests of windows unread where none is wanted: they import Qt and the whole program."""
    if config.option.markexpr == "not window" and collection_path == Path(__file__).parent / "gui":
        return True
    return None


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Collect tests, but no garbage: to look for it takes as long as all else, and there is next to none.

    Nor is what was collected looked through again and again: it stays to the end. From then on garbage is
    collected between tests: never in a destructor of Qt's, nor in a thread (see app/tasks/garbage.py).
    """
    gc.disable()
    # pytest-qt has imported Qt. As the program does at its start.
    spare_sources()
    try:
        return (yield)
    finally:
        gc.freeze()
        # Behind many a test there would be next to nothing to collect.
        gc.set_threshold(10_000, 10, 10)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    """Collect the garbage that is due, behind each test."""
    try:
        return (yield)
    finally:
        _generations.collect_due()


def pytest_make_parametrize_id(config, val, argname):
    """Call a test of a family by the family's name."""
    return val.name if isinstance(val, Family) else None


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Give every process neighbours: windows and what modules prepare are used again by the next test."""
    if config.getoption("dist") != "load":
        return None
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log)


def pytest_terminal_summary(terminalreporter):
    """Say which tests left a window that could not be used again, and where it differed from a new one."""
    # Of a test that fails, that is no news.
    left = [
        (report.nodeid, value)
        for report in terminalreporter.stats.get("", ())
        for name, value in report.user_properties
        if name == "thrown_away" and report.when == "teardown"
    ]
    if left:
        terminalreporter.write_sep("-", f"{len(left)} windows were not as new")
        for test, place in left:
            terminalreporter.write_line(f"{test} {place}")


# Every document that a session shows, in whatever test, holds plain and finite numbers alone: previews,
# steps, undo, files, snapshots. The walk is not the one of the program: it knows none of the values' names.

_PLAIN = (bool, str, type(None))


def odd_values(value: object, place: str = "document", known: object = None) -> list[str]:
    """Return what in `value` is not of the plain types, or no finite number, with its place.

    What is the same object in `known`, at the same place, is not looked at again.
    """
    if value is known and value is not None:
        return []
    if isinstance(value, msgspec.Struct):
        return [
            odd
            for name in value.__struct_fields__
            # Most fields hold nothing: each costs every test that counts calls its share.
            if type(each := getattr(value, name)) not in _PLAIN
            for odd in odd_values(each, f"{place}.{name}", getattr(known, name, None))
        ]
    if type(value) is tuple:
        return _odd_items(value, place, known)
    if type(value) is float and math.isfinite(value):
        return []
    if type(value) in _PLAIN or isinstance(value, Enum):
        return []
    if isinstance(value, FamilySettingValues):
        return [odd for name, each in value.items() for odd in _odd_setting(each, f"{place}.{name}")]
    if isinstance(value, Family):
        return odd_values(value.name, f"{place}.name")
    return [f"{place} = {value!r}, a {type(value).__name__}"]


def _odd_setting(value: object, place: str) -> list[str]:
    return [] if type(value) in (int, str) else odd_values(value, place)


def _odd_items(items: tuple[object, ...], place: str, known: object) -> list[str]:
    before = known if isinstance(known, tuple) and len(known) == len(items) else (None,) * len(items)
    changed = compress(range(len(items)), map(is_not, items, before))
    return [odd for index in changed for odd in odd_values(items[index], f"{place}[{index}]", before[index])]


def pytest_collection_finish(session):
    """Have every session look at what it shows, where any test has one."""
    module = sys.modules.get("app.session")
    if module is None or hasattr(module.Session._show, "__wrapped__"):
        return
    show = module.Session._show

    @functools.wraps(show)
    def looked_at(self, document):
        odd = odd_values(document, known=getattr(self, "_looked_at", None))
        assert not odd, f"The document holds what is not plain: {'; '.join(odd[:5])}"
        self._looked_at = document
        show(self, document)

    module.Session._show = looked_at


@pytest.fixture(name="odd_values")
def odd_values_of():
    """Return what finds the values of a document that are not plain."""
    return odd_values
