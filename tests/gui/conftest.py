"""The editor fixture, over a window that is used again: see shared_window.py."""

from __future__ import annotations

import gc
import sys
from pathlib import Path

import pytest

# What several of these tests share lies beside them.
sys.path.insert(0, str(Path(__file__).parent))

from PySide6.QtCore import QLocale
from PySide6.QtGui import QFontMetrics
from shared_window import SharedEditor
from shiboken6 import delete

from app.document import rule_edits
from app.document.model import Document, make_curve
from app.families import HERMITE
from app.tasks import garbage
from app.testing import Editor
from app.workbench import status_line

# On a busy machine a sentence of the status line would have stood long enough after one event or two.
status_line._MESSAGE_MS, status_line._READ_MS = 600_000, 300_000

_shared = SharedEditor()


def pytest_configure(config):
    """Let the kept window hear of tests in other folders, too."""
    config.pluginmanager.register(_shared)
    # Windows that are kept for a module are built outside of `_decimal_points`.
    QLocale.setDefault(QLocale.c())


def pytest_itemcollected(item):
    """Mark the tests of this folder, see `markers` in pyproject.toml."""
    item.add_marker("window")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Have tests first that make windows of their own: each of them puts an end to the one that is kept."""
    items.sort(key=lambda item: "editor" in getattr(item, "fixturenames", ()))


@pytest.fixture(scope="session", autouse=True)
def _a_font(qapp):
    """Fail without a font: each letter is a box of 12 pixels then, for which no window has room."""
    if not QFontMetrics(qapp.font()).inFont("a"):
        pytest.fail("No font is installed. README.md has a package that brings one.", pytrace=False)


@pytest.fixture
def editor(qtbot, record_property):
    yield _shared.get(qtbot)
    if places := _shared.take_back():
        # tests/conftest.py tells how many there were: to build the next one takes longer than most tests.
        record_property("thrown_away", places[0])


@pytest.fixture
def new_editor(qtbot):
    """Return the editor of a window in which nothing has been opened yet."""
    return Editor(qtbot)


@pytest.fixture
def waves(editor):
    """Return what draws Hermite waves of these names one above the other; the second is active."""

    def draw(names):
        wave = ((0, 0), (1, 1), (2, 0), (3, 1))
        curves = tuple(
            make_curve([(x, y + 3 * level) for x, y in wave], name=name, family=HERMITE)
            for level, name in enumerate(names)
        )
        editor.session.commit(Document(curves), "Begin", active=1)
        editor.fit()
        return editor

    return draw


@pytest.fixture
def arch(editor):
    """Four points of an arch, with room around them."""
    editor.session.commit(Document((make_curve([(0, 0), (1, 2), (3, 2), (4, 0)]),)), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    return editor


@pytest.fixture
def pen(editor):
    """An empty Hermite curve, and the pen in hand."""
    editor.new()
    editor.session.commit(rule_edits.set_family(editor.session.document, 0, HERMITE), "Begin")
    editor.trigger("addTool")
    return editor


@pytest.fixture(autouse=True)
def _decimal_points():
    """Have decimal points, whatever the machine's locale is; tests of other locales set them."""
    before = QLocale()
    QLocale.setDefault(QLocale.c())
    yield
    QLocale.setDefault(before)


@pytest.fixture
def only_new_garbage():
    """Have garbage collected of what is made from now on alone: of all, it takes half a second every time."""
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.fixture
def garbage_collected_in_loop(qapp, monkeypatch, only_new_garbage):
    """Have Python's collector on, for the first window or task to take over; elsewhere it is off in tests."""
    monkeypatch.setattr(garbage, "_collectors", [])
    gc.enable()
    yield
    gc.disable()
    for each in garbage._collectors:
        delete(each)


@pytest.fixture(scope="session")
def shared_editor():
    """Return what keeps the window of the editor fixture."""
    return _shared


@pytest.fixture(scope="module")
def own_families_in_windows(shared_editor, own_families):
    """Have windows that offer the families that only the tests have; the one that is kept has fewer."""
    with shared_editor.another("families of files"):
        yield own_families


@pytest.fixture(autouse=True)
def _nothing_said_of_family_files():
    """Fail a test that leaves a notice of a family's file: every later window would show it."""
    yield
    files = sys.modules.get("app.features.own_families.files")
    if files is not None:
        left = files.family_files()
        notices = [each for each in (left.problems, left.offered) if each]
        assert not notices, f"left over of a family's file: {notices}"
