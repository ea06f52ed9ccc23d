"""The layers: contracts in pyproject.toml, and what they cannot say."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from app.features import FEATURES
from tests.rows import each_row

ROOT = Path(__file__).resolve().parent.parent
QT = ["PySide6", "shiboken6", "pyqtgraph"]


def module_name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {
    module_name(path): path for path in sorted([*ROOT.glob("curvecore/**/*.py"), *ROOT.glob("app/**/*.py")])
}


def test_the_contracts_of_the_layers_hold():
    code = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_every_feature_is_listed_in_features():
    """Where it stands in ``FEATURES`` is the order of tabs and entries, so nothing finds it by itself."""
    there = {path.parent.name for path in ROOT.glob("app/features/*/__init__.py")}
    assert sorted(there) == sorted(FEATURES)


def packages() -> list[Path]:
    """The packages but those that find their modules by listing: what is put there needs no other place."""
    sources = {name: path.read_text(encoding="utf-8") for name, path in MODULES.items()}
    listed = {
        name.rpartition(".")[0] + found
        for name, text in sources.items()
        for found in re.findall(r'Registry\(\w+, f"\{__package__\}(.+)"\)', text)
    }
    listed |= {name for name, text in sources.items() if re.search(r"Registry\(\w+, __name__\)", text)}
    # What is not named in `FEATURES` the test above tells.
    listed.add("app.features")
    maps = {module_name(path): path.parent for path in ROOT.glob("app/**/__init__.py")}
    return sorted(package for name, package in maps.items() if name not in listed)


@each_row("package", packages(), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_the_map_of_a_package_names_all_its_modules(package):
    text = ast.get_docstring(ast.parse((package / "__init__.py").read_text(encoding="utf-8"))) or ""
    named = set(re.findall(r"``(\w+)``", text))
    there = {path.stem for path in package.glob("*.py")} - {"__init__", "__main__"}
    there |= {path.parent.name for path in package.glob("*/__init__.py")}
    assert there - named == set(), "name them in the docstring of its __init__.py"
    known = {part for name in MODULES for part in name.split(".")}
    assert named - known == set(), "they are no longer there"


def test_the_layers_below_import_where_there_is_no_qt():
    packages = ("curvecore", "app.families", "app.document", "app.storage", "app.view_model", "app.tools")
    names = [name for name in MODULES if name.startswith(tuple(f"{package}." for package in packages))]
    code = f"import sys; sys.modules.update(dict.fromkeys({QT!r}))\n"
    code += "".join(f"import {name}\n" for name in [*packages, *names])
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@dataclass(frozen=True)
class Start:
    """A start of the window in a process of its own.

    Attributes
    ----------
    before, modules
        The modules that are imported before Qt is, and at the end.
    searched
        Modules whose sources PySide read, or whose imports it looked at.
    """

    before: set[str]
    modules: set[str]
    searched: list[str]


@pytest.fixture(scope="module")
def start():
    code = (
        "import app.cli, app.cli.start, inspect, sys\n"
        "print(*sys.modules)\n"
        "app.cli.application.qt_application('')\n"
        "searched = []\n"
        "inspect.getsource = lambda module: searched.append(module) or ''\n"
        "from shibokensupport.signature import loader\n"
        "loader.feature_import = lambda name, *_: searched.append(name)\n"
        "import app.cli.windows\n"
        "print(*sys.modules)\n"
        "print(*searched)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        check=True,
    )
    before, after, searched = (line.split() for line in done.stdout.split("\n")[:3])
    return Start(set(before), set(after), searched)


def test_the_window_starts_without_rarely_used_modules(start):
    late = {
        "PIL",
        "app.canvas.motion_layer",
        "app.features.motion.stage",
        "app.features.hodograph.panel",
        "app.features.joints.panel",
        "app.features.laboratory.panel",
        "app.features.lessons.panel",
        "app.features.overlays.panel",
        "app.features.wiggle.panel",
        "app.window.command_palette",
        "app.window.preferences_dialog",
        "app.features.help.shortcut_sheet",
        "app.features.motion.player",
        "defusedxml",
        "ezdxf",
        "fractions",
        "simpleeval",
        "svgelements",
    }
    names = start.modules
    assert "app.window.main_window" in names
    assert not late & names
    # No readers, writers or dialogs.
    light = {"errors", "formats", "table", "table.clipboard"}
    of_exchange = (name for name in names if name.startswith("app.exchange."))
    assert {name.removeprefix("app.exchange.") for name in of_exchange} == light
    of_dialogs = {
        name.removeprefix("app.features.import_export.") for name in names if "import_export." in name
    }
    assert of_dialogs == {
        "commands",
        "export_commands",
        "import_series",
    }


def test_the_reading_process_imports_only_the_modules_for_reading():
    """Every drawing that is read alone pays for its start."""
    code = (
        "import sys, numpy; known = set(sys.modules)\n"
        "import app.exchange.reader_main, app.exchange.svg.reader\n"
        "print(*set(sys.modules) - known)"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    names = set(done.stdout.split())
    # What its parent takes to start it, and what only a window or another command does.
    others = {"asyncio", "ezdxf", "hashlib", "logging", "random", "shutil", "subprocess", "tempfile"}
    assert not (others | set(QT)) & names
    assert not {
        name for name in names if re.match(r"app\.(cli|features|qt|session|tools|exchange\.table)", name)
    }
    assert not {name for name in names if re.match(r"curvecore\.(analysis|drag|rounding)\b", name)}
    assert len(names) < 230


def test_the_start_imports_without_a_search_through_sources(start):
    """PySide read those of 650 modules, and looked at each import: an eighth of the start."""
    assert start.searched == []
    assert "PySide6" not in start.before


def test_a_drag_of_thousands_of_curves_triggers_no_full_garbage_collection():
    """Every third move of 3,000 curves took 30 ms longer for it; here several at once make values."""
    code = (
        "import gc, app.cli.start\n"
        "with app.cli.start.no_garbage_sought():\n"
        "    pass\n"
        "searched = []\n"
        "gc.callbacks.append(lambda phase, info: searched.append(info['generation']))\n"
        "kept = [[k] for k in range(150_000)]\n"
        "assert searched and 2 not in searched, searched\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_start_imports_only_the_needed_pyqtgraph_modules_and_copies_no_names_of_qt():
    """Its package imports all it has, and has PySide make every class and enumeration of three modules.

    The rest comes when asked for, and then all is there; Qt's own modules are as they were.
    """
    code = (
        "import sys\n"
        "from PySide6 import QtCore, QtGui, QtWidgets\n"
        "names = {each: set(dir(each)) for each in (QtCore, QtGui, QtWidgets)}\n"
        "from app.plotting.graphs import pg\n"
        "assert sum(name.startswith('pyqtgraph.') for name in sys.modules) < 40\n"
        "assert not {'multiprocessing', 'pydoc', 'pyqtgraph.widgets.PlotWidget'} & set(sys.modules)\n"
        "for each, before in names.items():\n"
        "    assert before <= set(dir(each))\n"
        "    copy = getattr(pg, each.__name__.rpartition('.')[2])\n"
        "    assert before <= set(dir(copy))\n"
        "    assert len(before & set(vars(copy))) < len(before) / 3, each\n"
        "    assert all(getattr(copy, name) is not None for name in before if name.startswith('Q'))\n"
        "assert pg.QtWidgets.QApplication is QtWidgets.QApplication\n"
        "assert not hasattr(pg.QtGui, 'QNothing')\n"
        "assert not hasattr(pg, '__nothing__')\n"
        "assert 'pyqtgraph.widgets.PlotWidget' not in sys.modules\n"
        "assert pg.PlotWidget.__module__ == 'pyqtgraph.widgets.PlotWidget'\n"
        "assert not hasattr(pg, 'nothing')\n"
        "del pg.__getattr__\n"
        "def listed(pg):\n"
        "    kinds = ((type(it).__name__, getattr(it, '__module__', '')) for it in vars(pg).values())\n"
        "    return set(zip(vars(pg), kinds))\n"
        "ours = listed(pg)\n"
        "for name in [name for name in sys.modules if name.partition('.')[0] == 'pyqtgraph']:\n"
        "    del sys.modules[name]\n"
        "import pyqtgraph\n"
        "assert pyqtgraph is not pg\n"
        "assert ours == listed(pyqtgraph), ours ^ listed(pyqtgraph)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_only_one_module_imports_pyqtgraph():
    sources = {name: path.read_text(encoding="utf-8") for name, path in MODULES.items()}
    named = re.compile(r"^\s*(import|from) pyqtgraph", re.MULTILINE)
    assert [name for name, text in sources.items() if named.search(text)] == ["app.plotting.graphs"]


def test_one_module_starts_threads():
    """Python's collector runs in whatever thread allocates; ``app.tasks.task`` keeps it out of its own.

    ``processor_limit`` has one in child processes, which have no widgets.
    """
    starts = re.compile(r"\bThread\(|QThread|QRunnable|ThreadPool|concurrent\.futures|multiprocessing")
    sources = {name: path.read_text(encoding="utf-8") for name, path in MODULES.items()}
    assert [name for name, text in sources.items() if starts.search(text)] == [
        "app.tasks.processor_limit",
        "app.tasks.task",
    ]
