"""What ships: one version, every icon in its place, the licences, nothing that pins a machine."""

from __future__ import annotations

import ast
import re
import tomllib
from functools import cache
from pathlib import Path

import pytest

import app
import curvecore
from app.storage.resources import resource
from app.window.connect import all_actions
from tests.rows import each_row

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
ICONS = {path.stem: path for path in (ROOT / "resources/icons").glob("*.svg")}


@cache
def texts():
    return [path.read_text(encoding="utf-8") for path in sorted((ROOT / "app").rglob("*.py"))]


def nodes_where(pattern):
    """All syntax of the modules in whose text something matches: parsing all takes seconds."""
    for text in texts():
        if re.search(pattern, text):
            yield from ast.walk(ast.parse(text))


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def test_the_version_is_stated_once():
    assert PROJECT["tool"]["hatch"]["version"]["path"] == "curvecore/__init__.py"
    assert "version" in PROJECT["project"]["dynamic"]
    assert "version" not in PROJECT["project"]
    assert re.fullmatch(r"\d+\.\d+\.\d+", curvecore.__version__)
    assert app.__version__ is curvecore.__version__


def test_the_changelog_begins_with_the_present_version():
    first = re.search(r"^## (\S+)", text_of("CHANGELOG.md"), re.MULTILINE)
    assert first.group(1) == curvecore.__version__


def called_icons():
    """Names in the table of actions, and those given as constants: ``icon("save", …)``, ``icon="save"``."""
    yield from (each.icon for each in all_actions() if each.icon)
    for node in nodes_where(r"\bicon\b"):
        if not isinstance(node, ast.Call):
            continue
        called = getattr(node.func, "attr", getattr(node.func, "id", ""))
        names = [word.value for word in node.keywords if word.arg == "icon"]
        names += node.args[:1] if called == "icon" else []
        for name in names:
            if isinstance(name, ast.Constant) and isinstance(name.value, str):
                yield name.value


def test_every_icon_named_in_code_exists():
    assert {name for name in called_icons() if name not in ICONS} == set()


def test_every_icon_is_used():
    words = {
        node.value
        for node in nodes_where(f"([\"'])({'|'.join(map(re.escape, ICONS))})\\1")
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    words |= {each.icon for each in all_actions()}
    assert set(ICONS) - words - {"app"} == set()


@each_row("name", sorted(set(ICONS) - {"app"}))
def test_icons_are_one_family(name):
    drawing = ICONS[name].read_text(encoding="utf-8")
    assert 'viewBox="0 0 24 24"' in drawing
    assert 'stroke="currentColor" stroke-width="1.5"' in drawing
    assert drawing.count("stroke-width") == 1
    colours = set(re.findall(r'(?:fill|stroke)="([^"]*)"', drawing))
    assert colours <= {"none", "currentColor"}


def test_icons_refer_to_nothing_outside():
    for path in ICONS.values():
        drawing = path.read_text(encoding="utf-8").replace('xmlns="http://www.w3.org/2000/svg"', "")
        assert not re.search(r"href|://|<script|<style|<image", drawing), path.name


def test_licences_exist_and_name_their_owners():
    for name in PROJECT["project"]["license-files"]:
        assert (ROOT / name).is_file()
    assert "Curvebench contributors" in text_of("LICENSE")
    icons = resource("icons", "LICENSE").read_text(encoding="utf-8")
    assert "Lucide" in icons
    assert "ISC License" in icons


@pytest.mark.parametrize("origin", ["Lucide", "After Lucide"])
def test_the_licence_of_the_icons_lists_every_icon_that_names_an_original(origin):
    """Where they differ, put the list of the failure into the licence; all other icons are our own."""
    icons = ROOT / "resources/icons"
    named = [
        path.relative_to(icons).with_suffix("").as_posix()
        for path in sorted(icons.rglob("*.svg"))
        if f"<!-- {origin}: " in path.read_text(encoding="utf-8")
    ]
    heading = "From Lucide:" if origin == "Lucide" else "After Lucide:"
    text = text_of("resources/icons/LICENSE").partition(f"\n{heading}\n")[2].partition(".\n\n")[0]
    assert ", ".join(text.split(",")).split() == ", ".join(named).split()


def test_the_wheel_carries_the_resources_but_no_screenshots():
    folders = {path.name for path in (ROOT / "resources").iterdir()} - {"screenshots"}
    assert PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"] == {
        f"resources/{name}": f"curvebench/resources/{name}" for name in folders
    }
    # 0.7 MB that no program opens were in it.
    assert not [path for path in (ROOT / "app").rglob("*.py") if "screenshots" in path.read_text("utf-8")]


@pytest.mark.parametrize("kind", ["editor", "test"])
def test_the_readme_has_the_commands_that_ci_runs(kind):
    blocks = re.findall(rf"<!-- command: {kind} -->\n```sh\n(.+)\n```\n", text_of("README.md"))
    assert len(blocks) == 1
    assert blocks[0].startswith("python3 -m venv .venv && .venv/bin/pip install -q -e ")


def test_the_readme_opens_an_example_that_exists():
    named = re.findall(r"resources/examples/[\w.]+", text_of("README.md"))
    assert named
    assert all((ROOT / name).is_file() for name in named)


# In two parts, so that this file does not name them itself.
HOSTS = [
    "py" + "pi.org",
    "python" + "hosted.org",
    "npm" + "js.",
    "ana" + "conda.",
    "un" + "pkg.",
    "jsdelivr" + ".net",
]
LOCKS = ["*.lock", "*lock.json", "*-lock.yaml", "requirements*.txt"]
SKIPPED = {"build", "dist", "__pycache__"}


def shipped_files():
    folders = [ROOT]
    while folders:
        for path in folders.pop().iterdir():
            hidden = path.name.startswith(".") and path.name not in {".ci", ".gitignore"}
            if hidden or path.name in SKIPPED or path.name.endswith(".egg-info"):
                continue
            if path.is_dir():
                folders.append(path)
            else:
                yield path


def test_no_file_names_a_package_host_or_locks_versions():
    for path in shipped_files():
        assert not any(path.match(pattern) for pattern in LOCKS), path
        text = path.read_bytes().decode("utf-8", errors="ignore")
        assert not [host for host in HOSTS if host in text], path


def test_the_readme_example_of_the_core_runs(capsys):
    block = r"```python\n(import numpy as np\nfrom curvecore.+?)```"
    code = re.search(block, text_of("README.md"), re.DOTALL)
    assert code is not None
    exec(code[1], {})
    # Runge's function, interpolated; the weights of the points add up to one.
    assert float(capsys.readouterr().out.split()[-1]) == pytest.approx(1.0, abs=1e-14)
