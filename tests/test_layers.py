"""The layers of ``app/__init__.py`` and DESIGN, read off the imports."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
QT = {"PySide6", "shiboken6", "pyqtgraph"}
WITHOUT_QT = (
    "curvecore",
    "app.families",
    "app.document",
    "app.storage",
    "app.view_model",
    "app.tools",
    "app.exchange",
)
WITH_QT = ("app.exchange.drawing.image", "app.exchange.drawing.motion_frames")
CALLS_THE_CORE = ("app.families", "app.view_model", "app.exchange", "app.cli")
STRANGERS = {("app.canvas", "app.panels"), ("app.panels", "app.canvas")}


def layers(root: Path) -> dict[str, int]:
    """The layer number of each name in the docstring of ``app``, 0 at the top."""
    text = ast.get_docstring(ast.parse((root / "app/__init__.py").read_text(encoding="utf-8"))) or ""
    bullets = [line for line in text.splitlines() if line.startswith("- ")]
    # ``a``, ``b``: what they are.  ``c``: another of the same layer.
    named = [re.findall(r"((?:``\w+``(?:, )?)+):", line) for line in bullets]
    return {
        f"app.{name}": number
        for number, groups in enumerate(named)
        for group in groups
        for name in re.findall(r"\w+", group)
    }


def module_name(root: Path, path: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def modules(root: Path) -> dict[str, Path]:
    paths = [*root.glob("curvecore/**/*.py"), *root.glob("app/**/*.py")]
    return {module_name(root, path): path for path in sorted(paths)}


def is_within(module: str, packages) -> bool:
    return any(module == package or module.startswith(f"{package}.") for package in packages)


def statements(node: ast.AST):
    """All statements in a node, at any depth; expressions, of which there are far more, hold none."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for each in getattr(node, part, ()):
            yield each
            yield from statements(each)


def imports(name: str, path: Path, known) -> set[str]:
    """Every module that a file imports, at any depth of its code, under its absolute name."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    found = set()
    for node in statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.rsplit(".", node.level - 1)[0] if node.level else ""
            base = ".".join(part for part in (base, node.module) if part)
            names = {f"{base}.{alias.name}" for alias in node.names}
            found.update(names & set(known) or {base})
    return found


def layer_of(module: str, order: dict[str, int]) -> int | None:
    # ``python -m app`` is the command line by another name.
    name = "app.cli" if module == "app.__main__" else ".".join(module.split(".")[:2])
    return order.get(name)


def complaint(module: str, target: str, order: dict[str, int]) -> str | None:
    """What is wrong with one import, or None."""
    top = target.partition(".")[0]
    if is_within(module, ["curvecore"]):
        allowed = sys.stdlib_module_names | {"numpy", "curvecore"}
        return None if top in allowed else "curvecore knows NumPy and the standard library only"
    if top in QT and is_within(module, WITHOUT_QT) and not is_within(module, WITH_QT):
        return "this layer works without Qt"
    if top == "curvecore" and not is_within(module, CALLS_THE_CORE):
        return "only view_model, exchange and cli call the core"
    if top != "app" or target == "app":
        return None
    pair = tuple(".".join(name.split(".")[:2]) for name in (module, target))
    if pair in STRANGERS:
        return "canvas and panels do not know each other"
    own, other = layer_of(module, order), layer_of(target, order)
    if own is None or other is None or other <= own:
        return None  # a module without a layer has a test of its own
    return "a module imports from its own layer and those above it"


def violations(root: Path) -> list[str]:
    known, order = modules(root), layers(root)
    return [
        f"{name} imports {target}: {reason}"
        for name, path in known.items()
        for target in sorted(imports(name, path, known))
        if (reason := complaint(name, target, order))
    ]


def test_the_docstring_of_app_gives_the_layers():
    order = layers(ROOT)
    assert order["app.families"] == 0
    above = [
        "families",
        "document",
        "storage",
        "view_model",
        "tools",
        "session",
        "canvas",
        "main_window",
        "cli",
    ]
    numbers = [order[f"app.{name}"] for name in above]
    assert numbers == sorted(numbers)
    assert order["app.canvas"] == order["app.panels"]
    assert order["app.cli"] < order["app.testing"]


def test_every_module_has_a_layer():
    order = layers(ROOT)
    homeless = [
        name
        for name in modules(ROOT)
        if is_within(name, ["app"]) and name != "app" and layer_of(name, order) is None
    ]
    assert not homeless, "name them in the docstring of app/__init__.py"


def packages(root: Path) -> list[Path]:
    """The packages but those that find their modules by listing: what is put there needs no other place."""
    maps = {path.parent: path.read_text(encoding="utf-8") for path in root.glob("app/**/__init__.py")}
    return sorted(package for package, text in maps.items() if "iter_modules(__path__)" not in text)


@pytest.mark.parametrize("package", packages(ROOT), ids=lambda path: path.relative_to(ROOT).as_posix())
def test_the_map_of_a_package_names_all_of_it(package):
    text = ast.get_docstring(ast.parse((package / "__init__.py").read_text(encoding="utf-8"))) or ""
    named = set(re.findall(r"``(\w+)``", text))
    there = {path.stem for path in package.glob("*.py")} - {"__init__", "__main__"}
    there |= {path.parent.name for path in package.glob("*/__init__.py")}
    assert there - named == set(), "name them in the docstring of its __init__.py"
    known = {part for name in modules(ROOT) for part in name.split(".")}
    assert named - known == set(), "they are no longer there"


def test_imports_keep_to_the_layers():
    assert violations(ROOT) == []


MAP = '''"""Layers.

