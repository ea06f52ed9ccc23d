"""Panels show values and emit what the person meant; only their controllers know the session."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

from tests.rows import each_row

ROOT = Path(__file__).resolve().parent.parent
ROOMS = [ROOT / "app/workbench", ROOT / "app/window", *(ROOT / "app/features").iterdir()]
BUILDS = ROOT / "app/window/main_window.py"


CLASS = re.compile(r"^[ \t]*class (\w+)(?:\(([^()]*)\))?:", re.MULTILINE)


@cache
def classes_in(path: Path) -> dict[str, set[str]]:
    """The classes of a module, each with the names of its bases."""
    # To parse all modules takes a second of every process that collects tests.
    return {
        name: {base.strip() for base in bases.split(",")}
        for name, bases in CLASS.findall(path.read_text(encoding="utf-8"))
    }


def widgets_among(classes: dict[str, set[str]]) -> set[str]:
    """Those of some classes that are widgets, or models for one, by their bases and those of their bases."""
    found: set[str] = set()
    while (
        more := {
            name
            for name, bases in classes.items()
            if bases & found or any(base.startswith("Q") and base != "QObject" for base in bases)
        }
        - found
    ):
        found |= more
    return found


WIDGETS = widgets_among(
    {
        name: bases
        for path in (ROOT / "app").rglob("*.py")
        for name, bases in classes_in(path).items()
        if path != BUILDS
    }
)


def shows_something(path: Path) -> bool:
    """Whether a module makes widgets, or a model for one."""
    return not WIDGETS.isdisjoint(classes_in(path))


FOUND = filter(shows_something, (path for room in ROOMS for path in room.glob("*.py") if path != BUILDS))
SHOW = ["app/widgets", "app/features/basis", "app/features/plots"]
READ = {path for room in SHOW for path in (ROOT / room).glob("*.py") if path.stem != "commands"}
PANELS = sorted(READ.union(FOUND))


def names_in(tree: ast.AST) -> set[str]:
    """Every name, attribute, argument, keyword and imported module or name in some code."""
    found = set()
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name) | ast.arg(arg=name) | ast.alias(name=name):
                found.add(name)
            case ast.keyword(arg=str(name)) | ast.ImportFrom(module=str(name)):
                found.add(name)
    return found


def sessions_in(source: str | ast.AST) -> set[str]:
    """The names in some code that stand for the session, or for a part of it."""
    if isinstance(source, str) and not re.search(r"(?i:session)|host|context", source):
        return set()
    names = names_in(ast.parse(source) if isinstance(source, str) else source)
    return {name for name in names if "session" in name.lower() or name in ("host", "_host", "context")}


@each_row("path", PANELS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_a_panel_holds_no_session(path):
    """A module of widgets names no session; beside other classes, its widgets and functions name none."""
    source = path.read_text(encoding="utf-8")
    tree = ast.parse(source)
    others = {node.name for node in tree.body if isinstance(node, ast.ClassDef)} - WIDGETS
    if not others:
        assert sessions_in(source) == set()
    for node in tree.body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name not in others:
            assert sessions_in(node) == set(), node.name


@each_row(
    "code",
    [
        "from app.session import Session",
        "from app import session",
        "import app.session.history",
        "def __init__(self, session): pass",
        "self._session.commit(document, text)",
        "panel = Panel(session=owner)",
        "self.tools.event.session.selected.set_points([1])",
    ],
)
def test_a_panel_that_holds_a_session_is_detected(code):
    assert sessions_in(code)


def test_the_panels_of_features_are_among_the_checked_files():
    read = {path.relative_to(ROOT).as_posix() for path in PANELS}
    table = {f"app/features/point_table/{name}.py" for name in ("panel", "model", "view")}
    assert table < read
    # They derive from widgets of ours.
    assert {"app/features/curve_settings/panel.py", "app/features/reference_image/commands.py"} < read
    assert "app/features/import_export/import_table_dialog.py" in read
    assert "app/features/point_table/commands.py" not in read


def commits_in(source: str) -> list[int]:
    """The lines in which a step of the history is made without an edit: the end of a gesture."""
    if "commit" not in source and "push" not in source:
        return []
    return [
        node.lineno
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and (node.func.attr, bool(node.args)) in {("commit", True), ("push", True)}
        and "stack" not in ast.unparse(node.func)
    ]


def test_only_gestures_commit():
    """All else changes the document by `Session.change`."""
    gestures = {"app/workbench/form_edits.py"}
    allowed = ("app/tools/tool.py", "app/session/")
    found = {
        path.relative_to(ROOT).as_posix()
        for path in sorted((ROOT / "app").rglob("*.py"))
        if commits_in(path.read_text(encoding="utf-8"))
    }
    assert {name for name in found if not name.startswith(allowed)} == gestures
    assert commits_in("session.commit(document, text)") == [1]