- ``document``: values.
- ``view_model``: arrays.
- ``tools``: press.
- ``exchange``: files.
- ``session``: owner.
- ``canvas``, ``panels``: widgets. They use ``session``.
- ``main_window``: all.
- ``cli``: the command line.  ``testing``: a driver.
"""
'''


@pytest.mark.parametrize(
    ("path", "code", "expected"),
    [
        ("curvecore/curve.py", "import scipy.interpolate", "curvecore.curve imports scipy.interpolate"),
        ("curvecore/curve.py", "from app.document import Point", "curvecore.curve imports app.document"),
        ("curvecore/curve.py", "def f():\n    import pyqtgraph", "curvecore.curve imports pyqtgraph"),
        ("app/document/model.py", "from PySide6.QtCore import Qt", "imports PySide6.QtCore"),
        ("app/document/model.py", "from ..session import Session", "imports app.session"),
        ("app/document/model.py", "import curvecore", "imports curvecore"),
        ("app/document/__init__.py", "from .. import session", "app.document imports app.session"),
        ("app/tools/drags.py", "import pyqtgraph as pg", "imports pyqtgraph"),
        ("app/exchange/svg/writer.py", "from PySide6.QtSvg import QSvgGenerator", "imports PySide6.QtSvg"),
        ("app/canvas/canvas.py", "from app.panels import Table", "canvas and panels"),
        ("app/panels/__init__.py", "import app.canvas.canvas", "canvas and panels"),
        ("app/panels/basis.py", "from curvecore import uniform", "imports curvecore"),
        ("app/view_model/basis.py", "from app import session", "app.view_model.basis imports app.session"),
        ("app/canvas/canvas.py", "if TYPE_CHECKING:\n    from app.main_window import W", "app.main_window"),
        ("app/session.py", "import app.cli", "app.session imports app.cli"),
    ],
)
def test_a_planted_violation_is_found(tmp_path, path, code, expected):
    plant(tmp_path, {path: code})
    found = violations(tmp_path)
    assert len(found) == 1
    assert expected in found[0]


def test_what_is_allowed_is_not_reported(tmp_path):
    plant(
        tmp_path,
        {
            "curvecore/curve.py": "import math\nimport numpy.linalg\nfrom .errors import E",
            "app/document/model.py": "import msgspec\nfrom app import __version__",
            "app/view_model/basis.py": "import curvecore.curve\nfrom app.document.model import Point",
            "app/exchange/drawing/image.py": "from PySide6.QtGui import QImage\nimport curvecore",
            "app/session.py": "from PySide6.QtCore import QObject\nfrom app import document",
            "app/canvas/canvas.py": "from . import items\nfrom app.session import Session",
            "app/main_window.py": "from app.canvas import canvas\nfrom app import panels",
            "app/__main__.py": "from app.cli import main",
        },
    )
    assert violations(tmp_path) == []


def plant(root: Path, files: dict[str, str]) -> None:
    """A small tree with the packages that the planted imports name."""
    packages = [f"app/{name}" for name in ("document", "view_model", "tools", "exchange", "canvas", "panels")]
    empty = [f"{package}/__init__.py" for package in ("curvecore", *packages)]
    empty += ["app/session.py", "app/main_window.py", "app/cli.py", "curvecore/errors.py"]
    for name, text in ({"app/__init__.py": MAP} | dict.fromkeys(empty, "") | files).items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    "package", ["curvecore", "app.families", "app.document", "app.storage", "app.view_model", "app.tools"]
)
def test_it_imports_where_there_is_no_qt(package):
    names = [name for name in modules(ROOT) if is_within(name, [package])]
    code = f"import sys; sys.modules.update(dict.fromkeys({sorted(QT)!r}))\n"
    code += "".join(f"import {name}\n" for name in names)
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_window_starts_without_what_is_rarely_used():
    late = {
        "PIL",
        "PySide6.QtPrintSupport",
        "app.canvas.motion_layer",
        "app.commands.motion_stage",
        "app.panels.analysis_panel",
        "app.panels.motion_bar",
        "app.panels.preferences_dialog",
        "app.panels.shortcut_sheet",
        "app.player",
        "defusedxml",
        "ezdxf",
        "fractions",
    }
    code = "import sys; import app.cli, app.main_window; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    names = set(done.stdout.split())
    assert not late & names
    # No readers, writers or dialogs.
    light = {"drawing", "drawing.styles", "errors", "formats", "options", "reading"}
    light |= {"table", "table.clipboard", "writing"}
    of_exchange = (name for name in names if name.startswith("app.exchange."))
    assert {name.removeprefix("app.exchange.") for name in of_exchange} == light
    of_panels = (name for name in names if name.startswith("app.panels."))
    assert [name for name in of_panels if "import_" in name or "export_" in name] == []


def test_one_module_starts_threads():
    """Python's collector runs in whatever thread allocates; ``app.tasks.task`` keeps it out of its own."""
    starts = re.compile(r"\bThread\(|QThread|QRunnable|ThreadPool|concurrent\.futures|multiprocessing")
    sources = {name: path.read_text(encoding="utf-8") for name, path in modules(ROOT).items()}
    assert [name for name, text in sources.items() if starts.search(text)] == ["app.tasks.task"]
